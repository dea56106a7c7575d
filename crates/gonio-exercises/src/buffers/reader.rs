//! A reader of OBJ files with switches: each switch is a mistake that students make. With none set it reads correctly.

use super::buffer::unit;
use super::obj_lines::{Face, ObjLines, Slots};

/// The switches of a reader. The default reads correctly.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Reader {
    /// For `v`, `vt`, `vn`: the index is used without subtracting 1.
    pub(super) from_zero: [bool; 3],
    pub(super) slots: SlotUse,
    pub(super) flip_v: bool,
    pub(super) swap_uv: bool,
    pub(super) polygons: Polygons,
    pub(super) negative: Negative,
    pub(super) tex_coord: From,
    pub(super) normal: From,
    /// Every position has one texture coordinate and one normal: those of the first or last corner that uses it.
    pub(super) unsplit: Option<Which>,
    pub(super) order: Order,
    pub(super) axes: Axes,
    pub(super) turned_over: bool,
    pub(super) objects: Option<Which>,
    /// Skips the first `v`, `vt`, `vn` and `f`.
    pub(super) skips_first: bool,
    pub(super) loses_last_face: bool,
    /// Indices count from the object's own first `v`, `vt`, `vn`.
    pub(super) anew: bool,
    pub(super) numbers: Numbers,
    /// Loses faces whose corners are not all of the form `v/vt/vn`.
    pub(super) loses_partial: bool,
    /// Cuts convex polygons along other diagonals than gonio-mesh.
    pub(super) other_diagonals: bool,
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum SlotUse {
    #[default]
    Right,
    /// `v/vn/vt`.
    Swapped,
    /// An empty slot is skipped: `v//vn` is read as `v/vt`.
    EmptyPassedOver,
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum Polygons {
    #[default]
    Right,
    /// A fan around the first corner, even if the polygon is concave.
    Fan,
    FirstTriangle,
    /// Loses everything except triangles.
    Lost,
    /// All corners of the file form one list, and every three are a triangle.
    Stream,
    /// Only the first four corners of larger polygons.
    FirstQuad,
    /// Loses polygons with more than four corners.
    LargeLost,
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum Negative {
    #[default]
    Right,
    /// The sign is lost.
    Positive,
    FacesLost,
    /// Counts from the end of the whole file.
    FromEnd,
    /// `list[index - 1]` in a language whose lists count negative numbers from the end.
    OneTooFar,
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum From {
    #[default]
    Own,
    /// By the index of the position.
    Position,
    /// From the face's first corner.
    FirstCorner,
    /// Computed from the triangle (only for normals).
    Geometry,
    Constant([f32; 3]),
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Which {
    First,
    Last,
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum Order {
    #[default]
    Right,
    /// `v`, `vt`, `vn` combined in the order of the file.
    FacesIgnored,
    /// Each distinct corner once.
    EachOnce,
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum Axes {
    #[default]
    Right,
    SwappedYz,
    /// (x, z, -y).
    ZUp,
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum Numbers {
    #[default]
    Right,
    Truncated,
    /// A stream that expects a comma stops at the first point of a line.
    StoppedAtPoint,
}

/// A corner as a reader produces it; `None` for a value that is read beyond the end of a list, which may be anything.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Corner {
    pub(super) position: Option<[f32; 3]>,
    pub(super) tex_coord: Option<[f32; 2]>,
    pub(super) normal: Option<[f32; 3]>,
}

/// A triangle as a reader produces it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Triangle {
    pub(super) corners: [Corner; 3],
    /// Its index in [`ObjLines::faces`]; `None` if the reader ignores faces.
    pub(super) face: Option<usize>,
}

/// The target of a slot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum AttributeSlot {
    Empty,
    /// Beyond the end of a list.
    Nowhere,
    At(usize),
}

impl Reader {
    /// The triangles that this reader produces from a file.
    pub(super) fn read(&self, source: &ObjLines) -> Vec<Triangle> {
        if self.order == Order::FacesIgnored {
            return self.faces_ignored(source);
        }
        let mut faces: Vec<(usize, Vec<[AttributeSlot; 3]>)> = self
            .faces(source)
            .map(|(number, face)| {
                (number, face.corners.iter().map(|slots| self.targets(source, face, slots)).collect())
            })
            .collect();
        if let Some(which) = self.unsplit {
            unsplit(&mut faces, source.positions.len(), which);
        }
        match (self.order, self.polygons) {
            (Order::EachOnce, _) => self.each_once(source, &faces),
            (_, Polygons::Stream) => self.stream(source, &faces),
            _ => self.triangles(source, &faces),
        }
    }

    fn faces<'a>(&self, source: &'a ObjLines) -> impl Iterator<Item = (usize, &'a Face)> {
        let this = self.clone();
        let object = match self.objects {
            None => None,
            Some(Which::First) => source.faces.first().map(|face| face.object),
            Some(Which::Last) => source.faces.last().map(|face| face.object),
        };
        let count = source.faces.len() - usize::from(self.loses_last_face && !source.faces.is_empty());
        let faces = source.faces.iter().enumerate().take(count).skip(usize::from(self.skips_first));
        faces.filter(move |(_, face)| {
            let corners = &face.corners;
            object.is_none_or(|object| object == face.object)
                && !(this.polygons == Polygons::Lost && corners.len() != 3)
                && !(this.polygons == Polygons::LargeLost && corners.len() > 4)
                && !(this.loses_partial && corners.iter().flatten().any(Option::is_none))
                && !(this.negative == Negative::FacesLost && corners.iter().flatten().flatten().any(|index| *index < 0))
        })
    }

    fn targets(&self, source: &ObjLines, face: &Face, slots: &Slots) -> [AttributeSlot; 3] {
        let [v, vt, vn] = *slots;
        let slots = match self.slots {
            SlotUse::Right => [v, vt, vn],
            SlotUse::Swapped => [v, vn, vt],
            SlotUse::EmptyPassedOver => [v, vt.or(vn), vn.filter(|_| vt.is_some())],
        };
        std::array::from_fn(|kind| {
            slots[kind].map_or(AttributeSlot::Empty, |index| self.target(source, face, kind, index))
        })
    }

    fn target(&self, source: &ObjLines, face: &Face, kind: usize, index: i64) -> AttributeSlot {
        let total = [source.positions.len(), source.tex_coords.len(), source.normals.len()][kind];
        let index = if self.negative == Negative::Positive { index.saturating_abs() } else { index };
        let before = match self.negative {
            Negative::Right => face.before[kind] as i64,
            _ => total as i64,
        };
        let place = if index < 0 {
            before.saturating_add(index).saturating_sub(i64::from(self.negative == Negative::OneTooFar))
        } else {
            let start = if self.anew { source.start_of(face.object)[kind] as i64 } else { 0 };
            let shift = start + i64::from(self.from_zero[kind]) + i64::from(self.skips_first) - 1;
            index.saturating_add(shift)
        };
        usize::try_from(place).ok().filter(|place| *place < total).map_or(AttributeSlot::Nowhere, AttributeSlot::At)
    }

    fn corner(&self, source: &ObjLines, targets: &[AttributeSlot; 3], first: &[AttributeSlot; 3]) -> Corner {
        let position = match targets[0] {
            AttributeSlot::At(place) => source.positions.get(place).map(|p| self.turn(self.cut(*p))),
            _ => None,
        };
        let tex_coord = match self.chosen(self.tex_coord, 1, targets, first) {
            Ok(target) => follow(target, &source.tex_coords).map(|t| self.map(self.cut(t))),
            Err([u, v, _]) => Some([u, v]),
        };
        let normal = match self.chosen(self.normal, 2, targets, first) {
            Ok(target) => follow(target, &source.normals).map(|n| self.turn(unit(self.cut(n)))),
            Err(normal) => Some(normal),
        };
        Corner { position, tex_coord, normal }
    }

    fn chosen(
        &self,
        from: From,
        kind: usize,
        targets: &[AttributeSlot; 3],
        first: &[AttributeSlot; 3],
    ) -> Result<AttributeSlot, [f32; 3]> {
        match from {
            From::Own => Ok(targets[kind]),
            From::Position => Ok(targets[0]),
            From::FirstCorner => Ok(first[kind]),
            From::Geometry => Err([0.0; 3]),
            From::Constant(value) => Err(value),
        }
    }

    fn cut<const N: usize>(&self, values: [f32; N]) -> [f32; N] {
        match self.numbers {
            Numbers::Right => values,
            Numbers::Truncated => values.map(f32::trunc),
            Numbers::StoppedAtPoint => std::array::from_fn(|i| if i == 0 { values[0].trunc() } else { 0.0 }),
        }
    }

    fn map(&self, [u, v]: [f32; 2]) -> [f32; 2] {
        let [u, v] = if self.swap_uv { [v, u] } else { [u, v] };
        if self.flip_v { [u, 1.0 - v] } else { [u, v] }
    }

    fn turn(&self, [x, y, z]: [f32; 3]) -> [f32; 3] {
        match self.axes {
            Axes::Right => [x, y, z],
            Axes::SwappedYz => [x, z, y],
            Axes::ZUp => [x, z, -y],
        }
    }

    fn triangle(&self, mut corners: [Corner; 3], face: Option<usize>) -> Triangle {
        if self.turned_over {
            corners.swap(1, 2);
        }
        if self.normal == From::Geometry {
            let normal = match corners.map(|corner| corner.position.map(glam::Vec3::from)) {
                [Some(a), Some(b), Some(c)] => Some(unit((b - a).cross(c - a).into())),
                _ => None,
            };
            corners.iter_mut().for_each(|corner| corner.normal = normal);
        }
        Triangle { corners, face }
    }

    fn triangles(&self, source: &ObjLines, faces: &[(usize, Vec<[AttributeSlot; 3]>)]) -> Vec<Triangle> {
        let mut triangles = Vec::new();
        for (number, targets) in faces {
            let corners: Vec<Corner> = targets.iter().map(|corner| self.corner(source, corner, &targets[0])).collect();
            let n = corners.len();
            let fan = |n: usize| (1..n - 1).map(|i| [0, i, i + 1]).collect::<Vec<_>>();
            let face = &source.faces[*number];
            let cut = match self.polygons {
                Polygons::Fan => fan(n),
                Polygons::FirstTriangle => fan(3),
                Polygons::FirstQuad => fan(n.min(4)),
                _ if self.other_diagonals && face.is_convex => (0..n - 2).map(|i| [n - 1, i, i + 1]).collect(),
                _ => face.cut.clone(),
            };
            triangles.extend(cut.iter().map(|triangle| self.triangle(triangle.map(|i| corners[i]), Some(*number))));
        }
        triangles
    }

    fn stream(&self, source: &ObjLines, faces: &[(usize, Vec<[AttributeSlot; 3]>)]) -> Vec<Triangle> {
        let corners: Vec<(usize, Corner)> = faces
            .iter()
            .flat_map(|(number, targets)| {
                targets.iter().map(move |corner| (*number, self.corner(source, corner, &targets[0])))
            })
            .collect();
        let triangles = corners.as_chunks::<3>().0.iter();
        triangles.map(|triangle| self.triangle(triangle.map(|(_, corner)| corner), Some(triangle[0].0))).collect()
    }

    fn each_once(&self, source: &ObjLines, faces: &[(usize, Vec<[AttributeSlot; 3]>)]) -> Vec<Triangle> {
        let mut seen = std::collections::HashSet::new();
        let corners = faces.iter().flat_map(|(_, targets)| targets.iter().map(move |corner| (corner, &targets[0])));
        let unseen = corners.filter(|(corner, _)| seen.insert(**corner));
        let vertices: Vec<Corner> = unseen.map(|(corner, first)| self.corner(source, corner, first)).collect();
        vertices.as_chunks::<3>().0.iter().map(|corners| self.triangle(*corners, None)).collect()
    }

    fn faces_ignored(&self, source: &ObjLines) -> Vec<Triangle> {
        let vertex = |i: usize| {
            let at = |count: usize| if i < count { AttributeSlot::At(i) } else { AttributeSlot::Nowhere };
            let targets = [AttributeSlot::At(i), at(source.tex_coords.len()), at(source.normals.len())];
            self.corner(source, &targets, &targets)
        };
        let vertices: Vec<Corner> = (usize::from(self.skips_first)..source.positions.len()).map(vertex).collect();
        vertices.as_chunks::<3>().0.iter().map(|corners| self.triangle(*corners, None)).collect()
    }
}

/// The value of a slot: zero if it is empty, `None` if it is out of range.
fn follow<const N: usize>(target: AttributeSlot, values: &[[f32; N]]) -> Option<[f32; N]> {
    match target {
        AttributeSlot::Empty => Some([0.0; N]),
        AttributeSlot::Nowhere => None,
        AttributeSlot::At(place) => values.get(place).copied(),
    }
}

/// Gives each position the texture coordinate and normal of one of its corners.
fn unsplit(faces: &mut [(usize, Vec<[AttributeSlot; 3]>)], positions: usize, which: Which) {
    let mut kept: Vec<Option<[AttributeSlot; 3]>> = vec![None; positions];
    for corner in faces.iter().flat_map(|(_, corners)| corners) {
        if let AttributeSlot::At(place) = corner[0]
            && let Some(kept) = kept.get_mut(place)
        {
            if which == Which::Last {
                *kept = Some(*corner);
            } else {
                kept.get_or_insert(*corner);
            }
        }
    }
    for corner in faces.iter_mut().flat_map(|(_, corners)| corners) {
        if let AttributeSlot::At(place) = corner[0]
            && let Some(Some(kept)) = kept.get(place)
        {
            *corner = *kept;
        }
    }
}
