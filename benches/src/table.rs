//! Results as tables and as JSON.

use serde_json::Value;
use std::path::Path;

/// Prints rows under a title. The first row is the heading; the first column is aligned left, the others right.
pub fn print(title: &str, rows: &[Vec<String>]) {
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
