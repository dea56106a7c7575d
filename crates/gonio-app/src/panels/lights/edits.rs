//! Edits of the list of lights.

use crate::document::Document;
use crate::session::{Selection, Session};
use glam::DVec3;
use gonio_language::tr;
use gonio_light::vector::unit;
use gonio_scene::defaults;
use gonio_scene::scene_file::LightSourceKind;
use gonio_scene::settings::LightSettings;

/// An edit of the list of lights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Edit {
    /// Adds a copy after the light.
    Duplicate(usize),
    /// Removes the light.
    Remove(usize),
    /// Moves the light up by one.
    Up(usize),
    /// Moves the light down by one.
    Down(usize),
}

/// Applies an edit. The selection and debug views of one light follow their light.
pub fn apply(document: &mut Document, session: &mut Session, edit: Edit) {
    let count = document.scene.lights.len();
    match edit {
        Edit::Duplicate(index) if index < count => {
            let mut copy = document.scene.lights[index].clone();
            if !copy.name.is_empty() {
                copy.name = tr!("scene-copy", copy = copy.name.trim_end_matches(" copy"));
            }
            document.scene.lights.insert(index + 1, copy);
            renumber(document, |light| Some(if light > index { light + 1 } else { light }));
            session.selection = Selection::Light(index + 1);
        }
        Edit::Remove(index) if index < count => {
            document.scene.lights.remove(index);
            renumber(document, |light| match light.cmp(&index) {
                std::cmp::Ordering::Less => Some(light),
                std::cmp::Ordering::Equal => None,
                std::cmp::Ordering::Greater => Some(light - 1),
            });
            session.selection = Selection::None;
        }
        Edit::Up(index) if index > 0 && index < count => swap(document, session, index, index - 1),
        Edit::Down(index) if index + 1 < count => swap(document, session, index, index + 1),
        _ => {}
    }
}

fn swap(document: &mut Document, session: &mut Session, from: usize, to: usize) {
    document.scene.lights.swap(from, to);
    renumber(document, |light| {
        Some(if light == from {
            to
        } else if light == to {
            from
        } else {
            light
        })
    });
    session.selection = Selection::Light(to);
}

/// Gives debug views of one light its new number; `None` selects the first light.
fn renumber(document: &mut Document, number: impl Fn(usize) -> Option<usize>) {
    for pane in &mut document.panes.list {
        if let Some(view) = &mut pane.view {
            view.light = view.light.and_then(&number);
        }
    }
}

/// Whether the light is the only one that is on, of several.
pub fn is_alone(document: &Document, index: usize) -> bool {
    let lights = &document.scene.lights;
    lights.len() > 1 && lights.iter().enumerate().all(|(i, light)| light.enabled == (i == index))
}

/// Switches on this light alone; if it is alone, all lights.
pub fn alone(document: &mut Document, index: usize) {
    let all = is_alone(document, index);
    for (i, light) in document.scene.lights.iter_mut().enumerate() {
        light.enabled = all || i == index;
    }
}

/// Adds a light of a kind at the upper left of the camera, so that it is visible and lights the objects.
pub fn add(document: &mut Document, session: &mut Session, kind: LightSourceKind) {
    let (center, radius) = around(session);
    let camera = document.scene.camera.to_camera();
    // New lights alternate in position, so that they can be told apart.
    let side = [-0.55, 0.55, 0.0][document.scene.lights.len() % 3];
    let way = unit(side * camera.right + 0.6 * camera.up - 0.75 * camera.front).unwrap_or(DVec3::Y);
    let tidy = |v: DVec3| v.to_array().map(|c| tidy(c, radius));
    let mut light = LightSettings { intensity: 0.6, ..LightSettings::new(kind) };
    if kind == LightSourceKind::Ambient {
        light.intensity = 0.08;
    }
    light.direction = kind.has_direction().then(|| (-way).to_array().map(tidy_unit));
    light.position = kind.has_position().then(|| tidy(center + 1.6 * radius * way));
    if kind == LightSourceKind::Rectangle {
        light.size = size_for(radius);
    }
    document.scene.lights.push(light);
    session.selection = Selection::Light(document.scene.lights.len() - 1);
    session.announcement = tr!("scene-a-light-was-added", kind = gonio_language::name(kind.name()));
}

/// Converts a light to another kind. Values that the new kind lacks are removed, those that it needs are filled in.
pub fn convert(light: &mut LightSettings, kind: LightSourceKind, session: &Session) {
    let (center, radius) = around(session);
    let way = light.direction.map(DVec3::from).and_then(unit);
    let from_place = light.position.and_then(|p| unit(center - DVec3::from(p)));
    let way = way.or(from_place).unwrap_or(DVec3::NEG_Y);
    light.kind = kind;
    light.direction = kind.has_direction().then(|| way.to_array().map(tidy_unit));
    let place = light.position.unwrap_or_else(|| (center - 1.6 * radius * way).to_array().map(|c| tidy(c, radius)));
    light.position = kind.has_position().then_some(place);
    if !kind.has_position() {
        [light.constant, light.linear, light.quadratic] = defaults::ATTENUATION;
        light.motion = None;
    }
    if !kind.has_radius() {
        light.radius = defaults::LIGHT_RADIUS;
    }
    light.size = if kind == LightSourceKind::Rectangle { size_for(radius) } else { defaults::LIGHT_SIZE };
    if kind != LightSourceKind::Spot {
        (light.inner_angle, light.outer_angle) = (defaults::INNER_ANGLE, defaults::OUTER_ANGLE);
    }
}

/// Centre and half diagonal of the scene's bounding box.
pub fn around(session: &Session) -> (DVec3, f64) {
    let (min, max) = session.loaded.as_ref().map(|loaded| loaded.bounds()).unwrap_or_default();
    let radius = 0.5 * (max - min).length();
    (0.5 * (min + max), if radius > 1e-12 { radius } else { 1.0 })
}

/// Width and height of a rectangle that lights a scene of this radius.
fn size_for(radius: f64) -> [f64; 2] {
    [tidy(0.6 * radius, radius); 2]
}

/// Rounds to three digits relative to the size of the scene.
fn tidy(v: f64, size: f64) -> f64 {
    let step = 10f64.powf(size.log10().floor() - 2.0);
    let tidied = (v / step).round() * step;
    // Steps below 1 are not binary fractions: this is the nearest number with a short decimal form.
    format!("{tidied:.6e}").parse().unwrap_or(v)
}

fn tidy_unit(c: f64) -> f64 {
    (1000.0 * c).round() / 1000.0 + 0.0
}
