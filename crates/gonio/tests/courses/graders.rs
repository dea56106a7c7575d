//! The packages, each run as its platform runs it, with a right and a wrong submission.

use crate::common::Lab;
use crate::secrecy::from_base64;
use crate::{all_files, hand_in, read, rim_light};
use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};

/// The course, a right submission, a wrong one and one that is no shader; and the package for a platform.
fn packaged(platform: &str) -> Lab {
    let lab = rim_light();
    hand_in(&lab, "rim-light", "right", &[]);
    hand_in(&lab, "rim-light", "wrong", &[("reference.frag", "dot(N, V)", "dot(N, L)")]);
    std::fs::create_dir(lab.path("nothing")).unwrap();
    lab.write("nothing/notes.txt", "I was \"ill\" \\ today");
    let package = ["course", "package", "rim-light", "--course", "course", "--for", platform, "-o", "package"];
    lab.run(&[&package, ["--program", "none"].as_slice()].concat()).good();
    lab
}

fn copy(from: &Path, to: &Path) {
    for (name, bytes) in all_files(from) {
        let path = to.join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, bytes).unwrap();
    }
}

/// A command that finds the program under test, and nothing of the person who runs the test.
fn command(program: &str, args: &[&str], folder: &Path) -> Command {
    let mut command = Command::new(program);
    command.args(args).current_dir(folder).env("GONIO", env!("CARGO_BIN_EXE_gonio"));
    command
}

#[track_caller]
fn ran(output: Output, code: i32) -> String {
    let [out, err] = [output.stdout, output.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
    assert_eq!(output.status.code(), Some(code), "{out}\n{err}");
    out
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap_or_else(|error| panic!("{error}: {text}"))
}

#[test]
fn gradescope_gets_results_in_its_layout() {
    let lab = packaged("gradescope");
    for (submission, score, word) in [
        ("right", 10.0, "correct"),
        ("wrong", 7.0, "rim-by-light"),
        ("nothing", 0.0, "there is no shader in notes.txt"),
    ] {
        let root = lab.path(&format!("autograder-{submission}"));
        copy(&lab.path("package/upload"), &root.join("source"));
        copy(&lab.path(submission), &root.join("submission"));
        let mut harness = command("bash", &["source/run_autograder"], &root);
        ran(harness.env("AUTOGRADER_ROOT", &root).output().unwrap(), 0);
        let results = json(&std::fs::read_to_string(root.join("results/results.json")).unwrap());
        assert_eq!(results["score"], score, "{submission}: {results}");
        assert!(results["output"].as_str().unwrap().contains(word), "{results}");
        assert_eq!((&results["visibility"], &results["stdout_visibility"]), (&"visible".into(), &"hidden".into()));
        for test in results["tests"].as_array().unwrap() {
            assert!(test["name"].is_string() && test["visibility"] == "visible", "{test}");
        }
    }
    // A result is there also if gonio is not.
    lab.write("broken", "#!/bin/sh\necho 'error: there is no \"OpenGL\" \\ here' >&2\nexit 2\n");
    let root = lab.path("autograder-right");
    let broken = format!("{}/broken", lab.path("").display());
    ran(command("chmod", &["+x", &broken], &root).output().unwrap(), 0);
    let mut harness = command("bash", &["source/run_autograder"], &root);
    ran(harness.env("AUTOGRADER_ROOT", &root).env("GONIO", &broken).output().unwrap(), 0);
    let results = json(&std::fs::read_to_string(root.join("results/results.json")).unwrap());
    let output = results["output"].as_str().unwrap();
    assert!(
        results["score"] == 0 && output.ends_with("(exit code 2). error: there is no \"OpenGL\" \\ here"),
        "{results}"
    );
}

/// Gradescope's harness unpacks the zip and runs `setup.sh`. Installing packages is left out here.
#[test]
fn gradescopes_zip_sets_itself_up() {
    let lab = packaged("moodle");
    let root = lab.path("");
    lab.write("program", format!("#!/bin/sh\nexec '{}' \"$@\"\n", env!("CARGO_BIN_EXE_gonio")));
    let package = ["course", "package", "rim-light", "--course", "course", "--for", "gradescope", "-o", "up.zip"];
    lab.run(&[&package, ["--program", "program"].as_slice()].concat()).good();
    let script = "import zipfile\nz = zipfile.ZipFile('up.zip')\nz.extractall('source')\n\
        for i in z.infolist(): print(i.filename, oct(i.external_attr >> 16))";
    let listed = ran(command("python3", &["-c", script], &root).output().unwrap(), 0);
    for line in [
        "setup.sh 0o100755",
        "run_autograder 0o100755",
        "gonio 0o100755",
        "course/rim-light/reference.pictures 0o100644",
    ] {
        assert!(listed.lines().any(|listed| listed == line), "`{line}` is not in {listed}");
    }
    std::fs::create_dir(lab.path("bin")).unwrap();
    lab.write("bin/apt-get", "#!/bin/sh\necho \"$@\" >> packages\n");
    ran(command("chmod", &["+x", "bin/apt-get"], &root).output().unwrap(), 0);
    let path = format!("{}:{}", lab.path("bin").display(), std::env::var("PATH").unwrap());
    let mut setup = command("bash", &["source/setup.sh"], &root);
    ran(setup.env("AUTOGRADER_ROOT", &root).env("PATH", path).output().unwrap(), 0);
    assert!(read(&lab, "packages").contains("libegl1"));
    copy(&lab.path("wrong"), &lab.path("submission"));
    let mut harness = command("bash", &["source/run_autograder"], &root);
    ran(harness.env("AUTOGRADER_ROOT", &root).env_remove("GONIO").output().unwrap(), 0);
    assert_eq!(json(&read(&lab, "results/results.json"))["score"], 7.0);
}

#[test]
fn a_built_in_exercise_is_packaged_without_a_course() {
    let lab = Lab::new();
    let package =
        |exercise: &str, platform: &str| lab.run(&["course", "package", exercise, "--for", platform, "-o", "x"]);
    package("ex02", "coderunner").refused(&["ex02", "pair of shaders"]);
    lab.run(&[
        "course",
        "package",
        "ex04",
        "--for",
        "docker",
        "-o",
        "package",
        "--program",
        "none",
        "--language",
        "en",
    ])
    .good();
    lab.run(&["lab", "reference", "ex04", "-o", "right"]).good();
    std::fs::create_dir(lab.path("results")).unwrap();
    let mut grade = command("sh", &["package/upload/grade.sh"], &lab.path(""));
    grade.env("SUBMISSION", "right").env("RESULTS", "results").env("COURSE", "package/upload/course");
    ran(grade.output().unwrap(), 0);
    assert_eq!(json(&read(&lab, "results/verdict.json"))["verdict"], "correct");
}

#[test]
fn a_container_judges_what_is_mounted_and_has_limits() {
    let lab = packaged("docker");
    for (submission, code, outcome) in [("right", 0, "correct"), ("wrong", 1, "wrong")] {
        let results = lab.path(&format!("results-{submission}"));
        std::fs::create_dir(&results).unwrap();
        let mut grade = command("sh", &["package/upload/grade.sh"], &lab.path(""));
        grade.env("SUBMISSION", submission).env("RESULTS", &results).env("COURSE", "package/upload/course");
        ran(grade.output().unwrap(), code);
        let verdict = json(&std::fs::read_to_string(results.join("verdict.json")).unwrap());
        assert_eq!(verdict["verdict"], outcome, "{verdict}");
        assert!(results.join("verdict.html").exists() && results.join("verdict.xml").exists());
    }
    let mut nothing = command("sh", &["package/upload/grade.sh"], &lab.path(""));
    std::fs::create_dir(lab.path("results")).unwrap();
    nothing.env("SUBMISSION", "nothing").env("RESULTS", "results").env("COURSE", "package/upload/course");
    ran(nothing.output().unwrap(), 1);
    assert_eq!(json(&read(&lab, "results/verdict.json"))["verdict"], "unsure");
    let run = read(&lab, "package/upload/run.sh");
    for option in [
        "--network none",
        "--read-only",
        "--cap-drop ALL",
        "no-new-privileges",
        "--memory",
        "--pids-limit",
        ":/submission:ro",
    ] {
        assert!(run.contains(option), "{option}");
    }
    ran(command("sh", &["-n", "package/upload/run.sh"], &lab.path("")).output().unwrap(), 0);
    let dockerfile = read(&lab, "package/upload/Dockerfile");
    for instruction in ["FROM ", "COPY course /course", "USER grader", "ENTRYPOINT [\"/bin/sh\", \"/grade.sh\"]"] {
        assert!(dockerfile.lines().any(|line| line.starts_with(instruction)), "{dockerfile}");
    }
}

#[test]
fn github_classroom_gets_points_that_its_reporter_can_read() {
    let lab = packaged("github-classroom");
    for (submission, score, status) in [("right", 10.0, "pass"), ("wrong", 7.0, "fail"), ("nothing", 0.0, "error")] {
        // A student's repository: the template, with other shaders.
        let repository = lab.path(&format!("repository-{submission}"));
        copy(&lab.path("package/upload"), &repository);
        for name in ["start.vert", "start.frag"] {
            std::fs::remove_file(repository.join(name)).unwrap();
        }
        copy(&lab.path(submission), &repository.join("src"));
        let output = lab.path(&format!("output-{submission}"));
        let mut grade = command("bash", &[".gonio/grade.sh"], &repository);
        let printed = ran(grade.env("GITHUB_OUTPUT", &output).output().unwrap(), 0);
        let line = std::fs::read_to_string(&output).unwrap();
        let encoded = line.trim_end().strip_prefix("result=").unwrap();
        let result = json(&String::from_utf8(from_base64(encoded)).unwrap());
        assert_eq!((&result["max_score"], &result["status"]), (&10.0.into(), &status.into()), "{result}");
        let tests = result["tests"].as_array().unwrap();
        assert_eq!(
            (tests.len(), &tests[0]["score"], &tests[0]["status"]),
            (1, &score.into(), &status.into()),
            "{result}"
        );
        if submission == "wrong" {
            assert!(
                printed.contains("::error file=src/mine.frag,line="),
                "messages at the lines of the push: {printed}"
            );
        }
    }
}

/// The parts of a workflow that Classroom and its reporter rely on, by indentation.
#[test]
fn the_workflow_has_the_form_of_the_autograding_actions() {
    let lab = packaged("github-classroom");
    let text = read(&lab, "package/upload/.github/workflows/classroom.yml");
    let mut path: Vec<(usize, String)> = Vec::new();
    let mut found: Vec<String> = Vec::new();
    let mut literal: Option<usize> = None;
    for line in text.lines().filter(|line| !line.trim().is_empty() && !line.trim_start().starts_with('#')) {
        let indent = line.len() - line.trim_start().len();
        if literal.is_some_and(|outer| indent > outer) {
            continue;
        }
        literal = None;
        assert!(!line.contains('\t') && indent.is_multiple_of(2), "{line:?}");
        let (indent, entry) = match line.trim_start().strip_prefix("- ") {
            Some(entry) => (indent + 2, entry),
            None => (indent, line.trim_start()),
        };
        path.retain(|(outer, _)| *outer < indent);
        let (key, value) = entry.split_once(':').unwrap_or((entry, ""));
        path.push((indent, key.to_owned()));
        if value.trim() == "|" {
            literal = Some(indent);
        }
        let place: Vec<&str> = path.iter().map(|(_, key)| key.as_str()).collect();
        found.push(format!("{}={}", place.join("."), value.trim()));
    }
    for expected in [
        "name=Autograding Tests",
        "permissions.checks=write",
        "jobs.run-autograding-tests.runs-on=ubuntu-latest",
        "jobs.run-autograding-tests.steps.uses=actions/checkout@v4",
        "jobs.run-autograding-tests.steps.id=gonio",
        "jobs.run-autograding-tests.steps.uses=classroom-resources/autograding-grading-reporter@v1",
        "jobs.run-autograding-tests.steps.env.GONIO_RESULTS=\"${{ steps.gonio.outputs.result }}\"",
        "jobs.run-autograding-tests.steps.with.runners=gonio",
    ] {
        assert!(found.iter().any(|found| found == expected), "`{expected}` is not in {found:#?}");
    }
    assert!(!text.contains("secrets."), "students can read what a workflow can");
}

/// The fields of the question in a Moodle XML file, by Python's parser.
fn question(lab: &Lab) -> Value {
    let script = "import json, xml.etree.ElementTree as E\n\
        q = E.parse('package/upload/question.xml').getroot().find('question')\n\
        d = {e.tag: (e.findtext('text') if e.find('text') is not None else e.text) for e in q}\n\
        d['type'] = q.get('type')\n\
        d['files'] = {f.get('name'): f.text for f in q.iter('file')}\n\
        d['format'] = q.find('questiontext').get('format')\n\
        print(json.dumps(d))";
    json(&ran(command("python3", &["-c", script], &lab.path("")).output().unwrap(), 0))
}

#[test]
fn coderunner_gets_a_question_whose_template_judges() {
    let lab = packaged("coderunner");
    let question = question(&lab);
    for (field, value) in [
        ("type", "coderunner"),
        ("name", "Rim light"),
        ("format", "markdown"),
        ("defaultgrade", "10"),
        ("coderunnertype", "python3"),
        ("prototypetype", "0"),
        ("iscombinatortemplate", "1"),
        ("grader", "TemplateGrader"),
        ("sandbox", "jobesandbox"),
        ("hoisttemplateparams", "1"),
    ] {
        assert_eq!(question[field], value, "{field}");
    }
    let preload = question["answerpreload"].as_str().unwrap();
    assert!(preload.starts_with("// vertex shader\n#version") && preload.contains("\n// fragment shader\n#version"));
    assert_eq!(question["answer"], Value::Null, "the answer would be shown to students");
    let template = question["template"].as_str().unwrap();
    let zip = from_base64(question["files"]["course.zip"].as_str().unwrap());
    let both = |folder: &str| {
        format!(
            "// vertex shader\n{}\n// fragment shader\n{}",
            read(&lab, &format!("{folder}/mine.vert")),
            read(&lab, &format!("{folder}/mine.frag"))
        )
    };
    let fields = ["fraction", "prologuehtml", "testresults", "columnformats", "epiloguehtml", "instructorhtml"];
    for (name, answer, fraction, word) in [
        ("right", both("right"), 1.0, "correct"),
        ("wrong", both("wrong"), 0.7, "The rim depends on the light"),
        ("nothing", "I was \"\"\"ill\\ today".to_owned(), 0.0, "no shader in answer.glsl"),
    ] {
        let folder = lab.path(&format!("jobe-{name}"));
        std::fs::create_dir(&folder).unwrap();
        std::fs::write(folder.join("course.zip"), &zip).unwrap();
        // As CodeRunner's Twig extension escapes a text for Python.
        let escaped = |text: &str| text.replace('\\', "\\\\").replace('"', "\\\"");
        let program = template.replace("{{ STUDENT_ANSWER | e('py') }}", &escaped(&answer));
        let program = program.replace("{{ gonio | e('py') }}", env!("CARGO_BIN_EXE_gonio"));
        assert!(!program.contains("{{") && !program.contains("{%"), "{program}");
        std::fs::write(folder.join("prog.py"), program).unwrap();
        let printed = ran(command("python3", &["prog.py"], &folder).output().unwrap(), 0);
        let result = json(&printed);
        assert_eq!(result["fraction"], fraction, "{result}");
        assert!(result["prologuehtml"].as_str().unwrap().contains(word), "{result}");
        assert!(result.as_object().unwrap().keys().all(|key| fields.contains(&key.as_str())), "{result}");
    }
}

#[test]
fn moodle_gets_an_essay_to_which_files_are_attached() {
    let lab = packaged("moodle");
    let question = question(&lab);
    for (field, value) in [
        ("type", "essay"),
        ("name", "Rim light"),
        ("defaultgrade", "10"),
        ("responseformat", "noinline"),
        ("attachmentsrequired", "1"),
        ("format", "markdown"),
    ] {
        assert_eq!(question[field], value, "{field}");
    }
    let start = from_base64(question["files"]["start.frag"].as_str().unwrap());
    assert_eq!(start, lab.read("course/rim-light/start.frag"));
    assert!(question["questiontext"].as_str().unwrap().contains("(@@PLUGINFILE@@/start.frag)"));
    assert!(read(&lab, "package/README.md").contains("cannot run gonio"));
}
