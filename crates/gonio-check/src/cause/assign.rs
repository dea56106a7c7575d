//! Finds the roles of inputs whose names say nothing: those with which most values of the program are quantities of the
//! light equation.

mod influence;
pub(super) mod lights;
mod probe;
mod scorer;
mod switches;

pub(super) use influence::by_influence;
use scorer::Scorer;
pub(super) use switches::with_other_switches;

use super::model::{Model, STAGES};
use super::program::Program;
use super::samples::SceneSamples;
use super::solutions::ModelSolutions;
use crate::roles::{Bound, How, Role, VariableKind};
use gonio_threads::prelude::*;

const MATRICES: [Role; 8] = [
    Role::Model,
    Role::View,
    Role::Projection,
    Role::ModelView,
    Role::ViewProjection,
    Role::ModelViewProjection,
    Role::NormalMatrix,
    Role::NormalMatrixOfModelView,
];
const NORMAL_MATRICES: [Role; 4] = [Role::NormalMatrix, Role::NormalMatrixOfModelView, Role::Model, Role::View];
/// The colour first, because few values show it.
const VECTORS: [Role; 4] = [Role::MaterialColor, Role::LightPos(0), Role::ViewPos, Role::LightPosInView(0)];

/// In the order in which programs usually declare them.
const NUMBERS: [Role; 10] = [
    Role::AmbientStrength(0),
    Role::DiffuseStrength(0),
    Role::SpecularStrength(0),
    Role::Shininess,
    Role::AttenuationConstant(0),
    Role::AttenuationLinear(0),
    Role::AttenuationQuadratic(0),
    Role::RefractionIndex,
    Role::RefractionRatio,
    Role::Roughness,
];
const LIGHT_POSITIONS: [Role; 2] = [Role::LightPos(0), Role::LightPosInView(0)];
const NORMALS: [Role; 2] = [Role::NormalMatrix, Role::NormalMatrixOfModelView];
const ATTENUATION: [Role; 3] =
    [Role::AttenuationConstant(0), Role::AttenuationLinear(0), Role::AttenuationQuadratic(0)];

/// Most matrices whose roles are tried together.
const MOST_MATRICES: usize = 4;

/// The roles of a colour that may instead be three strengths.
const STRENGTHS: [Role; 2] = [Role::LightColor(0), Role::Strengths(0)];
/// Those of a vector whose components are only read one by one.
const PACKED: [Role; 3] = [Role::Strengths(0), Role::Attenuation(0), Role::MaterialColor];
/// Those of one that is also read as a vector.
const PACKED_OR_VECTOR: [Role; 6] = [
    Role::MaterialColor,
    Role::LightPos(0),
    Role::ViewPos,
    Role::LightPosInView(0),
    Role::Strengths(0),
    Role::Attenuation(0),
];

/// The roles that an input may have: the name alone does not tell the space of a normal matrix.
fn candidates(program: &Program, bound: &Bound) -> &'static [Role] {
    let is_named = bound.how == How::Name;
    let packed = program.packed.iter().find(|(name, _)| *name == bound.declared.name);
    match bound.role {
        _ if bound.how == How::NamesFile => &[],
        Role::LightColor(0) | Role::Strengths(0) if packed.is_some_and(|(_, is_vector)| *is_vector) => &STRENGTHS,
        _ if let (Some((_, is_vector)), false) = (packed, is_named) => {
            if *is_vector {
                &PACKED_OR_VECTOR
            } else {
                &PACKED
            }
        }
        _ if lights::is_open(bound) && (is_named || bound.declared.array > 1) => &[],
        _ if bound.declared.name.starts_with("gl_") => &[],
        _ if is_named && has_open_normals(bound) => &NORMALS,
        _ if is_named => &[],
        _ => of_type(&bound.declared.glsl_type),
    }
}

/// Whether it is a normal matrix whose name leaves open to which matrix it belongs.
pub(super) fn has_open_normals(bound: &Bound) -> bool {
    NORMALS.contains(&bound.role)
        && bound.how != How::NamesFile
        && !bound.declared.name.starts_with("gl_")
        && !is_of_model(&bound.declared.name)
}

/// Whether the name of a normal matrix says that it belongs to the model matrix.
fn is_of_model(name: &str) -> bool {
    let name = name.to_lowercase();
    ["itm", "model"].iter().any(|word| name.contains(word)) && !["mv", "view"].iter().any(|word| name.contains(word))
}

/// The roles that a type may have.
fn of_type(glsl_type: &str) -> &'static [Role] {
    match glsl_type {
        "float" => &NUMBERS,
        "mat4" => &MATRICES,
        "mat3" => &NORMAL_MATRICES,
        "vec3" | "vec4" => &VECTORS,
        _ => &[],
    }
}

/// Whether the role of some input is open.
#[must_use]
pub fn is_open(program: &Program) -> bool {
    let is_uniform = |kind: VariableKind| kind == VariableKind::Uniform;
    let mut unknown = program.bindings.unknown.iter();
    unknown.any(|declared| is_uniform(declared.kind) && !of_type(&declared.glsl_type).is_empty())
        || program
            .bindings
            .bound
            .iter()
            .any(|bound| is_uniform(bound.declared.kind) && !candidates(program, bound).is_empty())
        || program.bindings.bound.iter().any(lights::is_open)
        || influence::has_doubles(program)
        || lights::may_be_directions(program)
        || switches::are_open(program)
        || open_attributes(program).is_some()
}

/// Assigns roles to the inputs of a program whose names do not determine them. `samples` are those of the test scenes.
pub fn assign(solutions: &ModelSolutions, program: &mut Program, samples: &[SceneSamples], models: &[Model]) {
    let suns =
        lights::may_be_directions(program).then(|| lights::choose_suns(solutions, program, samples, models)).flatten();
    let (samples, models) = match &suns {
        Some((samples, models)) => (samples.as_slice(), models.as_slice()),
        None => (samples, models),
    };
    let Some(first) = samples.first() else { return };
    for declared in influence::scales(program, first) {
        program.bindings.unknown.retain(|unknown| *unknown != declared);
        program.bindings.bound.push(Bound { declared, role: Role::Tint, how: How::Type });
    }
    let scorer = &Scorer::new(first, models);
    if switches::are_open(program) {
        switches::set(program, scorer);
    }
    let other = open_attributes(program).map(|[a, b]| {
        let mut other = program.clone();
        (other.bindings.bound[a].role, other.bindings.bound[b].role) =
            (program.bindings.bound[b].role, program.bindings.bound[a].role);
        assign_uniforms(&mut other, scorer);
        other
    });
    assign_uniforms(program, scorer);
    let fitness = |program: &Program| (scorer.is_in_place(program), scorer.score(program));
    if let Some(other) = other.filter(|other| fitness(other) > fitness(program)) {
        *program = other;
    }
}

fn assign_uniforms(program: &mut Program, scorer: &Scorer<'_>) {
    // Variables without a role take part.
    let unknown: Vec<Bound> = (program.bindings.unknown.iter())
        .filter(|declared| declared.kind == VariableKind::Uniform)
        .filter_map(|declared| {
            let role = *of_type(&declared.glsl_type).first()?;
            Some(Bound { declared: declared.clone(), role, how: How::Type })
        })
        .collect();
    let mut bound: Vec<Bound> = program.bindings.bound.clone();
    bound.extend(unknown);
    let is_open = |bound: &Bound| {
        bound.declared.kind == VariableKind::Uniform
            && bound.declared.array <= 1
            && !candidates(program, bound).is_empty()
    };
    let open: Vec<usize> = (0..bound.len()).filter(|index| is_open(&bound[*index])).collect();
    // The only vector is the light's position more often than a colour, and with it the matrices show more values.
    let is_vector = |index: &&usize| of_type(&bound[**index].declared.glsl_type).contains(&VECTORS[0]);
    let is_lit = bound.iter().any(|bound| bound.role == Role::LightPos(0));
    let only = match (open.iter().filter(is_vector).collect::<Vec<_>>().as_slice(), is_lit) {
        ([only], false) => Some(**only),
        _ => None,
    };
    if let Some(only) = only {
        bound[only].role = Role::LightPos(0);
    }
    if open.is_empty() && !bound.iter().any(lights::is_open) {
        return;
    }
    let known = program.bindings.bound.clone();
    let before = (scorer.is_in_place(program), scorer.score(program));
    let is_matrix = |index: &usize| bound[*index].declared.glsl_type == "mat4" && bound[*index].how != How::Name;
    let matrices: Vec<usize> = open.iter().copied().filter(is_matrix).collect();
    let mut others: Vec<usize> = open.iter().copied().filter(|index| !is_matrix(index)).collect();
    let order = |index: &usize| match of_type(&bound[*index].declared.glsl_type) {
        [Role::NormalMatrix | Role::Model, ..] => 0,
        [Role::MaterialColor, ..] => 1,
        _ => 2,
    };
    others.sort_by_key(order);
    program.bindings.bound.clone_from(&bound);
    if (1..=MOST_MATRICES).contains(&matrices.len()) {
        // A light in view space shows only beside the matrices that lead there.
        let all = lights::in_spaces(&program.bindings.bound).into_iter().map(|bound| {
            program.bindings.bound = bound;
            (choose_matrices(program, scorer, &matrices), program.bindings.bound.clone())
        });
        let best = all.reduce(|best, other| if other.0 > best.0 { other } else { best });
        program.bindings.bound = best.map_or(bound.clone(), |(_, bound)| bound);
    }
    lights::choose_space(program, scorer);
    let mut attenuated = false;
    // Twice, because the first of two unknown vectors is tried beside a wrong second one.
    for _ in 0..2 {
        // It is a function of the distance from the light.
        if let Some(found) = (!attenuated).then(|| attenuation(program, scorer, &bound, &others)).flatten() {
            attenuated = true;
            for (index, role) in found.into_iter().zip(ATTENUATION) {
                program.bindings.bound[index].role = role;
                others.retain(|other| *other != index);
            }
        }
        for index in &others {
            let is_exponent = is_exponent(program, &bound[*index].declared.name);
            let mut usual = if is_exponent { Role::Shininess } else { program.bindings.bound[*index].role };
            program.bindings.bound[*index].role = usual;
            if NUMBERS.contains(&usual) || VECTORS.contains(&usual) || PACKED.contains(&usual) {
                let is_taken = |role: &Role| {
                    let others = program.bindings.bound.iter().enumerate().filter(|(other, _)| other != index);
                    others.into_iter().any(|(_, bound)| bound.role == *role)
                };
                if is_taken(&usual) {
                    let mut all = candidates(program, &bound[*index]).iter().copied();
                    usual = all.find(|role| !is_taken(role)).unwrap_or(usual);
                    program.bindings.bound[*index].role = usual;
                }
            }
            // Its use tells more than its values, of which the smallest look alike.
            if is_exponent && usual == Role::Shininess {
                continue;
            }
            // An input has one meaning.
            let is_same = |a: Role, b: Role| a == b || [a, b].iter().all(|role| LIGHT_POSITIONS.contains(role));
            let is_free = |role: &&Role| {
                let is_other = |(other, bound): (usize, &Bound)| {
                    other != *index
                        && bound.how == How::Name
                        && is_same(bound.role, **role)
                        && (NUMBERS.contains(role) || VECTORS.contains(role))
                };
                !program.bindings.bound.iter().enumerate().any(is_other)
            };
            let roles: Vec<Role> = candidates(program, &bound[*index]).iter().filter(is_free).copied().collect();
            let score = |role: &Role| {
                let mut other = program.clone();
                other.bindings.bound[*index].role = *role;
                scorer.score(&other)
            };
            let scores: Vec<usize> = roles.par_iter().map(score).collect();
            let mut best = (scorer.score(program), usual);
            for (role, score) in roles.into_iter().zip(scores) {
                if score > best.0 {
                    best = (score, role);
                }
            }
            program.bindings.bound[*index].role = best.1;
        }
        // Beside inputs without a role, a light shows few values.
        lights::choose_space(program, scorer);
    }
    tell_eye_from_light(program, scorer, &others);
    // Beside a light without a role, the space of the light shows in no value.
    if !others.is_empty() && (1..=MOST_MATRICES).contains(&matrices.len()) {
        choose_matrices(program, scorer, &matrices);
    }
    if (scorer.is_in_place(program), scorer.score(program)) <= before {
        // An exponent is one by its use, and the only vector is the light, even if no value becomes right with it.
        let is_new =
            |bound: &Bound| known.iter().all(|other| other.declared != bound.declared || other.role == Role::Tint);
        let is_shown = |bound: &&Bound| {
            bound.role == Role::Shininess && is_new(bound) && is_exponent(program, &bound.declared.name)
        };
        let has_one = known.iter().any(|bound| bound.role == Role::Shininess);
        let exponent = if has_one { None } else { program.bindings.bound.iter().find(is_shown).cloned() };
        let light = only.map(|only| bound[only].clone()).filter(|light| scorer.is_lit && is_new(light));
        program.bindings.bound = known;
        for found in exponent.into_iter().chain(light) {
            program.bindings.bound.retain(|bound| bound.declared != found.declared);
            program.bindings.bound.push(found);
        }
    }
    program.declared.adopt(&program.bindings);
    let bound = &program.bindings.bound;
    program.bindings.unknown.retain(|unknown| bound.iter().all(|bound| bound.declared != *unknown));
}

/// Makes one of two inputs the eye that both have the role of the light: from either, most values are directions to it.
fn tell_eye_from_light(program: &mut Program, scorer: &Scorer<'_>, open: &[usize]) {
    let light = Role::LightPos(0);
    let bound = &program.bindings.bound;
    let is_light = |index: &usize| bound[*index].role == light && bound[*index].how == How::Type;
    let lights: Vec<usize> = open.iter().copied().filter(is_light).collect();
    let is_taken = bound.iter().any(|bound| bound.role == Role::ViewPos);
    let is_named = bound.iter().any(|bound| bound.role == light && bound.how != How::Type);
    let ([first, second], false, false) = (lights.as_slice(), is_taken, is_named) else { return };
    let with_eye = |eye: usize| {
        let mut other = program.clone();
        other.bindings.bound[eye].role = Role::ViewPos;
        (scorer.score(&other), other.bindings.bound)
    };
    let [of_first, of_second] = [*first, *second].map(with_eye);
    program.bindings.bound = if of_first.0 > of_second.0 { of_first.1 } else { of_second.1 };
}

/// Assigns roles to the matrices that have none by name, once those of the other inputs are known.
pub(super) fn choose_open_matrices(program: &mut Program, samples: &[SceneSamples], models: &[Model]) {
    let Some(first) = samples.first() else { return };
    let is_open = |bound: &Bound| {
        bound.declared.kind == VariableKind::Uniform && bound.declared.glsl_type == "mat4" && bound.how == How::Type
    };
    let all = program.bindings.bound.iter().enumerate();
    let matrices: Vec<usize> = all.filter(|(_, bound)| is_open(bound)).map(|(index, _)| index).collect();
    if (1..=MOST_MATRICES).contains(&matrices.len()) {
        choose_matrices(program, &Scorer::new(first, models), &matrices);
        program.declared.adopt(&program.bindings);
    }
}

/// Assigns roles to matrices, so that every vertex is in place and most values are right. Returns 0 if that is not
/// possible.
fn choose_matrices(program: &mut Program, scorer: &Scorer<'_>, matrices: &[usize]) -> usize {
    // The roles that the source shows, unless others fit better.
    let usual = program.bindings.bound.clone();
    // In a scene without stretching, the model matrix is as good as that of the normals.
    let role = |at: usize| usual[matrices[at]].role;
    let is_usual_distinct = (1..matrices.len()).all(|at| (0..at).all(|other| role(other) != role(at)));
    let mut best = match is_usual_distinct && scorer.is_in_place(program) {
        true => (1 + scorer.score(program), usual.clone()),
        false => (0, usual.clone()),
    };
    let mut chosen = vec![0_usize; matrices.len()];
    loop {
        let is_distinct = (1..chosen.len()).all(|at| !chosen[..at].contains(&chosen[at]));
        if is_distinct {
            for (index, role) in matrices.iter().zip(&chosen) {
                program.bindings.bound[*index].role = MATRICES[*role];
            }
            if scorer.is_in_place(program) {
                let score = 1 + scorer.score(program);
                if score > best.0 {
                    best = (score, program.bindings.bound.clone());
                }
            }
        }
        let Some(at) = chosen.iter().rposition(|role| *role + 1 < MATRICES.len()) else { break };
        chosen[at] += 1;
        chosen[at + 1..].fill(0);
    }
    program.bindings.bound = best.1;
    if best.0 == 0 {
        choose_each_matrix(program, scorer, matrices);
    }
    best.0
}

/// Assigns roles to matrices one by one, so that most values are right: a mistake may leave no vertex in place.
fn choose_each_matrix(program: &mut Program, scorer: &Scorer<'_>, matrices: &[usize]) {
    for at in matrices.iter().chain(matrices) {
        let mut best = (scorer.score(program), program.bindings.bound[*at].role);
        for role in MATRICES {
            program.bindings.bound[*at].role = role;
            let score = scorer.score(program);
            if score > best.0 {
                best = (score, role);
            }
        }
        program.bindings.bound[*at].role = best.1;
    }
}

/// Whether an input is the second argument of `pow`.
fn is_exponent(program: &Program, name: &str) -> bool {
    let name = program.in_text(name);
    // A last component has several names.
    let vector = name.strip_suffix(".w");
    let is_it = |exponent: &str| {
        let of_vector = |vector| exponent.strip_prefix(vector).is_some_and(|last| matches!(last, ".w" | ".a" | ".q"));
        exponent == name || vector.is_some_and(of_vector)
    };
    STAGES.into_iter().any(|stage| {
        program.numbers(stage).into_iter().any(|expr| {
            let arguments = program.text(stage, expr).strip_prefix("pow").and_then(|text| text.strip_suffix(')'));
            arguments.and_then(|text| text.rsplit_once(',')).is_some_and(|(_, exponent)| is_it(exponent.trim()))
        })
    })
}

/// Position and normal, if their names do not tell which attribute is which.
fn open_attributes(program: &Program) -> Option<[usize; 2]> {
    let is_open = |bound: &Bound| {
        bound.declared.kind == VariableKind::Attribute
            && bound.how == How::Type
            && [Role::Position, Role::Normal].contains(&bound.role)
    };
    let all = program.bindings.bound.iter().enumerate();
    let open: Vec<usize> = all.filter(|(_, bound)| is_open(bound)).map(|(index, _)| index).collect();
    open.try_into().ok()
}

/// The three numbers among the open ones that are the constants of the attenuation: together they give a right value.
fn attenuation(program: &mut Program, scorer: &Scorer<'_>, bound: &[Bound], open: &[usize]) -> Option<[usize; 3]> {
    let is_number = |index: &&usize| bound[**index].declared.glsl_type == "float";
    let numbers: Vec<usize> = open.iter().filter(is_number).copied().collect();
    // An input has one meaning.
    let is_named = |bound: &Bound| bound.how == How::Name && ATTENUATION.contains(&bound.role);
    if numbers.len() < ATTENUATION.len() || numbers.len() > 7 || bound.iter().any(is_named) {
        return None;
    }
    let mut all = Vec::new();
    for a in &numbers {
        for b in numbers.iter().filter(|b| *b != a) {
            all.extend(numbers.iter().filter(|c| *c != a && *c != b).map(|c| [*a, *b, *c]));
        }
    }
    let score = |inputs: &[usize; 3]| {
        let mut other = program.clone();
        for (index, role) in inputs.iter().zip(ATTENUATION) {
            other.bindings.bound[*index].role = role;
        }
        scorer.score(&other)
    };
    let scores: Vec<usize> = all.par_iter().map(score).collect();
    let mut best = (scorer.score(program), None);
    for (inputs, score) in all.into_iter().zip(scores) {
        if score > best.0 {
            best = (score, Some(inputs));
        }
    }
    best.1
}
