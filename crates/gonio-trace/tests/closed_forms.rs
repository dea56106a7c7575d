//! Light of lamps with a size, reflected energy at every angle, and slabs of glass: traced, and by formula or quadrature.
#![allow(clippy::unwrap_used, missing_docs)]

mod common;

use common::{RGB, TestScene, cuboid, matte, point, square};
use glam::{DMat4, DVec3};
use gonio_light::brdf::{BrdfKind, BrdfSettings};
use gonio_light::{Fresnel, Optics, ShadingPoint, Surface, Surfaces, microfacet};
use gonio_mesh::{Material, Mesh, MetallicRoughness};
use gonio_scene::LightShape;
use std::f64::consts::{FRAC_1_PI, PI, TAU};

/// Every channel is within four standard errors and `tolerance` of `expected`.
fn assert_mean(name: &str, scene: &TestScene, samples: u32, expected: f64, tolerance: f64) {
    let (mean, error) = scene.mean(&RGB, samples);
    let difference = (mean - expected).abs().max_element();
    assert!(difference <= 4.0 * error + tolerance, "{name}: {mean} instead of {expected}, standard error {error:.2e}");
    // A test that noise hides tells nothing.
    assert!(error < 0.01 * expected, "{name}: standard error {error:.2e} of {expected}");
}

fn lamp(radiance: f32) -> Material {
    Material { emitted: [radiance; 3], ..matte(0.0) }
}

/// The integral of `f cos` over the hemisphere, by the midpoint rule.
fn albedo(f: impl Fn(DVec3) -> f64) -> f64 {
    const ROWS: u32 = 300;
    let mut sum = 0.0;
    for row in 0..ROWS {
        // Uniform in the squared sine: the weight cos is in the step.
        let sin2 = (f64::from(row) + 0.5) / f64::from(ROWS);
        for column in 0..2 * ROWS {
            let (sin, cos) = (TAU * (f64::from(column) + 0.5) / f64::from(2 * ROWS)).sin_cos();
            sum += f(DVec3::new(sin2.sqrt() * cos, sin2.sqrt() * sin, (1.0 - sin2).sqrt()));
        }
    }
    sum * PI / f64::from(2 * ROWS * ROWS)
}

/// A flat piece of a material in light that is 1 everywhere, seen at an angle: it is as bright as its albedo.
fn flat_furnace(material: Material, degrees: f64) -> (TestScene, DVec3) {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let mut scene = TestScene::new()
        .object(square(1.0, 0.0), material)
        .environment(|_| DVec3::ONE)
        .eye([5.0 * sin, 0.0, 5.0 * cos], [0.0; 3]);
    scene.frame.camera.fov_y_rad = 0.2f64.to_radians();
    (scene, DVec3::new(sin, 0.0, cos))
}

#[test]
fn lobes_reflect_their_albedo() {
    let (diffuse, glossy) = (0.3, 0.6);
    for kind in [BrdfKind::Lambert, BrdfKind::Phong, BrdfKind::Blinn, BrdfKind::Lafortune, BrdfKind::Ward] {
        for (degrees, shininess) in [(0.0, 30.0), (50.0, 30.0), (75.0, 8.0)] {
            let mut brdf = BrdfSettings { normalised: true, ..BrdfSettings::new(kind) };
            brdf.lafortune = DVec3::new(0.8, 0.8, -1.0);
            let material =
                Material { specular: [glossy as f32; 3], shininess: shininess as f32, ..matte(diffuse as f32) };
            let (mut scene, view) = flat_furnace(material, degrees);
            scene.frame.equation.brdf = Some(brdf);
            let point = ShadingPoint { position: DVec3::ZERO, normal: DVec3::Z, view, tangent: DVec3::X };
            let surface = Surface { shininess, ..Surface::default() };
            let lobe = match kind {
                BrdfKind::Lambert => 0.0,
                _ => albedo(|l| brdf.lobe(&point, &surface, l)),
            };
            let name = format!("{kind:?} {degrees}");
            assert!(lobe <= 1.001, "{name}: the lobe reflects {lobe}");
            assert_mean(&name, &scene, 512, diffuse + glossy * lobe, 1e-3);
        }
    }
}

/// glTF's materials: what microfacets reflect, and below them the diffuse rest. Never more than arrives.
#[test]
fn metals_and_plastics_reflect_their_albedo() {
    for (metallic, roughness) in [(1.0, 0.3), (1.0, 0.8), (0.0, 0.3), (0.0, 0.8)] {
        for degrees in [0.0, 50.0, 75.0] {
            let base = 1.0;
            let f0 = 0.04 + (base - 0.04) * metallic;
            let physical = MetallicRoughness {
                base_color: [base as f32; 3],
                metallic: metallic as f32,
                roughness: roughness as f32,
                metallic_map: None,
                roughness_map: None,
            };
            let diffuse = base * (1.0 - metallic);
            let material =
                Material { specular: [f0 as f32; 3], metallic_roughness: Some(physical), ..matte(diffuse as f32) };
            let (scene, view) = flat_furnace(material, degrees);
            let facets = |cos: f64| {
                let (scale, bias) = microfacet::environment_brdf(cos, roughness);
                f0 * scale + bias
            };
            let alpha = microfacet::alpha(roughness);
            let of_view = facets(view.z);
            let expected = albedo(|l| {
                let h = (view + l).normalize();
                let f = f0 + (1.0 - f0) * (1.0 - view.dot(h)).powi(5);
                f * microfacet::distribution(h.z, alpha) * microfacet::visibility(view.z, l.z, alpha)
            }) + diffuse
                * (0..1000).map(|i| 1.0 - facets(((f64::from(i) + 0.5) / 1000.0).sqrt()).max(of_view)).sum::<f64>()
                / 1000.0;
            assert!(expected <= 1.001, "{metallic} {roughness} {degrees}: {expected}");
            assert!(roughness > 0.5 || expected > 0.9, "{metallic} {roughness} {degrees}: {expected} is too dark");
            assert_mean(&format!("{metallic} {roughness} {degrees}"), &scene, 512, expected, 2e-3);
        }
    }
}

/// Glass that absorbs, at normal incidence: `R + (1 - R)^2 a / (1 - R a)` of even light, `a = exp(-absorption d)`.
/// Without absorption that is 1; of light from the viewer's side `R + (1 - R)^2 R a^2 / (1 - R^2 a^2)`. The tracer has two surfaces also where the light equation refracts at one.
#[test]
fn slab_of_glass() {
    for surfaces in [Surfaces::One, Surfaces::Two] {
        for (index, absorption) in [(1.5_f64, 0.0_f64), (1.5, 0.8), (2.4, 0.8)] {
            let optics = Optics {
                transmission: 1.0,
                fresnel: Fresnel::Exact,
                absorption: DVec3::splat(absorption),
                surfaces,
                ..Optics::default()
            };
            let material = Material { refraction_index: index as f32, ..matte(0.0) };
            let mut scene = TestScene::new()
                .placed(cuboid([2.0, 2.0, 0.25]), material, optics, DMat4::IDENTITY)
                .environment(|_| DVec3::ONE);
            scene.frame.camera.fov_y_rad = 0.5f64.to_radians();
            let (r, a) = (((index - 1.0) / (index + 1.0)).powi(2), (-absorption * 0.5).exp());
            let expected = r + (1.0 - r).powi(2) * a / (1.0 - r * a);
            assert_mean(&format!("{surfaces:?} {index} {absorption}"), &scene, 1024, expected, 1e-4);
            // Light from the viewer's side only: what the slab reflects.
            let scene = scene.environment(|d| DVec3::splat(if d.z > 0.0 { 1.0 } else { 0.0 }));
            let expected = r + (1.0 - r).powi(2) * r * a * a / (1.0 - r * r * a * a);
            assert_mean(&format!("reflected, {surfaces:?} {index} {absorption}"), &scene, 4096, expected, 1e-4);
        }
    }
}

/// Irradiance at the origin, normal +Z, from a polygon of radiance 1 that is above the horizon (J. H. Lambert 1760).
fn irradiance_of_polygon(corners: &[DVec3]) -> f64 {
    let edges = corners.iter().zip(corners.iter().cycle().skip(1));
    let sum: f64 = edges.map(|(a, b)| a.cross(*b).normalize().z * a.normalize().dot(b.normalize()).acos()).sum();
    0.5 * sum.abs()
}

/// Lamps aside of the point and tilted, small and large, near and far.
#[test]
fn light_of_a_tilted_rectangle() {
    for (size, at, turn) in [
        ([1.0, 1.0], [1.2, 0.5, 1.0], [0.4, -0.7, 0.3]),
        ([3.0, 0.4], [-0.8, 0.6, 2.5], [1.0, 0.2, 0.0]),
        ([0.05, 0.08], [0.2, -0.1, 0.3], [0.0, 1.2, 0.5]),
    ] {
        let m = DMat4::from_translation(DVec3::from(at))
            * DMat4::from_euler(glam::EulerRot::XYZ, turn[0], turn[1], turn[2])
            * DMat4::from_scale(DVec3::new(size[0], size[1], 1.0));
        let corners: Vec<DVec3> = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)]
            .iter()
            .map(|&(x, y)| m.transform_point3(DVec3::new(x, y, 0.0)))
            .collect();
        assert!(corners.iter().all(|c| c.z > 0.0), "{corners:?}");
        let mut scene = TestScene::new()
            .object(square(3.0, 0.0), matte(0.7))
            .placed(square(0.5, 0.0), lamp(5.0), Optics::default(), m)
            .eye([-0.02, -0.2, 0.05], [0.0; 3]);
        scene.frame.camera.fov_y_rad = 1e-4;
        let expected = 0.7 * FRAC_1_PI * 5.0 * irradiance_of_polygon(&corners);
        assert_mean(&format!("{at:?}"), &scene, 1024, expected, 1e-4 * expected);
    }
}

/// The form factor of two equal rectangles that face each other at the distance 1 (J. R. Howell, *A Catalog of Radiation
/// Heat Transfer Configuration Factors*, C-11).
fn facing_rectangles(x: f64, y: f64) -> f64 {
    let (rx, ry) = ((1.0 + x * x).sqrt(), (1.0 + y * y).sqrt());
    let log = (rx * rx * ry * ry / (1.0 + x * x + y * y)).sqrt().ln();
    let sum = log + x * ry * (x / ry).atan() + y * rx * (y / rx).atan() - x * x.atan() - y * y.atan();
    2.0 / (PI * x * y) * sum
}

/// Two facing squares, one of them a lamp: of the light that leaves it, the share of the form factor arrives at the other,
/// whose mean radiance is seen by parallel rays from the side.
#[test]
fn form_factor_of_facing_plates() {
    assert!((facing_rectangles(1.0, 1.0) - 0.1998).abs() < 1e-4, "the value in every textbook");
    for distance in [1.0, 1.5, 2.0] {
        let (far, view) = (1e5, DVec3::new((distance + 1.0_f64).atan().sin(), 0.0, (distance + 1.0_f64).atan().cos()));
        let mut scene = TestScene::new()
            .object(square(0.5, 0.0), matte(0.8))
            .object(square(0.5, distance as f32), lamp(2.0))
            .eye((far * view).to_array(), [0.0; 3]);
        // The picture is wide enough for the lower plate, and does not contain the lamp.
        let width = 1.04;
        assert!(view.x * distance > 0.5 * width + 0.5 * view.z, "the lamp is outside");
        scene.frame.camera.fov_y_rad = 2.0 * (0.5 * width / far).atan();
        (scene.frame.camera.near, scene.frame.camera.far) = (far - 10.0, far + 10.0);
        (scene.frame.width, scene.frame.height) = (32, 32);
        let share = view.z / (width * width);
        let expected = 0.8 * 2.0 * facing_rectangles(1.0 / distance, 1.0 / distance) * share;
        // 1e-3: f32 rounds the origins of rays, and perspective is left by 1e-5.
        assert_mean(&format!("distance {distance}"), &scene, 1024, expected, 1e-3 * expected);
    }
}

/// Area of the disc of radius `r` in the projection of the hemisphere along its axis, on the side `x` of a great circle that is
/// tilted by `tilt` from the axis: what is left of a sphere lamp of apparent radius asin(r) behind a straight edge.
fn disc_beside_edge(r: f64, tilt: f64) -> f64 {
    const STEPS: u32 = 20_000;
    let column = |i: u32| {
        // The step narrows at the ends of the disc.
        let (y, cos) = (PI * ((f64::from(i) + 0.5) / f64::from(STEPS) - 0.5)).sin_cos();
        let (half, edge) = (r * cos, tilt.sin() * (1.0 - r * r * y * y).sqrt());
        (half - edge.clamp(-half, half)) * r * cos
    };
    (0..STEPS).map(column).sum::<f64>() * PI / f64::from(STEPS)
}

/// The penumbra of a sphere lamp behind the edge of a half-plane: points on the ground see part of its disc.
#[test]
fn penumbra_of_a_sphere() {
    let (radius, height, edge_height) = (1.0, 8.0, 4.0);
    let r = radius / height;
    assert!((disc_beside_edge(r, 0.0) / (0.5 * PI * r * r) - 1.0).abs() < 1e-6);
    assert!((disc_beside_edge(r, -0.5) / (PI * r * r) - 1.0).abs() < 1e-6 && disc_beside_edge(r, 0.5) == 0.0);
    // The blocker covers x < edge at its height; the point is below the lamp.
    let blocker = |edge: f32| Mesh {
        positions: [[edge, -30.0], [edge, 30.0], [edge - 30.0, 30.0], [edge - 30.0, -30.0]]
            .map(|[x, y]| [x, y, edge_height as f32])
            .to_vec(),
        normals: vec![[0.0, 0.0, 1.0]; 4],
        indices: vec![0, 1, 2, 0, 2, 3],
        ..Mesh::default()
    };
    for edge in [-0.6, -0.3, -0.1, 0.0, 0.15, 0.3] {
        let intensity = 20.0 * PI * radius * radius;
        let mut scene = TestScene::new()
            .object(square(40.0, 0.0), matte(0.5))
            .object(blocker(edge as f32), matte(0.0))
            .light(point([0.0, 0.0, height], intensity))
            .eye([2.0, 0.0, 3.0], [0.0; 3]);
        scene.frame.light_shapes = vec![LightShape::Sphere { radius }];
        scene.frame.camera.fov_y_rad = 1e-4;
        let seen = disc_beside_edge(r, f64::from(edge as f32).atan2(edge_height));
        let expected = 0.5 * FRAC_1_PI * 20.0 * seen;
        assert_mean(&format!("edge {edge}"), &scene, 4096, expected, 1e-4 * expected);
    }
}
