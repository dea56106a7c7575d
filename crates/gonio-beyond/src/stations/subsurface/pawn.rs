//! The body: a chess pawn of height 1, as a signed distance.

use glam::{DVec2, DVec3};

/// The distance to a pawn that stands at the origin, negative inside; never more than the true distance.
pub fn pawn(at: DVec3) -> f64 {
    let place = DVec2::new(DVec2::new(at.x, at.z).length(), at.y);
    // Beyond its hull the exact distance is not needed.
    let hull = (place.x - 0.32).max(place.y - 1.02);
    if hull > 0.3 {
        return hull;
    }
    let foot = slab(place, 0.045, DVec2::new(0.285, 0.02), 0.025);
    let ring = slab(place, 0.135, DVec2::new(0.215, 0.01), 0.032);
    let stem = cone(place - DVec2::new(0.0, 0.14), 0.185, 0.082, 0.46);
    let collar = slab(place, 0.655, DVec2::new(0.135, 0.004), 0.022);
    let head = (place - DVec2::new(0.0, 0.825)).length() - 0.165;
    let base = join(join(foot, ring, 0.03), stem, 0.05);
    0.95 * join(join(base, collar, 0.05), head, 0.035)
}

/// The outward normal.
pub fn pawn_normal(at: DVec3) -> DVec3 {
    const STEP: f64 = 1e-4;
    let along = |axis: DVec3| pawn(at + axis * STEP) - pawn(at - axis * STEP);
    DVec3::new(along(DVec3::X), along(DVec3::Y), along(DVec3::Z)).normalize_or(DVec3::Y)
}

/// A disc of half the size `half` at a height, rounded.
fn slab(at: DVec2, height: f64, half: DVec2, round: f64) -> f64 {
    let q = DVec2::new(at.x, (at.y - height).abs()) - half;
    q.max(DVec2::ZERO).length() + q.max_element().min(0.0) - round
}

/// The hull of two spheres at the heights 0 and `length`.
fn cone(at: DVec2, low: f64, high: f64, length: f64) -> f64 {
    let slope = (low - high) / length;
    let across = (1.0 - slope * slope).sqrt();
    let place = at.dot(DVec2::new(-slope, across));
    if place < 0.0 {
        at.length() - low
    } else if place > across * length {
        (at - DVec2::new(0.0, length)).length() - high
    } else {
        at.dot(DVec2::new(across, slope)) - low
    }
}

/// The union of two shapes with a fillet.
fn join(a: f64, b: f64, fillet: f64) -> f64 {
    let near = (fillet - (a - b).abs()).max(0.0) / fillet;
    a.min(b) - near * near * fillet * 0.25
}
