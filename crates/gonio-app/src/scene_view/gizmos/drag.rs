//! The geometry of dragging: from a place in the window to a place in the scene.

use crate::scene_view::Projection;
use egui::Pos2;
use glam::DVec3;
use gonio_light::vector::unit;
use gonio_scene::frame::position_at;
use gonio_scene::settings::{LightSettings, MotionPath};

/// Sine of the viewing angle below which an axis cannot be dragged, because a point of the window would be too long on it.
const END_ON: f64 = 0.05;

/// The point under `place` on the plane through `start` that is parallel to the picture.
pub fn in_screen_plane(projection: &Projection, start: DVec3, place: Pos2) -> DVec3 {
    let camera = projection.camera();
    let direction = projection.direction(place);
    // Every direction through the picture has a part along the view.
    camera.position + direction * (camera.depth_of(start) / direction.dot(camera.front))
}

/// Moves `start` away from the eye (positive `points`) or nearer, so that its place in the picture stays. A hundred points double
/// or halve the distance.
pub fn along_view(projection: &Projection, start: DVec3, points: f32) -> DVec3 {
    let eye = projection.camera().position;
    eye + (start - eye) * (f64::from(points) / 100.0).exp2()
}

/// The point of the line from `start` along `axis` (unit) that is nearest to the ray through `place`; `None` if the axis is nearly
/// parallel to the view, or that point is behind the eye.
pub fn along_axis(projection: &Projection, start: DVec3, axis: DVec3, place: Pos2) -> Option<DVec3> {
    let camera = projection.camera();
    let ray = projection.direction(place);
    let from_eye = start - camera.position;
    let cosine = axis.dot(ray);
    let sine_squared = 1.0 - cosine * cosine;
    if sine_squared < END_ON * END_ON {
        return None;
    }
    let t = (cosine * ray.dot(from_eye) - axis.dot(from_eye)) / sine_squared;
    let point = start + t * axis;
    (camera.depth_of(point) > 0.05 * camera.near).then_some(point)
}

/// The direction (unit) from `center` to the point under `place` on a sphere of `radius`, on its near or far side. Beside the
/// sphere it is the nearest point of its outline.
pub fn on_sphere(projection: &Projection, center: DVec3, radius: f64, place: Pos2, far_side: bool) -> DVec3 {
    let eye = projection.camera().position;
    let ray = projection.direction(place);
    let middle = (center - eye).dot(ray);
    let closest = eye + ray * middle;
    let beside = closest.distance(center);
    if beside >= radius {
        return unit(closest - center).unwrap_or(-ray);
    }
    let half_chord = (radius * radius - beside * beside).sqrt();
    let point = closest + ray * if far_side { half_chord } else { -half_chord };
    unit(point - center).unwrap_or(-ray)
}

/// Moves a light so that it is at `target` at `time`. A moving light keeps its motion: the start of a circle or of an oscillation
/// follows, a path is shifted as a whole.
pub fn place_light(spec: &mut LightSettings, target: DVec3, time: f64) {
    let position = DVec3::from(spec.position.unwrap_or_default());
    let Some(motion) = &mut spec.motion else {
        spec.position = Some(target.to_array());
        return;
    };
    let way = target - position_at(motion, position, time);
    match &mut motion.path {
        // Both are undone by the same motion at the opposite time.
        MotionPath::Oscillate { .. } | MotionPath::Circle { .. } => {
            spec.position = Some(position_at(motion, target, -time).to_array());
        }
        MotionPath::Path { points } => {
            for point in points {
                *point = (DVec3::from(*point) + way).to_array();
            }
            spec.position = Some((position + way).to_array());
        }
    }
}

/// Rounds a point to readable numbers, finer than half of `unit`, the size of a point of the window there.
pub fn tidy(point: DVec3, unit: f64) -> DVec3 {
    let decimals = -(0.5 * unit).log10().floor();
    if !(-12.0..=12.0).contains(&decimals) {
        return point;
    }
    // Dividing by a power of ten, and not multiplying by a tenth, gives the shortest decimals.
    let power = 10f64.powi(decimals.abs() as i32);
    let round = |v: f64| if decimals >= 0.0 { (v * power).round() / power } else { (v / power).round() * power };
    // A zero without sign prints better.
    DVec3::new(round(point.x), round(point.y), round(point.z)) + DVec3::ZERO
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::{Rect, pos2};
    use gonio_scene::Camera;
    use gonio_scene::scene_file::LightSourceKind;
    use gonio_scene::settings::Motion;

    /// A random generator with a fixed seed (SplitMix64).
    struct Random(u64);

    impl Random {
        fn next(&mut self) -> f64 {
            self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
            let mut z = self.0;
            z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
            z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
            ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
        }

        fn vector(&mut self) -> DVec3 {
            DVec3::new(self.next() - 0.5, self.next() - 0.5, self.next() - 0.5)
        }

        fn projection(&mut self) -> Projection {
            let position = 6.0 * self.vector() + DVec3::new(0.0, 0.0, 8.0);
            let camera =
                Camera::looking_along(position, self.vector() - position, DVec3::Y, 0.3 + self.next(), 0.1, 100.0);
            Projection::new(&camera, Rect::from_min_max(pos2(60.0, 40.0), pos2(900.0, 640.0)))
        }

        fn place(&mut self) -> Pos2 {
            pos2(60.0 + 840.0 * self.next() as f32, 40.0 + 600.0 * self.next() as f32)
        }
    }

    /// Tolerance in points of the window.
    const POINT: f32 = 0.5;

    #[test]
    fn a_dragged_point_is_under_the_pointer() {
        let mut random = Random(1);
        for round in 0..500 {
            let projection = random.projection();
            let (start, place) = (3.0 * random.vector(), random.place());
            let dragged = in_screen_plane(&projection, start, place);
            let seen = projection.to_window(dragged).unwrap_or_else(|| panic!("round {round}: behind the eye"));
            assert!(seen.distance(place) < POINT, "round {round}: {seen} for {place}");
            // Parallel to the picture.
            let depth = |p: DVec3| projection.camera().depth_of(p);
            assert!((depth(dragged) - depth(start)).abs() < 1e-9);
            // Readable numbers are as near.
            let tidied = tidy(dragged, projection.units_per_point(dragged));
            let seen = projection.to_window(tidied).unwrap_or_else(|| panic!("round {round}: behind the eye"));
            assert!(seen.distance(place) < 2.0 * POINT, "round {round}: {tidied} is seen at {seen} for {place}");
        }
    }

    #[test]
    fn a_drag_along_an_axis_stays_nearest_to_the_pointer() {
        let mut random = Random(2);
        let mut done = 0;
        for _ in 0..500 {
            let projection = random.projection();
            let (start, place) = (3.0 * random.vector(), random.place());
            let axis = DVec3::AXES[done % 3];
            let Some(dragged) = along_axis(&projection, start, axis, place) else { continue };
            done += 1;
            assert!((dragged - start).cross(axis).length() < 1e-9, "{dragged} has left the axis");
            // No other point of the line is nearer to the ray.
            let ray = projection.direction(place);
            let away = |p: DVec3| (p - projection.camera().position).cross(ray).length();
            for step in [-1e-3, 1e-3] {
                assert!(away(dragged + step * axis) >= away(dragged), "a step of {step} comes nearer");
            }
        }
        assert!(done > 300, "only {done} axes could be dragged");
    }

    #[test]
    fn a_drag_along_the_view_keeps_the_place_in_the_picture() {
        let mut random = Random(3);
        for _ in 0..200 {
            let projection = random.projection();
            let start = random.vector();
            let (near, far) = (along_view(&projection, start, -50.0), along_view(&projection, start, 50.0));
            let seen = |p: DVec3| projection.to_window(p).unwrap_or_else(|| panic!("{p} is behind the eye"));
            assert!(seen(near).distance(seen(start)) < POINT && seen(far).distance(seen(start)) < POINT);
            let distance = |p: DVec3| p.distance(projection.camera().position);
            assert!((distance(far) / distance(near) - 2.0).abs() < 1e-9);
        }
    }

    #[test]
    fn a_dragged_direction_is_under_the_pointer() {
        let mut random = Random(4);
        let mut inside = 0;
        for _ in 0..500 {
            let projection = random.projection();
            let (center, radius, place) = (random.vector(), 0.5 + random.next(), random.place());
            for far_side in [false, true] {
                let direction = on_sphere(&projection, center, radius, place, far_side);
                assert!((direction.length() - 1.0).abs() < 1e-9);
                let eye = projection.camera().position;
                let point = center + radius * direction;
                let ray = projection.direction(place);
                if (center - eye).cross(ray).length() < radius {
                    inside += 1;
                    let seen = projection.to_window(point).unwrap_or_else(|| panic!("{point} is behind the eye"));
                    assert!(seen.distance(place) < POINT, "{seen} for {place}");
                    let beyond = (point - eye).length() > (center - eye).dot(ray);
                    assert_eq!(beyond, far_side);
                }
            }
        }
        assert!(inside > 100, "only {inside} places were on the sphere");
    }

    #[test]
    fn a_moving_light_is_where_it_was_put() {
        let mut random = Random(5);
        let motions = [
            MotionPath::Oscillate { amplitude: [0.3, 1.0, -0.4] },
            MotionPath::Circle { center: [0.2, 0.1, 0.0], axis: [0.0, 1.0, 0.0] },
            MotionPath::Path { points: vec![[0.0; 3], [1.0, 0.0, 0.0], [1.0, 2.0, 0.0]] },
        ];
        for path in motions {
            for _ in 0..20 {
                let motion = Motion { period: 2.0 + random.next(), path: path.clone() };
                let mut spec = LightSettings {
                    position: Some(random.vector().to_array()),
                    motion: Some(motion),
                    ..LightSettings::new(LightSourceKind::Point)
                };
                let (target, time) = (random.vector(), 5.0 * random.next());
                place_light(&mut spec, target, time);
                let motion = spec.motion.as_ref().unwrap_or_else(|| panic!("it still moves"));
                let now = position_at(motion, spec.position.unwrap_or_default().into(), time);
                // Rounding only.
                assert!(now.distance(target) < 1e-9, "{path:?}: {now} for {target}");
            }
        }
    }

    #[test]
    fn numbers_are_short() {
        assert_eq!(tidy(DVec3::new(0.123456, -2.0004, 30.06), 0.02), DVec3::new(0.12, -2.0, 30.06));
        assert_eq!(tidy(DVec3::new(1234.5, -0.4, 999.6), 30.0), DVec3::new(1230.0, 0.0, 1000.0));
    }
}
