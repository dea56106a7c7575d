//! Proposed fixes: edits that make every test scene right, in the student's style, for mistakes of each kind.
#![allow(clippy::unwrap_used)]

use gonio_check::cause::edit::edited;
use gonio_check::cause::found::Found;
use gonio_check::cause::{Diagnosis, NotJudged, diagnose};
use gonio_check::comparison::Task;
use gonio_check::compile::ParsedStage;
use gonio_check::dataflow::Shader;
use gonio_check::mistakes::{Hypotheses, ModelSolution};
use gonio_check::roles::NamesFile;
use gonio_check::source::Analysis;
use gonio_check::submission::{SourceFile, StageText};
use gonio_check::verdict::{Outcome, Verdict};
use gonio_check::{CheckOptions, ShaderChecker, ShaderExercise, check_without_fix, with_edits};
use gonio_gl::HeadlessContext;
use gonio_glsl::{OutputVersion, Stage};

const VERTEX: &str = "#version 330 core
in vec3 position;
in vec3 normal;
uniform mat4 M, V, P;
uniform mat4 itM;
out vec3 place;
out vec3 n;
void main() {
    vec4 world = M * vec4(position, 1.0f);
    place = world.xyz;
    n = mat3(itM) * normal;
    gl_Position = P * V * world;
}
";

const FRAGMENT: &str = "#version 330 core
in vec3 place;
in vec3 n;
uniform vec3 light_pos;
uniform vec3 u_view_pos;
uniform vec3 materialColour;
uniform float ambient_strength, diffuse_strength, specular_strength;
uniform float constant, linear, quadratic;
uniform float shininess;
out vec4 colour;
void main() {
    vec3 N = normalize(n);
    vec3 l = light_pos - place;
    vec3 L = normalize(l);
    vec3 E = normalize(u_view_pos - place);
    float d = length(l);
    float att = 1.0f / (constant + linear * d + quadratic * d * d);
    float cosine = max(dot(N, L), 0.0f);
    float shine = pow(max(dot(reflect(-L, N), E), 0.0f), shininess);
    float ambient = ambient_strength;
    float diffuse = diffuse_strength * cosine;
    float specular = specular_strength * shine;
    vec3 sum = (ambient + att * (diffuse + specular)) * materialColour;
    colour = vec4(sum, 1.0f);
}
";

fn diagnosed(exercise: &str, vertex: &str, fragment: &str) -> Result<Diagnosis, NotJudged> {
    let texts = [StageText::whole("a.vert", vertex), StageText::whole("a.frag", fragment)];
    let stages = [
        ParsedStage::new(&texts[0], Stage::Vertex, OutputVersion::Core330),
        ParsedStage::new(&texts[1], Stage::Fragment, OutputVersion::Core330),
    ];
    let names = NamesFile::default();
    let [v, f] = stages.each_ref().map(|stage| Shader { parsed: &stage.parsed, checked: &stage.checked });
    let constants = Analysis::new(&v, &f, &names).constants();
    let [v, f] = stages.each_ref().map(|stage| (&stage.parsed, &stage.checked));
    diagnose(
        Task::find(exercise).unwrap(),
        [v, f],
        [vertex, fragment],
        &names,
        &constants,
        &std::rc::Rc::default(),
        gonio_check::cause::DiagnosisDepth::Causes,
    )
}

/// The lines that the first fix writes, of both stages.
fn new_lines(exercise: &str, vertex: &str, fragment: &str) -> Vec<String> {
    let diagnosis = diagnosed(exercise, vertex, fragment).unwrap();
    let Some(fix) = diagnosis.fixes.first() else { return Vec::new() };
    let mut new = Vec::new();
    for (stage, text) in [(Stage::Vertex, vertex), (Stage::Fragment, fragment)] {
        let after = edited(text, stage, fix).unwrap();
        let old: Vec<&str> = text.lines().collect();
        new.extend(after.lines().filter(|line| !old.contains(line)).map(|line| line.trim().to_owned()));
    }
    new
}

#[test]
fn the_programs_without_a_mistake_need_no_fix() {
    let diagnosis = diagnosed("ex07", VERTEX, FRAGMENT).unwrap();
    assert!(matches!(diagnosis.found, Found::Right(_)), "{:?}", diagnosis.found);
    assert!(diagnosis.fixes.is_empty());
}

/// What is right, what a student wrote instead, and the line of the fix.
const KINDS: [(&str, &str, &str, &str); 12] = [
    ("sign of a difference", "l = light_pos - place", "l = place - light_pos", "vec3 l = light_pos - place;"),
    ("superfluous sign", "reflect(-L, N)", "-reflect(-L, N)", "reflect(-L, N)"),
    ("length", "L = normalize(l)", "L = l", "vec3 L = normalize(l);"),
    ("clamp", "cosine = max(dot(N, L), 0.0f)", "cosine = dot(N, L)", ", 0.0f)"),
    (
        "own variable",
        "pow(max(dot(reflect(-L, N), E)",
        "pow(max(dot(reflect(-L, N), N)",
        "max(dot(reflect(-L, N), E), 0.0f)",
    ),
    ("formula", "d = length(l)", "d = length(light_pos)", "float d = length(l);"),
    ("missing factor", "specular = specular_strength * shine", "specular = shine", "specular_strength"),
    ("superfluous factor", "ambient = ambient_strength", "ambient = att * ambient_strength", "ambient_strength"),
    ("missing summand", "quadratic * d * d)", "quadratic * d)", "quadratic * d * d)"),
    ("interpolated normal", "N = normalize(n)", "N = n", "vec3 N = normalize(n);"),
    (
        "reciprocal",
        "att = 1.0f / (constant + linear * d + quadratic * d * d)",
        "att = 1.0f + 0.14f * d + 0.07f * d * d",
        "float att = 1.0f / (1.0f + 0.14f * d + 0.07f * d * d);",
    ),
    ("gamma", "vec4(sum, 1.0f)", "vec4(pow(sum, vec3(1.0f / 2.2f)), 1.0f)", "colour = vec4(sum, 1.0f);"),
];

#[test]
fn each_kind_of_mistake_gets_an_edit_in_the_students_style() {
    let mut missed = Vec::new();
    for (kind, right, wrong, expected) in KINDS {
        assert!(FRAGMENT.contains(right), "{kind}");
        let lines = new_lines("ex07", VERTEX, &FRAGMENT.replace(right, wrong));
        if lines.len() != 1 || !lines[0].contains(expected) {
            missed.push((kind, lines));
        }
    }
    assert!(missed.is_empty(), "{missed:#?}");
}

#[test]
fn a_fix_reads_the_elements_of_arrays_with_the_index_of_its_place() {
    let (head, body) = FRAGMENT.split_once("    vec3 l = ").unwrap();
    let mut head = head.to_owned();
    for name in
        ["light_pos", "ambient_strength", "diffuse_strength", "specular_strength", "constant", "linear", "quadratic"]
    {
        head = head.replacen(&format!("{name};"), &format!("{name}[2];"), 1).replacen(
            &format!("{name},"),
            &format!("{name}[2],"),
            1,
        );
    }
    let mut body = format!("vec3 all = vec3(0.0f);\nfor (int i = 0; i < 2; i++) {{\n    vec3 l = {body}");
    for name in
        ["light_pos", "ambient_strength", "diffuse_strength", "specular_strength", "constant", "linear", "quadratic"]
    {
        body = body.replacen(name, &format!("{name}[i]"), 1);
    }
    let lights = format!("{head}{body}")
        .replace("    colour = vec4(sum, 1.0f);", "    all += sum;\n}\ncolour = vec4(all, 1.0f);");
    assert!(matches!(diagnosed("ex07", VERTEX, &lights).unwrap().found, Found::Right(_)), "{lights}");
    let right = "1.0f / (constant[i] + linear[i] * d + quadratic[i] * d * d)";
    assert!(lights.contains(right), "{lights}");
    let lines = new_lines("ex07", VERTEX, &lights.replace(right, "1.0f / d"));
    assert_eq!(lines, [format!("float att = {right};")]);
}

#[test]
fn a_mirror_gets_the_direction_to_the_eye() {
    let fragment = "#version 330 core
in vec3 place;
in vec3 n;
uniform vec3 u_view_pos;
uniform samplerCube cubemapSampler;
out vec4 colour;
void main() {
    vec3 N = normalize(n);
    vec3 E = normalize(u_view_pos);
    vec3 R = 2.0f * dot(N, E) * N - E;
    colour = vec4(texture(cubemapSampler, R).rgb, 1.0f);
}
";
    assert_eq!(new_lines("ex09", VERTEX, fragment), ["vec3 E = normalize(u_view_pos - place);"]);
}

#[test]
fn a_uniform_that_a_fix_needs_is_declared() {
    let vertex = VERTEX.replace("uniform mat4 itM;\n", "").replace("mat3(itM)", "mat3(M)").replace("330 core", "130");
    let lines = new_lines("ex07", &vertex, FRAGMENT);
    assert_eq!(lines, ["uniform mat4 itM;", "n = mat3(itM) * normal;"]);
}

#[test]
fn what_the_vertex_shader_must_hand_on_first_is_not_proposed() {
    // The fragment shader has neither the position nor anything computed from it.
    let fragment = FRAGMENT.replace("in vec3 place;\n", "").replace("- place", "- n");
    let vertex = VERTEX.replace("out vec3 place;\n", "vec3 place;\n");
    assert!(diagnosed("ex07", &vertex, &fragment).unwrap().fixes.is_empty());
}

/// The catalogue's mistakes in a model, each alone.
fn catalogue(model: ModelSolution) -> Vec<(String, [String; 2])> {
    let all = Hypotheses::for_model(model);
    let is_mistake = |index: &usize| !all.mistakes[*index].harmless;
    let singles = all.singles.iter().filter(|single| single.mistakes.iter().all(is_mistake));
    singles.map(|single| (all.mistakes[single.mistakes[0]].id.clone(), all.written(single))).collect()
}

#[test]
fn mistakes_of_the_catalogue_get_fixes() {
    let (mut fixed, mut all, mut missed) = (0, 0, Vec::new());
    let models = [ModelSolution::Phong, ModelSolution::Gouraud, ModelSolution::Ward];
    for (exercise, model) in ["ex07", "ex05", "ex12"].into_iter().zip(models) {
        for (id, [vertex, fragment]) in catalogue(model).into_iter().step_by(6) {
            let Ok(diagnosis) = diagnosed(exercise, &vertex, &fragment) else { continue };
            if !matches!(diagnosis.found, Found::Causes(_)) {
                continue;
            }
            all += 1;
            match diagnosis.fixes.is_empty() {
                true => missed.push(id),
                false => fixed += 1,
            }
        }
    }
    // Four of five: the rest needs a quantity that the model solutions compute nowhere.
    assert!(all > 12 && fixed * 100 >= all * 80, "{fixed} of {all}, not {missed:?}");
}

#[test]
fn a_verdict_proposes_a_fix_that_the_driver_draws_right() {
    let context = HeadlessContext::new().unwrap();
    let mut checker = ShaderChecker::new(context.gl());
    let exercise = ShaderExercise::new("ex07");
    let wrong = FRAGMENT.replace("max(dot(N, L), 0.0f)", "dot(N, L)");
    let program = format!("const char* v = R\"({VERTEX})\";\r\nconst char* f = R\"({wrong})\";\r\n");
    let files = vec![SourceFile::new("main.cpp", program)];
    let mut check = |files: Vec<SourceFile>| {
        gonio_check::check(&mut checker, &exercise, files, &CheckOptions::default()).unwrap().0
    };
    let verdict = check(files.clone());
    assert_eq!(verdict.verdict, Outcome::Wrong, "{verdict:?}");
    let [edit] = verdict.proposed_fix.as_slice() else { panic!("{verdict:?}") };
    assert_eq!(edit.file, "main.cpp");
    assert!(edit.before.contains("cosine") && !edit.before.contains("max("), "{edit:?}");
    assert!(edit.after.contains("max(") && edit.after.contains(", 0.0f)"), "{edit:?}");
    let fixed = check(with_edits(&files, &verdict.proposed_fix).unwrap());
    assert_eq!(fixed.verdict, Outcome::Correct, "{fixed:?}");
    assert!(fixed.proposed_fix.is_empty());
    let without = check_without_fix(&mut checker, &exercise, files, &CheckOptions::default()).unwrap().0;
    assert_eq!(without, Verdict { proposed_fix: Vec::new(), ..verdict });
}
