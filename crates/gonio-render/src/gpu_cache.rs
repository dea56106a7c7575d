//! A cache of GPU resources: found by the data that they were created from, freed when no scene uses them.
//!
//! A window draws one scene in several panes, and uploads it after every edit: all of them share what they have in
//! common, recognised by the identity of the `Arc`s that a [`gonio_scene::Scene`] shares with its clones.

use crate::body_on_gpu::BodyOnGpu;
use crate::environment_on_gpu::EnvironmentOnGpu;
use crate::geometry::{Form, Geometry};
use gonio_gl::GlError;
use gonio_gl::objects::TextureObject;
use gonio_mesh::Mesh;
use gonio_scene::{LoadedEnvironment, Texture};
use std::collections::HashMap;
use std::hash::Hash;
use std::rc::{Rc, Weak as WeakRc};
use std::sync::{Arc, Weak};

/// The GPU resources of all scenes.
#[derive(Default)]
pub(crate) struct GpuCache {
    pub geometries: CacheOf<Form, Mesh, Geometry>,
    pub textures: CacheOf<(), Texture, TextureObject>,
    pub environments: CacheOf<(), LoadedEnvironment, EnvironmentOnGpu>,
    /// By whether normals are those of triangles, and by the bits of the object's matrix.
    pub bodies: CacheOf<(bool, [u64; 16]), Mesh, BodyOnGpu>,
}

impl GpuCache {
    /// Removes unused entries.
    pub fn tidy(&mut self) {
        self.geometries.tidy();
        self.textures.tidy();
        self.environments.tidy();
        self.bodies.tidy();
    }

    /// The number of resources created so far.
    pub fn count_made(&self) -> usize {
        self.geometries.count_made + self.textures.count_made + self.environments.count_made + self.bodies.count_made
    }
}

/// GPU resources by the identity of the data that they were created from, and how.
pub(crate) struct CacheOf<How, Source, Made> {
    made: HashMap<(usize, How), (Weak<Source>, WeakRc<Made>)>,
    /// The number created so far.
    count_made: usize,
}

impl<How, Source, Made> Default for CacheOf<How, Source, Made> {
    fn default() -> Self {
        CacheOf { made: HashMap::new(), count_made: 0 }
    }
}

impl<How: Hash + Eq, Source, Made> CacheOf<How, Source, Made> {
    /// The resource that was created from `source` in this way; it is created now if it is missing.
    ///
    /// An address says who somebody is while somebody remembers it: the weak reference keeps the address from being
    /// given to another, though not what lay there.
    pub fn get(
        &mut self,
        source: &Arc<Source>,
        how: How,
        make: impl FnOnce() -> Result<Made, GlError>,
    ) -> Result<Rc<Made>, GlError> {
        let made = self.get_if(source, how, || make().map(Some))?;
        made.ok_or_else(|| GlError::new("what was just made is not there"))
    }

    /// [`Self::get`] of what cannot always be made.
    pub fn get_if(
        &mut self,
        source: &Arc<Source>,
        how: How,
        make: impl FnOnce() -> Result<Option<Made>, GlError>,
    ) -> Result<Option<Rc<Made>>, GlError> {
        let key = (Arc::as_ptr(source) as usize, how);
        if let Some(made) = self.made.get(&key).and_then(|(_, made)| made.upgrade()) {
            return Ok(Some(made));
        }
        let Some(made) = make()?.map(Rc::new) else { return Ok(None) };
        self.count_made += 1;
        self.made.insert(key, (Arc::downgrade(source), Rc::downgrade(&made)));
        Ok(Some(made))
    }

    fn tidy(&mut self) {
        self.made.retain(|_, (_, made)| made.strong_count() > 0);
    }

    /// The number that scenes use.
    #[cfg(test)]
    pub fn count(&self) -> usize {
        self.made.values().filter(|(_, made)| made.strong_count() > 0).count()
    }
}
