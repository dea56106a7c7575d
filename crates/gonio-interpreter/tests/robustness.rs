//! No shader makes the interpreter panic, hang, or exhaust the stack, however odd it is.
#![allow(clippy::unwrap_used)]

use gonio_fixtures::FixtureTable;
use gonio_glsl::Stage;
use gonio_interpreter::{LANES, PointValues, RunOptions, StageInputs, compile, run};
use std::fmt::Write as _;

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
        let mut parsed = gonio_glsl::parse(&source);
        let checked = gonio_glsl::check(&mut parsed, stage);
        // `double` and a struct without a name are the only things in them that cannot be run.
        match compile(&parsed, &checked) {
            Ok(_) => assert!(process(&source) > 0, "{source}"),
            Err(error) => {
                let known = source.contains("double") || source.contains("uniform struct {");
                assert!(known, "{error}\n{source}");
            }
        }
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
    let mut parsed = gonio_glsl::parse(array);
    let checked = gonio_glsl::check(&mut parsed, Stage::Fragment);
    let stage = compile(&parsed, &checked).unwrap();
    let mut inputs = StageInputs::new(&stage, LANES);
    let x: Vec<f32> = (0..LANES).map(|point| point as f32).collect();
    inputs.set_named(&stage, "x", PointValues::each(&[&x]));
    let result = run(&stage, &inputs, &RunOptions::default());
    assert_eq!((result.ended, result.outputs[0].float(0, 100)), (None, 200.0));
}
