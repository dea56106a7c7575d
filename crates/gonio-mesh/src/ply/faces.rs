//! The elements `face` and `tristrips`: polygons as lists of vertices.

use super::header::{Element, Property};
use super::number_reader::{ListProblem, NumberReader, explain, list_length, skip_property};
use super::scalar::Scalar;
use super::vertices::{LinearFromSrgb, color_slot};
use crate::diagnostic::{Reports, Tally};
use crate::polygon::MOST_CORNERS;
use crate::{ReadError, Severity};

/// A `texnumber` that means no texture.
pub(super) const NO_TEXTURE: i64 = -1;

/// Polygons, one after the other, with valid vertex indices.
#[derive(Default)]
pub(super) struct Faces {
    /// The number of faces that the file declares.
    pub(super) declared: u64,
    pub(super) corners: Vec<u32>,
    /// The end of each face in `corners`.
    pub(super) ends: Vec<usize>,
    /// For each corner, or empty.
    pub(super) tex_coords: Vec<[f32; 2]>,
    /// The texture of each face, or [`NO_TEXTURE`]; or empty.
    pub(super) textures: Vec<i64>,
    /// The linear colour of each face, or empty.
    pub(super) colors: Vec<[f32; 4]>,
    /// Faces with invalid vertex indices, which are left out.
    pub(super) astray: Tally,
    too_short: Tally,
    bad_tex_coords: Tally,
    colors_not_finite: Tally,
}

/// The meaning of a property of a face.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    Corners,
    TexCoords,
    Texture,
    Color(usize),
    Unused,
}

impl Role {
    /// Returns the role of each property; the first of a name counts.
    pub(super) fn all_of(element: &Element) -> Vec<Role> {
        let mut roles: Vec<Role> = Vec::with_capacity(element.properties.len());
        for property in &element.properties {
            let role = match (property.name.as_str(), property.count.is_some()) {
                ("vertex_indices" | "vertex_index", true) => Role::Corners,
                ("texcoord" | "texcoords", true) => Role::TexCoords,
                ("texnumber", false) => Role::Texture,
                (name, false) => color_slot(name).map_or(Role::Unused, Role::Color),
                _ => Role::Unused,
            };
            roles.push(if roles.contains(&role) { Role::Unused } else { role });
        }
        let has_color = (0..3).all(|channel| roles.contains(&Role::Color(channel)));
        let drop_halves = |role| if matches!(role, Role::Color(_)) && !has_color { Role::Unused } else { role };
        roles.into_iter().map(drop_halves).collect()
    }
}

/// The face that is being read.
#[derive(Default)]
struct Face {
    corners: Vec<f64>,
    tex_coords: Vec<f32>,
    texture: f64,
    color: [f32; 4],
}

/// Reads the element `face`. Faces with invalid vertex indices are left out.
pub(super) fn read(
    source: &mut impl NumberReader,
    element: &Element,
    roles: &[Role],
    vertex_count: u64,
) -> Result<Faces, ReadError> {
    if !roles.contains(&Role::Corners) && element.count > 0 {
        let message = "the faces have no list vertex_indices (or vertex_index): nothing to draw";
        return Err(ReadError::new(message));
    }
    let has = |role| roles.contains(&role);
    let (has_tex_coords, has_texture, has_color) = (has(Role::TexCoords), has(Role::Texture), has(Role::Color(0)));
    let linear = LinearFromSrgb::new();
    let mut faces = Faces { declared: element.count, ..Faces::default() };
    // A face takes more bytes than this.
    faces.ends.reserve((element.count as usize).min(source.left() / 4));
    let mut face = Face::default();
    for index in 0..element.count {
        source.begin();
        face.color = [0.0, 0.0, 0.0, 1.0];
        for (property, &role) in element.properties.iter().zip(roles) {
            face.property(source, property, role).map_err(|e| explain(e, source, element, index, property))?;
        }
        source.end();
        let line = source.line();
        if !faces.add(&face.corners, vertex_count, line, "face", index) {
            continue;
        }
        if has_tex_coords {
            faces.add_tex_coords(&face, line, index);
        }
        if has_texture {
            faces.textures.push(if face.texture.fract() == 0.0 { face.texture as i64 } else { i64::MAX });
        }
        if has_color {
            if !face.color.iter().all(|c| c.is_finite()) {
                faces.colors_not_finite.add(line, || format!("face {index}"));
            }
            faces.colors.push(linear.rgba(face.color.map(|c| if c.is_finite() { c } else { 0.0 })));
        }
    }
    Ok(faces)
}

impl Face {
    #[inline]
    fn property(&mut self, source: &mut impl NumberReader, property: &Property, role: Role) -> Result<(), ListProblem> {
        match (role, property.count) {
            (Role::Corners, Some(count)) => numbers(source, property, count, MOST_CORNERS as u64, &mut self.corners),
            (Role::TexCoords, Some(count)) => {
                self.tex_coords.clear();
                for _ in 0..list_length(source, count)? {
                    self.tex_coords.push(source.coordinate(property.value)?);
                }
                Ok(())
            }
            (Role::Texture, None) => {
                self.texture = source.number(property.value)?;
                Ok(())
            }
            (Role::Color(channel), None) => {
                self.color[channel] = source.coordinate(property.value)? / property.value.white() as f32;
                Ok(())
            }
            _ => skip_property(source, property),
        }
    }
}

#[inline]
fn numbers(
    source: &mut impl NumberReader,
    property: &Property,
    count: Scalar,
    most: u64,
    numbers: &mut Vec<f64>,
) -> Result<(), ListProblem> {
    numbers.clear();
    let length = list_length(source, count)?;
    if length > most {
        return Err(ListProblem::TooManyCorners);
    }
    for _ in 0..length {
        numbers.push(source.number(property.value)?);
    }
    Ok(())
}

impl Faces {
    /// Adds a polygon if all its vertices exist.
    #[inline]
    fn add(&mut self, corners: &[f64], vertex_count: u64, line: Option<u64>, what: &str, index: u64) -> bool {
        if corners.len() < 3 {
            self.too_short.add(line, || format!("{what} {index}"));
            return false;
        }
        let is_there = |&corner: &f64| corner >= 0.0 && corner < vertex_count as f64 && corner.fract() == 0.0;
        if let Some(astray) = corners.iter().find(|corner| !is_there(corner)) {
            self.astray.add(line, || format!("{what} {index} at vertex {astray}"));
            return false;
        }
        self.corners.extend(corners.iter().map(|&corner| corner as u32));
        self.ends.push(self.corners.len());
        true
    }

    fn add_tex_coords(&mut self, face: &Face, line: Option<u64>, index: u64) {
        let fits = face.tex_coords.len() == 2 * face.corners.len() && face.tex_coords.iter().all(|c| c.is_finite());
        if fits {
            self.tex_coords.extend(face.tex_coords.chunks_exact(2).map(|pair| [pair[0], pair[1]]));
        } else {
            self.bad_tex_coords.add(line, || format!("face {index}"));
            self.tex_coords.resize(self.corners.len(), [0.0; 2]);
        }
    }

    /// Reports oddities.
    pub(super) fn report(&self, vertex_count: u64, reports: &mut Reports) {
        self.astray.report(Severity::Warning, reports, |tally| {
            let (faces, first) = (tally.counted("polygon points", "polygons point"), &tally.first);
            format!("{faces} at missing vertices (the first is {first} of {vertex_count}): left out")
        });
        self.too_short.report(Severity::Warning, reports, |tally| {
            let faces = tally.counted("polygon has", "polygons have");
            format!("{faces} fewer than 3 corners (the first is {}): left out", tally.first)
        });
        self.colors_not_finite.report(Severity::Warning, reports, |tally| {
            let faces = tally.counted("face has", "faces have");
            format!("{faces} a color that is not finite (the first is {}): using 0 instead", tally.first)
        });
        self.bad_tex_coords.report(Severity::Warning, reports, |tally| {
            let (faces, first) = (tally.counted("face lacks", "faces lack"), &tally.first);
            format!("{faces} two finite texture coordinates for each corner (the first is {first}): using (0, 0)")
        });
    }
}

/// Reads the element `tristrips`: strips of triangles with alternating winding, separated by -1.
pub(super) fn read_strips(
    source: &mut impl NumberReader,
    element: &Element,
    vertex_count: u64,
) -> Result<Faces, ReadError> {
    let mut faces = Faces::default();
    let mut strip = Vec::new();
    let roles = Role::all_of(element);
    for index in 0..element.count {
        source.begin();
        for (property, &role) in element.properties.iter().zip(&roles) {
            let done = match (role, property.count) {
                (Role::Corners, Some(count)) => numbers(source, property, count, u64::MAX, &mut strip),
                _ => skip_property(source, property),
            };
            done.map_err(|e| explain(e, source, element, index, property))?;
        }
        source.end();
        for strip in strip.split(|&vertex| vertex == -1.0) {
            for (i, triangle) in strip.windows(3).enumerate() {
                let [a, b, c] = [triangle[0], triangle[1], triangle[2]];
                // A repeated vertex turns a strip around a corner: such triangles have no area.
                if a == b || b == c || a == c {
                    continue;
                }
                faces.declared += 1;
                let turned = if i % 2 == 0 { [a, b, c] } else { [b, a, c] };
                faces.add(&turned, vertex_count, source.line(), "strip", index);
            }
        }
        strip.clear();
    }
    Ok(faces)
}
