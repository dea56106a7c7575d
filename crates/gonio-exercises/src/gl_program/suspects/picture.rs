//! Mistakes with indices, programs, draws, the viewport, clearing and tests.

use super::{Case, Suspect, known};
use gonio_language::tr;
use gonio_render::gl_program::{Constant, GlCall, IntArgument, ObjectKind};

/// Adds the suspects about the picture as a whole.
pub fn suspect(case: &Case<'_>, found: &mut Vec<Suspect>) {
    indices(case, found);
    program(case, found);
    viewport(case, found);
    clears(case, found);
    clear_color(case, found);
    switches(case, found);
    draws(case, found);
}

fn indices(case: &Case<'_>, found: &mut Vec<Suspect>) {
    let Some(GlCall::DrawElements { mode, count, kind, offset }) = case.steps.get(case.draw).map(|step| &step.call)
    else {
        return;
    };
    let draw = |kind: Constant, offset: i32| {
        case.replaced(case.draw, GlCall::DrawElements { mode: *mode, count: *count, kind, offset })
    };
    let whole = known("UNSIGNED_INT");
    if *kind != whole {
        let message = tr!("check-gl-the-index-buffer-contains-unsigned-int", name = kind.name);
        found.push(case.suspect(
            "index-type-wrong",
            case.draw,
            message,
            tr!("check-gl-write-unsigned-int"),
            draw(whole, *offset),
        ));
    }
    if *offset != 0 {
        let message = tr!("check-gl-the-draw-begins-at-byte-of", offset = offset);
        found.push(case.suspect("index-offset-wrong", case.draw, message, tr!("check-gl-write-0"), draw(*kind, 0)));
    }
    for (at, step) in case.before() {
        let GlCall::Indices { name, numbers } = &step.call else { continue };
        if numbers.iter().all(|index| *index > 0) {
            let from_zero = numbers.iter().map(|index| index - 1).collect();
            let call = GlCall::Indices { name: name.clone(), numbers: from_zero };
            let message = tr!("check-gl-the-indices-in-start-at-1", name = name);
            let corrected = case.replaced(at, call);
            found.push(case.suspect("indices-from-one", at, message, tr!("check-gl-subtract-1-from-each"), corrected));
        }
        let mut sorted = numbers.clone();
        sorted.sort_unstable();
        // The same corners in another order are not a mistake in themselves.
        if sorted == [0, 1, 2] {
            continue;
        }
        let call = GlCall::Indices { name: name.clone(), numbers: vec![0, 1, 2] };
        let message = tr!("check-gl-contains-other-corners-than-0-1", name = name);
        found.push(case.suspect("indices-changed", at, message, tr!("check-gl-write-0-1-2"), case.replaced(at, call)));
    }
    for buffer in case.objects(ObjectKind::Buffer) {
        let call = GlCall::BindBuffer {
            target: known("ELEMENT_ARRAY_BUFFER"),
            buffer: IntArgument::Variable(buffer.to_owned()),
        };
        let message = tr!("check-gl-no-element-array-buffer-or-another");
        let fix = tr!("check-gl-write-bind-buffer-element-array-buffer", buffer = buffer);
        let corrected = case.inserted(case.draw, [call]);
        found.push(case.suspect("index-buffer-not-bound", case.draw, message, fix, corrected));
    }
}

fn program(case: &Case<'_>, found: &mut Vec<Suspect>) {
    let created: Vec<(usize, &String)> = case
        .steps
        .iter()
        .enumerate()
        .filter_map(
            |(at, step)| if let GlCall::CreateProgram { name, .. } = &step.call { Some((at, name)) } else { None },
        )
        .collect();
    let Some(&(made, name)) = created.last() else { return };
    let right = IntArgument::Variable(name.clone());
    let uses: Vec<(usize, &IntArgument)> = case
        .steps
        .iter()
        .enumerate()
        .filter_map(|(at, step)| if let GlCall::UseProgram(number) = &step.call { Some((at, number)) } else { None })
        .collect();
    if uses.is_empty() {
        let corrected = case.inserted(made + 1, [GlCall::UseProgram(right.clone())]);
        let message = tr!("check-gl-is-created-but-never-used", name = name);
        let fix = tr!("check-gl-write-use-program-before-the-uniforms", name = name);
        found.push(case.suspect("program-not-used", made, message, fix, corrected));
    }
    for (at, number) in uses {
        if *number == IntArgument::Literal(0) {
            let message = tr!("check-gl-0-unbinds-the-program-and-the");
            found.push(case.suspect("program-switched-off", at, message, tr!("check-gl-remove-it"), case.without(at)));
        } else if *number != right {
            let corrected = case.replaced(at, GlCall::UseProgram(right.clone()));
            let message = tr!("check-gl-this-is-not-the-number-of", name = name);
            found.push(case.suspect(
                "program-number-wrong",
                at,
                message,
                tr!("check-gl-write-use-program", name = name),
                corrected,
            ));
        }
    }
}

fn viewport(case: &Case<'_>, found: &mut Vec<Suspect>) {
    for (at, step) in case.before() {
        let GlCall::Viewport([x, y, width, height]) = step.call else { continue };
        let message = tr!("check-gl-the-picture-is-drawn-into-x", width = width, height = height, x = x, y = y);
        let fix = tr!("check-gl-set-it-to-0-0-and");
        found.push(case.suspect("viewport-wrong", at, message, fix, case.without(at)));
    }
}

fn clears(case: &Case<'_>, found: &mut Vec<Suspect>) {
    let color = known("COLOR_BUFFER_BIT");
    let clears_color = |call: &GlCall| matches!(call, GlCall::Clear(bits) if bits.contains(&color));
    let first_draw = case.first(GlCall::draws).unwrap_or(case.steps.len());
    let clears: Vec<usize> = (0..case.steps.len()).filter(|at| clears_color(&case.steps[*at].call)).collect();
    for &at in clears.iter().filter(|at| **at > first_draw) {
        let message = tr!("check-gl-this-clears-what-line-has-drawn", line = case.line(first_draw));
        let corrected = case.moved(at, first_draw);
        found.push(case.suspect("clear-after-draw", at, message, tr!("check-gl-write-it-before-the-draw"), corrected));
    }
    if clears.is_empty() {
        let message = tr!("check-gl-the-picture-keeps-its-previous-content");
        let corrected = case.inserted(first_draw, [GlCall::Clear(vec![color])]);
        let fix = tr!("check-gl-write-clear-color-buffer-bit-before");
        found.push(case.suspect("clear-missing", first_draw, message, fix, corrected));
    }
}

fn clear_color(case: &Case<'_>, found: &mut Vec<Suspect>) {
    let right = case.reference.iter().find_map(|step| match step.call {
        GlCall::ClearColor(color) => Some(color),
        _ => None,
    });
    let Some(right) = right else { return };
    let Some(clear) = case.first(|call| matches!(call, GlCall::Clear(_))) else { return };
    let [r, g, b, a] = right;
    let fix = tr!("check-gl-write-clear-color", r = r, g = g, b = b, a = a);
    let Some(at) = case.first(|call| matches!(call, GlCall::ClearColor(_))) else {
        let corrected = case.inserted(clear, [GlCall::ClearColor(right)]);
        let message = tr!("check-gl-no-clear-color-comes-before-this");
        found.push(case.suspect("clear-color-wrong", clear, message, fix, corrected));
        return;
    };
    if at > clear {
        let message = tr!("check-gl-clear-in-line-uses-the-colour", line = case.line(clear));
        found.push(case.suspect(
            "clear-color-late",
            at,
            message,
            tr!("check-gl-write-it-before-clear"),
            case.moved(at, clear),
        ));
    }
    for (at, step) in case.before() {
        if matches!(step.call, GlCall::ClearColor(color) if color != right) {
            let message = tr!("check-gl-the-background-is-not-the-exercise");
            let corrected = case.replaced(at, GlCall::ClearColor(right));
            found.push(case.suspect("clear-color-wrong", at, message, fix.clone(), corrected));
        }
    }
}

fn switches(case: &Case<'_>, found: &mut Vec<Suspect>) {
    for (at, step) in case.before() {
        let GlCall::Switch { what, on: true } = &step.call else { continue };
        if what.name == "CULL_FACE" {
            let message = tr!("check-gl-the-triangle-s-corners-are-clockwise");
            found.push(case.suspect("culled", at, message, tr!("check-gl-remove-it"), case.without(at)));
        }
    }
}

fn draws(case: &Case<'_>, found: &mut Vec<Suspect>) {
    let right = case.reference.iter().find(|step| step.call.draws()).map(|step| step.call.clone());
    let Some(right @ GlCall::DrawArrays { mode, first, count }) = right else { return };
    let Some(step) = case.steps.get(case.draw) else {
        let corrected = case.inserted(case.steps.len(), [right]);
        let at = case.steps.len();
        let fix = tr!("check-gl-write-draw-arrays-at-the-end", name = mode.name, first = first, count = count);
        found.push(case.suspect("draw-missing", at, tr!("check-gl-no-call-draws-anything"), fix, corrected));
        return;
    };
    let mut add = |id: &'static str, call: GlCall, message: String, fix: String| {
        found.push(case.suspect(id, case.draw, message, fix, case.replaced(case.draw, call)));
    };
    match step.call.clone() {
        GlCall::DrawArrays { mode: mine, first: from, count: many } => {
            if many != count {
                let call = GlCall::DrawArrays { mode: mine, first: from, count };
                let message = tr!("check-gl-vertices-are-drawn-but-there-are", many = many, count = count);
                add("draw-count-wrong", call, message, tr!("check-gl-write-plain", text = count));
            }
            if from != first {
                let call = GlCall::DrawArrays { mode: mine, first, count: many };
                add(
                    "draw-first-wrong",
                    call,
                    tr!("check-gl-the-draw-begins-at-vertex", from = from),
                    tr!("check-gl-write-plain", text = first),
                );
            }
            if mine != mode {
                let call = GlCall::DrawArrays { mode, first: from, count: many };
                let message = tr!("check-gl-joins-the-corners-in-another-way", name = mine.name, name2 = mode.name);
                add("draw-mode-wrong", call, message, tr!("check-gl-write-plain", text = mode.name));
            }
        }
        GlCall::DrawElements { mode: mine, count: many, kind, offset } => {
            if many != count {
                let call = GlCall::DrawElements { mode: mine, count, kind, offset };
                let message = tr!("check-gl-indices-are-drawn-but-there-are", many = many, count = count);
                add("draw-count-wrong", call, message, tr!("check-gl-write-plain", text = count));
            }
            if mine != mode {
                let call = GlCall::DrawElements { mode, count: many, kind, offset };
                let message = tr!("check-gl-joins-the-corners-in-another-way", name = mine.name, name2 = mode.name);
                add("draw-mode-wrong", call, message, tr!("check-gl-write-plain", text = mode.name));
            }
        }
        _ => {}
    }
    if case.draw + 1 < case.steps.len() {
        let message = tr!("check-gl-the-calls-that-follow-are-meant");
        let corrected = case.moved(case.draw, case.steps.len());
        found.push(case.suspect("draw-too-early", case.draw, message, tr!("check-gl-write-it-at-the-end"), corrected));
    }
}
