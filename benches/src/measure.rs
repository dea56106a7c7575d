//! Times of child processes and of this process, their medians, and results as tables and as JSON.

use serde_json::Value;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};
use wait4::Wait4;

/// Wall and CPU time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cost {
    /// From start to end, seconds.
    pub wall_s: f64,
    /// User and system time on all cores together, seconds.
    pub cpu_s: f64,
}

/// Runs a program to its end and measures it with the children that it waited for. If it fails, the error is its stderr.
pub fn process(command: &mut Command) -> Result<Cost, String> {
    let program = command.get_program().to_string_lossy().into_owned();
    let failed = |why: String| format!("{program}: {why}");
    // A file rather than a pipe, which would have to be read during the measurement.
    let mut errors = tempfile().map_err(|e| failed(e.to_string()))?;
    let stderr = errors.try_clone().map_err(|e| failed(e.to_string()))?;
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(stderr);
    let start = Instant::now();
    let child = command.spawn().map_err(|e| failed(e.to_string()))?;
    let used = child.wait4().map_err(|e| failed(e.to_string()))?;
    let wall_s = start.elapsed().as_secs_f64();
    if !used.status.success() {
        use std::io::{Read, Seek};
        let mut text = String::new();
        let _ = errors.rewind().and_then(|()| errors.read_to_string(&mut text));
        return Err(failed(format!("{}: {}", used.status, text.trim())));
    }
    Ok(Cost { wall_s, cpu_s: (used.rusage.utime + used.rusage.stime).as_secs_f64() })
}

/// Opens a temporary file and removes its name.
fn tempfile() -> std::io::Result<std::fs::File> {
    let path = std::env::temp_dir().join(format!("gonio-bench-{}", std::process::id()));
    let file = std::fs::File::options().read(true).write(true).create(true).truncate(true).open(&path)?;
    std::fs::remove_file(&path)?;
    Ok(file)
}

/// Returns the CPU time of all threads of this process so far.
#[cfg(unix)]
pub fn cpu_time() -> Duration {
    let now = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
    Duration::new(now.tv_sec.unsigned_abs(), now.tv_nsec.unsigned_abs() as u32)
}

/// Returns the wall time, because this system reports no CPU time.
#[cfg(not(unix))]
pub fn cpu_time() -> Duration {
    static START: std::sync::OnceLock<Instant> = std::sync::OnceLock::new();
    START.get_or_init(Instant::now).elapsed()
}

/// Measures a part of this process.
pub fn here<T>(work: impl FnOnce() -> T) -> (T, Cost) {
    let (wall, cpu) = (Instant::now(), cpu_time());
    let result = work();
    let cost = Cost { cpu_s: (cpu_time() - cpu).as_secs_f64(), wall_s: wall.elapsed().as_secs_f64() };
    (result, cost)
}

/// Warns if the machine is busy with other work, which makes wall times meaningless and ratios inaccurate.
pub fn warn_if_busy() {
    let load = std::fs::read_to_string("/proc/loadavg").ok().and_then(|text| load_average(&text));
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    if let Some(load) = load.filter(|&load| load > 0.5 * cores as f64) {
        println!("this machine is busy (load {load:.1} on {cores} cores): do not trust wall times");
    }
}

/// Returns the first number of `/proc/loadavg`: the mean number of runnable processes in the last minute.
fn load_average(text: &str) -> Option<f64> {
    text.split_whitespace().next()?.parse().ok()
}

/// Returns the median: of an even number of values the mean of the middle two, of none 0.
pub fn median(values: impl IntoIterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.into_iter().collect();
    values.sort_by(f64::total_cmp);
    match values.len() {
        0 => 0.0,
        n if n % 2 == 1 => values[n / 2],
        n => 0.5 * (values[n / 2 - 1] + values[n / 2]),
    }
}

/// Returns the medians of wall and CPU time, each taken separately.
pub fn median_cost(costs: &[Cost]) -> Cost {
    Cost { wall_s: median(costs.iter().map(|c| c.wall_s)), cpu_s: median(costs.iter().map(|c| c.cpu_s)) }
}

/// Prints rows under a title. The first row is the heading; the first column is aligned left, the others right.
pub fn print_table(title: &str, rows: &[Vec<String>]) {
    println!("{title}");
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let widths: Vec<usize> = (0..columns)
        .map(|c| rows.iter().filter_map(|r| r.get(c)).map(|t| t.chars().count()).max().unwrap_or(0))
        .collect();
    for row in rows {
        let cells: Vec<String> = row
            .iter()
            .zip(&widths)
            .enumerate()
            .map(|(c, (text, width))| if c == 0 { format!("{text:<width$}") } else { format!("{text:>width$}") })
            .collect();
        println!("  {}", cells.join("   ").trim_end());
    }
}

/// Prints whether a requirement is met, and returns it.
pub fn bar(what: &str, value: f64, unit: &str, limit: f64, at_most: bool) -> bool {
    let held = if at_most { value <= limit } else { value >= limit };
    let word = if at_most { "at most" } else { "at least" };
    println!("  {} {what}: {value:.3}{unit} ({word} {limit}{unit})", if held { "held  " } else { "MISSED" });
    held
}

/// Writes the result of a benchmark to `target/bench/NAME.json`.
pub fn write_json(folder: &Path, name: &str, value: &Value) -> Result<(), String> {
    let path = folder.join(format!("{name}.json"));
    std::fs::write(&path, format!("{value:#}\n")).map_err(|e| format!("cannot write {}: {e}", path.display()))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn the_median_is_the_middle() {
        assert_eq!(median([3.0, 1.0, 100.0]), 3.0);
        assert_eq!(median([4.0, 1.0, 2.0, 100.0]), 3.0);
        assert_eq!(median([]), 0.0);
    }

    #[test]
    fn the_load_is_read() {
        assert_eq!(load_average("7.24 8.31 8.84 3/512 1234\n"), Some(7.24));
        assert_eq!(load_average(""), None);
    }

    #[cfg(unix)]
    #[test]
    fn a_child_is_measured_and_its_failure_told() {
        // Counting to 300,000 in a shell takes some CPU time anywhere.
        let busy =
            process(Command::new("sh").args(["-c", "i=0; while [ $i -lt 300000 ]; do i=$((i+1)); done"])).unwrap();
        assert!(busy.cpu_s > 0.0 && busy.wall_s > 0.0, "{busy:?}");
        let error = process(Command::new("sh").args(["-c", "echo trouble >&2; exit 3"])).unwrap_err();
        assert!(error.contains("trouble"), "{error}");
    }
}
