//! The same bytes whatever the threads and however the samples are divided.
#![allow(clippy::unwrap_used, missing_docs)]

mod common;

use common::{RGB, TestScene, matte, point, sphere, square};
use gonio_mesh::Material;
use gonio_scene::scene_file::{MotionKind, MotionSpec, ObjectSpec};
use gonio_trace::{Film, Simplification, Simplifications, TraceScene, TraceSettings};

fn scene() -> TestScene {
    let mut scene = TestScene::new()
        .object(sphere(12), matte(0.7))
        .object(square(5.0, -1.0), matte(0.5))
        .light(point([2.0, 3.0, 4.0], 20.0));
    (scene.frame.width, scene.frame.height) = (40, 30);
    scene.frame.camera.fov_y_rad = 0.8;
    scene
}

#[test]
fn threads_do_not_matter() {
    let settings = TraceSettings { simplified: Simplifications::NONE, ..RGB };
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| scene().trace(&settings, 8))
    };
    let one = on(1);
    assert_eq!(one, on(2));
    assert!(one.error().relative > 0.0 && one.error().relative < 1.0, "{:?}", one.error());
}

#[test]
fn samples_may_be_added_in_any_number_of_steps() {
    let scene = scene();
    let ready = TraceScene::new(&scene.scene, &scene.frame);
    let mut film = Film::new(scene.frame.width, scene.frame.height);
    for samples in [1, 5, 2] {
        assert!(ready.add_samples(&mut film, &RGB, samples, None, &|_| true));
    }
    // Interrupted: as if it had not been started.
    let before = film.clone();
    assert!(!ready.add_samples(&mut film, &RGB, 4, None, &|share| share < 0.5));
    assert_eq!(film, before);
    assert_eq!(film, scene.trace(&RGB, 8));
}

/// Stopped, saved, loaded and continued, with more samples where the noise is.
#[test]
fn a_resumed_picture_equals_an_uninterrupted_one() {
    let scene = scene();
    let ready = TraceScene::new(&scene.scene, &scene.frame);
    let steps = |saved: bool| {
        let mut film = scene.trace(&RGB, 8);
        for _ in 0..3 {
            let mask = film.unfinished(0.03);
            assert!(ready.add_samples(&mut film, &RGB, 8, Some(&mask), &|_| true));
            if saved {
                film = Film::from_checkpoint(&film.to_checkpoint(5), 5, film.width, film.height).unwrap();
            }
        }
        film
    };
    let film = steps(true);
    assert_eq!(film, steps(false));
    assert!(film.least_samples() < film.most_samples(), "{} {}", film.least_samples(), film.most_samples());
}

#[test]
fn other_seeds_make_other_noise() {
    let one = scene().trace(&RGB, 2).picture();
    let two = scene().trace(&TraceSettings { seed: 2, ..RGB }, 2).picture();
    assert_ne!(one.pixels, two.pixels);
}

/// A glowing square that moves 10 units in a second, and back.
fn moving() -> TestScene {
    let mut scene = TestScene::new().object(square(0.5, 0.0), Material { emitted: [2.0; 3], ..matte(0.0) });
    let points = Some(vec![[0.0; 3], [10.0, 0.0, 0.0]]);
    let motion = MotionSpec { kind: MotionKind::Path, period: 2.0, points, ..MotionSpec::default() };
    scene.scene.settings.objects.push(ObjectSpec { motion: Some(motion), ..ObjectSpec::default() });
    scene = scene.eye([2.0, 0.0, 5.0], [2.0, 0.0, 0.0]);
    scene.frame.camera.fov_y_rad = 1e-3;
    scene
}

/// The square is seen for a tenth of a second.
#[test]
fn what_moves_is_blurred() {
    for (shutter, time, expected) in [(0.3, 0.0, 2.0 / 3.0), (0.08, 0.16, 2.0), (0.05, 0.0, 0.0), (0.0, 0.2, 2.0)] {
        let mut scene = moving();
        scene.scene = scene.scene.at(time);
        scene.frame.time = time;
        let mean = scene.mean(&TraceSettings { shutter, ..RGB }, 64).0.x;
        // 64 moments; the square's edge is met a little before or after.
        assert!((mean - expected).abs() < 0.07, "{shutter} {time}: {mean}");
        // So are the features that the denoiser is guided by.
        let features = TraceScene::new(&scene.scene, &scene.frame).features(&TraceSettings { shutter, ..RGB }, 64);
        let seen = features.normal.iter().map(|n| f64::from(n[2])).sum::<f64>() / features.normal.len() as f64;
        assert!((seen - 0.5 * expected).abs() < 0.04, "{shutter} {time}: {seen}");
        let closed = TraceSettings { shutter, simplified: RGB.simplified.with(Simplification::Time), ..RGB };
        let closed = scene.mean(&closed, 4).0.x;
        assert!((closed - if time > 0.1 { 2.0 } else { 0.0 }).abs() < 1e-6, "{shutter} {time}: {closed}");
    }
}

/// Passes, tiles and threads do not matter where something moves either.
#[test]
fn moving_scenes_are_deterministic() {
    let mut scene = moving();
    // The square stays in the lower half.
    scene = scene.eye([2.0, 3.0, 5.0], [2.0, 3.0, 0.0]);
    scene.frame.camera.fov_y_rad = 1.5;
    (scene.frame.width, scene.frame.height) = (40, 30);
    let settings = TraceSettings { shutter: 0.4, seed: 3, ..RGB };
    let ready = TraceScene::new(&scene.scene, &scene.frame);
    let mut film = scene.trace(&settings, 8);
    let mask = film.unfinished(0.03);
    for samples in [3, 5] {
        assert!(ready.add_samples(&mut film, &settings, samples, Some(&mask), &|_| true));
    }
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let mut at_once = pool.install(|| scene.trace(&settings, 8));
    assert!(pool.install(|| ready.add_samples(&mut at_once, &settings, 8, Some(&mask), &|_| true)));
    assert_eq!(film, at_once);
    assert!(film.least_samples() < film.most_samples());
    let parts = ready.contributions(&settings, 20, 24, film.least_samples(), &|_| true);
    assert!(parts.emitted.x > 0.0 && parts.emitted.x < 2.0, "{parts:?}");
}
