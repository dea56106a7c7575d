//! PLY, the Stanford Triangle Format (G. Turk, 1994, "The PLY Polygon File Format", version 1.0), ASCII and binary in
//! both byte orders, with the additions of MeshLab, Blender and others.
//!
//! | in the file | in the model |
//! |---|---|
//! | `vertex`: `x y z` | positions |
//! | `nx ny nz` | normals, made unit length |
//! | `s t`, `u v`, `texture_u texture_v` | texture coordinates, v up |
//! | `red green blue alpha` (or `r g b a`, `diffuse_red`...) | vertex colours |
//! | `face`: `vertex_indices` or `vertex_index` | polygons, cut into triangles |
//! | `texcoord`: a list of two numbers for each corner | texture coordinates of corners (before those of vertices) |
//! | `texnumber` | which of the `comment TextureFile` names; -1: none |
//! | `red green blue alpha` of a face | colours of its corners, where vertices have none |
//! | `tristrips`: `vertex_indices` with -1 between strips | triangles |
//! | `comment TextureFile NAME` | a material with that `diffuse_map` |
//!
//! Colours are interpreted as sRGB, integers from 0 to the largest of their type (`int`: to 255), floats from 0 to 1,
//! as by Blender (whose default this is for reading and writing), MeshLab and three.js; alpha is linear. Everything
//! else is skipped and listed in [`Model::contents`].

mod build;
mod faces;
mod header;
mod number_reader;
mod scalar;
mod vertices;

use crate::diagnostic::Reports;
use crate::encoding::read_as_utf8;
use crate::{Diagnostic, Limits, Material, Model, PropertySource as Origin, ReadError, Sidecars, TextureMap};
use faces::{Faces, Role};
use header::{Element, Encoding, Header};
use number_reader::{AsciiReader, BinaryReader, NumberReader, explain, skip_property};
use vertices::{VertexLayout, Vertices};

/// Reads a PLY file. It refers to no other files but textures.
///
/// Warnings: faces with an out-of-range vertex index, fewer than three corners or a corner that is not finite (left
/// out), more numbers on a line than the header declares, bytes after the last element. Errors: an invalid header, no
/// `x y z`, a number that cannot be read, an early end, no triangles (a point cloud), more data than `limits` allow.
pub fn read(bytes: &[u8], sidecars: &mut dyn Sidecars, limits: &Limits) -> Result<Model, ReadError> {
    let _ = sidecars;
    read_as_utf8(bytes, |bytes| read_utf8(bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes), limits))
}

/// Reads a file whose header is UTF-8, and whose body is too unless the header declares another encoding.
fn read_utf8(bytes: &[u8], limits: &Limits) -> Result<Model, ReadError> {
    let mut reports = Reports::default();
    let header = Header::parse(bytes, &mut reports)?;
    let at = header.end;
    let body = match header.encoding {
        Encoding::Ascii => Body::read(AsciiReader::new(bytes, at, header.end_line), &header, limits, &mut reports)?,
        Encoding::LittleEndian => Body::read(BinaryReader::new(bytes, at, false), &header, limits, &mut reports)?,
        Encoding::BigEndian => Body::read(BinaryReader::new(bytes, at, true), &header, limits, &mut reports)?,
    };
    let Some(vertices) = body.vertices else {
        return Err(ReadError::new("has no vertex element: nothing to draw"));
    };
    let vertex_count = vertices.positions.len();
    if body.faces.declared == 0 {
        let points = if vertex_count == 1 { "point" } else { "points" };
        return Err(ReadError::new(format!("contains {vertex_count} {points} but no faces: nothing to draw")));
    }
    body.faces.report(vertex_count as u64, &mut reports);
    let corner_counts = corner_counts(&body.faces);
    let has_colors = !vertices.colors.is_empty() || !body.faces.colors.is_empty();
    let mesh = build::mesh(vertices, &body.faces, header.textures.len(), limits, &mut reports)?;
    if mesh.indices.is_empty() {
        return Err(nothing_to_draw(vertex_count, body.faces.declared, &reports));
    }
    if !header.textures.is_empty() && mesh.tex_coords.is_empty() {
        let message = "the file names a texture, but it has no texture coordinates";
        reports.warning(header.textures[0].1, message);
    }
    let contents = contents(&header, body.stepped_over, &corner_counts, &mut reports);
    let mut materials = materials(&header, has_colors);
    if mesh.parts.iter().any(|part| part.material == materials.len()) {
        // Faces with a texnumber of -1.
        materials.push(Material::default());
    }
    Ok(Model { mesh, materials, contents, diagnostics: reports.finish(), ..Model::default() })
}

/// The elements after the header.
#[derive(Default)]
struct Body {
    vertices: Option<Vertices>,
    faces: Faces,
    /// Names such as `edge` and `vertex.quality`, with their counts.
    stepped_over: Vec<(String, u64)>,
}

impl Body {
    fn read<S: NumberReader>(
        mut source: S,
        header: &Header,
        limits: &Limits,
        reports: &mut Reports,
    ) -> Result<Body, ReadError> {
        let vertex_count = header.elements.iter().find(|e| e.name == "vertex").map_or(0, |e| e.count);
        let mut body = Body::default();
        for (i, element) in header.elements.iter().enumerate() {
            check_count(&source, element, header.encoding)?;
            let is_first = header.elements[..i].iter().all(|other| other.name != element.name);
            match element.name.as_str() {
                "vertex" if is_first => {
                    let layout = VertexLayout::of_element(element);
                    body.list_unread(element, |property| layout.reads(property));
                    body.vertices = Some(vertices::read(&mut source, element, &layout, limits, reports)?);
                }
                "face" if is_first && body.faces.declared == 0 => {
                    let roles = Role::all_of(element);
                    body.list_unread(element, |property| roles[property] != Role::Unused);
                    body.faces = faces::read(&mut source, element, &roles, vertex_count)?;
                }
                "tristrips" if is_first && body.faces.declared == 0 => {
                    body.faces = faces::read_strips(&mut source, element, vertex_count)?;
                }
                _ => {
                    body.stepped_over.push((element.name.clone(), element.count));
                    step_over(&mut source, element)?;
                }
            }
        }
        source.finish(reports);
        Ok(body)
    }

    fn list_unread(&mut self, element: &Element, reads: impl Fn(usize) -> bool) {
        for (i, property) in element.properties.iter().enumerate() {
            if !reads(i) {
                self.stepped_over.push((format!("{}.{}", element.name, property.name), element.count));
            }
        }
    }
}

/// Checks the size before anything is allocated for elements that cannot exist.
fn check_count(source: &impl NumberReader, element: &Element, encoding: Encoding) -> Result<(), ReadError> {
    let least = element.least_size(encoding) as u64;
    let possible = (source.left() as u64).checked_div(least).unwrap_or(u64::MAX);
    if element.count <= possible {
        return Ok(());
    }
    let (name, count) = (&element.name, element.count);
    let message = format!("the file ends early: its header declares {count} {name} elements");
    Err(ReadError::new(format!("{message}, but at most {possible} fit in the remaining bytes; get it again")))
}

fn step_over(source: &mut impl NumberReader, element: &Element) -> Result<(), ReadError> {
    if element.properties.is_empty() {
        return Ok(());
    }
    for index in 0..element.count {
        source.begin();
        for property in &element.properties {
            skip_property(source, property).map_err(|e| explain(e, source, element, index, property))?;
        }
        source.end();
    }
    Ok(())
}

#[cold]
fn nothing_to_draw(vertices: usize, faces: u64, reports: &Reports) -> ReadError {
    let reason = reports.first().map(|first| format!("; {}", first.message)).unwrap_or_default();
    ReadError::new(format!("contains no triangles (vertices: {vertices}, faces: {faces}): nothing to draw{reason}"))
}

/// Counts the polygons with 3 corners, 4, and 5 or more.
fn corner_counts(faces: &Faces) -> [u64; 3] {
    let mut counts = [0; 3];
    let mut first = 0;
    for &end in &faces.ends {
        counts[(end - std::mem::replace(&mut first, end)).clamp(3, 5) - 3] += 1;
    }
    counts
}

fn contents(
    header: &Header,
    stepped_over: Vec<(String, u64)>,
    corner_counts: &[u64; 3],
    reports: &mut Reports,
) -> Vec<(String, u64)> {
    let mut contents: Vec<(String, u64)> = header.elements.iter().map(|e| (e.name.clone(), e.count)).collect();
    let of_corners = ["polygons of 3 corners", "polygons of 4 corners", "polygons of 5 or more corners"];
    contents.extend(of_corners.into_iter().zip(*corner_counts).map(|(what, count)| (what.to_owned(), count)));
    contents.extend([("comment".to_owned(), header.comments), ("obj_info".to_owned(), header.obj_infos)]);
    contents.retain(|(_, count)| *count > 0);
    if !stepped_over.is_empty() {
        let names: Vec<&str> = stepped_over.iter().take(20).map(|(name, _)| name.as_str()).collect();
        let more = if stepped_over.len() > names.len() { " and more" } else { "" };
        reports.push(u64::MAX, Diagnostic::note(format!("skipped: {}{more}", names.join(", "))));
        contents.extend(stepped_over.into_iter().map(|(name, count)| (format!("{name} (skipped)"), count)));
    }
    contents
}

/// Returns a material for each texture; without textures the default material, white if there are colours.
fn materials(header: &Header, has_colors: bool) -> Vec<Material> {
    let source = |property, line, written: &str, rule: &str| Origin {
        property,
        line,
        written: written.to_owned(),
        rule: rule.to_owned(),
    };
    if !header.textures.is_empty() {
        let of_texture = |(name, line): &(String, u64)| Material {
            name: name.clone(),
            diffuse: [1.0; 3],
            diffuse_map: Some(TextureMap { line: Some(*line), ..TextureMap::new(name.as_str()) }),
            sources: vec![
                source("diffuse", None, "", "white beside a texture"),
                source("diffuse_map", Some(*line), &format!("comment TextureFile {name}"), ""),
            ],
            ..Material::default()
        };
        return header.textures.iter().map(of_texture).collect();
    }
    if has_colors {
        let sources = vec![source("diffuse", None, "", "white beside vertex colors")];
        return vec![Material { diffuse: [1.0; 3], sources, ..Material::default() }];
    }
    vec![Material::default()]
}
