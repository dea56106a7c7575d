//! The semantics of the language, on the CPU alone; and no shader makes the interpreter panic, hang, or exhaust the stack.
#![allow(clippy::unwrap_used)]

use gonio_fixtures::FixtureTable;
use gonio_glsl::Stage;
use gonio_interpreter::{
    AnomalyKind, CompiledStage, LANES, PointValues, RunOptions, StageInputs, StageRun, Substitute, compile, run,
};
use std::fmt::Write as _;

fn compiled(stage: Stage, source: &str) -> CompiledStage {
    let mut parsed = gonio_glsl::parse(source);
    let checked = gonio_glsl::check(&mut parsed, stage);
    compile(&parsed, &checked).unwrap_or_else(|error| panic!("{error}\n{source}"))
}

/// Points with x = 0, 1, 2, ...
const POINTS: usize = 300;

fn shader(body: &str) -> CompiledStage {
    let (before, main) = body.split_once("---").unwrap_or(("", body));
    let source =
        format!("#version 400\nin float x;\nout vec4 r;\n{before}\nvoid main() {{\n r = vec4(0.0);\n{main}\n}}\n");
    compiled(Stage::Vertex, &source)
}

fn run_with(stage: &CompiledStage, options: &RunOptions<'_>) -> StageRun {
    let mut inputs = StageInputs::new(stage, POINTS);
    let x: Vec<f32> = (0..POINTS).map(|point| point as f32).collect();
    inputs.set_named(stage, "x", PointValues::each(&[&x]));
    run(stage, &inputs, options)
}

/// Checks `r.x` at all points.
#[track_caller]
fn gives(body: &str, expected: impl Fn(f32) -> f32) {
    let stage = shader(body);
    let result = run_with(&stage, &RunOptions::default());
    assert_eq!(result.ended, None, "{body}");
    let r = result.output(&stage, "r").unwrap();
    for point in 0..POINTS {
        let (found, expected) = (r.float(0, point), expected(point as f32));
        assert!(
            found == expected || (found.is_nan() && expected.is_nan()),
            "{body}\nat {point}: {found}, not {expected}"
        );
    }
}

#[test]
fn branches_and_loops_apply_to_their_points_alone() {
    gives("if (x < 100.0) r.x = 1.0; else if (x < 200.0) r.x = 2.0; else r.x = 3.0;", |x| {
        if x < 100.0 {
            1.0
        } else if x < 200.0 {
            2.0
        } else {
            3.0
        }
    });
    gives("for (int i = 0; i < int(x); ++i) { if (i == 7) break; if (i == 3) continue; r.x += 1.0; }", |x| {
        x.min(7.0) - f32::from(u8::from(x > 3.0))
    });
    gives("int i = 0; do { r.x += 2.0; i++; } while (float(i) < x && i < 5);", |x| 2.0 * x.clamp(1.0, 5.0));
    gives("float i = x; while (i > 0.0) { if (mod(i, 2.0) == 1.0) { i -= 1.0; continue; } i -= 2.0; r.x++; }", |x| {
        (x / 2.0).floor()
    });
    gives("for (int i = 0; i < 3; i++) for (int j = 0; j < 4; j++) { if (float(j) > x) break; r.x += 1.0; }", |x| {
        3.0 * (x + 1.0).min(4.0)
    });
}

#[test]
fn switches_fall_through() {
    let expected = |x: f32| match x as i32 % 6 {
        0 => 1.0,
        1 => 11.0,
        2 => 10.0,
        3 => 110.0,
        _ => 100.0,
    };
    gives(
        "switch (int(x) % 6) { case 0: r.x = 1.0; break; case 1: r.x += 1.0; case 2: r.x += 10.0; break; \
         case 3: r.x += 10.0; default: r.x += 100.0; }",
        expected,
    );
    // `default` in the middle, and `continue` of the loop around.
    gives(
        "for (int i = 0; i < 2; i++) { switch (int(x) % 3) { default: r.x += 1.0; case 1: r.x += 10.0; break; \
         case 2: continue; } r.x += 100.0; }",
        |x| match x as i32 % 3 {
            0 => 222.0,
            1 => 220.0,
            _ => 0.0,
        },
    );
}

#[test]
fn functions_return_early_and_copy_their_arguments() {
    gives(
        "float f(float a) { if (a < 50.0) return 1.0; a += 1.0; if (a > 99.0) { return a; } return 0.0; } --- r.x = f(x) + x;",
        |x| {
            x + if x < 50.0 {
                1.0
            } else if x + 1.0 > 99.0 {
                x + 1.0
            } else {
                0.0
            }
        },
    );
    // `inout` arguments are copied in and out, from left to right, also if they are the same variable.
    gives("void f(inout float a, inout float b) { a += 1.0; b += 10.0; } --- float v = x; f(v, v); r.x = v;", |x| {
        x + 10.0
    });
    gives(
        "void f(out vec2 a, in float b) { a = vec2(b, b + 1.0); } --- vec3 v = vec3(0.0); f(v.zy, x); r.x = v.y * 1000.0 + v.z;",
        |x| (x + 1.0) * 1000.0 + x,
    );
    gives(
        "float g = 0.0; bool f() { g += 1.0; return true; } --- bool b = x > 9.0 && f(); b = x > 9.0 || f(); r.x = g;",
        |_| 1.0,
    );
    gives("float g = 0.0; float f() { g += 1.0; return 5.0; } --- r.x = x > 9.0 ? f() : 7.0; r.x += g;", |x| {
        if x > 9.0 { 6.0 } else { 7.0 }
    });
    gives(
        "int f(int a) { return 1; } int f(float a) { return 2; } int f(vec2 a) { return 3; } --- r.x = float(f(1) * 100 + f(x) * 10 + f(vec2(x)));",
        |_| 123.0,
    );
}

#[test]
fn an_argument_may_call_the_same_function() {
    let difference = "float f(float a, float b) { return a - 2.0 * b; } ---";
    gives(&format!("{difference} r.x = f(x, f(1.0, x));"), |x| 5.0 * x - 2.0);
    gives(&format!("{difference} r.x = f(f(x, 1.0), 3.0);"), |x| x - 8.0);
    let first = "float first(out float a, float b) { a = b; return b + 1.0; } ---";
    gives(&format!("{first} float u, v; r.x = first(u, first(v, x)) + 10.0 * u + 100.0 * v;"), |x| {
        x + 2.0 + 10.0 * (x + 1.0) + 100.0 * x
    });
}

#[test]
fn structs_and_arrays_are_copied() {
    gives(
        "struct S { vec2 a[2]; float b; }; --- S s = S(vec2[2](vec2(x), vec2(1.0)), 2.0); S t = s; t.a[1].y = 9.0; r.x = s.a[1].y + t.a[1].y * 10.0 + s.a[0].x * 0.0;",
        |_| 91.0,
    );
    gives("float a[5]; for (int i = 0; i < 5; i++) a[i] = float(i * i); r.x = a[int(x) % 5];", |x| {
        (x % 5.0) * (x % 5.0)
    });
    gives(
        "float a[5] = float[](0.0, 0.0, 0.0, 0.0, 0.0); a[int(x) % 5] = x; r.x = a[int(x) % 5] + a[(int(x) + 1) % 5];",
        |x| x,
    );
    gives("vec4 v = vec4(1.0, 2.0, 3.0, 4.0); r.x = v[int(x) % 4] + v.wzyx[int(x) % 4];", |_| 5.0);
    gives("mat3 m = mat3(1.0); m[int(x) % 3][1] = 7.0; r.x = m[int(x) % 3].y;", |_| 7.0);
    gives("bool same = vec2[2](vec2(x), vec2(1.0)) == vec2[2](vec2(x), vec2(1.0)); r.x = same ? 1.0 : 0.0;", |_| 1.0);
}

#[test]
fn indices_out_of_range_read_zero_and_write_nothing() {
    let body = "float a[3] = float[3](1.0, 2.0, 3.0); int i = int(x) - 1; a[i] = a[i] + 10.0; r.x = a[0] + a[1] + a[2] + a[i];";
    gives(body, |x| match x as i32 {
        1 => 16.0 + 11.0,
        2 => 16.0 + 12.0,
        3 => 16.0 + 13.0,
        _ => 6.0,
    });
    let found = run_with(&shader(body), &RunOptions::default());
    assert!(found.anomalies.iter().any(|a| a.kind == AnomalyKind::IndexOutOfRange && a.point == 0));
}

#[test]
fn integers_wrap_around() {
    gives("int a = 2147483647; a += int(x) * 0 + 1; r.x = a == -2147483647 - 1 ? 1.0 : 0.0;", |_| 1.0);
    gives("uint a = 0u; a -= uint(x); r.x = float(a & 0xffu);", |x| (0_u32.wrapping_sub(x as u32) & 0xff) as f32);
    gives("r.x = float((int(x) - 150) / 7);", |x| ((x as i32 - 150) / 7) as f32);
    gives("r.x = float(((int(x) << 3) ^ 5) >> 1 | ~int(x) & 1);", |x| {
        ((((x as i32) << 3) ^ 5) >> 1 | !(x as i32) & 1) as f32
    });
    gives("r.x = float(bitCount(int(x)) + findMSB(int(x)) * 10 + int(bitfieldExtract(uint(x), 1, 3)) * 1000);", |x| {
        let x = x as i32;
        (x.count_ones() as i32 + (31 - x.leading_zeros() as i32) * 10 + ((x >> 1) & 7) * 1000) as f32
    });
}

#[test]
fn matrices_are_columns() {
    gives(
        "mat2x3 m = mat2x3(1.0, 2.0, 3.0, 4.0, 5.0, 6.0); vec3 v = m * vec2(x, 1.0); r.x = v.x + v.y * 10.0 + v.z * 100.0;",
        |x| (x + 4.0) + (2.0 * x + 5.0) * 10.0 + (3.0 * x + 6.0) * 100.0,
    );
    gives(
        "mat2x3 m = mat2x3(1.0, 2.0, 3.0, 4.0, 5.0, 6.0); vec2 v = vec3(x, 1.0, 0.0) * m; r.x = v.x + v.y * 10.0;",
        |x| (x + 2.0) + (4.0 * x + 5.0) * 10.0,
    );
    gives(
        "mat3x2 a = transpose(mat2x3(1.0, 2.0, 3.0, 4.0, 5.0, 6.0)); mat3 m = outerProduct(vec3(1.0, 2.0, 3.0), vec3(x)); r.x = a[2][1] + m[1][2] + mat4(m)[3][3];",
        |x| 6.0 + 3.0 * x + 1.0,
    );
    gives("mat3 m = mat3(2.0); m *= m; r.x = (inverse(m) * vec3(x)).y * 4.0 + determinant(m);", |x| x + 64.0);
}

#[test]
fn values_that_were_never_written_are_found() {
    let stage = shader("float y; if (x > 10.0) y = 1.0; r.x = y;");
    let found = run_with(&stage, &RunOptions::default());
    let unset: Vec<_> = found.anomalies.iter().filter(|a| a.kind == AnomalyKind::ReadBeforeWritten).collect();
    assert_eq!(unset.len(), 1);
    assert_eq!((unset[0].point, unset[0].count), (0, 11));
    let expression = stage.source.expression(unset[0].expr).unwrap();
    assert_eq!(expression.span.line, 7);
    let r = found.output(&stage, "r").unwrap();
    assert!(!r.is_written(10) && r.is_written(11));
    // A copy of a struct with unwritten members is not a read of them.
    let stage = shader("struct S { float a, b; }; --- S s; s.a = x; S t = s; r.x = t.a;");
    assert_eq!(run_with(&stage, &RunOptions::default()).anomalies, []);
}

#[test]
fn the_origin_of_a_nan_is_its_first_expression() {
    let body = "float a = x - 5.0; float b = sqrt(a); vec3 n = normalize(vec3(b * 0.0)); r.xyz = n + b;";
    let stage = shader(body);
    let found = run_with(&stage, &RunOptions { find_non_finite: true, ..RunOptions::default() });
    let place = |point: usize| stage.source.expression(found.non_finite[point].unwrap()).unwrap().span.column;
    // Negative numbers below 5; for the others `normalize` divides by 0.
    assert_eq!((place(0), place(4), place(5), place(299)), (30, 30, 48, 48));
    assert!(found.anomalies.iter().any(|a| a.kind == AnomalyKind::NonFinite && a.count == 5));
    let stage = shader("r.x = x > 4.0 ? sqrt(x - 5.0) : 0.0; if (x > 9.0) { r.x += 1.0 / (x - 5.0); }");
    let found = run_with(&stage, &RunOptions { find_non_finite: true, ..RunOptions::default() });
    assert_eq!(found.anomalies, [], "nothing is reported for points that do not evaluate it");
}

#[test]
fn endless_loops_end() {
    for body in ["while (true) { r.x += 1.0; }", "for (;;) { if (x < 0.0) break; }", "do { } while (x >= 0.0);"] {
        let stage = shader(body);
        let found = run_with(&stage, &RunOptions { most_work: 100_000, ..RunOptions::default() });
        assert!(found.ended.is_some(), "{body}");
    }
}

#[test]
fn expressions_are_watched_in_every_call_and_iteration() {
    let body = "float f(float a) { return a * 2.0; } --- for (int i = 0; i < 2; i++) { r.x += f(x); if (x > 255.5) r.x += f(1.0); }";
    let stage = shader(body);
    let text = "a * 2.0";
    let found = stage
        .source
        .expressions
        .iter()
        .position(|e| e.function.as_deref() == Some("f") && e.span.end - e.span.start == text.len() as u32);
    let expr = gonio_interpreter::ExprId(found.unwrap() as u32);
    let watched = [expr];
    let result = run_with(&stage, &RunOptions { watched: &watched, ..RunOptions::default() });
    // Two calls in two iterations; no point of the first block comes to the second call.
    let seen: Vec<_> = result.evaluations.iter().map(|e| (e.first_point, e.frame, e.iterations[0])).collect();
    assert_eq!(seen, [(0, 1, 0), (0, 1, 1), (256, 1, 0), (256, 2, 0), (256, 1, 1), (256, 2, 1)]);
    assert_eq!(result.evaluations[0].values.float(0, 5), 10.0);
    assert_eq!(stage.frames[2].function, "f");
    // With another value from there on.
    let substitutes = [Substitute { expr, occurrence: None, values: PointValues::floats(&[100.0]) }];
    let result = run_with(&stage, &RunOptions { substitutes: &substitutes, ..RunOptions::default() });
    let r = result.output(&stage, "r").unwrap();
    assert_eq!((r.float(0, 3), r.float(0, 299)), (200.0, 400.0));
}

#[test]
fn one_point_is_traced() {
    let stage = shader("float y = x; for (int i = 0; i < 2; i++) { if (x > 1.0) { y += 1.0; } } r.x = y;");
    let result = run_with(&stage, &RunOptions { traced_point: Some(2), ..RunOptions::default() });
    let name = |variable: u32| stage.variables[variable as usize].name.clone();
    let writes: Vec<(String, f32)> = result
        .trace
        .iter()
        .flat_map(|step| &step.writes)
        .map(|w| (name(w.variable), f32::from_bits(w.values[0])))
        .filter(|(name, _)| name == "y" || name == "r")
        .collect();
    let expected = [("r", 0.0), ("y", 2.0), ("y", 3.0), ("y", 4.0), ("r", 4.0)];
    assert_eq!(writes, expected.map(|(name, value)| (name.to_string(), value)));
    let iterations: Vec<_> =
        result.trace.iter().filter(|s| !s.iterations.is_empty()).map(|s| s.iterations[0]).collect();
    // `i++` begins the next iteration.
    assert_eq!(iterations, [0, 0, 1, 1, 1, 2]);
}

#[test]
fn writes_after_a_call_belong_to_the_caller() {
    let body = "float f(float a) { float b = a * 2.0; return b; }\n---\nfloat y = 0.0;\nfor (int i = 0; i < 2; i++)\n y += f(x);\nr.x = y;";
    let stage = shader(body);
    let result = run_with(&stage, &RunOptions { traced_point: Some(3), ..RunOptions::default() });
    let line = |step: &gonio_interpreter::TraceStep| {
        let statement = &stage.source.statements[step.statement.unwrap().0 as usize];
        statement.span.line
    };
    let seen: Vec<_> = result
        .trace
        .iter()
        .flat_map(|step| step.writes.iter().map(move |write| (step, write)))
        .map(|(step, write)| {
            let name = stage.variables[write.variable as usize].name.as_str();
            (name, line(step), stage.frames[step.frame as usize].function.as_str(), step.iterations.clone())
        })
        .filter(|(name, ..)| ["b", "y", "i"].contains(name))
        .collect();
    let expected = [
        ("y", 9, "main", vec![]),
        ("i", 10, "main", vec![]),
        ("b", 4, "f", vec![0]),
        ("y", 11, "main", vec![0]),
        ("i", 10, "main", vec![1]),
        ("b", 4, "f", vec![1]),
        ("y", 11, "main", vec![1]),
        ("i", 10, "main", vec![2]),
    ];
    assert_eq!(seen, expected);
}

#[test]
fn discarded_points_have_no_output() {
    let stage = compiled(
        Stage::Fragment,
        "#version 330 core\nin float x;\nout vec4 r;\nvoid main() { r = vec4(x); if (x > 100.0) discard; r.y = 2.0; }",
    );
    let result = run_with(&stage, &RunOptions::default());
    assert_eq!((result.discarded[100], result.discarded[101], result.discarded[299]), (false, true, true));
    assert_eq!(result.output(&stage, "r").unwrap().float(1, 100), 2.0);
}

#[test]
fn old_built_in_state_is_an_input() {
    let source = "varying vec3 n; void main() { n = gl_NormalMatrix * gl_Normal; gl_Position = ftransform(); \
                  gl_FrontColor = gl_LightSource[1].diffuse * gl_FrontMaterial.diffuse; }";
    let stage = compiled(Stage::Vertex, source);
    let mut inputs = StageInputs::new(&stage, 2);
    assert!(inputs.set_named(&stage, "gl_LightSource[1].diffuse", PointValues::floats(&[0.5; 4])));
    assert!(inputs.set_named(&stage, "gl_FrontMaterial.diffuse", PointValues::floats(&[0.5; 4])));
    assert!(inputs.set_named(&stage, "gl_NormalMatrix", PointValues::floats(&[2.0; 9])));
    assert!(inputs.set_named(&stage, "gl_Normal", PointValues::each(&[&[1.0, 2.0], &[0.0, 0.0], &[0.0, 0.0]])));
    let result = run(&stage, &inputs, &RunOptions::default());
    assert_eq!(result.output(&stage, "n").unwrap().float(1, 1), 4.0);
    assert_eq!(result.output(&stage, "gl_FrontColor").unwrap().float(2, 0), 0.25);
}

#[test]
fn doubles_have_the_precision_of_floats() {
    gives("double d = double(x) * 0.5lf + 1; dvec2 v = dvec2(d, 2.0); v.x += v.y; r.x = float(v.x);", |x| {
        x * 0.5 + 3.0
    });
    gives("double sum(in dvec3 v) { return v.x + v.y + v.z; } --- r.x = float(sum(dvec3(x, 1, 2u)));", |x| x + 3.0);
    gives("dmat2 m = dmat2(x); m[1].y = 2.0; r.x = float((m * dvec2(1.0, 3.0)).y);", |_| 6.0);
    gives("dvec3 v = dvec3(x, 0.0, 0.0); r.x = float(length(v) + max(v.x, 1.0));", |x| x + x.max(1.0));
    let stage =
        shader("uniform double gain[2]; uniform dvec2 place = dvec2(1.0, 2.0); --- r.x = float(gain[1] + place.y);");
    let mut inputs = StageInputs::new(&stage, 1);
    assert!(inputs.set_named(&stage, "gain", PointValues::floats(&[1.0, 2.5])));
    let result = run(&stage, &inputs, &RunOptions::default());
    assert_eq!(result.output(&stage, "r").unwrap().float(0, 0), 4.5);
}

#[test]
fn structs_without_a_name_have_members() {
    let stage = shader(
        "uniform struct { vec3 colour; struct { float k[2]; } inner; } material;\nstruct { float a, b; } local;\n--- \
         local.b = material.inner.k[1]; r.x = material.colour.y * local.b;",
    );
    let mut inputs = StageInputs::new(&stage, 1);
    assert!(inputs.set_named(&stage, "material.colour", PointValues::floats(&[1.0, 2.0, 3.0])));
    assert!(inputs.set_named(&stage, "material.inner.k", PointValues::floats(&[4.0, 5.0])));
    let result = run(&stage, &inputs, &RunOptions::default());
    assert_eq!(result.output(&stage, "r").unwrap().float(0, 0), 10.0);
}

#[test]
fn derivatives_are_those_of_quads() {
    let stage = compiled(
        Stage::Fragment,
        "#version 330 core\nin float x;\nout vec4 r;\nvoid main() { r = vec4(dFdx(x), dFdy(x * x), fwidth(x), 1.0); }",
    );
    let result = run_with(&stage, &RunOptions { quads: true, ..RunOptions::default() });
    let r = result.output(&stage, "r").unwrap();
    assert_eq!([0, 1, 2].map(|component| r.float(component, 4)), [1.0, 36.0 - 16.0, 3.0]);
}

/// Returns the shaders of gonio-glsl's table `pairs.txt`.
fn sources() -> Vec<String> {
    let table = FixtureTable::read(concat!(env!("CARGO_MANIFEST_DIR"), "/../gonio-glsl/tests/pairs.txt"));
    let table = table.unwrap_or_else(|error| panic!("{error}"));
    assert!(table.files().len() >= 50, "only {} shaders", table.files().len());
    table.files().iter().map(|file| String::from_utf8(file.bytes.clone()).expect("the file is UTF-8")).collect()
}

/// Compiles and runs a source as both stages, and returns how often it ran.
fn process(source: &str) -> usize {
    let mut ran = 0;
    for stage in [Stage::Vertex, Stage::Fragment] {
        let mut parsed = gonio_glsl::parse(source);
        let checked = gonio_glsl::check(&mut parsed, stage);
        let Ok(stage) = compile(&parsed, &checked) else { continue };
        let mut inputs = StageInputs::new(&stage, 3);
        for (index, input) in stage.inputs.iter().enumerate() {
            let n = input.ty.components().unwrap_or(1) * input.count;
            inputs.set(index, PointValues::floats(&(0..n).map(|at| at as f32 - 1.5).collect::<Vec<_>>()));
        }
        let options = RunOptions {
            quads: true,
            find_non_finite: true,
            traced_point: Some(1),
            most_work: 100_000,
            ..RunOptions::default()
        };
        let result = run(&stage, &inputs, &options);
        assert_eq!(result.outputs.len(), stage.outputs.len());
        ran += 1;
    }
    ran
}

#[test]
fn every_dialect_runs() {
    for source in sources() {
        let stage = if source.contains("gl_Position") { Stage::Vertex } else { Stage::Fragment };
        compiled(stage, &source);
        assert!(process(&source) > 0, "{source}");
    }
}

#[test]
fn words_removed_duplicated_and_swapped() {
    let mut random = 4321_u64;
    let mut next = |below: usize| {
        random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (random >> 33) as usize % below.max(1)
    };
    let mut ran = 0;
    for source in sources() {
        let words: Vec<&str> = source.split_inclusive([' ', '\n', '(', ')', ';', '{', '}', ',', '.', '*']).collect();
        for _ in 0..40 {
            let mut words = words.clone();
            for _ in 0..=next(2) {
                let (a, b) = (next(words.len()), next(words.len()));
                match next(3) {
                    0 => drop(words.remove(a)),
                    1 => words.insert(a, words[b]),
                    _ => words.swap(a, b),
                }
            }
            ran += process(&words.concat());
        }
    }
    assert!(ran > 100, "only {ran} ran");
}

/// What a page's thread has.
const SMALL_STACK: usize = 1 << 20;

fn on_a_small_stack(source: String) {
    let thread = std::thread::Builder::new().stack_size(SMALL_STACK);
    thread.spawn(move || process(&source)).unwrap().join().unwrap();
}

#[test]
fn deep_shaders_fit_a_small_stack() {
    let head = "#version 330 core\nout vec4 r;\n";
    let sum = format!("{head}void main() {{ float x = 1.0{}; r = vec4(x); }}", " + 1.0".repeat(250));
    on_a_small_stack(sum);
    let nested =
        format!("{head}void main() {{ float x = {}1.0{}; r = vec4(x); }}", "sin(".repeat(120), ")".repeat(120));
    on_a_small_stack(nested);
    let mut calls = format!("{head}float f0(float x) {{ return x; }}\n");
    for at in 1..250 {
        writeln!(calls, "float f{at}(float x) {{ return 1.0 + (2.0 * (x + f{}(x))); }}", at - 1).unwrap();
    }
    on_a_small_stack(format!("{calls}void main() {{ r = vec4(f249(1.0)); }}"));
}

#[test]
fn large_shaders_are_bounded() {
    // 2^14 calls by doubling, and arrays at the limit that differ from point to point.
    let mut source = "#version 330 core\nin float x;\nout vec4 r;\nfloat f0(float x) { return x; }\n".to_string();
    for at in 1..14 {
        writeln!(source, "float f{at}(float x) {{ return f{0}(x) + f{0}(x + 1.0); }}", at - 1).unwrap();
    }
    process(&format!("{source}void main() {{ r = vec4(f13(x)); }}"));
    let array = "#version 330 core\nin float x;\nout vec4 r;\nvoid main() { float a[16000]; \
                 for (int i = 0; i < 16000; i++) a[i] = x + float(i); r = vec4(a[int(x)]); }";
    let stage = compiled(Stage::Fragment, array);
    let mut inputs = StageInputs::new(&stage, LANES);
    let x: Vec<f32> = (0..LANES).map(|point| point as f32).collect();
    inputs.set_named(&stage, "x", PointValues::each(&[&x]));
    let result = run(&stage, &inputs, &RunOptions::default());
    assert_eq!((result.ended, result.outputs[0].float(0, 100)), (None, 200.0));
}
