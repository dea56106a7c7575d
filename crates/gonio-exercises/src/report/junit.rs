//! JUnit XML, which build servers read.

use super::text::{escaped, escaped_line, line, percent, place, plain, word};
use gonio_check::proposed_fix;
use gonio_check::testbench::scene;
use gonio_check::verdict::{FoundMistake, Outcome, ProposedEdit, TermState, Verdict};
use gonio_language::tr;
use std::fmt::Write as _;

/// JUnit XML: a suite for each exercise and submission, with a case for the verdict, one for each term and one for each scene.
///
/// Used: `testsuites` and `testsuite` with `name`, `tests`, `failures`, `errors` and `skipped`; `testcase` with `classname`,
/// `name` and, where the mistake's place is known, `file` and `line`; in it `failure` (wrong), `error` (it does not compile, or
/// could not be judged) or `skipped` (a term that cannot be tested alone), each with `message`; `system-out` for
/// peculiarities and warnings. `verdicts` are labels with their verdicts. A wrong term or scene is a failure
/// of its own, so a suite can have more failures than there are mistakes.
pub fn junit(verdicts: &[(String, Verdict)]) -> String {
    let mut all = Counts::default();
    let mut suites = String::new();
    for (label, verdict) in verdicts {
        let (suite, counts) = suite(label, verdict);
        suites.push_str(&suite);
        all.add(&counts);
    }
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"gonio lab\" {}>\n{suites}</testsuites>\n",
        all.attributes()
    )
}

#[derive(Default)]
struct Counts {
    tests: usize,
    failures: usize,
    errors: usize,
    skipped: usize,
}

impl Counts {
    fn add(&mut self, other: &Counts) {
        self.tests += other.tests;
        self.failures += other.failures;
        self.errors += other.errors;
        self.skipped += other.skipped;
    }

    fn attributes(&self) -> String {
        let Counts { tests, failures, errors, skipped } = self;
        format!("tests=\"{tests}\" failures=\"{failures}\" errors=\"{errors}\" skipped=\"{skipped}\"")
    }
}

/// The result of a case, with text that is already escaped.
enum End {
    Passed,
    Failure(String),
    Error(String),
    Skipped(String),
}

fn suite(label: &str, verdict: &Verdict) -> (String, Counts) {
    let suite_name = format!("{} {}", escaped_line(&verdict.exercise), escaped_line(label));
    let mut counts = Counts::default();
    let mut cases = String::new();
    let mut case = |name: &str, attributes: &str, end: End| {
        counts.tests += 1;
        let inner = match end {
            End::Passed => None,
            End::Failure(inner) => {
                counts.failures += 1;
                Some(inner)
            }
            End::Error(inner) => {
                counts.errors += 1;
                Some(inner)
            }
            End::Skipped(inner) => {
                counts.skipped += 1;
                Some(inner)
            }
        };
        let head = format!("    <testcase classname=\"{suite_name}\" name=\"{name}\"{attributes}");
        // Writing into a String cannot fail.
        let _ = match inner {
            None => writeln!(cases, "{head}/>"),
            Some(inner) => writeln!(cases, "{head}>\n      {inner}\n    </testcase>"),
        };
    };
    case("verdict", &place_attributes(verdict), whole(verdict));
    for term in &verdict.terms {
        let end = match term.state {
            TermState::Right => End::Passed,
            TermState::Wrong => {
                let message = tr!("report-term-is-wrong", term = scene::term_title(&term.term));
                End::Failure(format!("<failure message=\"{}\"/>", escaped_line(&message)))
            }
            TermState::NotSeparable => {
                let message = escaped_line(tr!("report-not-tested-separately-reason"));
                End::Skipped(format!("<skipped message=\"{message}\"/>"))
            }
        };
        case(&format!("term: {}", escaped_line(&term.term)), "", end);
    }
    for scene in &verdict.scenes {
        let end = match scene.right {
            true => End::Passed,
            false => {
                let (percent, worst) = (percent(scene.pixels_beyond), format!("{:.3}", scene.worst));
                let message = escaped_line(&tr!("report-pixels-differ", percent = percent, worst = worst));
                End::Failure(format!("<failure message=\"{message}\">{}</failure>", escaped(&scene.shows)))
            }
        };
        case(&format!("scene: {}", escaped_line(&scene.scene)), "", end);
    }
    let output: Vec<String> = verdict
        .peculiarities
        .iter()
        .map(|peculiarity| tr!("report-other-method", name = escaped_line(&peculiarity.name)))
        .chain(verdict.warnings.iter().map(|warning| tr!("report-warning", text = escaped_line(warning))))
        .collect();
    let output = match output.is_empty() {
        true => String::new(),
        false => format!("    <system-out>{}</system-out>\n", output.join("\n")),
    };
    let suite = format!("  <testsuite name=\"{suite_name}\" {}>\n{cases}{output}  </testsuite>\n", counts.attributes());
    (suite, counts)
}

/// The place of the first mistake, or of the first message of the compiler.
fn place_attributes(verdict: &Verdict) -> String {
    let of_mistake = verdict.mistakes.iter().find_map(|mistake| Some((mistake.file.as_deref()?, mistake.line)));
    let of_message = verdict.messages.first().map(|message| (message.file.as_str(), message.line));
    let Some((file, line)) = of_mistake.or(of_message) else { return String::new() };
    let number = line.map_or_else(String::new, |line| format!(" line=\"{line}\""));
    format!(" file=\"{}\"{number}", escaped_line(file))
}

fn whole(verdict: &Verdict) -> End {
    let message = escaped_line(&verdict.summary);
    let kind = word(verdict.verdict);
    match verdict.verdict {
        Outcome::Correct => End::Passed,
        Outcome::Wrong => {
            let kind = match verdict.mistakes.as_slice() {
                [] => kind.to_owned(),
                some => some.iter().map(|mistake| escaped_line(&mistake.id)).collect::<Vec<_>>().join(" "),
            };
            let text: Vec<String> =
                verdict.mistakes.iter().map(mistake_text).chain(proposed_fix_text(&verdict.proposed_fix)).collect();
            let text = escaped(&text.join("\n"));
            End::Failure(format!("<failure type=\"{kind}\" message=\"{message}\">{text}</failure>"))
        }
        Outcome::DoesNotCompile | Outcome::Unsure => {
            let text: Vec<String> = verdict
                .messages
                .iter()
                .map(|message| {
                    let place = place(Some(&message.file), message.line).unwrap_or_default();
                    format!("{place}: {}", line(&message.text))
                })
                .collect();
            let text = escaped(&text.join("\n"));
            End::Error(format!("<error type=\"{kind}\" message=\"{message}\">{text}</error>"))
        }
    }
}

/// The proposed fix as a unified diff, in lines of plain text.
pub fn proposed_fix_text(edits: &[ProposedEdit]) -> Vec<String> {
    if edits.is_empty() {
        return Vec::new();
    }
    let mut lines = vec![String::new(), proposed_fix::promise(edits).to_owned()];
    for edit in edits {
        lines.extend(place(Some(&edit.file), Some(edit.line)).map(|place| format!("  {place}")));
        lines.extend(edit.diff().iter().map(|line| format!("    {} {}", line.sign(), plain(line.text().trim_end()))));
    }
    lines
}

fn mistake_text(mistake: &FoundMistake) -> String {
    let mut text = line(&mistake.name);
    if let Some(place) = place(mistake.file.as_deref(), mistake.line) {
        let _ = write!(text, "\n{}", tr!("report-at", place = place));
    }
    if let Some(quoted) = &mistake.quoted {
        let _ = write!(text, "\n  {}", line(quoted));
    }
    let _ = write!(text, "\n{}", tr!("report-explains", percent = percent(mistake.share_explained)));
    if !mistake.fix.is_empty() {
        let _ = write!(text, "\n{}", tr!("report-to-fix-it", fix = line(&mistake.fix)));
    }
    text
}
