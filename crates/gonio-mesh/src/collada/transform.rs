//! Transforms of nodes, and of the whole file to Y up and metres.

use super::document::Document;
use super::xml::Element;
use crate::ReadError;
use crate::text::quote;
use glam::{DMat3, DMat4, DVec3};

/// Returns `parent_from_file`, which converts to Y up and metres, and the length of the file's unit in metres.
pub(super) fn model_from_file(document: &Document<'_>) -> Result<(DMat4, f64), ReadError> {
    let Some(asset) = document.tree.root().child("asset") else { return Ok((DMat4::IDENTITY, 1.0)) };
    let mut meter = 1.0;
    if let Some(unit) = asset.child("unit")
        && let Some(written) = unit.attribute("meter")
    {
        match written.trim().parse::<f64>() {
            Ok(value) if value.is_finite() && value > 0.0 => meter = value,
            _ => {
                let written = quote(written.as_bytes());
                document.warn(unit.at(), format!("invalid unit length {written}: using 1 metre"));
            }
        }
    }
    let axes = match asset.child("up_axis") {
        None => DMat3::IDENTITY,
        Some(axis) => match axis.text().as_ref() {
            "Y_UP" => DMat3::IDENTITY,
            "Z_UP" => DMat3::from_cols(DVec3::X, DVec3::NEG_Z, DVec3::Y),
            "X_UP" => DMat3::from_cols(DVec3::Y, DVec3::NEG_X, DVec3::Z),
            other => {
                let message = format!("up_axis is {}, not X_UP, Y_UP or Z_UP: using Y_UP", quote(other.as_bytes()));
                document.warn(axis.at(), message);
                DMat3::IDENTITY
            }
        },
    };
    Ok((DMat4::from_mat3(axes) * DMat4::from_scale(DVec3::splat(meter)), meter))
}

/// `parent_from_node`: all transforms of a node, in the order of the file.
pub(super) fn parent_from_node(document: &Document<'_>, node: Element<'_>) -> Result<DMat4, ReadError> {
    let mut matrix = DMat4::IDENTITY;
    for child in node.children() {
        matrix *= match child.name() {
            // Written row by row.
            "matrix" => DMat4::from_cols_array(&document.exactly::<16>(child)?).transpose(),
            "translate" => DMat4::from_translation(DVec3::from(document.exactly::<3>(child)?)),
            "scale" => DMat4::from_scale(DVec3::from(document.exactly::<3>(child)?)),
            "rotate" => {
                let [x, y, z, degrees] = document.exactly::<4>(child)?;
                match DVec3::new(x, y, z).try_normalize() {
                    Some(axis) => DMat4::from_axis_angle(axis, degrees.to_radians()),
                    None => DMat4::IDENTITY,
                }
            }
            "lookat" => look_at(document, child)?,
            "skew" => skew(document.exactly::<7>(child)?),
            _ => continue,
        };
    }
    Ok(matrix)
}

/// Eye, interest, up; the node looks along its -z.
fn look_at(document: &Document<'_>, element: Element<'_>) -> Result<DMat4, ReadError> {
    let v = document.exactly::<9>(element)?;
    let [eye, interest, up] =
        [DVec3::new(v[0], v[1], v[2]), DVec3::new(v[3], v[4], v[5]), DVec3::new(v[6], v[7], v[8])];
    let back = (eye - interest).try_normalize();
    let right = back.and_then(|back| up.cross(back).try_normalize());
    let (Some(back), Some(right)) = (back, right) else {
        document.warn(
            element.at(),
            "this lookat has no direction, or looks along its up vector: only its position is used",
        );
        return Ok(DMat4::from_translation(eye));
    };
    Ok(DMat4::from_translation(eye) * DMat4::from_mat3(DMat3::from_cols(right, back.cross(right), back)))
}

/// Angle in degrees, the axis that turns, the axis along which points move; as RenderMan defines it: the first axis is
/// turned towards the second by the angle.
fn skew(v: [f64; 7]) -> DMat4 {
    let turned = DVec3::new(v[1], v[2], v[3]).normalize_or_zero();
    let along = DVec3::new(v[4], v[5], v[6]).normalize_or_zero();
    // The component of `turned` orthogonal to `along` is the height above the fixed plane.
    let height = turned - turned.dot(along) * along;
    let Some(height) = height.try_normalize() else { return DMat4::IDENTITY };
    let shear = v[0].to_radians().tan();
    // p + along * shear * (height . p), column by column.
    let column = |axis: DVec3| axis + along * shear * height.dot(axis);
    DMat4::from_mat3(DMat3::from_cols(column(DVec3::X), column(DVec3::Y), column(DVec3::Z)))
}
