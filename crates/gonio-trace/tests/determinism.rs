//! The same bytes whatever the threads and however the samples are divided.
#![allow(clippy::unwrap_used, missing_docs)]

mod common;

use common::{RGB, TestScene, matte, point, sphere, square};
use gonio_trace::{Film, Simplifications, TraceScene, TraceSettings};

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
