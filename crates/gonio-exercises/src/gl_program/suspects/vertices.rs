//! Attributes, and the vertex arrays and buffers that provide them.

use super::{Case, Suspect, known};
use gonio_language::tr;
use gonio_render::gl_program::{GlCall, IntArgument, ObjectKind, Pointer, Step};

/// Adds the suspects about vertex arrays, buffers and attributes.
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

/// Whether a call changes the bound vertex array.
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
                let fix = tr!("check-gl-write-bind-vertex-array-after-it", name = name);
                let message = tr!("check-gl-is-created-but-never-bound", name = name);
                let corrected = case.inserted(first_for.max(made + 1), [bound]);
                case.suspect("vertex-array-not-bound", made, message, fix, corrected)
            }
            None => {
                let made = GlCall::Generate { name: array, kind: ObjectKind::VertexArray };
                let fix = tr!("check-gl-write-array-gen-vertex-array-and");
                let message = tr!("check-gl-no-vertex-array-is-bound-to");
                case.suspect("vertex-array-missing", first_for, message, fix, case.inserted(first_for, [made, bound]))
            }
        });
        return;
    };
    if first_for < bind {
        // Moves the call that creates it as well, if that comes too late too.
        let made = case.first(|call| matches!(call, GlCall::Generate { kind: ObjectKind::VertexArray, .. }));
        let mut corrected = case.moved(bind, first_for);
        if let Some(made) = made.filter(|made| *made > first_for) {
            let step = corrected.remove(made + 1);
            corrected.insert(first_for, step);
        }
        let message = tr!("check-gl-line-is-meant-for-this-vertex", line = case.line(first_for));
        let fix = tr!("check-gl-write-it-before-line", line = case.line(first_for));
        found.push(case.suspect("vertex-array-bound-late", bind, message, fix, corrected));
    }
    let Some(last) = case.last(binds_array) else { return };
    let GlCall::BindVertexArray(bound) = &case.steps[last].call else { return };
    if *bound == IntArgument::Literal(0) {
        let message = tr!("check-gl-0-unbinds-the-vertex-array-before", draw = case.line(case.draw));
        let fix = tr!("check-gl-bind-the-vertex-array-again-before");
        found.push(case.suspect("vertex-array-unbound", last, message, fix, case.without(last)));
    }
    for name in arrays.iter().filter(|name| *bound != IntArgument::Variable((**name).to_owned())) {
        let call = GlCall::BindVertexArray(IntArgument::Variable((*name).to_owned()));
        let message = tr!("check-gl-the-attributes-were-described-in-but", name = name);
        let fix = tr!("check-gl-write-bind-vertex-array", name = name);
        found.push(case.suspect("other-vertex-array", last, message, fix, case.replaced(last, call)));
    }
    for (at, step) in case.before() {
        if at != last && matches!(&step.call, GlCall::BindVertexArray(IntArgument::Literal(0))) {
            let message = tr!("check-gl-0-unbinds-the-vertex-array-but");
            found.push(case.suspect("vertex-array-unbound", at, message, tr!("check-gl-remove-it"), case.without(at)));
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
                let fix = tr!("check-gl-write-bind-buffer-array-buffer-after", buffer = buffer);
                let message = tr!("check-gl-is-created-but-never-bound-to", buffer = buffer);
                let corrected = case.inserted(first_for.max(made + 1), [call]);
                found.push(case.suspect("buffer-not-bound", made, message, fix, corrected));
            }
        }
        Some(bind) if first_for < bind => {
            let made = case.first(|call| matches!(call, GlCall::Generate { kind: ObjectKind::Buffer, .. }));
            let place = made.map_or(first_for, |made| (made + 1).min(first_for));
            let message = tr!("check-gl-line-is-meant-for-this-buffer", line = case.line(first_for));
            let fix = tr!("check-gl-write-it-before-line", line = case.line(first_for));
            found.push(case.suspect("buffer-bound-late", bind, message, fix, case.moved(bind, place)));
        }
        Some(_) => {}
    }
    for (at, step) in case.before() {
        let GlCall::BindBuffer { target, buffer: IntArgument::Literal(0) } = &step.call else { continue };
        let message = tr!("check-gl-0-unbinds-the-buffer-from-so", name = target.name);
        let id = if *target == vertices { "buffer-unbound" } else { "index-buffer-not-bound" };
        found.push(case.suspect(id, at, message, tr!("check-gl-remove-it"), case.without(at)));
    }
    filled(case, found);
}

/// Vertices bound as indices, and vice versa.
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
        // Corrects the buffer_data that follows bind_buffer as well.
        let mut corrected = case.replaced(at, call.clone());
        if buffer(&call).is_some()
            && let Some(next) = corrected.get_mut(at + 1)
            && let GlCall::BufferData { target, .. } = &mut next.call
            && *target == was
        {
            *target = now;
        }
        let message = tr!("check-gl-this-buffer-is-not-read-from", name = was.name);
        found.push(case.suspect(
            "buffer-target-wrong",
            at,
            message,
            tr!("check-gl-write-plain", text = now.name),
            corrected,
        ));
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
    let fix = tr!("check-gl-write-buffer-data-array-buffer-static", data = data);
    let call = GlCall::BufferData { target: known("ARRAY_BUFFER"), data, usage: known("STATIC_DRAW") };
    let corrected = case.inserted(bind + 1, [call]);
    found.push(case.suspect("buffer-empty", bind, tr!("check-gl-this-buffer-never-gets-any-bytes"), fix, corrected));
}

/// The reference's description of each attribute.
fn reference(case: &Case<'_>) -> Vec<Pointer> {
    let pointer =
        |call: &GlCall| if let GlCall::VertexAttribPointer(pointer) = call { Some(pointer.clone()) } else { None };
    case.reference.iter().filter_map(|step| pointer(&step.call)).collect()
}

type Change = fn(&mut Pointer, &Pointer) -> bool;
/// A mistake's id, its correction, and the field in words.
type Field = (&'static str, Change, fn(&Pointer) -> String);

fn changes<T: PartialEq>(mine: &mut T, right: T) -> bool {
    let other = *mine != right;
    *mine = right;
    other
}

fn fields(case: &Case<'_>, found: &mut Vec<Suspect>) {
    let right = reference(case);
    let fields: [Field; 4] = [
        (
            "stride-wrong",
            |mine, right| changes(&mut mine.stride, right.stride),
            |p| tr!("check-gl-stride", stride = p.stride),
        ),
        (
            "offset-wrong",
            |mine, right| changes(&mut mine.offset, right.offset),
            |p| tr!("check-gl-offset", offset = p.offset),
        ),
        (
            "attribute-size-wrong",
            |mine, right| changes(&mut mine.size, right.size),
            |p| tr!("check-gl-size", size = p.size),
        ),
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
        let message =
            tr!("check-gl-has-but-the-data-needs", attribute = was.attribute, was = words(was), is = words(is));
        found.push(case.suspect(id, at, message, tr!("check-gl-write-plain", text = words(is)), corrected));
    }
}

fn is_switched(case: &Case<'_>, attribute: &str, enabled: bool) -> Option<usize> {
    case.first(|call| matches!(call, GlCall::SwitchAttribute { attribute: a, on } if a == attribute && *on == enabled))
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
        let message = tr!("check-gl-described-here-but-never-enabled", names = names);
        let fix = tr!("check-gl-write-enable-vertex-attrib-array-after", name = name);
        found.push(case.suspect("attribute-not-enabled", first, message, fix, corrected));
    }
    for (at, step) in case.before() {
        if let GlCall::SwitchAttribute { attribute, on: false } = &step.call {
            let message =
                tr!("check-gl-is-disabled-before-the-draw-in", attribute = attribute, draw = case.line(case.draw));
            found.push(case.suspect("attribute-disabled", at, message, tr!("check-gl-remove-it"), case.without(at)));
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
        let fix = tr!(
            "check-gl-write-vertex-attrib-pointer-float-false",
            name = name,
            size = right.size,
            stride = right.stride,
            offset = right.offset
        );
        let mut calls = vec![GlCall::VertexAttribPointer(right)];
        if enabled.is_none() {
            calls.push(GlCall::SwitchAttribute { attribute: name.clone(), on: true });
        }
        let message = tr!("check-gl-no-vertex-attrib-pointer-says-where", name = name);
        let corrected = case.inserted(place + 1, calls);
        found.push(case.suspect("attribute-not-described", enabled.unwrap_or(place), message, fix, corrected));
    }
}

/// The attribute of a call.
fn name_of(call: &GlCall) -> Option<&String> {
    match call {
        GlCall::VertexAttribPointer(pointer) => Some(&pointer.attribute),
        GlCall::SwitchAttribute { attribute, .. } => Some(attribute),
        _ => None,
    }
}

/// The attribute of a call, for changing it.
fn name_of_mut(call: &mut GlCall) -> Option<&mut String> {
    match call {
        GlCall::VertexAttribPointer(pointer) => Some(&mut pointer.attribute),
        GlCall::SwitchAttribute { attribute, .. } => Some(attribute),
        _ => None,
    }
}

/// The attributes of the reference, and those of the program.
fn all_names(case: &Case<'_>) -> [Vec<String>; 2] {
    let right = reference(case).into_iter().map(|pointer| pointer.attribute).collect();
    [right, case.steps.iter().filter_map(|step| name_of(&step.call).cloned()).collect()]
}

/// Names that are not attributes.
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
                let message = tr!("check-gl-the-program-has-no-attribute-and", wrong = wrong, meant = meant);
                found.push(case.suspect(
                    "attribute-name-wrong",
                    at,
                    message,
                    tr!("check-gl-write", text = meant),
                    corrected,
                ));
            }
        }
    }
}

/// A name that is used twice instead of one that is never used.
fn repeated_names(case: &Case<'_>, found: &mut Vec<Suspect>) {
    let [right, named] = all_names(case);
    for (at, step) in case.before() {
        let Some(name) = name_of(&step.call) else { continue };
        for meant in right.iter().filter(|meant| *meant != name && !named.contains(meant)) {
            let mut call = step.call.clone();
            if let Some(name) = name_of_mut(&mut call) {
                meant.clone_into(name);
            }
            let message = tr!("check-gl-is-used-here-but-is-never", name = name, meant = meant);
            let corrected = case.replaced(at, call);
            found.push(case.suspect(
                "attribute-name-wrong",
                at,
                message,
                tr!("check-gl-write", text = meant),
                corrected,
            ));
        }
    }
}

/// The data in buffers.
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
                let message = tr!("check-gl-the-buffer-is-filled-with-but", data = data, other = other);
                found.push(case.suspect(
                    "other-data",
                    at,
                    message,
                    tr!("check-gl-write", text = other),
                    case.replaced(at, call),
                ));
            }
        }
    }
    if let Some((_, right)) = lists(case.reference).into_iter().next() {
        for (at, step) in case.before() {
            let GlCall::Data { name, numbers } = &step.call else { continue };
            if *numbers != right {
                let call = GlCall::Data { name: name.clone(), numbers: right.clone() };
                let message = tr!("check-gl-does-not-contain-the-exercise-s", name = name);
                let corrected = case.replaced(at, call);
                found.push(case.suspect(
                    "data-changed",
                    at,
                    message,
                    tr!("check-gl-restore-the-original-numbers"),
                    corrected,
                ));
            }
        }
    }
}
