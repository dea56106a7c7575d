//! Attributes, and the arrays and buffers that feed them.

use super::{Case, Suspect, known};
use gonio_render::gl_program::{Constant, GlCall, IntArgument, ObjectKind, Pointer, Step};

/// Adds what may be wrong with vertices.
pub fn suspect(case: &Case<'_>, found: &mut Vec<Suspect>) {
    vertex_arrays(case, found);
    buffers(case, found);
    fields(case, found);
    unknown_names(case, found);
    enabled(case, found);
    repeated_names(case, found);
    described(case, found);
    numbers(case, found);
}

/// What is kept in the vertex array that is bound.
fn for_array(call: &GlCall) -> bool {
    match call {
        GlCall::VertexAttribPointer(_) | GlCall::SwitchAttribute { .. } => true,
        GlCall::BindBuffer { target, .. } => target.name == "ELEMENT_ARRAY_BUFFER",
        _ => false,
    }
}

fn binds_array(call: &GlCall) -> bool {
    matches!(call, GlCall::BindVertexArray(_))
}

fn vertex_arrays(case: &Case<'_>, found: &mut Vec<Suspect>) {
    let arrays = case.objects(ObjectKind::VertexArray);
    let first_for = case.first(for_array).unwrap_or(case.draw);
    let Some(bind) = case.first(binds_array) else {
        let name = arrays.first().copied();
        let array = name.unwrap_or("array").to_owned();
        let bound = GlCall::BindVertexArray(IntArgument::Variable(array.clone()));
        found.push(match name {
            Some(name) => {
                let made =
                    case.first(|call| matches!(call, GlCall::Generate { name: n, .. } if n == name)).unwrap_or(0);
                let fix = format!("write `bind_vertex_array {name}` after it");
                let said = format!("`{name}` is created but never bound");
                let corrected = case.inserted(first_for.max(made + 1), [bound]);
                case.suspect("vertex-array-not-bound", made, said, fix, corrected)
            }
            None => {
                let made = GlCall::Generate { name: array, kind: ObjectKind::VertexArray };
                let fix = "write `array = gen_vertex_array` and `bind_vertex_array array` before it";
                let said = "no vertex array is bound to store this setting";
                case.suspect("vertex-array-missing", first_for, said, fix, case.inserted(first_for, [made, bound]))
            }
        });
        return;
    };
    if first_for < bind {
        // With what makes it, where that comes late too.
        let made = case.first(|call| matches!(call, GlCall::Generate { kind: ObjectKind::VertexArray, .. }));
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
    let GlCall::BindVertexArray(bound) = &case.steps[last].call else { return };
    if *bound == IntArgument::Literal(0) {
        let said = format!("0 unbinds the vertex array before the draw in line {}", case.line(case.draw));
        let fix = "bind the vertex array again before the draw, or leave this out";
        found.push(case.suspect("vertex-array-unbound", last, said, fix, case.without(last)));
    }
    for name in arrays.iter().filter(|name| *bound != IntArgument::Variable((**name).to_owned())) {
        let call = GlCall::BindVertexArray(IntArgument::Variable((*name).to_owned()));
        let said = format!("the attributes were described in `{name}`, and another vertex array is bound at the draw");
        let fix = format!("write `bind_vertex_array {name}`");
        found.push(case.suspect("other-vertex-array", last, said, fix, case.replaced(last, call)));
    }
    for (at, step) in case.before() {
        if at != last && matches!(&step.call, GlCall::BindVertexArray(IntArgument::Literal(0))) {
            let said = "0 unbinds the vertex array, and what follows is meant for it";
            found.push(case.suspect("vertex-array-unbound", at, said, "remove it", case.without(at)));
        }
    }
}

fn buffers(case: &Case<'_>, found: &mut Vec<Suspect>) {
    let vertices = known("ARRAY_BUFFER");
    let is_vertices = |call: &GlCall| matches!(call, GlCall::BindBuffer { target, .. } if *target == vertices);
    let for_buffer = |call: &GlCall| match call {
        GlCall::VertexAttribPointer(_) => true,
        GlCall::BufferData { target, .. } => *target == vertices,
        _ => false,
    };
    let first_for = case.first(for_buffer).unwrap_or(case.draw);
    buffer_targets(case, found);
    match case.first(is_vertices) {
        None => {
            for buffer in case.objects(ObjectKind::Buffer) {
                let made =
                    case.first(|call| matches!(call, GlCall::Generate { name, .. } if name == buffer)).unwrap_or(0);
                let call = GlCall::BindBuffer { target: vertices, buffer: IntArgument::Variable(buffer.to_owned()) };
                let fix = format!("write `bind_buffer ARRAY_BUFFER {buffer}` after it");
                let said = format!("`{buffer}` is created but never bound to ARRAY_BUFFER");
                let corrected = case.inserted(first_for.max(made + 1), [call]);
                found.push(case.suspect("buffer-not-bound", made, said, fix, corrected));
            }
        }
        Some(bind) if first_for < bind => {
            let made = case.first(|call| matches!(call, GlCall::Generate { kind: ObjectKind::Buffer, .. }));
            let place = made.map_or(first_for, |made| (made + 1).min(first_for));
            let said = format!("line {} is meant for this buffer, and comes before it is bound", case.line(first_for));
            let fix = format!("write it before line {}", case.line(first_for));
            found.push(case.suspect("buffer-bound-late", bind, said, fix, case.moved(bind, place)));
        }
        Some(_) => {}
    }
    for (at, step) in case.before() {
        let GlCall::BindBuffer { target, buffer: IntArgument::Literal(0) } = &step.call else { continue };
        let said = format!("0 unbinds the buffer of {}, and what follows refers to none", target.name);
        let id = if *target == vertices { "buffer-unbound" } else { "index-buffer-not-bound" };
        found.push(case.suspect(id, at, said, "remove it", case.without(at)));
    }
    filled(case, found);
}

/// Vertices bound as indices, and the other way round.
fn buffer_targets(case: &Case<'_>, found: &mut Vec<Suspect>) {
    for (at, step) in case.before() {
        let mut call = step.call.clone();
        if matches!(call, GlCall::BindBuffer { buffer: IntArgument::Literal(0), .. }) {
            continue;
        }
        let (GlCall::BindBuffer { target, .. } | GlCall::BufferData { target, .. }) = &mut call else { continue };
        let was = *target;
        *target = known(if was.name == "ARRAY_BUFFER" { "ELEMENT_ARRAY_BUFFER" } else { "ARRAY_BUFFER" });
        let now = *target;
        let buffer =
            |call: &GlCall| if let GlCall::BindBuffer { buffer, .. } = call { Some(buffer.clone()) } else { None };
        // The buffer's other calls with it: bind_buffer and the buffer_data that follows.
        let mut corrected = case.replaced(at, call.clone());
        if buffer(&call).is_some()
            && let Some(next) = corrected.get_mut(at + 1)
            && let GlCall::BufferData { target, .. } = &mut next.call
            && *target == was
        {
            *target = now;
        }
        let said = format!("{} is not what this buffer is read from", was.name);
        found.push(case.suspect("buffer-target-wrong", at, said, format!("write {}", now.name), corrected));
    }
}

fn filled(case: &Case<'_>, found: &mut Vec<Suspect>) {
    if case.first(|call| matches!(call, GlCall::BufferData { .. })).is_some() {
        return;
    }
    let Some(bind) = case.first(|call| matches!(call, GlCall::BindBuffer { .. })) else { return };
    let data = case.steps.iter().find_map(|step| match &step.call {
        GlCall::Data { name, .. } => Some(name.clone()),
        _ => None,
    });
    let Some(data) = data else { return };
    let fix = format!("write `buffer_data ARRAY_BUFFER {data} STATIC_DRAW` after it");
    let call = GlCall::BufferData { target: known("ARRAY_BUFFER"), data, usage: known("STATIC_DRAW") };
    let corrected = case.inserted(bind + 1, [call]);
    found.push(case.suspect("buffer-empty", bind, "this buffer never gets any bytes", fix, corrected));
}

/// What the reference says of each attribute.
fn reference(case: &Case<'_>) -> Vec<Pointer> {
    let pointer =
        |call: &GlCall| if let GlCall::VertexAttribPointer(pointer) = call { Some(pointer.clone()) } else { None };
    case.reference.iter().filter_map(|step| pointer(&step.call)).collect()
}

type Change = fn(&mut Pointer, &Pointer) -> bool;
/// A mistake's word, how it is corrected, and the field in words.
type Field = (&'static str, Change, fn(&Pointer) -> String);

fn changes<T: PartialEq>(mine: &mut T, right: T) -> bool {
    let other = *mine != right;
    *mine = right;
    other
}

fn fields(case: &Case<'_>, found: &mut Vec<Suspect>) {
    let right = reference(case);
    let fields: [Field; 4] = [
        ("stride-wrong", |mine, right| changes(&mut mine.stride, right.stride), |p| format!("stride {}", p.stride)),
        ("offset-wrong", |mine, right| changes(&mut mine.offset, right.offset), |p| format!("offset {}", p.offset)),
        ("attribute-size-wrong", |mine, right| changes(&mut mine.size, right.size), |p| format!("size {}", p.size)),
        ("attribute-type-wrong", |mine, right| changes(&mut mine.kind, right.kind), |p| p.kind.name.to_owned()),
    ];
    for (id, change, words) in fields {
        let changed = case.changed(|_, call| match call {
            GlCall::VertexAttribPointer(mine) => {
                right.iter().find(|right| right.attribute == mine.attribute).is_some_and(|right| change(mine, right))
            }
            _ => false,
        });
        let Some((at, corrected)) = changed else { continue };
        let (GlCall::VertexAttribPointer(was), GlCall::VertexAttribPointer(is)) =
            (&case.steps[at].call, &corrected[at].call)
        else {
            continue;
        };
        let said = format!("`{}` has {}, and the data wants {}", was.attribute, words(was), words(is));
        found.push(case.suspect(id, at, said, format!("write {}", words(is)), corrected));
    }
}

fn is_switched(case: &Case<'_>, attribute: &str, wanted: bool) -> Option<usize> {
    case.first(|call| matches!(call, GlCall::SwitchAttribute { attribute: a, on } if a == attribute && *on == wanted))
}

fn enabled(case: &Case<'_>, found: &mut Vec<Suspect>) {
    let mut all = Vec::new();
    for right in reference(case) {
        let name = &right.attribute;
        let described = case.last(|call| matches!(call, GlCall::VertexAttribPointer(p) if p.attribute == *name));
        if let (Some(at), None) = (described, is_switched(case, name, true)) {
            all.push((at, name.clone()));
        }
    }
    if let Some((first, name)) = all.first().cloned() {
        let mut corrected = case.steps.to_vec();
        for (at, name) in all.iter().rev() {
            let step =
                Step { line: case.line(*at), call: GlCall::SwitchAttribute { attribute: name.clone(), on: true } };
            corrected.insert(at + 1, step);
        }
        let names = all.iter().map(|(_, name)| format!("`{name}`")).collect::<Vec<_>>().join(", ");
        let said = format!("{names}: described here, never enabled");
        let fix = format!("write `enable_vertex_attrib_array {name}` after it");
        found.push(case.suspect("attribute-not-enabled", first, said, fix, corrected));
    }
    for (at, step) in case.before() {
        if let GlCall::SwitchAttribute { attribute, on: false } = &step.call {
            let said = format!("`{attribute}` is disabled before the draw in line {}", case.line(case.draw));
            found.push(case.suspect("attribute-disabled", at, said, "remove it", case.without(at)));
        }
    }
}

fn described(case: &Case<'_>, found: &mut Vec<Suspect>) {
    for right in reference(case) {
        let name = right.attribute.clone();
        if case.first(|call| matches!(call, GlCall::VertexAttribPointer(p) if p.attribute == name)).is_some() {
            continue;
        }
        let place = case
            .last(|call| matches!(call, GlCall::VertexAttribPointer(_)))
            .or(case.last(|call| matches!(call, GlCall::BufferData { .. })))
            .unwrap_or(0);
        let enabled = is_switched(case, &name, true);
        let fix = format!(
            "write `vertex_attrib_pointer {name} {} FLOAT FALSE {} {}`",
            right.size, right.stride, right.offset
        );
        let mut calls = vec![GlCall::VertexAttribPointer(right)];
        if enabled.is_none() {
            calls.push(GlCall::SwitchAttribute { attribute: name.clone(), on: true });
        }
        let said = format!("no vertex_attrib_pointer says where `{name}` is");
        let corrected = case.inserted(place + 1, calls);
        found.push(case.suspect("attribute-not-described", enabled.unwrap_or(place), said, fix, corrected));
    }
}

/// The attribute that a call is about.
fn name_of(call: &GlCall) -> Option<&String> {
    match call {
        GlCall::VertexAttribPointer(pointer) => Some(&pointer.attribute),
        GlCall::SwitchAttribute { attribute, .. } => Some(attribute),
        _ => None,
    }
}

/// The same, to be changed.
fn name_of_mut(call: &mut GlCall) -> Option<&mut String> {
    match call {
        GlCall::VertexAttribPointer(pointer) => Some(&mut pointer.attribute),
        GlCall::SwitchAttribute { attribute, .. } => Some(attribute),
        _ => None,
    }
}

/// Attributes of the reference, and those that the program names.
fn all_names(case: &Case<'_>) -> [Vec<String>; 2] {
    let right = reference(case).into_iter().map(|pointer| pointer.attribute).collect();
    [right, case.steps.iter().filter_map(|step| name_of(&step.call).cloned()).collect()]
}

/// Names that no attribute has.
fn unknown_names(case: &Case<'_>, found: &mut Vec<Suspect>) {
    let [right, named] = all_names(case);
    let mut unknown: Vec<&String> = named.iter().filter(|name| !right.contains(name)).collect();
    unknown.dedup();
    for wrong in unknown {
        for meant in &right {
            let changed = case.changed(|_, call| match name_of_mut(call).filter(|name| *name == wrong) {
                Some(name) => {
                    meant.clone_into(name);
                    true
                }
                None => false,
            });
            if let Some((at, corrected)) = changed {
                let said = format!("the program has no attribute `{wrong}`, and `{meant}` gets nothing");
                found.push(case.suspect("attribute-name-wrong", at, said, format!("write `{meant}`"), corrected));
            }
        }
    }
}

/// A name that has a call already, in place of one that has none.
fn repeated_names(case: &Case<'_>, found: &mut Vec<Suspect>) {
    let [right, named] = all_names(case);
    for (at, step) in case.before() {
        let Some(name) = name_of(&step.call) else { continue };
        for meant in right.iter().filter(|meant| *meant != name && !named.contains(meant)) {
            let mut call = step.call.clone();
            if let Some(name) = name_of_mut(&mut call) {
                meant.clone_into(name);
            }
            let said = format!("`{name}` is used here, and `{meant}` is never described");
            let corrected = case.replaced(at, call);
            found.push(case.suspect("attribute-name-wrong", at, said, format!("write `{meant}`"), corrected));
        }
    }
}

/// The numbers in buffers, and those that count them.
fn numbers(case: &Case<'_>, found: &mut Vec<Suspect>) {
    let lists = |steps: &[Step]| {
        let list = |step: &Step| match &step.call {
            GlCall::Data { name, numbers } => Some((name.clone(), numbers.clone())),
            _ => None,
        };
        steps.iter().filter_map(list).collect::<Vec<_>>()
    };
    let mine = lists(case.steps);
    for (at, step) in case.before() {
        if let GlCall::BufferData { target, data, usage } = &step.call {
            for (other, _) in mine.iter().filter(|(name, _)| name != data) {
                let call = GlCall::BufferData { target: *target, data: other.clone(), usage: *usage };
                let said = format!("the buffer is filled with `{data}`, and the corners are in `{other}`");
                found.push(case.suspect("other-data", at, said, format!("write `{other}`"), case.replaced(at, call)));
            }
        }
    }
    if let Some((_, right)) = lists(case.reference).into_iter().next() {
        for (at, step) in case.before() {
            let GlCall::Data { name, numbers } = &step.call else { continue };
            if *numbers != right {
                let call = GlCall::Data { name: name.clone(), numbers: right.clone() };
                let said = format!("`{name}` does not hold the exercise's numbers");
                let corrected = case.replaced(at, call);
                found.push(case.suspect("data-changed", at, said, "restore the original numbers", corrected));
            }
        }
    }
    indices(case, found);
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
        let said = format!("the index buffer holds UNSIGNED_INT, and is read as {}", kind.name);
        found.push(case.suspect("index-type-wrong", case.draw, said, "write UNSIGNED_INT", draw(whole, *offset)));
    }
    if *offset != 0 {
        let said = format!("the draw begins at byte {offset} of the index buffer");
        found.push(case.suspect("index-offset-wrong", case.draw, said, "write 0", draw(*kind, 0)));
    }
    for (at, step) in case.before() {
        let GlCall::Indices { name, numbers } = &step.call else { continue };
        if numbers.iter().all(|index| *index > 0) {
            let from_zero = numbers.iter().map(|index| index - 1).collect();
            let call = GlCall::Indices { name: name.clone(), numbers: from_zero };
            let said = format!("the indices in `{name}` begin with 1, and the first corner has 0");
            let corrected = case.replaced(at, call);
            found.push(case.suspect("indices-from-one", at, said, "subtract 1 from each", corrected));
        }
        let mut sorted = numbers.clone();
        sorted.sort_unstable();
        // The same corners in another order are no mistake by themselves.
        if sorted == [0, 1, 2] {
            continue;
        }
        let call = GlCall::Indices { name: name.clone(), numbers: vec![0, 1, 2] };
        let said = format!("`{name}` names other corners than 0, 1 and 2");
        found.push(case.suspect("indices-changed", at, said, "write 0 1 2", case.replaced(at, call)));
    }
    for buffer in case.objects(ObjectKind::Buffer) {
        let call = GlCall::BindBuffer {
            target: known("ELEMENT_ARRAY_BUFFER"),
            buffer: IntArgument::Variable(buffer.to_owned()),
        };
        let said = "no ELEMENT_ARRAY_BUFFER, or another one, is bound in the vertex array that is drawn";
        let fix = format!("write `bind_buffer ELEMENT_ARRAY_BUFFER {buffer}` after bind_vertex_array");
        let corrected = case.inserted(case.draw, [call]);
        found.push(case.suspect("index-buffer-not-bound", case.draw, said, fix, corrected));
    }
}
