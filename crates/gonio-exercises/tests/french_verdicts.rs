//! Verdicts and reports in French: every text differs from the English one, and none has English words.
//!
//! The language is one per process, so this is a file of its own, with one test.
#![allow(clippy::unwrap_used)]

use gonio_check::CheckOptions;
use gonio_check::comparison::Task;
use gonio_check::feedback::Feedback;
use gonio_check::mistakes::Hypotheses;
use gonio_check::submission::SourceFile;
use gonio_check::testbench::scene;
use gonio_check::verdict::{
    BoundVariable, CompilerMessage, FoundMistake, Outcome, Peculiarity, PropertyState, PropertyVerdict, ProposedEdit,
    SceneVerdict, TermState, TermVerdict, Verdict,
};
use gonio_exercises::report::{self, Overview, Row};
use gonio_exercises::{Checker, exercise};
use gonio_gl::HeadlessContext;
use gonio_language::Language;
use std::collections::BTreeSet;

/// Words that French does not have.
const ENGLISH: [&str; 15] = [
    "the", "is", "are", "should", "of", "and", "which", "with", "its", "has", "not", "wrong", "scene", "from", "write",
];

/// A submission of an exercise.
struct Case {
    exercise: &'static str,
    name: String,
    files: Vec<SourceFile>,
}

fn shaders(exercise: &'static str, name: &str, vertex: impl Into<Vec<u8>>, fragment: impl Into<Vec<u8>>) -> Case {
    let files = vec![SourceFile::new("my.vert", vertex), SourceFile::new("my.frag", fragment)];
    Case { exercise, name: name.to_owned(), files }
}

/// Some mistakes of the catalogue in each exercise whose solution is a pair of shaders.
fn catalogued() -> Vec<Case> {
    let mut cases = Vec::new();
    for id in ["ex01", "ex03", "ex04", "ex06", "ex07", "ex08", "ex09", "ex10", "ex12"] {
        let hypotheses = Hypotheses::for_model(Task::find(id).unwrap().model);
        for (index, hypothesis) in hypotheses.singles.iter().enumerate().step_by(9) {
            let [vertex, fragment] = hypotheses.written(hypothesis);
            cases.push(shaders(id, &format!("mistake {index}"), vertex, fragment));
        }
    }
    cases
}

/// Changes of the solution of an exercise that no mistake of the catalogue is, and errors of compilers.
fn changed() -> Vec<Case> {
    const CHANGES: [(&str, &str, &str); 11] = [
        ("normalize(v_normal)", "v_normal.zxy", "another normal"),
        ("max(dot(N, L), 0.0)", "0.7 * dot(N, L) + 0.1", "another cosine"),
        ("max(dot(N, L), 0.0)", "dot(N, L)", "no maximum"),
        ("vec3(diffuse), 1.0", "vec3(0.0), 1.0", "black"),
        ("vec3(diffuse), 1.0", "vec3(0.4), 1.0", "flat"),
        ("vec3(diffuse), 1.0", "vec3(diffuse / 0.0 * 0.0), 1.0", "no numbers"),
        ("vec3(diffuse), 1.0", "vec3(floor(diffuse * 4.0) / 4.0), 1.0", "steps"),
        ("u_light_pos - v_frag_coord", "u_light_pos - v_frag_coord + vec3(0.3, 0.0, 0.1)", "another light"),
        ("dot(N, L), 0.0);", "dot(N, L), 0.0)", "no semicolon"),
        ("vec3 N =", "vec3 M =", "undeclared"),
        ("void main() {", "void main() { while (true) { }", "endless"),
    ];
    let ex04 = exercise::find("ex04").unwrap();
    let [vertex, fragment] = ["reference.vert", "reference.frag"].map(|name| ex04.file(name).unwrap());
    let mut cases: Vec<Case> = CHANGES
        .iter()
        .map(|(from, to, name)| {
            assert!(fragment.contains(from), "{from}");
            shaders("ex04", name, vertex, fragment.replace(from, to))
        })
        .collect();
    cases.push(shaders("ex04", "start", ex04.file("start.vert").unwrap(), ex04.file("start.frag").unwrap()));
    cases.push(shaders("ex04", "empty", vertex, ""));
    cases.push(shaders("ex04", "no main", vertex, fragment.replace("void main()", "void start()")));
    let only = vec![SourceFile::new("my.vert", vertex)];
    cases.push(Case { exercise: "ex04", name: "one stage".to_owned(), files: only });
    cases.push(Case { exercise: "ex04", name: "nothing".to_owned(), files: Vec::new() });
    let ex08 = exercise::find("ex08").unwrap();
    let [vertex, fragment] = ["reference.vert", "reference.frag"].map(|name| ex08.file(name).unwrap());
    assert!(vertex.contains("place.xyww"));
    cases.push(shaders("ex08", "a depth of its own", vertex.replace("place.xyww", "place"), fragment));
    cases
}

/// Files of the exercises that are no pair of shaders.
fn others() -> Vec<Case> {
    let reference = include_str!("../../../exercises/ex11-texture-unit/host/reference.txt");
    let of = |exercise: &'static str, name: &str, file: &str, text: &str| Case {
        exercise,
        name: name.to_owned(),
        files: vec![SourceFile::new(file, text)],
    };
    let program = |from: &str, to: &str| {
        assert!(reference.contains(from), "{from}");
        of("ex11", &format!("`{from}` is `{to}`"), "mine.txt", &reference.replace(from, to))
    };
    let mut cases: Vec<Case> = [
        ("uniform_1i ourTexture 0", "uniform_1i ourTexture texture"),
        ("uniform_1i ourTexture 0", "uniform_1i ourTexture 3"),
        ("generate_mipmap TEXTURE_2D\n", ""),
        ("use_program program", ""),
        ("FLOAT FALSE 32 12", "FLOAT FALSE 12 12"),
        ("enable_vertex_attrib_array position", ""),
        ("bind_buffer ARRAY_BUFFER buffer", ""),
        ("clear COLOR_BUFFER_BIT", ""),
        ("draw_arrays TRIANGLES 0 3", "draw_arrays TRIANGLES 0 1"),
        ("draw_arrays TRIANGLES 0 3", ""),
        ("draw_arrays TRIANGLES 0 3", "draw_arrays TRIANGLES 0"),
        ("gen_texture", "glGenTextures"),
        ("\nend", ""),
        ("TEXTURE_2D 0 RGB8", "TEXTURE_2D 0 RGB99"),
        ("load_image checker.png", "load_image missing.png"),
    ]
    .into_iter()
    .map(|(from, to)| program(from, to))
    .collect();
    for (file, text) in [
        ("cube.csv", "x,y,z\n0,0,a\n"),
        ("cube.csv", "1,2\n"),
        ("cube.csv", ""),
        ("cube.json", "[[1, 2, 3], [4, 5]]"),
        ("cube.json", "{\"vertices\": [], \"indices\": [0]}"),
        ("cube.bin", "abc"),
        ("cube.csv", "x,y,z\n0,0,1\n0,1,0\n1,0,0\n"),
        ("readme.pdf", "?"),
    ] {
        cases.push(of("ex02", text, file, text));
    }
    cases.push(of("s1", "one face", "posx.png", "?"));
    cases.push(of("ex13", "no model", "notes.txt", "?"));
    cases
}

/// The texts of a verdict, each with its place. The messages of compilers and of the trace of OpenGL calls are their own.
fn texts(verdict: &Verdict) -> Vec<(String, String)> {
    let mut texts = Vec::new();
    let mut add = |place: &str, text: &str| texts.push((place.to_owned(), text.to_owned()));
    if verdict.messages.is_empty() {
        add("summary", &verdict.summary);
    }
    for found in &verdict.mistakes {
        add("name", &found.name);
        add("looks like", &found.looks_like);
        add("fix", &found.fix);
    }
    verdict.peculiarities.iter().for_each(|known| add("peculiarity", &known.name));
    verdict.warnings.iter().for_each(|warning| add("warning", warning));
    verdict.scenes.iter().for_each(|scene| add("shows", &scene.shows));
    verdict.scenes.iter().for_each(|scene| add("scene", &scene::title(&scene.scene)));
    verdict.properties.iter().for_each(|property| add("property", &property.sentence));
    for message in &verdict.messages {
        add("explanation", message.explanation.as_deref().unwrap_or_default());
    }
    texts
}

/// Whether a text is a name or a formula, which are the same in every language.
fn is_formula(text: &str) -> bool {
    let prose: String = text.split('`').step_by(2).collect();
    let has_operator = [" * ", " / ", " = "].iter().any(|operator| prose.contains(operator));
    has_operator || !text.contains(' ') || !prose.chars().any(char::is_alphabetic)
}

/// The English words of a text outside of code.
fn english(text: &str) -> Vec<&str> {
    let prose = text.split('`').step_by(2);
    let words = prose.flat_map(|part| part.split(|c: char| !c.is_alphanumeric()));
    words.filter(|word| ENGLISH.contains(&word.to_lowercase().as_str())).collect()
}

/// The verdict on a submission in a language, and its texts.
fn check(checker: &mut Checker, case: &Case, language: Language) -> (Verdict, Vec<(String, String)>) {
    language.make_current();
    let exercise = exercise::find(case.exercise).unwrap();
    let options = CheckOptions::default();
    let (verdict, _) = gonio_exercises::check(checker, exercise, case.files.clone(), &options, Feedback::Line).unwrap();
    let texts = texts(&verdict);
    (verdict, texts)
}

/// A verdict with every part, in words that no language has.
fn whole() -> Verdict {
    let mut verdict = Verdict::new("x", Outcome::Wrong, "ooo");
    let found = FoundMistake::new("ooo", "ooo", 0.5).taught("ooo", "ooo", "ooo").at("a.vert", Some(2), "ooo");
    let of_lab = FoundMistake { lab_does_it: true, or: vec!["ooo".to_owned(); 2], ..found.clone() };
    verdict.mistakes = vec![found, of_lab];
    verdict.peculiarities = vec![Peculiarity { id: "ooo".to_owned(), name: "ooo".to_owned() }];
    verdict.warnings = vec!["ooo".to_owned()];
    let (file, before, after) = ("a.vert".to_owned(), "o".to_owned(), "u".to_owned());
    verdict.proposed_fix = vec![ProposedEdit { file, line: 1, before, after }];
    let states = [TermState::Right, TermState::Wrong, TermState::NotSeparable];
    let terms = ["ambient", "diffuse", "specular"].into_iter().zip(states);
    verdict.terms = terms.map(|(term, state)| TermVerdict { term: term.into(), state }).collect();
    let names = ["lab", "far", "two lights", "stretched, specular alone"];
    let scenes = names.into_iter().zip([true, false, false, true]);
    verdict.scenes = scenes
        .map(|(scene, right)| SceneVerdict {
            scene: scene.to_owned(),
            shows: "ooo".into(),
            right,
            pixels_beyond: 0.25,
            worst: 0.5,
        })
        .collect();
    for state in [PropertyState::Right, PropertyState::Wrong] {
        let scenes = vec!["two lights".to_owned()];
        verdict.properties.push(PropertyVerdict { id: "ooo".to_owned(), sentence: "ooo".to_owned(), state, scenes });
    }
    let message = |text: &str, explanation: Option<&str>| CompilerMessage {
        file: "a.vert".to_owned(),
        line: Some(2),
        column: Some(3),
        text: text.to_owned(),
        quoted: None,
        explanation: explanation.map(str::to_owned),
    };
    let long = "o".repeat(300);
    verdict.messages =
        vec![message("ooo", Some("ooo")), message(&long, Some("ooo")), message(&long, None), message("ooo", None)];
    verdict.bound = vec![BoundVariable { name: "u".to_owned(), glsl_type: "vec3".to_owned(), role: None }];
    verdict
}

/// Each report about a verdict without its markup, and the values of its JSON without their keys.
fn reports(language: Language) -> Vec<(&'static str, String)> {
    language.make_current();
    let verdict = whole();
    let rows = [Row::new("ada", &verdict, 0.5), Row::new("bob", &Verdict::new("y", Outcome::Correct, "ooo"), 0.5)];
    let skipped = ["ooo".to_owned()];
    let batch =
        Overview { title: "ooo", rows: &rows, similar: &[], skipped: &skipped, most_points: 20.0, has_scheme: false };
    let sources = [SourceFile::new("a.vert", "o\nu\n")];
    let page = report::with_neighbours(&report::page("ada", &verdict, None, &sources), Some("bob"), None);
    let gradescope: serde_json::Value = serde_json::from_str(&report::gradescope(&verdict, 10.0)).unwrap();
    let outputs = gradescope["tests"].as_array().unwrap().iter().flat_map(|test| [&test["name"], &test["output"]]);
    let outputs = outputs.chain([&gradescope["output"]]).map(|text| text.as_str().unwrap().to_owned());
    let runner: serde_json::Value = serde_json::from_str(&report::code_runner(&verdict)).unwrap();
    let moodle = ["prologuehtml", "epiloguehtml"].map(|key| prose(runner[key].as_str().unwrap())).concat();
    let rows = runner["testresults"].as_array().unwrap().iter().flat_map(|row| [&row[1], &row[2]]);
    let rows: Vec<&str> = rows.map(|text| text.as_str().unwrap()).collect();
    vec![
        ("page", prose(&page)),
        ("overview", prose(&report::overview(&batch))),
        ("gradescope", outputs.collect::<Vec<_>>().join("\n")),
        ("code runner", format!("{moodle}\n{}", rows.join("\n"))),
    ]
}

/// The text of HTML, with the labels that screen readers speak, without style, script and code.
fn prose(html: &str) -> String {
    let mut text = String::new();
    let mut hidden = None;
    for piece in html.split('<').skip(1) {
        let (tag, after) = piece.split_once('>').unwrap_or((piece, ""));
        let name = tag.split(' ').next().unwrap_or_default();
        match hidden {
            None if ["style", "script", "code", "pre"].contains(&name) => hidden = Some(name),
            Some(open) if name.strip_prefix('/') == Some(open) => hidden = None,
            _ => {}
        }
        for label in ["alt=\"", "aria-label=\"", "title=\"", "data-shown=\""] {
            let spoken = tag.split_once(label).and_then(|(_, rest)| rest.split_once('"'));
            text.extend(spoken.map(|(spoken, _)| format!("{spoken}\n")));
        }
        if hidden.is_none() {
            text.push_str(after);
            text.push('\n');
        }
    }
    text
}

#[test]
fn verdicts_and_reports_are_in_french() {
    let context = HeadlessContext::new().unwrap_or_else(|error| panic!("{error}"));
    let mut checker = Checker::new(context.gl());
    let (mut tried, mut places, mut problems) = (0, BTreeSet::new(), BTreeSet::new());
    for case in catalogued().into_iter().chain(changed()).chain(others()) {
        let [(english_one, before), (french_one, after)] =
            [Language::English, Language::French].map(|language| check(&mut checker, &case, language));
        let place = format!("{} {}", case.exercise, case.name);
        // The language changes words alone.
        assert_eq!((english_one.verdict, english_one.score), (french_one.verdict, french_one.score), "{place}");
        let ids = |verdict: &Verdict| verdict.mistakes.iter().map(|found| found.id.clone()).collect::<Vec<_>>();
        assert_eq!(ids(&english_one), ids(&french_one), "{place}");
        assert_eq!(before.len(), after.len(), "{place}");
        for ((part, before), (_, after)) in before.iter().zip(&after).filter(|((_, before), _)| !before.is_empty()) {
            if before == after && !is_formula(before) {
                problems.insert(format!("{place}: {part} is not translated: {after}"));
            }
            let words = english(after);
            if !words.is_empty() {
                problems.insert(format!("{place}: {part} has {words:?}: {after}"));
            }
            places.insert(part.clone());
            tried += 1;
        }
    }
    for ((report, before), (_, after)) in reports(Language::English).iter().zip(reports(Language::French)) {
        assert!(english(before).len() > 10, "{report}: {before}");
        let words = english(&after);
        if !words.is_empty() {
            problems.insert(format!("{report} has {words:?}: {after}"));
        }
    }
    Language::English.make_current();
    assert!(problems.is_empty(), "{problems:#?}");
    assert!(tried > 800, "only {tried} texts");
    for part in ["summary", "name", "fix", "peculiarity", "warning", "shows", "property", "explanation"] {
        assert!(places.contains(part), "{part} was never tried");
    }
}
