//! What a program of the surroundings looks up, whatever it makes of it: a tint, a texture or a fog over a mirror is a choice,
//! and no mistake with the direction. The program is drawn once more, putting out what it looked up.

use crate::compile::ParsedStage;
use crate::rules::Analysis;
use crate::search::{Evidence, Prepared, ShaderChecker, Task};
use crate::verdict::{Outcome, Peculiarity, Verdict};
use gonio_gl::GlError;
use gonio_render::user_program::UserProgram;

/// Most look-ups of a program that are tried: of a mirror and a glass there are two.
const MOST: usize = 4;

/// Another verdict on a program that looks a cubemap up and is wrong without a name: of what it looks up alone. `None` where that
/// tells no more, or where no look-up flows into the colour.
pub(super) fn judge(
    checker: &mut ShaderChecker,
    task: &'static Task,
    [vertex, fragment]: [&ParsedStage<'_>; 2],
    prepared: &Prepared,
    source: &Analysis,
    verdict: &Verdict,
) -> Result<Option<(Verdict, Option<Evidence>)>, GlError> {
    if verdict.verdict != Outcome::Wrong || !verdict.mistakes.is_empty() || !task.model.is_looked_up() {
        return Ok(None);
    }
    let mut best: Option<(Verdict, Option<Evidence>)> = None;
    let lookups = fragment.lookups().into_iter().filter(|lookup| source.puts_out_lookup(lookup.span));
    for lookup in lookups.take(MOST) {
        let text = fragment.showing(lookup);
        let Ok(program) = UserProgram::new(checker.gl(), &vertex.translated.text, &text) else { continue };
        let (mut of_lookup, evidence) = checker.check(task, &program, prepared)?;
        of_lookup.bound.clone_from(&verdict.bound);
        let is_named = |verdict: &Verdict| verdict.verdict == Outcome::Wrong && !verdict.mistakes.is_empty();
        if of_lookup.verdict == Outcome::Correct {
            of_lookup.summary = "the lookup is right in every scene; its colour is changed afterwards".to_owned();
            of_lookup.peculiarities.push(Peculiarity {
                id: "lookup-mixed".to_owned(),
                name: "The colour of the cubemap is mixed with other colours; the pictures show the lookup alone"
                    .to_owned(),
            });
            return Ok(Some((of_lookup, evidence)));
        }
        let is_better = |best: &(Verdict, Option<Evidence>)| of_lookup.mistakes.len() < best.0.mistakes.len();
        if is_named(&of_lookup) && best.as_ref().is_none_or(is_better) {
            of_lookup.warnings.push(
                "the colour of the cubemap is mixed with other colours; only the lookup was judged, and the pictures \
                 show it"
                    .to_owned(),
            );
            best = Some((of_lookup, evidence));
        }
    }
    Ok(best)
}
