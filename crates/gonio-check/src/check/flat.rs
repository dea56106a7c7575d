//! Values that are not interpolated: varyings that are declared `flat`.

use super::by_values::{Judged, Judging, ProgramValues, placed, wrong};
use crate::cause::edit::{TextEdit, TextFix};
use crate::cause::found::Found;
use crate::cause::{Diagnosis, DiagnosisDepth};
use crate::comparison::{ShaderChecker, endless_verdict, named};
use crate::compile::ParsedStage;
use crate::submission::StageText;
use gonio_gl::GlError;
use gonio_glsl::{Span, Stage};

/// The id of the mistake.
const NOT_INTERPOLATED: &str = "varying-flat";

/// A stage without the word `flat`, which is replaced by spaces, and where the word stands.
struct Interpolated {
    text: StageText,
    flat: Vec<Span>,
}

impl Judging<'_> {
    /// Judges a program that would be right if its varyings were interpolated. `None` if it is not such a program.
    ///
    /// # Errors
    /// Errors of the driver.
    pub(super) fn not_interpolated(
        &self,
        checker: &mut ShaderChecker,
        diagnosis: &Diagnosis,
    ) -> Result<Option<Judged>, GlError> {
        let stages = self.values.stages.map(interpolated);
        let Some(first) = [Stage::Vertex, Stage::Fragment]
            .into_iter()
            .zip(&stages)
            .find_map(|(stage, of)| Some((stage, *of.flat.first()?)))
        else {
            return Ok(None);
        };
        let [vertex, fragment] = &stages;
        let targets = self.values.stages.map(|stage| stage.target);
        let vertex = ParsedStage::new(&vertex.text, Stage::Vertex, targets[0]);
        let fragment = ParsedStage::new(&fragment.text, Stage::Fragment, targets[1]);
        let values = ProgramValues { stages: [&vertex, &fragment], depth: DiagnosisDepth::Right, ..self.values };
        let Some(right) = values.diagnose(&checker.solutions).filter(|right| matches!(right.found, Found::Right(_)))
        else {
            return Ok(None);
        };
        let Some(mistake) = named(NOT_INTERPOLATED, 1.0) else { return Ok(None) };
        let right = Diagnosis { bindings: diagnosis.bindings.clone(), ..right };
        let Some((verdict, evidence)) = self.pictures(checker, &right)? else {
            return Ok(Some(Judged {
                verdict: endless_verdict(self.values.task.exercise),
                evidence: None,
                fixes: Vec::new(),
            }));
        };
        let mistake = placed(mistake, first, self.submission);
        let fixes = vec![without(&stages)];
        Ok(Some(Judged { verdict: wrong(verdict, vec![mistake]), evidence: Some(evidence), fixes }))
    }
}

/// The edit that deletes the words.
fn without(stages: &[Interpolated; 2]) -> TextFix {
    let of_stage = |(stage, of): (Stage, &Interpolated)| {
        let edit = move |span: &Span| TextEdit { stage, start: span.start, end: span.end + 1, text: String::new() };
        of.flat.iter().map(edit).collect::<Vec<_>>()
    };
    [Stage::Vertex, Stage::Fragment].into_iter().zip(stages).flat_map(of_stage).collect()
}

fn interpolated(stage: &ParsedStage<'_>) -> Interpolated {
    let mut text = stage.text.clone();
    let word = |at: usize| {
        let place = stage.parsed.tokens.get(at)?;
        stage.text.text.get(place.start as usize..place.end as usize).filter(|_| place.region == 0)
    };
    let mut flat = Vec::new();
    for (at, place) in stage.parsed.tokens.iter().enumerate().filter(|(at, _)| word(*at) == Some("flat")) {
        // Integers are never interpolated.
        let declaration = (at..).map_while(word).take_while(|word| !matches!(*word, ";" | "{" | "}"));
        let is_integer =
            |word: &str| word == "int" || word == "uint" || word.starts_with("ivec") || word.starts_with("uvec");
        if declaration.into_iter().any(is_integer) {
            continue;
        }
        text.text.replace_range(place.start as usize..place.end as usize, "    ");
        flat.push(Span { start: place.start, end: place.end, ..place.span });
    }
    Interpolated { text, flat }
}
