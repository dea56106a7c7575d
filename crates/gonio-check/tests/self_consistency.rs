//! What holds of every light equation, tried with a program alone: each is broken once, and the right ones keep all.

#![allow(missing_docs, clippy::unwrap_used)]

mod submissions;

use gonio_check::submission::SourceFile;
use gonio_check::verdict::{Outcome, PropertyState, Verdict};
use gonio_check::{CheckOptions, ShaderChecker, ShaderExercise};
use gonio_gl::HeadlessContext;
use submissions::submissions;

const VERTEX: &str = "#version 330 core
in vec3 position;
in vec3 normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
out vec3 place;
out vec3 turned;
void main() {
    place = vec3(M * vec4(position, 1.0));
    turned = normalize(mat3(itM) * normal);
    gl_Position = P * V * M * vec4(position, 1.0);
}
";

/// Two lights; `{sum}` is what is made of them, `{normal}` of the normal.
const FRAGMENT: &str = "#version 330 core
struct Light { vec3 light_pos; float ambient_strength, diffuse_strength, specular_strength, constant, linear, quadratic; };
uniform Light lights[2];
uniform vec3 u_view_pos;
uniform vec3 materialColour;
uniform float shininess;
in vec3 place;
in vec3 turned;
out vec4 FragColor;
vec3 N;
float one(Light l) {
    vec3 L = normalize(l.light_pos - place);
    float d = length(l.light_pos - place);
    float att = 1.0 / (l.constant + l.linear * d + l.quadratic * d * d);
    vec3 V = normalize(u_view_pos - place);
    float diffuse = l.diffuse_strength * max(dot(N, L), 0.0);
    float specular = l.specular_strength * pow(max(dot(reflect(-L, N), V), 0.0), shininess);
    return l.ambient_strength + att * (diffuse + specular);
}
void main() {
    N = {normal};
    float a = one(lights[0]), b = one(lights[1]);
    FragColor = vec4({sum}, 1.0);
}
";

fn check(normal: &str, sum: &str) -> Verdict {
    let context = HeadlessContext::new().unwrap_or_else(|why| panic!("{why}"));
    let mut checker = ShaderChecker::new(context.gl());
    let fragment = FRAGMENT.replace("{normal}", normal).replace("{sum}", sum);
    let files = vec![SourceFile::new("a.vert", VERTEX), SourceFile::new("a.frag", fragment)];
    gonio_check::check(&mut checker, &ShaderExercise::new("ex07"), files, &CheckOptions::default()).unwrap().0
}

fn state(verdict: &Verdict, id: &str) -> PropertyState {
    verdict.properties.iter().find(|property| property.id == id).unwrap().state
}

const ALL: [&str; 5] =
    ["finite", "unchanged-when-turned", "linear-in-light", "additive-over-lights", "falls-with-distance"];

#[test]
fn what_is_right_keeps_all() {
    let verdict = check("normalize(turned)", "materialColour * (a + b)");
    assert_eq!(verdict.verdict, Outcome::Correct, "{}", verdict.summary);
    for id in ALL {
        assert_eq!(state(&verdict, id), PropertyState::Right, "{id}");
    }
}

#[test]
fn each_is_broken_by_what_breaks_it() {
    for (normal, sum, broken) in [
        ("normalize(turned)", "materialColour * sqrt(a + b - 10.0)", &["finite"][..]),
        ("normalize(turned + vec3(0.4, 0.0, 0.0))", "materialColour * (a + b)", &["unchanged-when-turned"]),
        (
            "normalize(turned)",
            "materialColour * sqrt(a + b)",
            &["linear-in-light", "additive-over-lights", "falls-with-distance"],
        ),
        ("normalize(turned)", "materialColour * max(a, b)", &["additive-over-lights"]),
        ("normalize(turned)", "materialColour * (a + b) / (1.0 + lights[0].constant)", &["falls-with-distance"]),
    ] {
        let verdict = check(normal, sum);
        assert_eq!(verdict.verdict, Outcome::Wrong, "{sum}");
        for id in broken {
            assert_eq!(state(&verdict, id), PropertyState::Wrong, "{normal} {sum}: {id}");
        }
        // Where nothing is a number, nothing else can be told.
        for id in ALL.iter().filter(|id| !broken.contains(id) && !broken.contains(&"finite")) {
            assert_eq!(state(&verdict, id), PropertyState::Right, "{normal} {sum}: {id}");
        }
    }
}

#[test]
fn what_nothing_explains_says_where_to_look() {
    let verdict = check("normalize(turned + vec3(0.4, 0.3, 0.0))", "materialColour * (a + b)");
    assert!(verdict.mistakes.is_empty(), "{}", verdict.summary);
    assert!(verdict.summary.contains("when model, light and camera are rotated"), "{}", verdict.summary);
}

#[test]
fn every_right_answer_keeps_what_can_be_tried() {
    let context = HeadlessContext::new().unwrap_or_else(|why| panic!("{why}"));
    let mut checker = ShaderChecker::new(context.gl());
    let exercises = ["ex03", "ex04", "ex05", "ex06", "ex07"];
    let mut tried = 0;
    for submission in submissions("correct").into_iter().filter(|s| exercises.contains(&s.exercise.as_str())) {
        for property in &submission.check(&mut checker).properties {
            assert_ne!(property.state, PropertyState::Wrong, "{}: {property:?}", submission.name);
            tried += usize::from(property.state == PropertyState::Right);
        }
    }
    assert!(tried > 150, "{tried}");
}
