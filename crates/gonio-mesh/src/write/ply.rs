//! Writes a model as PLY.

use super::text::{Text, plain_name};
use super::{ImageFile, counted, image_files, texture_path};
use crate::{Diagnostic, Material, Mesh, Model, TextureMap};
use gonio_light::color::srgb_encode;

/// The encoding of numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PlyEncoding {
    /// `binary_little_endian`
    #[default]
    Binary,
    /// `ascii`
    Ascii,
}

/// The files of a written model.
#[derive(Clone, Debug, Default)]
pub struct PlyFiles {
    /// The PLY file.
    pub ply: Vec<u8>,
    /// Images inside the model that it refers to, to be written beside it.
    pub images: Vec<ImageFile>,
    /// The properties that were lost.
    pub diagnostics: Vec<Diagnostic>,
}

/// Writes a model; names of images written beside it begin with `stem`.
///
/// Vertices have `x y z`, and if present `nx ny nz`, `s t` and `red green blue alpha`: bytes, encoded as sRGB, which
/// every reader supports. Faces are `list uchar int vertex_indices`. Textures are written as MeshLab does it: `comment
/// TextureFile NAME`, and if there are several, `texnumber` for each face.
///
/// Other properties of materials are lost, and so are names of parts, smoothing groups, tangents, lights and cameras.
pub fn write(model: &Model, stem: &str, encoding: PlyEncoding) -> PlyFiles {
    let mesh = &model.mesh;
    let images = image_files(model, stem);
    let textures = Textures::of_model(model);
    let mut diagnostics = Vec::new();
    let mut text = Text::default();
    write_header(mesh, &textures, &images, encoding, &mut text, &mut diagnostics);
    // Up to 36 bytes for a vertex, 14 for a face; about twice that as text.
    let factor = if encoding == PlyEncoding::Ascii { 2 } else { 1 };
    text.bytes.reserve(factor * (36 * mesh.positions.len() + 14 * mesh.triangle_count()));
    let mut writer = Writer { encoding, text };
    for i in 0..mesh.positions.len() {
        writer.vertex(mesh, i);
    }
    let texture_of_triangle = textures.of_triangles(mesh);
    for (t, triangle) in mesh.indices.chunks_exact(3).enumerate() {
        writer.face(triangle, texture_of_triangle.get(t).copied());
    }
    let used: Vec<ImageFile> =
        images.into_iter().filter(|file| textures.maps.iter().any(|m| m.embedded == Some(file.image))).collect();
    report_lost(model, &textures, &mut diagnostics);
    PlyFiles { ply: writer.text.bytes, images: used, diagnostics }
}

/// The textures that the file refers to: those of the diffuse colour.
struct Textures<'a> {
    maps: Vec<&'a TextureMap>,
    /// For each material.
    number_of: Vec<Option<usize>>,
}

impl<'a> Textures<'a> {
    fn of_model(model: &'a Model) -> Self {
        let is_used = |index: usize| model.mesh.parts.iter().any(|part| part.material == index);
        let mut textures = Textures { maps: Vec::new(), number_of: Vec::new() };
        for (index, material) in model.materials.iter().enumerate() {
            let map = material.diffuse_map.as_ref().filter(|_| is_used(index) && !model.mesh.tex_coords.is_empty());
            let number = map.map(|map| {
                let same = |known: &&TextureMap| (&known.path, known.embedded) == (&map.path, map.embedded);
                textures.maps.iter().position(same).unwrap_or_else(|| {
                    textures.maps.push(map);
                    textures.maps.len() - 1
                })
            });
            textures.number_of.push(number);
        }
        textures
    }

    /// Returns the texture of each triangle, if it must be written.
    fn of_triangles(&self, mesh: &Mesh) -> Vec<i32> {
        if self.maps.len() < 2 {
            return Vec::new();
        }
        let mut numbers = vec![-1; mesh.triangle_count()];
        for part in &mesh.parts {
            let number = self.number_of.get(part.material).copied().flatten().map_or(-1, |number| number as i32);
            let end = part.first_triangle.saturating_add(part.triangle_count).min(numbers.len());
            if let Some(of_part) = numbers.get_mut(part.first_triangle..end) {
                of_part.fill(number);
            }
        }
        numbers
    }
}

fn write_header(
    mesh: &Mesh,
    textures: &Textures<'_>,
    images: &[ImageFile],
    encoding: PlyEncoding,
    text: &mut Text,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let format = if encoding == PlyEncoding::Ascii { "ascii" } else { "binary_little_endian" };
    text.push(&format!("ply\nformat {format} 1.0\ncomment gonio\n"));
    for map in &textures.maps {
        let path = texture_path(map, images);
        let plain = plain_name(path);
        if plain != path {
            let path = crate::text::quote(path.as_bytes());
            diagnostics
                .push(Diagnostic::warning(format!("the texture {path} cannot be named in PLY: change its name")));
        }
        text.named("comment TextureFile", &plain);
    }
    text.push(&format!("element vertex {}\n", mesh.positions.len()));
    let mut properties = |kind: &str, names: &[&str]| {
        names.iter().for_each(|name| text.push(&format!("property {kind} {name}\n")));
    };
    properties("float", &["x", "y", "z"]);
    if !mesh.normals.is_empty() {
        properties("float", &["nx", "ny", "nz"]);
    }
    if !mesh.tex_coords.is_empty() {
        properties("float", &["s", "t"]);
    }
    if !mesh.colors.is_empty() {
        properties("uchar", &["red", "green", "blue", "alpha"]);
    }
    // Most readers support `int`, and need no more.
    let index = if i32::try_from(mesh.positions.len()).is_ok() { "int" } else { "uint" };
    text.push(&format!("element face {}\nproperty list uchar {index} vertex_indices\n", mesh.triangle_count()));
    if textures.maps.len() > 1 {
        text.push("property int texnumber\n");
    }
    text.push("end_header\n");
}

/// Writes numbers in one of the encodings.
struct Writer {
    encoding: PlyEncoding,
    text: Text,
}

impl Writer {
    fn vertex(&mut self, mesh: &Mesh, i: usize) {
        self.floats(&mesh.positions[i]);
        if let Some(normal) = mesh.normals.get(i) {
            self.floats(normal);
        }
        if let Some(tex_coord) = mesh.tex_coords.get(i) {
            self.floats(tex_coord);
        }
        if let Some(&color) = mesh.colors.get(i) {
            for byte in bytes_of_color(color) {
                match self.encoding {
                    PlyEncoding::Binary => self.text.byte(byte),
                    PlyEncoding::Ascii => self.integer(byte.into()),
                }
            }
        }
        self.end();
    }

    fn face(&mut self, triangle: &[u32], texture: Option<i32>) {
        match self.encoding {
            PlyEncoding::Binary => {
                self.text.byte(triangle.len() as u8);
                triangle.iter().for_each(|index| self.text.bytes.extend(index.to_le_bytes()));
                self.text.bytes.extend(texture.iter().flat_map(|texture| texture.to_le_bytes()));
            }
            PlyEncoding::Ascii => {
                self.integer(triangle.len() as i64);
                triangle.iter().for_each(|&index| self.integer(index.into()));
                texture.iter().for_each(|&texture| self.integer(texture.into()));
            }
        }
        self.end();
    }

    fn floats(&mut self, values: &[f32]) {
        match self.encoding {
            PlyEncoding::Binary => values.iter().for_each(|value| self.text.bytes.extend(value.to_le_bytes())),
            PlyEncoding::Ascii => {
                for &value in values {
                    self.blank();
                    self.text.number(value);
                }
            }
        }
    }

    /// Separates numbers on one line.
    fn blank(&mut self) {
        if self.text.bytes.last() != Some(&b'\n') {
            self.text.byte(b' ');
        }
    }

    fn integer(&mut self, value: i64) {
        self.blank();
        if value < 0 {
            self.text.byte(b'-');
        }
        self.text.integer(value.unsigned_abs());
    }

    fn end(&mut self) {
        if self.encoding == PlyEncoding::Ascii {
            self.text.byte(b'\n');
        }
    }
}

fn bytes_of_color([r, g, b, a]: [f32; 4]) -> [u8; 4] {
    let [r, g, b] = [r, g, b].map(|c| srgb_encode(c.into()));
    // Conversion to a byte saturates.
    [r, g, b, f64::from(a)].map(|c| (c * 255.0).round() as u8)
}

fn report_lost(model: &Model, textures: &Textures<'_>, diagnostics: &mut Vec<Diagnostic>) {
    let mut lose = |message: String| diagnostics.push(Diagnostic::warning(message));
    let mesh = &model.mesh;
    let says_more = |material: &Material| {
        let whole = Material::default();
        let known = Material {
            name: material.name.clone(),
            diffuse: material.diffuse,
            diffuse_map: material.diffuse_map.clone(),
            sources: material.sources.clone(),
            file: material.file.clone(),
            ..whole.clone()
        };
        let is_placed = |map: &TextureMap| {
            let TextureMap { path, embedded, line, .. } = map.clone();
            *map != TextureMap { embedded, line, ..TextureMap::new(path) }
        };
        let is_plain = material.diffuse == [1.0; 3] || material.diffuse == whole.diffuse && known.diffuse_map.is_none();
        *material != known || !is_plain || material.diffuse_map.as_ref().is_some_and(is_placed)
    };
    let materials = model.materials.iter().filter(|material| says_more(material)).count();
    if materials > 0 {
        lose(format!("of {} only the diffuse texture is written: PLY has no more", counted(materials, "material")));
    }
    let is_bare = |part: &crate::Part| textures.number_of.get(part.material).copied().flatten().is_none();
    let some_without = mesh.parts.iter().any(is_bare);
    if !textures.maps.is_empty() && some_without {
        lose("some parts have no texture: readers of PLY may show them with one".to_owned());
    }
    let parts = mesh.parts.iter().filter(|part| !part.name.is_empty()).count();
    if parts > 0 {
        lose(format!("{} not written: PLY has none", counted(parts, "name") + " of parts"));
    }
    for (count, what) in [(model.lights.len(), "light"), (model.cameras.len(), "camera")] {
        if count > 0 {
            lose(format!("{} not written: PLY has none", counted(count, what)));
        }
    }
    if !mesh.smoothing_groups.is_empty() && mesh.normals.is_empty() {
        lose("smoothing groups are not written: PLY has none".to_owned());
    }
    if mesh.colors.iter().any(|&color| !is_of_bytes(color)) {
        diagnostics.push(Diagnostic::note("vertex colors are rounded to 8 bits"));
    }
}

/// Whether a byte represents each channel, except for the rounding of the encoding.
fn is_of_bytes(color: [f32; 4]) -> bool {
    let [r, g, b, a] = color;
    let encoded = [srgb_encode(r.into()), srgb_encode(g.into()), srgb_encode(b.into()), f64::from(a)];
    let is_in_range = color.iter().all(|c| (0.0..=1.0).contains(c));
    is_in_range && encoded.iter().all(|c| (c * 255.0 - (c * 255.0).round()).abs() < 1e-3)
}
