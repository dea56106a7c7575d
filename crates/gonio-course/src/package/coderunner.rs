//! CodeRunner: a question of Moodle whose template runs on a Jobe server. The template is a combinator with a template grader: it writes
//! the answer to a file, runs `gonio lab check --code-runner`, and prints what that wrote. gonio and a software driver are installed on
//! the Jobe server; the sealed course comes with the question, as a support file.

use super::xml::{cdata, escaped, file, question_text};
use super::{Package, PackageRequest, PackagedFile};
use crate::course::START_FILES;
use gonio_language::Language;

/// The support file with the sealed course.
const COURSE_ZIP: &str = "course.zip";

pub(super) fn package(request: &PackageRequest<'_>) -> Package {
    let students = request.start_in("");
    let question = question(request, &students);
    Package { upload: vec![PackagedFile::text("question.xml", question)], students, readme: readme(request) }
}

fn question(request: &PackageRequest<'_>, students: &[PackagedFile]) -> String {
    let exercise = &request.of.exercise;
    let is_figure = |file: &&PackagedFile| [".svg", ".png", ".jpg", ".jpeg"].iter().any(|end| file.path.ends_with(end));
    let figures: Vec<(String, Vec<u8>)> =
        students.iter().filter(is_figure).map(|file| (file.path.clone(), file.bytes.clone())).collect();
    let [vertex, fragment] = START_FILES.map(|name| exercise.file(name).unwrap_or_default());
    // One box for both: gonio splits them at the headings.
    let preload = format!("// vertex shader\n{}\n\n// fragment shader\n{}\n", vertex.trim_end(), fragment.trim_end());
    let zip = (request.zip)(&request.course_in("course"));
    let empty = |name: &str| format!("<{name}></{name}>\n");
    let mut xml = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<quiz>\n<question type=\"coderunner\">\n<name>\n<text>{}</text>\n</name>\n",
        escaped(exercise.title_in(request.language))
    );
    xml += &question_text(exercise.text_in(request.language), &figures);
    xml += &format!(
        "<generalfeedback format=\"html\">\n<text></text>\n</generalfeedback>\n<defaultgrade>{}</defaultgrade>\n<penalty>0</penalty>\n\
         <hidden>0</hidden>\n<idnumber>{}</idnumber>\n",
        request.points(),
        escaped(request.id())
    );
    let template = template(request);
    let params = r#"{"gonio": "gonio"}"#;
    for (name, value) in [
        ("coderunnertype", "python3"),
        ("prototypetype", "0"),
        ("allornothing", "0"),
        ("penaltyregime", "0"),
        ("precheck", "0"),
        ("hidecheck", "0"),
        ("showsource", "0"),
        ("answerboxlines", "40"),
        ("answerboxcolumns", "100"),
        ("answerpreload", preload.as_str()),
        ("globalextra", ""),
        ("useace", "1"),
        ("resultcolumns", ""),
        ("template", template.as_str()),
        ("iscombinatortemplate", "1"),
        ("allowmultiplestdins", "0"),
        ("answer", ""),
        ("validateonsave", "0"),
        ("testsplitterre", ""),
        ("language", "python3"),
        ("acelang", "glsl"),
        ("sandbox", "jobesandbox"),
        ("grader", "TemplateGrader"),
        ("cputimelimitsecs", "60"),
        // A software driver reserves more addresses than it uses.
        ("memlimitmb", "0"),
        ("sandboxparams", r#"{"numprocs": 200}"#),
        ("templateparams", params),
        ("hoisttemplateparams", "1"),
        ("templateparamslang", "None"),
        ("templateparamsevalpertry", "0"),
        ("templateparamsevald", params),
        ("twigall", "0"),
        ("uiplugin", "ace"),
        ("attachments", "0"),
        ("attachmentsrequired", "0"),
        ("maxfilesize", "0"),
        ("displayfeedback", "1"),
        ("giveupallowed", "0"),
    ] {
        xml += &if value.is_empty() { empty(name) } else { format!("<{name}>{}</{name}>\n", cdata(value)) };
    }
    let text = |name: &str| format!("<{name}>\n<text></text>\n</{name}>\n");
    let parts = ["testcode", "stdin", "expected", "extra"].map(text).concat();
    xml += &format!(
        "<testcases>\n<testcase testtype=\"0\" useasexample=\"0\" hiderestiffail=\"0\" mark=\"1.0000000\">\n{parts}\
         <display>\n<text>SHOW</text>\n</display>\n</testcase>\n{}</testcases>\n</question>\n</quiz>\n",
        file(COURSE_ZIP, &zip)
    );
    xml
}

/// The template, in Python; Twig replaces what is in double braces before it runs.
fn template(request: &PackageRequest<'_>) -> String {
    let word = |text: &str| serde_json::to_string(text).unwrap_or_default();
    let failed = match request.language {
        Language::English => "gonio could not judge this answer. Please tell your teacher.",
        Language::French => "gonio n'a pas pu juger cette réponse. Prévenez votre enseignant.",
    };
    let options: String = request.options().split(' ').map(|option| format!(", {}", word(option))).collect();
    format!(
        r#"# Made by gonio {version}. Runs gonio on the answer, and prints the result of a combinator template grader.
import json, os, subprocess, zipfile

answer = """{{{{ STUDENT_ANSWER | e('py') }}}}"""
gonio = """{{{{ gonio | e('py') }}}}"""

def failed(reason):
    print(json.dumps(dict(fraction=0, prologuehtml="<p>" + {failed} + "</p>", epiloguehtml="", instructorhtml="<pre>" + reason + "</pre>")))

def text(reason):
    return reason.replace("&", "&amp;").replace("<", "&lt;")[-2000:]

try:
    zipfile.ZipFile({COURSE_ZIP:?}).extractall(".")
    os.makedirs("submission", exist_ok=True)
    with open("submission/answer.glsl", "w", encoding="utf-8") as file:
        file.write(answer)
    run = subprocess.run(
        [gonio, "lab", "check", {id}, "submission", "--course", "course"{options}, "--code-runner", "verdict.json"],
        stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=50)
    if os.path.exists("verdict.json"):
        with open("verdict.json", encoding="utf-8") as file:
            print(file.read())
    else:
        failed(text(run.stdout.decode("utf-8", "replace")))
except Exception as error:
    failed(text(repr(error)))
"#,
        version = request.version,
        failed = word(failed),
        id = word(request.id())
    )
}

fn readme(request: &PackageRequest<'_>) -> String {
    let id = request.id();
    format!(
        "# {id} in CodeRunner\n\n\
         1. On the Jobe server: install gonio where every user finds it (`/usr/local/bin/gonio`), and a software driver for OpenGL \
         (`apt-get install libegl1 libgl1-mesa-dri`). As a user of Jobe, `gonio lab list` has to work.\n\
         2. In Moodle: Question bank, Import, Moodle XML, `upload/question.xml`. If gonio is not in the path of Jobe's users, change \
         `gonio` in the question's template parameters to its full path.\n\
         3. Preview the question with a right and a wrong answer.\n\n\
         The answer box has both shaders, below the headings `// vertex shader` and `// fragment shader`. The question has no reference; \
         `course.zip`, a support file that students do not see, has pictures of it at most.\n"
    )
}
