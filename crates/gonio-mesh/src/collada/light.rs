//! Reads lights and cameras at the nodes that place them.

use super::document::{Document, name_of};
use super::xml::Element;
use crate::text::quote;
use crate::{ModelCamera, ModelLight, ModelLightKind, ReadError, Severity};
use glam::{DMat3, DMat4, DVec3};
use std::f64::consts::PI;

/// The cone of a spot without one, in degrees: no cone at all.
const FALLOFF_ANGLE: f64 = 180.0;

/// The aspect ratio (width divided by height) of a camera without one.
const ASPECT_RATIO: f64 = 16.0 / 9.0;

/// Reads a light at a node. `meter` is the length of the file's unit in metres.
pub(super) fn light(
    document: &Document<'_>,
    element: Element<'_>,
    model_from_node: DMat4,
    meter: f64,
) -> Result<Option<ModelLight>, ReadError> {
    let Some(kind) = element.child("technique_common").and_then(|technique| technique.children().next()) else {
        document.warn(element.at(), format!("the light {:?} has no parameters: it is left out", name_of(element)));
        return Ok(None);
    };
    let number = |name: &str, absent: f64| kind.child(name).map_or(Ok(absent), |child| document.number(child));
    let written = kind.child("color").map_or(Ok([1.0; 3]), |color| document.exactly::<3>(color))?;
    let color = written.map(|value| value.max(0.0));
    let largest = color.iter().fold(0.0, |a: f64, &b| a.max(b));
    // Blender multiplies the colour by the light's power.
    let intensity = if largest > 1.0 { largest } else { 1.0 };
    let attenuation = [
        number("constant_attenuation", 1.0)?,
        number("linear_attenuation", 0.0)? / meter,
        number("quadratic_attenuation", 0.0)? / (meter * meter),
    ];
    let model_kind = match kind.name() {
        "ambient" => ModelLightKind::Ambient,
        "directional" => ModelLightKind::Directional,
        "point" => ModelLightKind::Point,
        "spot" => {
            let outer = (0.5 * number("falloff_angle", FALLOFF_ANGLE)?.to_radians()).clamp(0.0, 0.5 * PI);
            let inner = outer * (1.0 - number("falloff_exponent", 0.0)?.clamp(0.0, 1.0));
            ModelLightKind::Spot { inner_angle_rad: inner as f32, outer_angle_rad: outer as f32 }
        }
        other => {
            let message = format!(
                "the light {:?} has the unknown type {}: it is left out",
                name_of(element),
                quote(other.as_bytes())
            );
            document.warn(kind.at(), message);
            return Ok(None);
        }
    };
    let [position, direction, _] = frame(model_from_node);
    let light = ModelLight {
        name: name_of(element),
        kind: model_kind,
        position: position.to_array(),
        direction: direction.to_array(),
        color: color.map(|value| (value / intensity) as f32),
        intensity: intensity as f32,
        attenuation: attenuation.map(|value| value.max(0.0) as f32),
    };
    let numbers = light.color.iter().chain(&light.attenuation).chain([&light.intensity]);
    if !position.is_finite() || !numbers.copied().all(f32::is_finite) {
        document
            .warn(element.at(), format!("the light {:?} has numbers that are too large: it is left out", light.name));
        return Ok(None);
    }
    Ok(Some(light))
}

/// Reads a camera at a node.
pub(super) fn camera(
    document: &Document<'_>,
    element: Element<'_>,
    model_from_node: DMat4,
    meter: f64,
) -> Result<Option<ModelCamera>, ReadError> {
    let kind = element.path(&["optics", "technique_common"]).and_then(|technique| technique.children().next());
    let Some(kind) = kind.filter(|kind| matches!(kind.name(), "perspective" | "orthographic")) else {
        let message =
            format!("the camera {:?} is neither perspective nor orthographic: it is left out", name_of(element));
        document.warn(element.at(), message);
        return Ok(None);
    };
    let number = |name: &str| kind.child(name).map(|child| document.number(child)).transpose();
    let fov_y_rad = if kind.name() == "perspective" { Some(fov_y(document, kind)?) } else { None };
    let [position, direction, up] = frame(model_from_node);
    if !position.is_finite() || !fov_y_rad.is_none_or(|fov| fov > 0.0 && fov < PI) {
        document.warn(kind.at(), format!("the camera {:?} has invalid parameters: it is left out", name_of(element)));
        return Ok(None);
    }
    let clip = [number("znear")?, number("zfar")?].map(|distance| distance.map(|d| d * meter));
    Ok(Some(ModelCamera {
        name: name_of(element),
        position: position.to_array(),
        direction: direction.to_array(),
        up: up.to_array(),
        fov_y_rad,
        clip,
    }))
}

/// `tan(y / 2) = tan(x / 2) / aspect_ratio`.
fn fov_y(document: &Document<'_>, perspective: Element<'_>) -> Result<f64, ReadError> {
    let number = |name: &str| perspective.child(name).map(|child| document.number(child)).transpose();
    if let Some(degrees) = number("yfov")? {
        return Ok(degrees.to_radians());
    }
    let Some(x) = number("xfov")? else {
        return Err(document.error(perspective.at(), "this camera has neither xfov nor yfov"));
    };
    let aspect = number("aspect_ratio")?.filter(|aspect| *aspect > 0.0).unwrap_or_else(|| {
        document.add("cameras without an aspect_ratio", Severity::Note, perspective.at(), || {
            "this camera has an xfov but no aspect_ratio: using 16:9".to_owned()
        });
        ASPECT_RATIO
    });
    Ok(2.0 * ((0.5 * x.to_radians()).tan() / aspect).atan())
}

/// Returns the position, the direction of the node's -z, and its y orthogonal to that.
fn frame(model_from_node: DMat4) -> [DVec3; 3] {
    let m = DMat3::from_mat4(model_from_node);
    let direction = (-m.z_axis).try_normalize().unwrap_or(DVec3::NEG_Z);
    let up = m.y_axis - m.y_axis.dot(direction) * direction;
    let up = up.try_normalize().unwrap_or_else(|| direction.any_orthonormal_vector());
    [model_from_node.w_axis.truncate(), direction, up]
}
