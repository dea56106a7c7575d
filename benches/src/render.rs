//! The main job as a whole process: a 5,000-triangle model at 1024x768 to a PNG, in alternating runs
//! with other programs that do the same.

use crate::measure::{self, Cost};
use crate::{Places, models, peers, table};
use serde_json::json;
use std::path::{Path, PathBuf};
use std::process::Command;

const WIDTH: u32 = 1024;
const HEIGHT: u32 = 768;
/// Runs of each program that count.
const ROUNDS: usize = 21;
/// Runs of each before: caches of files and of shaders fill.
const WARM_UP: usize = 2;
/// Set by the project: seconds of wall time.
const WALL_BAR_S: f64 = 0.12;
/// Set by the project: how many times faster than the fastest peer.
const RATIO_BAR: f64 = 3.0;

struct Contestant {
    name: String,
    picture: PathBuf,
    command: Box<dyn Fn(&Path) -> Command>,
    costs: Vec<Cost>,
}

/// Measures, prints, and says whether the bars were held.
pub fn run(places: &Places) -> Result<bool, String> {
    let model = models::written(&places.out, "torus_5000.obj", || models::torus_obj(50, 50))?;
    let mut contestants = vec![gonio(places, &model)];
    let mut absent = Vec::new();
    match peers::install(&places.out) {
        Err(error) => absent.push(format!("no peer: {error}")),
        Ok(peers) => {
            for peer in peers {
                let (name, model) = (peer.name.to_owned(), model.clone());
                let picture = places.out.join(format!("render-{}.png", contestants.len()));
                let command = Box::new(move |out: &Path| peer.command(&model, out, WIDTH, HEIGHT));
                contestants.push(Contestant { name, picture, command, costs: Vec::new() });
            }
        }
    }
    // A peer that cannot draw here drops out, and is told of; gonio may not.
    let mut ready = Vec::new();
    for contestant in contestants {
        let warm = (0..WARM_UP).try_for_each(|_| once(&contestant).map(drop));
        match warm {
            Ok(()) => ready.push(contestant),
            Err(error) if ready.is_empty() => return Err(error),
            Err(error) => absent.push(format!("{} does not run here: {error}", contestant.name)),
        }
    }
    for _ in 0..ROUNDS {
        for contestant in &mut ready {
            let cost = once(contestant)?;
            contestant.costs.push(cost);
        }
    }
    report(places, &ready, &absent)
}

fn gonio(places: &Places, model: &Path) -> Contestant {
    let (program, model) = (places.gonio.clone(), model.to_owned());
    let command = Box::new(move |out: &Path| {
        let mut command = Command::new(&program);
        command.arg("render").arg(&model).arg("-o").arg(out).args(["--quiet", "--backend", "gl"]);
        command.args(["--size", &format!("{WIDTH}x{HEIGHT}")]);
        command
    });
    Contestant { name: "gonio render".into(), picture: places.out.join("render-0.png"), command, costs: Vec::new() }
}

/// One run, and a look at whether it drew.
fn once(contestant: &Contestant) -> Result<Cost, String> {
    let _ = std::fs::remove_file(&contestant.picture);
    let cost = measure::process(&mut (contestant.command)(&contestant.picture))?;
    let bytes = std::fs::read(&contestant.picture).map_err(|e| format!("{}: no picture: {e}", contestant.name))?;
    match png_size(&bytes) {
        Some((WIDTH, HEIGHT)) => Ok(cost),
        size => Err(format!("{}: a picture of the wrong size: {size:?}", contestant.name)),
    }
}

/// Width and height of a PNG.
fn png_size(bytes: &[u8]) -> Option<(u32, u32)> {
    let number = |at: usize| bytes.get(at..at + 4)?.try_into().ok().map(u32::from_be_bytes);
    if bytes.starts_with(b"\x89PNG") { Some((number(16)?, number(20)?)) } else { None }
}

fn report(places: &Places, contestants: &[Contestant], absent: &[String]) -> Result<bool, String> {
    let medians: Vec<Cost> = contestants.iter().map(|c| measure::median_cost(&c.costs)).collect();
    let ours = medians[0];
    let mut rows = vec![["", "wall s", "CPU s", "wall x", "CPU x"].map(String::from).to_vec()];
    for (contestant, cost) in contestants.iter().zip(&medians) {
        rows.push(vec![
            contestant.name.clone(),
            format!("{:.3}", cost.wall_s),
            format!("{:.3}", cost.cpu_s),
            format!("{:.2}", cost.wall_s / ours.wall_s),
            format!("{:.2}", cost.cpu_s / ours.cpu_s),
        ]);
    }
    table::print(
        &format!("render: 5,000 triangles, {WIDTH}x{HEIGHT}, to PNG; medians of {ROUNDS} alternating runs"),
        &rows,
    );
    for line in absent {
        println!("  {line}");
    }
    let mut held = table::bar("wall time", ours.wall_s, " s", WALL_BAR_S, true);
    let fastest = medians[1..].iter().map(|c| c.wall_s).min_by(f64::total_cmp);
    match fastest {
        Some(fastest) => held &= table::bar("against the fastest peer", fastest / ours.wall_s, " x", RATIO_BAR, false),
        None => {
            println!("  MISSED no peer to compare with");
            held = false;
        }
    }
    let rows: Vec<_> = contestants
        .iter()
        .zip(&medians)
        .map(|(c, m)| json!({"name": c.name, "wall_s": m.wall_s, "cpu_s": m.cpu_s, "runs": c.costs.len()}))
        .collect();
    table::write_json(&places.out, "render", &json!({"contestants": rows, "absent": absent, "bars_held": held}))?;
    Ok(held)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_size_of_a_png_is_read() {
        let mut png = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR".to_vec();
        png.extend([0, 0, 4, 0, 0, 0, 3, 0]);
        assert_eq!(png_size(&png), Some((1024, 768)));
        assert_eq!(png_size(b"P6 1024 768"), None);
        assert_eq!(png_size(b"\x89PNG"), None);
    }
}
