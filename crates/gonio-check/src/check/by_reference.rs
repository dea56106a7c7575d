//! Judges a program by the pictures of a teacher's own reference. A mistake is named if the reference with that mistake draws the
//! same pictures.

use crate::check::by_values::placed;
use crate::comparison::{
    Comparison, Evidence, MOST_FOR_WRONG, PIXEL_TOLERANCE, bound, declared, drawn_unless_endless, endless_verdict,
    fixed, pixel_difference, scene_verdicts, warn_of_undefined,
};
use crate::mistakes::TERMS;
use crate::picture_judge::{JudgePictures, OwnMistake, PictureJudge, WrittenMark};
use crate::roles::{self, Bindings, Bound, NamesFile, Role, VariableKind};
use crate::submission::{Submission, without_comments};
use crate::testbench::{Atlas, scene};
use crate::verdict::{FoundMistake, Outcome, TermState, TermVerdict, Verdict};
use gonio_gl::{Gl, GlError};
use gonio_glsl::{Span, Stage};
use gonio_language::tr;
use gonio_render::user_program::UserProgram;

/// The verdict on a program, without what the compilers report.
///
/// # Errors
/// Errors of the driver, and a reference that does not compile.
pub(super) fn judge(
    gl: &Gl,
    judge: &PictureJudge,
    id: &str,
    submission: &Submission,
    program: &UserProgram,
    names: &NamesFile,
) -> Result<(Verdict, Option<Evidence>), GlError> {
    let testbench = judge.testbench(gl)?;
    let bindings = roles::bind(&declared(program), &judge.names_with(names));
    let is_position = |b: &Bound| b.declared.kind == VariableKind::Attribute && b.role == Role::Position;
    // A program whose attributes are all known and none is the position does not read it, and is wrong.
    let is_open = bindings.unknown.iter().any(|declared| declared.kind == VariableKind::Attribute);
    if is_open && !bindings.bound.iter().any(is_position) {
        let mut verdict = Verdict::new(id, Outcome::Unsure, tr!("check-no-attribute-looks-like-the-position"));
        verdict.bound = bound(&bindings);
        return Ok((verdict, None));
    }
    let inputs = testbench.inputs(program, &bindings, |_| {});
    let [all, whole] = [judge.scenes.all.len(), judge.scenes.whole];
    let seen = drawn_unless_endless(program, &fixed(&bindings), &[1, all], |fixed, count| {
        let seen = testbench.draw(program, &inputs, fixed, count)?;
        testbench.error()?;
        Ok(seen)
    })?;
    let Some(seen) = seen else { return Ok((endless_verdict(id), None)) };
    let (reference, reads) = match &judge.reference {
        JudgePictures::Shaders(shaders) => {
            let drawn = judge.draw(&testbench, gl, shaders)?;
            (drawn.pictures, Some(drawn.bindings))
        }
        JudgePictures::Drawn(atlas) => (atlas.clone(), None),
    };
    let comparison = Comparison::new(&seen, &reference, all);
    let mut verdict = Verdict::new(id, Outcome::Wrong, "");
    verdict.scenes = scene_verdicts(&testbench, &Comparison::new(&seen, &reference, whole));
    verdict.bound = bound(&bindings);
    verdict.terms = terms(judge, &reference, &seen);
    warn_of_undefined(&mut verdict, &seen);
    let mut predicted = None;
    if comparison.is_same() {
        verdict.verdict = Outcome::Correct;
        verdict.score = 1.0;
        verdict.summary = tr!("check-right-in-every-scene").to_owned();
    } else {
        let right = verdict.scenes.iter().filter(|scene| scene.right).count();
        verdict.score = (right as f64 / whole.max(1) as f64).min(MOST_FOR_WRONG);
        let mut same: Vec<&OwnMistake> = Vec::new();
        for mistake in &judge.mistakes {
            let pictures = judge.pictures(&testbench, gl, &mistake.pictures)?;
            if Comparison::new(&seen, &pictures, all).is_same() {
                same.push(mistake);
                predicted.get_or_insert(pictures);
            }
        }
        match named(&same, submission) {
            Some(found) => {
                verdict.mistakes = vec![found];
                verdict.summary = verdict.mistake_names();
            }
            None => unexplained(&mut verdict, &bindings, reads.as_ref()),
        }
    }
    let scenes = judge.scenes.all.iter().take(whole).map(|scene| scene.name.clone()).collect();
    Ok((verdict, Some(Evidence { seen, reference, predicted, scenes })))
}

/// The terms that the reference has: what each adds to the picture without light.
fn terms(judge: &PictureJudge, reference: &Atlas, seen: &Atlas) -> Vec<TermVerdict> {
    let state = |term: &str| {
        let alone = judge.scenes.alone(term);
        // A term that changes nothing is not in the reference.
        let adds = |[lit, dark]: &[usize; 2]| {
            let pixels = reference.tile(*lit).iter().zip(reference.tile(*dark));
            pixels.into_iter().any(|(lit, dark)| pixel_difference(lit, dark) > PIXEL_TOLERANCE)
        };
        alone.iter().any(adds).then(|| {
            let added = |atlas: &Atlas| Atlas {
                pixels: alone.iter().flat_map(|[lit, dark]| difference(atlas.tile(*lit), atlas.tile(*dark))).collect(),
            };
            let is_right = Comparison::new(&added(seen), &added(reference), alone.len()).is_same();
            if is_right { TermState::Right } else { TermState::Wrong }
        })
    };
    TERMS.into_iter().filter_map(|term| Some(TermVerdict { term: term.into(), state: state(term)? })).collect()
}

/// The light that one picture has beyond another of the same object.
fn difference(lit: &[[f32; 4]], dark: &[[f32; 4]]) -> Vec<[f32; 4]> {
    let pixel = |(lit, dark): (&[f32; 4], &[f32; 4])| match Atlas::is_drawn(lit) {
        true => [lit[0] - dark[0], lit[1] - dark[1], lit[2] - dark[2], 1.0],
        false => *lit,
    };
    lit.iter().zip(dark).map(pixel).collect()
}

/// The mistake with the same pictures, at its line; others that no picture tells from it are named beside it.
fn named(same: &[&OwnMistake], submission: &Submission) -> Option<FoundMistake> {
    let place = |mistake: &&OwnMistake| mistake.written.iter().find_map(|written| line_with(submission, written));
    let first = same.iter().find(|mistake| place(mistake).is_some()).or(same.first())?;
    let texts = first.texts();
    let others = same.iter().filter(|other| other.id != first.id);
    let found = FoundMistake {
        or: others.map(|other| other.id.clone()).collect(),
        ..FoundMistake::new(&first.id, texts.name, 1.0)
    };
    let found = found.taught(texts.looks_like, texts.fix, &first.lecture_section);
    Some(match place(first) {
        Some((stage, line)) => placed(found, (stage, Span { line, column: 1, ..Span::default() }), submission),
        None => found,
    })
}

/// The first line that contains an expression.
fn line_with(submission: &Submission, written: &WrittenMark) -> Option<(Stage, u32)> {
    let of = |stage: Stage, text: &str| {
        let code = without_comments(text);
        let at = code.lines().position(|line| written.is_in(line))?;
        Some((stage, u32::try_from(at + 1).ok()?))
    };
    of(Stage::Fragment, &submission.fragment.text).or_else(|| of(Stage::Vertex, &submission.vertex.text))
}

/// Pictures that nothing explains: the inputs that are unknown, or never read, come first.
fn unexplained(verdict: &mut Verdict, bindings: &Bindings, reads: Option<&Bindings>) {
    let unknown = bindings.unknown.iter().filter(|declared| declared.kind == VariableKind::Uniform);
    let unknown: Vec<String> = unknown.map(|declared| format!("`{}`", declared.name)).collect();
    if !unknown.is_empty() {
        verdict.verdict = Outcome::Unsure;
        verdict.score = 0.0;
        verdict.summary = tr!("check-the-picture-differs-from-the-reference", names = unknown.join(", "));
        return;
    }
    let wrong: Vec<String> = verdict.scenes.iter().filter(|s| !s.right).map(|s| scene::title(&s.scene)).collect();
    verdict.summary = tr!("check-differs-from-the-reference-in", scenes = wrong.join(", "));
    let is_uniform = |bound: &&Bound| bound.declared.kind == VariableKind::Uniform;
    let missing = reads.into_iter().flat_map(|reads| reads.bound.iter().filter(is_uniform));
    let missing: Vec<String> = missing
        .filter(|bound| bindings.variable(bound.role).is_none())
        .map(|bound| format!("`{}`", bound.declared.name))
        .collect();
    if !missing.is_empty() {
        verdict.warnings.push(tr!("check-input-of-the-reference-not-read", names = missing.join(", ")));
    }
}
