//! Vertex arrays and buffers: made, bound and filled.

use super::{Case, Suspect, known};
use gonio_render::gl_program::{Call, Number, ObjectKind};

/// Adds what may be wrong with vertex arrays and buffers.
pub fn suspect(case: &Case<'_>, found: &mut Vec<Suspect>) {
    vertex_arrays(case, found);
    buffers(case, found);
}

/// What is kept in the vertex array that is bound.
fn for_array(call: &Call) -> bool {
    match call {
        Call::VertexAttribPointer(_) | Call::SwitchAttribute { .. } => true,
        Call::BindBuffer { target, .. } => target.name == "ELEMENT_ARRAY_BUFFER",
        _ => false,
    }
}

fn binds_array(call: &Call) -> bool {
    matches!(call, Call::BindVertexArray(_))
}

fn vertex_arrays(case: &Case<'_>, found: &mut Vec<Suspect>) {
    let arrays = case.objects(ObjectKind::VertexArray);
    let first_for = case.first(for_array).unwrap_or(case.draw);
    let Some(bind) = case.first(binds_array) else {
        let name = arrays.first().copied();
        let array = name.unwrap_or("array").to_owned();
        let bound = Call::BindVertexArray(Number::Variable(array.clone()));
        found.push(match name {
            Some(name) => {
                let made = case.first(|call| matches!(call, Call::Generate { name: n, .. } if n == name)).unwrap_or(0);
                let fix = format!("write `bind_vertex_array {name}` after it");
                let said = format!("`{name}` is created but never bound");
                let corrected = case.inserted(first_for.max(made + 1), [bound]);
                case.suspect("vertex-array-not-bound", made, said, fix, corrected)
            }
            None => {
                let made = Call::Generate { name: array, kind: ObjectKind::VertexArray };
                let fix = "write `array = gen_vertex_array` and `bind_vertex_array array` before it";
                let said = "no vertex array is bound to store this setting";
                case.suspect("vertex-array-missing", first_for, said, fix, case.inserted(first_for, [made, bound]))
            }
        });
        return;
    };
    if first_for < bind {
        // With what makes it, where that comes late too.
        let made = case.first(|call| matches!(call, Call::Generate { kind: ObjectKind::VertexArray, .. }));
        let mut corrected = case.moved(bind, first_for);
        if let Some(made) = made.filter(|made| *made > first_for) {
            let step = corrected.remove(made + 1);
            corrected.insert(first_for, step);
        }
        let said = format!("line {} is meant for this vertex array, and comes before it", case.line(first_for));
        let fix = format!("write it before line {}", case.line(first_for));
        found.push(case.suspect("vertex-array-bound-late", bind, said, fix, corrected));
    }
    let Some(last) = case.last(binds_array) else { return };
    let Call::BindVertexArray(bound) = &case.steps[last].call else { return };
    if *bound == Number::Literal(0) {
        let said = format!("0 unbinds the vertex array before the draw in line {}", case.line(case.draw));
        let fix = "bind the vertex array again before the draw, or leave this out";
        found.push(case.suspect("vertex-array-unbound", last, said, fix, case.without(last)));
    }
    for name in arrays.iter().filter(|name| *bound != Number::Variable((**name).to_owned())) {
        let call = Call::BindVertexArray(Number::Variable((*name).to_owned()));
        let said = format!("the attributes were described in `{name}`, and another vertex array is bound at the draw");
        let fix = format!("write `bind_vertex_array {name}`");
        found.push(case.suspect("other-vertex-array", last, said, fix, case.replaced(last, call)));
    }
    for (at, step) in case.before() {
        if at != last && matches!(&step.call, Call::BindVertexArray(Number::Literal(0))) {
            let said = "0 unbinds the vertex array, and what follows is meant for it";
            found.push(case.suspect("vertex-array-unbound", at, said, "remove it", case.without(at)));
        }
    }
}

fn buffers(case: &Case<'_>, found: &mut Vec<Suspect>) {
    let vertices = known("ARRAY_BUFFER");
    let is_vertices = |call: &Call| matches!(call, Call::BindBuffer { target, .. } if *target == vertices);
    let for_buffer = |call: &Call| match call {
        Call::VertexAttribPointer(_) => true,
        Call::BufferData { target, .. } => *target == vertices,
        _ => false,
    };
    let first_for = case.first(for_buffer).unwrap_or(case.draw);
    targets(case, found);
    match case.first(is_vertices) {
        None => {
            for buffer in case.objects(ObjectKind::Buffer) {
                let made =
                    case.first(|call| matches!(call, Call::Generate { name, .. } if name == buffer)).unwrap_or(0);
                let call = Call::BindBuffer { target: vertices, buffer: Number::Variable(buffer.to_owned()) };
                let fix = format!("write `bind_buffer ARRAY_BUFFER {buffer}` after it");
                let said = format!("`{buffer}` is created but never bound to ARRAY_BUFFER");
                let corrected = case.inserted(first_for.max(made + 1), [call]);
                found.push(case.suspect("buffer-not-bound", made, said, fix, corrected));
            }
        }
        Some(bind) if first_for < bind => {
            let made = case.first(|call| matches!(call, Call::Generate { kind: ObjectKind::Buffer, .. }));
            let place = made.map_or(first_for, |made| (made + 1).min(first_for));
            let said = format!("line {} is meant for this buffer, and comes before it is bound", case.line(first_for));
            let fix = format!("write it before line {}", case.line(first_for));
            found.push(case.suspect("buffer-bound-late", bind, said, fix, case.moved(bind, place)));
        }
        Some(_) => {}
    }
    for (at, step) in case.before() {
        let Call::BindBuffer { target, buffer: Number::Literal(0) } = &step.call else { continue };
        let said = format!("0 unbinds the buffer of {}, and what follows refers to none", target.name);
        let id = if *target == vertices { "buffer-unbound" } else { "index-buffer-not-bound" };
        found.push(case.suspect(id, at, said, "remove it", case.without(at)));
    }
    filled(case, found);
}

/// Vertices bound as indices, and the other way round.
fn targets(case: &Case<'_>, found: &mut Vec<Suspect>) {
    for (at, step) in case.before() {
        let mut call = step.call.clone();
        if matches!(call, Call::BindBuffer { buffer: Number::Literal(0), .. }) {
            continue;
        }
        let (Call::BindBuffer { target, .. } | Call::BufferData { target, .. }) = &mut call else { continue };
        let was = *target;
        *target = known(if was.name == "ARRAY_BUFFER" { "ELEMENT_ARRAY_BUFFER" } else { "ARRAY_BUFFER" });
        let now = *target;
        let buffer = |call: &Call| if let Call::BindBuffer { buffer, .. } = call { Some(buffer.clone()) } else { None };
        // The buffer's other calls with it: bind_buffer and the buffer_data that follows.
        let mut corrected = case.replaced(at, call.clone());
        if buffer(&call).is_some()
            && let Some(next) = corrected.get_mut(at + 1)
            && let Call::BufferData { target, .. } = &mut next.call
            && *target == was
        {
            *target = now;
        }
        let said = format!("{} is not what this buffer is read from", was.name);
        found.push(case.suspect("buffer-target-wrong", at, said, format!("write {}", now.name), corrected));
    }
}

fn filled(case: &Case<'_>, found: &mut Vec<Suspect>) {
    if case.first(|call| matches!(call, Call::BufferData { .. })).is_some() {
        return;
    }
    let Some(bind) = case.first(|call| matches!(call, Call::BindBuffer { .. })) else { return };
    let data = case.steps.iter().find_map(|step| match &step.call {
        Call::Data { name, .. } => Some(name.clone()),
        _ => None,
    });
    let Some(data) = data else { return };
    let fix = format!("write `buffer_data ARRAY_BUFFER {data} STATIC_DRAW` after it");
    let call = Call::BufferData { target: known("ARRAY_BUFFER"), data, usage: known("STATIC_DRAW") };
    let corrected = case.inserted(bind + 1, [call]);
    found.push(case.suspect("buffer-empty", bind, "this buffer never gets any bytes", fix, corrected));
}
