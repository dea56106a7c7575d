//! No package has a line of a reference.

use crate::common::Lab;
use crate::{all_files, edit, light_equation, read, rim_light};

const PLATFORMS: [&str; 5] = ["gradescope", "coderunner", "github-classroom", "moodle", "docker"];

/// A text without spaces.
fn squeezed(text: &str) -> String {
    text.split_whitespace().collect()
}

/// The bytes of base64 text.
pub fn from_base64(text: &str) -> Vec<u8> {
    let digit = |c: u8| match c {
        b'A'..=b'Z' => Some(u32::from(c - b'A')),
        b'a'..=b'z' => Some(u32::from(c - b'a') + 26),
        b'0'..=b'9' => Some(u32::from(c - b'0') + 52),
        b'+' => Some(62),
        b'/' => Some(63),
        _ => None,
    };
    let digits: Vec<u32> = text.bytes().filter_map(digit).collect();
    let mut bytes = Vec::new();
    for group in digits.chunks(4) {
        let all = group.iter().fold(0, |all, digit| all << 6 | digit) << (6 * (4 - group.len()));
        bytes.extend(&all.to_be_bytes()[1..group.len()]);
    }
    bytes
}

/// Everything that a package contains, with what is in base64 decoded.
fn contents(lab: &Lab, folder: &str) -> Vec<(String, String)> {
    let mut all = Vec::new();
    for (name, bytes) in all_files(&lab.path(folder)) {
        let text = String::from_utf8_lossy(&bytes).into_owned();
        for (at, piece) in text.split("encoding=\"base64\">").skip(1).enumerate() {
            let inner = from_base64(piece.split('<').next().unwrap());
            assert!(!inner.is_empty(), "{name}: file {at}");
            all.push((format!("{name}#{at}"), String::from_utf8_lossy(&inner).into_owned()));
        }
        all.push((name, text));
    }
    all
}

/// The lines of the reference that no student has: what the files to start from and the text lack.
fn secret_lines(lab: &Lab, exercise: &str) -> Vec<String> {
    let of = |name: &str| read(lab, &format!("course/{exercise}/{name}"));
    let known: String = ["start.vert", "start.frag", "text.md"].map(|name| squeezed(&of(name))).concat();
    let lines = [of("reference.vert"), of("reference.frag")].join("\n");
    let lines = lines.lines().map(|line| squeezed(line.split("//").next().unwrap()));
    lines.filter(|line| line.len() >= 16 && !known.contains(line)).collect()
}

#[test]
fn no_package_has_a_line_of_the_reference() {
    for (lab, exercise) in [(rim_light(), "rim-light"), (light_equation(), "light-equation")] {
        // A comment may say what the answer is.
        edit(
            &lab,
            &format!("course/{exercise}/exercise.toml"),
            "judge =",
            "# answer: pow(1.0 - facing, rim_exponent)\njudge =",
        );
        lab.write(
            &format!("course/{exercise}/solution.frag"),
            read(&lab, &format!("course/{exercise}/reference.frag")),
        );
        let secret = secret_lines(&lab, exercise);
        assert!(secret.len() >= 6, "{secret:?}");
        for platform in PLATFORMS {
            let package = ["course", "package", exercise, "--course", "course", "--for", platform, "-o", platform];
            lab.run(&[&package, ["--program", "none"].as_slice()].concat()).good();
            let files = contents(&lab, platform);
            assert!(files.len() >= 3, "{platform}");
            for (name, text) in &files {
                assert!(!name.contains("reference.vert") && !name.contains("reference.frag"), "{platform}: {name}");
                let text = squeezed(text);
                for line in &secret {
                    assert!(!text.contains(line), "{platform}: {name} contains `{line}`");
                }
                assert!(!text.contains("#answer:"), "{platform}: {name}");
            }
        }
    }
}

#[test]
fn texts_that_are_never_shown_are_not_packaged() {
    let lab = rim_light();
    let mistakes = |level: &str| {
        edit(&lab, "course/course.toml", "feedback = \"line\"", &format!("feedback = \"{level}\""));
        let package =
            ["course", "package", "rim-light", "--course", "course", "--for", "github-classroom", "-o", level];
        lab.run(&package).good();
        edit(&lab, "course/course.toml", &format!("feedback = \"{level}\""), "feedback = \"line\"");
        read(&lab, &format!("{level}/upload/.gonio/course/rim-light/mistakes.toml"))
    };
    let [verdict, name, line] = ["verdict", "name", "line"].map(mistakes);
    for (text, has_name, has_fix) in [(&verdict, false, false), (&name, true, false), (&line, true, true)] {
        assert_eq!(text.contains("The rim depends on the light"), has_name, "{text}");
        assert_eq!(text.contains("Compute the cosine between"), has_fix, "{text}");
        assert!(!text.contains("find =") && !text.contains("dot(N"), "{text}");
    }
}

#[test]
fn a_package_is_complete_or_not_there() {
    let lab = rim_light();
    let package = |output: &str| {
        lab.run(&["course", "package", "rim-light", "--course", "course", "--for", "moodle", "-o", output])
    };
    std::fs::create_dir(lab.path("taken")).unwrap();
    package("taken").refused(&["taken", "exists"]);
    package("nowhere/deep").refused(&["nowhere"]);
    lab.run(&["course", "package", "rim-lite", "--course", "course", "--for", "moodle", "-o", "x"])
        .refused(&["rim-light"]);
    lab.run(&["course", "package", "rim-light", "--for", "moodel", "-o", "x"]).refused(&["moodle"]);
    assert_eq!(lab.names(), ["course", "taken"]);
    package("good").good();
    assert_eq!(lab.names(), ["course", "good", "taken"]);
}
