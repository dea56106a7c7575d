//! From meshes and materials to a scene's objects.

use crate::asset_cache::CachedMesh;
use crate::load::world_from_model;
use crate::scene::{Object, ObjectPart, Scene};
use crate::scene_file::ObjectSpec;
use gonio_mesh::{Diagnostic, Mesh, tangents};
use rayon::prelude::*;
use std::sync::Arc;

/// Fills in `meshes` and `objects` of `loaded`, whose materials are there: objects in the scene's order, tangents where
/// a normal map needs them. `mesh_of_object` indexes `cache`, `first_material` the materials.
pub(crate) fn assemble(
    loaded: &mut Scene,
    specs: &[ObjectSpec],
    cache: &mut [CachedMesh],
    mesh_of_object: &[usize],
    first_material: &[usize],
    diagnostics: &mut Vec<Diagnostic>,
) {
    // A mesh of the cache with or without tangents, each once.
    let mut wanted: Vec<(usize, bool)> = Vec::new();
    let mut index_of_object = Vec::with_capacity(specs.len());
    for (&mesh, &first) in mesh_of_object.iter().zip(first_material) {
        let has_normal_map = |material: usize| loaded.materials.get(material).is_some_and(|m| m.maps.normal.is_some());
        let parts = cache[mesh].any().map(|mesh| mesh.parts.as_slice()).unwrap_or_default();
        let tangents = parts.iter().any(|part| part.triangle_count > 0 && has_normal_map(first + part.material));
        let index = wanted.iter().position(|key| *key == (mesh, tangents)).unwrap_or(wanted.len());
        if index == wanted.len() {
            wanted.push((mesh, tangents));
        }
        index_of_object.push(index);
    }
    let lacking: Vec<usize> =
        wanted.iter().filter(|(m, t)| *t && cache[*m].with_tangents.is_none()).map(|w| w.0).collect();
    let made: Vec<Option<Mesh>> =
        lacking.par_iter().map(|&m| cache[m].plain.as_ref().and_then(|mesh| tangents::with_tangents(mesh))).collect();
    for (&m, made) in lacking.iter().zip(made) {
        if let Some(mesh) = made {
            cache[m].with_tangents = Some(Arc::new(mesh));
            continue;
        }
        let object = mesh_of_object.iter().position(|mesh| *mesh == m).unwrap_or(0);
        let name = specs.get(object).map_or("", |object| object.model.as_str());
        let message = "the normal map is ignored: the mesh has no texture coordinates";
        diagnostics.push(Diagnostic::warning(message).in_file(name));
    }
    for &(m, tangents) in &wanted {
        let of = &cache[m];
        let [first, second] = if tangents { [&of.with_tangents, &of.plain] } else { [&of.plain, &of.with_tangents] };
        loaded.meshes.push(first.as_ref().or(second.as_ref()).cloned().unwrap_or_default());
    }
    // A mesh with tangents can replace the one without, which is kept only while it is drawn.
    for (m, of) in cache.iter_mut().enumerate() {
        if of.with_tangents.is_some() && !wanted.contains(&(m, false)) {
            of.plain = None;
        }
    }
    let last_material = loaded.materials.len().saturating_sub(1);
    for (i, spec) in specs.iter().enumerate() {
        let mesh = &loaded.meshes[index_of_object[i]];
        let parts: Vec<ObjectPart> = mesh
            .parts
            .iter()
            .map(|part| ObjectPart {
                name: part.name.clone(),
                first_triangle: part.first_triangle,
                triangle_count: part.triangle_count,
                material: (first_material[i] + part.material).min(last_material),
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

impl CachedMesh {
    fn any(&self) -> Option<&Arc<Mesh>> {
        self.plain.as_ref().or(self.with_tangents.as_ref())
    }
}
