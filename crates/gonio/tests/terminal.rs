//! No text in a file, a name or an option can control the terminal that it is printed to.
#![allow(clippy::unwrap_used, missing_docs)]
#![cfg(unix)]

mod common;

use common::{EVIL, Lab, Run, evil_line, faults};

/// The forms in which the hostile text can be read: ours, JSON's, and that of libraries that quote a word.
const READABLE: &[&str] = &["\\x1b[2K", "\\u001b[2K", "\\u001B[2K", "\\u{1b}[2K", "\\x1b [ 2K"];

/// Runs it for a pipe, with colours forced, and for machines; what was printed is harmless, and quotes the hostile text.
fn harmless(lab: &Lab, args: &[&str]) {
    quoted(lab, args, READABLE);
    let json: Vec<&str> = args.iter().copied().chain(["--json"]).collect();
    quoted(lab, &json, READABLE);
}

/// The same of a command that need not quote it, for a pipe and with colours.
fn harmless_unquoted(lab: &Lab, args: &[&str]) {
    quoted(lab, args, &[""]);
}

/// The same in one form.
fn quoted(lab: &Lab, args: &[&str], one_of: &[&str]) {
    for coloured in [false, true] {
        let mut command = lab.command(args);
        command.env_remove("NO_COLOR").env_remove("CLICOLOR_FORCE");
        if coloured {
            command.env("CLICOLOR_FORCE", "1");
        }
        let output = command.output().unwrap();
        let code = output.status.code();
        assert!(matches!(code, Some(0..=2)), "{args:?}: {code:?}");
        for (stream, bytes) in [("stdout", &output.stdout), ("stderr", &output.stderr)] {
            let faults = faults(bytes, coloured);
            assert!(faults.is_empty(), "gonio {args:?} writes to {stream}: {faults:#?}");
        }
        let all = String::from_utf8([output.stdout.clone(), output.stderr.clone()].concat()).unwrap();
        assert!(!all.contains("panicked"), "{args:?}: {all}");
        assert!(one_of.iter().any(|form| all.contains(form)), "gonio {args:?} does not quote it: {all}");
        if args.contains(&"--json") && !output.stdout.is_empty() && code != Some(2) {
            let value: Result<serde_json::Value, _> = serde_json::from_slice(&output.stdout);
            assert!(value.is_ok(), "{args:?}: {all}");
        }
    }
}

#[test]
fn arguments() {
    let lab = Lab::new();
    for option in
        ["--size", "--light", "--material", "--camera-position", "--debug", "--samples", "--brdf", "--background"]
    {
        quoted(&lab, &["render", "builtin:cube", "-o", "x.png", option, EVIL], &["\\x1b[2K"]);
    }
    for option in ["--uniform", "--texture"] {
        quoted(&lab, &["render", "builtin:cube", "-o", "x.png", "--fragment", "x", option, EVIL], &["\\x1b[2K"]);
    }
    let option = format!("--{EVIL}");
    quoted(&lab, &["render", &option], &["\\x1b[2K"]);
    quoted(&lab, &["render", "builtin:cube", &format!("--shading={EVIL}")], &["\\x1b[2K"]);
    quoted(&lab, &[EVIL], &["\\x1b[2K"]);
    quoted(&lab, &["lab", EVIL], &["\\x1b[2K"]);
    quoted(&lab, &["serve", "--port", EVIL], &["\\x1b[2K"]);
    quoted(&lab, &["inspect", "builtin:cube", "--line", EVIL], &["\\x1b[2K"]);
    for args in [
        vec!["lab", "check", EVIL, "x"],
        vec!["lab", "check", "ex04", "x", "--format", EVIL],
        vec!["lsp", "--exercise", EVIL],
        vec!["lab", "list", "--course", EVIL],
        vec!["course", "new", "x", "--from", EVIL],
        vec!["course", "verify", EVIL],
        vec!["course", "package", EVIL, "--for", "moodle", "-o", "x"],
        vec!["course", "package", "ex04", "--for", "docker", "-o", "x", "--program", EVIL],
        vec!["course", "package", "ex04", "--for", "docker", "-o", "x", "--program-url", EVIL],
        vec!["lab", "show", EVIL],
        vec!["lab", "mistakes", EVIL],
        vec!["lab", "draw", "ex07", "-o", "x.png", "--scene", EVIL],
        vec!["lab", "draw", "ex07", "-o", "x.png", "--show", EVIL],
        vec!["lab", "step", EVIL],
        vec!["lab", "step", "ex07", "--scene", EVIL],
        vec!["render", "builtin:cube", "-o", EVIL],
        vec!["render", "builtin:cube", "-o", "x.png", "--camera", EVIL],
        vec!["render", "builtin:cube", "-o", "x.png", "--brdf-file", EVIL],
        vec!["trace", "builtin:cube", "-o", EVIL],
        vec!["trace", "builtin:cube", "-o", "x.png", "--camera", EVIL],
        vec!["simplify", "builtin:cube", "-o", "x", "--camera", EVIL],
        vec!["beyond", "polarisation", "-o", "x", "--set", EVIL],
        vec!["beyond", "polarisation", "-o", "x", "--picture", EVIL],
        vec!["unwrap", EVIL],
        vec!["unwrap", "builtin:cube", "-o", EVIL],
        vec!["bake", EVIL, "-o", "x"],
        vec!["bake", "builtin:cube", "-o", "x", "--from", EVIL],
        vec!["bake", "builtin:cube", "-o", "x", "--what", EVIL],
        vec!["probe", "builtin:cube", "--at", "1,1", "--camera", EVIL],
        vec!["probe", "builtin:cube", "--fragment", EVIL],
        vec!["render", "builtin:cube", "-o", "x.png", "--fragment", "x", "--show", EVIL],
        vec!["environment", "check", EVIL],
        vec!["diff", EVIL, EVIL],
        vec!["brdf", "show", EVIL],
        vec!["brdf", "check", EVIL],
        vec!["brdf", "plot", EVIL, "-o", "x.svg"],
        vec!["brdf", "view", EVIL],
        vec!["brdf", "plot", "ward", "-o", EVIL],
        vec!["brdf", "export", EVIL, "-o", "x.csv"],
        vec!["brdf", "fit", EVIL, "-o", "x.toml"],
        vec!["brdf", "fit", "x", "-o", "x.toml", "--model", EVIL],
    ] {
        harmless(&lab, &args);
    }
}

#[test]
fn names_of_missing_and_unusual_files() {
    let lab = Lab::new();
    let [missing, folder] = ["missing", "folder"].map(|name| format!("{name}{EVIL}"));
    std::fs::create_dir(lab.path(&folder)).unwrap();
    for ending in ["obj", "toml", "glb", "ply", "stl", "dae"] {
        let name = format!("{missing}.{ending}");
        harmless(&lab, &["render", &name, "-o", "x.png"]);
        let broken = format!("broken{EVIL}.{ending}");
        lab.write(&broken, "\u{1b}[2K \u{202e}");
        harmless(&lab, &["render", &broken, "-o", "x.png"]);
    }
    // The name of a checkpoint, which is damaged.
    lab.write(&format!("picture{EVIL}.trace"), "");
    harmless(&lab, &["trace", "builtin:cube", "-o", &format!("picture{EVIL}.png")]);
    harmless(&lab, &["inspect", &missing]);
    for option in ["--vertex", "--fragment"] {
        harmless(&lab, &["render", "builtin:cube", "-o", "x.png", option, &missing]);
    }
    harmless(&lab, &["scene", &missing]);
    harmless(&lab, &["convert", &missing, "x.obj"]);
    harmless(&lab, &["convert", "builtin:cube", &format!("{missing}/x.obj")]);
    harmless(&lab, &["environment", "convert", &missing, "x.png"]);
    harmless(&lab, &["environment", "check", &folder]);
    harmless(&lab, &["lab", "check", "ex07", &missing]);
    harmless_unquoted(&lab, &["lab", "check", "ex07", &folder]);
    harmless(&lab, &["lab", "step", "ex07", &missing]);
    harmless(&lab, &["diff", &missing, "x.png"]);
    harmless(&lab, &["brdf", "check", &missing]);
    harmless(&lab, &["brdf", "show", &folder]);
    for ending in ["brdf", "binary", "glsl", "fit.toml"] {
        let broken = format!("broken{EVIL}.{ending}");
        lab.write(&broken, "\u{1b}[2K \u{202e}");
        harmless(&lab, &["brdf", "check", &broken]);
    }
    harmless(&lab, &["tour", "-o", &format!("broken{EVIL}.obj")]);
    harmless(&lab, &["simplify", "builtin:cube", "-o", &format!("broken{EVIL}.obj")]);
}

/// A model with hostile names of everything, and what reads it.
#[test]
fn names_within_models_and_scenes() {
    let lab = Lab::new();
    let evil = evil_line();
    lab.write(
        "a.obj",
        format!(
            "mtllib a.mtl\nmtllib {evil}.mtl\no {evil}\ng {evil}\nusemtl {evil}\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n\
             usemtl missing {evil}\nf 3 2 1\n{evil} 1 2\nf 1 2 {evil}\n"
        ),
    );
    lab.write("a.mtl", format!("newmtl {evil}\nKd 1 {evil}\nmap_Kd {evil}.png\n{evil} 1\nKd 1 1 1\n"));
    harmless(&lab, &["inspect", "a.obj"]);
    for line in ["2", "4", "11", "12", "13"] {
        harmless(&lab, &["inspect", "a.obj", "--line", line]);
    }
    for line in ["1", "2", "3", "4"] {
        harmless(&lab, &["inspect", "a.mtl", "--line", line]);
    }
    let small = ["--size", "16x16", "--samples", "1"];
    harmless(&lab, &["probe", "a.obj", "--at", "8,8", "--size", "16x16"]);
    harmless(&lab, &[&["probe", "a.obj", "--at", "8,8", "--traced"][..], &small].concat());
    harmless(&lab, &[&["frame", "a.obj"][..], &small].concat());
    harmless(&lab, &[&["frame", "a.obj", "--draw", "0"][..], &small].concat());
    harmless(&lab, &[&["render", "a.obj", "-o", "a.png"][..], &small].concat());
    harmless(&lab, &["convert", "a.obj", "b.ply"]);
    harmless(&lab, &["scene", "a.obj"]);

    let key = evil.replace('"', "").chars().map(|c| format!("\\U{:08x}", u32::from(c))).collect::<String>();
    lab.write(
        "a.toml",
        format!("[[object]]\nmodel = \"builtin:cube\"\n\n[[light]]\nkind = \"point\"\nname = \"{key}\"\nposition = [2, 2, 2]\n"),
    );
    harmless(&lab, &["scene", "a.toml"]);
    quoted(&lab, &["probe", "a.toml", "--at", "8,8", "--size", "16x16"], READABLE);
    quoted(&lab, &[&["probe", "a.toml", "--at", "8,8", "--traced"][..], &small].concat(), READABLE);
    // The printed scene can be read again, and is the same.
    let printed = lab.run(&["scene", "a.toml"]).good();
    lab.write("b.toml", &printed.stdout);
    assert_eq!(lab.run(&["scene", "b.toml"]).good().text(), printed.text());
    for wrong in ["unknown\" = 1", "object\" = 1"] {
        lab.write("c.toml", format!("\"{key}{wrong}\n"));
        harmless(&lab, &["scene", "c.toml"]);
    }
    lab.write("d.toml", format!("[[object]]\nmodel = \"{key}\"\n"));
    harmless(&lab, &["scene", "d.toml"]);
    lab.write("e.toml", format!("# {evil}\nx = {evil}\n"));
    lab.run(&["scene", "e.toml"]).refused(&["e.toml"]);
    quoted(&lab, &["scene", "e.toml"], &["e.toml"]);
}

/// The right answer of an exercise, changed.
fn hand_in(lab: &Lab, exercise: &str, folder: &str, change: impl Fn(&str, String) -> String) {
    let path = lab.path(folder).to_string_lossy().into_owned();
    lab.run(&["lab", "reference", exercise, "-o", &path]).good();
    for name in ["reference.vert", "reference.frag"] {
        let name = format!("{folder}/{name}");
        let text = String::from_utf8(lab.read(&name)).unwrap();
        lab.write(&name, change(&name, text));
    }
}

fn judged(lab: &Lab, args: &[&str], first_line: &str) {
    quoted(lab, args, &["\\x1b[2K", "\\u001b[2K"]);
    let run: Run = lab.run(args);
    assert_eq!(run.code, 1, "{args:?}: {}", run.stderr);
    assert!(run.text().starts_with(first_line), "{args:?}: {}", run.text());
    let json: Vec<&str> = args.iter().copied().chain(["--json"]).collect();
    quoted(lab, &json, &["\\u001b[2K"]);
}

#[test]
fn verdicts() {
    let lab = Lab::new();
    let evil = evil_line();
    let wrong = |text: String| text.replace("mat3(itM)", "mat3(M)");
    // A comment in the line that is quoted.
    hand_in(&lab, "ex04", "quoted", |_, text| {
        text.replace("mat3(itM) * normal);", &format!("mat3(M) * normal); // {evil}"))
    });
    judged(&lab, &["lab", "check", "ex04", "quoted"], "ex04  wrong: ");
    // Text that a compiler quotes.
    hand_in(&lab, "ex04", "error", |_, text| text.replace("void main", &format!("#error {evil}\nvoid main")));
    judged(&lab, &["lab", "check", "ex04", "error"], "ex04  does not compile: ");
    hand_in(&lab, "ex04", "token", |_, text| text.replace("void main() {", &format!("void main() {{\n  {evil}")));
    judged(&lab, &["lab", "check", "ex04", "token"], "ex04  ");
    // Names of files.
    hand_in(&lab, "ex04", "named", |_, text| wrong(text).replace("vec3 N =", "vec3 N = x +"));
    for end in ["vert", "frag"] {
        std::fs::rename(lab.path(&format!("named/reference.{end}")), lab.path(&format!("named/a{EVIL}.{end}")))
            .unwrap();
    }
    judged(&lab, &["lab", "check", "ex04", "named"], "ex04  ");
    // Text in names.toml.
    let key = evil.chars().map(|c| format!("\\U{:08x}", u32::from(c))).collect::<String>();
    hand_in(&lab, "ex04", "names", |_, text| wrong(text));
    lab.write("names/names.toml", format!("\"{key}\" = \"{key}\"\n"));
    quoted(&lab, &["lab", "check", "ex04", "names"], &["\\x1b[2K"]);
    // A folder of all, by a hostile name too.
    std::fs::create_dir(lab.path("all")).unwrap();
    for name in ["quoted", "error", "token", "named"] {
        std::fs::rename(lab.path(name), lab.path(&format!("all/{name}{EVIL}"))).unwrap();
    }
    harmless(&lab, &["lab", "check", "ex04", "all", "-o", &format!("results{EVIL}")]);
}

#[test]
fn files_of_a_verdict() {
    let lab = Lab::new();
    let evil = evil_line();
    let folder = format!("mine{EVIL}");
    hand_in(&lab, "ex04", &folder, |_, text| {
        text.replace("mat3(itM) * normal);", &format!("mat3(M) * normal); // {evil}"))
    });
    let args = ["--page", "p.html", "--junit", "j.xml", "--gradescope", "g.json", "--code-runner", "c.json"];
    let run = lab.run(&[&["lab", "check", "ex04", &folder][..], &args].concat());
    assert_eq!(run.code, 1, "{}", run.stderr);
    for name in ["p.html", "j.xml", "g.json", "c.json"] {
        let text = String::from_utf8(lab.read(name)).unwrap();
        let hidden = text.chars().find(|&c| c != '\n' && (c.is_control() || ('\u{2028}'..='\u{202e}').contains(&c)));
        assert!(hidden.is_none(), "{name}: {hidden:?}");
        assert!(text.contains("x1b[2K"), "{name} does not quote it: {text}");
    }
}

#[test]
fn courses() {
    let lab = Lab::new();
    let key = evil_line().chars().map(|c| format!("\\U{:08x}", u32::from(c))).collect::<String>();
    lab.run(&["course", "new", "a", "--from", "reference", "--language", "en"]).good();
    let edit = |name: &str, from: &str, to: &str| {
        let text = String::from_utf8(lab.read(name)).unwrap();
        assert!(text.contains(from), "{text}");
        lab.write(name, text.replace(from, to));
    };
    edit("a/course.toml", "My course", &key);
    edit("a/rim-light/exercise.toml", "title = \"Rim light\"", &format!("title = \"{key}\""));
    edit("a/rim-light/exercise.toml", "name = \"from above\"", &format!("name = \"{key}\""));
    edit("a/rim-light/mistakes.toml", "The rim depends on the light instead of the camera", &key);
    lab.write("a/rim-light/text.md", EVIL);
    lab.write(&format!("a/rim-light/unused{EVIL}"), "");
    harmless(&lab, &["lab", "list", "--course", "a"]);
    harmless(&lab, &["lab", "show", "rim-light", "--course", "a"]);
    harmless(&lab, &["course", "verify", "a", "--mutants", "1"]);
    std::fs::create_dir(lab.path("wrong")).unwrap();
    for end in ["vert", "frag"] {
        let text = String::from_utf8(lab.read(&format!("a/rim-light/reference.{end}"))).unwrap();
        lab.write(&format!("wrong/x.{end}"), text.replace("dot(N, V)", "dot(N, L)"));
    }
    harmless(&lab, &["lab", "check", "rim-light", "wrong", "--course", "a"]);
    // A course around the current folder is mentioned by its name.
    let output = lab.command(&["lab", "list"]).current_dir(lab.path("a")).output().unwrap();
    assert!(faults(&output.stderr, false).is_empty() && String::from_utf8(output.stderr).unwrap().contains("\\x1b[2K"));
    edit("a/rim-light/exercise.toml", "judge =", &format!("\"{key}\" = 1\njudge ="));
    harmless(&lab, &["lab", "list", "--course", "a"]);
    harmless(&lab, &["course", "new", &format!("b{EVIL}")]);
}

#[test]
fn gl_programs() {
    let lab = Lab::new();
    let evil = evil_line();
    lab.write("a.txt", format!("program = create_program {}.vert start.frag\n{evil}\n", evil.replace(' ', "")));
    harmless_unquoted(&lab, &["lab", "draw", "ex11", "a.txt", "-o", "a.png"]);
    harmless_unquoted(&lab, &["lab", "check", "ex11", "a.txt"]);
    hand_in(&lab, "ex04", "broken", |_, text| text.replace("void main", &format!("#error {evil}\nvoid main")));
    harmless(&lab, &["lab", "draw", "ex04", "broken", "-o", "a.png"]);
    let start = format!("new{EVIL}");
    harmless(&lab, &["lab", "start", "ex01", &start]);
    quoted(&lab, &["lab", "reference", "ex01", "-o", &format!("right{EVIL}")], &["\\x1b[2K"]);
}

#[test]
fn pictures() {
    let lab = Lab::new();
    let name = format!("a{EVIL}.png");
    lab.render(&["builtin:cube", "-o", &name]).good();
    harmless(&lab, &["diff", &name, &name]);
    harmless(&lab, &["environment", "check", &name]);
    for out in [format!("sky{EVIL}.png"), format!("sky{EVIL}")] {
        harmless_unquoted(&lab, &["environment", "convert", "debug", &out, "--size", "8"]);
        quoted(&lab, &["environment", "convert", "debug", &out, "--size", "8", "--json"], READABLE);
    }
}
