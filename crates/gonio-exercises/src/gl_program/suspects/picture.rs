//! Mistakes with indices, programs, draws, the viewport, clearing and tests.

use super::{Case, Suspect, known};
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
        let message = format!("the index buffer contains UNSIGNED_INT, but is read as {}", kind.name);
        found.push(case.suspect("index-type-wrong", case.draw, message, "write UNSIGNED_INT", draw(whole, *offset)));
    }
    if *offset != 0 {
        let message = format!("the draw begins at byte {offset} of the index buffer");
        found.push(case.suspect("index-offset-wrong", case.draw, message, "write 0", draw(*kind, 0)));
    }
    for (at, step) in case.before() {
        let GlCall::Indices { name, numbers } = &step.call else { continue };
        if numbers.iter().all(|index| *index > 0) {
            let from_zero = numbers.iter().map(|index| index - 1).collect();
            let call = GlCall::Indices { name: name.clone(), numbers: from_zero };
            let message = format!("the indices in `{name}` start at 1, but the first corner is 0");
            let corrected = case.replaced(at, call);
            found.push(case.suspect("indices-from-one", at, message, "subtract 1 from each", corrected));
        }
        let mut sorted = numbers.clone();
        sorted.sort_unstable();
        // The same corners in another order are not a mistake in themselves.
        if sorted == [0, 1, 2] {
            continue;
        }
        let call = GlCall::Indices { name: name.clone(), numbers: vec![0, 1, 2] };
        let message = format!("`{name}` contains other corners than 0, 1 and 2");
        found.push(case.suspect("indices-changed", at, message, "write 0 1 2", case.replaced(at, call)));
    }
    for buffer in case.objects(ObjectKind::Buffer) {
        let call = GlCall::BindBuffer {
            target: known("ELEMENT_ARRAY_BUFFER"),
            buffer: IntArgument::Variable(buffer.to_owned()),
        };
        let message = "no ELEMENT_ARRAY_BUFFER, or another one, is bound in the vertex array that is drawn";
        let fix = format!("write `bind_buffer ELEMENT_ARRAY_BUFFER {buffer}` after bind_vertex_array");
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
        let message = format!("`{name}` is created but never used");
        let fix = format!("write `use_program {name}` before the uniforms and the draw");
        found.push(case.suspect("program-not-used", made, message, fix, corrected));
    }
    for (at, number) in uses {
        if *number == IntArgument::Literal(0) {
            let message = "0 unbinds the program, and the draw that follows has none";
            found.push(case.suspect("program-switched-off", at, message, "remove it", case.without(at)));
        } else if *number != right {
            let corrected = case.replaced(at, GlCall::UseProgram(right.clone()));
            let message = format!("this is not the number of `{name}`");
            found.push(case.suspect(
                "program-number-wrong",
                at,
                message,
                format!("write `use_program {name}`"),
                corrected,
            ));
        }
    }
}

fn viewport(case: &Case<'_>, found: &mut Vec<Suspect>) {
    for (at, step) in case.before() {
        let GlCall::Viewport([x, y, width, height]) = step.call else { continue };
        let message = format!("the picture is drawn into {width} x {height} pixels at ({x}, {y})");
        let fix = "set it to 0 0 and the picture's width and height, or remove it";
        found.push(case.suspect("viewport-wrong", at, message, fix, case.without(at)));
    }
}

fn clears(case: &Case<'_>, found: &mut Vec<Suspect>) {
    let color = known("COLOR_BUFFER_BIT");
    let clears_color = |call: &GlCall| matches!(call, GlCall::Clear(bits) if bits.contains(&color));
    let first_draw = case.first(GlCall::draws).unwrap_or(case.steps.len());
    let clears: Vec<usize> = (0..case.steps.len()).filter(|at| clears_color(&case.steps[*at].call)).collect();
    for &at in clears.iter().filter(|at| **at > first_draw) {
        let message = format!("this clears what line {} has drawn", case.line(first_draw));
        let corrected = case.moved(at, first_draw);
        found.push(case.suspect("clear-after-draw", at, message, "write it before the draw", corrected));
    }
    if clears.is_empty() {
        let message = "the picture keeps its previous content";
        let corrected = case.inserted(first_draw, [GlCall::Clear(vec![color])]);
        let fix = "write `clear COLOR_BUFFER_BIT` before it";
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
    let fix = format!("write `clear_color {r} {g} {b} {a}`");
    let Some(at) = case.first(|call| matches!(call, GlCall::ClearColor(_))) else {
        let corrected = case.inserted(clear, [GlCall::ClearColor(right)]);
        let message = "no clear_color comes before this, so the background is black";
        found.push(case.suspect("clear-color-wrong", clear, message, fix, corrected));
        return;
    };
    if at > clear {
        let message = format!("clear, in line {}, uses the colour that was set before it", case.line(clear));
        found.push(case.suspect("clear-color-late", at, message, "write it before clear", case.moved(at, clear)));
    }
    for (at, step) in case.before() {
        if matches!(step.call, GlCall::ClearColor(color) if color != right) {
            let message = "the background is not the exercise's dark grey-blue";
            let corrected = case.replaced(at, GlCall::ClearColor(right));
            found.push(case.suspect("clear-color-wrong", at, message, fix.clone(), corrected));
        }
    }
}

fn switches(case: &Case<'_>, found: &mut Vec<Suspect>) {
    for (at, step) in case.before() {
        let GlCall::Switch { what, on: true } = &step.call else { continue };
        if what.name == "CULL_FACE" {
            let message = "the triangle's corners are clockwise, and CULL_FACE discards such triangles";
            found.push(case.suspect("culled", at, message, "remove it", case.without(at)));
        }
    }
}

fn draws(case: &Case<'_>, found: &mut Vec<Suspect>) {
    let right = case.reference.iter().find(|step| step.call.draws()).map(|step| step.call.clone());
    let Some(right @ GlCall::DrawArrays { mode, first, count }) = right else { return };
    let Some(step) = case.steps.get(case.draw) else {
        let corrected = case.inserted(case.steps.len(), [right]);
        let at = case.steps.len();
        let fix = format!("write `draw_arrays {} {first} {count}` at the end", mode.name);
        found.push(case.suspect("draw-missing", at, "no call draws anything", fix, corrected));
        return;
    };
    let mut add = |id: &'static str, call: GlCall, message: String, fix: String| {
        found.push(case.suspect(id, case.draw, message, fix, case.replaced(case.draw, call)));
    };
    match step.call.clone() {
        GlCall::DrawArrays { mode: mine, first: from, count: many } => {
            if many != count {
                let call = GlCall::DrawArrays { mode: mine, first: from, count };
                let message = format!("{many} vertices are drawn, but there are {count}");
                add("draw-count-wrong", call, message, format!("write {count}"));
            }
            if from != first {
                let call = GlCall::DrawArrays { mode: mine, first, count: many };
                add("draw-first-wrong", call, format!("the draw begins at vertex {from}"), format!("write {first}"));
            }
            if mine != mode {
                let call = GlCall::DrawArrays { mode, first: from, count: many };
                let message = format!("{} joins the corners in another way than {}", mine.name, mode.name);
                add("draw-mode-wrong", call, message, format!("write {}", mode.name));
            }
        }
        GlCall::DrawElements { mode: mine, count: many, kind, offset } => {
            if many != count {
                let call = GlCall::DrawElements { mode: mine, count, kind, offset };
                let message = format!("{many} indices are drawn, but there are {count}");
                add("draw-count-wrong", call, message, format!("write {count}"));
            }
            if mine != mode {
                let call = GlCall::DrawElements { mode, count: many, kind, offset };
                let message = format!("{} joins the corners in another way than {}", mine.name, mode.name);
                add("draw-mode-wrong", call, message, format!("write {}", mode.name));
            }
        }
        _ => {}
    }
    if case.draw + 1 < case.steps.len() {
        let message = "the calls that follow are meant for the draw, but come after it";
        let corrected = case.moved(case.draw, case.steps.len());
        found.push(case.suspect("draw-too-early", case.draw, message, "write it at the end", corrected));
    }
}
