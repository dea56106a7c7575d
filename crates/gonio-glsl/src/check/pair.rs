//! Checks that a vertex and a fragment shader agree.

use std::collections::HashMap;

use super::{Checked, Storage, Variable};
use crate::{Problem, Type};

/// Returns problems between the two stages, with positions in the fragment shader unless the message says otherwise.
#[must_use]
pub fn check_pair(vertex: &Checked, fragment: &Checked) -> Vec<Problem> {
    let mut problems = Vec::new();
    let outputs = &vertex.interface.outputs;
    let by_name: HashMap<&str, &Variable> = outputs.iter().map(|o| (&*o.name, o)).collect();
    for input in &fragment.interface.inputs {
        let name = &input.name;
        match by_name.get(&**name) {
            None if input.location.is_some() && outputs.iter().any(|o| o.location == input.location) => {}
            None => {
                let message = format!("the input `{name}` is not an output of the vertex shader");
                let near = crate::nearest::nearest(name, outputs.iter().map(|o| &*o.name));
                let mut problem = Problem::error(input.span, "not-given", message);
                if let Some(near) = near {
                    problem = problem.with_help(format!("the vertex shader has the output `{near}`"));
                }
                // A linker may omit an unused input.
                if !input.is_used {
                    problem.severity = crate::Severity::Strict;
                }
                problems.push(problem);
            }
            Some(output) => compare(&mut problems, output, input),
        }
    }
    blocks(&mut problems, vertex, fragment);
    uniforms(&mut problems, vertex, fragment);
    problems
}

fn written(ty: Option<&Type>) -> String {
    ty.map_or_else(|| "?".into(), Type::written)
}

fn compare(problems: &mut Vec<Problem>, output: &Variable, input: &Variable) {
    let name = &input.name;
    if let (Some(a), Some(b)) = (&output.ty, &input.ty)
        && a != b
    {
        let message = format!("`{name}` is a `{b}` here and a `{a}` in the vertex shader, line {}", output.span.line);
        problems.push(Problem::error(input.span, "other-type", message));
        return;
    }
    if !output.is_used && input.is_used {
        let message = format!("the vertex shader, line {}, never assigns a value to `{name}`", output.span.line);
        problems.push(Problem::strict(input.span, "never-given", message));
    }
    let way = |v: &Variable| v.interpolation.clone().unwrap_or_else(|| "smooth".into());
    if way(output) != way(input) {
        let message = format!("`{name}` is `{}` here and `{}` in the vertex shader", way(input), way(output));
        problems.push(Problem::strict(input.span, "other-interpolation", message));
    }
    if output.location != input.location {
        let message = format!("`{name}` has another `location` in the vertex shader");
        problems.push(Problem::strict(input.span, "other-location", message));
    }
}

fn blocks(problems: &mut Vec<Problem>, vertex: &Checked, fragment: &Checked) {
    for block in fragment.interface.blocks.iter().filter(|b| b.storage == Storage::In) {
        let other = vertex.interface.blocks.iter().find(|b| b.storage == Storage::Out && b.name == block.name);
        let Some(other) = other else {
            let message = format!("the input block `{}` is not an output of the vertex shader", block.name);
            problems.push(Problem::error(block.span, "not-given", message));
            continue;
        };
        let members = |b: &super::Block| b.members.iter().map(|m| (m.name.clone(), m.ty.clone())).collect::<Vec<_>>();
        if members(block) != members(other) {
            let message = format!("the block `{}` is declared differently in the vertex shader", block.name);
            problems.push(Problem::error(block.span, "other-type", message));
        }
    }
}

fn uniforms(problems: &mut Vec<Problem>, vertex: &Checked, fragment: &Checked) {
    let by_name: HashMap<&str, &Variable> = vertex.interface.uniforms.iter().map(|u| (&*u.name, u)).collect();
    for uniform in &fragment.interface.uniforms {
        let Some(other) = by_name.get(&*uniform.name) else { continue };
        if let (Some(a), Some(b)) = (&other.ty, &uniform.ty)
            && a != b
        {
            let (a, b) = (written(Some(a)), written(Some(b)));
            let message = format!("the uniform `{}` is a `{b}` here and a `{a}` in the vertex shader", uniform.name);
            problems.push(Problem::error(uniform.span, "other-type", message));
        }
    }
}
