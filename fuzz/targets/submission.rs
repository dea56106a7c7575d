//! A student's submission of any content: gathered into a pair, with its names and lines.

#![no_main]

use gonio_check::dataflow::Shader;
use gonio_check::driver_log::{link_messages, to_messages};
use gonio_check::mistakes::{self, ModelSolution};
use gonio_check::roles::NamesFile;
use gonio_check::rules::Analysis;
use gonio_check::submission::{SourceFile, Submission};
use gonio_glsl::{Stage, check, parse};
use libfuzzer_sys::fuzz_target;

const MODELS: [ModelSolution; 5] = [
    ModelSolution::Gouraud,
    ModelSolution::Phong,
    ModelSolution::Reflection,
    ModelSolution::Refraction,
    ModelSolution::Skybox,
];

fuzz_target!(|data: &[u8]| {
    // A zero byte separates two files; without one both are the same, so that a single shader is a pair too. The length chooses
    // their names.
    let end = data.iter().position(|byte| *byte == 0);
    let (first, second) = end.map_or((data, data), |end| (&data[..end], &data[end + 1..]));
    let names = [["a.vert", "a.frag"], ["main.cpp", "b.txt"], ["both.glsl", "names.toml"], ["x", "y"]][data.len() % 4];
    let files = vec![SourceFile::new(names[0], first), SourceFile::new(names[1], second)];
    let Ok(submission) = Submission::gather(files) else { return };
    let names_file = submission.names.as_deref().map(NamesFile::parse).transpose();
    let Ok(names_file) = names_file.map(Option::unwrap_or_default) else { return };
    let mut vertex = parse(&submission.vertex.text);
    let mut fragment = parse(&submission.fragment.text);
    let checked = [check(&mut vertex, Stage::Vertex), check(&mut fragment, Stage::Fragment)];
    let source = Analysis::new(
        &Shader { parsed: &vertex, checked: &checked[0] },
        &Shader { parsed: &fragment, checked: &checked[1] },
        &names_file,
    );
    let _ = source.constants();
    let _ = source.in_source_only();
    for model in MODELS {
        for mistake in mistakes::for_model(model) {
            let support = source.support(&mistake.id, model);
            assert!((0.0..=1.0).contains(&support), "{}: {support}", mistake.id);
            if let Some(at) = source.line(&mistake.id, model) {
                let stage = if at.stage == Stage::Vertex { &submission.vertex } else { &submission.fragment };
                let (file, _, _) = stage.place(at.span.line, at.span.column);
                assert!(names.contains(&file), "{file}");
            }
        }
    }
    // A driver's log may be anything too.
    if let Ok(log) = std::str::from_utf8(second) {
        let _ = to_messages(log, &submission.vertex, 1);
        let _ = link_messages(log, &submission.vertex, &submission.fragment);
    }
});
