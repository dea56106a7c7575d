//! Levels of detail: the same scene with coarser meshes.

use crate::asset_cache::{NormalChoice, with_normals};
use crate::files::{self, BUILTIN};
use crate::scene::{ObjectPart, Scene};
use crate::scene_file::ObjectSpec;
use gonio_mesh::{Mesh, simplify, sphere, tangents, topology};
use std::sync::{Arc, OnceLock};

/// The level of detail of objects.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LevelOfDetail {
    /// Each mesh simplified to this share of its triangles, above 0, at most 1.
    Share(f64),
    /// Each built-in sphere with about this number of triangles: the nearest of 8, 32, 72, ... 131,072; the last one for all
    /// numbers above it.
    Sphere(usize),
}

impl LevelOfDetail {
    /// Returns a mesh of an object at this level of detail; `None` if it does not change.
    ///
    /// Simplifying a large mesh takes seconds, so it should run on a background thread.
    pub fn mesh_for(self, mesh: &Mesh, object: &ObjectSpec) -> Option<Mesh> {
        let other = match self {
            LevelOfDetail::Share(share) => {
                let count = (share.clamp(0.0, 1.0) * mesh.triangle_count() as f64).round() as usize;
                if count >= mesh.triangle_count() {
                    return None;
                }
                simplify::simplify(mesh, count)
            }
            LevelOfDetail::Sphere(triangles) => {
                if !is_sphere(object) {
                    return None;
                }
                let sphere = sphere::sphere(sphere::nearest_frequency(triangles)).ok()?;
                with_normals(sphere, NormalChoice::for_object(object)).0
            }
        };
        let wants_tangents = !mesh.tangents.is_empty() && other.tangents.is_empty();
        let with_tangents = if wants_tangents { tangents::with_tangents(&other) } else { None };
        Some(with_tangents.unwrap_or(other))
    }
}

/// Whether an object is a built-in sphere, with any number of triangles.
pub fn is_sphere(object: &ObjectSpec) -> bool {
    let name = object.model.strip_prefix(BUILTIN).map(|name| name.replace('_', "-"));
    name.is_some_and(|name| matches!(name.as_str(), "sphere-smooth" | "sphere-coarse" | "sphere-coarse-averaged"))
        || files::sphere_of(&object.model).is_some()
}

/// Returns the scene with other meshes, one for each object in order; surplus objects or meshes are ignored. A mesh has
/// the parts of the one it replaces, or fewer.
pub fn with_meshes(loaded: &Scene, meshes: &[Arc<Mesh>]) -> Scene {
    let mut next = loaded.clone();
    next.known_bounds = OnceLock::new();
    for (object, mesh) in next.objects.iter_mut().zip(meshes) {
        let same = loaded.meshes.get(object.mesh).is_some_and(|before| Arc::ptr_eq(before, mesh));
        if same {
            continue;
        }
        let known = next.meshes.iter().position(|known| Arc::ptr_eq(known, mesh));
        object.mesh = known.unwrap_or_else(|| {
            next.meshes.push(mesh.clone());
            next.meshes.len() - 1
        });
        object.closed = object.closed && topology::is_closed_outward(mesh);
        let parts = mesh.parts.iter().zip(&object.parts).map(|(part, before)| ObjectPart {
            first_triangle: part.first_triangle,
            triangle_count: part.triangle_count,
            ..before.clone()
        });
        object.parts = parts.collect();
    }
    next
}
