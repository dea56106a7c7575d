//! Lights and cameras of model files for the scene.

use crate::color_value::Color;
use crate::model_file::ModelFile;
use crate::scene::world_from_model;
use crate::scene_file::{CameraSpec, LightSourceKind, LightSpec, SceneFile};
use glam::{DMat4, DVec3};
use gonio_light::vector::unit;
use gonio_mesh::{Diagnostic, ModelCamera, ModelLight, ModelLightKind, ReadError};

/// Lights are not scaled if their sum at the centre of the objects is between these.
const USUAL_LIGHT: (f64, f64) = (0.25, 4.0);

/// Replaces `camera.from_model` by the values of that camera. Values that the scene gives itself stay.
pub(crate) fn take_camera(
    scene: &mut SceneFile,
    models: &[ModelFile],
    model_of_object: &[usize],
) -> Result<(), ReadError> {
    let Some(name) = scene.camera.from_model.take() else { return Ok(()) };
    let mut cameras = Vec::new();
    for (object, &m) in scene.objects.iter().zip(model_of_object) {
        let matrix = world_from_model(object);
        cameras.extend(models[m].model.cameras.iter().map(|camera| (camera, matrix)));
    }
    let by_number = name.parse::<usize>().ok().and_then(|n| n.checked_sub(1)).and_then(|n| cameras.get(n));
    let Some((camera, matrix)) = cameras.iter().find(|(camera, _)| camera.name == name).or(by_number) else {
        let names: Vec<&str> = cameras.iter().map(|(camera, _)| camera.name.as_str()).collect();
        let there_are = match names.as_slice() {
            [] => "the models have none".to_owned(),
            names => format!("the models have {}", names.join(", ")),
        };
        return Err(ReadError::new(format!("camera.from_model: unknown camera `{name}`: {there_are}")));
    };
    let spec = &mut scene.camera;
    let from = spec_of(camera, *matrix);
    spec.position = spec.position.or(from.position);
    if spec.target.is_none() && spec.yaw.is_none() && spec.pitch.is_none() {
        spec.target = from.target;
    }
    spec.up = spec.up.or(from.up);
    spec.fov_y = spec.fov_y.or(from.fov_y);
    spec.near = spec.near.or(from.near);
    spec.far = spec.far.or(from.far);
    Ok(())
}

/// A file's camera in the world. A parallel projection becomes the default perspective from the same place.
fn spec_of(camera: &ModelCamera, world_from_model: DMat4) -> CameraSpec {
    let position = world_from_model.transform_point3(camera.position.into());
    let way = |v: [f64; 3], or: DVec3| unit(world_from_model.transform_vector3(v.into())).unwrap_or(or);
    let scale = world_from_model.transform_vector3(camera.direction.into()).length();
    let [near, far] = camera.clip.map(|distance| distance.map(|d| d * scale));
    CameraSpec {
        position: Some(position.to_array()),
        target: Some((position + way(camera.direction, DVec3::NEG_Z)).to_array()),
        up: Some(way(camera.up, DVec3::Y).to_array()),
        fov_y: camera.fov_y_rad.map(f64::to_degrees),
        near: near.filter(|near| *near > 0.0 && far.is_none_or(|far| *near < far)),
        far,
        ..CameraSpec::default()
    }
}

/// Gives a scene without lights those of its model files.
///
/// Their units are those of photometry or of a program's own (candela, watts), whose numbers would need a camera's
/// exposure: where their sum at the centre of the objects is unusual, all are scaled by one factor, so that it is 1.
pub(crate) fn take_lights(
    scene: &mut SceneFile,
    models: &[ModelFile],
    model_of_object: &[usize],
    bounds: (DVec3, DVec3),
    diagnostics: &mut Vec<Diagnostic>,
) {
    if !scene.lights.is_empty() {
        return;
    }
    let mut lights = Vec::new();
    let mut from: Vec<&str> = Vec::new();
    for (object, &m) in scene.objects.iter().zip(model_of_object) {
        let matrix = world_from_model(object);
        lights.extend(models[m].model.lights.iter().filter_map(|light| light_of(light, matrix)));
        if !models[m].model.lights.is_empty() {
            from.push(&models[m].name);
        }
    }
    let middle = 0.5 * (bounds.0 + bounds.1);
    let sum: f64 = lights.iter().map(|light| strength_at(light, middle)).sum();
    if lights.is_empty() || sum.is_nan() || sum <= 0.0 {
        return;
    }
    let factor = if (USUAL_LIGHT.0..=USUAL_LIGHT.1).contains(&sum) { 1.0 } else { 1.0 / sum };
    for light in &mut lights {
        light.intensity = light.intensity.map(|i| i * factor);
    }
    let count = if lights.len() == 1 {
        "the model's own light".to_owned()
    } else {
        format!("the model's own {} lights", lights.len())
    };
    let scaled = if factor == 1.0 {
        String::new()
    } else {
        format!(", scaled by {factor:.3e} so that the centre of the scene receives 1 in total")
    };
    let file = from.first().copied().unwrap_or_default();
    diagnostics.push(Diagnostic::note(format!("lit by {count}{scaled}")).in_file(file));
    scene.lights = lights;
}

fn light_of(light: &ModelLight, world_from_model: DMat4) -> Option<LightSpec> {
    let position = world_from_model.transform_point3(light.position.into()).to_array();
    let direction = unit(world_from_model.transform_vector3(light.direction.into())).unwrap_or(DVec3::NEG_Y).to_array();
    let [constant, linear, quadratic] = light.attenuation.map(|k| Some(f64::from(k)));
    let mut spec = LightSpec {
        name: light.name.clone(),
        color: Some(Color(light.color.map(f64::from))),
        intensity: Some(f64::from(light.intensity)),
        ..LightSpec::default()
    };
    if light.intensity <= 0.0 || light.color == [0.0; 3] {
        return None;
    }
    match light.kind {
        ModelLightKind::Ambient => spec.kind = LightSourceKind::Ambient,
        ModelLightKind::Directional => (spec.kind, spec.direction) = (LightSourceKind::Directional, Some(direction)),
        ModelLightKind::Point => {
            spec = LightSpec {
                kind: LightSourceKind::Point,
                position: Some(position),
                constant,
                linear,
                quadratic,
                ..spec
            };
        }
        ModelLightKind::Spot { inner_angle_rad, outer_angle_rad } => {
            let outer = f64::from(outer_angle_rad).to_degrees().clamp(0.1, 89.9);
            spec = LightSpec {
                kind: LightSourceKind::Spot,
                position: Some(position),
                direction: Some(direction),
                inner_angle: Some(f64::from(inner_angle_rad).to_degrees().clamp(0.0, outer)),
                outer_angle: Some(outer),
                constant,
                linear,
                quadratic,
                ..spec
            };
        }
    }
    Some(spec)
}

/// The light's brightest channel that reaches `point`, its cone left out; ambient light counts too.
fn strength_at(light: &LightSpec, point: DVec3) -> f64 {
    let color = light.color.map_or(1.0, |c| c.0.iter().fold(0.0, |a: f64, &b| a.max(b)));
    let attenuation = light.position.map_or(1.0, |position| {
        let d = point.distance(position.into());
        let k = [light.constant, light.linear, light.quadratic].map(Option::unwrap_or_default);
        1.0 / (k[0] + k[1] * d + k[2] * d * d).max(1e-6)
    });
    light.intensity.unwrap_or(1.0) * color * attenuation
}
