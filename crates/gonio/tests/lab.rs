//! `gonio lab`: exercises, single checks and batches, and the process that tries shaders for the window.
#![allow(clippy::unwrap_used, missing_docs)]

mod common;
#[path = "lab/editor.rs"]
mod editor;
#[path = "lab/formats.rs"]
mod formats;
#[path = "lab/neovim.rs"]
mod neovim;
#[path = "lab/watch.rs"]
mod watch;

use common::{Lab, Run};
use gonio_app::platform::desktop::trial;
use gonio_app::platform::{CheckRequest, Pending, TrialOutcome};
use gonio_exercises::exercise;
use std::path::Path;
use std::time::Duration;

/// Writes the reference solution of an exercise to `folder`, with one line of its vertex shader changed.
fn hand_in(lab: &Lab, exercise: &str, folder: &str, from: &str, to: &str) {
    let path = lab.path(folder).to_string_lossy().into_owned();
    lab.run(&["lab", "reference", exercise, "-o", &path]).good();
    let name = format!("{folder}/reference.vert");
    let text = String::from_utf8(lab.read(&name)).unwrap();
    assert!(text.contains(from), "{text}");
    lab.write(&name, text.replace(from, to));
}

#[test]
fn exercises_are_listed_shown_and_started_once() {
    let lab = Lab::new();
    let run = lab.run(&["lab", "list"]).good();
    for word in ["ex01", "ex07", "ex11", "ex12", "ex13", "s1", "The light equation", "Which BRDF?"] {
        assert!(run.text().contains(word), "{word}");
    }
    assert!(lab.run(&["lab", "show", "4"]).good().text().contains("gonio lab check ex04"));
    let folder = lab.path("mine").to_string_lossy().into_owned();
    lab.run(&["lab", "start", "ex04", &folder]).good();
    assert!(lab.path("mine/start.frag").exists() && !lab.path("mine/reference.frag").exists());
    // Nothing is changed yet, and the verdict states only that, without guesses about the start files.
    let run = lab.run(&["lab", "check", "ex04", &folder, "--json"]).json();
    let (summary, warnings) = (run["summary"].as_str().unwrap(), run["warnings"].as_array().unwrap());
    assert!(run["verdict"] == "wrong" && summary.contains("unchanged start files"), "{run}");
    assert!(warnings.is_empty(), "{run}");
    lab.write("mine/start.frag", "mine");
    lab.run(&["lab", "start", "ex04", &folder]).refused(&["exists"]);
    let panorama = lab.path("pano").to_string_lossy().into_owned();
    lab.run(&["lab", "start", "s1", &panorama]).good();
    assert!(lab.read("pano/panorama.png").starts_with(b"\x89PNG"));
    assert_eq!(lab.read("mine/start.frag"), b"mine");
    lab.run(&["lab", "show", "ex99"]).refused(&["there is no exercise `ex99`", "ex01"]);
}

#[test]
fn a_mistake_is_named_with_its_line_and_a_right_answer_passes() {
    let lab = Lab::new();
    hand_in(&lab, "ex04", "wrong", "mat3(itM)", "mat3(M)");
    hand_in(&lab, "ex04", "right", "mat3(itM) * normal", "(itM * vec4(normal, 1.0)).xyz");
    let run = lab.run(&["lab", "check", "ex04", &lab.path("wrong").to_string_lossy(), "--json"]);
    let verdict = run.json();
    assert_eq!(verdict["verdict"], "wrong");
    assert_eq!(verdict["mistakes"][0]["id"], "normal-by-model-matrix");
    assert_eq!(verdict["mistakes"][0]["file"], "reference.vert");
    let line = verdict["mistakes"][0]["quoted"].as_str().unwrap();
    assert!(line.contains("mat3(M)"), "{line}");
    let run = lab.run(&["lab", "check", "ex04", &lab.path("right").to_string_lossy()]).good();
    assert!(run.text().contains("correct"), "{}", run.text());
}

#[test]
fn a_teacher_chooses_how_much_is_shown() {
    let lab = Lab::new();
    hand_in(&lab, "ex04", "ann", "mat3(itM)", "mat3(M)");
    let folder = lab.path("ann").to_string_lossy().into_owned();
    let check = |level: &[&str]| lab.run(&[&["lab", "check", "ex04", &folder, "--json"], level].concat()).json();
    let verdict = check(&["--feedback", "verdict"]);
    assert_eq!((&verdict["verdict"], &verdict["mistakes"]), (&"wrong".into(), &serde_json::json!([])));
    let scenes = verdict["scenes"].as_array().unwrap();
    assert!(scenes.iter().any(|scene| scene["right"] == true) && scenes.iter().any(|scene| scene["right"] == false));
    assert!(verdict["summary"].as_str().unwrap().ends_with("test scenes are right"), "{verdict}");
    let found = |level: &[&str]| check(level)["mistakes"][0].clone();
    let name = found(&["--feedback", "name"]);
    assert_eq!(name["id"], "normal-by-model-matrix");
    assert!(name.get("line").is_none() && name.get("quoted").is_none() && name["fix"] == "", "{name}");
    let line = found(&[]);
    assert!(line["line"].is_number() && !line["fix"].as_str().unwrap().is_empty(), "{line}");
    assert_eq!(found(&["--feedback", "line"]), line, "the exercise's own setting");
    assert!(check(&[]).get("proposed_fix").is_none());
    lab.run(&["lab", "check", "ex04", &folder, "--feedback", "all"]).refused(&["verdict", "name", "line", "fix"]);
    // The text to write in a program of OpenGL calls is the answer.
    lab.run(&["lab", "start", "ex11", &lab.path("gl").to_string_lossy()]).good();
    let program = lab.path("gl/host/unbound-unit.txt").to_string_lossy().into_owned();
    let fix = |level: &str| {
        let verdict = lab.run(&["lab", "check", "ex11", &program, "--json", "--feedback", level]).json();
        verdict["mistakes"][0]["fix"].as_str().unwrap().to_owned()
    };
    assert!(fix("fix").contains("uniform_1i ourTexture 2") && !fix("line").contains("uniform_1i"), "{}", fix("line"));
}

#[test]
fn a_batch_shows_as_much_as_the_last_run_asked_for() {
    let lab = Lab::new();
    hand_in(&lab, "ex04", "all/ann", "mat3(itM)", "mat3(M)");
    let all = lab.path("all").to_string_lossy().into_owned();
    let files = ["all-results/ann.html", "all-results/table.csv", "all-results/index.html", "all.xml"];
    let junit = lab.path("all.xml").to_string_lossy().into_owned();
    for (level, is_named) in [("line", true), ("verdict", false), ("name", true)] {
        let batch = ["lab", "check", "ex04", &all, "--submissions", "many", "--junit", &junit, "--feedback", level];
        let run = lab.run(&batch);
        let is_word = |text: &str, word: &str| text.contains(word);
        assert_eq!(is_word(run.text(), "normal-by-model-matrix"), is_named, "{level}: {}", run.text());
        for file in files {
            let text = String::from_utf8(lab.read(file)).unwrap();
            assert_eq!(is_word(&text, "normal-by-model-matrix"), is_named, "{file} at {level}");
            // The name of the file alone is the heading of its code.
            let has_place = [":", "</span>, line"].iter().any(|rest| is_word(&text, &format!("reference.vert{rest}")));
            assert_eq!(has_place, level == "line", "{file} at {level}");
        }
    }
}

#[test]
fn every_mistake_is_listed_and_explained() {
    let lab = Lab::new();
    let all = lab.run(&["lab", "mistakes", "--json"]).json();
    let ids: Vec<&str> = all.as_array().unwrap().iter().map(|m| m["id"].as_str().unwrap()).collect();
    for id in ["normal-by-model-matrix", "gouraud-instead-of-phong", "attenuation-other-formula"] {
        assert!(ids.contains(&id), "{id}");
        let run = lab.run(&["lab", "mistakes", id]).good();
        assert!(run.text().contains("How to fix it"), "{}", run.text());
    }
    lab.run(&["lab", "mistakes", "ambient-missed"]).refused(&["did you mean `ambient-missing`"]);
}

#[test]
fn a_batch_always_ends_and_continues_an_earlier_run() {
    let lab = Lab::new();
    hand_in(&lab, "ex04", "all/ann", "mat3(itM)", "mat3(M)");
    hand_in(&lab, "ex04", "all/bob", "mat3(itM)", "mat3(itM)");
    std::fs::create_dir_all(lab.path("all/cyd")).unwrap();
    lab.write("all/cyd/a.vert", [0_u8, 159, 146, 150, 0, 0]);
    lab.write("all/dan.zip", "PK\x03\x04 and no more");
    hand_in(&lab, "ex04", "all/eve", "void main() {", "void main() { while (true) { gl_Position.x += 1.0; }");
    let (all, results) = (lab.path("all").to_string_lossy().into_owned(), lab.path("results"));
    let out = results.to_string_lossy().into_owned();
    let batch = || {
        let run = lab.run(&["lab", "check", "ex04", &all, "-o", &out, "--patience", "20", "--json"]);
        run.json().as_array().unwrap().iter().map(|row| row["verdict"].as_str().unwrap().to_owned()).collect::<Vec<_>>()
    };
    let first = batch();
    assert_eq!(first[..4], ["wrong", "correct", "unsure", "unsure"]);
    assert_ne!(first[4], "correct");
    for name in ["index.html", "table.csv", "ann.html", "bob.html", "cyd.html"] {
        assert!(results.join(name).exists(), "{name}");
    }
    // Verdicts are stored, so the page is not written again.
    std::fs::write(results.join("ann.html"), "kept").unwrap();
    hand_in_again(&lab);
    assert_eq!(batch()[..2], ["wrong", "wrong"]);
    assert_eq!(std::fs::read(results.join("ann.html")).unwrap(), b"kept");
}

#[test]
fn a_class_of_any_folder_structure_is_checked_and_left_unchanged() {
    let lab = Lab::new();
    hand_in(&lab, "ex04", "class/ann/work/shaders", "mat3(itM)", "mat3(itM)");
    hand_in(&lab, "ex04", "class/-rf", "mat3(itM)", "mat3(M)");
    let long = format!("class/{}", "\u{1f600}".repeat(60));
    hand_in(&lab, "ex04", &long, "mat3(itM)", "mat3(itM)");
    hand_in(&lab, "ex04", "class/_bob", "mat3(itM)", "mat3(itM)");
    lab.write("class/list.txt", "ann, bob");
    let before = all_files(&lab.path("class"));
    // Without `-o` the results are beside the class, even if it is the current folder.
    let junit = lab.path("all.xml").to_string_lossy().into_owned();
    let mut command = lab.command(&["lab", "check", "ex04", ".", "--json", "--junit", &junit]);
    let run = Run::of(command.current_dir(lab.path("class")).output().unwrap());
    let verdicts: Vec<(String, String)> = run
        .json()
        .as_array()
        .unwrap()
        .iter()
        .map(|row| [&row["submission"], &row["verdict"]].map(|word| word.as_str().unwrap().to_owned()).into())
        .collect();
    let expected = [("-rf", "wrong"), ("_bob", "correct"), ("ann", "correct"), (&long[6..], "correct")];
    assert_eq!(verdicts, expected.map(|(label, word)| (label.to_owned(), word.to_owned())));
    assert!(run.stderr.contains("skipped: list.txt (it contains no answer)"), "{}", run.stderr);
    assert_eq!(all_files(&lab.path("class")), before);
    let overview = String::from_utf8(lab.read("class-results/index.html")).unwrap();
    assert!(overview.contains("Not checked") && overview.contains("list.txt"));
    assert!(String::from_utf8(lab.read("all.xml")).unwrap().contains("_bob"));
}

#[test]
fn submissions_and_classes_are_distinguished() {
    let lab = Lab::new();
    hand_in(&lab, "ex04", "mine/work/shaders", "mat3(itM)", "mat3(itM)");
    let run = lab.run(&["lab", "check", "ex04", "mine", "--json"]).good();
    assert_eq!(run.json()["verdict"], "correct");
    assert!(!lab.path("mine-results").exists());
    // A flat download: one student's right answer does not count for the others.
    for (student, to) in [("Ann_1", "mat3(itM)"), ("Ben_2", "mat3(M)")] {
        hand_in(&lab, "ex04", student, "mat3(itM)", to);
        for name in ["reference.vert", "reference.frag"] {
            let bytes = lab.read(&format!("{student}/{name}"));
            std::fs::create_dir_all(lab.path("flat")).unwrap();
            lab.write(&format!("flat/{student}_assignsubmission_file_{name}"), bytes);
        }
    }
    let run = lab.run(&["lab", "check", "ex04", "flat", "-o", "results", "--json"]);
    let verdicts: Vec<String> =
        run.json().as_array().unwrap().iter().map(|row| row["verdict"].as_str().unwrap().to_owned()).collect();
    assert_eq!((run.code, verdicts.as_slice()), (1, &["correct".to_owned(), "wrong".to_owned()][..]));
    assert!(lab.path("results/Ann_1.html").exists());

    for option in ["--page", "--sheet", "--gradescope", "--code-runner"] {
        lab.run(&["lab", "check", "ex04", "flat", option, "out.file"]).refused(&[option, "one submission", "2"]);
    }
    lab.run(&["lab", "check", "ex04", "flat", "-o", "flat/results"]).refused(&["is inside", "outside"]);
    // One submission with a folder for results is a class of one.
    lab.run(&["lab", "check", "ex04", "mine", "-o", "one", "--json"]).good();
    assert!(lab.path("one/mine.html").exists(), "{:?}", lab.names());
    for (option, value) in [("--points", "nan"), ("--points", "-1"), ("--patience", "9223372036854775807")] {
        assert_eq!(
            lab.run(&["lab", "check", "ex04", "mine", &format!("{option}={value}")]).code,
            2,
            "{option} {value}"
        );
    }
}

#[cfg(unix)]
#[test]
fn a_check_ends_with_its_caller() {
    let lab = Lab::new();
    // The maximum number of long iterations: minutes of work for every picture, longer than this test waits.
    let work = "q = sin(q + 1.0); ".repeat(1000);
    let turns =
        format!("float q = position.x; for (int i = 0; i < 45000; i++) {{ {work} }} gl_Position.x += 1e-9 * q;\n}}");
    for student in ["ann", "bob"] {
        let folder = format!("class/{student}");
        hand_in(&lab, "ex04", &folder, "gl_Position", "gl_Position");
        let name = format!("{folder}/reference.vert");
        let text = String::from_utf8(lab.read(&name)).unwrap();
        let end = text.rfind('}').unwrap();
        lab.write(&name, format!("{}{turns}\n", &text[..end]));
    }
    let folder = lab.path("class").to_string_lossy().into_owned();
    let mut asked = lab.command(&["lab", "check", "ex04", &folder, "--patience", "600"]).spawn().unwrap();
    let workers = || -> Vec<u32> {
        let is_ours = |id: &u32| {
            let of = |name: &str| std::fs::read(format!("/proc/{id}/{name}")).unwrap_or_default();
            let stat = String::from_utf8_lossy(&of("stat")).into_owned();
            let is_dead = stat.rsplit(") ").next().is_some_and(|rest| rest.starts_with('Z'));
            let command = String::from_utf8_lossy(&of("cmdline")).into_owned();
            let inside = std::fs::read_link(format!("/proc/{id}/cwd"))
                .is_ok_and(|cwd| cwd == lab.path("").canonicalize().unwrap());
            !is_dead && inside && command.contains("check-worker")
        };
        std::fs::read_dir("/proc")
            .unwrap()
            .filter_map(|e| e.unwrap().file_name().to_str()?.parse().ok())
            .filter(is_ours)
            .collect()
    };
    until(|| !workers().is_empty());
    let terminated = std::process::Command::new("kill").arg(asked.id().to_string()).status().unwrap();
    assert!(terminated.success());
    asked.wait().unwrap();
    until(|| workers().is_empty());
}

#[test]
fn the_pages_of_a_class_lead_to_one_another() {
    let lab = Lab::new();
    let evil = "=<script>alert(1)<\u{202e}\u{1b}[2J\u{7f} #%&?\"";
    for (student, to) in
        [("Zoé", "mat3(M)"), ("group 10", "mat3(itM)"), ("Group 9", "mat3(M)"), (evil, "norml"), ("中村", "mat3(itM)")]
    {
        hand_in(&lab, "ex04", &format!("class/{student}"), "mat3(itM)", to);
    }
    let check = |folder: &str| {
        let folder = lab.path(folder).to_string_lossy().into_owned();
        let out = lab.path("results").to_string_lossy().into_owned();
        lab.run(&["lab", "check", "ex04", &folder, "-o", &out, "--points", "20"])
    };
    let run = check("class");
    assert!(run.text().contains("5 submissions: 2 correct, 2 wrong, 1 does not compile, 0 unsure"), "{}", run.text());
    // All have the same text but for a word: one group.
    let groups: Vec<&str> = run.text().lines().filter(|line| line.starts_with("similar: ")).collect();
    assert!(matches!(groups.as_slice(), [one] if one.contains("Group 9, group 10")), "{groups:?}");
    let page = |name: &str| String::from_utf8(lab.read(&format!("results/{name}"))).unwrap();
    let neighbours = |page: &str| {
        let (nav, _) = page.split_once("</nav>").unwrap();
        nav.matches("rel=\"").count()
    };
    assert_eq!(["Group 9.html", "Zoé.html", "中村.html"].map(|name| neighbours(&page(name))), [2, 2, 1]);
    assert!(page("Group 9.html").contains("<span>group 10</span> →</a>"));
    assert!(page("Zoé.html").contains("class=\"marked\"") && page("Zoé.html").contains("href=\"#line-"));
    let overview = page("index.html");
    assert!(overview.contains("#finding-1\">reference.vert:"), "{overview}");
    // Each wrong one beside the correct picture, and a correct one alone.
    assert_eq!(overview.matches("src=\"data:image/png").count(), 2 * 2 + 2);
    assert_eq!(links(&lab, "results"), 4 * 5 + 5);
    let table = lab.read("results/table.csv");
    assert!(table.starts_with("\u{feff}name,verdict,points,of_points,mistakes,reason,".as_bytes()));
    let table = String::from_utf8(table).unwrap();
    assert!(table.contains("\r\nZoé,wrong,") && table.contains("\r\n中村,correct,20,20,,,"), "{table}");
    assert!(table.contains("\"'=<script>alert(1)<\\u{202e}\\x1b[2J\\x7f #%&?\"\"\""), "{table}");

    // One leaves, and the pages of the others are linked again without a check.
    std::fs::remove_dir_all(lab.path("class/group 10")).unwrap();
    let checked = |name: &str| std::fs::metadata(lab.path("results/kept").join(name)).unwrap().modified().unwrap();
    let before = checked("Group 9.html.json");
    check("class");
    assert!(page("Group 9.html").contains("<span>Zoé</span> →</a>"));
    assert_eq!(checked("Group 9.html.json"), before);
    for student in ["Group 9", "Zoé", evil] {
        std::fs::remove_dir_all(lab.path(&format!("class/{student}"))).unwrap();
    }
    let out = lab.path("one").to_string_lossy().into_owned();
    let run = lab.run(&["lab", "check", "ex04", &lab.path("class").to_string_lossy(), "-o", &out]).good();
    assert!(run.text().contains("1 submission: 1 correct"), "{}", run.text());
    links(&lab, "one");
}

/// Follows every link in every page of a folder, within it, and returns their number without those within a page.
fn links(lab: &Lab, folder: &str) -> usize {
    let pages: std::collections::BTreeMap<String, String> = all_files(&lab.path(folder))
        .into_iter()
        .filter(|(path, _)| path.extension().is_some_and(|ending| ending == "html"))
        .map(|(path, bytes)| {
            (path.file_name().unwrap().to_str().unwrap().to_owned(), String::from_utf8(bytes).unwrap())
        })
        .collect();
    let has_place = |page: &str, place: &str| page.matches(&format!(" id=\"{place}\"")).count() == 1;
    let mut count = 0;
    for (name, page) in &pages {
        assert!(!page.contains("http:") && !page.contains("https:") && !page.contains("<script>alert"), "{name}");
        for link in page.split("href=\"").skip(1).map(|rest| rest.split_once('"').unwrap().0) {
            let (address, place) = link.split_once('#').map_or((link, None), |(address, place)| (address, Some(place)));
            let target = match address.strip_prefix("./") {
                Some(address) => {
                    count += 1;
                    pages.get(&percent_decoded(address)).unwrap_or_else(|| panic!("{name} leads to {address}"))
                }
                None => {
                    assert!(address.is_empty(), "{name} leads to {address}");
                    page
                }
            };
            assert!(place.is_none_or(|place| has_place(target, place)), "{name} leads to {link}");
        }
    }
    count
}

fn percent_decoded(address: &str) -> String {
    let mut parts = address.split('%');
    let mut bytes = parts.next().unwrap_or_default().as_bytes().to_vec();
    for part in parts {
        bytes.push(u8::from_str_radix(&part[..2], 16).unwrap());
        bytes.extend_from_slice(&part.as_bytes()[2..]);
    }
    String::from_utf8(bytes).unwrap()
}

/// Waits for a condition that must become true; a minute is far more than it takes.
fn until(has_come: impl Fn() -> bool) {
    for _ in 0..6000 {
        if has_come() {
            return;
        }
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    panic!("it did not come within a minute");
}

/// Every file below a folder with its content.
fn all_files(folder: &std::path::Path) -> Vec<(std::path::PathBuf, Vec<u8>)> {
    let mut found = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            match path.is_dir() {
                true => folders.push(path),
                false => found.push((path.clone(), std::fs::read(&path).unwrap())),
            }
        }
    }
    found.sort();
    found
}

/// Replaces Bob's answer with a wrong one.
fn hand_in_again(lab: &Lab) {
    let name = "all/bob/reference.vert";
    let text = String::from_utf8(lab.read(name)).unwrap();
    lab.write(name, text.replace("mat3(itM)", "mat3(M)"));
}

#[test]
fn a_gl_program_is_drawn_and_its_frame_listed() {
    let lab = Lab::new();
    let folder = lab.path("mine").to_string_lossy().into_owned();
    lab.run(&["lab", "start", "ex11", &folder]).good();
    let program = |name: &str| format!("{folder}/host/{name}.txt");
    let picture = lab.path("black.png").to_string_lossy().into_owned();
    let run = lab
        .run(&["lab", "draw", "ex11", &program("texture-name-as-unit"), "-o", &picture, "--size", "256", "--frame"])
        .good();
    for words in
        ["error texture-name-as-unit", "`ourTexture`", "256 x 256", "draw 0 is line 45: draw_arrays TRIANGLES 0 3"]
    {
        assert!(run.text().contains(words), "{words}: {}", run.text());
    }
    let right = lab.path("right.png").to_string_lossy().into_owned();
    lab.run(&["lab", "draw", "ex11", "-o", &right, "--size", "256"]).good();
    // The middle of the triangle: a bright check above the exercise's ground, and black.
    let at = |name: &str| lab.picture(name).to_rgb8().get_pixel(138, 118).0;
    assert!(at("right.png").iter().all(|channel| *channel > 90), "{:?}", at("right.png"));
    assert_eq!(at("black.png"), [0, 0, 0]);

    let json = lab.run(&["lab", "draw", "ex11", &program("uniform-before-use-program"), "--json"]).good().json();
    assert_eq!(json["refused"][0]["call"], "uniform_1i");
    assert_eq!(json["refused"][0]["error"], "INVALID_OPERATION");
    lab.run(&["lab", "draw", "ex11", &folder, "-o", &right]).refused(&["8 GL programs"]);
    lab.run(&["lab", "draw", "ex11", &program("stride-wrong")]).refused(&["-o picture.png"]);
    lab.write("mine/host/new.txt", "draw_arays TRIANGLES 0 3\n");
    lab.run(&["lab", "draw", "ex11", &program("new"), "-o", &right]).refused(&["new.txt:1:1", "draw_arrays"]);
}

#[test]
fn a_pair_of_shaders_is_drawn_and_compile_errors_have_lines() {
    let lab = Lab::new();
    let path = |name: &str| lab.path(name).to_string_lossy().into_owned();
    lab.run(&["lab", "start", "ex04", &path("mine")]).good();
    lab.run(&["lab", "draw", "ex04", "-o", &path("right.png")]).good();
    // The goal is the picture of the reference solution, not of the start files.
    assert_eq!(lab.picture("mine/goal.png"), lab.picture("right.png"));
    lab.run(&["lab", "draw", "ex04", &path("mine"), "-o", &path("mine.png")]).good();
    assert_ne!(lab.picture("mine.png"), lab.picture("right.png"));
    lab.run(&["lab", "draw", "ex04", "-o", &path("ring.png"), "--scene", "stretched"]).good();
    assert_ne!(lab.picture("ring.png"), lab.picture("right.png"));
    lab.run(&["lab", "draw", "ex04", "-o", &path("x.png"), "--scene", "moon"]).refused(&["`moon`", "stretched"]);
    lab.run(&["lab", "draw", "ex04", "-o", &path("x.png"), "--frame"]).refused(&["GL program"]);

    hand_in(&lab, "ex04", "broken", "mat3(itM) * normal", "mat3(itM) * norml");
    let broken = [path("broken/reference.vert"), path("broken/reference.frag")];
    lab.run(&["lab", "draw", "ex04", &broken[0], &broken[1], "-o", &path("x.png")])
        .refused(&["reference.vert:", "norml"]);
    assert!(!lab.path("x.png").exists());
}

/// The window's result for the reference solution of exercise 04, with `change` in place of the fragment shader's `void main() {`.
fn outcome(change: &str) -> TrialOutcome {
    let exercise = exercise::find("ex04").unwrap();
    let text = |(name, text): (&str, &str)| {
        let text = if name.ends_with(".frag") { text.replacen("void main() {", change, 1) } else { text.to_owned() };
        (name.to_owned(), text.into_bytes())
    };
    let files = exercise.reference_files().unwrap().map(text).collect();
    let request = CheckRequest { exercise: "ex04".into(), files, as_the_lab: false };
    let mut process = trial::begin(Path::new(env!("CARGO_BIN_EXE_gonio")), &request, || ()).unwrap();
    loop {
        if let Some(outcome) = process.poll() {
            return outcome;
        }
        std::thread::sleep(Duration::from_millis(10));
    }
}

#[test]
fn ordinary_shaders_are_harmless_even_with_errors() {
    for change in [
        "void main() {",
        "void main() { int i; for (i = 0; i < 16; ++i) { }",
        "void mian() {",
        "void main( {",
        "#error no\nvoid main() {",
    ] {
        assert_eq!(outcome(change), TrialOutcome::Harmless, "{change}");
    }
}

/// Texts that crash a reader or a driver, or exhaust the memory, on some machine: the process reports a sentence, or that the
/// compiler rejects the text.
#[test]
fn hostile_texts_are_refused_in_one_sentence() {
    let long = format!("void main() {{ float x = 1.0{};", "+0.0".repeat(40_000));
    let deep = format!("void main() {{ float x = {}1.0{};", "(".repeat(50_000), ")".repeat(50_000));
    let doubling: String = (1..40).map(|n| format!("#define M{n} M{} M{}\n", n - 1, n - 1)).collect();
    let macros = format!("#define M0 x += 1.0;\n{doubling}void main() {{ float x = 0.0; M39");
    let array = "void main() { int a[2147483647]; a[int(gl_FragCoord.x)] = 1;";
    let endless = "void main() { float z = 1.0; while (z > 0.0) { z += 1e-9; }";
    for text in [&long, &deep, &macros, array, endless] {
        match outcome(text) {
            TrialOutcome::Harmless => {}
            TrialOutcome::Refused(why) => {
                assert!(why.contains("the window does not draw it") && !why.contains('\n'), "{why}");
            }
            TrialOutcome::Unavailable(why) => panic!("{:.60}: {why}", text),
        }
    }
}

/// A loop that ends late: at the size of a window it would block everything.
#[test]
fn a_shader_that_would_block_the_window_is_refused() {
    let slow =
        "void main() { float z = gl_FragCoord.x; for (int i = 0; i < 60000; ++i) { z = fract(sin(z) * 43758.5); }
        if (z > 2.0) discard;";
    let TrialOutcome::Refused(why) = outcome(slow) else { panic!("it counts as harmless") };
    assert!(why.contains("seconds"), "{why}");
}

#[test]
fn missing_files_or_a_damaged_list_are_an_error() {
    for input in [&b""[..], b"\x01\0\0\0", b"\xff\xff\xff\xff"] {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_gonio"));
        let mut child = command
            .args(["lab", "trial", "ex04"])
            .stdin(std::process::Stdio::piped())
            .stderr(std::process::Stdio::piped())
            .spawn()
            .unwrap();
        std::io::Write::write_all(&mut child.stdin.take().unwrap(), input).unwrap();
        let output = child.wait_with_output().unwrap();
        let words = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2));
        assert!(words.starts_with("error: ") && words.lines().count() == 1, "{words}");
    }
}
