//! Programs, draws, and what else makes the picture: where it is drawn, on which ground, after which tests.

use super::{Case, Suspect, known};
use gonio_render::gl_program::{GlCall, IntArgument};

/// Adds what may be wrong with the picture.
pub fn suspect(case: &Case<'_>, found: &mut Vec<Suspect>) {
    program(case, found);
    viewport(case, found);
    clears(case, found);
    clear_color(case, found);
    switches(case, found);
    draws(case, found);
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
        let said = format!("`{name}` is created but never used");
        let fix = format!("write `use_program {name}` before the uniforms and the draw");
        found.push(case.suspect("program-not-used", made, said, fix, corrected));
    }
    for (at, number) in uses {
        if *number == IntArgument::Literal(0) {
            let said = "0 unbinds the program, and the draw that follows has none";
            found.push(case.suspect("program-switched-off", at, said, "remove it", case.without(at)));
        } else if *number != right {
            let corrected = case.replaced(at, GlCall::UseProgram(right.clone()));
            let said = format!("this is not the number of `{name}`");
            found.push(case.suspect(
                "program-number-wrong",
                at,
                said,
                format!("write `use_program {name}`"),
                corrected,
            ));
        }
    }
}

fn viewport(case: &Case<'_>, found: &mut Vec<Suspect>) {
    for (at, step) in case.before() {
        let GlCall::Viewport([x, y, width, height]) = step.call else { continue };
        let said = format!("the picture is drawn into {width} x {height} pixels from ({x}, {y}) on");
        let fix = "give it 0 0 and the picture's width and height, or leave it out";
        found.push(case.suspect("viewport-wrong", at, said, fix, case.without(at)));
    }
}

fn clears(case: &Case<'_>, found: &mut Vec<Suspect>) {
    let color = known("COLOR_BUFFER_BIT");
    let clears_color = |call: &GlCall| matches!(call, GlCall::Clear(bits) if bits.contains(&color));
    let first_draw = case.first(GlCall::draws).unwrap_or(case.steps.len());
    let clears: Vec<usize> = (0..case.steps.len()).filter(|at| clears_color(&case.steps[*at].call)).collect();
    for &at in clears.iter().filter(|at| **at > first_draw) {
        let said = format!("this clears what line {} has drawn", case.line(first_draw));
        let corrected = case.moved(at, first_draw);
        found.push(case.suspect("clear-after-draw", at, said, "write it before the draw", corrected));
    }
    if clears.is_empty() {
        let said = "the picture keeps what was there before";
        let corrected = case.inserted(first_draw, [GlCall::Clear(vec![color])]);
        let fix = "write `clear COLOR_BUFFER_BIT` before it";
        found.push(case.suspect("clear-missing", first_draw, said, fix, corrected));
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
        let said = "no clear_color comes before this, so the ground is black";
        found.push(case.suspect("clear-color-wrong", clear, said, fix, corrected));
        return;
    };
    if at > clear {
        let said = format!("clear, in line {}, has taken the colour as it was before", case.line(clear));
        found.push(case.suspect("clear-color-late", at, said, "write it before clear", case.moved(at, clear)));
    }
    for (at, step) in case.before() {
        if matches!(step.call, GlCall::ClearColor(color) if color != right) {
            let said = "the ground is not the exercise's dark grey-blue";
            let corrected = case.replaced(at, GlCall::ClearColor(right));
            found.push(case.suspect("clear-color-wrong", at, said, fix.clone(), corrected));
        }
    }
}

fn switches(case: &Case<'_>, found: &mut Vec<Suspect>) {
    for (at, step) in case.before() {
        let GlCall::Switch { what, on: true } = &step.call else { continue };
        if what.name == "CULL_FACE" {
            let said = "the triangle's corners go clockwise, and CULL_FACE leaves such triangles out";
            found.push(case.suspect("culled", at, said, "remove it", case.without(at)));
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
    let mut told = |id: &'static str, call: GlCall, said: String, fix: String| {
        found.push(case.suspect(id, case.draw, said, fix, case.replaced(case.draw, call)));
    };
    match step.call.clone() {
        GlCall::DrawArrays { mode: mine, first: from, count: many } => {
            if many != count {
                let call = GlCall::DrawArrays { mode: mine, first: from, count };
                let said = format!("{many} vertices are drawn, and there are {count}");
                told("draw-count-wrong", call, said, format!("write {count}"));
            }
            if from != first {
                let call = GlCall::DrawArrays { mode: mine, first, count: many };
                told("draw-first-wrong", call, format!("the draw begins at vertex {from}"), format!("write {first}"));
            }
            if mine != mode {
                let call = GlCall::DrawArrays { mode, first: from, count: many };
                let said = format!("{} joins the corners in another way than {}", mine.name, mode.name);
                told("draw-mode-wrong", call, said, format!("write {}", mode.name));
            }
        }
        GlCall::DrawElements { mode: mine, count: many, kind, offset } => {
            if many != count {
                let call = GlCall::DrawElements { mode: mine, count, kind, offset };
                let said = format!("{many} indices are drawn, and there are {count}");
                told("draw-count-wrong", call, said, format!("write {count}"));
            }
            if mine != mode {
                let call = GlCall::DrawElements { mode, count: many, kind, offset };
                let said = format!("{} joins the corners in another way than {}", mine.name, mode.name);
                told("draw-mode-wrong", call, said, format!("write {}", mode.name));
            }
        }
        _ => {}
    }
    if case.draw + 1 < case.steps.len() {
        let said = "the calls that follow are for the draw, and come after it";
        let corrected = case.moved(case.draw, case.steps.len());
        found.push(case.suspect("draw-too-early", case.draw, said, "write it at the end", corrected));
    }
}
