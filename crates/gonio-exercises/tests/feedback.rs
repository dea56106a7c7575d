//! Each level of feedback in each report: what it shows, and what it hides.
#![allow(clippy::unwrap_used)]

use gonio_check::WRONG_VALUE;
use gonio_check::comparison::Evidence;
use gonio_check::feedback::Feedback;
use gonio_check::testbench::Atlas;
use gonio_check::verdict::{
    CompilerMessage, FoundMistake, Outcome, Peculiarity, PropertyState, PropertyVerdict, ProposedEdit, SceneVerdict,
    TermState, TermVerdict, Verdict,
};
use gonio_exercises::report::{self, Overview, Row};

/// Words that only one part of [`verdict`] has, with the first level that shows the part.
const PARTS: [(&str, Feedback); 14] = [
    ("hillside", Feedback::Verdict),
    ("undeclared", Feedback::Verdict),
    ("skylark", Feedback::Name),
    ("murky", Feedback::Name),
    ("chapter", Feedback::Name),
    ("sepia", Feedback::Name),
    ("rotunda", Feedback::Name),
    ("halfway", Feedback::Name),
    ("student.frag", Feedback::Line),
    ("quotation", Feedback::Line),
    ("remedy", Feedback::Line),
    ("portable", Feedback::Line),
    ("oldtext", Feedback::Fix),
    ("newtext", Feedback::Fix),
];

/// A verdict with every part.
fn verdict() -> Verdict {
    let mut verdict = Verdict::new("ex04", Outcome::Wrong, "line 14: skylark");
    let found = FoundMistake::new("skylark-id", "skylark", 1.0).taught("murky", "remedy", "chapter");
    verdict.mistakes = vec![found.at("student.frag", Some(14), "quotation")];
    verdict.peculiarities = vec![Peculiarity { id: "halfway".to_owned(), name: "halfway".to_owned() }];
    verdict.warnings = vec!["student.frag:3: not portable".to_owned(), "ignored: notes.pdf".to_owned()];
    let edit = |line, before: &str, after: &str| ProposedEdit {
        file: "student.frag".to_owned(),
        line,
        before: before.to_owned(),
        after: after.to_owned(),
    };
    verdict.proposed_fix = vec![edit(14, "same\n  oldtext <>", "same\n  newtext <>")];
    verdict.terms = vec![TermVerdict { term: "sepia".into(), state: TermState::Wrong }];
    let scene = |scene: &str, right| SceneVerdict {
        scene: scene.to_owned(),
        shows: "what others do not".into(),
        right,
        pixels_beyond: 0.25,
        worst: 0.5,
    };
    verdict.scenes = vec![scene("hillside", true), scene("valley", false), scene("valley, sepia alone", false)];
    verdict.properties = vec![PropertyVerdict {
        id: "rotunda".to_owned(),
        sentence: "rotunda".to_owned(),
        state: PropertyState::Wrong,
        scenes: Vec::new(),
    }];
    verdict.messages = vec![CompilerMessage {
        file: "other.frag".to_owned(),
        line: Some(3),
        column: None,
        text: "undeclared".to_owned(),
        quoted: None,
        explanation: None,
    }];
    verdict
}

/// Each report about a verdict, by its name.
fn reports(verdict: &Verdict) -> Vec<(&'static str, String)> {
    let rows = [Row::new("ada", verdict, 0.5)];
    vec![
        ("json", serde_json::to_string(verdict).unwrap()),
        ("page", report::page("ada", verdict, None, &[])),
        ("junit", report::junit(&[("ada".to_owned(), verdict.clone())])),
        ("gradescope", report::gradescope(verdict, 10.0)),
        ("code runner", report::code_runner(verdict)),
        ("classroom", report::classroom(verdict, 10.0)),
        ("csv", report::csv(&rows, 100.0)),
        (
            "overview",
            report::overview(&Overview {
                title: "ex04",
                rows: &rows,
                similar: &[],
                skipped: &[],
                most_points: 100.0,
                has_scheme: false,
            }),
        ),
        ("rows", serde_json::to_string(&rows).unwrap()),
    ]
}

#[test]
fn no_report_shows_more_than_its_level() {
    let whole = reports(&verdict());
    for level in Feedback::ALL {
        let reduced = reports(&level.reduce(verdict()));
        for ((report, text), (_, whole)) in reduced.iter().zip(&whole) {
            for (word, first) in PARTS {
                let is_shown = text.contains(word);
                assert_eq!(is_shown, level >= first && whole.contains(word), "{word} in {report} at {level:?}");
            }
        }
        let (_, json) = &reduced[0];
        let of_level = PARTS.iter().filter(|(_, first)| level >= *first);
        assert!(of_level.clone().all(|(word, _)| json.contains(word)), "{level:?}: {json}");
        let (_, page) = &reduced[1];
        for (word, _) in of_level {
            assert!(page.contains(word), "{word} at {level:?}");
        }
    }
}

#[test]
fn files_that_were_ignored_are_named_at_every_level() {
    for level in Feedback::ALL {
        let warnings = level.reduce(verdict()).warnings;
        assert_eq!(warnings.len(), if level >= Feedback::Line { 2 } else { 1 }, "{level:?}");
        assert!(warnings.contains(&"ignored: notes.pdf".to_owned()), "{level:?}");
    }
}

#[test]
fn without_names_the_summary_counts_test_scenes() {
    assert_eq!(Feedback::Verdict.reduce(verdict()).summary, "1 of 2 test scenes are right");
    assert_eq!(Feedback::Name.reduce(verdict()).summary, "skylark");
    assert_eq!(Feedback::Line.reduce(verdict()).summary, verdict().summary);
    for outcome in [Outcome::Correct, Outcome::DoesNotCompile, Outcome::Unsure] {
        let other = Verdict::new("ex04", outcome, "what is missing");
        assert_eq!(Feedback::Verdict.reduce(other).summary, "what is missing", "{outcome:?}");
    }
    let no_scenes = Verdict::new("ex02", Outcome::Wrong, "the triangles are reversed");
    assert_eq!(Feedback::Verdict.reduce(no_scenes).summary, "the answer is not right");
}

#[test]
fn the_name_of_a_mistake_in_no_list_is_not_shown_without_its_line() {
    let mut unlisted = verdict();
    let name = "`d` should be the distance to the light";
    unlisted.mistakes[0] = FoundMistake::new(WRONG_VALUE, name, 1.0).taught("here it is another", "remedy", "");
    unlisted.summary = unlisted.mistake_names();
    let shown = |level: Feedback| serde_json::to_string(&level.reduce(unlisted.clone())).unwrap();
    for (level, is_shown) in [(Feedback::Name, false), (Feedback::Line, true)] {
        assert_eq!(shown(level).contains("distance"), is_shown, "{level:?}");
        assert_eq!(shown(level).contains("another"), is_shown, "{level:?}");
    }
    assert!(shown(Feedback::Name).contains("A value is wrong"));
}

#[test]
fn predictions_are_pictures_of_mistakes() {
    let atlas = || Atlas { pixels: vec![[0.5; 4]] };
    for level in Feedback::ALL {
        let evidence =
            Evidence { seen: atlas(), reference: atlas(), predicted: Some(atlas()), scenes: vec!["lab".to_owned()] };
        assert_eq!(level.reduce_pictures(evidence).predicted.is_some(), level >= Feedback::Name, "{level:?}");
    }
}

#[test]
fn a_diff_has_signs_and_keeps_its_indentation() {
    let reports = reports(&verdict());
    let report = |name: &str| &reports.iter().find(|(known, _)| *known == name).unwrap().1;
    for (name, lines) in [
        ("page", ["  same", "-   oldtext &lt;&gt;", "+   newtext &lt;&gt;"]),
        ("junit", ["  same", "-   oldtext &lt;&gt;", "+   newtext &lt;&gt;"]),
        ("gradescope", ["  same", "-   oldtext <>", "+   newtext <>"]),
        ("code runner", ["  same", "-   oldtext &lt;&gt;", "+   newtext &lt;&gt;"]),
    ] {
        let text = report(name);
        assert!(lines.iter().all(|line| text.contains(line)), "{name}: {text}");
        assert!(text.contains("With this change every test scene is right."), "{name}: {text}");
    }
    assert!(report("page").contains("<code class=\"removed\">") && report("page").contains("<code class=\"added\">"));
}
