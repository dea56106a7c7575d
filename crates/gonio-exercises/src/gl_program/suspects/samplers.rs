//! Samplers, units, and how the one comes to the other.

use super::{Case, Suspect, known};
use gonio_render::gl_program::{Call, Number, ObjectKind, Selector, UniformArgument, texture_unit};
use std::collections::BTreeSet;

/// Adds what may be wrong with samplers.
pub fn suspect(case: &Case<'_>, found: &mut Vec<Suspect>) {
    let samplers = samplers(case);
    let units = units(case);
    let textures = case.objects(ObjectKind::Texture);
    let sets: Vec<(usize, &str, &UniformArgument)> = case
        .steps
        .iter()
        .enumerate()
        .filter_map(|(at, step)| match &step.call {
            Call::Uniform { uniform, given } => Some((at, uniform.as_str(), given)),
            _ => None,
        })
        .collect();
    for &(at, uniform, given) in &sets {
        if !samplers.iter().any(|sampler| sampler == uniform) {
            unknown_name(case, at, given, &samplers, found);
            continue;
        }
        if at > case.draw {
            let said = format!("the draw in line {} has already read `{uniform}`", case.line(case.draw));
            let corrected = case.moved(at, case.draw);
            found.push(case.suspect("uniform-after-draw", at, said, "write it before the draw", corrected));
        }
        if case.refused(at).is_some_and(|error| error.code == "INVALID_OPERATION") {
            before_use(case, at, uniform, found);
        }
        match given {
            UniformArgument::Whole(Number::Variable(name)) if textures.contains(&name.as_str()) => {
                for &unit in &units {
                    let said =
                        format!("`{uniform}` is set to `{name}`, the name of a texture, which is bound to unit {unit}");
                    let fix = format!("write `uniform_1i {uniform} {unit}`");
                    let corrected = case.replaced(at, set(uniform, unit));
                    found.push(case.suspect("texture-name-as-unit", at, said, fix, corrected));
                }
            }
            UniformArgument::Floats(_) => {
                for &unit in &units {
                    let fix = format!("write `uniform_1i {uniform} {unit}`");
                    let said = format!("`{uniform}` is a sampler, and a sampler is an integer");
                    let corrected = case.replaced(at, set(uniform, unit));
                    found.push(case.suspect("uniform-type-wrong", at, said, fix, corrected));
                }
            }
            UniformArgument::Whole(_) => {}
        }
    }
    active_after_bind(case, found);
    active_number(case, found);
    for &(at, uniform, given) in &sets {
        let UniformArgument::Whole(number) = given else { continue };
        let value = match number {
            Number::Literal(value) => value.to_string(),
            Number::Variable(name) if textures.contains(&name.as_str()) => continue,
            Number::Variable(name) => format!("`{name}`"),
        };
        for &unit in units.iter().filter(|unit| *number != Number::Literal(**unit as i32)) {
            if samplers.iter().any(|sampler| sampler == uniform) {
                let said = format!("`{uniform}` reads unit {value}, and the texture is bound to unit {unit}");
                let fix = format!("write `uniform_1i {uniform} {unit}`, or bind the texture to unit {value}");
                let corrected = case.replaced(at, set(uniform, unit));
                found.push(case.suspect("unbound-unit", at, said, fix, corrected));
            }
        }
    }
    never_set(case, &samplers, &units, found);
}

/// Names of samplers that the drawing program needs; where nothing drew, the reference's.
fn samplers(case: &Case<'_>) -> Vec<String> {
    let drawn = case.run.record.draws.last().and_then(|draw| case.run.record.program_of(draw));
    if let Some(program) = drawn {
        let samplers = program.uniforms.iter().filter(|uniform| uniform.glsl_type.contains("sampler"));
        return samplers.map(|uniform| uniform.name.clone()).collect();
    }
    let reference = case.reference.iter().filter_map(|step| match &step.call {
        Call::Uniform { uniform, given: UniformArgument::Whole(_) } => Some(uniform.clone()),
        _ => None,
    });
    reference.collect()
}

/// Units that are ever made active, and 0, which is from the start.
fn units(case: &Case<'_>) -> BTreeSet<u32> {
    let active = case.steps.iter().filter_map(|step| match &step.call {
        Call::ActiveTexture(Selector::Constant(constant)) => constant.unit(),
        _ => None,
    });
    active.chain([0]).collect()
}

fn set(uniform: &str, unit: u32) -> Call {
    Call::Uniform { uniform: uniform.to_owned(), given: UniformArgument::Whole(Number::Literal(unit as i32)) }
}

fn unknown_name(case: &Case<'_>, at: usize, given: &UniformArgument, samplers: &[String], found: &mut Vec<Suspect>) {
    let Some(Call::Uniform { uniform, .. }) = case.steps.get(at).map(|step| &step.call) else { return };
    for sampler in samplers {
        let call = Call::Uniform { uniform: sampler.clone(), given: given.clone() };
        let said = format!("the program has no uniform `{uniform}`; its sampler is `{sampler}`");
        let fix = format!("write `{sampler}`");
        found.push(case.suspect("uniform-name-wrong", at, said, fix, case.replaced(at, call)));
    }
}

fn before_use(case: &Case<'_>, at: usize, uniform: &str, found: &mut Vec<Suspect>) {
    let later = case.before().skip(at + 1);
    let mut uses = later.filter(|(_, step)| matches!(&step.call, Call::UseProgram(p) if *p != Number::Literal(0)));
    let Some((used, step)) = uses.next() else { return };
    let said = format!("no program is in use here: use_program comes in line {}, and `{uniform}` stays 0", step.line);
    let fix = format!("write it after use_program in line {}", step.line);
    found.push(case.suspect("uniform-before-use-program", at, said, fix, case.moved(at, used + 1)));
}

/// The unit is made active when the texture is bound already, and nothing is bound after that.
fn active_after_bind(case: &Case<'_>, found: &mut Vec<Suspect>) {
    let Some(bind) = case.last(|call| matches!(call, Call::BindTexture { .. })) else { return };
    for (at, step) in case.before().skip(bind + 1) {
        let Call::ActiveTexture(Selector::Constant(unit)) = &step.call else { continue };
        let said =
            format!("{} is made active when the texture is bound already, in line {}", unit.name, case.line(bind));
        let fix = format!("write it before bind_texture in line {}", case.line(bind));
        found.push(case.suspect("active-texture-after-bind", at, said, fix, case.moved(at, bind)));
    }
}

fn active_number(case: &Case<'_>, found: &mut Vec<Suspect>) {
    for (at, step) in case.before() {
        let Call::ActiveTexture(Selector::Number(number)) = &step.call else { continue };
        let unit = match number {
            Number::Literal(value) => u32::try_from(*value).unwrap_or(0),
            Number::Variable(_) => 0,
        };
        let unit = texture_unit(unit).unwrap_or(known("TEXTURE0"));
        let said = format!("a plain number is not a unit, and OpenGL rejects it; {} is one", unit.name);
        let corrected = case.replaced(at, Call::ActiveTexture(Selector::Constant(unit)));
        found.push(case.suspect("active-texture-number", at, said, format!("write {}", unit.name), corrected));
    }
}

fn never_set(case: &Case<'_>, samplers: &[String], units: &BTreeSet<u32>, found: &mut Vec<Suspect>) {
    let is_set = |sampler: &String| {
        case.steps.iter().any(|step| matches!(&step.call, Call::Uniform { uniform, .. } if uniform == sampler))
    };
    let used = case.last(|call| matches!(call, Call::UseProgram(_))).unwrap_or(case.draw);
    for sampler in samplers.iter().filter(|sampler| !is_set(sampler)) {
        for &unit in units.iter().filter(|unit| **unit != 0) {
            let said = format!("`{sampler}` is never set and reads unit 0, and the texture is bound to unit {unit}");
            let fix = format!("write `uniform_1i {sampler} {unit}` after use_program");
            let corrected = case.inserted(case.draw, [set(sampler, unit)]);
            found.push(case.suspect("sampler-never-set", used, said, fix, corrected));
        }
    }
}
