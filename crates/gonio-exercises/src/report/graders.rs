//! Results for the graders of courses: Gradescope, CodeRunner in Moodle, and GitHub Classroom.

use super::junit::proposed_fix_text;
use super::text::{line, percent, place, plain, points, points_line, unit, words};
use super::verdict_parts::{messages_html, mistakes_html, notes_html, proposed_fix_html, verdict_html};
use gonio_check::testbench::scene;
use gonio_check::verdict::{Outcome, SceneVerdict, TermState, TermVerdict, Verdict};
use gonio_language::tr;
use serde_json::{Value, json};

/// The content of Gradescope's `results.json`.
///
/// Used: `score`, which is the verdict's share of `max_score` (at least 0; NaN counts as 0) and overrides the tests' sum;
/// `output` as `text`, so that nothing in it is read as markup; `test_output_format`; `visibility` and `stdout_visibility`;
/// `tests` with `name`, `status`, `score`, `max_score`, `output` and `visibility`: the verdict, the terms and the scenes. The
/// scenes share `max_score` evenly; without scenes it belongs to the verdict. Terms have a status but no points; terms that
/// cannot be tested alone have no status either.
pub fn gradescope(verdict: &Verdict, max_score: f64) -> String {
    let max_score = if max_score.is_finite() { max_score.max(0.0) } else { 0.0 };
    let share_of = |share: f64| {
        let share = if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 };
        (share * max_score * 1e6).round() / 1e6
    };
    let mut tests = vec![whole(verdict)];
    if verdict.scenes.is_empty() {
        tests[0]["score"] = json!(share_of(verdict.score));
        tests[0]["max_score"] = json!(max_score);
    }
    for term in &verdict.terms {
        let mut test = json!({
            "name": term_name(term),
            "output": term_words(term.state),
            "visibility": "visible",
        });
        if let Some(right) = is_right(term.state) {
            test["status"] = json!(status(right));
        }
        tests.push(test);
    }
    let each = share_of(1.0 / verdict.scenes.len().max(1) as f64);
    for scene in &verdict.scenes {
        tests.push(json!({
            "name": scene_name(scene),
            "status": status(scene.right),
            "score": if scene.right { each } else { 0.0 },
            "max_score": each,
            "output": scene_words(scene),
            "visibility": "visible",
        }));
    }
    json!({
        "score": share_of(verdict.score),
        "output": text_output(verdict),
        "output_format": "text",
        "test_output_format": "text",
        "visibility": "visible",
        "stdout_visibility": "hidden",
        "tests": tests,
    })
    .to_string()
}

/// The result of a step that GitHub Classroom's autograding reporter reads, in base64, from an environment variable.
///
/// Used: `max_score`, and one test with `score`, `status` and `message`. The grade is the sum of the scores; the table that the reporter
/// prints in its log counts tests that passed, and so shows a partly right answer as 0.
pub fn classroom(verdict: &Verdict, max_score: f64) -> String {
    let max_score = if max_score.is_finite() { max_score.max(0.0) } else { 0.0 };
    let status = match verdict.verdict {
        Outcome::Correct => "pass",
        Outcome::Wrong | Outcome::DoesNotCompile => "fail",
        Outcome::Unsure => "error",
    };
    json!({
        "version": 1,
        "status": status,
        "max_score": max_score,
        "tests": [{
            "name": line(&verdict.exercise),
            "status": status,
            "score": points(verdict.score, max_score),
            "message": text_output(verdict),
            "test_code": "",
            "filename": "",
            "line_no": 0,
            "execution_time": 0,
        }],
    })
    .to_string()
}

/// The result that a combinator template grader of Moodle's CodeRunner returns.
///
/// Used: `fraction`; `prologuehtml`, the verdict, the mistakes, the proposed change and the compiler's messages; `testresults`, whose first row names
/// the columns (`iscorrect` is shown as tick or cross), with one row per term and scene; `columnformats`, all `%s`, so that the
/// page escapes the cells; `epiloguehtml`, peculiarities and warnings. Not used: `got`, which belongs to graders of single
/// tests. CodeRunner rejects a combinator's answer with any other field.
pub fn code_runner(verdict: &Verdict) -> String {
    let row = |right: bool, name: String, result: String| json!([u8::from(right), name, result]);
    let mut results = vec![json!(["iscorrect", tr!("report-test"), tr!("report-result")])];
    results.push(row(verdict.verdict == Outcome::Correct, tr!("report-verdict").to_owned(), line(&verdict.summary)));
    for term in &verdict.terms {
        // A row has a tick or a cross: a term that was not tested has neither.
        if let Some(right) = is_right(term.state) {
            results.push(row(right, term_name(term), term_words(term.state).to_owned()));
        }
    }
    for scene in &verdict.scenes {
        results.push(row(scene.right, scene_name(scene), scene_words(scene)));
    }
    let prologue = [
        verdict_html(verdict, false),
        mistakes_html(verdict, None),
        proposed_fix_html(verdict, None),
        messages_html(verdict, None),
    ];
    let prologue = prologue.concat();
    json!({
        "fraction": unit(verdict.score),
        "prologuehtml": prologue,
        "testresults": results,
        "columnformats": ["%s", "%s", "%s"],
        "epiloguehtml": notes_html(verdict),
    })
    .to_string()
}

fn term_name(term: &TermVerdict) -> String {
    tr!("report-term", term = line(&scene::term_title(&term.term)))
}

fn scene_name(verdict: &SceneVerdict) -> String {
    tr!("report-scene", scene = line(&scene::title(&verdict.scene)))
}

fn outcome_and_summary(verdict: &Verdict) -> String {
    tr!("report-outcome-and-summary", outcome = words(verdict.verdict), summary = plain(&verdict.summary))
}

fn status(right: bool) -> &'static str {
    if right { "passed" } else { "failed" }
}

fn is_right(state: TermState) -> Option<bool> {
    match state {
        TermState::Right => Some(true),
        TermState::Wrong => Some(false),
        TermState::NotSeparable => None,
    }
}

fn term_words(state: TermState) -> &'static str {
    match state {
        TermState::Right => tr!("report-right"),
        TermState::Wrong => tr!("report-wrong"),
        TermState::NotSeparable => tr!("report-not-tested-separately-reason"),
    }
}

fn scene_words(scene: &SceneVerdict) -> String {
    match scene.right {
        true => tr!("report-same-as-reference", shows = line(&scene.shows)),
        false => tr!(
            "report-differs-from-reference",
            percent = percent(scene.pixels_beyond),
            worst = format!("{:.3}", scene.worst),
            shows = line(&scene.shows)
        ),
    }
}

fn whole(verdict: &Verdict) -> Value {
    json!({
        "name": tr!("report-verdict"),
        "status": status(verdict.verdict == Outcome::Correct),
        "output": outcome_and_summary(verdict),
        "visibility": "visible",
    })
}

/// Everything that a student should read, as plain text.
fn text_output(verdict: &Verdict) -> String {
    let mut lines = vec![outcome_and_summary(verdict)];
    lines.extend(verdict.points.as_ref().map(points_line));
    for mistake in &verdict.mistakes {
        lines.push(String::new());
        lines.push(format!("{} [{}]", line(&mistake.name), line(&mistake.id)));
        if let Some(place) = place(mistake.file.as_deref(), mistake.line) {
            lines.push(tr!("report-where", place = place));
        }
        if let Some(quoted) = &mistake.quoted {
            lines.push(format!("    {}", line(quoted)));
        }
        lines.push(tr!("report-explains-lines", percent = percent(mistake.share_explained)));
        for (heading, text) in [
            (tr!("report-looks-like"), &mistake.looks_like),
            (tr!("report-fix"), &mistake.fix),
            (tr!("report-lecture"), &mistake.lecture_section),
        ] {
            if !text.is_empty() {
                lines.push(tr!("report-heading", heading = heading, text = line(text)));
            }
        }
    }
    lines.extend(proposed_fix_text(&verdict.proposed_fix));
    for message in &verdict.messages {
        lines.push(String::new());
        let place = place(Some(&message.file), message.line).unwrap_or_default();
        lines.push(format!("{place}: {}", line(&message.text)));
        lines.extend(message.quoted.as_deref().map(|quoted| format!("    {}", line(quoted))));
        lines.extend(message.explanation.as_deref().map(|explanation| format!("  {}", line(explanation))));
    }
    if !verdict.peculiarities.is_empty() || !verdict.warnings.is_empty() {
        lines.push(String::new());
    }
    lines.extend(verdict.peculiarities.iter().map(|known| tr!("report-other-method", name = line(&known.name))));
    lines.extend(verdict.warnings.iter().map(|warning| tr!("report-warning", text = line(warning))));
    lines.join("\n")
}
