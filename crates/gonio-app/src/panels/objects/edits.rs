//! Edits of the list of objects.

use crate::document::Document;
use crate::session::{Selection, Session};
use glam::DVec3;
use gonio_scene::Scene;
use gonio_scene::files;
use gonio_scene::scene_file::ObjectSpec;
use gonio_scene::settings::{Aim, CameraSettings};

/// An edit of the list of objects.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Edit {
    /// A copy beside it.
    Duplicate(usize),
    /// Taken out.
    Remove(usize),
    /// The camera looks at it.
    Frame(usize),
}

/// Applies it.
pub fn apply(document: &mut Document, session: &mut Session, edit: Edit) {
    let objects = &mut document.scene.objects;
    match edit {
        Edit::Duplicate(index) if index < objects.len() => {
            let bounds = session.loaded.as_ref().and_then(|loaded| bounds_of(loaded, index));
            let width = bounds.map_or(1.0, |(min, max)| 1.15 * (max.x - min.x));
            let mut copy = objects[index].clone();
            copy.name = format!("{} copy", copy.name.trim_end_matches(" copy"));
            copy.translate[0] = ((copy.translate[0] + width) * 1000.0).round() / 1000.0;
            objects.insert(index + 1, copy);
            session.selection = Selection::Object(index + 1);
        }
        // A scene has at least one.
        Edit::Remove(index) if index < objects.len() && objects.len() > 1 => {
            objects.remove(index);
            session.selection = Selection::None;
        }
        Edit::Frame(index) => {
            let Some(loaded) = &session.loaded else { return };
            if let Some(bounds) = bounds_of(loaded, index) {
                document.scene.camera = loaded.with_planes(looking_at(&document.scene.camera, bounds, aspect(session)));
            }
        }
        _ => {}
    }
}

fn aspect(session: &Session) -> f64 {
    let [width, height] = session.facts.size.map(f64::from);
    if width > 0.0 && height > 0.0 { width / height } else { 1.0 }
}

/// Whether a built-in file is a model, and no scene.
pub fn is_model(name: &str) -> bool {
    let text = files::builtin(name).map(String::from_utf8_lossy).unwrap_or_default();
    text.lines().any(|line| line.starts_with("v "))
}

/// Adds a built-in model beside what there is.
pub fn add(document: &mut Document, session: &mut Session, name: &str) {
    let (min, max) = session.loaded.as_ref().map(|loaded| loaded.bounds()).unwrap_or_default();
    // Sample models reach about a unit to each side.
    let [x, y, z] = [max.x + 1.2, 0.5 * (min.y + max.y), 0.5 * (min.z + max.z)].map(|v| (100.0 * v).round() / 100.0);
    let model = format!("{}{name}", files::BUILTIN);
    document.scene.objects.push(ObjectSpec { model, translate: [x, y, z], ..ObjectSpec::default() });
    session.selection = Selection::Object(document.scene.objects.len() - 1);
    session.announcement = format!("{name} was added");
}

/// The box around an object, world space.
fn bounds_of(loaded: &Scene, index: usize) -> Option<(DVec3, DVec3)> {
    let object = loaded.objects.get(index)?;
    let mesh = loaded.meshes.get(object.mesh)?;
    let points = mesh.positions.iter().map(|p| object.world_from_model.transform_point3(DVec3::from(p.map(f64::from))));
    points.fold(None, |known, p| {
        let (min, max) = known.unwrap_or((p, p));
        Some((min.min(p), max.max(p)))
    })
}

/// A camera from the same side, as far away as the box's sphere wants.
fn looking_at(spec: &CameraSettings, (min, max): (DVec3, DVec3), aspect: f64) -> CameraSettings {
    let camera = spec.to_camera();
    let center = 0.5 * (min + max);
    let radius = (0.5 * (max - min).length()).max(1e-6);
    let half_y = 0.5 * camera.fov_y_rad;
    let half = half_y.min((half_y.tan() * aspect).atan());
    let position = center - camera.front * (1.05 * radius / half.sin());
    CameraSettings { position: position.to_array(), aim: Aim::Target(center.to_array()), ..spec.clone() }
}
