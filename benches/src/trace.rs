//! Traces Mitsuba's Cornell box (256 x 256 pixels, 64 samples, depth 8) with gonio and with Mitsuba 3 in alternating runs, and a sphere
//! of a million triangles with gonio alone.
//!
//! CPU seconds are those of all threads while samples are traced: neither program's start-up nor its loading counts. Errors are
//! root mean squares of the luminance, relative to its mean, against a picture of 1024 samples by Mitsuba, which is kept in
//! `target/bench`. Both filter with a box of one pixel.

use crate::Places;
use crate::measure::{self, Cost};
use glam::{DMat4, DVec3, Vec3};
use gonio_light::{Equation, Simplification, Simplifications, Specular};
use gonio_mesh::{Material, Mesh};
use gonio_scene::{Background, Camera, Frame, Scene, TextureFilter};
use gonio_trace::{Film, TraceScene, TraceSettings};
use serde_json::json;
use std::path::Path;
use std::process::Command;

const SIZE: u32 = 256;
const SAMPLES: u32 = 64;
const DEPTH: u32 = 8;
/// Measured rounds.
const ROUNDS: u32 = 5;
/// Samples and seed of the reference.
const REFERENCE: (u32, u32) = (1024, 1000);

/// Required speed as a multiple of Mitsuba's, in RGB.
const BAR_RATE: f64 = 3.0;
/// For a million triangles: the longest time that the scene takes, and the first sample of 1024 x 768 pixels, CPU seconds.
const BAR_TREE_S: f64 = 1.0;
const BAR_FIRST_SAMPLE_S: f64 = 1.5;

/// Measures, prints, and returns whether the requirements are met: the speed at no more error than Mitsuba's, and the times.
pub fn run(places: &Places) -> Result<bool, String> {
    let reference = places.out.join(format!("cornell-{}.pfm", REFERENCE.0));
    if !reference.exists() {
        println!("tracing the reference with Mitsuba, once");
        // Renamed when it is complete.
        let part = places.out.join("cornell-part.pfm");
        mitsuba(REFERENCE.0, REFERENCE.1, &part)?;
        std::fs::rename(&part, &reference).map_err(|e| format!("cannot write {}: {e}", reference.display()))?;
    }
    let reference = luminance(&read_pfm(&reference)?);
    let (scene, frame) = cornell_box();
    let ready = TraceScene::new(&scene, &frame);
    let rgb = Simplifications::NONE.with(Simplification::Wavelengths);
    let mut sides = [Side::new("Mitsuba 3, scalar_rgb"), Side::new("gonio, RGB"), Side::new("gonio, spectral")];
    // The first samples also pay for what is made once.
    ours(&ready, rgb, 0, 1)?;
    ours(&ready, Simplifications::NONE, 0, 1)?;
    for round in 0..ROUNDS {
        let out = places.out.join("cornell-round.pfm");
        let cpu_s = mitsuba(SAMPLES, round, &out)?;
        sides[0].add(cpu_s, rms(&luminance(&read_pfm(&out)?), &reference));
        for (side, simplified) in [(1, rgb), (2, Simplifications::NONE)] {
            let (pixels, cost) = ours(&ready, simplified, round.into(), SAMPLES)?;
            sides[side].add(cost.cpu_s, rms(&luminance(&pixels), &reference));
        }
    }
    let mut rows = vec![["", "M paths / CPU s", "x Mitsuba", "error at 64 samples"].map(String::from).to_vec()];
    for side in &sides {
        let cells = [side.rate(), side.rate() / sides[0].rate()];
        let [rate, ratio] = cells.map(|v| format!("{v:.2}"));
        rows.push(vec![side.name.to_owned(), rate, ratio, format!("{:.2} %", 100.0 * side.error())]);
    }
    measure::print_table(&format!("Cornell box, medians of {ROUNDS} alternating rounds"), &rows);
    let (triangles, tree, first) = million()?;
    println!("  {triangles} triangles: scene {:.3} CPU s, first sample {:.3} CPU s", tree.cpu_s, first.cpu_s);
    let ratio = sides[1].rate() / sides[0].rate();
    // The error falls with the square root of the time.
    let error_ratio = sides[1].error() / sides[0].error();
    println!("  to the same error gonio needs 1/{:.1} of Mitsuba's time in RGB", ratio / (error_ratio * error_ratio));
    let held = [
        measure::bar("paths per CPU second in RGB, over Mitsuba's", ratio, "", BAR_RATE, false),
        measure::bar("error in RGB, over Mitsuba's", error_ratio, "", 1.0, true),
        measure::bar("scene of a million triangles", tree.cpu_s, " CPU s", BAR_TREE_S, true),
        measure::bar("first sample of 1024 x 768", first.cpu_s, " CPU s", BAR_FIRST_SAMPLE_S, true),
    ];
    let sides: Vec<_> = sides
        .iter()
        .map(|s| json!({ "name": s.name, "million_paths_per_cpu_s": s.rate(), "relative_error": s.error() }))
        .collect();
    let value = json!({
        "sides": sides, "triangles": triangles, "scene_cpu_s": tree.cpu_s, "first_sample_cpu_s": first.cpu_s,
    });
    measure::write_json(&places.out, "trace", &value)?;
    Ok(held.iter().all(|&held| held))
}

/// The rounds of one program.
struct Side {
    name: &'static str,
    cpu_s: Vec<f64>,
    errors: Vec<f64>,
}

impl Side {
    fn new(name: &'static str) -> Self {
        Side { name, cpu_s: Vec::new(), errors: Vec::new() }
    }

    fn add(&mut self, cpu_s: f64, error: f64) {
        self.cpu_s.push(cpu_s);
        self.errors.push(error);
    }

    /// Million paths per CPU second.
    fn rate(&self) -> f64 {
        f64::from(SIZE * SIZE * SAMPLES) / measure::median(self.cpu_s.iter().copied()) / 1e6
    }

    fn error(&self) -> f64 {
        measure::median(self.errors.iter().copied())
    }
}

/// Traces Mitsuba's box to a file; the CPU seconds.
fn mitsuba(samples: u32, seed: u32, out: &Path) -> Result<f64, String> {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("peers/mitsuba_trace.py");
    let mut command = Command::new("python3");
    command.arg(script).arg(samples.to_string()).arg(seed.to_string()).arg(out);
    let output =
        command.output().map_err(|e| format!("cannot run python3: {e}; install it, and `pip install mitsuba`"))?;
    if !output.status.success() {
        return Err(format!("Mitsuba failed: {}", String::from_utf8_lossy(&output.stderr).trim()));
    }
    let text = String::from_utf8_lossy(&output.stdout);
    text.trim().parse().map_err(|_| format!("Mitsuba's time is not a number: {}", text.trim()))
}

/// Traces a picture; its pixels, with the cost.
fn ours(
    ready: &TraceScene,
    simplified: Simplifications,
    seed: u64,
    samples: u32,
) -> Result<(Vec<[f32; 3]>, Cost), String> {
    let settings = TraceSettings { simplified, most_depth: DEPTH, seed, ..TraceSettings::default() };
    let mut film = Film::new(ready.frame().width, ready.frame().height);
    let (finished, cost) = measure::here(|| ready.add_samples(&mut film, &settings, samples, None, &|_| true));
    if !finished {
        return Err("tracing was interrupted".to_owned());
    }
    Ok((film.picture().pixels.iter().map(|p| [p[0], p[1], p[2]]).collect(), cost))
}

/// Reads a portable float map of three channels, little-endian, as Mitsuba writes it. Rows from top to bottom.
fn read_pfm(path: &Path) -> Result<Vec<[f32; 3]>, String> {
    let bytes = std::fs::read(path).map_err(|e| format!("cannot read {}: {e}", path.display()))?;
    let wrong = || format!("{} is not a float map of {SIZE} x {SIZE} pixels", path.display());
    let length = (SIZE * SIZE * 12) as usize;
    let head = bytes.len().checked_sub(length).ok_or_else(wrong)?;
    let expected = format!("PF\n{SIZE} {SIZE}\n-1");
    if !bytes.starts_with(expected.as_bytes()) {
        return Err(wrong());
    }
    let float = |b: &[u8]| f32::from_le_bytes([b[0], b[1], b[2], b[3]]);
    let pixels: Vec<[f32; 3]> =
        bytes[head..].chunks_exact(12).map(|p| [float(&p[..4]), float(&p[4..8]), float(&p[8..])]).collect();
    Ok(pixels.chunks(SIZE as usize).rev().flatten().copied().collect())
}

fn luminance(pixels: &[[f32; 3]]) -> Vec<f64> {
    let weights = Vec3::new(0.2126, 0.7152, 0.0722);
    pixels.iter().map(|&p| f64::from(Vec3::from(p).dot(weights))).collect()
}

/// The root of the mean square difference, relative to the mean of `reference`.
fn rms(pixels: &[f64], reference: &[f64]) -> f64 {
    let count = reference.len() as f64;
    let squares: f64 = pixels.iter().zip(reference).map(|(a, b)| (a - b) * (a - b)).sum();
    (squares / count).sqrt() / (reference.iter().sum::<f64>() / count)
}

/// `mitsuba.cornell_box()` of Mitsuba 3.9. There the lamp shines and surfaces reflect on their front only: a black plate
/// behind the lamp hides its back.
fn cornell_box() -> (Scene, Frame) {
    let matte = |diffuse: [f32; 3]| Material { diffuse, specular: [0.0; 3], ..Material::default() };
    let white = matte([0.885809, 0.698859, 0.666422]);
    let lamp = Material { emitted: [18.387, 13.9873, 6.75357], ..white.clone() };
    let mut scene = Scene::default();
    // The middle, and half edges along two axes whose cross product is the normal.
    let mut plate = |middle: [f32; 3], u: [f32; 3], v: [f32; 3], material: &Material| {
        let (middle, u, v) = (Vec3::from(middle), Vec3::from(u), Vec3::from(v));
        let positions = [-u - v, u - v, u + v, v - u].map(|p| (middle + p).to_array()).to_vec();
        let normals = vec![u.cross(v).normalize().to_array(); 4];
        let mesh = Mesh { positions, normals, indices: vec![0, 1, 2, 0, 2, 3], ..Mesh::default() };
        scene.add_object(mesh, material.clone().into(), DMat4::IDENTITY);
    };
    let (x, y, z, mx) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [-1.0, 0.0, 0.0]);
    plate([0.0, 0.0, -1.0], x, y, &white);
    plate([0.0, 1.0, 0.0], x, z, &white);
    plate([0.0, -1.0, 0.0], z, x, &white);
    plate([1.0, 0.0, 0.0], z, y, &matte([0.105421, 0.37798, 0.076425]));
    plate(mx, y, z, &matte([0.570068, 0.0430135, 0.0443706]));
    plate([0.0, 0.99, 0.01], [0.23, 0.0, 0.0], [0.0, 0.0, 0.19], &lamp);
    plate([0.0, 0.9905, 0.01], [0.23, 0.0, 0.0], [0.0, 0.0, 0.19], &matte([0.0; 3]));
    // Middle, height, and the half edges along the floor, which the boxes are turned on.
    for (middle, height, edges) in [
        ([-0.33, -0.4, -0.28], 0.61, [[0.28491, -0.0939491], [0.0939491, 0.28491]]),
        ([0.335, -0.7, 0.38], 0.3, [[0.286891, 0.0877115], [-0.0877115, 0.286891]]),
    ] {
        let [a, b] = edges.map(|[x, z]: [f32; 2]| Vec3::new(x, 0.0, z));
        let axes = [a, Vec3::Y * height, b];
        for axis in 0..3 {
            let (u, v) = (axes[(axis + 1) % 3], axes[(axis + 2) % 3]);
            for side in [1.0, -1.0] {
                let at = Vec3::from(middle) + axes[axis] * side;
                plate(at.to_array(), u.to_array(), (v * side).to_array(), &white);
            }
        }
    }
    let camera = Camera::looking_along(DVec3::Z * 3.9, DVec3::NEG_Z, DVec3::Y, 39.3077_f64.to_radians(), 1e-3, 100.0);
    let frame = frame(&scene, camera, SIZE, SIZE);
    (scene, frame)
}

/// Nothing but the objects, with a black background.
fn frame(scene: &Scene, camera: Camera, width: u32, height: u32) -> Frame {
    Frame {
        width,
        height,
        camera,
        lights: Vec::new(),
        light_shapes: Vec::new(),
        equation: Equation { specular: Specular::Phong, ..Equation::default() },
        two_sided: true,
        background: Background { top: DVec3::ZERO, bottom: DVec3::ZERO, transparent: false },
        texture_filter: TextureFilter::Linear,
        ..scene.frame(0.0)
    }
}

/// A sphere of a million triangles in a picture of 1024 x 768: their number, the cost of the scene and of a sample.
fn million() -> Result<(usize, Cost, Cost), String> {
    const RINGS: u32 = 500;
    let mut mesh = Mesh::default();
    for ring in 0..=RINGS {
        let (sin, cos) = (std::f32::consts::PI * ring as f32 / RINGS as f32).sin_cos();
        for sector in 0..2 * RINGS {
            let (s, c) = (std::f32::consts::PI * sector as f32 / RINGS as f32).sin_cos();
            mesh.positions.push([sin * c, cos, -sin * s]);
            mesh.normals.push([sin * c, cos, -sin * s]);
        }
    }
    for ring in 0..RINGS {
        for sector in 0..2 * RINGS {
            let at = |ring: u32, sector: u32| ring * 2 * RINGS + sector % (2 * RINGS);
            let [a, b] = [at(ring, sector), at(ring, sector + 1)];
            let [c, d] = [at(ring + 1, sector), at(ring + 1, sector + 1)];
            mesh.indices.extend([a, c, d, a, d, b]);
        }
    }
    let mut scene = Scene::default();
    let material = Material { diffuse: [0.7; 3], specular: [0.0; 3], ..Material::default() };
    scene.add_object(mesh, material.into(), DMat4::IDENTITY);
    let camera = Camera::looking_along(DVec3::Z * 5.0, DVec3::NEG_Z, DVec3::Y, 0.5, 0.1, 100.0);
    let frame = frame(&scene, camera, 1024, 768);
    let (ready, tree) = measure::here(|| TraceScene::new(&scene, &frame));
    let (_, first) = ours(&ready, Simplifications::NONE, 0, 1)?;
    Ok((ready.triangles(), tree, first))
}
