//! Unwraps models with gonio, with xatlas and with Blender's smart projection, at the same margin, and measures all results with
//! gonio's report; then the speed of unwrapping 100,000 triangles, and of a whole bake.
//!
//! gonio's time is that of its whole process; xatlas and Blender are measured without reading and writing files. A program that
//! fails on a model, or crashes, has no figures there.

use crate::measure::{self, median};
use crate::{Places, models, peers};
use serde_json::{Value, json};
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Texels along a side, and the distance between charts in texels: 0.01 of the side.
const SIZE: u32 = 1024;
const MARGIN_TEXELS: u32 = 10;
const ROUNDS: usize = 3;

/// Issue 20: seconds for 100,000 triangles, and for a diffuse bake of Suzanne.
const BAR_UNWRAP_S: f64 = 3.0;
const BAR_BAKE_S: f64 = 1.0;

/// Issue 20: gonio covers at least as much as Blender on 4 of 5 models, with no more mean area stretch.
const BAR_BETTER_THAN_BLENDER: f64 = 0.8;

/// Unwraps the model in the first file into the second; returns the seconds.
type RunUnwrapper<'a> = dyn Fn(&Path, &Path) -> Result<f64, String> + 'a;

/// A program that unwraps models.
struct Unwrapper<'a> {
    name: &'static str,
    run: Box<RunUnwrapper<'a>>,
}

/// Measures, prints, and returns whether the requirements are met.
pub fn run(places: &Places) -> Result<bool, String> {
    let unwrappers = unwrappers(places)?;
    let mut rows = vec![
        ["model", "program", "charts", "coverage", "area stretch", "overlaps", "seconds"].map(str::to_owned).to_vec(),
    ];
    let (mut results, mut better, mut compared) = (Vec::new(), 0.0, 0.0);
    let mut is_clean = true;
    for model in models(places)? {
        let name = model.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let mut found: Vec<(&str, Value)> = Vec::new();
        for unwrapper in &unwrappers {
            let out = places.out.join(format!("unwrapped-{}-{name}.obj", unwrapper.name));
            let seconds = match (unwrapper.run)(&model, &out) {
                Ok(seconds) => seconds,
                Err(error) if found.is_empty() => return Err(error),
                Err(error) => {
                    println!("{name}: {error}");
                    let row = [&name, unwrapper.name, "failed", "", "", "", ""];
                    rows.push(row.map(str::to_owned).to_vec());
                    results.push(json!({ "model": name, "program": unwrapper.name, "error": error }));
                    continue;
                }
            };
            let report = report(places, &out)?;
            let number = |key: &str| report[key].as_f64().unwrap_or(f64::NAN);
            rows.push(vec![
                name.clone(),
                unwrapper.name.to_owned(),
                report["charts"].to_string(),
                format!("{:.1} %", 100.0 * number("coverage")),
                format!("{:.3}", number("area_stretch")),
                report["overlapping_texels"].to_string(),
                format!("{seconds:.2}"),
            ]);
            results.push(json!({ "model": name, "program": unwrapper.name, "seconds": seconds, "uv": report }));
            found.push((unwrapper.name, report));
        }
        is_clean &= found[0].1["overlapping_texels"] == 0;
        if let Some((_, other)) = found.iter().find(|(name, _)| *name == BLENDER) {
            let of = |report: &Value, key: &str| report[key].as_f64().unwrap_or(f64::NAN);
            let ratio = |key: &str| of(&found[0].1, key) / of(other, key);
            println!(
                "{name}: {:.2} of Blender's coverage, {:.3} of its stretch",
                ratio("coverage"),
                ratio("area_stretch")
            );
            compared += 1.0;
            better += f64::from(u8::from(ratio("coverage") >= 1.0 && ratio("area_stretch") <= 1.0));
        }
    }
    measure::print_table("unwrapped", &rows);
    let mut held = is_clean;
    println!("  {} no texel belongs to two charts of gonio", if is_clean { "held  " } else { "MISSED" });
    if compared > 0.0 {
        let what = "of the models: at least Blender's coverage, no more stretch";
        held &= measure::bar(what, better / compared, "", BAR_BETTER_THAN_BLENDER, false);
    }
    let (speed, is_fast) = speed(places, &unwrappers)?;
    measure::write_json(&places.out, "unwrap", &json!({ "models": results, "speed": speed }))?;
    Ok(held && is_fast)
}

const BLENDER: &str = "blender";

fn unwrappers(places: &Places) -> Result<Vec<Unwrapper<'_>>, String> {
    let mut all = vec![Unwrapper {
        name: "gonio",
        run: Box::new(|model, out| {
            let margin = MARGIN_TEXELS.to_string();
            let mut command = Command::new(&places.gonio);
            command
                .args(["unwrap", "--quiet", "--margin-texels", &margin, "--size", &SIZE.to_string(), "-o"])
                .arg(out)
                .arg(model);
            Ok(measure::process(&mut command)?.wall_s)
        }),
    }];
    match peers::python_with(&places.out, "xatlas-venv", &["xatlas==0.0.11", "numpy"]) {
        Ok(python) => {
            all.push(Unwrapper { name: "xatlas", run: Box::new(move |model, out| xatlas(&python, model, out)) })
        }
        Err(error) => println!("without xatlas, a Python package that is installed with pip: {error}"),
    }
    match find_blender(places) {
        Ok(blender) => all.push(Unwrapper {
            name: BLENDER,
            run: Box::new(move |model, out| {
                let mut command = Command::new(&blender[0]);
                command.args(&blender[1..]).arg(script("blender_unwrap.py")).arg("--").arg(model).arg(out);
                command.arg((f64::from(MARGIN_TEXELS) / f64::from(SIZE)).to_string());
                seconds(&answer(&mut command, "unwrapped")?)
            }),
        }),
        Err(error) => println!("without Blender: put `blender` on the path, or install bpy with pip: {error}"),
    }
    Ok(all)
}

/// Version 5.0, as a Python package; it needs Python 3.11.
const BPY: &str = "bpy==5.0.1";

/// The command that runs a script of Blender: the program on the path, else the Python package.
fn find_blender(places: &Places) -> Result<Vec<OsString>, String> {
    if Command::new("blender").arg("--version").output().is_ok_and(|output| output.status.success()) {
        return Ok(["blender", "-b", "--factory-startup", "-P"].map(OsString::from).to_vec());
    }
    Ok(vec![peers::python_with(&places.out, "bpy-venv", &[BPY])?.into_os_string()])
}

fn script(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("peers").join(name)
}

/// The words on the line of stdout that begins with `prefix`, after it.
fn answer(command: &mut Command, prefix: &str) -> Result<Vec<String>, String> {
    let name = command.get_program().to_string_lossy().into_owned();
    let output = command.output().map_err(|e| format!("cannot run {name}: {e}"))?;
    let text = String::from_utf8_lossy(&output.stdout);
    let line = text.lines().find_map(|line| line.strip_prefix(prefix)).filter(|_| output.status.success());
    let words = line.map(|line| line.split_whitespace().map(str::to_owned).collect());
    words.ok_or_else(|| {
        // A program that crashed has no last words, or those of another part of it.
        let errors = String::from_utf8_lossy(&output.stderr);
        let last = errors.lines().chain(text.lines()).rfind(|line| !line.trim().is_empty()).unwrap_or_default();
        format!("{name} failed: {}: {last}", output.status)
    })
}

fn xatlas(python: &Path, model: &Path, out: &Path) -> Result<f64, String> {
    let mut command = Command::new(python);
    command.arg(script("xatlas_unwrap.py")).arg(model).arg(out).args([SIZE, MARGIN_TEXELS].map(|n| n.to_string()));
    let words = answer(&mut command, "")?;
    if words.get(1).is_some_and(|count| count != "1") {
        println!("xatlas needed {} textures for {}", words[1], model.display());
    }
    seconds(&words)
}

fn seconds(words: &[String]) -> Result<f64, String> {
    words.first().and_then(|word| word.parse().ok()).ok_or_else(|| "the program printed no time".to_owned())
}

/// The figures of a model's own coordinates.
fn report(places: &Places, model: &Path) -> Result<Value, String> {
    let mut command = Command::new(&places.gonio);
    command.args(["unwrap", "--keep-uvs", "--json", "--size", &SIZE.to_string()]).arg(model);
    let output = command.output().map_err(|e| format!("cannot run gonio: {e}"))?;
    let answer: Value = serde_json::from_slice(&output.stdout)
        .map_err(|e| format!("gonio's report: {e}: {}", String::from_utf8_lossy(&output.stderr).trim()))?;
    Ok(answer["uv"].clone())
}

/// gonio's own models, the OBJ files in `target/bench/models`, a sphere of a million triangles.
fn models(places: &Places) -> Result<Vec<PathBuf>, String> {
    let assets = Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets/models");
    let mut all = vec![assets.join("still_life.obj"), assets.join("suzanne.obj")];
    let others = places.out.join("models");
    match std::fs::read_dir(&others) {
        Ok(entries) => all.extend(
            entries.flatten().map(|entry| entry.path()).filter(|path| path.extension().is_some_and(|e| e == "obj")),
        ),
        Err(_) => {
            println!("no further models: put OBJ files, such as those of tinyobjloader, into {}", others.display())
        }
    }
    all[2..].sort();
    all.push(models::written(&places.out, "sphere-1m.obj", || models::sphere_obj(1000, 501))?);
    Ok(all)
}

/// Medians of alternating runs; the requirements are those of whole processes.
fn speed(places: &Places, unwrappers: &[Unwrapper]) -> Result<(Value, bool), String> {
    let model = models::written(&places.out, "sphere-100k.obj", || models::sphere_obj(250, 201))?;
    let suzanne = Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets/models/suzanne.obj");
    let mut times: Vec<Vec<f64>> = vec![Vec::new(); unwrappers.len()];
    let mut bakes = Vec::new();
    for _ in 0..ROUNDS {
        for (index, (unwrapper, times)) in unwrappers.iter().zip(&mut times).enumerate() {
            match (unwrapper.run)(&model, &places.out.join(format!("unwrapped-{}-100k.obj", unwrapper.name))) {
                Ok(seconds) => times.push(seconds),
                Err(error) if index == 0 => return Err(error),
                Err(error) => println!("100,000 triangles: {error}"),
            }
        }
        let mut bake = Command::new(&places.gonio);
        bake.args(["bake", "--quiet", "--size", &SIZE.to_string(), "-o"]).arg(places.out.join("baked")).arg(&suzanne);
        bakes.push(measure::process(&mut bake)?.wall_s);
    }
    let own = median(times[0].clone());
    let bake = median(bakes);
    let mut seconds = serde_json::Map::new();
    for (unwrapper, times) in unwrappers.iter().zip(times).filter(|(_, times)| !times.is_empty()) {
        let time = median(times);
        seconds.insert(unwrapper.name.to_owned(), time.into());
        if seconds.len() > 1 {
            let ratio = own / time;
            println!("100,000 triangles: gonio takes {ratio:.2} of the time of {} ({time:.2} s)", unwrapper.name);
        }
    }
    let mut held = measure::bar("unwrapping 100,000 triangles", own, " s", BAR_UNWRAP_S, true);
    held &= measure::bar("a diffuse bake of Suzanne", bake, " s", BAR_BAKE_S, true);
    Ok((json!({ "unwrap_100k_s": seconds, "bake_suzanne_s": bake }), held))
}
