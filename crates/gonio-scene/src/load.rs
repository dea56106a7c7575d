//! From the inputs that a user names to a scene file, and from a scene file to a complete scene.

use crate::asset_cache::{AssetCache, CachedMesh, CachedModel, NormalChoice, with_normals};
use crate::environment_file;
use crate::files::{self, Budgeted, FileSource};
use crate::framing::{self, BoundingSphere};
use crate::input_kind::{self, InputKind};
use crate::material_binding::{MaterialBinder, MaterialSource, used_materials};
use crate::material_brdf::{self, BrdfLibrary};
use crate::model_file::{self, ModelFile};
use crate::model_scene;
use crate::part_material::NamedParts;
use crate::readers::Readers;
use crate::scene::{Object, ObjectPart, Scene, SceneMaterial, world_from_model};
use crate::scene_file::{ObjectSpec, SceneFile};
use crate::settings::{EnvironmentSettings, EquationSettings, LightSettings, SceneSettings};
use crate::toml_file;
use crate::toml_table::line_and_column;
use crate::validate;
use gonio_mesh::{Cause, Diagnostic, Limits, Mesh, ReadError, encoding, topology};
use gonio_threads::prelude::*;
use std::borrow::Cow;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Reads what `inputs` name: scene files (`.toml`), bare models, or `builtin:NAME` of either. The
/// models of a scene file are relative to its folder; in the result they are relative to the current
/// one, so that [`load`] is given an empty base.
///
/// Several inputs become one scene, with models in the coordinates of their files; the first scene file
/// determines picture, camera, background and equation. Of models, only the format is detected.
pub fn describe(inputs: &[&str], files: &dyn FileSource) -> Result<SceneFile, ReadError> {
    if inputs.is_empty() {
        return Err(ReadError::new("nothing to read: name a model, a scene file or builtin:suzanne"));
    }
    let mut whole = SceneFile::default();
    let mut has_settings = false;
    for &input in inputs {
        let (mut scene, is_scene_file) = describe_one(input, files).map_err(|e| e.in_file(input))?;
        whole.objects.append(&mut scene.objects);
        whole.lights.append(&mut scene.lights);
        if is_scene_file && !has_settings {
            has_settings = true;
            whole = SceneFile { objects: whole.objects, lights: whole.lights, ..scene };
        }
    }
    Ok(whole)
}

/// The scene of one input, and whether it came from a scene file.
fn describe_one(input: &str, files: &dyn FileSource) -> Result<(SceneFile, bool), ReadError> {
    let path = files::resolve(Path::new(""), input);
    let explain = |e: std::io::Error| {
        if e.kind() == std::io::ErrorKind::NotFound && environment_file::builtin_of(input).is_some() {
            let message = "this is a built-in environment, not a model; to surround a model by it, name it as the \
                           environment";
            return ReadError::new(message).caused_by(Cause::EnvironmentAsModel);
        }
        files::failed(&e)
    };
    let bytes = files::read(files, &path).map_err(explain)?;
    match input_kind::detect(&bytes, &path)? {
        InputKind::Model => {
            let object = ObjectSpec { model: input.to_owned(), ..ObjectSpec::default() };
            Ok((SceneFile { objects: vec![object], ..SceneFile::default() }, false))
        }
        InputKind::Scene => {
            let bytes = scene_text(&bytes)?;
            let text = std::str::from_utf8(&bytes).map_err(|e| not_utf8(&bytes, e.valid_up_to()))?;
            let mut scene = toml_file::read(text)?;
            let base = path.parent().unwrap_or(Path::new(""));
            for object in &mut scene.objects {
                if !object.model.starts_with(files::BUILTIN) {
                    object.model = files::resolve(base, &object.model).to_string_lossy().into_owned();
                }
                for file in object.materials_mut().filter_map(|material| material.brdf_file.as_mut()) {
                    *file = material_brdf::rebased(base, file);
                }
            }
            if let Some(environment) = &mut scene.environment {
                for image in std::iter::once(&mut environment.image).chain(&mut environment.background) {
                    *image = environment_file::rebased(base, image);
                }
            }
            Ok((scene, true))
        }
    }
}

/// The text of a scene file as UTF-8, without replacements.
fn scene_text(bytes: &[u8]) -> Result<Cow<'_, [u8]>, ReadError> {
    let text = encoding::to_utf8(bytes);
    match text.diagnostics.first() {
        Some(damage) => {
            let message = "a scene file must be UTF-8 or UTF-16 text, and this file is neither".to_owned();
            Err(ReadError { place: damage.place.clone(), ..ReadError::new(message) })
        }
        None => Ok(text.bytes),
    }
}

fn not_utf8(bytes: &[u8], valid: usize) -> ReadError {
    let (line, column) = line_and_column(&String::from_utf8_lossy(&bytes[..valid]), valid);
    ReadError::new("a scene file must be UTF-8 text, and this file is not").at(line, Some(column))
}

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
pub fn load_within(scene: SceneFile, base: &Path, files: &dyn FileSource, limits: &Limits) -> Result<Scene, ReadError> {
    validate::check(&scene)?;
    load_by(Readers::ALL, scene, base, files, limits)
}

/// [`load_within`] by these readers, for a `scene` whose numbers are valid.
pub fn load_by(
    readers: &Readers,
    mut scene: SceneFile,
    base: &Path,
    files: &dyn FileSource,
    limits: &Limits,
) -> Result<Scene, ReadError> {
    scene.objects.iter_mut().for_each(ObjectSpec::start_on_path);
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
    let (models, environment) = gonio_threads::join(
        || -> Result<Vec<ModelFile>, ReadError> {
            let read = |(path, name): (PathBuf, String)| model_file::read_by(readers, &path, &name, files, limits);
            paths.into_par_iter().map(read).collect()
        },
        || scene.environment.as_ref().map(|spec| (readers.environment)(spec, base, files)).transpose(),
    );
    let (mut models, environment) = (models?, environment?);

    let mut diagnostics = Vec::new();
    let mut brdfs = BrdfLibrary::default();
    for material in scene.objects.iter().flat_map(ObjectSpec::materials) {
        (readers.brdf)(&mut brdfs, material, base, files, &mut diagnostics)?;
    }
    let mut binder = MaterialBinder::new(files, files.budget(), readers.pictures, brdfs.clone());
    let mut materials_of_parts = Vec::with_capacity(scene.objects.len());
    let used: Vec<Vec<bool>> = models.iter().map(|file| used_materials(&file.model)).collect();
    let folders: Vec<Vec<PathBuf>> = models.iter().map(ModelFile::texture_folders).collect();
    for (object, &m) in scene.objects.iter().zip(&model_of_object) {
        let source = MaterialSource::of_file(&models[m], &folders[m], &used[m]);
        materials_of_parts.push(binder.add_object(
            m,
            object,
            &models[m].model.mesh.parts,
            &source,
            readers.own_material,
        ));
    }
    let of_object =
        |&m: &usize| NamedParts { parts: &models[m].model.mesh.parts, materials: &models[m].model.materials };
    let named: Vec<NamedParts<'_>> = model_of_object.iter().map(of_object).collect();
    diagnostics.extend((readers.unknown_parts)(&scene.objects, &named));
    for model in &mut models {
        diagnostics.append(&mut model.model.diagnostics);
    }

    // The needed (model, normals), each once.
    let mut needed: Vec<(usize, NormalChoice)> = Vec::new();
    let mut prepared_of_object = Vec::with_capacity(scene.objects.len());
    for (object, &m) in scene.objects.iter().zip(&model_of_object) {
        let key = (m, NormalChoice::for_object(object));
        let index = needed.iter().position(|k| *k == key).unwrap_or(needed.len());
        if index == needed.len() {
            needed.push(key);
        }
        prepared_of_object.push(index);
    }
    // The last user of a model's mesh takes it; others get copies.
    let mut meshes = Vec::with_capacity(needed.len());
    for (i, (m, _)) in needed.iter().enumerate() {
        let mesh = &mut models[*m].model.mesh;
        let needed_again = needed[i + 1..].iter().any(|(other, _)| other == m);
        meshes.push(if needed_again { mesh.clone() } else { std::mem::take(mesh) });
    }
    let (bound, prepared) = gonio_threads::join(
        || binder.finish(),
        || {
            meshes
                .into_par_iter()
                .zip(&needed)
                .map(|(mesh, &(_, normals))| prepare(mesh, normals))
                .collect::<Vec<(PreparedMesh, Vec<Diagnostic>)>>()
        },
    );
    diagnostics.extend(bound.diagnostics);
    let mut meshes = Vec::with_capacity(prepared.len());
    for ((mesh, mut found), &(model, normals)) in prepared.into_iter().zip(&needed) {
        found.iter_mut().for_each(|d| *d = d.clone().in_file(&models[model].name));
        diagnostics.append(&mut found);
        let plain = Some(Arc::new(mesh.mesh));
        meshes.push(CachedMesh { model, normals, closed: mesh.closed, plain, with_tangents: None });
    }
    let of_models = models.iter_mut().zip(used).map(|(file, used)| CachedModel::of_file(file, used)).collect();
    let (base, textures) = (base.to_owned(), bound.cache);
    let mut cache = AssetCache { base, models: of_models, meshes, textures, brdfs, environment: None };
    for (spec, &m) in scene.objects.iter_mut().zip(&model_of_object) {
        if spec.name.is_empty() {
            spec.name = cache.models[m].object_name();
        }
    }

    let mut loaded = Scene { materials: bound.materials, textures: bound.textures, ..Scene::default() };
    let (meshes, of_object) = (&mut cache.meshes, &prepared_of_object);
    assemble(&mut loaded, &scene.objects, meshes, of_object, &materials_of_parts, readers.tangents, &mut diagnostics);
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

/// Prepares a mesh: normals from the file or computed, and whether it is closed.
fn prepare(mesh: Mesh, choice: NormalChoice) -> (PreparedMesh, Vec<Diagnostic>) {
    let closed = topology::is_closed_outward(&mesh);
    let (mesh, diagnostics) = with_normals(mesh, choice);
    (PreparedMesh { mesh, closed }, diagnostics)
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
    let around = BoundingSphere::new(min, max, &objects);
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

/// Fills in `meshes` and `objects` of `loaded`, which has its materials: objects in the scene's order, with tangents
/// where a normal map or a BRDF needs them. `mesh_of_object` indexes `cache`, `materials_of_parts` the materials, for each part of
/// each object.
pub(crate) fn assemble(
    loaded: &mut Scene,
    specs: &[ObjectSpec],
    cache: &mut [CachedMesh],
    mesh_of_object: &[usize],
    materials_of_parts: &[Vec<usize>],
    with_tangents: fn(&Mesh) -> Option<Mesh>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    // Meshes of the cache, with or without tangents, each once.
    let mut needed: Vec<(usize, bool)> = Vec::new();
    let mut index_of_object = Vec::with_capacity(specs.len());
    for (&mesh, materials) in mesh_of_object.iter().zip(materials_of_parts) {
        let needs_tangents = |&material: &usize| {
            let has_direction = |m: &SceneMaterial| m.brdf.as_ref().is_some_and(|brdf| brdf.has_direction());
            loaded.materials.get(material).is_some_and(|m| m.maps.normal.is_some() || has_direction(m))
        };
        let parts = cache[mesh].any().map(|mesh| mesh.parts.as_slice()).unwrap_or_default();
        let mut drawn = parts.iter().zip(materials).filter(|(part, _)| part.triangle_count > 0);
        let tangents = drawn.any(|(_, material)| needs_tangents(material));
        let index = needed.iter().position(|key| *key == (mesh, tangents)).unwrap_or(needed.len());
        if index == needed.len() {
            needed.push((mesh, tangents));
        }
        index_of_object.push(index);
    }
    let lacking: Vec<usize> =
        needed.iter().filter(|(m, t)| *t && cache[*m].with_tangents.is_none()).map(|w| w.0).collect();
    let made: Vec<Option<Mesh>> =
        lacking.par_iter().map(|&m| cache[m].plain.as_ref().and_then(|mesh| with_tangents(mesh))).collect();
    for (&m, made) in lacking.iter().zip(made) {
        if let Some(mesh) = made {
            cache[m].with_tangents = Some(Arc::new(mesh));
            continue;
        }
        let object = mesh_of_object.iter().position(|mesh| *mesh == m).unwrap_or(0);
        let name = specs.get(object).map_or("", |object| object.model.as_str());
        let materials = materials_of_parts.get(object).map(Vec::as_slice).unwrap_or_default();
        let is_mapped =
            |&material: &usize| loaded.materials.get(material).is_some_and(|material| material.maps.normal.is_some());
        // A BRDF with a direction follows the vertical axis instead.
        if materials.iter().any(is_mapped) {
            let message = "the normal map is ignored: the mesh has no texture coordinates";
            diagnostics.push(Diagnostic::warning(message).in_file(name));
        }
    }
    for &(m, tangents) in &needed {
        let cached = &cache[m];
        let [first, second] =
            if tangents { [&cached.with_tangents, &cached.plain] } else { [&cached.plain, &cached.with_tangents] };
        loaded.meshes.push(first.as_ref().or(second.as_ref()).cloned().unwrap_or_default());
    }
    // A mesh with tangents can replace the one without, which is kept only while it is drawn.
    for (m, cached) in cache.iter_mut().enumerate() {
        if cached.with_tangents.is_some() && !needed.contains(&(m, false)) {
            cached.plain = None;
        }
    }
    let last_material = loaded.materials.len().saturating_sub(1);
    for (i, spec) in specs.iter().enumerate() {
        let mesh = &loaded.meshes[index_of_object[i]];
        let parts: Vec<ObjectPart> = mesh
            .parts
            .iter()
            .zip(&materials_of_parts[i])
            .map(|(part, &material)| ObjectPart {
                name: part.name.clone(),
                first_triangle: part.first_triangle,
                triangle_count: part.triangle_count,
                material: material.min(last_material),
            })
            .collect();
        let opaque = parts.iter().all(|p| !loaded.materials[p.material].is_transparent());
        loaded.objects.push(Object {
            name: spec.name.clone(),
            mesh: index_of_object[i],
            shading: spec.shading,
            world_from_model: world_from_model(spec),
            parts,
            closed: opaque && cache[mesh_of_object[i]].closed,
        });
    }
}
