//! Finds the settings of switches: integers and booleans without a role that choose between branches.

use super::{Program, Scorer};
use crate::roles::{Declared, Fixed, VariableKind};

/// Most switches that are set; more belong to an engine.
const MOST_SWITCHES: usize = 6;
/// Most switches of which all combinations are tried.
const MOST_COMBINED: usize = 4;
/// Most settings with which a program may be right.
const MOST_SETTINGS: usize = 32;

/// The settings of a switch of this type, apart from 0.
fn settings(glsl_type: &str) -> &'static [f32] {
    match glsl_type {
        "bool" | "bvec2" | "bvec3" | "bvec4" => &[1.0],
        "int" | "uint" => &[1.0, 2.0, 3.0],
        _ => &[],
    }
}

/// The name without the indices of arrays: `lights[1].type` and `lights[0].type` are one switch.
fn group(name: &str) -> String {
    name.chars().filter(|c| !c.is_ascii_digit()).collect()
}

/// The switches of a program, each with all its elements.
fn switches(program: &Program) -> Vec<Vec<Declared>> {
    let mut all: Vec<Vec<Declared>> = Vec::new();
    let is_switch = |declared: &&Declared| {
        declared.kind == VariableKind::Uniform && declared.array <= 1 && !settings(&declared.glsl_type).is_empty()
    };
    for declared in program.bindings.unknown.iter().filter(is_switch) {
        match all.iter_mut().find(|others| group(&others[0].name) == group(&declared.name)) {
            Some(others) => others.push(declared.clone()),
            None => all.push(vec![declared.clone()]),
        }
    }
    all.truncate(MOST_SWITCHES);
    all
}

/// Whether a program has switches.
pub(super) fn are_open(program: &Program) -> bool {
    !switches(program).is_empty()
}

/// Sets the switches with which the most values are right. Without one, they keep the value that OpenGL gives them.
///
/// Switches are tried on and off together, because one may only count where another is on; then each with its other
/// settings.
pub(super) fn set(program: &mut Program, scorer: &Scorer<'_>) {
    let all = switches(program);
    let before = program.bindings.fixed.clone();
    let mut best = (scorer.score(program), vec![0.0; all.len()]);
    let mut attempt = |program: &mut Program, chosen: Vec<f32>| {
        program.bindings.fixed.clone_from(&before);
        program.bindings.fixed.extend(fixed(&all, &chosen));
        let score = scorer.score(program);
        if score > best.0 {
            best = (score, chosen);
        }
        best.1.clone()
    };
    let mut chosen = vec![0.0; all.len()];
    for bits in 1..1_u32 << all.len().min(MOST_COMBINED) {
        let on = (0..all.len()).map(|at| f32::from(u8::from(bits >> at & 1 == 1))).collect();
        chosen = attempt(program, on);
    }
    for (at, switch) in all.iter().enumerate() {
        for setting in settings(&switch[0].glsl_type).iter().filter(|setting| **setting > 1.0) {
            let mut other = chosen.clone();
            other[at] = *setting;
            chosen = attempt(program, other);
        }
    }
    let mut found = before;
    found.extend(fixed(&all, &chosen));
    for bindings in [&mut program.bindings, &mut program.declared] {
        bindings.fixed.clone_from(&found);
        bindings.unknown.retain(|unknown| found.iter().all(|fixed| fixed.declared != *unknown));
    }
}

/// The program with each other setting of its switches.
pub(in crate::cause) fn with_other_switches(program: &Program) -> Vec<Program> {
    let mut open = program.clone();
    let is_switch = |fixed: &Fixed| !settings(&fixed.declared.glsl_type).is_empty();
    open.bindings
        .unknown
        .extend(open.bindings.fixed.iter().filter(|fixed| is_switch(fixed)).map(|fixed| fixed.declared.clone()));
    open.bindings.fixed.retain(|fixed| !is_switch(fixed));
    let all = switches(&open);
    if all.is_empty() {
        return Vec::new();
    }
    let mut combinations: Vec<Vec<f32>> = vec![Vec::new()];
    for switch in &all {
        let each = [0.0].into_iter().chain(settings(&switch[0].glsl_type).iter().copied());
        combinations = each
            .flat_map(|setting| combinations.iter().map(move |known| [known.as_slice(), &[setting]].concat()))
            .collect();
    }
    let made = combinations.into_iter().take(MOST_SETTINGS).map(|chosen| {
        let found = fixed(&all, &chosen);
        let mut other = open.clone();
        other.bindings.unknown.retain(|unknown| found.iter().all(|fixed| fixed.declared != *unknown));
        other.bindings.fixed.extend(found);
        other
    });
    made.filter(|other| other.bindings.fixed != program.bindings.fixed).collect()
}

/// The values of switches with these settings; those at 0 keep the value that OpenGL gives them.
fn fixed(all: &[Vec<Declared>], settings: &[f32]) -> Vec<Fixed> {
    let value = |declared: &Declared, setting: f32| {
        let size = declared.glsl_type.strip_prefix("bvec").and_then(|size| size.parse().ok()).unwrap_or(1);
        Fixed { declared: declared.clone(), values: vec![setting; size] }
    };
    let set = all.iter().zip(settings).filter(|(_, setting)| **setting != 0.0);
    set.flat_map(|(switch, setting)| switch.iter().map(|declared| value(declared, *setting))).collect()
}
