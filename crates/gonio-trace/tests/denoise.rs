//! Filtered pictures against converged ones.
#![allow(clippy::unwrap_used, missing_docs)]

mod common;

use common::{RGB, TestScene, cuboid, matte, point, sphere, square};
use glam::{DMat4, DVec3};
use gonio_light::Optics;
use gonio_mesh::{Material, Mesh};
use gonio_scene::{Background, Picture};
use gonio_trace::{Film, Simplifications, TraceScene, TraceSettings};

const SPECTRAL: TraceSettings = TraceSettings { simplified: Simplifications::NONE, ..RGB };

fn sized(mut scene: TestScene, width: u32, height: u32, fov_degrees: f64) -> TestScene {
    (scene.frame.width, scene.frame.height) = (width, height);
    scene.frame.camera.fov_y_rad = fov_degrees.to_radians();
    scene
}

/// A square of `count` x `count` cells with the colours of a checkerboard.
fn checkerboard(half: f32, z: f32, count: u32) -> Mesh {
    let mut mesh = Mesh::default();
    let at = |i: u32| half * (2.0 * i as f32 / count as f32 - 1.0);
    for (row, column) in (0..count).flat_map(|row| (0..count).map(move |column| (row, column))) {
        let first = mesh.positions.len() as u32;
        for (x, y) in [(0, 0), (1, 0), (1, 1), (0, 1)] {
            mesh.positions.push([at(column + x), at(row + y), z]);
            mesh.normals.push([0.0, 0.0, 1.0]);
            mesh.colors.push(if (row + column) % 2 == 0 { [1.0, 0.9, 0.7, 1.0] } else { [0.2, 0.3, 0.6, 1.0] });
        }
        mesh.indices.extend([0, 1, 2, 0, 2, 3].map(|i| first + i));
    }
    mesh
}

fn lamp(radiance: f32) -> Material {
    Material { emitted: [radiance; 3], ..matte(0.0) }
}

/// A ball and a box on a checkerboard below a small lamp, which is not in the picture, in dim light from all sides.
fn lamp_scene() -> TestScene {
    let down = DMat4::from_translation(DVec3::new(0.5, 1.0, 3.0)) * DMat4::from_rotation_x(std::f64::consts::PI);
    let scene = TestScene::new()
        .object(checkerboard(4.0, -1.0, 10), matte(0.8))
        .object(sphere(24), matte(0.5))
        .placed(
            cuboid([0.4, 0.4, 0.8]),
            matte(0.7),
            Optics::default(),
            DMat4::from_translation(DVec3::new(1.5, 0.4, 0.0)),
        )
        .placed(square(1.5, 0.0), lamp(5.0), Optics::default(), down)
        .environment(|d| DVec3::new(0.1, 0.15, 0.2) * (1.0 + d.y))
        .eye([0.5, -5.0, 3.0], [0.3, 0.0, -0.3]);
    sized(scene, 64, 48, 35.0)
}

/// Inside of a box: most light is reflected several times, and the walls have other colours.
fn room_scene() -> TestScene {
    let colored = |color: [f32; 3]| Material { diffuse: color, ..matte(0.0) };
    let wall = |m: DMat4| m * DMat4::from_translation(DVec3::new(0.0, 0.0, -2.0));
    let turned = |axis: DVec3, degrees: f64| wall(DMat4::from_axis_angle(axis, f64::to_radians(degrees)));
    let plain = Optics::default;
    let scene = TestScene::new()
        .placed(square(2.0, 0.0), matte(0.7), plain(), wall(DMat4::IDENTITY))
        .placed(square(2.0, 0.0), colored([0.7, 0.1, 0.1]), plain(), turned(DVec3::Y, 90.0))
        .placed(square(2.0, 0.0), colored([0.1, 0.6, 0.1]), plain(), turned(DVec3::Y, -90.0))
        .placed(square(2.0, 0.0), matte(0.7), plain(), turned(DVec3::X, 90.0))
        .placed(square(2.0, 0.0), matte(0.7), plain(), turned(DVec3::X, -90.0))
        .placed(square(0.5, 0.02), lamp(12.0), plain(), turned(DVec3::X, 90.0))
        .placed(cuboid([0.5, 1.0, 0.5]), matte(0.7), plain(), DMat4::from_translation(DVec3::new(-0.7, -1.0, -0.7)))
        .placed(sphere(20), matte(0.7), plain(), DMat4::from_translation(DVec3::new(0.8, -1.0, 0.2)))
        .eye([0.0, 0.0, 7.0], [0.0, 0.0, 0.0]);
    sized(scene, 56, 56, 42.0)
}

fn denoised(scene: &TestScene, settings: &TraceSettings, film: &Film) -> Picture {
    let features = TraceScene::new(&scene.scene, &scene.frame).features(settings, 64);
    film.denoised(&features)
}

/// As a display shows it, light above 1 clipped: otherwise the outline of a lamp outweighs everything else.
fn rms(a: &Picture, b: &Picture) -> f64 {
    let square = |(a, b): (&[f32; 4], &[f32; 4])| {
        (0..3).map(|c| f64::from(a[c].min(1.0) - b[c].min(1.0)).powi(2)).sum::<f64>() / 3.0
    };
    (a.pixels.iter().zip(&b.pixels).map(square).sum::<f64>() / a.pixels.len() as f64).sqrt()
}

fn mean(picture: &Picture) -> f64 {
    let sum: f64 = picture.pixels.iter().map(|p| f64::from(p[0] + p[1] + p[2])).sum();
    sum / (3 * picture.pixels.len()) as f64
}

#[test]
fn sixteen_paths_have_less_than_half_the_error() {
    for (name, scene, settings) in
        [("lamp", lamp_scene(), RGB), ("room", room_scene(), RGB), ("spectral room", room_scene(), SPECTRAL)]
    {
        // With 512 paths the noise of the truth itself would count.
        let truth = scene.trace(&settings, 2048).picture();
        let film = scene.trace(&TraceSettings { seed: 7, ..settings }, 16);
        let (noisy, filtered) = (film.picture(), denoised(&scene, &settings, &film));
        let (before, after) = (rms(&noisy, &truth), rms(&filtered, &truth));
        assert!(after < 0.5 * before, "{name}: {before} becomes {after}");
        let ratio = mean(&filtered) / mean(&noisy);
        assert!((ratio - 1.0).abs() < 0.01, "{name}: mean changes by {ratio}");
        assert!(noisy.pixels.iter().zip(&filtered.pixels).all(|(a, b)| a[3] == b[3]), "{name}");
        // Two films with as many paths together are as good.
        let halves = [7, 8].map(|seed| scene.trace(&TraceSettings { seed, ..settings }, 8));
        let features = TraceScene::new(&scene.scene, &scene.frame).features(&settings, 64);
        let filtered = Film::denoised_together(&halves, &features);
        let [mut noisy, other] = halves.each_ref().map(Film::picture);
        for (a, b) in noisy.pixels.iter_mut().flatten().zip(other.pixels.iter().flatten()) {
            *a = 0.5 * (*a + *b);
        }
        let (before, after) = (rms(&noisy, &truth), rms(&filtered, &truth));
        assert!(after < 0.5 * before, "{name}: {before} becomes {after} with two films");
        let ratio = mean(&filtered) / mean(&noisy);
        assert!((ratio - 1.0).abs() < 0.01, "{name}: mean changes by {ratio} with two films");
    }
}

#[test]
fn a_converged_picture_changes_by_less_than_its_error() {
    for (name, scene) in [("lamp", lamp_scene()), ("room", room_scene())] {
        for samples in [64, 256] {
            let film = scene.trace(&RGB, samples);
            let picture = film.picture();
            let error = film.error().relative * mean(&picture);
            let change = rms(&denoised(&scene, &RGB, &film), &picture);
            assert!(change < error, "{name} {samples}: {change} {error}");
        }
    }
}

/// The edge of a checkerboard's cell seen from the front, in noisy light.
#[test]
fn edges_of_colors_stay_sharp() {
    let scene = TestScene::new().object(checkerboard(1.0, 0.0, 2), matte(0.8)).placed(
        square(1.0, 0.0),
        lamp(2.0),
        Optics::default(),
        DMat4::from_translation(DVec3::new(0.0, 3.0, 2.0)),
    );
    let scene = sized(scene, 48, 48, 20.0);
    let film = scene.trace(&RGB, 16);
    let filtered = denoised(&scene, &RGB, &film);
    let noisy = film.picture();
    let truth = scene.trace(&RGB, 1024).picture();
    assert!(rms(&filtered, &truth) < 0.5 * rms(&noisy, &truth), "{} {}", rms(&filtered, &truth), rms(&noisy, &truth));
    for y in 4..20 {
        let row = |x: usize| filtered.pixels[y * 48 + x][0];
        let exact = |x: usize| truth.pixels[y * 48 + x][0];
        let step = exact(22) - exact(25);
        assert!(step.abs() > 0.5 * exact(22).max(exact(25)), "{y}: {step}");
        // The edge lies between the pixels 23 and 24: one pixel beside it, nothing is left of it.
        assert!((row(22) - row(25) - step).abs() < 0.1 * step.abs(), "{y}: {} {} {step}", row(22), row(25));
        assert!((row(23) - row(24) - step).abs() < 0.1 * step.abs(), "{y}: {} {} {step}", row(23), row(24));
    }
}

#[test]
fn pictures_without_noise_stay_as_they_are() {
    let mut scene = sized(TestScene::new().object(square(9.0, 0.0), lamp(0.37)), 40, 24, 20.0);
    let film = scene.trace(&RGB, 16);
    let filtered = denoised(&scene, &RGB, &film);
    for (a, b) in film.picture().pixels.iter().zip(&filtered.pixels) {
        assert!((a[0] - b[0]).abs() <= 1e-5 && a[3] == b[3], "{a:?} {b:?}");
    }
    // A gradient behind nothing: each row has its own colour, and none moves into the next.
    scene = sized(TestScene::new(), 40, 24, 20.0);
    scene.frame.background = Background { top: DVec3::new(0.1, 0.2, 0.9), bottom: DVec3::ONE, transparent: false };
    let film = scene.trace(&RGB, 16);
    let change = rms(&denoised(&scene, &RGB, &film), &film.picture());
    assert!(change < film.error().relative * mean(&film.picture()), "{change}");
}

#[test]
fn threads_do_not_matter_and_odd_pictures_are_finite() {
    let scene = lamp_scene();
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let film = scene.trace(&RGB, 20);
            denoised(&scene, &RGB, &film).pixels
        })
    };
    assert_eq!(on(1), on(2));
    // Sizes below that of the window, few samples, light beyond what f32 can square.
    for (width, height, samples, strength) in [(1, 1, 1, 1.0), (1, 9, 2, 1.0), (7, 3, 16, 1e25), (3, 40, 9, 1e37)] {
        let scene = TestScene::new().object(sphere(8), matte(0.5)).light(point([0.0, 2.0, 3.0], strength));
        let scene = sized(scene, width, height, 30.0);
        // Here samples may be lost.
        let mut film = Film::new(width, height);
        TraceScene::new(&scene.scene, &scene.frame).add_samples(&mut film, &RGB, samples, None, &|_| true);
        let filtered = denoised(&scene, &RGB, &film);
        assert!(filtered.pixels.iter().flatten().all(|c| c.is_finite()), "{width}x{height} {strength}");
    }
}
