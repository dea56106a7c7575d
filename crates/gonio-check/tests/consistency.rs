//! Verdicts are consistent: terms, scenes, mistakes and the summary never contradict one another, and the properties that
//! every light equation has are violated exactly by programs that violate them. `corpus.rs` tests both of the submissions that
//! it checks.
#![allow(clippy::unwrap_used)]

mod contradictions;

use contradictions::contradictions;
use gonio_check::comparison::TASKS;
use gonio_check::mistakes::Hypotheses;
use gonio_check::submission::SourceFile;
use gonio_check::verdict::{Outcome, PropertyState, TermState, Verdict};
use gonio_check::{CheckOptions, ShaderChecker, ShaderExercise};
use gonio_gl::HeadlessContext;

#[test]
fn no_mistake_of_the_catalogue_contradicts_the_terms() {
    let context = HeadlessContext::new().unwrap_or_else(|error| panic!("{error}"));
    let mut checker = ShaderChecker::new(context.gl());
    let (mut checked, mut separable, mut named) = (0, 0, 0);
    let mut wrong = Vec::new();
    for task in TASKS.iter().filter(|task| task.model.is_lit()) {
        let hypotheses = Hypotheses::for_model(task.model);
        let mut seen = std::collections::BTreeSet::new();
        for single in hypotheses.singles.iter().filter(|single| seen.insert(single.mistakes.clone())) {
            let [vertex, fragment] = hypotheses.written(single);
            let files = vec![SourceFile::new("a.vert", vertex), SourceFile::new("a.frag", fragment)];
            let exercise = ShaderExercise::new(task.exercise);
            let (verdict, _) = gonio_check::check(&mut checker, &exercise, files, &CheckOptions::default()).unwrap();
            checked += 1;
            separable += usize::from(verdict.terms.iter().any(|term| term.state != TermState::NotSeparable));
            named += usize::from(!verdict.mistakes.is_empty());
            let id = &hypotheses.mistakes[single.mistakes[0]].id;
            wrong.extend(
                contradictions(&verdict)
                    .into_iter()
                    .map(|contradiction| format!("{} {id}: {contradiction}", task.exercise)),
            );
        }
    }
    assert!(checked > 300 && separable > 200 && named > 200, "{checked} {separable} {named}");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

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

/// Two lights; `{sum}` is the expression of the sum, `{normal}` that of the normal.
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
    let context = HeadlessContext::new().unwrap_or_else(|error| panic!("{error}"));
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
fn right_programs_have_all_properties() {
    let verdict = check("normalize(turned)", "materialColour * (a + b)");
    assert_eq!(verdict.verdict, Outcome::Correct, "{}", verdict.summary);
    for id in ALL {
        assert_eq!(state(&verdict, id), PropertyState::Right, "{id}");
    }
}

#[test]
fn each_property_is_violated_by_its_mistakes() {
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
        // If all pixels are NaN, no other property can be tested.
        for id in ALL.iter().filter(|id| !broken.contains(id) && !broken.contains(&"finite")) {
            assert_eq!(state(&verdict, id), PropertyState::Right, "{normal} {sum}: {id}");
        }
    }
}

#[test]
fn unexplained_verdicts_report_violated_properties() {
    // No value brings discarded places back.
    let verdict = check("normalize(turned); if (turned.x > 0.3) discard", "materialColour * (a + b)");
    assert!(verdict.mistakes.is_empty(), "{}", verdict.summary);
    assert!(verdict.summary.contains("when model, light and camera are rotated"), "{}", verdict.summary);
}
