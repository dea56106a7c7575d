//! Causes found by the values of programs, without a driver: on the corpus of submissions and on programs in no list.
//!
//! Tolerances: the corpus has 86 % named and 80 % of their lines by values alone now; the
//! verdict adds what the rules about the source know.
#![allow(clippy::unwrap_used)]

mod submissions;

use gonio_check::cause::found::Found;
use gonio_check::cause::proven_cause::ProvenCause;
use gonio_check::cause::{Diagnosis, NotJudged, diagnose};
use gonio_check::comparison::Task;
use gonio_check::compile::ParsedStage;
use gonio_check::dataflow::Shader;
use gonio_check::mistakes::{Hypotheses, ModelSolution};
use gonio_check::roles::{NamesFile, Role};
use gonio_check::source::Analysis;
use gonio_check::submission::{StageText, Submission};
use gonio_glsl::{OutputVersion, Stage};

/// Diagnoses a pair as the checker does.
fn diagnosed(
    exercise: &str,
    [vertex, fragment]: [&StageText; 2],
    mut names: NamesFile,
) -> Result<Diagnosis, NotJudged> {
    let task = Task::find(exercise).unwrap();
    let stages = [
        ParsedStage::new(vertex, Stage::Vertex, OutputVersion::Core330),
        ParsedStage::new(fragment, Stage::Fragment, OutputVersion::Core330),
    ];
    let shaders = stages.each_ref().map(|stage| Shader { parsed: &stage.parsed, checked: &stage.checked });
    let constants = Analysis::with_roles_by_use(&shaders[0], &shaders[1], &mut names).constants();
    let [v, f] = stages.each_ref().map(|stage| (&stage.parsed, &stage.checked));
    diagnose(
        task,
        [v, f],
        [&vertex.text, &fragment.text],
        &names,
        &constants,
        &std::rc::Rc::default(),
        gonio_check::cause::DiagnosisDepth::Causes,
    )
}

/// A submission of the corpus with its diagnosis, if it is one that values judge.
fn diagnosed_case(case: &submissions::Submission) -> Option<(Submission, Diagnosis)> {
    let found = Submission::gather(case.files.clone()).ok()?;
    let names = found.names.as_deref().map_or_else(NamesFile::default, |text| NamesFile::parse(text).unwrap());
    let diagnosis = diagnosed(&case.exercise, [&found.vertex, &found.fragment], names).ok()?;
    Some((found, diagnosis))
}

fn is_judged(case: &submissions::Submission) -> bool {
    !["ex01", "s1"].contains(&case.exercise.as_str()) && case.expected.get("verdict").is_none()
}

fn words(case: &submissions::Submission, key: &str) -> Vec<String> {
    let list = case.expected.get(key).and_then(toml::Value::as_array).into_iter().flatten();
    list.map(|word| word.as_str().unwrap().to_owned()).collect()
}

/// Right answers that mix the cubemap with other colours, or assume another program around them.
const BEYOND_VALUES: [&str; 5] = [
    "ex08/correct/fog-at-the-horizon",
    "ex09/correct/mixed-with-a-colour",
    "ex09/correct/over-a-texture",
    "ex10/correct/cosine-held",
    "ex10/correct/glass-with-fresnel",
];

#[test]
fn right_submissions_are_right_by_their_values() {
    let (mut right, mut wrong) = (0, Vec::new());
    for case in submissions::submissions("correct").iter().filter(|case| is_judged(case)) {
        let Some((_, diagnosis)) = diagnosed_case(case) else { continue };
        match diagnosis.found {
            Found::Right(_) => right += 1,
            _ => wrong.push(case.name.clone()),
        }
    }
    wrong.retain(|name| !BEYOND_VALUES.contains(&name.as_str()));
    assert!(wrong.is_empty() && right > 150, "{right} right, not {wrong:?}");
}

/// Whether the first cause of each group is named as expected.
fn is_named(groups: &[Vec<ProvenCause>], expected: &[String], also: &[String]) -> bool {
    let firsts: Vec<&ProvenCause> = groups.iter().filter_map(|group| group.first()).collect();
    let count = firsts.len() + firsts.iter().filter(|cause| cause.with.is_some()).count();
    let is_it = |cause: &&ProvenCause| {
        let is_unlisted = cause.mistakes.is_empty() && expected.iter().any(|id| id == gonio_check::WRONG_VALUE);
        is_unlisted
            || cause.mistakes.iter().take(1 + cause.equals).any(|m| expected.contains(&m.id) || also.contains(&m.id))
    };
    count == expected.len() && firsts.iter().all(is_it)
}

#[test]
fn mistakes_are_named_at_their_lines_by_their_values() {
    let (mut named, mut all, mut placed, mut with_line) = (0, 0, 0, 0);
    let mut missed = Vec::new();
    // A third of the corpus: a search takes a tenth of a second, and a second at worst.
    let cases = submissions::submissions("wrong").into_iter().filter(is_judged).step_by(3);
    for case in cases {
        let Some((submission, diagnosis)) = diagnosed_case(&case) else { continue };
        all += 1;
        let Found::Causes(groups) = &diagnosis.found else {
            missed.push(case.name);
            continue;
        };
        if !is_named(groups, &words(&case, "mistakes"), &words(&case, "also_right")) {
            missed.push(case.name);
            continue;
        }
        named += 1;
        if let (Some(line), [group]) = (case.expected.get("line").and_then(toml::Value::as_integer), groups.as_slice())
        {
            let cause = &group[0];
            let text = if cause.stage == Stage::Vertex { &submission.vertex } else { &submission.fragment };
            with_line += 1;
            placed += usize::from(i64::from(text.place(cause.span.line, cause.span.column).1) == line);
        }
    }
    assert!(all > 95 && named * 100 >= all * 83, "{named} of {all}, not {missed:?}");
    assert!(with_line > 60 && placed * 100 >= with_line * 78, "{placed} of {with_line}");
}

const VERTEX: &str = "#version 330 core
in vec3 in0; in vec3 in1;
uniform mat4 un1, un2, un3; uniform mat3 un4;
out vec3 p; out vec3 n;
void main() {
    vec4 place = un1 * vec4(in0, 1.0);
    p = place.xyz;
    n = un4 * in1;
    gl_Position = un3 * un2 * place;
}
";

fn fragment(to_eye: &str) -> String {
    format!(
        "#version 330 core
in vec3 p; in vec3 n;
uniform vec3 un5, un6; uniform float un7;
out vec4 c;
void main() {{
    vec3 a = normalize(n);
    vec3 b = normalize(un5 - p);
    vec3 e = normalize({to_eye});
    float s = pow(max(dot(reflect(-b, a), e), 0.0), un7);
    c = vec4(vec3(s), 1.0);
}}
"
    )
}

fn of_texts(vertex: &str, fragment: &str) -> Diagnosis {
    of_exercise("ex06", vertex, fragment)
}

fn of_exercise(exercise: &str, vertex: &str, fragment: &str) -> Diagnosis {
    let texts = [StageText::whole("a.vert", vertex.to_owned()), StageText::whole("a.frag", fragment.to_owned())];
    diagnosed(exercise, [&texts[0], &texts[1]], NamesFile::default()).unwrap()
}

/// The mistakes of the first explanation, in alphabetical order.
fn explained(diagnosis: &Diagnosis) -> Vec<&'static str> {
    let first = diagnosis.explanations.first().unwrap_or_else(|| panic!("{diagnosis:?}"));
    let mut ids: Vec<&str> = first.mistakes.iter().map(|mistake| mistake.id.as_str()).collect();
    ids.sort_unstable();
    ids
}

#[test]
fn two_mistakes_are_named_by_what_they_compute_together() {
    let all = Hypotheses::for_model(ModelSolution::Phong);
    let single = |id: &str| {
        all.singles.iter().find(|single| all.mistakes[single.mistakes[0]].id == id).unwrap_or_else(|| panic!("{id}"))
    };
    for pair in [
        ["attenuation-missing", "normal-by-model-matrix"],
        ["diffuse-floor", "specular-without-power"],
        ["ambient-attenuated", "light-direction-reversed"],
    ] {
        let [vertex, fragment] = all.written(&single(pair[0]).and(single(pair[1])).unwrap());
        assert_eq!(explained(&of_exercise("ex07", &vertex, &fragment)), pair);
    }
}

const IN_VIEW_SPACE: &str = "#version 330 core
in vec3 position; in vec3 normal;
uniform mat4 M, V, P, itM;
out vec3 n; out vec3 p;
void main() {
    gl_Position = P * V * M * vec4(position, 1.0);
    n = normalize(mat3(V) * (mat3(itM) * normal));
    p = PLACE;
}
";

const IN_WORLD_SPACE: &str = "#version 330 core
in vec3 position; in vec3 normal;
uniform mat4 M, V, P, itM;
out vec3 n; out vec3 p;
void main() {
    gl_Position = P * V * M * vec4(position, 1.0);
    n = normalize(mat3(itM) * normal);
    p = vec3(M * vec4(position, 1.0));
}
";

const LIT_IN_VIEW_SPACE: &str = "#version 330 core
in vec3 n; in vec3 p;
uniform vec3 light_pos; uniform mat4 V;
out vec4 c;
void main() {
    vec3 toLight = (V * vec4(light_pos, 1.0)).xyz - p;
    c = vec4(vec3(max(dot(normalize(n), normalize(toLight)), 0.0)), 1.0);
}
";

#[test]
fn the_space_of_the_light_is_a_convention_and_mistakes_in_it_are_named() {
    let right = IN_VIEW_SPACE.replace("PLACE", "(V * M * vec4(position, 1.0)).xyz");
    assert!(matches!(of_exercise("ex04", &right, LIT_IN_VIEW_SPACE).found, Found::Right(_)));
    // In world space, the same mistake has other colours.
    let wrong = IN_VIEW_SPACE.replace("PLACE", "(P * V * M * vec4(position, 1.0)).xyz");
    assert_eq!(explained(&of_exercise("ex04", &wrong, LIT_IN_VIEW_SPACE)), ["position-in-clip-space"]);
}

/// The line of the first cause of each group, in order.
fn lines(diagnosis: &Diagnosis) -> Vec<u32> {
    let Found::Causes(groups) = &diagnosis.found else { panic!("{diagnosis:?}") };
    let mut lines: Vec<u32> = groups.iter().map(|group| group[0].span.line).collect();
    lines.sort_unstable();
    lines
}

#[test]
fn causes_in_view_space_have_their_lines() {
    let wrong = IN_VIEW_SPACE.replace("PLACE", "(P * V * M * vec4(position, 1.0)).xyz");
    assert_eq!(lines(&of_exercise("ex04", &wrong, LIT_IN_VIEW_SPACE)), [8]);
}

#[test]
fn the_program_may_send_light_and_normal_matrix_in_view_space() {
    let vertex = "#version 330 core
in vec3 position; in vec3 normal;
uniform mat4 M, V, P; uniform mat3 MATRIX;
out vec3 n; out vec3 p;
void main() {
    gl_Position = P * V * M * vec4(position, 1.0);
    n = MATRIX * normal;
    p = vec3(V * M * vec4(position, 1.0));
}
";
    let fragment = LIT_IN_VIEW_SPACE.replace("(V * vec4(light_pos, 1.0)).xyz", "light_pos");
    let sent = of_exercise("ex04", &vertex.replace("MATRIX", "normalMatrix"), &fragment);
    assert!(matches!(sent.found, Found::Right(_)), "{sent:?}");
    // names.toml leaves nothing open.
    let texts = [("a.vert", vertex.replace("MATRIX", "normalMatrix")), ("a.frag", fragment.clone())]
        .map(|(name, text)| StageText::whole(name, text));
    for (light, normals) in [("light-pos", "normal-matrix"), ("light-pos-in-view", "normal-matrix-of-model-view")] {
        let names = format!("[names]\nlight_pos = \"{light}\"\nnormalMatrix = \"{normals}\"\n");
        let stated = diagnosed("ex04", [&texts[0], &texts[1]], NamesFile::parse(&names).unwrap()).unwrap();
        assert_eq!(matches!(stated.found, Found::Right(_)), light == "light-pos-in-view", "{stated:?}");
    }
    // The name of this one tells that it is in world space.
    let world = of_exercise("ex04", &vertex.replace("MATRIX", "itM"), &fragment);
    assert!(!matches!(world.found, Found::Right(_)), "{world:?}");
}

#[test]
fn a_mistake_of_both_stages_has_the_line_where_it_is_used() {
    let vertex = IN_VIEW_SPACE
        .replace("normalize(mat3(V) * (mat3(itM) * normal))", "mat3(itM) * normal")
        .replace("PLACE", "vec3(M * vec4(position, 1.0))");
    let fragment =
        LIT_IN_VIEW_SPACE.replace("(V * vec4(light_pos, 1.0)).xyz", "light_pos").replace("normalize(n)", "n");
    let diagnosis = of_exercise("ex04", &vertex, &fragment);
    assert_eq!((explained(&diagnosis), lines(&diagnosis)), (vec!["normal-not-renormalised"], vec![7]));
}

#[test]
fn causes_beside_a_second_light_have_their_lines() {
    let fragment = "#version 330 core
in vec3 n; in vec3 p;
struct Light { vec3 light_pos; float ambient_strength, diffuse_strength, specular_strength, constant, linear, quadratic; };
uniform Light lights[2];
uniform vec3 materialColour, u_view_pos; uniform float shininess;
out vec4 c;
void main() {
    vec3 a = normalize(n); vec3 sum = vec3(0.0);
    for (int i = 0; i < 2; i++) {
        vec3 l = normalize(lights[i].light_pos - p);
        vec3 r = reflect(-l, a);
        float d = length(lights[i].light_pos - p);
        float f = 1.0 / (lights[i].constant + lights[i].linear * d);
        float s = pow(max(dot(r, normalize(u_view_pos - p)), 0.0), shininess);
        sum += lights[i].ambient_strength
            + f * (lights[i].diffuse_strength * max(dot(a, l), 0.0) + lights[i].specular_strength * s);
    }
    c = vec4(sum * materialColour, 1.0);
}
";
    let vertex = IN_VIEW_SPACE.replace("mat3(V) * ", "").replace("PLACE", "vec3(M * vec4(position, 1.0))");
    let diagnosis = of_exercise("ex07", &vertex, fragment);
    assert_eq!((explained(&diagnosis), lines(&diagnosis)), (vec!["attenuation-without-quadratic"], vec![13]));
}

#[test]
fn strengths_that_the_program_fixes_hide_no_mistake() {
    let wrong = IN_VIEW_SPACE.replace("PLACE", "(V * M * vec4(position, 1.0)).xyz");
    let floor =
        LIT_IN_VIEW_SPACE.replace("vec3(max(", "vec3(0.15) + vec3(0.7 * max(").replace("0.0)), 1.0)", "0.3)), 1.0)");
    assert_eq!(explained(&of_exercise("ex04", &wrong, &floor)), ["diffuse-floor"]);
}

#[test]
fn names_without_meaning_get_the_roles_that_their_values_show() {
    let diagnosis = of_texts(VERTEX, &fragment("un6 - p"));
    assert!(matches!(diagnosis.found, Found::Right(_)), "{:?}", diagnosis.found);
    let role = |name: &str| diagnosis.bindings.bound.iter().find(|bound| bound.declared.name == name).unwrap().role;
    let expected = [
        ("un1", Role::Model),
        ("un2", Role::View),
        ("un3", Role::Projection),
        ("un4", Role::NormalMatrix),
        ("un7", Role::Shininess),
    ];
    for (name, expected) in expected {
        assert_eq!(role(name), expected, "{name}");
    }
    // A highlight is the same if light and eye change places.
    let mut both = [role("un5"), role("un6")].map(|role| role.to_string());
    both.sort();
    assert_eq!(both, ["light-pos", "view-pos"]);
}

#[test]
fn a_mistake_in_no_list_gets_its_line_and_the_right_quantity() {
    let diagnosis = of_texts(VERTEX, &fragment("un6 - 2.0 * p"));
    let Found::Causes(groups) = &diagnosis.found else { panic!("{:?}", diagnosis.found) };
    let cause = &groups[0][0];
    assert_eq!((groups.len(), cause.span.line, cause.stage), (1, 8, Stage::Fragment), "{cause:?}");
    assert!(cause.text == "2.0 * p" && cause.should.contains("the position"), "{cause:?}");
}

#[test]
fn a_sky_with_a_depth_of_its_own_is_right_and_marked() {
    let fragment = "#version 330 core\nin vec3 d; uniform samplerCube cubemapSampler; out vec4 c;\n\
                    void main() { c = texture(cubemapSampler, d); }\n";
    for (place, expected) in [("clip.xyww", false), ("clip", true), ("vec4(clip.xy, 0.0, clip.w)", true)] {
        let vertex = format!(
            "#version 330 core\nin vec3 position; uniform mat4 V, P; out vec3 d;\n\
             void main() {{ d = position; vec4 clip = P * mat4(mat3(V)) * vec4(position, 1.0); gl_Position = {place}; }}\n"
        );
        let diagnosis = of_exercise("ex08", &vertex, fragment);
        assert!(matches!(diagnosis.found, Found::Right(_)), "{:?}", diagnosis.found);
        assert_eq!(diagnosis.has_own_depth, expected, "{place}");
    }
}

/// What is right in the corpus's first answer to exercise 12, and what is in no list.
const BESIDE_WARD: [(&str, &str); 5] = [
    ("sqrt(NL * NV)", "sqrt(NL * NV * NV)"),
    ("exp(-tan2 / a2)", "exp2(-tan2 / a2)"),
    ("4.0 * PI * a2", "4.0 * PI * (a2 + 0.1)"),
    ("normalize(L + V)", "normalize(L + 2.0 * V)"),
    ("dot(N, H)", "dot(N, H) * dot(N, H)"),
];

#[test]
fn mistakes_with_wards_model_in_no_list_get_their_lines() {
    let all = submissions::submissions("correct");
    let case = all.iter().find(|case| case.name == "ex12/correct/one-function").unwrap();
    let right = Submission::gather(case.files.clone()).unwrap();
    let [vertex, fragment] = [right.vertex.text, right.fragment.text];
    let mut missed = Vec::new();
    for (is, becomes) in BESIDE_WARD {
        let line = 1 + fragment[..fragment.find(is).unwrap()].matches('\n').count() as u32;
        let diagnosis = of_exercise("ex12", &vertex, &fragment.replacen(is, becomes, 1));
        let found = if let Found::Causes(_) = diagnosis.found { lines(&diagnosis) } else { Vec::new() };
        if !diagnosis.explanations.is_empty() || found != [line] {
            missed.push((becomes, diagnosis.explanations.len(), found, line));
        }
    }
    assert!(missed.is_empty(), "{missed:?}");
}

/// A right highlight of exercise 06, below [`IN_WORLD_SPACE`].
const HIGHLIGHT: &str = "#version 330 core
in vec3 n; in vec3 p;
uniform vec3 light_pos, u_view_pos; uniform float shininess;
out vec4 c;
void main() {
    vec3 a = normalize(n);
    vec3 l = normalize(light_pos - p);
    vec3 r = reflect(-l, a);
    float s = pow(max(dot(r, normalize(u_view_pos - p)), 0.0), shininess);
    c = vec4(vec3(s), 1.0);
}
";

#[test]
fn two_mistakes_have_their_lines_if_one_or_both_are_in_no_list() {
    let fragment = HIGHLIGHT;
    assert!(matches!(of_exercise("ex06", IN_WORLD_SPACE, fragment).found, Found::Right(_)));
    let by_model = IN_WORLD_SPACE.replace("mat3(itM)", "mat3(M)");
    let to_light = fragment.replace("light_pos - p", "light_pos - u_view_pos");
    assert_eq!(lines(&of_exercise("ex06", &by_model, &to_light)), [7, 7]);
    let swapped = fragment.replace("light_pos - p", "light_pos + p").replace("reflect(-l, a)", "reflect(a, -l)");
    assert_eq!(lines(&of_exercise("ex06", IN_WORLD_SPACE, &swapped)), [7, 8]);
}

/// A row vector times the matrices: the positions are wrong and the colours are not.
#[test]
fn a_wrong_position_on_the_screen_in_no_list_has_its_line_alone_and_beside_a_wrong_colour() {
    let by_rows = IN_WORLD_SPACE.replace("P * V * M * vec4(position, 1.0);", "vec4(position, 1.0) * P * V * M;");
    let lit = LIT_IN_VIEW_SPACE.replace("(V * vec4(light_pos, 1.0)).xyz", "light_pos");
    assert_eq!(lines(&of_exercise("ex04", &by_rows, &lit)), [6]);
    let sine = lit
        .replace("max(dot(normalize(n), normalize(toLight)), 0.0)", "length(cross(normalize(n), normalize(toLight)))");
    let both = of_exercise("ex04", &by_rows, &sine);
    assert_eq!((lines(&both), both.explanations.len()), (vec![6, 7], 0));
}

/// The steps of the formula are right values, so that its sum is where it goes wrong.
#[test]
fn a_wrong_sign_in_the_formula_of_the_reflected_direction_is_one_mistake() {
    let by_formula = |formula: &str| HIGHLIGHT.replace("reflect(-l, a)", formula);
    let right = of_exercise("ex06", IN_WORLD_SPACE, &by_formula("2.0 * dot(a, l) * a - l"));
    assert!(matches!(right.found, Found::Right(_)), "{right:?}");
    let diagnosis = of_exercise("ex06", IN_WORLD_SPACE, &by_formula("2.0 * dot(a, l) * a + l"));
    assert_eq!(lines(&diagnosis), [8]);
    let Found::Causes(groups) = &diagnosis.found else { panic!("{diagnosis:?}") };
    assert_eq!(groups[0][0].should, "should be the direction of the reflected or refracted light");
}

/// In the first scene of a sky, the camera stands at the origin and looks ahead: V is the identity.
#[test]
fn v_and_p_of_a_sky_are_told_apart_whatever_their_names() {
    let vertex = "#version 330 core
in vec3 in0; uniform mat4 un4, un5; out vec3 direction;
void main() {
    direction = in0;
    mat4 turn = mat4(mat3(un4));
    gl_Position = (un5 * turn * vec4(in0, 1.0)).xyww;
}
";
    let fragment = "#version 330 core
uniform samplerCube un16; in vec3 direction; out vec4 c;
void main() { c = vec4(texture(un16, direction).rgb, 1.0); }
";
    let found = of_exercise("ex08", vertex, fragment).found;
    assert!(matches!(found, Found::Right(_)), "{found:?}");
}

/// A power of at least 1 is white everywhere: ambient light of 1 and any highlight would be too.
#[test]
fn a_white_picture_is_never_right() {
    let fragment = "#version 330 core
in vec3 n; in vec3 p;
uniform vec3 light_pos, u_view_pos; uniform float brillance;
out vec4 c;
void main() {
    vec3 r = reflect(-normalize(light_pos - p), normalize(n));
    c = vec4(vec3(pow(brillance, clamp(dot(r, normalize(u_view_pos - p)), 0.0, 1.0))), 1.0);
}
";
    let found = of_exercise("ex06", IN_WORLD_SPACE, fragment).found;
    assert!(!matches!(found, Found::Right(_)), "{found:?}");
}

/// The sum of the terms is in line 12.
const LIT_IN_WORLD_SPACE: &str = "#version 330 core
struct Light { vec3 light_pos; float ambient_strength, diffuse_strength, specular_strength, constant, linear, quadratic; };
uniform Light light; uniform vec3 u_view_pos, materialColour; uniform float shininess;
in vec3 n; in vec3 p; out vec4 c;
void main() {
    vec3 to_light = light.light_pos - p;
    vec3 N = normalize(n), L = normalize(to_light), H = normalize(L + normalize(u_view_pos - p));
    float d = length(to_light), a = 1.0 / (light.constant + light.linear * d + light.quadratic * d * d);
    vec3 ambient = light.ambient_strength * materialColour;
    vec3 diffuse = light.diffuse_strength * max(dot(N, L), 0.0) * materialColour;
    vec3 specular = light.specular_strength * pow(max(dot(N, H), 0.0), shininess) * materialColour;
    vec3 sum = SUM;
    c = vec4(sum, 1.0);
}
";

/// In view space, a highlight of wrong vectors would be as dark as one that is missing.
#[test]
fn a_program_in_world_space_has_no_mistakes_in_view_space() {
    let fragment = LIT_IN_WORLD_SPACE.replace("SUM", "ambient + a * diffuse");
    let found = of_exercise("ex07", IN_WORLD_SPACE, &fragment).explanations;
    let ids: Vec<&str> = found.iter().flat_map(|one| one.mistakes.iter().map(|mistake| mistake.id.as_str())).collect();
    assert_eq!(ids, ["specular-missing"]);
}

/// With a normal that is translated, the highlight is behind the object: any exponent would do, but no other value.
#[test]
fn a_black_picture_has_the_mistake_that_its_values_show() {
    let vertex = "#version 330 core
in vec3 position; in vec3 normal; uniform mat4 M, V, P; uniform vec3 light_pos; uniform float brillance;
out float grau;
void main() {
    vec3 punkt = (V * M * vec4(position, 1.0)).xyz;
    vec3 nrm = normalize((V * M * vec4(normal, 1.0)).xyz);
    vec3 licht = normalize((V * vec4(light_pos, 1.0)).xyz - punkt);
    grau = pow(max(0.0, dot(normalize(licht - normalize(punkt)), nrm)), brillance);
    gl_Position = P * vec4(punkt, 1.0);
}
";
    let fragment = "#version 330 core
in float grau; out vec4 c;
void main() { c = vec4(vec3(grau), 1.0); }
";
    let found = of_exercise("ex05", vertex, fragment);
    assert_eq!(explained(&found), ["normal-translated"]);
}

/// Most mistakes have their own wrong values in the program, by the space that it computes in: few pairs are left to try.
#[test]
fn two_mistakes_in_view_space_are_named() {
    let vertex = "#version 330 core
in vec3 position; in vec3 normal; uniform mat4 M, V, P; uniform vec3 u_light_pos; out float grey;
void main() {
    vec3 place = (P * V * M * vec4(position, 1.0)).xyz;
    vec3 N = normalize(mat3(transpose(inverse(V * M))) * normal);
    vec3 L = normalize(vec3(V * vec4(u_light_pos, 1.0)) - N);
    grey = pow(max(dot(2.0 * dot(N, L) * N - L, normalize(-place)), 0.0), 32.0);
    gl_Position = P * V * M * vec4(position, 1.0);
}
";
    let fragment = "#version 330 core
in float grey; out vec4 c;
void main() { c = vec4(vec3(grey), 1.0); }
";
    let mut found = explained(&of_exercise("ex05", vertex, fragment));
    found.sort_unstable();
    assert_eq!(found, ["light-direction-minus-normal", "position-in-clip-space"]);
}

/// The camera turns a normal in view space, and with it the diffuse light: only the exponent tells which strength is
/// that of the highlight.
#[test]
fn strengths_are_told_apart_beside_a_wrong_normal() {
    let vertex = "#version 330
in vec3 p; in vec3 n; uniform mat4 M, V, P; out vec3 vn; out vec3 vp;
void main() {
    vn = mat3(V * M) * n;
    gl_Position = P * V * M * vec4(p, 1.0);
    vp = vec3(M * vec4(p, 1.0));
}
";
    let fragment = "#version 330
struct T { float d; float s; vec3 pos; float a; };
uniform T li; uniform vec3 eye, col; uniform float s; in vec3 vn, vp; out vec4 o;
void main() {
    vec3 n1 = normalize(vn), c = normalize(eye - vp), w = li.pos - vp, b = normalize(w);
    float e = length(w), at = 1.0 / (1.0 + 0.14 * e + 0.07 * e * e);
    float pw = pow(max(0.0, dot(-reflect(b, n1), c)), s);
    o = vec4((li.a + at * (li.d * max(0.0, dot(n1, b)) + li.s * pw)) * col, 1.0);
}
";
    assert_eq!(explained(&of_exercise("ex07", vertex, fragment)), ["normal-by-model-view"]);
}

/// Each part of a product is a multiple of what it should be.
#[test]
fn a_term_that_is_added_twice_is_wrong_in_the_sum() {
    let fragment = LIT_IN_WORLD_SPACE.replace("SUM", "2.0 * ambient + a * diffuse + a * specular");
    let found = of_exercise("ex07", IN_WORLD_SPACE, &fragment);
    assert_eq!(explained(&found), ["ambient-twice"]);
    let place = found.places.iter().find(|place| place.is_sum).unwrap();
    let line = fragment[..place.span.start as usize].lines().count();
    assert_eq!((place.mistake.id.as_str(), line), ("ambient-twice", 12));
}

/// The first cause of a single error: its line, what it should be, and its mistake.
fn single(diagnosis: &Diagnosis) -> (u32, &str, Option<&str>) {
    let Found::Causes(groups) = &diagnosis.found else { panic!("{diagnosis:?}") };
    assert_eq!(groups.len(), 1, "{groups:?}");
    let cause = &groups[0][0];
    (cause.span.line, cause.should.as_str(), cause.mistakes.first().map(|mistake| mistake.id.as_str()))
}

#[test]
fn an_input_in_place_of_another_has_its_line() {
    let right = LIT_IN_WORLD_SPACE.replace("SUM", "ambient + a * (diffuse + specular)");
    assert!(matches!(of_exercise("ex07", IN_WORLD_SPACE, &right).found, Found::Right(_)));
    let strengths = "float ka = light.ambient_strength;\n    vec3 ambient = ka *";
    let named = right.replace("vec3 ambient = light.ambient_strength *", strengths);
    let wrong = named.replace("ka = light.ambient_strength", "ka = light.diffuse_strength");
    let found = of_exercise("ex07", IN_WORLD_SPACE, &wrong);
    let (line, should, mistake) = single(&found);
    assert_eq!((line, mistake), (9, None), "{should}");
    assert!(should.contains("ambient strength"), "{should}");
}

#[test]
fn a_colour_with_exchanged_channels_is_wrong_where_they_are_exchanged() {
    let right = LIT_IN_WORLD_SPACE.replace("SUM", "ambient + a * (diffuse + specular)");
    let found = of_exercise("ex07", IN_WORLD_SPACE, &right.replace("vec4(sum,", "vec4(sum.zyx,"));
    assert_eq!((single(&found).0, single(&found).2), (13, None));
}

#[test]
fn attenuation_has_the_name_of_the_term_that_it_belongs_to() {
    let with_sum = |sum: &str| of_exercise("ex07", IN_WORLD_SPACE, &LIT_IN_WORLD_SPACE.replace("SUM", sum));
    let twice = with_sum("ambient + a * (a * diffuse) + a * specular");
    assert_eq!((single(&twice).0, single(&twice).2), (12, None));
    // It is missing where the other term gets it, and not where the term is computed.
    let missing = with_sum("ambient + diffuse + a * specular");
    assert_eq!((single(&missing).0, single(&missing).2), (12, Some("diffuse-not-attenuated")));
}

#[test]
fn terms_may_be_multiplied_in_any_way() {
    let with_sum = |sum: &str| of_exercise("ex07", IN_WORLD_SPACE, &LIT_IN_WORLD_SPACE.replace("SUM", sum));
    for sum in ["ambient + a * diffuse * specular", "(ambient + diffuse) * (a * specular)"] {
        let found = with_sum(sum);
        assert_eq!((single(&found).0, single(&found).2), (12, Some("terms-multiplied")), "{sum}");
    }
}

#[test]
fn a_strength_is_missing_where_a_function_is_called() {
    let right = LIT_IN_WORLD_SPACE.replace("SUM", "ambient + a * (diffuse + specular)");
    let function = "float lambert(vec3 n, vec3 l) { return max(dot(n, l), 0.0); }\nvoid main";
    let called = right.replace("void main", function).replace("max(dot(N, L), 0.0) *", "lambert(N, L) *");
    assert!(matches!(of_exercise("ex07", IN_WORLD_SPACE, &called).found, Found::Right(_)));
    let found = of_exercise("ex07", IN_WORLD_SPACE, &called.replace("light.diffuse_strength * lambert", "lambert"));
    assert_eq!((single(&found).0, single(&found).2), (11, Some("diffuse-strength-missing")));
}

/// Beside another mistake, a varying that is read twice is wrong at both places, and not in the sum of what is computed from it.
#[test]
fn what_is_read_twice_beside_another_mistake_is_wrong_where_it_is_read() {
    let right = LIT_IN_WORLD_SPACE.replace("SUM", "ambient + a * (diffuse + specular)");
    let wrong = right
        .replace("vec3 N = normalize(n), L", "vec3 L")
        .replace("dot(N, ", "dot(n, ")
        .replace("light.constant + light.linear * d", "light.linear * d");
    let in_view = wrong
        .replace("uniform Light light;", "uniform Light light; uniform mat4 V;")
        .replace("light.light_pos - p", "vec3(V * vec4(light.light_pos, 1.0)) - p")
        .replace("u_view_pos - p", "-p");
    let vertex = IN_VIEW_SPACE.replace("PLACE", "(V * M * vec4(position, 1.0)).xyz");
    let found = of_exercise("ex07", &vertex, &in_view);
    assert_eq!(explained(&found), ["attenuation-without-constant", "normal-not-renormalised"]);
    assert_eq!(lines(&found), [8, 10]);
}

/// The object's colour is open, but it is the same for all terms.
#[test]
fn a_strength_of_another_term_is_wrong_although_the_colour_is_written_in_the_source() {
    let right = LIT_IN_WORLD_SPACE
        .replace("SUM", "ambient + a * (diffuse + specular)")
        .replace("materialColour", "vec3(0.5, 0.6, 0.8)")
        .replace(", vec3(0.5, 0.6, 0.8);", ";");
    assert!(matches!(of_exercise("ex07", IN_WORLD_SPACE, &right).found, Found::Right(_)));
    let found =
        of_exercise("ex07", IN_WORLD_SPACE, &right.replace("light.diffuse_strength *", "light.specular_strength *"));
    assert!(!matches!(found.found, Found::Right(_)), "{found:?}");
}

/// Most of it is dark, which is as few colours as steps have.
#[test]
fn a_dark_picture_is_not_drawn_in_steps() {
    let vertex = IN_VIEW_SPACE.replace("PLACE", "(V * M * vec4(position, 1.0)).xyz");
    let fragment = "#version 330 core
uniform mat4 V;
in vec3 n; in vec3 p;
out vec4 c;
void main() {
    vec3 a = normalize(n);
    vec3 l = normalize(vec3(V * vec4(0.5, 0.5, -0.7, 1.0)) - a);
    c = vec4(vec3(0.1 + max(dot(a, l), 0.0)), 1.0);
}
";
    assert_eq!(explained(&of_exercise("ex04", &vertex, fragment)), ["light-direction-minus-normal"]);
}

#[test]
fn programs_that_take_long_are_not_judged() {
    let start = "void main() {";
    let loops =
        fragment("un6 - p").replace(start, "void main() {\nfloat x = 0.0; for (int i = 0; i < 100000; i++) x += 0.1;");
    let long =
        fragment("un6 - p").replace(start, &format!("{start}\nfloat x = 0.0;\n{}", "x = x * 2.0 + 1.0;\n".repeat(400)));
    for text in [loops, long] {
        let texts = [StageText::whole("a.vert", VERTEX.to_owned()), StageText::whole("a.frag", text)];
        let found = diagnosed("ex06", [&texts[0], &texts[1]], NamesFile::default());
        assert!(matches!(found, Err(NotJudged::TooLong)), "{found:?}");
    }
}

/// The old pipeline limits light to 1 at the vertices; any other limit changes the light.
#[test]
fn light_may_be_limited_to_one_at_the_vertices_and_to_nothing_else() {
    let limited = |limit: &str| {
        let vertex = "#version 330 core
in vec3 position; in vec3 normal;
uniform mat4 M, V, P, itM; uniform vec3 u_light_pos, u_view_pos; uniform float shininess;
out vec3 v_light;
void main() {
    vec3 p = vec3(M * vec4(position, 1.0));
    vec3 n = normalize(mat3(itM) * normal);
    vec3 l = normalize(u_light_pos - p);
    float spec = pow(max(dot(reflect(-l, n), normalize(u_view_pos - p)), 0.0), shininess);
    vec3 sum = vec3(0.2 + 0.9 * max(dot(n, l), 0.0) + spec);
    v_light = LIMIT;
    gl_Position = P * V * vec4(p, 1.0);
}
";
        let fragment = "#version 330 core
in vec3 v_light;
out vec4 color;
void main() { color = vec4(v_light, 1.0); }
";
        of_exercise("ex05", &vertex.replace("LIMIT", limit), fragment)
    };
    for limit in ["clamp(sum, 0.0, 1.0)", "min(sum, vec3(1.0))"] {
        let diagnosis = limited(limit);
        assert!(matches!(diagnosis.found, Found::Right(_)) && diagnosis.limits_colours, "{limit}");
    }
    for limit in ["clamp(sum, 0.0, 0.5)", "clamp(sum, 0.4, 1.0)"] {
        assert!(!matches!(limited(limit).found, Found::Right(_)), "{limit}");
    }
}
