//! Scenes whose answers are known on paper.
#![allow(clippy::unwrap_used, missing_docs)]

mod common;

use common::*;
use glam::{DMat4, DQuat, DVec3};
use gonio_light::{Attenuation, Light, LightKind, Quantity};
use gonio_reference::ReferenceScene;
use gonio_scene::Maps;
use gonio_scene::scene_file::Shading;

/// f32 of the picture.
const ROUNDING: f64 = 1e-6;

/// The point at which the ray through a pixel's centre meets the plane through `p` with normal `n`.
fn on_plane(lab: &TestScene, x: u32, y: u32, p: DVec3, n: DVec3) -> DVec3 {
    let c = &lab.frame.camera;
    let d = c.ray_direction(f64::from(x) + 0.5, f64::from(y) + 0.5, lab.frame.width, lab.frame.height);
    c.position + d * ((p - c.position).dot(n) / d.dot(n))
}

#[test]
fn the_unit_sphere_under_one_directional_light() {
    let l = DVec3::new(0.5, 0.7, 1.0).normalize();
    let lab = TestScene::new()
        .object(sphere(200, 200), Shading::Phong, matte([0.5; 3]))
        .light(directional([-l.x, -l.y, -l.z], 0.8));
    let picture = lab.draw().picture;
    let mut compared = 0;
    for y in 0..33 {
        for x in 0..33 {
            let c = &lab.frame.camera;
            let d = c.ray_direction(f64::from(x) + 0.5, f64::from(y) + 0.5, 33, 33);
            // The nearer root of |position + t d| = 1, where it is well inside of the silhouette.
            let (b, q) = (c.position.dot(d), c.position.length_squared() - 1.0);
            if b * b - q < 0.05 {
                continue;
            }
            let n = c.position + d * (-b - (b * b - q).sqrt());
            let expected = 0.5 * 0.8 * n.dot(l).max(0.0);
            let value = f64::from(picture.at(x, y)[1]);
            // Set by the tessellation: 200 segments, sagitta 1.2e-4, seen at up to 77 degrees.
            assert!(near(value, expected, 1e-3), "{x},{y}: {value} {expected}");
            compared += 1;
        }
    }
    assert!(compared > 100, "{compared}");
    // At the centre, lit from the eye, N.L is 1.
    let centre = TestScene::new()
        .object(sphere(64, 64), Shading::Phong, matte([0.5; 3]))
        .light(directional([0.0, 0.0, -1.0], 0.8));
    assert!(near(centre.middle()[0], 0.4, ROUNDING));
}

#[test]
fn inverse_square_at_three_distances() {
    for distance in [1.0, 2.0, 4.0] {
        let lab = TestScene::new().object(square(2.0, 0.0), Shading::Phong, matte([0.5; 3])).light(point(
            [0.0, 0.0, distance],
            3.0,
            Attenuation::INVERSE_SQUARE,
        ));
        let value = lab.middle()[0];
        assert!(near(value, 0.5 * 3.0 / (distance * distance), ROUNDING), "{distance}: {value}");
    }
}

#[test]
fn the_edge_of_a_spot() {
    let (inner, outer) = (10f64.to_radians(), 20f64.to_radians());
    let light = Light {
        kind: LightKind::Spot {
            position: DVec3::new(0.0, 0.0, 3.0),
            axis: DVec3::NEG_Z,
            inner_rad: inner,
            outer_rad: outer,
        },
        color: DVec3::ONE,
        attenuation: Attenuation::NONE,
    };
    let lab = TestScene::new().object(square(3.0, 0.0), Shading::Phong, matte([0.5; 3])).light(light);
    let picture = lab.draw().picture;
    let (mut full, mut half, mut none) = (0, 0, 0);
    for x in 0..33 {
        let p = on_plane(&lab, x, 16, DVec3::ZERO, DVec3::Z);
        let angle = (p.x.abs() / 3.0).atan();
        let t = ((angle.cos() - outer.cos()) / (inner.cos() - outer.cos())).clamp(0.0, 1.0);
        let spot = t * t * (3.0 - 2.0 * t);
        let value = f64::from(picture.at(x, 16)[0]);
        assert!(near(value, 0.5 * angle.cos() * spot, ROUNDING), "{x}: {value}");
        match spot {
            s if s >= 1.0 => full += 1,
            s if s <= 0.0 => none += 1,
            _ => half += 1,
        }
    }
    assert!(full > 2 && half > 2 && none > 2, "{full} {half} {none}");
}

/// A triangle that leans away from the eye, each corner with a normal of its own: the light is linear on the triangle, not in the
/// picture.
#[test]
fn gouraud_on_one_triangle_is_linear_in_space() {
    let corners = [DVec3::new(-1.5, -1.0, 2.0), DVec3::new(2.0, -1.5, -3.0), DVec3::new(0.0, 2.0, -1.0)];
    let normals =
        [DVec3::new(0.2, 0.1, 1.0), DVec3::new(-0.5, 0.3, 1.0), DVec3::new(0.0, -0.7, 0.6)].map(DVec3::normalize);
    let f32s = |v: DVec3| v.to_array().map(|x| x as f32);
    let mesh = mesh(&corners.map(f32s), &normals.map(f32s), &[0, 1, 2]);
    let light = DVec3::new(1.0, 2.0, 4.0);
    let lab = TestScene::new()
        .object(mesh, Shading::Gouraud, matte([0.5; 3]))
        .light(point([1.0, 2.0, 4.0], 1.0, Attenuation::NONE))
        .frame(|f| f.background.transparent = true);
    let at_corner: [f64; 3] = std::array::from_fn(|i| normals[i].dot((light - corners[i]).normalize()).max(0.0));
    let picture = lab.draw().picture;
    let area = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    let mut inside = 0;
    for y in 0..33 {
        for x in 0..33 {
            let p = on_plane(&lab, x, y, corners[0], area);
            let weight = |a: DVec3, b: DVec3| (a - p).cross(b - p).dot(area) / area.length_squared();
            let w = [weight(corners[1], corners[2]), weight(corners[2], corners[0]), weight(corners[0], corners[1])];
            let pixel = picture.at(x, y).map(f64::from);
            if w.iter().all(|&w| w > 1e-9) {
                let expected = 0.5 * (w[0] * at_corner[0] + w[1] * at_corner[1] + w[2] * at_corner[2]);
                // f32 of normals and picture.
                assert!(near(pixel[0], expected, ROUNDING) && pixel[3] == 1.0, "{x},{y}: {pixel:?} {expected}");
                inside += 1;
            } else if w.iter().any(|&w| w < -1e-9) {
                assert_eq!(pixel, [0.0; 4], "{x},{y}");
            }
        }
    }
    assert!(inside > 80, "{inside}");
}

#[test]
fn flat_is_one_value_per_triangle_and_phong_is_not() {
    let l = DVec3::new(0.3, 0.5, 1.0).normalize();
    let of = |shading| {
        TestScene::new().object(sphere(6, 8), shading, matte([0.5; 3])).light(directional([-l.x, -l.y, -l.z], 1.0))
    };
    let flat = of(Shading::Flat);
    let (flat_picture, phong_picture) = (flat.draw().picture, of(Shading::Phong).draw().picture);
    let reference = ReferenceScene::new(&flat.scene);
    let mesh = &flat.scene.meshes[0];
    let (mut compared, mut others) = (0, 0);
    for y in 0..33 {
        for x in 0..33 {
            let Some(probe) = reference.probe(&flat.frame, x, y) else { continue };
            let [a, b, c] = mesh.triangle_positions(probe.triangle).map(|p| p.as_dvec3());
            let expected = 0.5 * (b - a).cross(c - a).normalize().dot(l).max(0.0);
            let value = f64::from(flat_picture.at(x, y)[0]);
            assert!(near(value, expected, ROUNDING), "{x},{y}: {value} {expected}");
            compared += 1;
            others += usize::from((f64::from(phong_picture.at(x, y)[0]) - expected).abs() > 0.01);
        }
    }
    assert!(compared > 100 && others > 50, "{compared} {others}");
}

/// Under a point light flat shading varies over a triangle; per face it has the centroid's value everywhere.
#[test]
fn flat_per_face_is_evaluated_at_the_centroid() {
    let mesh = mesh(&[[-2.0, -2.0, 0.0], [2.0, -2.0, 0.0], [0.0, 2.0, 0.0]], &[[0.0, 0.0, 1.0]; 3], &[0, 1, 2]);
    let of = |shading| {
        TestScene::new().object(mesh.clone(), shading, matte([0.5; 3])).light(point(
            [0.0, 0.0, 1.0],
            1.0,
            Attenuation::INVERSE_SQUARE,
        ))
    };
    // From the centroid (0, -2/3, 0) the light at (0, 0, 1) is sqrt(13)/3 away; N.L = 3/sqrt(13).
    let d = 13f64.sqrt() / 3.0;
    let expected = 0.5 / (d * d) / d;
    let picture = of(Shading::FlatPerFace).draw().picture;
    for (x, y) in [(16, 16), (16, 20), (12, 20), (20, 20), (16, 8)] {
        let value = f64::from(picture.at(x, y)[0]);
        assert!(near(value, expected, ROUNDING), "{x},{y}: {value} {expected}");
    }
    let flat = of(Shading::Flat).draw().picture;
    assert!(near(f64::from(flat.at(16, 16)[0]), 0.5, ROUNDING) && flat.at(16, 20)[0] < 0.4);
}

/// The normal of an ellipsoid at M q is M^-T q.
#[test]
fn normals_are_carried_by_the_inverse_transpose() {
    let turn = DQuat::from_euler(glam::EulerRot::XYZ, 0.4, -0.7, 0.3);
    for scale in [DVec3::new(1.4, 0.5, 0.9), DVec3::new(-1.4, 0.5, 0.9)] {
        let m = DMat4::from_scale_rotation_translation(scale, turn, DVec3::new(0.1, -0.2, 0.3));
        for shading in [Shading::Phong, Shading::Flat] {
            let lab = TestScene::new().placed(sphere(300, 300), shading, matte([0.5; 3]), Maps::default(), m);
            let (normals, positions) = (lab.show(Quantity::Normal).picture, lab.show(Quantity::Position).picture);
            let mut compared = 0;
            for (n, p) in normals.pixels.iter().zip(&positions.pixels).filter(|(n, _)| n[3] == 1.0) {
                let vector = |v: &[f32; 4]| DVec3::new(v[0].into(), v[1].into(), v[2].into());
                let q = m.inverse().transform_point3(vector(p)).normalize();
                let expected = m.inverse().transpose().transform_vector3(q).normalize();
                // Set by the tessellation: a facet spans 1/300 of half a turn, and the scales stretch it.
                let tolerance = if shading == Shading::Flat { 0.05 } else { 1e-3 };
                assert!(vector(n).distance(expected) < tolerance, "{:?} {expected}", vector(n));
                compared += 1;
            }
            assert!(compared > 80, "{compared}");
        }
    }
}

#[test]
fn position_and_depth_are_those_of_the_ray() {
    let m = DMat4::from_rotation_x(-0.9);
    let lab = TestScene::new()
        .placed(square(5.0, 0.0), Shading::Phong, matte([0.5; 3]), Maps::default(), m)
        .eye([0.3, 0.5, 4.0], [0.0, 0.2, 0.0]);
    let n = m.transform_vector3(DVec3::Z);
    let (positions, depths) = (lab.show(Quantity::Position).picture, lab.show(Quantity::Depth).picture);
    for (x, y) in [(16, 16), (3, 5), (30, 28), (0, 32)] {
        let expected = on_plane(&lab, x, y, DVec3::ZERO, n);
        let p = positions.at(x, y).map(f64::from);
        assert!(DVec3::new(p[0], p[1], p[2]).distance(expected) < 1e-5, "{p:?} {expected}");
        let depth = (expected - lab.frame.camera.position).dot(lab.frame.camera.front);
        assert!(near(f64::from(depths.at(x, y)[0]), depth, 1e-5));
    }
}

/// The shadow of a square of half size 1 at z = 2 on the plane z = 0.
#[test]
fn a_square_casts_the_shadow_of_its_projection() {
    let lamp = |z: f64| point([0.5, 0.3, z], 1.0, Attenuation::NONE);
    let sun = directional([1.0, 0.5, -1.0], 1.0);
    // A lamp between the plane and the square, and a square that lets most of the light through, cast none.
    for (light, opacity, casts) in
        [(sun, 1.0, true), (lamp(4.0), 1.0, true), (lamp(1.0), 1.0, false), (sun, 0.4, false)]
    {
        let sheet = gonio_mesh::Material { opacity, ..matte([0.5; 3]) };
        let lab = TestScene::new()
            .object(square(8.0, 0.0), Shading::Phong, matte([0.5; 3]))
            .object(square(1.0, 2.0), Shading::Phong, sheet)
            .light(ambient(0.1))
            .light(light)
            .eye([2.0, 1.0, 12.0], [1.0, 0.5, 0.0])
            .frame(|frame| frame.shadows = true);
        let reference = ReferenceScene::new(&lab.scene);
        let (mut lit, mut dark) = (0, 0);
        for (x, y) in (0..33).flat_map(|y| (0..33).map(move |x| (x, y))) {
            let Some(probe) = reference.probe(&lab.frame, x, y).filter(|probe| probe.object == 0) else { continue };
            let terms = probe.terms.lights[0];
            let t = 2.0 / terms.l.z;
            let crossing = probe.position + t * terms.l;
            let reach = crossing.truncate().abs().max_element();
            if (reach - 1.0).abs() < 1e-9 {
                // The very edge may be lit or dark.
                continue;
            }
            let expected = !(casts && t < terms.distance && reach < 1.0);
            assert_eq!(terms.visibility, if expected { 1.0 } else { 0.0 }, "{light:?} at {}", probe.position);
            // Ambient light stays.
            let share = if expected { terms.cos_theta * terms.spot } else { 0.0 };
            assert!(near(probe.radiance.x, 0.5 * (0.1 + share), 1e-6), "{} {share}", probe.radiance);
            if expected { lit += 1 } else { dark += 1 }
        }
        assert!(lit > 50 && (dark > 10) == casts, "{light:?}: {lit} lit, {dark} dark");
    }
}
