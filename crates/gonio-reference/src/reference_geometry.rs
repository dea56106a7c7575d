//! Geometry that outlives a scene: an edit of lights or colours need not build the tree of boxes again.

use crate::geometry::{WorldGeometry, is_looked_through};
use glam::DMat4;
use gonio_mesh::Mesh;
use gonio_scene::Scene;
use std::sync::Arc;

/// The triangles of a scene in world space, with the tree of boxes over them: what takes long to build. Can be built on
/// one thread and used on others.
pub struct ReferenceGeometry {
    world: WorldGeometry,
    built_of: Vec<ObjectParts>,
}

/// The properties of an object that its triangles depend on.
struct ObjectParts {
    mesh: Option<Arc<Mesh>>,
    world_from_model: DMat4,
    closed: bool,
    looked_through: bool,
    parts: Vec<Part>,
}

/// First triangle, how many, their material, and whether it shows what is behind.
type Part = (usize, usize, usize, bool);

impl ReferenceGeometry {
    /// Carries the geometry to world space and builds the tree.
    pub fn new(scene: &Scene) -> Self {
        ReferenceGeometry { world: WorldGeometry::new(scene), built_of: objects(scene).collect() }
    }

    /// Whether it is what [`Self::new`] would build for a scene: of the same meshes (the same ones, not equal ones), in
    /// the same places, with materials of the same numbers that are transparent, and looked through, where they were.
    /// Colours, textures, shading, lights, camera and environment may be others.
    pub fn fits(&self, scene: &Scene) -> bool {
        self.built_of.len() == scene.objects.len() && self.built_of.iter().zip(objects(scene)).all(|(a, b)| a.is(&b))
    }

    pub(crate) fn world(&self) -> &WorldGeometry {
        &self.world
    }
}

impl ObjectParts {
    fn is(&self, other: &ObjectParts) -> bool {
        let same_mesh = match (&self.mesh, &other.mesh) {
            (Some(a), Some(b)) => Arc::ptr_eq(a, b),
            (a, b) => a.is_none() && b.is_none(),
        };
        same_mesh
            && self.world_from_model == other.world_from_model
            && (self.closed, self.looked_through) == (other.closed, other.looked_through)
            && self.parts == other.parts
    }
}

fn objects(scene: &Scene) -> impl Iterator<Item = ObjectParts> {
    scene.objects.iter().map(|object| ObjectParts {
        mesh: scene.meshes.get(object.mesh).cloned(),
        world_from_model: object.world_from_model,
        closed: object.closed,
        looked_through: is_looked_through(scene, object),
        parts: object
            .parts
            .iter()
            .map(|part| {
                let transparent = scene.materials.get(part.material).is_some_and(|m| m.is_transparent());
                (part.first_triangle, part.triangle_count, part.material, transparent)
            })
            .collect(),
    })
}
