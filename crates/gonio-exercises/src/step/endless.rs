//! The loop of a pair of shaders that never ends, found on the CPU.

use super::{StepOptions, StepWork, SteppedPair, SteppedScene, SteppedStage};
use crate::exercise::Exercise;
use crate::preview::{self, SubmittedPair};
use gonio_check::roles::Bindings;
use gonio_check::verdict::CompilerMessage;
use gonio_language::tr;
use std::sync::Arc;

/// Side of the picture whose pixels are tried.
const SIDE: u32 = 64;
/// Places in the picture, as shares of its sides, beside which a drawn pixel is tried.
const PLACES: [[f32; 2]; 5] = [[0.5, 0.5], [0.25, 0.4], [0.75, 0.6], [0.4, 0.8], [0.6, 0.2]];
/// A tenth of a second for the vertices, and as much for each pixel: some 100,000 passes of a short loop.
const WORK: StepWork = StepWork { vertices: 1_000_000, point: 1_000_000, picture: 1 };

/// A loop that does not end.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EndlessLoop {
    /// The file.
    pub file: String,
    /// The line at which the loop begins, from 1.
    pub line: u32,
}

impl EndlessLoop {
    /// A message at its line.
    #[must_use]
    pub fn message(&self) -> CompilerMessage {
        CompilerMessage {
            file: self.file.clone(),
            line: Some(self.line),
            column: None,
            text: tr!("check-step-this-loop-never-ends").to_owned(),
            quoted: None,
            explanation: None,
        }
    }
}

impl std::fmt::Display for EndlessLoop {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&tr!("check-step-the-loop-in-line-of-never", line = self.line, file = self.file))
    }
}

/// Finds a loop that does not end at some vertices and pixels of the exercise's preview scenes, within 100,000 passes. `None` if
/// there is none at these, or if the pair cannot be run on the CPU. Takes at most about a second.
#[must_use]
pub fn endless_loop(exercise: &Exercise, submitted: &SubmittedPair) -> Option<EndlessLoop> {
    // Without a compiled program, every variable is bound by its name and type.
    let pair = Arc::new(SteppedPair::new(submitted, &Bindings::default()).ok()?);
    let found = |stage: &SteppedStage, line: u32| EndlessLoop { file: stage.text.file.clone(), line };
    preview::scenes(exercise).iter().find_map(|scene| {
        let objects = scene.test_scenes(&scene.eye, 0.0, [SIDE; 2]);
        let drawn = SteppedScene::new(pair.clone(), &objects, StepOptions { work: WORK, ..StepOptions::square(SIDE) });
        if let Some(vertex) = drawn.endless_vertex() {
            return drawn.endless_line_at_vertex(vertex).map(|line| found(&pair.vertex, line));
        }
        PLACES.iter().find_map(|place| {
            let pixel = place.map(|share| (share * SIDE as f32) as u32);
            let line = drawn.endless_line_at_pixel(drawn.nearest_drawn(pixel)?)?;
            Some(found(&pair.fragment, line))
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exercise;
    use gonio_check::submission::SourceFile;

    #[test]
    fn an_endless_loop_is_found_in_either_stage_and_in_no_right_answer() {
        let ex04 = exercise::find("ex04").unwrap();
        let found = |change: &dyn Fn(&str, &str) -> String| {
            let files = ex04.reference_files().unwrap().map(|(name, text)| SourceFile::new(name, change(name, text)));
            endless_loop(ex04, &SubmittedPair::gather(ex04, files.collect()).unwrap())
        };
        assert_eq!(found(&|_, text| text.to_owned()), None);
        let begin = "void main() {";
        for (name, end) in
            [("reference.vert", "while (true) { }"), ("reference.frag", "for (int i = 0; i < 5; i *= 2) { }")]
        {
            let change = |of: &str, text: &str| match of == name {
                true => text.replace(begin, &format!("{begin}\n{end}")),
                false => text.to_owned(),
            };
            let text = ex04.file(name).unwrap();
            let line = 2 + text.lines().position(|line| line.contains(begin)).unwrap() as u32;
            assert_eq!(found(&change), Some(EndlessLoop { file: name.to_owned(), line }), "{name}");
        }
        let ends = "for (int i = 0; i < 1000; i++) { }";
        assert_eq!(found(&|_, text| text.replace(begin, &format!("{begin}\n{ends}"))), None);
    }
}
