//! The plane that the objects stand on, as an aid for viewers: it is no part of the scene, and no picture of a file has it.

use crate::scene::Scene;
use glam::{DVec2, DVec3};

/// A surface within this share of the scene's largest extent from its lowest point is at the bottom.
const AT_BOTTOM: f64 = 0.03;
/// The share of the scene's rectangle, seen from above, that a floor covers.
const FLOOR_SHARE: f64 = 0.5;
/// An object above its own bottom shows at least this share of the bottom's area from above; a floor's underside has less
/// above it.
const BODY_SHARE: f64 = 0.6;
/// Number of steps of the grid in the half width of the objects, about.
const STEPS: f64 = 3.0;

/// A plane through the lowest point of the objects.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GroundPlane {
    /// The plane's normal, up: an axis of the world, or its opposite.
    pub up: DVec3,
    /// The two directions of its lines: axes of the world. `right x back = -up` or `up`.
    pub axes: [DVec3; 2],
    /// `up . p` of its points.
    pub height: f64,
    /// The middle of the objects along `axes`.
    pub center: DVec2,
    /// Half of their extent along `axes`.
    pub half: DVec2,
    /// Their extent along `up`, >= 0.
    pub rise: f64,
}

impl GroundPlane {
    /// The plane below a scene's objects. `None` if there are none, if one of them is a floor (large, flat and at the bottom),
    /// or if no axis of the world points along `up`.
    pub fn below(scene: &Scene, up: DVec3) -> Option<Self> {
        let (min, max) = scene.bounds();
        let size = max - min;
        let largest = size.max_element();
        if !(largest.is_finite() && largest > 0.0) {
            return None;
        }
        let index = (0..3).find(|&i| up.normalize_or_zero()[i].abs() > 0.999)?;
        let axis = DVec3::AXES[index];
        let up = axis * up[index].signum();
        let axes = [DVec3::AXES[if index == 0 { 1 } else { 0 }], DVec3::AXES[if index == 2 { 1 } else { 2 }]];
        let along = |p: DVec3| DVec2::new(p.dot(axes[0]), p.dot(axes[1]));
        let plane = GroundPlane {
            up,
            axes,
            height: up.dot(min).min(up.dot(max)),
            center: along(0.5 * (min + max)),
            half: along(0.5 * size),
            rise: size[index],
        };
        (!plane.is_floored(scene, AT_BOTTOM * largest)).then_some(plane)
    }

    /// Whether surfaces within `tolerance` of the plane cover much of it.
    fn is_floored(&self, scene: &Scene, tolerance: f64) -> bool {
        // Areas seen along `up`: of surfaces at the bottom that face up and down, and of other surfaces that face up.
        let (mut floor, mut underside, mut above) = (0.0, 0.0, 0.0);
        for object in &scene.objects {
            let Some(mesh) = scene.meshes.get(object.mesh) else { continue };
            for triangle in 0..mesh.triangle_count() {
                let corners =
                    mesh.triangle_positions(triangle).map(|p| object.world_from_model.transform_point3(p.as_dvec3()));
                let area = 0.5 * (corners[1] - corners[0]).cross(corners[2] - corners[0]).dot(self.up);
                let is_low = corners.iter().all(|p| p.dot(self.up) <= self.height + tolerance);
                match (is_low, area > 0.0) {
                    (true, true) => floor += area,
                    (true, false) => underside -= area,
                    (false, true) => above += area,
                    (false, false) => {}
                }
            }
        }
        let large = FLOOR_SHARE * 4.0 * self.half.x * self.half.y;
        floor >= large || (underside >= large && above < BODY_SHARE * underside)
    }

    /// Whether an eye is above the plane, where the plane does not hide the objects.
    pub fn is_seen_from(&self, eye: DVec3) -> bool {
        eye.dot(self.up) > self.height + 1e-3 * self.extent()
    }

    /// Half of the largest extent of the objects, > 0.
    pub fn extent(&self) -> f64 {
        self.half.max_element().max(0.5 * self.rise)
    }

    /// The distance between lines of the grid, 1, 2 or 5 times a power of ten; and between stronger lines, 10 times a power of
    /// ten.
    pub fn steps(&self) -> [f64; 2] {
        let about = self.extent() / STEPS;
        let power = 10.0_f64.powf(about.log10().floor());
        let digit = [1.0, 2.0, 5.0].into_iter().rev().find(|digit| digit * power <= about * 1.001).unwrap_or(1.0);
        [digit * power, 10.0 * power]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::Disk;
    use std::path::Path;

    fn scene(objects: &[&str]) -> Scene {
        let text: String = objects.iter().map(|object| format!("[[object]]\n{object}\n")).collect();
        let file = crate::toml_file::read(&text).unwrap_or_else(|error| panic!("{error}"));
        crate::load::load(file, Path::new(""), &Disk).unwrap_or_else(|error| panic!("{error}"))
    }

    fn below(objects: &[&str]) -> Option<GroundPlane> {
        GroundPlane::below(&scene(objects), DVec3::Y)
    }

    const CUBE: &str = "model = \"builtin:cube\"";
    const FLOOR: &str = "model = \"builtin:cube\"\nscale = [9.0, 0.01, 9.0]\ntranslate = [0.0, -0.51, 0.0]";

    #[test]
    fn the_plane_is_below_the_objects() {
        let plane = below(&[CUBE, "model = \"builtin:cube\"\ntranslate = [4.0, 3.0, 0.0]"]);
        let plane = plane.unwrap_or_else(|| panic!("two cubes are no floor"));
        let side = 2.0 * plane.half.y;
        assert_eq!((plane.up, plane.height, plane.rise), (DVec3::Y, -0.5 * side, side + 3.0));
        assert_eq!((plane.center, plane.half.x), (DVec2::new(2.0, 0.0), 0.5 * (side + 4.0)));
        assert!(plane.is_seen_from(DVec3::ZERO) && !plane.is_seen_from(DVec3::NEG_Y * side));
        let sideways = GroundPlane::below(&scene(&[CUBE]), DVec3::NEG_Z).unwrap_or_else(|| panic!("an axis"));
        assert_eq!((sideways.up, sideways.axes), (DVec3::NEG_Z, [DVec3::X, DVec3::Y]));
        assert_eq!(GroundPlane::below(&scene(&[CUBE]), DVec3::ONE), None, "no axis is up");
    }

    #[test]
    fn a_scene_with_a_floor_needs_no_plane() {
        assert_eq!(below(&[CUBE, FLOOR]), None);
        assert_eq!(below(&[FLOOR]), None, "a plate alone");
        let flipped = FLOOR.replace("0.01", "-0.0001");
        assert_eq!(below(&[CUBE, &flipped]), None, "its faces may look down");
        assert!(below(&[CUBE, &FLOOR.replace("9.0", "0.1")]).is_some(), "a small plate");
        assert!(below(&[CUBE, &FLOOR.replace("-0.51", "0.51")]).is_some(), "a ceiling");
    }

    #[test]
    fn lines_are_at_round_distances() {
        let steps = |size: f64| {
            let cube = format!("{CUBE}\nscale = [{size}, {size}, {size}]");
            below(&[&cube]).map(|plane| plane.steps().map(|step| (step * 1e6).round() / 1e6))
        };
        let side = 2.0 * below(&[CUBE]).map_or(0.0, |plane| plane.extent());
        assert_eq!(steps(6.0 / side), Some([1.0, 10.0]));
        assert_eq!(steps(13.0 / side), Some([2.0, 10.0]));
        assert_eq!(steps(59.0 / side), Some([5.0, 10.0]));
        assert_eq!(steps(0.6 / side), Some([0.1, 1.0]));
    }
}
