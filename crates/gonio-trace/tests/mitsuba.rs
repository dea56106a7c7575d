//! The same scenes as Mitsuba 3 traces them: `mitsuba/make.py` wrote `mitsuba/reference.txt` from `mitsuba/scenes.txt`.
//!
//! Both pictures are means of independent runs, from which the standard errors of blocks of 8 x 8 pixels come. Chance alone puts
//! 0.4 % of channels beyond 3 standard errors (Student's t with 47 degrees of freedom), so 4 of a scene's 48 blocks may be; more
//! are with p < 0.001. None of all 1,152 channels is beyond 5.5 with p > 0.001. The mean square of a channel's deviations is
//! about 1, and below 1.9 with p > 0.0001. The light of the whole picture is equal within 0.2 %, or 3 standard errors where these are more.
#![allow(clippy::unwrap_used, missing_docs)]

mod common;

use common::RGB;
use gonio_fixtures::{FixtureCase, FixtureTable, selected};
use gonio_mesh::{Cause, Diagnostic};
use gonio_scene::files::{FileBytes, FileSource, within};
use gonio_scene::{Scene, load, toml_file};
use gonio_trace::{Film, Technique, TraceScene, TraceSettings};
use std::io::{Error, ErrorKind};
use std::path::{Path, PathBuf};

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/mitsuba");
const BLOCK: usize = 8;
/// Pictures with independent noise, and samples of each.
const SEEDS: u64 = 48;
const SAMPLES: u32 = 20;

struct Files<'c>(&'c FixtureCase);

impl FileSource for Files<'_> {
    fn read_within(&self, path: &Path, most: u64) -> Result<FileBytes, Error> {
        let file = self.0.files.iter().find(|file| Path::new(&file.path) == path).ok_or(ErrorKind::NotFound)?;
        within(file.bytes.clone().into(), most)
    }
    fn list(&self, folder: &Path) -> Vec<PathBuf> {
        // There are no folders in a scene's folder.
        let files = self.0.files.iter().filter(|_| folder == Path::new(""));
        files.map(|file| file.path.clone().into()).collect()
    }
}

/// Mean and standard error of each channel.
#[derive(Clone, Copy, Debug)]
struct Estimate {
    mean: [f64; 3],
    error: [f64; 3],
}

fn scene(case: &FixtureCase) -> Scene {
    let file = toml_file::read(case.text("scene.toml").unwrap()).unwrap();
    let scene = load::load(file, Path::new(""), &Files(case)).unwrap();
    // The light equation needs an environment for mirrors and glass, the rendering equation does not.
    let harmless = |d: &Diagnostic| matches!(d.cause, Some(Cause::NoEnvironment));
    assert!(scene.diagnostics.iter().all(harmless), "{:?}", scene.diagnostics);
    scene
}

/// The blocks of a picture, rows from the top, and at the end the whole picture.
fn blocks(film: &Film) -> Vec<[f64; 3]> {
    let picture = film.picture();
    let (width, height) = (picture.width as usize, picture.height as usize);
    let columns = width / BLOCK;
    let mut means = vec![[0.0; 3]; columns * (height / BLOCK) + 1];
    for (i, pixel) in picture.pixels.iter().enumerate() {
        let block = i / width / BLOCK * columns + i % width / BLOCK;
        for channel in 0..3 {
            means[block][channel] += f64::from(pixel[channel]) / (BLOCK * BLOCK) as f64;
            means.last_mut().unwrap()[channel] += f64::from(pixel[channel]) / (width * height) as f64;
        }
    }
    means
}

/// `seeds` pictures of `samples` each.
fn traced(scene: &Scene, technique: Technique, first_seed: u64, seeds: u64, samples: u32) -> Vec<Estimate> {
    let frame = scene.frame(0.0);
    let ready = TraceScene::new(scene, &frame);
    let runs: Vec<Vec<[f64; 3]>> = (first_seed..first_seed + seeds)
        .map(|seed| {
            let mut film = Film::new(frame.width, frame.height);
            assert!(ready.add_samples(&mut film, &TraceSettings { seed, technique, ..RGB }, samples, None, &|_| true));
            assert_eq!(film.lost_samples(), 0);
            blocks(&film)
        })
        .collect();
    let n = seeds as f64;
    let estimate = |block: usize| {
        let mean = [0, 1, 2].map(|c| runs.iter().map(|run| run[block][c]).sum::<f64>() / n);
        let squares = |c: usize| runs.iter().map(|run| (run[block][c] - mean[c]).powi(2)).sum::<f64>();
        Estimate { mean, error: [0, 1, 2].map(|c| (squares(c) / (n - 1.0) / n).sqrt()) }
    };
    (0..runs[0].len()).map(estimate).collect()
}

/// What Mitsuba says, as [`traced`].
fn reference(name: &str) -> Vec<Estimate> {
    let table = std::fs::read_to_string(format!("{FOLDER}/reference.txt")).unwrap();
    let mut lines = table.lines().skip_while(|line| !line.starts_with(&format!("-- {name}:")));
    assert!(lines.next().is_some(), "the reference has no scene {name}");
    let numbers = |line: &str| -> Vec<f64> {
        line.trim_start_matches("all ").split(' ').map(|number| number.parse().unwrap()).collect()
    };
    lines
        .take_while(|line| !line.is_empty())
        .map(|line| match numbers(line)[..] {
            [r, g, b, er, eg, eb] => Estimate { mean: [r, g, b], error: [er, eg, eb] },
            _ => panic!("{name}: `{line}`"),
        })
        .collect()
}

/// The difference in standard errors, and in 1/10,000 of the block's largest channel: the panorama's texels become those of a
/// cubemap, which is seen where there is no noise, and the reference has six digits.
fn deviation(ours: &Estimate, theirs: &Estimate, channel: usize) -> f64 {
    let rounding = 1e-4 * theirs.mean.iter().copied().fold(0.0, f64::max);
    let error = ours.error[channel].hypot(theirs.error[channel]).hypot(rounding);
    let difference = ours.mean[channel] - theirs.mean[channel];
    if difference == 0.0 { 0.0 } else { difference / error }
}

fn assert_agrees(case: &FixtureCase) -> Vec<String> {
    let scene = scene(case);
    let (ours, theirs) = (traced(&scene, Technique::Both, 0, SEEDS, SAMPLES), reference(&case.name));
    assert_eq!(ours.len(), theirs.len(), "{}", case.name);
    let (whole, blocks) = (ours.len() - 1, 0..ours.len() - 1);
    let mut faults = Vec::new();
    let z: Vec<[f64; 3]> = blocks.map(|i| [0, 1, 2].map(|c| deviation(&ours[i], &theirs[i], c))).collect();
    let columns = scene.settings.picture.width as usize / BLOCK;
    let far: Vec<String> = (0..z.len())
        .filter(|&i| z[i].iter().any(|z| z.abs() > 3.0))
        .map(|i| {
            let (mine, other) = (ours[i].mean, theirs[i].mean);
            format!("column {} row {}: {mine:.5?} instead of {other:.5?}, z = {:.1?}", i % columns, i / columns, z[i])
        })
        .collect();
    if far.len() > 4 || z.iter().flatten().any(|z| z.abs() > 5.5) {
        faults.push(format!("blocks differ:\n  {}", far.join("\n  ")));
    }
    for channel in 0..3 {
        let mean_square = z.iter().map(|z| z[channel].powi(2)).sum::<f64>() / z.len() as f64;
        if mean_square > 1.9 {
            faults.push(format!("channel {channel}: the mean square of the deviations is {mean_square:.2}"));
        }
        let (mine, other) = (ours[whole].mean[channel], theirs[whole].mean[channel]);
        let noise = ours[whole].error[channel].hypot(theirs[whole].error[channel]) / other;
        if (mine / other - 1.0).abs() > f64::max(2e-3, 3.0 * noise) {
            faults.push(format!("channel {channel}: {mine} instead of {other}, standard error {:.2} %", 100.0 * noise));
        }
        // A comparison that noise hides tells nothing.
        if noise > 2e-3 {
            faults.push(format!("channel {channel}: the standard error is {:.2} % of the whole", 100.0 * noise));
        }
    }
    faults.iter().map(|fault| format!("{}: {fault}", case.name)).collect()
}

#[test]
fn pictures_agree_with_mitsuba() {
    let cases = FixtureTable::read(format!("{FOLDER}/scenes.txt")).unwrap().cases().unwrap();
    let faults: Vec<String> = selected(cases, |case| &case.name).iter().flat_map(assert_agrees).collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Samples of lights alone, of directions alone, and both: the same picture with other noise, p > 0.001. Of 288 differences of
/// blocks in green none exceeds 5.1 standard errors, and of 6 of whole pictures none 4.0 (Student's t with 62 degrees of
/// freedom at 0.001 / 288 and 0.001 / 6).
#[test]
fn techniques_agree() {
    let cases = FixtureTable::read(format!("{FOLDER}/scenes.txt")).unwrap().cases().unwrap();
    for name in ["cornell", "glossy", "environment"] {
        let scene = scene(cases.iter().find(|case| case.name == name).unwrap());
        let [both, lights, directions] = [Technique::Both, Technique::Lights, Technique::Directions]
            .map(|technique| traced(&scene, technique, 100 * technique as u64, 32, 8));
        for (technique, other) in [("lights", lights), ("directions", directions)] {
            let z: Vec<f64> = both.iter().zip(&other).map(|(a, b)| deviation(a, b, 1).abs()).collect();
            let (whole, blocks) = z.split_last().unwrap();
            let largest = blocks.iter().copied().fold(0.0, f64::max);
            assert!(largest < 5.1 && *whole < 4.0, "{name}, {technique}: {largest:.1} in a block, {whole:.1} in all");
            let noise = other.last().map(|e| e.error[1] / e.mean[1]).unwrap();
            assert!(noise < 0.05, "{name}, {technique}: the standard error is {noise:.3} of the whole");
        }
    }
}
