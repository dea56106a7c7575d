//! Measures the checker with `gonio lab score`, and compares the result with the table in `exercises/README.md`.

use crate::report::Findings;
use crate::target::{debug_program, target_folder};
use crate::{process, root};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

const DOCUMENT: &str = "exercises/README.md";
const BEGIN: &str = "<!-- made by `cargo xtask score` -->\n";
const END: &str = "<!-- end of what is made -->\n";
/// Tables of submissions in many styles.
const CORPUS: &str = "crates/gonio-check/corpus";
/// Counts may differ by this much: drivers differ in the last bit, and a mistake at the limit of 8 bits is visible with one
/// driver and not with another.
const STEPS: usize = 2;

/// `cargo xtask score`: measures the checker and writes the table.
pub fn run() -> ExitCode {
    let root = root();
    let built = process::run(process::cargo(&root).args(["build", "--locked", "--release"]));
    if !built.success {
        eprintln!("{}", built.text);
        return ExitCode::from(2);
    }
    let program = target_folder(&root).join("release").join(program_name());
    let outcome = measure(&root, &program).and_then(|(table, reached)| {
        let path = root.join(DOCUMENT);
        let document = std::fs::read_to_string(&path).map_err(|error| format!("cannot read {DOCUMENT}: {error}"))?;
        let (before, _, after) = parts(&document)?;
        std::fs::write(&path, format!("{before}{}{after}", rows_only(&table)))
            .map_err(|error| format!("cannot write {DOCUMENT}: {error}"))?;
        println!("{table}");
        Ok(reached)
    });
    match outcome {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(1),
        Err(error) => {
            eprintln!("xtask: {error}");
            ExitCode::from(2)
        }
    }
}

/// Measures with the program that was built for the tests, and compares with the goals and with the document.
pub fn check(root: &Path) -> Findings {
    let program = debug_program(root);
    let measured = measure(root, &program);
    let document = std::fs::read_to_string(root.join(DOCUMENT)).map_err(|error| format!("{DOCUMENT}: {error}"));
    match (measured, document) {
        (Ok((table, true)), Ok(document)) => {
            match parts(&document).and_then(|(_, stated, _)| compare(stated, &table)) {
                Ok(rows) => Findings::pass().remarking(format!("{rows} exercises")),
                Err(error) => Findings::fail(format!("{error}\n{table}")),
            }
        }
        (Ok((table, false)), _) => Findings::fail(format!("the checker misses its goals\n{table}")),
        (Err(error), _) | (_, Err(error)) => Findings::fail(error),
    }
}

/// Programs that are generated for one run of the tests.
const GENERATED: u32 = 60;
/// Least shares with a seed that nobody has seen. They are below what 400 programs have (see `docs/decisions/checker.md`) by
/// more than the chance of so few programs explains, so that a failure is a defect.
const LEAST_OF_GENERATED: [(&str, f64); 4] =
    [("correct", 0.75), ("outcomes", 0.88), ("single_named", 0.7), ("same_when_rewritten", 0.5)];

/// Checks generated programs and their rewrites, with a new seed.
pub fn check_generated(root: &Path) -> Findings {
    let program = debug_program(root);
    let mut command = Command::new(&program);
    command.args(["lab", "score", "--generated", &GENERATED.to_string(), "--json", "--quiet"]).current_dir(root);
    let output = match command.output() {
        Ok(output) => output,
        Err(error) => return Findings::fail(format!("cannot run {}: {error}", program.display())),
    };
    let Ok(report) = serde_json::from_slice::<serde_json::Value>(&output.stdout) else {
        return Findings::fail(String::from_utf8_lossy(&output.stderr).into_owned());
    };
    let seed = report["seed"].to_string();
    let all = report["scores"].as_array().and_then(|scores| scores.last()).cloned().unwrap_or_default();
    let mut remarks = vec![format!("seed {seed}")];
    let mut failures = Vec::new();
    for (name, least) in LEAST_OF_GENERATED {
        let count = |key: &str| all[name][key].as_f64();
        // Without a number, the report is not what it was.
        let (Some(right), Some(of)) = (count("right"), count("all")) else {
            failures.push(format!("the report has no `{name}`"));
            continue;
        };
        let words = name.replace('_', " ");
        remarks.push(format!("{words} {right} of {of}"));
        if right < least * of {
            failures.push(format!("{words}: {right} of {of}, expected at least {:.0} %", 100.0 * least));
        }
    }
    match failures.is_empty() {
        true => Findings::pass().remarking(remarks.join(", ")),
        false => Findings::fail(format!(
            "{}\nsee them with `gonio lab score --generated {GENERATED} --seed {seed}`",
            failures.join("\n")
        )),
    }
}

fn program_name() -> PathBuf {
    PathBuf::from(format!("gonio{}", std::env::consts::EXE_SUFFIX))
}

/// Runs `gonio lab score`. Returns its output, and whether the goals were reached.
fn measure(root: &Path, program: &Path) -> Result<(String, bool), String> {
    let corpus = crate::fixtures::unpack(root, CORPUS, "score")?;
    let mut command = Command::new(program);
    command.args(["lab", "score", "--quiet", "--corpus"]).arg(corpus).current_dir(root);
    let output = command.output().map_err(|error| format!("cannot run {}: {error}", program.display()))?;
    let table = String::from_utf8_lossy(&output.stdout).into_owned();
    match output.status.code() {
        Some(0) => Ok((table, true)),
        Some(1) => Ok((table, false)),
        _ => Err(String::from_utf8_lossy(&output.stderr).into_owned()),
    }
}

/// Splits a document into the text before the table, the table, and the text after it.
fn parts(document: &str) -> Result<(&str, &str, &str), String> {
    let lacking = |mark: &str| format!("{DOCUMENT} lacks the line {}", mark.trim());
    let begin = document.find(BEGIN).ok_or_else(|| lacking(BEGIN))? + BEGIN.len();
    let end = begin + document[begin..].find(END).ok_or_else(|| lacking(END))?;
    Ok((&document[..begin], &document[begin..end], &document[end..]))
}

/// Only the lines of the table.
fn rows_only(text: &str) -> String {
    text.lines().filter(|line| line.starts_with('|')).map(|line| format!("{line}\n")).collect()
}

/// The counts of each row. Percentages are left out, because they follow from the counts.
fn numbers(table: &str) -> Vec<(String, Vec<usize>)> {
    let rows = table.lines().filter(|line| line.starts_with('|')).skip(2);
    rows.filter_map(|row| {
        let mut cells = row.trim_matches('|').split('|');
        let name = cells.next()?.trim().to_owned();
        let counts = cells.flat_map(|cell| {
            let counts = cell.split('(').next().unwrap_or_default();
            counts.split_whitespace().filter_map(|word| word.parse().ok()).collect::<Vec<usize>>()
        });
        Some((name, counts.collect()))
    })
    .collect()
}

/// Compares two tables. Returns their number of rows if they agree.
fn compare(stated: &str, measured: &str) -> Result<usize, String> {
    let fix = "run `cargo xtask score` to update it";
    let (stated, measured) = (numbers(stated), numbers(measured));
    if measured.is_empty() || stated.len() != measured.len() {
        return Err(format!("{DOCUMENT} has {} exercises, {} were measured; {fix}", stated.len(), measured.len()));
    }
    for ((name, stated), (measured_name, measured)) in stated.iter().zip(&measured) {
        let same = stated.len() == measured.len() && stated.iter().zip(measured).all(|(a, b)| a.abs_diff(*b) <= STEPS);
        if name != measured_name || !same {
            return Err(format!("{DOCUMENT} states {stated:?} for {name}, measured {measured:?}; {fix}"));
        }
    }
    Ok(stated.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLE: &str = "\
| exercise | single, named right | pairs, named right | right answers | false alarms |
|---|---|---|---|---|
| ex03 | 20 of 20 (100 %) | 18 of 19 (95 %) | 12 | 0 |
| ex04 | 30 of 31 (97 %) | 15 of 16 (94 %) | 14 | 0 |
";

    #[test]
    fn numbers_of_a_table() {
        assert_eq!(numbers(TABLE)[1], ("ex04".to_owned(), vec![30, 31, 15, 16, 14, 0]));
    }

    #[test]
    fn the_document_must_agree_with_the_measurement() {
        assert_eq!(compare(TABLE, TABLE), Ok(2));
        assert_eq!(compare(TABLE, &TABLE.replace("30 of 31", "29 of 31")), Ok(2));
        assert!(compare(TABLE, &TABLE.replace("30 of 31", "27 of 31")).is_err());
        assert!(compare(TABLE, &TABLE.replace("| ex04", "| ex05")).is_err());
        assert!(compare(TABLE, "").is_err());
        let document = format!("a\n{BEGIN}{TABLE}{END}b\n");
        assert_eq!(parts(&document), Ok((format!("a\n{BEGIN}").as_str(), TABLE, format!("{END}b\n").as_str())));
        assert!(parts("nothing").is_err());
        assert_eq!(rows_only(&format!("{TABLE}\nex03: a was called b\n")), TABLE);
    }
}
