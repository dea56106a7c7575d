//! Hostile names and sources in every format, each read back by an independent reader.
#![allow(clippy::unwrap_used)]

use super::*;
use gonio_check::comparison::Evidence;
use gonio_check::submission::SourceFile;
use gonio_check::testbench::{Atlas, TILE};
use gonio_check::verdict::{
    BoundVariable, CompilerMessage, FoundMistake, Outcome, Peculiarity, ProposedEdit, SceneVerdict, TermState,
    TermVerdict, Verdict,
};
use gonio_render::user_program::NOT_DRAWN;
use serde_json::Value;

/// Everything that may end a quotation too early.
const EVIL: &str = "</script><script>alert('1')</script>\"'&amp;<!--]]>\0\u{1b}[2J\u{202e}txt\u{2066}\u{200f}\u{feff}\u{ffff}\r\n=1+1`;\\";

/// A verdict with [`EVIL`] in every text that comes from a student's file or the driver.
fn evil(outcome: Outcome) -> Verdict {
    let evil = || EVIL.to_owned();
    let mut verdict = Verdict::new("ex04", outcome, EVIL);
    let found = FoundMistake::new("normal-by-model-matrix", EVIL, 0.9971).taught(EVIL, EVIL, EVIL);
    verdict.mistakes = vec![FoundMistake {
        or: vec![evil(), "diffuse-absolute".to_owned()],
        lab_does_it: true,
        ..found.at(EVIL, Some(14), EVIL)
    }];
    verdict.peculiarities = vec![Peculiarity { id: evil(), name: evil() }];
    verdict.warnings = vec![evil()];
    verdict.proposed_fix = vec![ProposedEdit { file: evil(), line: 14, before: evil(), after: format!("{EVIL}x") }];
    verdict.terms = vec![
        TermVerdict { term: "ambient".into(), state: TermState::Right },
        TermVerdict { term: "diffuse".into(), state: TermState::Wrong },
        TermVerdict { term: "specular".into(), state: TermState::NotSeparable },
    ];
    let scene = |scene: &str, right, pixels_beyond, worst| SceneVerdict {
        scene: scene.to_owned(),
        shows: "what others do not".into(),
        right,
        pixels_beyond,
        worst,
    };
    verdict.scenes = vec![
        scene("lab", true, 0.0, 0.0),
        scene(EVIL, false, f64::NAN, f32::NAN),
        scene("lab, diffuse alone", false, 0.5, 0.25),
    ];
    verdict.messages = vec![CompilerMessage {
        file: evil(),
        line: Some(3),
        column: Some(7),
        text: evil(),
        quoted: Some(evil()),
        explanation: Some(evil()),
    }];
    let bound = |role| BoundVariable { name: evil(), glsl_type: evil(), role };
    verdict.bound = vec![bound(Some(evil())), bound(None)];
    verdict.score = 1.0 / 3.0;
    verdict
}

fn evidence() -> Evidence {
    let size = (TILE * TILE) as usize;
    let mut seen = vec![[0.5, 0.25, 2.0, 0.0]; 3 * size];
    seen[5] = [f32::NAN, 0.0, f32::INFINITY, 1.0];
    seen[6] = NOT_DRAWN;
    let reference = Atlas { pixels: vec![[0.4, 0.25, 1.0, 1.0]; 3 * size] };
    let scenes = vec!["lab".to_owned(), EVIL.to_owned()];
    Evidence { seen: Atlas { pixels: seen }, predicted: Some(reference.clone()), reference, scenes }
}

/// The content of a markup file.
#[derive(Debug, Default)]
struct Markup {
    /// Elements in order, with their attributes.
    elements: Vec<(String, Vec<(String, String)>)>,
    /// All text, with references resolved.
    text: String,
}

impl Markup {
    /// The values of an attribute, in order.
    fn attributes<'a>(&'a self, wanted: &'a str) -> impl Iterator<Item = &'a str> {
        let all = self.elements.iter().flat_map(|(_, attributes)| attributes);
        all.filter(move |(name, _)| name == wanted).map(|(_, value)| value.as_str())
    }
}

/// Reads XML, and HTML that is written like it: elements in `empty` need no end tag.
fn read_markup(source: &str, empty: &[&str]) -> Markup {
    assert!(
        source
            .chars()
            .all(|c| matches!(c, '\t' | '\n' | '\r' | '\u{20}'..='\u{d7ff}' | '\u{e000}'..='\u{fffd}' | '\u{10000}'..)),
        "a character that XML forbids"
    );
    let mut markup = Markup::default();
    let mut open: Vec<String> = Vec::new();
    let mut rest = source;
    while let Some(start) = rest.find('<') {
        markup.text.push_str(&resolved(&rest[..start]));
        let (tag, after) = rest[start + 1..].split_once('>').expect("a tag that does not end");
        rest = after;
        if tag.starts_with(['?', '!']) {
            assert!(markup.elements.is_empty(), "only allowed at the beginning: {tag}");
        } else if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop().as_deref(), Some(name));
        } else {
            let (tag, is_closed) = tag.strip_suffix('/').map_or((tag, false), |tag| (tag, true));
            let (name, attributes) = tag.split_once(' ').unwrap_or((tag, ""));
            assert!(!name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '-'), "{tag}");
            markup.elements.push((name.to_owned(), read_attributes(attributes)));
            if !is_closed && !empty.contains(&name) {
                open.push(name.to_owned());
            }
        }
    }
    assert!(open.is_empty(), "{open:?}");
    assert!(rest.trim().is_empty(), "{rest}");
    markup
}

fn read_attributes(mut text: &str) -> Vec<(String, String)> {
    let mut attributes: Vec<(String, String)> = Vec::new();
    loop {
        text = text.trim_start();
        if text.is_empty() {
            return attributes;
        }
        // HTML has attributes without a value.
        let end = text.find(['=', ' ']).unwrap_or(text.len());
        let (name, after) = text.split_at(end);
        assert!(name.chars().all(|c| c.is_ascii_alphabetic() || c == '-' || c == ':'), "{name}");
        assert!(attributes.iter().all(|(known, _)| known != name), "{name} twice");
        let Some(after) = after.strip_prefix('=') else {
            attributes.push((name.to_owned(), String::new()));
            text = after;
            continue;
        };
        let quote = after.chars().next().filter(|c| matches!(c, '"' | '\'')).expect("an attribute in quotes");
        let (value, after) = after[1..].split_once(quote).expect("an attribute that ends");
        assert!(!value.contains('<'), "{value}");
        attributes.push((name.to_owned(), resolved(value)));
        text = after;
    }
}

fn resolved(text: &str) -> String {
    let mut parts = text.split('&');
    let mut resolved = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let (name, after) = part.split_once(';').expect("an & without a known entity");
        resolved.push(match name {
            "amp" => '&',
            "lt" => '<',
            "gt" => '>',
            "quot" => '"',
            "#39" => '\'',
            other => panic!("&{other};"),
        });
        resolved.push_str(after);
    }
    resolved
}

/// Reads a page, which runs nothing but the overview's own script, and whose links lead to pages beside it and to places in it.
fn read_page(page: &str) -> Markup {
    assert!(page.starts_with("<!DOCTYPE html>\n"));
    let page = page.replacen(&format!("<script>{}</script>\n", overview::SCRIPT), "", 1);
    let markup = read_markup(&page, &["meta", "img", "br", "input"]);
    let ids: Vec<&str> = markup.attributes("id").collect();
    for (index, id) in ids.iter().enumerate() {
        assert!(!ids[..index].contains(id), "{id} twice");
    }
    for (name, attributes) in &markup.elements {
        assert!(!["script", "iframe", "object", "base", "form", "link"].contains(&name.as_str()), "{name}");
        for (attribute, value) in attributes {
            assert!(!attribute.starts_with("on"), "{attribute}");
            let is_safe = match attribute.as_str() {
                "src" => value.starts_with("data:image/png;base64,"),
                "href" => match value.split_once('#') {
                    Some(("", place)) => ids.contains(&place),
                    Some((page, place)) => {
                        page.starts_with("./") && page.ends_with(".html") && place.starts_with("finding-")
                    }
                    None => value.starts_with("./") && value.ends_with(".html"),
                },
                "for" => ids.contains(&value.as_str()),
                _ => true,
            };
            assert!(is_safe, "{attribute}={value}");
        }
    }
    nothing_invisible(&page);
    markup
}

fn nothing_invisible(text: &str) {
    let hidden: String = text.chars().filter(|&c| is_hidden(c) && !matches!(c, '\n' | '\r' | '\t')).collect();
    assert!(hidden.is_empty(), "{hidden:?}");
}

/// Reads CSV with a byte order mark. Quoted cells may contain anything, the others no comma, quote or line break.
fn read_csv(table: &str) -> Vec<Vec<String>> {
    let (mut rows, mut row, mut cell, mut quoted) = (Vec::new(), Vec::new(), String::new(), false);
    let mut characters = table.strip_prefix('\u{feff}').expect("a byte order mark").chars().peekable();
    while let Some(c) = characters.next() {
        match (quoted, c) {
            (true, '"') if characters.peek() == Some(&'"') => cell.extend(characters.next()),
            (true, '"') => {
                quoted = false;
                assert!(matches!(characters.peek(), Some(',' | '\r')), "text after a quotation");
            }
            (true, c) => cell.push(c),
            (false, '"') => {
                assert!(cell.is_empty(), "a quote within a cell");
                quoted = true;
            }
            (false, ',') => row.push(std::mem::take(&mut cell)),
            (false, '\r') => {
                assert_eq!(characters.next(), Some('\n'));
                row.push(std::mem::take(&mut cell));
                rows.push(std::mem::take(&mut row));
            }
            (false, c) => {
                assert_ne!(c, '\n');
                cell.push(c);
            }
        }
    }
    assert!(!quoted && row.is_empty() && cell.is_empty());
    rows
}

const OUTCOMES: [Outcome; 4] = [Outcome::Correct, Outcome::Wrong, Outcome::DoesNotCompile, Outcome::Unsure];

#[test]
fn junit_counts_its_cases() {
    let verdicts: Vec<(String, Verdict)> =
        OUTCOMES.into_iter().map(|outcome| (EVIL.to_owned(), evil(outcome))).collect();
    let xml = junit(&verdicts);
    nothing_invisible(&xml);
    let markup = read_markup(&xml, &[]);
    let count = |expected: &str| markup.elements.iter().filter(|(name, _)| name == expected).count();
    // Each has the verdict, three terms and three scenes. One term and two scenes are wrong, and the verdict once.
    assert_eq!((count("testsuite"), count("testcase")), (4, 28));
    assert_eq!((count("failure"), count("error"), count("skipped")), (13, 2, 4));
    let (name, attributes) = &markup.elements[0];
    assert_eq!(name, "testsuites");
    for (attribute, value) in [("tests", "28"), ("failures", "13"), ("errors", "2"), ("skipped", "4")] {
        assert!(attributes.contains(&(attribute.to_owned(), value.to_owned())), "{attribute}: {attributes:?}");
    }
    let (_, attributes) = markup.elements.iter().find(|(name, _)| name == "testcase").unwrap();
    assert!(attributes.contains(&("line".to_owned(), "14".to_owned())), "{attributes:?}");
    let (_, attributes) = &markup.elements.iter().find(|(name, _)| name == "failure").unwrap();
    assert!(attributes[0].1.contains("</script><script>alert('1')") || attributes[0].1.contains("diffuse"));
    assert!(markup.text.contains("explains 99.7 % of the difference"));
    assert_eq!(read_markup(&junit(&[]), &[]).elements.len(), 1);
}

#[test]
fn junit_fails_the_terms_that_are_wrong_and_no_others() {
    for state in [TermState::Right, TermState::Wrong, TermState::NotSeparable] {
        let mut verdict = Verdict::new("ex07", Outcome::Wrong, "wrong");
        verdict.terms = vec![TermVerdict { term: "diffuse".into(), state }];
        let xml = junit(&[("a".to_owned(), verdict)]);
        assert_eq!(xml.contains("the diffuse term is wrong"), state == TermState::Wrong, "{state:?}");
    }
}

#[test]
fn gradescope_gets_points_and_reasons() {
    for outcome in OUTCOMES {
        let text = gradescope(&evil(outcome), 12.0);
        nothing_invisible(&text);
        let json: Value = serde_json::from_str(&text).unwrap();
        assert_eq!(json["score"], 4.0);
        assert_eq!(json["output_format"], "text");
        let tests = json["tests"].as_array().unwrap();
        assert_eq!(tests.len(), 7);
        let sum = |key: &str| tests.iter().filter_map(|test| test[key].as_f64()).sum::<f64>();
        assert_eq!((sum("score"), sum("max_score")), (4.0, 12.0));
        let status = if outcome == Outcome::Correct { "passed" } else { "failed" };
        assert_eq!(tests[0]["status"], status);
        assert!(tests[3].get("status").is_none(), "{}", tests[3]);
        assert!(tests.iter().all(|test| test["visibility"] == "visible" && test["output"].is_string()));
        assert!(json["output"].as_str().unwrap().contains(":14\n"));
    }
}

#[test]
fn gradescope_without_scenes_and_without_numbers() {
    let json: Value =
        serde_json::from_str(&gradescope(&Verdict::new("ex04", Outcome::DoesNotCompile, "it does not"), 5.0)).unwrap();
    assert_eq!((json["score"].as_f64(), json["tests"][0]["max_score"].as_f64()), (Some(0.0), Some(5.0)));
    let mut verdict = Verdict::new("ex04", Outcome::Correct, "");
    for (score, max_score, expected) in
        [(f64::NAN, 5.0, 0.0), (1.0, f64::NAN, 0.0), (1.0, -3.0, 0.0), (7.0, 5.0, 5.0), (1.0, f64::INFINITY, 0.0)]
    {
        verdict.score = score;
        let json: Value = serde_json::from_str(&gradescope(&verdict, max_score)).unwrap();
        assert_eq!(json["score"].as_f64(), Some(expected), "{score} {max_score}");
    }
}

#[test]
fn code_runner_gets_only_fields_that_it_knows() {
    for outcome in OUTCOMES {
        let text = code_runner(&evil(outcome));
        nothing_invisible(&text);
        let json: Value = serde_json::from_str(&text).unwrap();
        let known = ["fraction", "prologuehtml", "testresults", "columnformats", "epiloguehtml"];
        assert!(json.as_object().unwrap().keys().all(|key| known.contains(&key.as_str())), "{json}");
        assert_eq!(json["fraction"], 0.333333);
        let results = json["testresults"].as_array().unwrap();
        let columns = json["columnformats"].as_array().unwrap().len();
        assert!(results.iter().all(|row| row.as_array().unwrap().len() == columns));
        // The header, the verdict, two terms that could be tested, three scenes.
        assert_eq!(results.len(), 7);
        assert_eq!(results[0][0], "iscorrect");
        assert_eq!(results[1][0], u8::from(outcome == Outcome::Correct));
        let html =
            format!("<div>{}{}</div>", json["prologuehtml"].as_str().unwrap(), json["epiloguehtml"].as_str().unwrap());
        let markup = read_markup(&html, &[]);
        assert!(markup.elements.iter().all(|(name, _)| name != "script" && name != "svg"));
        assert!(markup.text.contains("</script><script>alert('1')"));
    }
}

fn evil_row() -> Row {
    Row::new(EVIL, &evil(Outcome::Wrong), 0.25)
}

#[test]
fn a_table_has_a_line_per_submission() {
    let mut second = evil(Outcome::DoesNotCompile);
    second.mistakes.clear();
    second.messages[0].file = "a b.frag".to_owned();
    second.summary = "`lum` is not declared".to_owned();
    let mut third = evil(Outcome::Wrong);
    third.mistakes[0] = FoundMistake::new("normal-by-model-matrix", "The normal is wrong", 0.9971);
    third.mistakes.push(FoundMistake {
        id: "ambient-twice".to_owned(),
        name: "A is added twice".to_owned(),
        ..third.mistakes[0].clone().at("a b.frag", Some(14), "")
    });
    third.warnings.clear();
    let rows = [evil_row(), Row::new("second", &second, f64::NAN), Row::new("José, 中村", &third, 1.0)];
    let table = csv(&rows, 20.0);
    assert!(table.as_bytes().starts_with(b"\xEF\xBB\xBFname,verdict,points,"), "{table}");
    nothing_invisible(table.trim_start_matches('\u{feff}'));
    let read = read_csv(&table);
    assert_eq!(read.len(), 4);
    assert!(read.iter().all(|row| row.len() == 13), "{read:?}");
    assert!(read[1][0].starts_with("</script>") && read[1][0].contains("\\r\\n=1+1"), "{:?}", read[1][0]);
    assert_eq!(read[2][..6], ["second", "does-not-compile", "6.67", "20", "", "a b.frag:3: `lum` is not declared"]);
    assert_eq!((read[2][10].as_str(), read[2][12].as_str()), ("a b.frag:3", "0.000"));
    let reason = "The normal is wrong; a b.frag:14: A is added twice";
    let titles = "The normal is wrong; A is added twice";
    assert_eq!(read[3][..6], ["José, 中村", "wrong", "6.67", "20", titles, reason]);
    let ids = "normal-by-model-matrix ambient-twice";
    assert_eq!(read[3][6..], ["ex04", "0.3333", ids, "0.9971 0.9971", "? a_b.frag:14", "", "1.000"]);
}

#[test]
fn no_cell_is_a_formula() {
    for label in ["=1+1", "+1", "-1", "@SUM(A1)", "  =1", "\u{200b}=1", "\t=1", "\r\n=1", "\0=1", "＝1"] {
        let mut row = evil_row();
        row.submission = label.to_owned();
        row.mistakes[0].name = label.to_owned();
        row.mistakes[0].place = None;
        let read = read_csv(&csv(&[row], 1.0));
        assert!(read[1][0].starts_with('\''), "{label:?}: {:?}", read[1][0]);
        // The title and the reason begin with an apostrophe, or with the escape of a hidden character.
        for column in [4, 5] {
            assert!(read[1][column].starts_with(['\'', '\\']), "{label:?}: {:?}", read[1][column]);
        }
    }
    for (label, expected) in
        [("=cmd|' /C calc'!A0", "'=cmd|' /C calc'!A0"), ("a=b", "a=b"), ("علی\u{200c}رضا", "علی\u{200c}رضا")]
    {
        let mut row = evil_row();
        row.submission = label.to_owned();
        assert_eq!(read_csv(&csv(&[row], 1.0))[1][0], expected);
    }
}

#[test]
fn a_page_shows_everything_and_runs_nothing() {
    let evidence = evidence();
    for outcome in OUTCOMES {
        let verdict = evil(outcome);
        for evidence in [None, Some(&evidence)] {
            let text = format!("void main() {{}}\n{}\n", EVIL.replace('\0', "")).repeat(9);
            let sources = [SourceFile::new(EVIL, text)];
            let page = with_neighbours(&page(EVIL, &verdict, evidence, &sources), Some(EVIL), Some("\u{202e}"));
            let markup = read_page(&page);
            let pictures = markup.elements.iter().filter(|(name, _)| name == "img").count();
            assert_eq!(pictures, evidence.map_or(0, |_| 12));
            for word in
                [text::words(outcome), r"\u{202e}", r"\x00", "line 14", "99.7 % of the difference", "The difference"]
            {
                let word = word.trim_start_matches("The ");
                assert!(markup.text.to_lowercase().contains(&word.to_lowercase()), "{word}");
            }
            assert!(markup.text.contains("</script><script>alert('1')</script>\"'&amp;<!--]]>"));
            let alone = markup.elements.iter().filter(|(name, _)| name == "h1").count();
            assert_eq!(alone, 1);
            // The mistake's line and the message's are marked, and both lead back.
            let back: Vec<&str> = markup.attributes("href").filter(|place| place.starts_with("#finding")).collect();
            assert_eq!(back, ["#finding-2", "#finding-1"], "in the order of lines");
            assert_eq!(markup.attributes("href").filter(|place| place.starts_with("#line-")).count(), 3);
            assert_eq!(markup.attributes("class").filter(|class| class.starts_with("marked")).count(), 2);
        }
    }
}

#[test]
fn a_page_of_a_right_answer_mentions_no_mistakes() {
    let mut verdict = Verdict::new("ex04", Outcome::Correct, "right in every scene");
    verdict.terms = vec![TermVerdict { term: "diffuse".into(), state: TermState::Right }];
    let markup = read_page(&page("ada", &verdict, None, &[]));
    assert!(markup.text.contains("Right in every scene.") && markup.text.contains("Correct"));
    assert!(
        !markup.text.contains("What is wrong")
            && ["compiler", "Scene by scene", "was bound"].iter().all(|word| !markup.text.contains(word)),
        "{}",
        markup.text
    );
}

#[test]
fn a_long_file_does_not_make_a_long_page() {
    let mut verdict = evil(Outcome::DoesNotCompile);
    let message =
        CompilerMessage { text: "x".repeat(1 << 16), quoted: Some("y".repeat(1 << 16)), ..verdict.messages[0].clone() };
    verdict.messages = vec![message; 300];
    verdict.warnings = vec!["w".repeat(1 << 16); 300];
    verdict.bound = vec![verdict.bound[0].clone(); 300];
    let sources = vec![SourceFile::new(EVIL, "z".repeat(1 << 16)); 300];
    let page = page("long", &verdict, None, &sources);
    read_page(&page);
    assert!(page.len() < 1 << 20, "{}", page.len());
    assert!(page.contains("And 260 more"));
}

/// A class of four, with a name that is hostile and one that is empty.
fn class() -> Vec<Row> {
    let thumbnail = SubmissionThumbnail::new(&evil(Outcome::Wrong), &evidence());
    assert!(thumbnail.is_some());
    vec![
        evil_row().with_thumbnail(thumbnail),
        Row::new("Group 10", &Verdict::new("ex04", Outcome::Correct, ""), 0.5),
        Row::new("group 9", &evil(Outcome::Wrong), 0.5),
        Row::new("", &Verdict::new("ex04", Outcome::Unsure, EVIL), f64::INFINITY),
    ]
}

fn overview_of(rows: &[Row]) -> String {
    let similar = [("group 9".to_owned(), "Group 10".to_owned(), 0.7), (EVIL.to_owned(), "group 9".to_owned(), 0.96)];
    let similar = similar_groups(&similar);
    overview(&Overview {
        title: EVIL,
        rows,
        similar: &similar,
        skipped: &[EVIL.to_owned()],
        most_points: 20.0,
        has_scheme: false,
    })
}

#[test]
fn an_overview_begins_with_the_submissions_and_ends_with_similarity() {
    let page = overview_of(&class());
    let markup = read_page(&page);
    let at = |heading: &str| page.find(&format!("<h2>{heading}</h2>")).expect(heading);
    let order = ["Submissions", "Mistakes", "Not checked", "Similar submissions"].map(at);
    assert!(order.is_sorted(), "{order:?}");
    let table = &page[..order[1]];
    let first = |words: &str| table.find(words).expect(words);
    // By name, without case and with numbers by value.
    assert!(first("(no name)") < first(">group 9<") && first(">group 9<") < first(">Group 10<"), "{table}");
    for words in ["4 submissions", "2 wrong", "1 correct", "1 could not be judged", "of 20", "100 % of pixels differ"] {
        assert!(markup.text.contains(words), "{words}: {}", markup.text);
    }
    // The chain of three is one group.
    assert!(markup.text.contains("3 submissions, up to 96 % the same"), "{}", markup.text);
    assert!(markup.text.contains("2 similar pairs") && markup.text.contains("70 %"));
    // Both wrong ones make the mistake, and their rows are linked.
    assert_eq!(markup.attributes("style").collect::<Vec<_>>(), ["width: 50.0%"]);
    assert_eq!(markup.attributes("href").filter(|place| place.starts_with("#submission-")).count(), 2);
    let finding = "./group%209.html#finding-1";
    assert_eq!(markup.attributes("href").filter(|place| *place == finding).count(), 1);
    read_page(&overview(&Overview {
        title: "none",
        rows: &[],
        similar: &[],
        skipped: &[],
        most_points: f64::NAN,
        has_scheme: true,
    }));
}

#[test]
fn every_column_of_an_overview_has_what_it_is_sorted_by() {
    let rows = class();
    let markup = read_page(&overview_of(&rows));
    assert_eq!(markup.attributes("aria-sort").collect::<Vec<_>>(), ["none", "ascending", "none", "none", "none"]);
    let keys: Vec<f64> = markup.attributes("data-key").map(|key| key.parse().expect(key)).collect();
    let keys: Vec<&[f64]> = keys.chunks_exact(5).collect();
    assert_eq!(keys.len(), rows.len());
    let column = |column: usize| keys.iter().map(|row| row[column]).collect::<Vec<f64>>();
    // In the order of names: the hostile one, the empty one, 9 and 10.
    let names: Vec<&str> = markup.attributes("href").filter(|place| !place.contains('#')).take(4).collect();
    assert_eq!(names[0], "./~.html");
    assert_eq!(names[2..], ["./group%209.html", "./Group%2010.html"]);
    assert_eq!(column(0), [-1.0, 1.0, -1.0, -1.0]);
    assert_eq!(column(1), [0.0, 1.0, 2.0, 3.0]);
    assert_eq!(column(2), [2.0, 1.0, 1.0, 0.0]);
    assert_eq!(column(3), [0.0, 6.67, 6.67, 20.0]);
    assert_eq!(column(4), [2.0, 0.0, 0.0, 2.0]);
}

#[test]
fn one_is_singular() {
    let mut verdict = Verdict::new("ex04", Outcome::DoesNotCompile, "no");
    verdict.warnings = vec!["w".to_owned()];
    let rows = [Row::new("ada", &verdict, 1.0)];
    let one = |skipped: &[String]| {
        read_page(&overview(&Overview {
            title: "t",
            rows: &rows,
            similar: &[],
            skipped,
            most_points: 1.0,
            has_scheme: false,
        }))
        .text
    };
    let text = one(&[]);
    assert!(
        ["1 submission\n", "1 does not compile", "1 warning\n"].iter().all(|words| text.contains(words.trim())),
        "{text}"
    );
    assert!(!text.contains("1 submissions") && !text.contains("1 do not") && !text.contains("1 warnings"), "{text}");
}

#[test]
fn texts_can_be_read_on_every_ground_in_both_themes() {
    let style = include_str!("style.css");
    let (light, dark) = style.split_once("@media").unwrap();
    for theme in [light, dark] {
        let luminance = |name: &str| {
            let (_, value) = theme.split_once(&format!("--{name}: #")).expect(name);
            let channel = |at: usize| {
                let encoded = f64::from(u8::from_str_radix(&value[at..at + 2], 16).unwrap()) / 255.0;
                if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
            };
            0.2126 * channel(0) + 0.7152 * channel(2) + 0.0722 * channel(4)
        };
        // WCAG 2.2, 1.4.3: 4.5 for text at level AA.
        let readable = |text: &str, ground: &str| {
            let (a, b) = (luminance(text), luminance(ground));
            let contrast = (a.max(b) + 0.05) / (a.min(b) + 0.05);
            assert!(contrast >= 4.5, "{text} on {ground}: {contrast:.2} in {theme}");
        };
        for text in ["text", "soft", "right", "warning", "error", "accent"] {
            ["ground", "card"].into_iter().for_each(|ground| readable(text, ground));
        }
        for ground in ["code", "right-ground", "warning-ground", "error-ground", "accent-ground"] {
            ["text", "soft"].into_iter().for_each(|text| readable(text, ground));
        }
        for tint in ["right", "warning", "error", "accent"] {
            readable(tint, &format!("{tint}-ground"));
        }
    }
}
