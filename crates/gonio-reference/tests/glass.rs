//! Refraction in the pictures: Snell's law at one surface, and whole bodies that paper knows.
#![allow(clippy::unwrap_used, missing_docs)]

mod common;

use common::*;
use glam::{DMat4, DVec3};
use gonio_environment::Cubemap;
use gonio_light::optics::{MOST_MEETINGS, boundary};
use gonio_light::{Fresnel, Optics, Surfaces};
use gonio_mesh::{Material, Mesh};
use gonio_reference::ReferenceScene;
use gonio_scene::Maps;
use gonio_scene::scene_file::Shading;

/// f32 of texels and of the picture.
const ROUNDING: f64 = 1e-6;

/// Clear, without reflection.
fn clear(surfaces: Surfaces) -> Optics {
    Optics { transmission: 1.0, surfaces, ..Optics::default() }
}

fn pixels() -> impl Iterator<Item = (u32, u32)> {
    (0..33).flat_map(|y| (0..33).map(move |x| (x, y)))
}

/// A closed mesh of flat faces: each polygon counter-clockwise from outside.
fn faces(polygons: &[&[[f32; 3]]]) -> Mesh {
    let (mut positions, mut normals, mut indices) = (Vec::new(), Vec::new(), Vec::new());
    for polygon in polygons {
        let p = |i: usize| DVec3::from(polygon[i].map(f64::from));
        let n = (p(1) - p(0)).cross(p(2) - p(0)).normalize().to_array().map(|v| v as f32);
        let first = positions.len() as u32;
        for i in 2..polygon.len() as u32 {
            indices.extend([first, first + i - 1, first + i]);
        }
        positions.extend_from_slice(polygon);
        normals.extend(polygon.iter().map(|_| n));
    }
    mesh(&positions, &normals, &indices)
}

#[test]
fn one_surface_bends_by_snells_law() {
    for index in [1.0_f32, 1.309, 1.33, 1.52, 2.42] {
        let index64 = f64::from(index);
        for lean in [0.0, 0.5, -1.1] {
            let m = DMat4::from_rotation_y(lean);
            let lab = TestScene::new()
                .placed(square(50.0, 0.0), Shading::Phong, Material::default(), Maps::default(), m)
                .optics(clear(Surfaces::One))
                .index(index)
                .environment(compass());
            let n = m.transform_vector3(DVec3::Z);
            let picture = lab.draw().picture;
            let mut compared = 0;
            for (x, y) in pixels() {
                let d = ray_of(&lab, x, y);
                // In the plane of ray and normal: the angle's sine divided by the index, going on.
                let across = d - d.dot(n) * n;
                let sine = across.length() / index64;
                let bent = sine * across.normalize_or_zero() - (1.0 - sine * sine).sqrt() * n;
                if d.dot(n) > -0.1 || !is_exact(bent) {
                    continue;
                }
                let got = rgb(picture.at(x, y)).normalize();
                assert!(got.abs_diff_eq(bent, ROUNDING), "{index} {lean} {x},{y}: {got} is not {bent}");
                compared += 1;
            }
            assert!(compared > 500, "{compared}");
        }
    }
}

#[test]
fn colours_are_bent_by_indices_of_their_own() {
    let optics = Optics { dispersion: 0.4, tint: DVec3::new(0.5, 1.0, 0.25), ..clear(Surfaces::One) };
    let lab = TestScene::new()
        .object(square(50.0, 0.0), Shading::Phong, Material::default())
        .optics(optics)
        .index(1.5)
        .environment(compass())
        .eye([5.0, 0.0, 5.0], [0.0, 0.0, 0.0]);
    // At 45 degrees towards -X; ahead of the pane it is -Z that is largest.
    let got = lab.middle();
    for (channel, (index, tint)) in [(1.3_f64, 0.5), (1.5, 1.0), (1.7, 0.25)].into_iter().enumerate() {
        let sine = 0.5_f64.sqrt() / index;
        let expected = on_cube(DVec3::new(-sine, 0.0, -(1.0 - sine * sine).sqrt()));
        assert!(near(got[channel], tint * expected[channel], ROUNDING), "{channel}: {got:?}");
    }
    // The channels differ only in x: each colour alone.
    for (channel, index) in [1.3_f64, 1.5, 1.7].into_iter().enumerate() {
        let lab = lab_of_x(&lab);
        let sine = 0.5_f64.sqrt() / index;
        let expected = 1.0 - on_cube(DVec3::new(-sine, 0.0, -(1.0 - sine * sine).sqrt())).x;
        let tint = [0.5, 1.0, 0.25][channel];
        assert!(near(lab.middle()[channel], tint * expected, ROUNDING), "{channel}: {:?}", lab.middle());
    }
}

/// The same with an environment that is 1 - x on the cube, in all channels.
fn lab_of_x(lab: &TestScene) -> TestScene {
    let scene = lab.scene.clone();
    let map = Cubemap::from_function(COMPASS_SIZE, |d| DVec3::splat(1.0 - on_cube(d).x));
    TestScene { scene, frame: lab.frame.clone() }.environment(map)
}

#[test]
fn a_ball_turns_the_view_as_on_paper() {
    let ball = |m: DMat4| {
        TestScene::new()
            .placed(sphere(160, 160), Shading::Phong, Material::default(), Maps::default(), m)
            .closed()
            .optics(clear(Surfaces::Two))
            .index(1.5)
            .environment(compass())
    };
    // The second is inside out twice: its matrix mirrors.
    for m in [DMat4::IDENTITY, DMat4::from_scale(DVec3::new(-1.0, 1.0, 1.0))] {
        let lab = ball(m);
        let picture = lab.draw().picture;
        let mut compared = 0;
        for (x, y) in pixels() {
            let (eye, d) = (lab.frame.camera.position, ray_of(&lab, x, y));
            let away = eye - d * eye.dot(d);
            let sine = away.length();
            if sine > 0.9 {
                continue;
            }
            // Towards the axis, by twice what one surface turns; both angles inside are equal.
            let turned = 2.0 * (sine.asin() - (sine / 1.5).asin());
            let expected = turned.cos() * d - turned.sin() * away.normalize_or_zero();
            let got = rgb(picture.at(x, y)).normalize();
            // Set by the tessellation: chords of 2 degrees.
            assert!(got.abs_diff_eq(expected, 2e-3), "{x},{y}: {got} is not {expected}");
            compared += 1;
        }
        assert!(compared > 150, "{compared}");
    }
    // Weakened along the diameter: exp(-2 ln 2).
    let optics = Optics { absorption: DVec3::splat(std::f64::consts::LN_2), ..clear(Surfaces::Two) };
    let value = ball(DMat4::IDENTITY).optics(optics).environment(Cubemap::new(1, [1.0; 4])).middle();
    assert!(near(value[1], 0.25, 1e-3), "{value:?}");
}

#[test]
fn a_slab_shifts_the_view_and_weakens_it() {
    // Of thickness 1 and wide enough that nothing leaves by its sides; and another behind it, of the same object, that
    // the view does not go through any more.
    let slab = faces(&[
        &[[-50.0, -50.0, 0.5], [50.0, -50.0, 0.5], [50.0, 50.0, 0.5], [-50.0, 50.0, 0.5]],
        &[[-50.0, 50.0, -0.5], [50.0, 50.0, -0.5], [50.0, -50.0, -0.5], [-50.0, -50.0, -0.5]],
        &[[-50.0, -50.0, -1.5], [50.0, -50.0, -1.5], [50.0, 50.0, -1.5], [-50.0, 50.0, -1.5]],
        &[[-50.0, 50.0, -2.5], [50.0, 50.0, -2.5], [50.0, -50.0, -2.5], [-50.0, -50.0, -2.5]],
    ]);
    let absorption = DVec3::new(0.1, 0.5, 2.0);
    let optics = Optics { absorption, tint: DVec3::new(1.0, 0.5, 1.0), ..clear(Surfaces::Two) };
    let shifted = TestScene::new()
        .object(slab, Shading::Phong, Material::default())
        .optics(optics)
        .index(1.52)
        .eye([2.0, 1.0, 4.0], [0.0, 0.0, 0.0])
        .environment(compass());
    let picture = shifted.draw().picture;
    let mut compared = 0;
    for (x, y) in pixels() {
        let d = ray_of(&shifted, x, y);
        let cos_inside = (1.0 - (1.0 - d.z * d.z) / (1.52 * 1.52)).sqrt();
        let expected = on_cube(d) * optics.tint * (-absorption / cos_inside).exp();
        if is_exact(d) {
            let got = rgb(picture.at(x, y));
            // The index is an f32 in the scene.
            assert!(got.abs_diff_eq(expected, ROUNDING), "{x},{y}: {got} is not {expected}");
            compared += 1;
        }
    }
    assert!(compared > 500, "{compared}");
}

/// A prism along X whose hypotenuse, at z = 0, looks at the eye; its legs meet at z = -2 under a right angle.
fn prism() -> Mesh {
    let [a, b, c] = [[2.0_f32, 0.0], [-2.0, 0.0], [0.0, -2.0]]; // y and z of the upper, the lower, the hind edge
    let at = |x: f32, [y, z]: [f32; 2]| [x, y, z];
    let (l, r) = (-3.0, 3.0);
    faces(&[
        &[at(l, a), at(l, b), at(r, b), at(r, a)],
        &[at(l, a), at(r, a), at(r, c), at(l, c)],
        &[at(l, c), at(r, c), at(r, b), at(l, b)],
        &[at(l, a), at(l, c), at(l, b)],
        &[at(r, a), at(r, b), at(r, c)],
    ])
}

#[test]
fn a_right_angled_prism_sends_the_view_back() {
    for shading in [Shading::Flat, Shading::Phong] {
        let lab = TestScene::new()
            .object(prism(), shading, Material::default())
            .closed()
            .optics(clear(Surfaces::Two))
            .index(1.52)
            // Not level with the hind edge, where three surfaces meet in no distance.
            .eye([0.0, 0.3, 5.0], [0.0, 0.3, 0.0])
            .environment(compass());
        let picture = lab.draw().picture;
        let mut compared = 0;
        for (x, y) in pixels() {
            let d = ray_of(&lab, x, y);
            // Reflection is total at the legs up to 5.9 degrees from the normal, across the prism.
            if d.y.abs() > 5f64.to_radians().sin() || d.x.abs() > 0.1 {
                continue;
            }
            let expected = on_cube(DVec3::new(d.x, -d.y, -d.z));
            let got = rgb(picture.at(x, y));
            assert!(got.abs_diff_eq(expected, ROUNDING), "{shading} {x},{y}: {got} is not {expected}");
            compared += 1;
        }
        assert!(compared > 50, "{shading}: {compared}");
    }
}

#[test]
fn in_an_even_environment_glass_is_not_seen() {
    for fresnel in [Fresnel::None, Fresnel::Exact, Fresnel::Schlick] {
        for (surfaces, dispersion) in [(Surfaces::One, 0.0), (Surfaces::Two, 0.0), (Surfaces::Two, 0.1)] {
            let lab = TestScene::new()
                .object(sphere(20, 30), Shading::Phong, Material::default())
                .closed()
                .optics(Optics { fresnel, dispersion, ..clear(surfaces) })
                .environment(Cubemap::new(2, [0.25, 0.5, 1.0, 1.0]));
            for pixel in lab.draw().picture.pixels {
                // What a ray that carries less than a thousandth would have brought is lost.
                let got = rgb(pixel);
                assert!(got.abs_diff_eq(DVec3::new(0.25, 0.5, 1.0), 1.1e-3), "{fresnel} {surfaces}: {got}");
            }
        }
    }
}

/// The next point at which a ray leaves a mesh of flat faces, by testing every triangle.
fn brute_exit(triangles: &[[DVec3; 3]], origin: DVec3, direction: DVec3) -> Option<(f64, DVec3)> {
    let mut nearest: Option<(f64, DVec3)> = None;
    for [a, b, c] in triangles {
        let n = (b - a).cross(c - a).normalize();
        let distance = (a - origin).dot(n) / direction.dot(n);
        let p = origin + distance * direction;
        let inside = [(a, b), (b, c), (c, a)].iter().all(|(p0, p1)| (*p1 - *p0).cross(p - *p0).dot(n) >= 0.0);
        let counts = direction.dot(n) > 0.0 && distance > 1e-5 && inside;
        if counts && nearest.is_none_or(|(d, _)| distance < d) {
            nearest = Some((distance, n));
        }
    }
    nearest
}

#[test]
fn facets_are_met_as_brute_force_meets_them() {
    let ball = sphere(7, 11);
    let corner = |i: u32| DVec3::from(ball.positions[i as usize].map(f64::from));
    let triangles: Vec<[DVec3; 3]> = ball.indices.chunks_exact(3).map(|t| [0, 1, 2].map(|i| corner(t[i]))).collect();
    let absorption = DVec3::new(0.1, 0.2, 0.4);
    let optics = Optics { absorption, fresnel: Fresnel::Exact, ..clear(Surfaces::Two) };
    let smooth = |d: DVec3| DVec3::splat(2.0) + on_cube(d);
    let others = square(0.3, 0.0);
    let lab = TestScene::new()
        .object(ball.clone(), Shading::Flat, Material::default())
        .closed()
        .optics(optics)
        .index(1.5)
        // Inside of the ball, and not part of it.
        .object(others, Shading::Flat, matte([1.0; 3]))
        .environment(Cubemap::from_function(COMPASS_SIZE, smooth));
    let reference = ReferenceScene::new(&lab.scene);
    let (mut compared, mut most) = (0, 0);
    'pixels: for (x, y) in pixels() {
        let Some(probe) = reference.probe(&lab.frame, x, y).filter(|p| p.object == 0) else { continue };
        let n = probe.geometry.geometric_normal;
        let first = boundary(n, probe.terms.point.view, 1.5, Fresnel::Exact);
        let (mut origin, mut direction) = (probe.position, first.transmitted.unwrap());
        let (mut sum, mut weight) = (DVec3::ZERO, DVec3::ONE);
        let mut exact = is_exact(first.reflected);
        for meeting in 1..=MOST_MEETINGS {
            let (distance, n) = brute_exit(&triangles, origin, direction).unwrap();
            weight *= (-absorption * distance).exp();
            let at = boundary(n, -direction, 1.5, Fresnel::Exact);
            if let Some(out) = at.transmitted {
                sum += weight * (1.0 - at.reflectance) * smooth(out);
                exact &= is_exact(out);
            }
            weight *= at.reflectance;
            (origin, direction) = (origin + distance * direction, at.reflected);
            most = most.max(meeting);
            if weight.max_element() < gonio_light::optics::WEIGHT_THAT_COUNTS {
                weight = DVec3::ZERO;
                break;
            }
        }
        if weight != DVec3::ZERO {
            sum += weight * smooth(direction);
            exact &= is_exact(direction);
        }
        if !exact {
            continue 'pixels;
        }
        let (got, expected) = (probe.terms.environment.sight.transmitted, (1.0 - first.reflectance) * sum);
        assert!(got.abs_diff_eq(expected, ROUNDING), "{x},{y}: {got} is not {expected}");
        compared += 1;
    }
    assert!(compared > 50 && most == MOST_MEETINGS, "{compared} {most}");
}

#[test]
fn open_bodies_let_the_view_go() {
    let of = |surfaces| {
        TestScene::new()
            .object(square(9.0, 0.0), Shading::Phong, Material::default())
            .optics(Optics { absorption: DVec3::ONE, ..clear(surfaces) })
            .environment(compass())
            .draw()
    };
    assert_eq!(of(Surfaces::One), of(Surfaces::Two));
}
