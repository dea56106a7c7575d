//! The positions of moving lights.

use crate::settings::{Motion, MotionPath};
use glam::{DQuat, DVec3};
use gonio_light::vector::unit;
use std::f64::consts::TAU;

/// The position at `time`, seconds, of a light whose motion starts at `position`.
///
/// All motions repeat after `period`. At time 0 the light is at `position`, on a path at its first point.
pub fn position_at(motion: &Motion, position: DVec3, time: f64) -> DVec3 {
    let turns = time / motion.period;
    if !turns.is_finite() {
        return position;
    }
    match &motion.path {
        MotionPath::Oscillate { amplitude } => position + DVec3::from(*amplitude) * (TAU * turns).sin(),
        MotionPath::Circle { center, axis } => {
            let center = DVec3::from(*center);
            let axis = unit(DVec3::from(*axis)).unwrap_or(DVec3::Y);
            center + DQuat::from_axis_angle(axis, TAU * turns) * (position - center)
        }
        MotionPath::Path { points } => along(points, turns - turns.floor(), position),
    }
}

/// The point at `share` in [0, 1) of the closed path's length: constant speed.
fn along(points: &[[f64; 3]], share: f64, position: DVec3) -> DVec3 {
    let point = |i: usize| DVec3::from(points[i % points.len()]);
    let lengths: Vec<f64> = (0..points.len()).map(|i| point(i).distance(point(i + 1))).collect();
    let mut left = share * lengths.iter().sum::<f64>();
    for (i, &length) in lengths.iter().enumerate() {
        if left < length {
            return point(i).lerp(point(i + 1), left / length);
        }
        left -= length;
    }
    points.first().map_or(position, |&p| p.into())
}
