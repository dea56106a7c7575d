//! Converts a panorama of 4096 x 2048 pixels to six faces of 1024 x 1024 with bilinear filtering. The conversion in memory is
//! compared with OpenCV and with ffmpeg's `v360`; the whole process, from a PNG to six, with ffmpeg.
//!
//! gonio and OpenCV are measured twice, with and without AVX2. All numbers are CPU seconds of one thread.

use crate::measure::{self, Cost};
use crate::{Places, peers};
use gonio_environment::convert::{Conversion, EnvironmentRef, Filter};
use gonio_environment::{Cubemap, Panorama, SimdLevel, builtin};
use gonio_image::encode::png::{self, Depth};
use gonio_light::color::OutputTransform;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::process::Command;

const SIZE: u32 = 1024;
const MEGAPIXELS: f64 = 6.0 * (SIZE as f64 * SIZE as f64) / 1e6;
/// Measured rounds.
const ROUNDS: usize = 7;
/// Conversions by gonio in each round: a single one is too short for the clock.
const REPEATS: usize = 5;

/// Required speed as a multiple of OpenCV's when it computes the map, at each SIMD level.
const BAR_MAP_AND_REMAP: f64 = 2.5;
/// The same when the map is computed beforehand.
const BAR_REMAP: f64 = 1.2;

/// Measures, prints, and returns whether the requirements are met: OpenCV's at each level, 12 times `v360`, 2 times ffmpeg's
/// whole process.
pub fn run(places: &Places) -> Result<bool, String> {
    let picture = panorama_png(&places.out)?;
    let bytes = std::fs::read(&picture).map_err(|e| format!("cannot read {}: {e}", picture.display()))?;
    let decoded = gonio_image::decode::decode("panorama.png", &bytes, &Default::default());
    let decoded = decoded.map_err(|e| e.to_string())?;
    let gonio_image::decode::DecodedContent::Picture(image) = decoded.shape else {
        return Err("the panorama is not a single picture".to_owned());
    };
    let panorama = Panorama::new(image).map_err(|e| e.to_string())?;
    let python = peers::python_with(&places.out, "opencv-venv", &["opencv-python-headless==5.0.0.93"])?;
    let ffmpeg = Ffmpeg::find()?;
    let mut rows = Rows::default();
    let mut map = Cubemap::new(SIZE, [0.0; 4]);
    // The first conversion also pays for the pages of memory.
    ours(SimdLevel::detect(), &panorama, &mut map, 1)?;
    for round in 0..ROUNDS {
        for &level in SimdLevel::available() {
            rows.add(&gonio_at(level), ours(level, &panorama, &mut map, REPEATS)?);
            let peer = opencv(&python, &picture, level)?;
            for (name, seconds) in peer.seconds {
                rows.add(&name, seconds);
            }
            if round == 0 {
                println!("OpenCV against {}: {}", gonio_at(level), peer.features);
            }
        }
        rows.add("ffmpeg v360, conversion", ffmpeg.conversion(&picture, places)?);
        let (gonio, other) = (gonio(places, &picture), ffmpeg.faces(&picture, places));
        // The two take turns in going first.
        let costs = if round % 2 == 0 {
            [measure::process(&mut gonio.command()), measure::process(&mut other.command())]
        } else {
            let second = measure::process(&mut other.command());
            [measure::process(&mut gonio.command()), second]
        };
        let [gonio, other] = costs;
        rows.add_cost("gonio environment convert", gonio?);
        rows.add_cost("ffmpeg", other?);
    }
    rows.report(places)
}

/// CPU seconds of one conversion on one thread, as everywhere here: threads that share a core slow each other down.
fn ours(level: SimdLevel, panorama: &Panorama, map: &mut Cubemap, repeats: usize) -> Result<f64, String> {
    let conversion = Conversion { filter: Some(Filter::Bilinear), ..Conversion::default() };
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().map_err(|e| e.to_string())?;
    let ((), cost) = measure::here(|| {
        one.install(|| {
            (0..repeats).for_each(|_| conversion.fill_cubemap_at(level, EnvironmentRef::Panorama(panorama), map))
        });
    });
    Ok(cost.cpu_s / repeats as f64)
}

fn gonio_at(level: SimdLevel) -> String {
    format!("gonio, {}", level.name())
}

fn opencv_at(level: SimdLevel, depth: &str, way: &str) -> String {
    format!("OpenCV for {}, {depth}, {way}", level.name())
}

const DEPTHS: [&str; 2] = ["8 bits", "floats"];
const WAYS: [(&str, f64); 2] = [("map and remap", BAR_MAP_AND_REMAP), ("remap", BAR_REMAP)];

/// CPU seconds of OpenCV, and the CPU features that it and numpy used.
struct OpenCv {
    seconds: Vec<(String, f64)>,
    features: String,
}

/// The environment variables that make OpenCV and numpy do without AVX2.
const WITHOUT_AVX2: &[(&str, &str)] = &[
    ("OPENCV_CPU_DISABLE", "AVX512-SKX,AVX2,FP16,AVX"),
    ("OPENCV_IPP", "disabled"),
    ("NPY_DISABLE_CPU_FEATURES", "AVX512_SPR,AVX512_ICL,X86_V4,X86_V3"),
];

/// Returns the CPU seconds of one conversion by OpenCV in each way, with this CPU's instructions or without AVX2.
fn opencv(python: &Path, picture: &Path, level: SimdLevel) -> Result<OpenCv, String> {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("peers/opencv_convert.py");
    let mut command = Command::new(python);
    command.arg(script).arg(picture).arg(SIZE.to_string()).arg("3");
    if level != SimdLevel::detect() {
        command.envs(WITHOUT_AVX2.iter().copied());
    }
    let output = command.output().map_err(|e| format!("cannot run {}: {e}", python.display()))?;
    if !output.status.success() {
        return Err(format!("OpenCV failed: {}", String::from_utf8_lossy(&output.stderr).trim()));
    }
    let answer: Value = serde_json::from_slice(&output.stdout).map_err(|e| format!("OpenCV's answer: {e}"))?;
    let mut seconds = Vec::new();
    for depth in DEPTHS {
        for (way, _) in WAYS {
            let rounds = answer[depth][way].as_array().into_iter().flatten().filter_map(Value::as_f64);
            seconds.push((opencv_at(level, depth, way), measure::median(rounds)));
        }
    }
    Ok(OpenCv { seconds, features: answer["features"].as_str().unwrap_or_default().to_owned() })
}

struct Job(Box<dyn Fn() -> Command>);

impl Job {
    fn command(&self) -> Command {
        (self.0)()
    }
}

fn gonio(places: &Places, picture: &Path) -> Job {
    let (program, picture, out) = (places.gonio.clone(), picture.to_owned(), places.out.join("faces-gonio"));
    Job(Box::new(move || {
        let mut command = Command::new(&program);
        command.args(["environment", "convert", "--quiet", "--filter", "bilinear", "--size", &SIZE.to_string()]);
        command.arg(&picture).arg(&out);
        command
    }))
}

struct Ffmpeg {
    program: PathBuf,
}

impl Ffmpeg {
    fn find() -> Result<Ffmpeg, String> {
        let program = PathBuf::from("ffmpeg");
        match Command::new(&program).arg("-version").output() {
            Ok(output) if output.status.success() => Ok(Ffmpeg { program }),
            _ => Err("ffmpeg is missing, with which gonio is compared: install ffmpeg".to_owned()),
        }
    }

    fn command(&self) -> Command {
        let mut command = Command::new(&self.program);
        command.args(["-hide_banner", "-loglevel", "error", "-nostdin", "-y"]);
        command
    }

    /// Returns the CPU seconds of one conversion in memory: those of a process that reads raw pixels, converts and discards
    /// them, minus those of one that does not convert.
    fn conversion(&self, picture: &Path, places: &Places) -> Result<f64, String> {
        let raw = places.out.join("panorama.rgb");
        if !raw.exists() {
            let made = measure::process(
                self.command().arg("-i").arg(picture).args(["-f", "rawvideo", "-pix_fmt", "gbrp"]).arg(&raw),
            );
            made?;
        }
        let run = |filter: &str| {
            let mut command = self.command();
            command
                .args([
                    "-threads",
                    "1",
                    "-filter_threads",
                    "1",
                    "-f",
                    "rawvideo",
                    "-pix_fmt",
                    "gbrp",
                    "-s",
                    "4096x2048",
                    "-i",
                ])
                .arg(&raw);
            command.args(["-vf", filter, "-f", "null", "-"]);
            measure::process(&mut command)
        };
        let with = run(&format!("v360=e:c6x1:interp=linear:w={}:h={SIZE}", 6 * SIZE))?;
        let without = run("null")?;
        Ok((with.cpu_s - without.cpu_s).max(1e-6))
    }

    /// Converts a PNG to six.
    fn faces(&self, picture: &Path, places: &Places) -> Job {
        let (program, picture, out) = (self.program.clone(), picture.to_owned(), places.out.clone());
        Job(Box::new(move || {
            let mut command = Ffmpeg { program: program.clone() }.command();
            command.arg("-i").arg(&picture);
            let mut graph = format!("[0:v]v360=e:c6x1:interp=linear:w={}:h={SIZE},split=6", 6 * SIZE);
            (0..6).for_each(|i| graph.push_str(&format!("[s{i}]")));
            (0..6).for_each(|i| graph.push_str(&format!(";[s{i}]crop={SIZE}:{SIZE}:{}:0[f{i}]", i * SIZE)));
            command.args(["-filter_complex", &graph]);
            for i in 0..6 {
                command.args(["-map", &format!("[f{i}]"), "-frames:v", "1"]).arg(out.join(format!("ffmpeg-{i}.png")));
            }
            command
        }))
    }
}

/// Writes the built-in room, enlarged and with the grain of a photograph, which PNG cannot compress away.
fn panorama_png(folder: &Path) -> Result<PathBuf, String> {
    let path = folder.join("panorama_4096.png");
    if path.exists() {
        return Ok(path);
    }
    let room = builtin::room().map_err(|e| e.to_string())?;
    let conversion = Conversion { filter: Some(Filter::Bicubic), ..Conversion::default() };
    let mut large = conversion.panorama(EnvironmentRef::Panorama(&room), 4096, 2048);
    let mut state = 1_u32;
    for pixel in &mut large.image.pixels {
        for value in &mut pixel[..3] {
            // G. Marsaglia's xorshift, 2003.
            state ^= state << 13;
            state ^= state >> 17;
            state ^= state << 5;
            *value *= 0.97 + 0.06 * (state as f32 / u32::MAX as f32);
        }
    }
    let bytes = png::encode(&large.image, &OutputTransform::default(), Depth::Eight).map_err(|e| e.to_string())?;
    std::fs::write(&path, bytes).map_err(|e| format!("cannot write {}: {e}", path.display()))?;
    Ok(path)
}

/// The measurements, by name.
#[derive(Default)]
struct Rows {
    conversions: Vec<(String, Vec<f64>)>,
    processes: Vec<(String, Vec<Cost>)>,
}

impl Rows {
    fn add(&mut self, name: &str, seconds: f64) {
        match self.conversions.iter_mut().find(|(known, _)| known == name) {
            Some((_, all)) => all.push(seconds),
            None => self.conversions.push((name.to_owned(), vec![seconds])),
        }
    }

    fn add_cost(&mut self, name: &str, cost: Cost) {
        match self.processes.iter_mut().find(|(known, _)| known == name) {
            Some((_, all)) => all.push(cost),
            None => self.processes.push((name.to_owned(), vec![cost])),
        }
    }

    fn report(&self, places: &Places) -> Result<bool, String> {
        let seconds: Vec<(&str, f64)> =
            self.conversions.iter().map(|(name, all)| (name.as_str(), measure::median(all.iter().copied()))).collect();
        let of = |name: &str| seconds.iter().find(|(known, _)| *known == name).map_or(0.0, |(_, s)| *s);
        let ours = of(&gonio_at(SimdLevel::detect()));
        let mut lines = vec![["", "CPU", "Mpixel per CPU second", "gonio is"].map(String::from).to_vec()];
        lines.extend(seconds.iter().map(|(name, s)| {
            let times = format!("{:.1} x", s / ours);
            vec![(*name).to_owned(), format!("{:.0} ms", s * 1e3), format!("{:.1}", MEGAPIXELS / s), times]
        }));
        measure::print_table(
            "panorama 4096 x 2048 to six faces of 1024 x 1024, bilinear, in memory, one thread each",
            &lines,
        );
        let processes: Vec<(&str, Cost)> =
            self.processes.iter().map(|(name, all)| (name.as_str(), measure::median_cost(all))).collect();
        let mut lines = vec![["", "wall", "CPU"].map(String::from).to_vec()];
        lines.extend(processes.iter().map(|(name, cost)| {
            vec![(*name).to_owned(), format!("{:.3} s", cost.wall_s), format!("{:.3} s", cost.cpu_s)]
        }));
        measure::print_table("the same as a whole process, PNG to six PNG", &lines);
        let cpu = |name: &str| processes.iter().find(|(known, _)| *known == name).map_or(0.0, |(_, c)| c.cpu_s);
        let whole = cpu("ffmpeg") / cpu("gonio environment convert");
        let mut held = true;
        for &level in SimdLevel::available() {
            for depth in DEPTHS {
                for (way, bar) in WAYS {
                    let name = opencv_at(level, depth, way);
                    held &=
                        measure::bar(&format!("against {name}"), of(&name) / of(&gonio_at(level)), " x", bar, false);
                }
            }
        }
        held &= measure::bar("against v360", of("ffmpeg v360, conversion") / ours, " x", 12.0, false);
        held &= measure::bar("whole process against ffmpeg, CPU", whole, " x", 2.0, false);
        let value = json!({
            "conversion_cpu_s": seconds.iter().map(|(n, s)| json!({ "name": n, "cpu_s": s })).collect::<Vec<_>>(),
            "process": processes.iter().map(|(n, c)| json!({ "name": n, "wall_s": c.wall_s, "cpu_s": c.cpu_s }))
                .collect::<Vec<_>>(),
            "held": held,
        });
        measure::write_json(&places.out, "environment", &value)?;
        Ok(held)
    }
}
