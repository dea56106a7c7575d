//! Finds the roles of inputs by their influence on the colour: an input of which nothing is known is a strength if the
//! colour is linear in it, an exponent if it is one, a position if all channels depend on all its components.
//!
//! Unlike the number of right values, this does not change much where the program has a mistake.

use super::probe::{Influence, Input, Probe, differ, is_exponent, powers, spread};
use crate::cause::program::{Program, Runner, index_of};
use crate::cause::samples::SceneSamples;
use crate::cause::seeing::see;
use crate::roles::{Bound, Declared, Fixed, How, Role, VariableKind};
use glam::Vec3;

/// Places at which inputs are varied.
const PLACES: usize = 40;
/// More inputs without a role belong to an engine.
const MOST_INPUTS: usize = 12;

/// The name without the indices of arrays.
fn without_indices(name: &str) -> String {
    let mut is_index = false;
    let is_kept = |c: &char| {
        is_index = *c == '[' || is_index && *c != ']';
        !is_index && *c != ']'
    };
    name.chars().filter(is_kept).collect()
}

/// The inputs that are varied, elements of arrays of structs together.
fn inputs(named: &Program, samples: &SceneSamples, is_scale: &dyn Fn(&Declared) -> bool) -> Vec<Input> {
    let mut found: Vec<Input> = Vec::new();
    let base = |glsl_type: &str| {
        let place = samples.scene.eye + Vec3::new(0.3, 0.5, 0.2);
        let scale = place.length().max(1.0) / 2.5;
        Some(match glsl_type {
            "float" => vec![0.6],
            "vec3" => (place / scale).to_array().to_vec(),
            "vec4" => (place / scale).extend(1.0).to_array().to_vec(),
            _ => return None,
        })
    };
    let mut add = |declared: &Declared| {
        let Some(base) = base(&declared.glsl_type).filter(|_| declared.kind == VariableKind::Uniform) else { return };
        let group = without_indices(&declared.name);
        match found.iter_mut().find(|known| without_indices(&known.members[0].name) == group) {
            Some(known) => known.members.push(declared.clone()),
            None => found.push(Input { members: vec![declared.clone()], base, is_exponent: false }),
        }
    };
    for declared in named.bindings.unknown.iter().chain(doubles(named)) {
        if !is_scale(declared) {
            add(declared);
        }
    }
    found
}

/// Inputs whose names give them the role that another one has too.
fn doubles(named: &Program) -> impl Iterator<Item = &Declared> {
    let is_open = |bound: &&Bound| {
        bound.declared.kind == VariableKind::Uniform && bound.how == How::Name && of_one_input(bound.role)
    };
    let others = |bound: &Bound| named.bindings.bound.iter().filter(|other| other.role == bound.role).count();
    named.bindings.bound.iter().filter(is_open).filter(move |bound| others(bound) > 1).map(|bound| &bound.declared)
}

/// Whether one input has this role, not several that are used together.
fn of_one_input(role: Role) -> bool {
    super::NUMBERS.contains(&role) || [Role::LightPos(0), Role::ViewPos].contains(&role)
}

/// Whether names give two inputs the same role.
pub(super) fn has_doubles(named: &Program) -> bool {
    doubles(named).next().is_some()
}

/// The program with the roles that its inputs have by their influence; several if nothing distinguishes two of them. None
/// if all names tell the role.
pub(in crate::cause) fn by_influence(
    named: &Program,
    assigned: &Program,
    samples: &SceneSamples,
    is_lit: bool,
) -> Vec<Program> {
    let samples = samples.few(PLACES);
    let is_scale =
        |declared: &Declared| assigned.bindings.bound.iter().any(|b| b.declared == *declared && b.role == Role::Tint);
    let mut all = inputs(named, &samples, &is_scale);
    if all.is_empty() || all.len() > MOST_INPUTS {
        return Vec::new();
    }
    let is_number = |input: &Input| input.base.len() == 1;
    let mut start = assigned.clone();
    let is_probed = |all: &[Input], declared: &Declared| all.iter().any(|input| input.members.contains(declared));
    start.bindings.bound.retain(|bound| !is_probed(&all, &bound.declared));
    let powers = powers(&start);
    for at in 0..all.len() {
        // The power may be in a branch that is dark at all places.
        let is_written = || all[at].members.iter().any(|declared| super::is_exponent(&start, &declared.name));
        let is_one = is_number(&all[at]) && (is_exponent(&start, &samples, &powers, &all, at) || is_written());
        if is_one {
            (all[at].is_exponent, all[at].base) = (true, vec![8.0]);
        }
    }
    // A name may say exponent where the use says another.
    if all.iter().any(|input| input.is_exponent) {
        let by_name = start.bindings.bound.iter().position(|bound| bound.role == Role::Shininess);
        if let Some(at) = by_name {
            let bound = start.bindings.bound.remove(at);
            all.push(Input { members: vec![bound.declared], base: vec![0.6], is_exponent: false });
            if is_exponent(&start, &samples, &powers, &all, all.len() - 1) {
                return Vec::new();
            }
        }
    }
    let mut probe = Probe::new(start.clone(), samples, &all);
    let Some(kinds) = (0..all.len()).map(|at| probe.influence(at)).collect::<Option<Vec<_>>>() else {
        return Vec::new();
    };
    let these = |is: &dyn Fn(Influence) -> bool| (0..all.len()).filter(|at| is(kinds[*at])).collect::<Vec<usize>>();
    let places = these(&|kind| kind == Influence::Place);
    let mut roles: Vec<Option<Role>> = vec![None; all.len()];
    let mut taken: Vec<Role> = start.bindings.bound.iter().map(|bound| bound.role).collect();
    let mut give = |at: usize, wanted: &[Role]| {
        let role = wanted.iter().copied().find(|role| !taken.contains(role)).unwrap_or(Role::Tint);
        taken.push(role);
        roles[at] = Some(role);
        role
    };
    for at in these(&|kind| kind == Influence::Exponent) {
        give(at, &[Role::Shininess]);
    }
    let mut of_diffuse = None;
    let linear = these(&|kind| matches!(kind, Influence::Linear { .. }));
    for (at, of_term) in terms(&mut probe, &linear, &kinds, &places) {
        let is_colour = kinds[at] == Influence::Linear { is_colour: true };
        let wanted = match of_term {
            None => &[Role::MaterialColor, Role::LightColor(0)],
            Some(term) => roles_of_term(term, is_colour),
        };
        if give(at, wanted) == Role::DiffuseStrength(0) {
            of_diffuse = Some(at);
        }
    }
    let has = |is: &dyn Fn(Role) -> bool| start.bindings.bound.iter().any(|bound| is(bound.role));
    let numbers = these(&|kind| kind == Influence::Number);
    if is_lit {
        let mut factors: Vec<(f32, usize)> = numbers.iter().map(|at| (spread(&probe.factor(*at)), *at)).collect();
        factors.sort_by(|a, b| a.0.total_cmp(&b.0));
        let of_degree = [Role::AttenuationConstant(0), Role::AttenuationLinear(0), Role::AttenuationQuadratic(0)];
        let first = factors.first().is_none_or(|(spread, _)| *spread < 1e-3);
        let open = of_degree.iter().filter(|role| !has(&|known| known == **role)).copied().collect::<Vec<_>>();
        let open = if first || open.len() < 3 { open } else { open[1..].to_vec() };
        for ((_, at), role) in factors.iter().zip(open) {
            give(*at, &[role]);
        }
    } else {
        for at in &numbers {
            give(*at, &[Role::RefractionIndex]);
        }
    }
    let has_light = has(&|role| role.light().is_some() && role.in_space(false).is_some());
    let has_eye = has(&|role| role == Role::ViewPos);
    let (light, eye) = (Role::LightPos(0), Role::ViewPos);
    // Where a mistake takes the light away, or the highlight, its place has no influence, nor has the eye's.
    let by_values = |role: Role| {
        let is_it = |at: &usize| {
            let is_it = |bound: &Bound| bound.role == role && all[*at].members.contains(&bound.declared);
            kinds[*at] == Influence::None && assigned.bindings.bound.iter().any(is_it)
        };
        (0..all.len()).find(is_it).map(|at| (at, role))
    };
    let of_places: Vec<Vec<(usize, Role)>> = match (places.as_slice(), is_lit) {
        ([], true) if !has_light => {
            let eye = by_values(eye).filter(|_| !has_eye);
            vec![by_values(light).into_iter().chain(eye).collect()]
        }
        ([], _) => vec![Vec::new()],
        ([one, ..], false) => vec![vec![(*one, eye)]],
        ([one], true) => vec![vec![(*one, if has_light { eye } else { light })]],
        ([one, two, ..], true) => {
            let (first, second) = (vec![(*one, light), (*two, eye)], vec![(*two, light), (*one, eye)]);
            match [*one, *two].map(|at| probe.is_light(at, of_diffuse)) {
                [Some(false), Some(true)] if !has_light && !has_eye => vec![second],
                [Some(a), Some(b)] if a == b && !has_light && !has_eye => vec![first, second],
                [None, _] | [_, None] if !has_light && !has_eye => vec![first, second],
                _ => vec![first],
            }
        }
    };
    let with_places = |of_places: Vec<(usize, Role)>| {
        let mut roles = roles.clone();
        of_places.into_iter().for_each(|(at, role)| roles[at] = Some(role));
        with_roles(&start, &all, &roles)
    };
    let found = of_places.into_iter().map(with_places);
    found.filter(|program| program.bindings != assigned.bindings).collect()
}

/// The term of each input in which the colour is linear: 0 for ambient, 1 for diffuse and 2 for specular light; `None` for
/// a colour of the whole object.
fn terms(
    probe: &mut Probe<'_>,
    linear: &[usize],
    kinds: &[Influence],
    places: &[usize],
) -> Vec<(usize, Option<usize>)> {
    let mut found = Vec::new();
    let by_exponent: Vec<bool> = linear.iter().map(|at| probe.depends_on_exponent(*at)).collect();
    let is_by_exponent = by_exponent.contains(&true);
    for (at, of_exponent) in linear.iter().copied().zip(by_exponent) {
        let is_colour = kinds[at] == Influence::Linear { is_colour: true };
        let is_whole = is_colour && probe.is_dark_without(at);
        found.push((
            at,
            if is_whole { None } else { Some(probe.term(at, places, is_by_exponent.then_some(of_exponent))) },
        ));
    }
    // Of several that are ambient, all but one are of diffuse light without its cosine: what the light's place changes, or
    // else the name, tells which.
    for is_colour in [false, true] {
        let is_ambient =
            |(at, term): &(usize, Option<usize>)| *term == Some(0) && kinds[*at] == Influence::Linear { is_colour };
        let mut ambient: Vec<usize> = (0..found.len()).filter(|index| is_ambient(&found[*index])).collect();
        if ambient.len() > 1 {
            ambient.sort_by_cached_key(|index| {
                let at = found[*index].0;
                (probe.depends_on_light(at, places), !probe.is_named(at, 'a'), probe.is_named(at, 'd'))
            });
            ambient[1..].iter().for_each(|index| found[*index].1 = Some(1));
        }
    }
    found
}

/// The roles of a factor of a term: a number or a colour.
fn roles_of_term(term: usize, is_colour: bool) -> &'static [Role] {
    match (term, is_colour) {
        (0, false) => &[Role::AmbientStrength(0)],
        (1, false) => &[Role::DiffuseStrength(0), Role::SpecularStrength(0)],
        (_, false) => &[Role::SpecularStrength(0), Role::DiffuseStrength(0)],
        (0, true) => &[Role::AmbientColor(0), Role::MaterialAmbient],
        (1, true) => &[Role::DiffuseColor(0), Role::MaterialDiffuse],
        (_, true) => &[Role::SpecularColor(0), Role::MaterialSpecular],
    }
}

/// A program with roles for these inputs.
fn with_roles(program: &Program, inputs: &[Input], roles: &[Option<Role>]) -> Program {
    let mut program = program.clone();
    for (input, role) in inputs.iter().zip(roles) {
        let Some(role) = role else { continue };
        for declared in &input.members {
            program.bindings.unknown.retain(|unknown| unknown != declared);
            let role = role.with_light(index_of(&declared.name));
            program.bindings.bound.push(Bound { declared: declared.clone(), role, how: How::Type });
        }
    }
    program.declared.adopt(&program.bindings);
    program
}

/// The numbers without a role on which positions on the screen depend: factors that are 1 in the test scenes.
pub(super) fn scales(program: &Program, samples: &SceneSamples) -> Vec<Declared> {
    let is_number = |declared: &&Declared| declared.kind == VariableKind::Uniform && declared.glsl_type == "float";
    let open: Vec<Declared> = program.bindings.unknown.iter().filter(is_number).cloned().collect();
    if open.len() > MOST_INPUTS {
        return Vec::new();
    }
    let samples = [samples.few(PLACES)];
    let mut probe = program.clone();
    let fixed = |of: &[Declared], changed: Option<usize>| -> Vec<Fixed> {
        let value = |at: usize| if changed == Some(at) { 1.5 } else { 1.0 };
        of.iter()
            .enumerate()
            .map(|(at, declared)| Fixed { declared: declared.clone(), values: vec![value(at)] })
            .collect()
    };
    let mut positions = |changed: Option<usize>| {
        probe.bindings.fixed = [program.bindings.fixed.as_slice(), &fixed(&open, changed)].concat();
        see(&Runner::new(&probe, &samples), &[], 0..1).map(|seen| seen.clip.numbers)
    };
    let Some(start) = positions(None) else { return Vec::new() };
    let moves: Vec<bool> =
        (0..open.len()).map(|at| positions(Some(at)).is_some_and(|now| differ(&start, &now))).collect();
    open.into_iter().zip(moves).filter(|(_, moves)| *moves).map(|(declared, _)| declared).collect()
}
