//! Joins pieces of a file in file order, so that the result is the same as for one piece.

use super::attributes::Attributes;
use super::triangles::Triangles;
use super::vertices::{Corner, CornerAttributes, Vertices};
use crate::ReadError;
use rayon::prelude::*;
use std::mem;

/// Joins the attributes of consecutive pieces, up to the first error.
pub(super) fn attributes(mut pieces: Vec<Attributes>) -> Attributes {
    let first_error = pieces.iter().position(|piece| piece.error.is_some());
    pieces.truncate(first_error.map_or(pieces.len(), |piece| piece + 1));
    if pieces.len() == 1
        && let Some(piece) = pieces.pop()
    {
        return piece;
    }
    let mut all = Attributes::default();
    let mut counts = [0; 3];
    for piece in &mut pieces {
        for mut segment in mem::take(&mut piece.segments) {
            segment.line += all.lines;
            (0..3).for_each(|kind| segment.counts[kind] += counts[kind]);
            all.segments.push(segment);
        }
        if !piece.colors.is_empty() {
            all.colors.resize(counts[0] as usize, [1.0; 3]);
            all.colors.append(&mut piece.colors);
        }
        let more = piece.counts();
        (0..3).for_each(|kind| counts[kind] += more[kind]);
        all.reports.append(mem::take(&mut piece.reports), all.lines);
        all.colored += piece.colored;
        all.weighted = all.weighted.or(piece.weighted.map(|line| all.lines + line));
        all.error =
            piece.error.take().map(|error| ReadError { line: error.line.map(|line| line + all.lines), ..error });
        all.lines += piece.lines;
    }
    // One kind after the other, so that little is in memory twice.
    all.positions = concatenate(pieces.iter_mut().map(|piece| mem::take(&mut piece.positions)).collect());
    all.tex_coords = concatenate(pieces.iter_mut().map(|piece| mem::take(&mut piece.tex_coords)).collect());
    all.normals = concatenate(pieces.iter_mut().map(|piece| mem::take(&mut piece.normals)).collect());
    all
}

fn concatenate<const N: usize>(parts: Vec<Vec<[f32; N]>>) -> Vec<[f32; N]> {
    let mut all = vec![[0.0; N]; parts.iter().map(Vec::len).sum()];
    let mut rest = all.as_mut_slice();
    let mut places = Vec::with_capacity(parts.len());
    for part in parts {
        let (place, behind) = rest.split_at_mut(part.len());
        places.push((place, part));
        rest = behind;
    }
    places.into_par_iter().for_each(|(place, part)| place.copy_from_slice(&part));
    all
}

/// Renumbers the vertices and triangles of consecutive ranges as if all their corners had been looked up in one table,
/// in order.
pub(super) fn vertices(stretches: &mut [(Vertices, Triangles<'_>)]) -> Result<Vertices, ReadError> {
    let Some(((first, _), rest)) = stretches.split_first_mut() else { return Ok(Vertices::new(0)) };
    let mut all = mem::take(first);
    let mut rest: Vec<Stretch<'_, '_>> = rest.iter_mut().map(Stretch::new).collect();
    let shared = first_attributes(&mut all, &mut rest);
    if rest.iter().all(|stretch| !stretch.differs && stretch.vertices.extras.corners.is_empty()) {
        return Ok(all);
    }
    rest.par_iter_mut().for_each(|stretch| stretch.find_extras(&all));
    let position_count = all.position_count();
    let mut vertices_of_extras = Vec::with_capacity(rest.len());
    for stretch in &mut rest {
        let numbers = mem::take(&mut stretch.found).into_iter().map(|corner| {
            let is_shared = shared[corner.0 as usize / 64] >> (corner.0 % 64) & 1 != 0;
            let extras = &mut all.extras;
            if is_shared { extras.number_of(corner, position_count) } else { extras.push(corner) }
        });
        vertices_of_extras.push(numbers.map(|number| position_count as u64 + u64::from(number)).collect::<Vec<u64>>());
    }
    if (position_count + all.extras.corners.len()) as u64 >= u64::from(u32::MAX) {
        return Err(crate::limits::too_many_vertices(u64::from(u32::MAX)));
    }
    rest.par_iter_mut().zip(&vertices_of_extras).for_each(|(stretch, vertices)| stretch.renumber(vertices));
    Ok(all)
}

/// Finds the first attributes of each position in file order. Returns the positions that several ranges use.
fn first_attributes(all: &mut Vertices, rest: &mut [Stretch<'_, '_>]) -> Vec<u64> {
    let mut shared = vec![0; all.position_count() / 64 + 1];
    for stretch in rest {
        for position in stretch.vertices.touched() {
            let kind = stretch.vertices.first(position);
            if !kind.is_used() {
                continue;
            }
            let known = all.first(position);
            if known.is_used() {
                shared[position / 64] |= 1 << (position % 64);
                stretch.differs |= known != kind;
            } else {
                all.set_first(position, kind);
            }
        }
    }
    shared
}

/// A range whose vertices are to be merged with those of the others.
struct Stretch<'a, 'b> {
    vertices: Vertices,
    triangles: &'a mut Triangles<'b>,
    /// Whether the first attributes of some position are not the first ones in the whole file.
    differs: bool,
    /// Its own extra vertices.
    extras: Vec<Corner>,
    /// Corners that are extra vertices of the whole file, in the order of first use.
    found: Vec<Corner>,
    /// For each of its extra vertices the index in `found`, or that it has the first attributes of its position.
    number_of_extra: Vec<ExtraIs>,
}

#[derive(Clone, Copy)]
enum ExtraIs {
    NotSeen,
    First,
    Found(u32),
}

impl<'a, 'b> Stretch<'a, 'b> {
    fn new((vertices, triangles): &'a mut (Vertices, Triangles<'b>)) -> Self {
        let vertices = mem::take(vertices);
        Stretch {
            vertices,
            triangles,
            differs: false,
            extras: Vec::new(),
            found: Vec::new(),
            number_of_extra: Vec::new(),
        }
    }

    /// Finds the corners that are extra vertices of the whole file, in order. First attributes that become an extra
    /// vertex are replaced by its index.
    fn find_extras(&mut self, all: &Vertices) {
        let position_count = self.vertices.position_count();
        let extras = mem::take(&mut self.vertices.extras).into_corners();
        if !self.differs {
            self.number_of_extra = (0..extras.len() as u32).map(ExtraIs::Found).collect();
            self.found = extras;
            return;
        }
        self.number_of_extra = vec![ExtraIs::NotSeen; extras.len()];
        for &mut index in self.triangles.vertices_mut() {
            let vertex = index as usize;
            if let Some(extra) = vertex.checked_sub(position_count) {
                if matches!(self.number_of_extra[extra], ExtraIs::NotSeen) {
                    let corner = extras[extra];
                    self.number_of_extra[extra] = if all.first(corner.0 as usize) == corner.1 {
                        ExtraIs::First
                    } else {
                        self.found.push(corner);
                        ExtraIs::Found(self.found.len() as u32 - 1)
                    };
                }
                continue;
            }
            let kind = self.vertices.first(vertex);
            if kind.is_used() && kind != all.first(vertex) {
                self.vertices.set_first(vertex, CornerAttributes::number(self.found.len() as u32));
                self.found.push((index, kind));
            }
        }
        self.extras = extras;
    }

    /// Renumbers the triangles for the whole file.
    fn renumber(&mut self, vertices_of_found: &[u64]) {
        let position_count = self.vertices.position_count();
        for index in self.triangles.vertices_mut() {
            let vertex = *index as usize;
            let place = match vertex.checked_sub(position_count) {
                Some(extra) => match self.number_of_extra[extra] {
                    ExtraIs::Found(place) => Some(place),
                    ExtraIs::First | ExtraIs::NotSeen => {
                        *index = self.extras[extra].0;
                        None
                    }
                },
                None if self.differs => self.vertices.first(vertex).as_number(),
                None => None,
            };
            if let Some(place) = place {
                *index = vertices_of_found[place as usize] as u32;
            }
        }
    }
}
