//! Draws 10,000 pictures by a Ray cluster of several nodes on this machine, of which a worker is killed, and by one plain process
//! for each core, in alternating rounds.

use crate::{Places, measure, python_package};
use serde_json::json;
use std::path::Path;
use std::process::Command;

const PICTURES: usize = 10_000;
const SIZE: &str = "256x192";
/// Measured rounds of each side.
const ROUNDS: usize = 2;
/// The required throughput as a multiple of plain processes'.
const BAR: f64 = 0.9;

/// Measures, prints, and returns whether the requirement is met.
pub fn run(places: &Places) -> Result<bool, String> {
    let python = python_package::interpreter(places)?;
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    // Ray's sockets want a short path.
    let folder = std::env::temp_dir().join(format!("gonio-ray-{}", std::process::id()));
    let (mut plain, mut cluster) = (Vec::new(), Vec::new());
    for _ in 0..ROUNDS {
        plain.push(seconds(&python, &folder, "plain", cores)?);
        cluster.push(seconds(&python, &folder, "cluster", cores)?);
    }
    let _ = std::fs::remove_dir_all(&folder);
    let [plain, cluster] = [plain, cluster].map(|seconds| PICTURES as f64 / measure::median(seconds));
    let heading = ["", "pictures / s"].map(String::from).to_vec();
    let row = |name: String, rate: f64| vec![name, format!("{rate:.1}")];
    measure::print_table(
        &format!("ray: {PICTURES} pictures of {SIZE}, medians of {ROUNDS} alternating rounds"),
        &[
            heading,
            row(format!("{cores} plain processes"), plain),
            row(format!("Ray, {cores} nodes, a worker killed"), cluster),
        ],
    );
    let ratio = cluster / plain;
    let held = measure::bar("throughput against plain processes", ratio, " x", BAR, false);
    let result = json!({
        "pictures": PICTURES, "size": SIZE, "cores": cores, "plain_per_s": plain, "cluster_per_s": cluster,
        "ratio": ratio, "bar_held": held,
    });
    measure::write_json(&places.out, "ray", &result)?;
    Ok(held)
}

/// The seconds of one side. Pictures that are lost or drawn twice are an error.
fn seconds(python: &Path, folder: &Path, side: &str, cores: usize) -> Result<f64, String> {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("peers/gonio_ray.py");
    let mut command = Command::new(python);
    command.arg(script).args([side, &cores.to_string(), &PICTURES.to_string(), SIZE]);
    if side == "cluster" {
        command.arg("kill");
    }
    // Ray's workers let all other processes go first, which would compare their priority on a machine that is busy.
    command.env("RAY_worker_niceness", "0").env("RAY_TMPDIR", folder).env("RAY_USAGE_STATS_ENABLED", "0");
    let output = command.output();
    let output = output.map_err(|e| format!("cannot run {}: {e}", python.display()))?;
    let text = String::from_utf8_lossy(&output.stdout);
    // Ray prints too.
    let result = text.lines().find_map(|line| line.strip_prefix("result ")).unwrap_or_default();
    let numbers: Vec<f64> = result.split(' ').filter_map(|word| word.parse().ok()).collect();
    match numbers.as_slice() {
        [seconds, all, different] if *all == PICTURES as f64 && all == different => Ok(*seconds),
        [_, all, different] => Err(format!("{side}: {all} pictures, {different} different ones, of {PICTURES}")),
        _ => Err(format!("{side}: {}\n{}", output.status, String::from_utf8_lossy(&output.stderr).trim())),
    }
}
