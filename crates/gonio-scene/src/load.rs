//! From a scene file to a complete scene.

use crate::assemble::assemble;
use crate::asset_cache::{self, AssetCache, CachedMesh, CachedModel, MaterialSource};
use crate::environment_file;
use crate::files::{self, Budgeted, FileSource};
use crate::framing::{self, BoundingSphere};
use crate::material_binding::MaterialBinder;
use crate::model_file::{self, ModelFile};
use crate::model_scene;
use crate::scene::{Scene, SceneMaterial};
use crate::scene_file::{MaterialOverride, Normals, ObjectSpec, SceneFile};
use crate::settings::{EnvironmentSettings, EquationSettings, LightSettings, SceneSettings};
use crate::validate;
use glam::{DMat4, DQuat, DVec3};
use gonio_light::{Fresnel, Optics};
use gonio_mesh::normals::Averaging;
use gonio_mesh::{Cause, Diagnostic, Limits, Material, Mesh, ReadError, normals, topology};
use rayon::prelude::*;
use std::path::{Path, PathBuf};
use std::sync::Arc;

pub use crate::describe::describe;

/// A model's mesh with one choice of normals.
struct PreparedMesh {
    mesh: Mesh,
    closed: bool,
}

/// Reads the files of `scene`, relative to `base`, and fills in every default.
///
/// A scene without lights gets those of its models' files; otherwise a default three-point rig.
pub fn load(scene: SceneFile, base: &Path, files: &dyn FileSource) -> Result<Scene, ReadError> {
    load_within(scene, base, files, &Limits::default())
}

/// [`load`], with other limits on what the files may make it allocate: `limits.max_bytes` are for all of them together.
pub fn load_within(
    mut scene: SceneFile,
    base: &Path,
    files: &dyn FileSource,
    limits: &Limits,
) -> Result<Scene, ReadError> {
    validate::check(&scene)?;
    let files = &Budgeted::new(files, limits.max_bytes);

    // Each file once.
    let mut paths: Vec<(PathBuf, String)> = Vec::new();
    let mut model_of_object = Vec::with_capacity(scene.objects.len());
    for object in &scene.objects {
        let path = files::resolve(base, &object.model);
        let index = paths.iter().position(|(known, _)| *known == path).unwrap_or(paths.len());
        if index == paths.len() {
            let name = if object.model.starts_with(files::BUILTIN) {
                object.model.clone()
            } else {
                path.display().to_string()
            };
            paths.push((path, name));
        }
        model_of_object.push(index);
    }
    let (models, environment) = rayon::join(
        || -> Result<Vec<ModelFile>, ReadError> {
            paths.into_par_iter().map(|(path, name)| model_file::read_within(&path, &name, files, limits)).collect()
        },
        || scene.environment.as_ref().map(|spec| environment_file::load(spec, base, files)).transpose(),
    );
    let (mut models, environment) = (models?, environment?);

    let mut diagnostics = Vec::new();
    let mut binder = MaterialBinder::new(files, files.budget());
    let mut first_material = Vec::with_capacity(scene.objects.len());
    let used: Vec<Vec<bool>> = models.iter().map(|file| asset_cache::used_materials(&file.model)).collect();
    let folders: Vec<Vec<PathBuf>> = models.iter().map(ModelFile::texture_folders).collect();
    for (object, &m) in scene.objects.iter().zip(&model_of_object) {
        let source = MaterialSource::of_file(&models[m], &folders[m], &used[m]);
        first_material.push(binder.add(m, &object.material, &source));
    }
    for model in &mut models {
        diagnostics.append(&mut model.model.diagnostics);
    }

    // The needed (model, normals), each once.
    let mut wanted: Vec<(usize, NormalChoice)> = Vec::new();
    let mut prepared_of_object = Vec::with_capacity(scene.objects.len());
    for (object, &m) in scene.objects.iter().zip(&model_of_object) {
        let key = (m, NormalChoice::for_object(object));
        let index = wanted.iter().position(|k| *k == key).unwrap_or(wanted.len());
        if index == wanted.len() {
            wanted.push(key);
        }
        prepared_of_object.push(index);
    }
    // The last user of a model's mesh takes it; others get copies.
    let mut meshes = Vec::with_capacity(wanted.len());
    for (i, (m, _)) in wanted.iter().enumerate() {
        let mesh = &mut models[*m].model.mesh;
        let wanted_again = wanted[i + 1..].iter().any(|(other, _)| other == m);
        meshes.push(if wanted_again { mesh.clone() } else { std::mem::take(mesh) });
    }
    let (bound, prepared) = rayon::join(
        || binder.finish(),
        || {
            meshes
                .into_par_iter()
                .zip(&wanted)
                .map(|(mesh, &(_, normals))| prepare(mesh, normals))
                .collect::<Vec<(PreparedMesh, Vec<Diagnostic>)>>()
        },
    );
    diagnostics.extend(bound.diagnostics);
    let mut meshes = Vec::with_capacity(prepared.len());
    for ((mesh, mut found), &(model, normals)) in prepared.into_iter().zip(&wanted) {
        found.iter_mut().for_each(|d| *d = d.clone().in_file(&models[model].name));
        diagnostics.append(&mut found);
        let plain = Some(Arc::new(mesh.mesh));
        meshes.push(CachedMesh { model, normals, closed: mesh.closed, plain, with_tangents: None });
    }
    let of_models = models.iter_mut().zip(used).map(|(file, used)| CachedModel::of_file(file, used)).collect();
    let mut cache =
        AssetCache { base: base.to_owned(), models: of_models, meshes, textures: bound.cache, environment: None };
    for (spec, &m) in scene.objects.iter_mut().zip(&model_of_object) {
        if spec.name.is_empty() {
            spec.name = cache.models[m].object_name();
        }
    }

    let mut loaded = Scene { materials: bound.materials, textures: bound.textures, ..Scene::default() };
    assemble(&mut loaded, &scene.objects, &mut cache.meshes, &prepared_of_object, &first_material, &mut diagnostics);
    model_scene::take_camera(&mut scene, &models, &model_of_object)?;
    model_scene::take_lights(&mut scene, &models, &model_of_object, loaded.bounds(), &mut diagnostics);
    if let Some(mut read) = environment {
        diagnostics.append(&mut read.diagnostics);
        if let Some(spec) = &mut scene.environment {
            (spec.layout, spec.size) = (read.layout, read.size);
        }
        loaded.environment = Some(Arc::new(read.environment));
    } else if loaded.materials.iter().any(|m| !m.optics.is_plain()) {
        diagnostics.push(lacks_surroundings());
    }
    loaded.camera_was_framed = scene.camera.position.is_none();
    loaded.settings = complete(scene, &loaded);
    cache.environment = loaded.settings.environment.clone().zip(loaded.environment.clone());
    loaded.cache = Arc::new(cache);
    loaded.diagnostics = diagnostics;
    Ok(loaded)
}

/// The mesh with normals of its own, from the file or made; and whether it is closed.
fn prepare(mesh: Mesh, choice: NormalChoice) -> (PreparedMesh, Vec<Diagnostic>) {
    let closed = topology::is_closed_outward(&mesh);
    let (mesh, diagnostics) = with_normals(mesh, choice);
    (PreparedMesh { mesh, closed }, diagnostics)
}

/// The normals of a mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct NormalChoice {
    normals: Normals,
    crease_angle_rad: Option<f64>,
}

impl NormalChoice {
    pub fn for_object(object: &ObjectSpec) -> Self {
        // Flat normals have no creases to speak of.
        let crease_angle = object.crease_angle.filter(|_| object.normals != Normals::Flat);
        NormalChoice { normals: object.normals, crease_angle_rad: crease_angle.map(f64::to_radians) }
    }
}

/// The mesh with normals of its own, from the file or made.
pub(crate) fn with_normals(mesh: Mesh, choice: NormalChoice) -> (Mesh, Vec<Diagnostic>) {
    let averaging = Averaging { crease_angle_rad: choice.crease_angle_rad };
    match choice.normals {
        Normals::File => normals::complete_with(mesh, &averaging),
        Normals::Flat => (normals::make_flat(&mesh), Vec::new()),
        Normals::Averaged => normals::make_averaged_with(&mesh, &averaging),
    }
}

/// The warning about mirrors and glass without an environment.
pub(crate) fn lacks_surroundings() -> Diagnostic {
    Diagnostic::warning(
        "mirrors and glass show their surroundings, and the scene has none: they look like any surface; add an \
         [environment] to the scene file",
    )
    .caused_by(Cause::NoEnvironment)
}

/// The settings of a scene file whose objects are read.
fn complete(file: SceneFile, scene: &Scene) -> SceneSettings {
    let SceneFile { picture, camera, background, environment, equation, objects, lights } = file;
    let (min, max) = scene.bounds();
    let around = BoundingSphere::new(min, max);
    let aspect = f64::from(picture.width) / f64::from(picture.height);
    let camera = framing::complete_camera(&camera, around, scene, aspect);
    let environment = environment.map(|spec| EnvironmentSettings::new(spec, lights.is_empty()));
    let equation = EquationSettings::from(equation);
    let lights = if lights.is_empty() && !environment.as_ref().is_some_and(|e| e.light) {
        framing::three_point_lights(&camera.to_camera(), around, &equation)
    } else {
        lights.into_iter().map(LightSettings::from).collect()
    };
    SceneSettings { picture, camera, background, environment, equation, objects, lights }
}

/// `M = T * Rz * Ry * Rx * S`: scaled, then turned about the world's x, y and z axes, then moved.
pub fn world_from_model(object: &ObjectSpec) -> DMat4 {
    let [x, y, z] = object.rotate.map(f64::to_radians);
    let rotation = DQuat::from_rotation_z(z) * DQuat::from_rotation_y(y) * DQuat::from_rotation_x(x);
    DMat4::from_scale_rotation_translation(object.scale.into(), rotation, object.translate.into())
}

/// The material of an object: the model's, with the values that the scene replaces.
pub(crate) fn overridden(mut material: Material, with: &MaterialOverride) -> Material {
    let rgb = |c: crate::color_value::Color| c.0.map(|v| v as f32);
    if with.textures == Some(false) {
        material.diffuse_map = None;
        material.specular_map = None;
        material.emitted_map = None;
        material.shininess_map = None;
        material.opacity_map = None;
        material.normal_map = None;
        material.bump_map = None;
        material.metallic_roughness = None;
    }
    if let Some(c) = with.ambient {
        material.ambient = gonio_mesh::AmbientRule::Value(rgb(c));
    }
    if let Some(c) = with.diffuse {
        (material.diffuse, material.diffuse_map) = (rgb(c), None);
    }
    if let Some(c) = with.specular {
        (material.specular, material.specular_map) = (rgb(c), None);
    }
    if let Some(c) = with.emitted {
        (material.emitted, material.emitted_map) = (rgb(c), None);
    }
    if let Some(v) = with.shininess {
        (material.shininess, material.shininess_map) = (v as f32, None);
    }
    if let Some(medium) = with.medium {
        material.refraction_index = medium.refraction_index() as f32;
    }
    if let Some(v) = with.refraction_index {
        material.refraction_index = v as f32;
    }
    if let Some(v) = with.opacity {
        (material.opacity, material.opacity_map) = (v as f32, None);
    }
    material
}

/// Reflection and refraction of an object. Only the scene file has them: model files have no keys for them.
pub(crate) fn optics_of(with: &MaterialOverride) -> Optics {
    let usual = Optics::default();
    let clear = with.medium.is_some();
    Optics {
        reflectivity: with.reflectivity.unwrap_or(usual.reflectivity),
        transmission: with.transmission.unwrap_or(if clear { 1.0 } else { usual.transmission }),
        fresnel: with.fresnel.unwrap_or(if clear { Fresnel::Exact } else { usual.fresnel }),
        tint: with.tint.map_or(usual.tint, DVec3::from),
        absorption: with.absorption.map_or(usual.absorption, DVec3::from),
        dispersion: with.dispersion.unwrap_or(usual.dispersion),
        surfaces: with.surfaces.unwrap_or(usual.surfaces),
    }
}

/// A material whose textures were all found, for tests and tools that build scenes by hand.
impl From<Material> for SceneMaterial {
    fn from(material: Material) -> Self {
        SceneMaterial { material, maps: crate::scene::Maps::default(), optics: Optics::default() }
    }
}
