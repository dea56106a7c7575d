//! Samplers and their units, and textures: bound, filled, filtered, and there when they are read.

use super::{Case, Suspect, known};
use gonio_language::tr;
use gonio_render::gl_program::{
    Constant, GlCall, IntArgument, ObjectKind, Selector, Step, UniformArgument, texture_unit,
};
use std::collections::BTreeSet;

/// Adds the suspects about samplers, units and textures.
pub fn suspect(case: &Case<'_>, found: &mut Vec<Suspect>) {
    samplers_and_units(case, found);
    deleted(case, found);
    targets(case, found);
    bindings(case, found);
    filters(case, found);
    mipmaps(case, found);
    images(case, found);
}

fn samplers_and_units(case: &Case<'_>, found: &mut Vec<Suspect>) {
    let samplers = samplers(case);
    let units = units(case);
    let textures = case.objects(ObjectKind::Texture);
    let sets: Vec<(usize, &str, &UniformArgument)> = case
        .steps
        .iter()
        .enumerate()
        .filter_map(|(at, step)| match &step.call {
            GlCall::Uniform { uniform, given } => Some((at, uniform.as_str(), given)),
            _ => None,
        })
        .collect();
    for &(at, uniform, given) in &sets {
        if !samplers.iter().any(|sampler| sampler == uniform) {
            unknown_name(case, at, given, &samplers, found);
            continue;
        }
        if at > case.draw {
            let message = tr!("check-gl-the-draw-in-line-has-already", draw = case.line(case.draw), uniform = uniform);
            let corrected = case.moved(at, case.draw);
            found.push(case.suspect(
                "uniform-after-draw",
                at,
                message,
                tr!("check-gl-write-it-before-the-draw"),
                corrected,
            ));
        }
        if case.refused(at).is_some_and(|error| error.code == "INVALID_OPERATION") {
            before_use(case, at, uniform, found);
        }
        match given {
            UniformArgument::Whole(IntArgument::Variable(name)) if textures.contains(&name.as_str()) => {
                for &unit in &units {
                    let message = tr!("check-gl-is-set-to-the-name-of", uniform = uniform, name = name, unit = unit);
                    let fix = tr!("check-gl-write-uniform-1i", uniform = uniform, unit = unit);
                    let corrected = case.replaced(at, set(uniform, unit));
                    found.push(case.suspect("texture-name-as-unit", at, message, fix, corrected));
                }
            }
            UniformArgument::Floats(_) => {
                for &unit in &units {
                    let fix = tr!("check-gl-write-uniform-1i", uniform = uniform, unit = unit);
                    let message = tr!("check-gl-is-a-sampler-and-a-sampler", uniform = uniform);
                    let corrected = case.replaced(at, set(uniform, unit));
                    found.push(case.suspect("uniform-type-wrong", at, message, fix, corrected));
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
            IntArgument::Literal(value) => value.to_string(),
            IntArgument::Variable(name) if textures.contains(&name.as_str()) => continue,
            IntArgument::Variable(name) => format!("`{name}`"),
        };
        for &unit in units.iter().filter(|unit| *number != IntArgument::Literal(**unit as i32)) {
            if samplers.iter().any(|sampler| sampler == uniform) {
                let message =
                    tr!("check-gl-reads-unit-but-the-texture-is", uniform = uniform, value = value, unit = unit);
                let fix = tr!("check-gl-write-uniform-1i-or-bind-the", uniform = uniform, unit = unit, value = value);
                let corrected = case.replaced(at, set(uniform, unit));
                found.push(case.suspect("unbound-unit", at, message, fix, corrected));
            }
        }
    }
    never_set(case, &samplers, &units, found);
}

/// Names of the samplers of the program that draws; those of the reference if nothing was drawn.
fn samplers(case: &Case<'_>) -> Vec<String> {
    let drawn = case.run.record.draws.last().and_then(|draw| case.run.record.program_of(draw));
    if let Some(program) = drawn {
        let samplers = program.uniforms.iter().filter(|uniform| uniform.glsl_type.contains("sampler"));
        return samplers.map(|uniform| uniform.name.clone()).collect();
    }
    let reference = case.reference.iter().filter_map(|step| match &step.call {
        GlCall::Uniform { uniform, given: UniformArgument::Whole(_) } => Some(uniform.clone()),
        _ => None,
    });
    reference.collect()
}

/// Units that are made active, and 0, which is active from the start.
fn units(case: &Case<'_>) -> BTreeSet<u32> {
    let active = case.steps.iter().filter_map(|step| match &step.call {
        GlCall::ActiveTexture(Selector::Constant(constant)) => constant.unit(),
        _ => None,
    });
    active.chain([0]).collect()
}

fn set(uniform: &str, unit: u32) -> GlCall {
    GlCall::Uniform { uniform: uniform.to_owned(), given: UniformArgument::Whole(IntArgument::Literal(unit as i32)) }
}

fn unknown_name(case: &Case<'_>, at: usize, given: &UniformArgument, samplers: &[String], found: &mut Vec<Suspect>) {
    let Some(GlCall::Uniform { uniform, .. }) = case.steps.get(at).map(|step| &step.call) else { return };
    for sampler in samplers {
        let call = GlCall::Uniform { uniform: sampler.clone(), given: given.clone() };
        let message = tr!("check-gl-the-program-has-no-uniform-its", uniform = uniform, sampler = sampler);
        let fix = tr!("check-gl-write", text = sampler);
        found.push(case.suspect("uniform-name-wrong", at, message, fix, case.replaced(at, call)));
    }
}

fn before_use(case: &Case<'_>, at: usize, uniform: &str, found: &mut Vec<Suspect>) {
    let later = case.before().skip(at + 1);
    let mut uses =
        later.filter(|(_, step)| matches!(&step.call, GlCall::UseProgram(p) if *p != IntArgument::Literal(0)));
    let Some((used, step)) = uses.next() else { return };
    let message = tr!("check-gl-no-program-is-in-use-here", line = step.line, uniform = uniform);
    let fix = tr!("check-gl-write-it-after-use-program-in", line = step.line);
    found.push(case.suspect("uniform-before-use-program", at, message, fix, case.moved(at, used + 1)));
}

/// The unit is made active only after the texture was bound, and nothing is bound after that.
fn active_after_bind(case: &Case<'_>, found: &mut Vec<Suspect>) {
    let Some(bind) = case.last(|call| matches!(call, GlCall::BindTexture { .. })) else { return };
    for (at, step) in case.before().skip(bind + 1) {
        let GlCall::ActiveTexture(Selector::Constant(unit)) = &step.call else { continue };
        let message = tr!("check-gl-is-made-active-only-after-the", name = unit.name, bind = case.line(bind));
        let fix = tr!("check-gl-write-it-before-bind-texture-in", bind = case.line(bind));
        found.push(case.suspect("active-texture-after-bind", at, message, fix, case.moved(at, bind)));
    }
}

fn active_number(case: &Case<'_>, found: &mut Vec<Suspect>) {
    for (at, step) in case.before() {
        let GlCall::ActiveTexture(Selector::Number(number)) = &step.call else { continue };
        let unit = match number {
            IntArgument::Literal(value) => u32::try_from(*value).unwrap_or(0),
            IntArgument::Variable(_) => 0,
        };
        let unit = texture_unit(unit).unwrap_or(known("TEXTURE0"));
        let message = tr!("check-gl-a-plain-number-is-not-a", name = unit.name);
        let corrected = case.replaced(at, GlCall::ActiveTexture(Selector::Constant(unit)));
        found.push(case.suspect(
            "active-texture-number",
            at,
            message,
            tr!("check-gl-write-plain", text = unit.name),
            corrected,
        ));
    }
}

fn never_set(case: &Case<'_>, samplers: &[String], units: &BTreeSet<u32>, found: &mut Vec<Suspect>) {
    let is_set = |sampler: &String| {
        case.steps.iter().any(|step| matches!(&step.call, GlCall::Uniform { uniform, .. } if uniform == sampler))
    };
    let used = case.last(|call| matches!(call, GlCall::UseProgram(_))).unwrap_or(case.draw);
    for sampler in samplers.iter().filter(|sampler| !is_set(sampler)) {
        for &unit in units.iter().filter(|unit| **unit != 0) {
            let message = tr!("check-gl-is-never-set-and-reads-unit", sampler = sampler, unit = unit);
            let fix = tr!("check-gl-write-uniform-1i-after-use-program", sampler = sampler, unit = unit);
            let corrected = case.inserted(case.draw, [set(sampler, unit)]);
            found.push(case.suspect("sampler-never-set", used, message, fix, corrected));
        }
    }
}

/// Deleted textures, buffers and vertex arrays.
fn deleted(case: &Case<'_>, found: &mut Vec<Suspect>) {
    for (at, step) in case.before() {
        let GlCall::Delete { kind, .. } = &step.call else { continue };
        let line = case.line(case.draw);
        let (id, message) = match kind {
            ObjectKind::Texture => ("texture-deleted", tr!("check-gl-texture-is-deleted", line = line)),
            ObjectKind::Buffer => ("buffer-deleted", tr!("check-gl-buffer-is-deleted", line = line)),
            ObjectKind::VertexArray => ("vertex-array-deleted", tr!("check-gl-vertex-array-is-deleted", line = line)),
        };
        found.push(case.suspect(id, at, message, tr!("check-gl-delete-it-after-the-draw"), case.without(at)));
    }
}

/// The target of a call for textures.
fn target_of(call: &mut GlCall) -> Option<&mut Constant> {
    match call {
        GlCall::BindTexture { target, .. }
        | GlCall::TexImage2d { target, .. }
        | GlCall::TexParameter { target, .. }
        | GlCall::GenerateMipmap { target } => Some(target),
        _ => None,
    }
}

/// All calls with the target of another kind of texture together, and each such call alone.
fn targets(case: &Case<'_>, found: &mut Vec<Suspect>) {
    let flat = known("TEXTURE_2D");
    let is_other = |call: &GlCall| target_of(&mut call.clone()).is_some_and(|target| *target != flat);
    let others: Vec<usize> = (0..case.steps.len()).filter(|at| is_other(&case.steps[*at].call)).collect();
    let turn = |only: Option<usize>| {
        case.changed(|at, call| {
            let meant = only.is_none_or(|only| only == at);
            let other = target_of(call).filter(|target| meant && **target != flat);
            other.is_some_and(|target| {
                *target = flat;
                true
            })
        })
    };
    let alone = if others.len() > 1 { others.clone() } else { Vec::new() };
    for only in std::iter::once(None).chain(alone.into_iter().map(Some)) {
        let Some((at, corrected)) = turn(only) else { continue };
        let written = target_of(&mut case.steps[at].call.clone()).map_or("", |target| target.name);
        let message = tr!("check-gl-is-the-target-of-another-kind", written = written);
        let fix = match only {
            None if others.len() > 1 => tr!("check-gl-write-texture-2d-in-this-line"),
            _ => tr!("check-gl-write-texture-2d"),
        };
        found.push(case.suspect("wrong-target", at, message, fix, corrected));
    }
}

fn bindings(case: &Case<'_>, found: &mut Vec<Suspect>) {
    let textures = case.objects(ObjectKind::Texture);
    let binds: Vec<usize> =
        case.before().filter(|(_, step)| matches!(step.call, GlCall::BindTexture { .. })).map(|(at, _)| at).collect();
    let for_texture = |call: &GlCall| {
        matches!(call, GlCall::TexImage2d { .. } | GlCall::TexParameter { .. } | GlCall::GenerateMipmap { .. })
    };
    let first_for = case.first(for_texture);
    if binds.is_empty() {
        for name in &textures {
            let call =
                GlCall::BindTexture { target: known("TEXTURE_2D"), texture: IntArgument::Variable((*name).to_owned()) };
            let place = first_for.unwrap_or(case.draw);
            let line =
                case.first(|call| matches!(call, GlCall::Generate { name: made, .. } if made == name)).unwrap_or(0);
            let fix = tr!("check-gl-write-bind-texture-texture-2d-before", name = name);
            let message = tr!("check-gl-the-texture-is-never-bound", name = name);
            found.push(case.suspect("texture-not-bound", line, message, fix, case.inserted(place, [call])));
        }
    }
    if let (Some(&bind), Some(first)) = (binds.first(), first_for)
        && first < bind
    {
        let message = tr!("check-gl-the-call-in-line-is-meant", first = case.line(first));
        let fix = tr!("check-gl-write-it-before-line", line = case.line(first));
        found.push(case.suspect("texture-bound-late", bind, message, fix, case.moved(bind, first)));
    }
    for &at in &binds {
        let GlCall::BindTexture { target, texture } = &case.steps[at].call else { continue };
        if *texture == IntArgument::Literal(0) {
            let message = tr!("check-gl-0-unbinds-the-texture-so-the");
            found.push(case.suspect("texture-unbound", at, message, tr!("check-gl-remove-it"), case.without(at)));
            continue;
        }
        if binds.len() > 1 && binds.first() != Some(&at) {
            let free = GlCall::ActiveTexture(Selector::Constant(known("TEXTURE15")));
            let message = tr!("check-gl-this-texture-replaces-the-one-to");
            let fix = tr!("check-gl-call-active-texture-with-another-unit");
            found.push(case.suspect("other-texture-bound", at, message, fix, case.inserted(at, [free])));
            let fix = tr!("check-gl-remove-it");
            found.push(case.suspect("other-texture-bound", at, message, fix, case.without(at)));
        }
        for name in &textures {
            if *texture != IntArgument::Variable((*name).to_owned()) {
                let call = GlCall::BindTexture { target: *target, texture: IntArgument::Variable((*name).to_owned()) };
                let message = tr!("check-gl-should-be-drawn-but-something-else", name = name);
                let fix = tr!("check-gl-write-bind-texture", name = target.name, name2 = name);
                found.push(case.suspect("other-texture-bound", at, message, fix, case.replaced(at, call)));
            }
        }
    }
}

fn filters(case: &Case<'_>, found: &mut Vec<Suspect>) {
    for (at, step) in case.before() {
        let GlCall::TexParameter { target, parameter, value } = &step.call else { continue };
        let Selector::Constant(set) = value else {
            if parameter.name.ends_with("LEVEL") {
                let message = tr!("check-gl-with-this-levels-are-read-that", name = parameter.name);
                found.push(case.suspect("level-range-wrong", at, message, tr!("check-gl-remove-it"), case.without(at)));
            }
            continue;
        };
        if case.refused(at).is_some() && parameter.name == "TEXTURE_MAG_FILTER" && set.name.contains("MIPMAP") {
            let parameter = known("TEXTURE_MIN_FILTER");
            let call = GlCall::TexParameter { target: *target, parameter, value: value.clone() };
            let message = tr!("check-gl-opengl-rejects-for-texture-mag-filter", name = set.name);
            found.push(case.suspect(
                "filter-refused",
                at,
                message,
                tr!("check-gl-write-texture-min-filter"),
                case.replaced(at, call),
            ));
        }
        if case.refused(at).is_some() && parameter.name == "TEXTURE_MIN_FILTER" {
            let value = Selector::Constant(known("LINEAR"));
            let call = GlCall::TexParameter { target: *target, parameter: *parameter, value };
            let message = tr!("check-gl-opengl-rejects-and-texture-min-filter", name = set.name);
            found.push(case.suspect(
                "filter-refused",
                at,
                message,
                tr!("check-gl-write-linear"),
                case.replaced(at, call),
            ));
        }
    }
}

fn mipmaps(case: &Case<'_>, found: &mut Vec<Suspect>) {
    let Some(image) = case.last(|call| matches!(call, GlCall::TexImage2d { .. })) else { return };
    let Some(made) = case.first(|call| matches!(call, GlCall::GenerateMipmap { .. })) else {
        let is_filter = |call: &GlCall| matches!(call, GlCall::TexParameter { parameter, .. } if parameter.name == "TEXTURE_MIN_FILTER");
        let set = case.before().find(|(at, step)| is_filter(&step.call) && case.refused(*at).is_none());
        let corrected = case.inserted(image + 1, [GlCall::GenerateMipmap { target: known("TEXTURE_2D") }]);
        found.push(match set {
            Some((_, step)) => case.suspect(
                "mipmaps-missing",
                image,
                tr!("check-gl-the-filter-set-in-line-needs", line = step.line),
                tr!("check-gl-write-generate-mipmap-texture-2d-after"),
                corrected,
            ),
            None => case.suspect(
                "filter-never-set",
                image,
                tr!("check-gl-texture-min-filter-is-never-set"),
                tr!("check-gl-write-tex-parameter-texture-2d-texture"),
                corrected,
            ),
        });
        return;
    };
    if made < image {
        let message = tr!("check-gl-the-image-comes-only-in-line", image = case.line(image));
        let fix = tr!("check-gl-write-it-after-line", image = case.line(image));
        found.push(case.suspect("mipmaps-before-image", made, message, fix, case.moved(made, image + 1)));
    } else if made > image + 1 {
        let message = tr!("check-gl-the-texture-bound-here-is-not", image = case.line(image));
        let fix = tr!("check-gl-write-it-right-after-line", image = case.line(image));
        found.push(case.suspect("mipmaps-misplaced", made, message, fix, case.moved(made, image + 1)));
    }
}

fn images(case: &Case<'_>, found: &mut Vec<Suspect>) {
    let mut any = false;
    for (at, step) in case.steps.iter().enumerate() {
        let GlCall::TexImage2d { target, level, format, image } = &step.call else { continue };
        any = true;
        if !["RGB8", "RGBA8", "RGB", "RGBA"].contains(&format.name) {
            let call =
                GlCall::TexImage2d { target: *target, level: *level, format: known("RGB8"), image: image.clone() };
            let message = tr!("check-gl-the-format-does-not-keep-the", name = format.name);
            found.push(case.suspect(
                "internal-format-wrong",
                at,
                message,
                tr!("check-gl-write-rgb8"),
                case.replaced(at, call),
            ));
        }
        if *level != 0 {
            let call = GlCall::TexImage2d { target: *target, level: 0, format: *format, image: image.clone() };
            let message = tr!("check-gl-the-image-is-passed-to-level", level = level);
            found.push(case.suspect(
                "image-level-wrong",
                at,
                message,
                tr!("check-gl-write-level-0"),
                case.replaced(at, call),
            ));
        }
    }
    let loads = |steps: &[Step]| {
        let load = |step: &Step| match &step.call {
            GlCall::LoadImage { name, file } => Some((name.clone(), file.clone())),
            _ => None,
        };
        steps.iter().filter_map(load).collect::<Vec<_>>()
    };
    // If the right image is loaded too, the mistake is that the wrong texture is read.
    let right = loads(case.reference).into_iter().next();
    let right = right.filter(|(_, right)| !loads(case.steps).iter().any(|(_, file)| file == right));
    for (at, step) in case.steps.iter().enumerate() {
        let (GlCall::LoadImage { name, file }, Some((_, right))) = (&step.call, &right) else { continue };
        if file != right {
            let call = GlCall::LoadImage { name: name.clone(), file: right.clone() };
            let message = tr!("check-gl-is-loaded-but-the-exercise-s", file = file, right = right);
            found.push(case.suspect(
                "image-wrong",
                at,
                message,
                tr!("check-gl-write", text = right),
                case.replaced(at, call),
            ));
        }
    }
    if let (false, Some((image, _))) = (any, loads(case.steps).into_iter().next()) {
        let bind = case.last(|call| matches!(call, GlCall::BindTexture { .. })).unwrap_or(0);
        let call =
            GlCall::TexImage2d { target: known("TEXTURE_2D"), level: 0, format: known("RGB8"), image: image.clone() };
        let fix = tr!("check-gl-write-tex-image-2d-texture-2d", image = image);
        let corrected = case.inserted(bind + 1, [call]);
        found.push(case.suspect(
            "image-missing",
            bind,
            tr!("check-gl-this-texture-never-gets-an-image"),
            fix,
            corrected,
        ));
    }
}
