//! glTF 2.0, `.gltf` and `.glb`, as Khronos defines it (2021, "glTF 2.0 Specification", ISO/IEC 12113:2022).
//!
//! - A mesh is in the model once for each node of the scene that shows it, in the scene's space. A part is a primitive,
//!   named after its node (or else after its mesh). Mirrored nodes have their winding reversed.
//! - Materials follow the rule of [`crate::MetallicRoughness`]. A primitive without a material gets the [default
//!   one](crate::Material), light clay: glTF's default, white metal without gloss, would not show the shape.
//! - An unlit material (`KHR_materials_unlit`) emits its base colour and reflects nothing.
//! - Alpha is applied according to `alphaMode`: ignored, compared with a cutoff, or used as opacity.
//! - A mesh has one set of texture coordinates: that of the material's first texture (base colour, then metalness and
//!   roughness, emission, normals). Textures on another set are left out with a warning.
//! - Skins, morph targets and animations: the model is shown in its bind pose, with a warning.
//! - Points and lines are counted, not drawn.
//!
//! Extensions: `KHR_lights_punctual`, `KHR_materials_emissive_strength`, `_ior`, `_pbrSpecularGlossiness`,
//! `_specular`, `_unlit`, `KHR_mesh_quantization`, `KHR_texture_transform`. Compressed geometry
//! (`KHR_draco_mesh_compression`, `EXT_meshopt_compression`) cannot be read.
//!
//! The JSON is read by hand rather than with the `gltf` crate, which rejects a whole file because of one wrong value in
//! a material, reports the line but not the path in the JSON, ignores unknown extensions, and panics in accessors that
//! leave their buffer. Tests compare with it.

mod accessor;
mod buffer;
mod json;
mod light;
mod material;
mod node;
mod primitive;
mod texture;
mod triangles;
mod uri;

use crate::diagnostic::Reports;
use crate::encoding::read_as_utf8;
use crate::{Cause, Diagnostic, Limits, Material, Model, ReadError, Severity, Sidecars};
use buffer::Buffers;
use glam::DMat4;
use json::JsonRef;
use material::ReadMaterial;
use node::PlacedNodes;
use primitive::{Geometry, MaterialUse, Placement};
use serde_json::Value;
use texture::Textures;

/// Reads a glTF file, JSON or binary; external buffers are requested from `sidecars`.
///
/// Errors, each with its path in the JSON or its byte: a file that is not glTF 2.0; a required extension that is not
/// supported; a buffer that is missing or too short; an accessor that leaves its buffer; a node with several parents; a
/// coordinate that is not finite; no triangles; more data than `limits` allow. Problems with materials, textures,
/// lights and cameras are warnings.
pub fn read(bytes: &[u8], sidecars: &mut dyn Sidecars, limits: &Limits) -> Result<Model, ReadError> {
    read_as_utf8(bytes, |bytes| read_utf8(bytes, sidecars, limits))
}

/// Reads a binary file, or a JSON document in UTF-8.
fn read_utf8(bytes: &[u8], sidecars: &mut dyn Sidecars, limits: &Limits) -> Result<Model, ReadError> {
    let mut reports = Reports::default();
    let container = buffer::open(bytes, &mut reports)?;
    let value: Value = serde_json::from_slice(container.json).map_err(|e| no_json(&e, container.is_binary))?;
    let root = JsonRef::root(&value);
    check_version(root)?;
    check(root, &mut reports)?;
    let mut buffers = Buffers::new(root, container.binary, sidecars);
    let mut textures = Textures::new(root, limits.max_bytes);
    let materials = materials(root, &mut textures, &mut buffers, &mut reports, limits)?;
    let places = node::place(root, &mut reports)?;
    let nodes = places.placed.len();
    let mut reader =
        Reader { root, buffers, reports, materials, places, default_material: None, model: Model::default() };
    let mut geometry = Geometry::new(limits);
    for place in 0..nodes {
        reader.node(place, &mut geometry)?;
    }
    if root.count("nodes") == 0 {
        reader.meshes_without_nodes(&mut geometry)?;
    }
    reader.report_motion();
    let Reader { buffers, mut reports, materials, mut model, .. } = reader;
    model.contents = contents(root, &geometry);
    let out_of_range = geometry.counts.out_of_range;
    model.mesh = geometry.finish(&mut reports);
    if model.mesh.indices.is_empty() {
        return Err(nothing_to_draw(root, nodes, out_of_range));
    }
    model.materials = materials.into_iter().map(|read| read.material).collect();
    model.images = textures.images;
    model.sidecars = buffers.uses;
    model.diagnostics = reports.finish();
    Ok(model)
}

#[cold]
fn no_json(error: &serde_json::Error, is_binary: bool) -> ReadError {
    let text = error.to_string();
    let what = text.split(" at line ").next().unwrap_or(&text);
    let whose = if is_binary { "the JSON in this binary glTF" } else { "this" };
    let hint = if error.is_eof() { ": the file is cut off" } else { "" };
    let message = format!("{whose} is not valid JSON: {what}{hint}");
    ReadError::new(message).at(error.line() as u64, Some(error.column() as u64))
}

fn version_1() -> ReadError {
    ReadError::new("this is glTF 1.0, which is not supported: convert it to glTF 2.0, for example with gltf-pipeline")
}

fn check_version(root: JsonRef<'_>) -> Result<(), ReadError> {
    let asset = root.get("asset");
    // Early glTF 1.0 files have a number.
    if asset.and_then(|asset| asset.get("version")?.value.as_f64()).is_some_and(|version| (0.0..2.0).contains(&version))
    {
        return Err(version_1());
    }
    let Some(version) = asset.map_or(Ok(None), |asset| asset.text("version"))? else {
        return Err(ReadError::new("this is not a glTF 2.0 file: its JSON has no asset.version"));
    };
    let newest_needed = asset.map_or(Ok(None), |asset| asset.text("minVersion"))?;
    let major = |version: &str| version.split('.').next().and_then(|major| major.parse::<u64>().ok());
    match (major(version), newest_needed) {
        (Some(1), _) => Err(version_1()),
        (Some(2), None | Some("2.0")) => Ok(()),
        _ => {
            let needed = newest_needed.unwrap_or(version);
            Err(ReadError::new(format!(
                "this file needs glTF {needed:?}, but only 2.0 is supported: export it as glTF 2.0"
            )))
        }
    }
}

/// All materials of the file, used or not.
fn materials<'v>(
    root: JsonRef<'v>,
    textures: &mut Textures<'v>,
    buffers: &mut Buffers<'v, '_>,
    reports: &mut Reports,
    limits: &Limits,
) -> Result<Vec<ReadMaterial>, ReadError> {
    // Two bytes of JSON are a material, whose diagnostics take about as much memory as the material itself.
    let bytes = 2 * (root.count("materials") as u64).saturating_mul(size_of::<ReadMaterial>() as u64);
    if bytes > limits.max_bytes {
        let (count, most) = (root.count("materials"), limits.max_bytes);
        let message = format!("its {count} materials take more than {most} bytes, which is the limit");
        return Err(ReadError::new(message).caused_by(Cause::MemoryLimit));
    }
    Ok(root.list("materials")?.map(|at| material::read(at, textures, buffers, reports)).collect())
}

/// The model while nodes are read.
struct Reader<'v, 's> {
    root: JsonRef<'v>,
    buffers: Buffers<'v, 's>,
    reports: Reports,
    materials: Vec<ReadMaterial>,
    places: PlacedNodes,
    default_material: Option<usize>,
    model: Model,
}

impl<'v> Reader<'v, '_> {
    fn node(&mut self, place: usize, geometry: &mut Geometry<'_>) -> Result<(), ReadError> {
        let root = self.root;
        let placed = &self.places.placed[place];
        let Some(at) = root.get("nodes").and_then(|nodes| nodes.item(placed.node)) else { return Ok(()) };
        self.model.lights.extend(light::at_node(root, at, &placed.model_from_node, &mut self.reports));
        self.model.cameras.extend(light::camera_at_node(root, at, &placed.model_from_node, &mut self.reports));
        let Some((_, mesh)) = at.target(root, "mesh", "meshes")? else { return Ok(()) };
        let model_from_mesh = match at.target(root, "skin", "skins")? {
            Some((_, skin)) => {
                node::model_from_mesh(root, skin, &self.places, &mut self.buffers)?.unwrap_or(placed.model_from_node)
            }
            None => placed.model_from_node,
        };
        if model_from_mesh.determinant() == 0.0 {
            let message = || format!("{} flattens its mesh: a scale is 0", at.title());
            self.reports.add_without_line("nodes that flatten their mesh", Severity::Warning, message);
        }
        let name = if at.name().is_empty() { mesh.name() } else { at.name() };
        self.mesh(mesh, name, model_from_mesh, geometry)
    }

    fn meshes_without_nodes(&mut self, geometry: &mut Geometry<'_>) -> Result<(), ReadError> {
        if self.root.count("meshes") > 0 {
            self.reports.push(0, Diagnostic::warning("has meshes but no nodes: each mesh is shown untransformed"));
        }
        for mesh in self.root.list("meshes")? {
            self.mesh(mesh, mesh.name(), DMat4::IDENTITY, geometry)?;
        }
        Ok(())
    }

    fn mesh(
        &mut self,
        mesh: JsonRef<'v>,
        name: &str,
        model_from_mesh: DMat4,
        geometry: &mut Geometry<'_>,
    ) -> Result<(), ReadError> {
        for primitive in mesh.list("primitives")? {
            let user = self.material_use(primitive)?;
            let placement = Placement { name, model_from_mesh, user };
            geometry.add(primitive, &placement, self.root, &mut self.buffers, &mut self.reports)?;
            if primitive.count("targets") > 0 {
                let message = || format!("{} has morph targets: its base shape is shown", mesh.title());
                self.reports.add_without_line("primitives with morph targets", Severity::Warning, message);
            }
        }
        Ok(())
    }

    fn material_use(&mut self, primitive: JsonRef<'v>) -> Result<MaterialUse, ReadError> {
        if let Some((index, _)) = primitive.target(self.root, "material", "materials")? {
            return Ok(self.materials[index].use_as(index));
        }
        let material = match self.default_material {
            Some(material) => material,
            None => {
                self.materials.push(ReadMaterial { material: Material::default(), tex_coord_set: None });
                let note = format!(
                    "{} has no material: using light clay (as for all primitives without one)",
                    primitive.path()
                );
                self.reports.push(0, Diagnostic::note(note));
                *self.default_material.insert(self.materials.len() - 1)
            }
        };
        Ok(MaterialUse { material, tex_coord_set: None })
    }

    fn report_motion(&mut self) {
        for (list, one, many) in [("skins", "skin", "skins"), ("animations", "animation", "animations")] {
            let count = self.root.count(list);
            if count > 0 {
                let what = if count == 1 { one } else { many };
                let message = format!("contains {count} {what}: the model is shown at rest, in its bind pose");
                self.reports.push(0, Diagnostic::warning(message));
            }
        }
    }
}

/// Counts objects under the file's own names.
fn contents(root: JsonRef<'_>, geometry: &Geometry<'_>) -> Vec<(String, u64)> {
    const LISTS: [&str; 14] = [
        "scenes",
        "nodes",
        "meshes",
        "materials",
        "textures",
        "images",
        "samplers",
        "accessors",
        "bufferViews",
        "buffers",
        "cameras",
        "skins",
        "animations",
        "extensionsUsed",
    ];
    let primitives = root.list("meshes").ok().into_iter().flatten().map(|mesh| mesh.count("primitives") as u64).sum();
    let mut contents: Vec<(String, u64)> =
        LISTS.iter().map(|list| ((*list).to_owned(), root.count(list) as u64)).collect();
    contents.insert(3, ("primitives".to_owned(), primitives));
    contents.push(("lights".to_owned(), light::count(root) as u64));
    contents.push(("primitives of points in the scene".to_owned(), geometry.counts.points));
    contents.push(("primitives of lines in the scene".to_owned(), geometry.counts.lines));
    contents.retain(|(_, count)| *count > 0);
    contents
}

#[cold]
fn nothing_to_draw(root: JsonRef<'_>, nodes: usize, out_of_range: u64) -> ReadError {
    let meshes = root.count("meshes");
    let reason =
        if out_of_range > 0 { format!("; {out_of_range} triangles have an index out of range") } else { String::new() };
    ReadError::new(format!(
        "contains no triangles (nodes in the scene: {nodes}, meshes: {meshes}): nothing to draw{reason}"
    ))
}

/// Extensions that are supported, or that do not affect a model at rest.
const UNDERSTOOD: &[&str] = &[
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_specular",
    "KHR_materials_unlit",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
    "KHR_xmp",
    "KHR_xmp_json_ld",
];

/// Unsupported extensions without which the shape is right, but not the appearance, and what is lost.
const SURVIVED: &[(&str, &str)] = &[
    ("KHR_animation_pointer", "animations are not played"),
    ("KHR_materials_variants", "each part has its first material"),
    ("KHR_technique_webgl", "its shaders are not run: the material is shown without them"),
    ("KHR_techniques_webgl", "its shaders are not run: the material is shown without them"),
    ("KHR_texture_basisu", "KTX2 images cannot be read"),
    ("EXT_texture_webp", "an image in another format is used instead, if there is one"),
    ("EXT_texture_avif", "an image in another format is used instead, if there is one"),
    ("MSFT_texture_dds", "an image in another format is used instead, if there is one"),
    ("KHR_node_visibility", "hidden nodes are shown"),
    ("EXT_lights_image_based", "its environment is not used"),
];

/// Unsupported extensions without which nothing is right, with advice.
const REFUSED: &[(&str, &str)] = &[
    ("KHR_draco_mesh_compression", "export it without Draco compression"),
    ("EXT_meshopt_compression", "export it without meshopt compression, or unpack it with gltf-transform"),
    ("KHR_meshopt_compression", "export it without meshopt compression, or unpack it with gltf-transform"),
    ("EXT_mesh_gpu_instancing", "export the copies as nodes of their own"),
];

/// Rejects a file that cannot be shown without an extension; warns about others.
fn check(root: JsonRef<'_>, reports: &mut Reports) -> Result<(), ReadError> {
    for at in root.list("extensionsRequired")? {
        let name = at.value.as_str().unwrap_or_default();
        if UNDERSTOOD.contains(&name) || lost_without(name).is_some() {
            continue;
        }
        let advice = find(REFUSED, name).unwrap_or("export it without that extension");
        return Err(ReadError::new(format!("needs the extension {name:?}, which is not supported: {advice}")));
    }
    let mut reported: Vec<&str> = Vec::new();
    for at in root.list("extensionsUsed")? {
        let name = at.value.as_str().unwrap_or_default();
        // Extensions of materials are reported where they are used.
        if UNDERSTOOD.contains(&name) || name.starts_with("KHR_materials_") && find(SURVIVED, name).is_none() {
            continue;
        }
        if reported.contains(&name) || reported.len() > 50 {
            continue;
        }
        reported.push(name);
        let lost = match (find(SURVIVED, name), find(REFUSED, name)) {
            (Some(lost), _) => lost,
            (None, Some(_)) => "the rest of the file is shown",
            (None, None) => "its data is ignored",
        };
        reports.push(0, Diagnostic::warning(format!("uses the extension {name:?}, which is not supported: {lost}")));
    }
    Ok(())
}

fn lost_without(name: &str) -> Option<&'static str> {
    let of_material = name.starts_with("KHR_materials_").then_some("the material is shown without it");
    find(SURVIVED, name).or(of_material)
}

fn find(list: &[(&str, &'static str)], name: &str) -> Option<&'static str> {
    list.iter().find(|(known, _)| *known == name).map(|(_, what)| *what)
}
