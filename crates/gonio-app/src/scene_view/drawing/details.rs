//! Meshes at other levels of detail, created once, in a thread if possible.

use gonio_mesh::Mesh;
use gonio_scene::Scene;
use gonio_scene::detail::LevelOfDetail;
use gonio_scene::scene_file::{Normals, ObjectSpec};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Weak};

/// Most meshes that are kept; the oldest go first.
const MOST: usize = 64;

/// Parameters of a mesh at another level of detail.
#[derive(Clone, PartialEq)]
struct Key {
    detail: LevelOfDetail,
    /// The object's model and normals, which a replacing sphere has too.
    model: Option<(String, Normals, Option<f64>)>,
}

impl Key {
    fn new(detail: LevelOfDetail, object: &ObjectSpec) -> Self {
        let model = match detail {
            LevelOfDetail::Share(_) => None,
            LevelOfDetail::Sphere(_) => Some((object.model.clone(), object.normals, object.crease_angle)),
        };
        Key { detail, model }
    }
}

struct Known {
    source: Weak<Mesh>,
    key: Key,
    mesh: Arc<Mesh>,
}

struct Made {
    source: Arc<Mesh>,
    key: Key,
    mesh: Option<Mesh>,
}

/// Meshes at other levels of detail. One is created at a time, so that values that a slider passes over are skipped.
pub struct Details {
    known: Vec<Known>,
    running: bool,
    sender: Sender<Made>,
    receiver: Receiver<Made>,
    ctx: Option<egui::Context>,
}

impl Default for Details {
    fn default() -> Self {
        let (sender, receiver) = channel();
        Details { known: Vec::new(), running: false, sender, receiver, ctx: None }
    }
}

impl Details {
    /// Takes finished meshes; `ctx` is repainted when there are more.
    pub fn begin(&mut self, ctx: &egui::Context) {
        if self.ctx.is_none() {
            self.ctx = Some(ctx.clone());
        }
        while let Ok(made) = self.receiver.try_recv() {
            self.running = false;
            self.keep(made);
        }
    }

    /// The meshes of a scene's objects at a level of detail; `None` while some are being created.
    pub fn meshes(&mut self, loaded: &Scene, detail: LevelOfDetail) -> Option<Vec<Arc<Mesh>>> {
        let mut meshes = Vec::with_capacity(loaded.objects.len());
        for (object, spec) in loaded.objects.iter().zip(&loaded.settings.objects) {
            let source = loaded.meshes.get(object.mesh)?;
            meshes.push(self.mesh(source, spec, detail)?);
        }
        Some(meshes)
    }

    fn mesh(&mut self, source: &Arc<Mesh>, object: &ObjectSpec, detail: LevelOfDetail) -> Option<Arc<Mesh>> {
        let key = Key::new(detail, object);
        if let Some(known) = self.find(source, &key) {
            return Some(known);
        }
        if self.running {
            return None;
        }
        let (for_it, object, sender) = (source.clone(), object.clone(), self.sender.clone());
        let made_of = key.clone();
        let make = move || {
            let mesh = made_of.detail.mesh_for(&for_it, &object);
            // The window may be closed by now.
            let _ = sender.send(Made { source: for_it, key: made_of, mesh });
        };
        #[cfg(not(target_arch = "wasm32"))]
        if matches!(detail, LevelOfDetail::Share(_)) {
            self.running = true;
            let ctx = self.ctx.clone();
            std::thread::spawn(move || {
                make();
                if let Some(ctx) = ctx {
                    ctx.request_repaint();
                }
            });
            return None;
        }
        make();
        while let Ok(made) = self.receiver.try_recv() {
            self.keep(made);
        }
        self.find(source, &key)
    }

    fn find(&self, source: &Arc<Mesh>, key: &Key) -> Option<Arc<Mesh>> {
        let is_it = |known: &&Known| known.source.as_ptr() == Arc::as_ptr(source) && known.key == *key;
        self.known.iter().find(is_it).map(|known| known.mesh.clone())
    }

    fn keep(&mut self, made: Made) {
        self.known.retain(|known| known.source.strong_count() > 0);
        if self.known.len() >= MOST {
            self.known.remove(0);
        }
        // A mesh that is not changed is shared.
        let mesh = made.mesh.map_or_else(|| made.source.clone(), Arc::new);
        self.known.push(Known { source: Arc::downgrade(&made.source), key: made.key, mesh });
    }
}
