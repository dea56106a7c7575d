//! A scene with edited settings, without reading its files again.
//!
//! A window edits the settings (a light is dragged, a colour is chosen) many times a second. Everything that does not
//! need another file or other normals follows from what [`crate::load`] left in the scene's [`crate::AssetCache`].

use crate::asset_cache::NormalChoice;
use crate::load::{assemble, lacks_surroundings};
use crate::material_binding::{MaterialBinder, MaterialSource};
use crate::readers::Readers;
use crate::scene::{Scene, world_from_model};
use crate::scene_file::{ObjectSpec, SceneFile};
use crate::settings::{LightSettings, SceneSettings};
use crate::validate::{self, InvalidValue};
use gonio_mesh::Diagnostic;
use std::sync::{Arc, OnceLock};

/// The result of [`apply`].
#[derive(Debug)]
pub enum Edited {
    /// The scene with the new settings.
    Done(Box<Applied>),
    /// The settings, unchanged: they need files that have not been read, so call [`crate::load::load`].
    NeedsFiles(Box<SceneSettings>),
}

/// A scene after an edit.
#[derive(Debug)]
pub struct Applied {
    /// The scene with the new settings. It shares meshes, textures and environment with the scene before where it can.
    pub loaded: Scene,
    /// Whether triangles were added, removed or moved, became transparent or opaque, or have other materials.
    pub geometry_changed: bool,
    /// Whether a material or one of its textures changed.
    pub materials_changed: bool,
}

/// Returns `loaded` with other settings.
///
/// It needs no files for changes of the picture, camera, background, equation and lights; of the use of the
/// environment; of objects' placement, shading and names; for removed and copied objects; for the numbers of a
/// material, and textures that were read before. It needs files for other models, normals, environments and textures.
///
/// A light or an object whose colour was edited loses the spectrum of that colour.
///
/// An object without a name gets that of its model. Settings without lights get no default lights.
///
/// # Errors
///
/// The first value that is out of its range.
pub fn apply(loaded: &Scene, mut scene: SceneSettings) -> Result<Edited, InvalidValue> {
    scene.lights.iter_mut().for_each(LightSettings::keep_spectrum);
    for material in scene.objects.iter_mut().flat_map(ObjectSpec::materials_mut).filter(|m| m.diffuse.is_some()) {
        material.diffuse_spectrum = None;
    }
    validate::check(&SceneFile::from(&scene))?;
    let cache = &loaded.cache;
    let known: Option<Vec<(usize, usize)>> = scene.objects.iter().map(|object| cache.find(object)).collect();
    let environment = scene.environment.as_ref().map(|spec| cache.environment(spec));
    let Some(known) = known.filter(|_| !matches!(environment, Some(None))) else {
        return Ok(Edited::NeedsFiles(Box::new(scene)));
    };
    for (object, (model, _)) in scene.objects.iter_mut().zip(&known) {
        object.start_on_path();
        if object.name.is_empty() {
            object.name = cache.models[*model].object_name();
        }
    }
    let same_things = loaded.settings.objects.len() == scene.objects.len()
        && loaded.objects.len() == scene.objects.len()
        && loaded.settings.objects.iter().zip(&scene.objects).all(|(before, now)| is_same_thing(before, now));
    let next = if same_things { Some(moved(loaded, &scene)) } else { rebound(loaded, &scene, &known) };
    let Some(mut next) = next else { return Ok(Edited::NeedsFiles(Box::new(scene))) };

    next.environment = environment.flatten();
    let about = lacks_surroundings();
    next.diagnostics.retain(|d| d.message != about.message);
    if next.environment.is_none() && next.materials.iter().any(|m| !m.optics.is_plain()) {
        next.diagnostics.push(about);
    }
    let geometry_changed = !same_things && !has_same_triangles(loaded, &next) || has_moved(loaded, &next);
    next.known_bounds = if geometry_changed { OnceLock::new() } else { loaded.known_bounds.clone() };
    next.camera_was_framed = false;
    next.settings = scene;
    let materials_changed =
        !same_things && (next.materials != loaded.materials || !are_same(&next.textures, &loaded.textures));
    Ok(Edited::Done(Box::new(Applied { loaded: next, geometry_changed, materials_changed })))
}

/// Whether an object has the same mesh and the same materials as before.
fn is_same_thing(before: &ObjectSpec, now: &ObjectSpec) -> bool {
    before.model == now.model
        && (&before.material, &before.parts) == (&now.material, &now.parts)
        && NormalChoice::for_object(before) == NormalChoice::for_object(now)
}

/// The same objects in their new places.
fn moved(loaded: &Scene, scene: &SceneSettings) -> Scene {
    let mut next = loaded.clone();
    for (object, spec) in next.objects.iter_mut().zip(&scene.objects) {
        object.name.clone_from(&spec.name);
        object.shading = spec.shading;
        object.world_from_model = world_from_model(spec);
    }
    next
}

/// Other objects or materials from the cache; `None` if it lacks something.
fn rebound(loaded: &Scene, scene: &SceneSettings, known: &[(usize, usize)]) -> Option<Scene> {
    let mut cache = (*loaded.cache).clone();
    for material in scene.objects.iter().flat_map(ObjectSpec::materials) {
        cache.brdfs.add_model(material);
        if cache.brdfs.lacks(material) {
            return None;
        }
    }
    let mut binder = MaterialBinder::from_cache(&cache.textures, cache.brdfs.clone());
    let materials_of_parts: Vec<Vec<usize>> = scene
        .objects
        .iter()
        .zip(known)
        .map(|(object, &(model, mesh))| {
            let parts = cache.meshes[mesh].any().map(|mesh| mesh.parts.as_slice()).unwrap_or_default();
            let source = MaterialSource::of_cached(&cache.models[model]);
            binder.add_object(model, object, parts, &source, Readers::ALL.own_material)
        })
        .collect();
    let bound = binder.recall(&cache.textures)?;
    let mesh_of_object: Vec<usize> = known.iter().map(|&(_, mesh)| mesh).collect();
    let mut next = Scene {
        materials: bound.materials,
        textures: bound.textures,
        diagnostics: loaded.diagnostics.clone(),
        ..Scene::default()
    };
    let mut new_diagnostics: Vec<Diagnostic> = Vec::new();
    let (meshes, with_tangents) = (&mut cache.meshes, Readers::ALL.tangents);
    assemble(
        &mut next,
        &scene.objects,
        meshes,
        &mesh_of_object,
        &materials_of_parts,
        with_tangents,
        &mut new_diagnostics,
    );
    new_diagnostics.retain(|new| !loaded.diagnostics.contains(new));
    next.diagnostics.append(&mut new_diagnostics);
    next.cache = Arc::new(cache);
    Some(next)
}

fn are_same<T>(a: &[Arc<T>], b: &[Arc<T>]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| Arc::ptr_eq(a, b))
}

/// Whether both have the same triangles, opaque and transparent alike, wherever they are placed.
fn has_same_triangles(before: &Scene, now: &Scene) -> bool {
    are_same(&before.meshes, &now.meshes)
        && before.objects.len() == now.objects.len()
        && before.objects.iter().zip(&now.objects).all(|(a, b)| {
            (a.mesh, a.closed, &a.parts) == (b.mesh, b.closed, &b.parts)
                && a.parts.iter().all(|part| {
                    let is_transparent = |of: &Scene| of.materials.get(part.material).map(|m| m.is_transparent());
                    is_transparent(before) == is_transparent(now)
                })
        })
}

fn has_moved(before: &Scene, now: &Scene) -> bool {
    before.objects.iter().zip(&now.objects).any(|(a, b)| a.world_from_model != b.world_from_model)
}
