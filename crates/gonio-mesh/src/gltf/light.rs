//! Lights (`KHR_lights_punctual`) and cameras. They are at their node and look along its -z, with +y up.

use super::json::JsonRef;
use crate::diagnostic::Reports;
use crate::{Diagnostic, ModelCamera, ModelLight, ModelLightKind, ReadError, Severity};
use glam::{DMat4, DVec3};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

const EXTENSION: &str = "KHR_lights_punctual";

/// Returns the number of lights in the file.
pub(super) fn count(root: JsonRef<'_>) -> usize {
    root.extension(EXTENSION).map_or(0, |extension| extension.count("lights"))
}

/// Returns the light at a node, if any; an invalid one becomes a warning.
pub(super) fn at_node(
    root: JsonRef<'_>,
    node: JsonRef<'_>,
    model_from_node: &DMat4,
    reports: &mut Reports,
) -> Option<ModelLight> {
    let user = node.extension(EXTENSION)?;
    let light = light(root, user, node, model_from_node, reports);
    survived(light, "the light is left out", reports)
}

/// Returns the camera at a node, if any; an invalid one becomes a warning.
pub(super) fn camera_at_node(
    root: JsonRef<'_>,
    node: JsonRef<'_>,
    model_from_node: &DMat4,
    reports: &mut Reports,
) -> Option<ModelCamera> {
    node.get("camera")?;
    let camera = camera(root, node, model_from_node, reports);
    survived(camera, "the camera is left out", reports)
}

fn survived<T>(read: Result<Option<T>, ReadError>, lost: &str, reports: &mut Reports) -> Option<T> {
    read.unwrap_or_else(|error| {
        let message = || format!("{}: {lost}", error.message);
        reports.add_without_line("lights and cameras that are left out", Severity::Warning, message);
        None
    })
}

fn light(
    root: JsonRef<'_>,
    user: JsonRef<'_>,
    node: JsonRef<'_>,
    model_from_node: &DMat4,
    reports: &mut Reports,
) -> Result<Option<ModelLight>, ReadError> {
    let index = user.index("light")?.ok_or_else(|| user.missing("light"))?;
    let lights = root.extension(EXTENSION).and_then(|extension| extension.get("lights"));
    let Some(at) = lights.and_then(|lights| lights.item(index)) else {
        return Err(ReadError::new(format!("{}, but the file has {} lights", user.written("light"), count(root))));
    };
    let kind = match at.text("type")?.ok_or_else(|| at.missing("type"))? {
        "directional" => ModelLightKind::Directional,
        "point" => ModelLightKind::Point,
        "spot" => spot(at)?,
        other => return Err(ReadError::new(format!("{} has the unknown type {other:?}", at.title()))),
    };
    if let Some(range) = at.number("range")? {
        let message = || {
            format!(
                "{} has a range of {range}, which is ignored: it falls off with the square of the distance",
                at.title()
            )
        };
        reports.add_without_line("lights with a range", Severity::Note, message);
    }
    let color = at.numbers("color")?.unwrap_or([1.0; 3]).map(|c| c.max(0.0) as f32);
    let intensity = at.number("intensity")?.unwrap_or(1.0).max(0.0) as f32;
    let (position, direction, _) = pose(node, model_from_node)?;
    let name = [node.name(), at.name()].into_iter().find(|name| !name.is_empty()).unwrap_or("").to_owned();
    Ok(Some(ModelLight {
        name,
        kind,
        position: position.to_array(),
        direction: direction.to_array(),
        color,
        intensity,
        // Candela: illuminance falls off with the square of the distance.
        attenuation: [0.0, 0.0, 1.0],
    }))
}

fn spot(at: JsonRef<'_>) -> Result<ModelLightKind, ReadError> {
    let cone = at.get("spot");
    let angle = |key, default| -> Result<f64, ReadError> {
        Ok(cone.map_or(Ok(None), |cone| cone.number(key))?.unwrap_or(default))
    };
    let outer = angle("outerConeAngle", FRAC_PI_4)?.clamp(0.0, FRAC_PI_2);
    let inner = angle("innerConeAngle", 0.0)?.clamp(0.0, outer);
    Ok(ModelLightKind::Spot { inner_angle_rad: inner as f32, outer_angle_rad: outer as f32 })
}

fn camera(
    root: JsonRef<'_>,
    node: JsonRef<'_>,
    model_from_node: &DMat4,
    reports: &mut Reports,
) -> Result<Option<ModelCamera>, ReadError> {
    let Some((_, at)) = node.target(root, "camera", "cameras")? else { return Ok(None) };
    let kind = at.text("type")?.ok_or_else(|| at.missing("type"))?;
    let lens = match kind {
        "perspective" | "orthographic" => at.get(kind).ok_or_else(|| at.missing(kind))?,
        other => return Err(ReadError::new(format!("{} has the unknown type {other:?}", at.title()))),
    };
    let fov_y_rad = if kind == "perspective" {
        let fov = lens.number("yfov")?.ok_or_else(|| lens.missing("yfov"))?;
        if !(fov > 0.0 && fov < std::f64::consts::PI) {
            return Err(ReadError::new(format!("{}, which is not a valid field of view", lens.written("yfov"))));
        }
        Some(fov)
    } else {
        let what = "an orthographic camera: its height (ymag) is ignored";
        reports.push(0, Diagnostic::note(format!("{} is {what}", at.title())));
        None
    };
    let clip = [lens.number("znear")?, lens.number("zfar")?];
    let (position, direction, up) = pose(node, model_from_node)?;
    let name = [node.name(), at.name()].into_iter().find(|name| !name.is_empty()).unwrap_or("").to_owned();
    Ok(Some(ModelCamera {
        name,
        position: position.to_array(),
        direction: direction.to_array(),
        up: up.to_array(),
        fov_y_rad,
        clip,
    }))
}

/// Returns the position of a node, the direction of its -z, and that of its +y made orthogonal to -z.
fn pose(node: JsonRef<'_>, model_from_node: &DMat4) -> Result<(DVec3, DVec3, DVec3), ReadError> {
    let position = model_from_node.w_axis.truncate();
    let direction = (-model_from_node.z_axis.truncate()).try_normalize();
    let up = direction.and_then(|d| model_from_node.y_axis.truncate().reject_from_normalized(d).try_normalize());
    match (position.is_finite(), direction, up) {
        (true, Some(direction), Some(up)) => Ok((position, direction, up)),
        _ => Err(ReadError::new(format!("{} has a degenerate transform", node.title()))),
    }
}
