//! Writes a model as Wavefront OBJ with its material library.

use super::text::{Text, plain_name};
use super::{Distinct, ImageFile, counted, image_files, mtl};
use crate::{Diagnostic, Material, Mesh, Model, Part};
use gonio_light::color::srgb_encode;

/// The files of a written model.
#[derive(Clone, Debug, Default)]
pub struct ObjFiles {
    /// The OBJ file.
    pub obj: Vec<u8>,
    /// Its material library; empty if it needs none (then the OBJ file refers to none).
    pub mtl: Vec<u8>,
    /// The name of the library in the OBJ file: the requested one, without characters that OBJ cannot store in a name.
    pub mtl_name: String,
    /// Images inside the model that its materials use, to be written beside it.
    pub images: Vec<ImageFile>,
    /// The properties that were lost.
    pub diagnostics: Vec<Diagnostic>,
}

/// Writes a model; `mtl_name` is the file name of its library.
///
/// - Equal positions, texture coordinates and normals are written once, in the order of the vertices; triangles in
///   their order, as `f`. Reading it again gives the same mesh bit by bit, except for normals, which are normalized
///   again, and colours.
/// - Vertex colours follow the coordinates of `v`, encoded as sRGB, as Blender and MeshLab read them. Their alpha is
///   lost, and values above 1 are clamped.
/// - Each part is an `o` with `usemtl`; smoothing groups are `s`.
/// - A material without a name is called `default`; duplicate names get a number. If only the default material is used,
///   no material is written.
/// - Lights, cameras, tangents are lost.
pub fn write(model: &Model, mtl_name: &str) -> ObjFiles {
    let mut diagnostics = Vec::new();
    let mtl_name = plain_name(mtl_name);
    let stem = mtl_name.strip_suffix(".mtl").unwrap_or(&mtl_name);
    let images = image_files(model, stem);
    let names = material_names(model, &mut diagnostics);
    let mut library = Text::default();
    for (material, name) in model.materials.iter().zip(&names) {
        if let Some(name) = name {
            if library.bytes.is_empty() {
                library.push("# gonio\n");
            }
            mtl::write(material, name, &images, &mut library, &mut diagnostics);
        }
    }
    let mut text = Text::default();
    text.push("# gonio\n");
    if !library.bytes.is_empty() {
        text.named("mtllib", &mtl_name);
    }
    let mesh = &model.mesh;
    // A position takes about 30 bytes, a triangle about 50.
    text.bytes.reserve(60 * mesh.positions.len() + 50 * mesh.triangle_count());
    let numbers = write_vertices(mesh, &mut text);
    write_parts(mesh, &names, &numbers, &mut text, &mut diagnostics);
    report_lost(model, &mut diagnostics);
    ObjFiles { obj: text.bytes, mtl: library.bytes, mtl_name, images, diagnostics }
}

/// Returns a unique name for each material; `None` if it needs none.
fn material_names(model: &Model, diagnostics: &mut Vec<Diagnostic>) -> Vec<Option<String>> {
    let nameless = |material: &Material| {
        material.name.is_empty() && *material == Material { sources: material.sources.clone(), ..Material::default() }
    };
    let is_used = |index: usize| model.mesh.parts.iter().any(|part| part.material == index);
    let needs_none = model.materials.iter().enumerate().all(|(index, material)| nameless(material) || !is_used(index));
    let mut taken = std::collections::HashSet::new();
    let mut names = Vec::new();
    for material in &model.materials {
        if nameless(material) && needs_none {
            names.push(None);
            continue;
        }
        let plain = plain_name(&material.name);
        let base = if plain.is_empty() { "default".to_owned() } else { plain };
        let mut name = base.clone();
        let mut number = 1;
        while !taken.insert(name.clone()) {
            number += 1;
            name = format!("{base}.{number}");
        }
        if name != material.name && !material.name.is_empty() {
            let old = crate::text::quote(material.name.as_bytes());
            diagnostics.push(Diagnostic::note(format!("the material {old} is written as {name}")));
        }
        names.push(Some(name));
    }
    names
}

/// The numbers by which faces refer to attributes.
struct Numbers {
    positions: Vec<u32>,
    tex_coords: Vec<u32>,
    normals: Vec<u32>,
}

fn write_vertices(mesh: &Mesh, text: &mut Text) -> Numbers {
    let count = mesh.positions.len();
    let positions = if mesh.colors.is_empty() {
        let positions = Distinct::from_values(count, |i| mesh.positions[i]);
        positions.indices().for_each(|i| text.statement("v", &mesh.positions[i]));
        positions
    } else {
        let colored = |i: usize| {
            let ([x, y, z], [r, g, b, _]) = (mesh.positions[i], mesh.colors[i]);
            [x, y, z, r, g, b]
        };
        let positions = Distinct::from_values(count, colored);
        for i in positions.indices() {
            let [x, y, z, r, g, b] = colored(i);
            let [r, g, b] = [r, g, b].map(|c| srgb_encode(c.into()) as f32);
            text.statement("v", &[x, y, z, r, g, b]);
        }
        positions
    };
    let tex_coords = Distinct::from_values(mesh.tex_coords.len(), |i| mesh.tex_coords[i]);
    tex_coords.indices().for_each(|i| text.statement("vt", &mesh.tex_coords[i]));
    let normals = Distinct::from_values(mesh.normals.len(), |i| mesh.normals[i]);
    normals.indices().for_each(|i| text.statement("vn", &mesh.normals[i]));
    Numbers { positions: positions.number_of, tex_coords: tex_coords.number_of, normals: normals.number_of }
}

fn write_parts(
    mesh: &Mesh,
    names: &[Option<String>],
    numbers: &Numbers,
    text: &mut Text,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let whole = [Part { triangle_count: mesh.triangle_count(), ..Part::default() }];
    let parts = if mesh.parts.is_empty() { &whole[..] } else { &mesh.parts };
    let (mut name, mut material, mut group) = ("", None, None);
    let mut renamed = 0;
    for part in parts {
        if part.name != name {
            let plain = plain_name(&part.name);
            renamed += usize::from(plain != part.name);
            text.named("o", &plain);
            name = &part.name;
        }
        let own = names.get(part.material).and_then(Option::as_deref);
        if let Some(own) = own
            && material != Some(own)
        {
            text.named("usemtl", own);
            material = Some(own);
        }
        for t in part.first_triangle..part.first_triangle + part.triangle_count {
            let own = mesh.smoothing_groups.get(t).copied();
            if own != group {
                text.push("s ");
                match own {
                    Some(0) | None => text.push("off"),
                    Some(number) => text.integer(number.into()),
                }
                text.byte(b'\n');
                group = own;
            }
            if let Some(corners) = mesh.indices.get(3 * t..3 * t + 3) {
                write_face(corners, numbers, text);
            }
        }
    }
    if renamed > 0 {
        let what = format!("{} with line ends, comments or blanks around them", counted(renamed, "name"));
        diagnostics.push(Diagnostic::note(format!("{what} were changed: OBJ cannot hold them")));
    }
}

fn write_face(corners: &[u32], numbers: &Numbers, text: &mut Text) {
    text.byte(b'f');
    for &vertex in corners {
        let number = |numbers: &[u32]| numbers.get(vertex as usize).map(|&number| u64::from(number) + 1);
        text.byte(b' ');
        text.integer(number(&numbers.positions).unwrap_or(0));
        let (tex_coord, normal) = (number(&numbers.tex_coords), number(&numbers.normals));
        if tex_coord.is_some() || normal.is_some() {
            text.byte(b'/');
        }
        if let Some(tex_coord) = tex_coord {
            text.integer(tex_coord);
        }
        if let Some(normal) = normal {
            text.byte(b'/');
            text.integer(normal);
        }
    }
    text.byte(b'\n');
}

fn report_lost(model: &Model, diagnostics: &mut Vec<Diagnostic>) {
    let mut lose = |message: String| diagnostics.push(Diagnostic::warning(message));
    for (count, what) in [(model.lights.len(), "light"), (model.cameras.len(), "camera")] {
        if count > 0 {
            lose(format!("{} not written: OBJ has none", counted(count, what)));
        }
    }
    let colors = &model.mesh.colors;
    if colors.iter().any(|color| color[3] != 1.0) {
        lose("the alpha of vertex colors is not written: OBJ has none".to_owned());
    }
    if colors.iter().flat_map(|color| &color[..3]).any(|c| !(0.0..=1.0).contains(c)) {
        lose("vertex colors outside 0 to 1 are clamped: OBJ has none".to_owned());
    }
}
