//! Measures the checker: makes each mistake of the catalogue in the exercise's model solution, and checks the result.

use crate::check::{Checker, check};
use crate::exercise::Exercise;
use gonio_check::CheckOptions;
use gonio_check::mistakes::{Hypotheses, Hypothesis};
use gonio_check::search::{Comparison, Evidence, Task};
use gonio_check::submission::SourceFile;
use gonio_check::verdict::{Outcome, Verdict};
use gonio_gl::GlError;
use serde::{Deserialize, Serialize};

/// Counts of mistakes by how they were named.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct MistakeCounts {
    /// Mistakes that are visible in some scene.
    pub visible: usize,
    /// Mistakes that were named, alone or among alternatives with the same picture.
    pub named: usize,
    /// Submissions that were called wrong, without a mistake being named.
    pub unnamed: usize,
    /// Mistakes that were given another name: the mistakes made, and those named.
    pub misnamed: Vec<(String, String)>,
    /// Mistakes that are invisible in this exercise, and called right.
    pub invisible: usize,
    /// Pairs in which one mistake hides the other, and explains the whole picture alone.
    pub hidden: usize,
}

impl MistakeCounts {
    /// The share of visible mistakes that were named; 1 if none is visible.
    pub fn share(&self) -> f64 {
        if self.visible == 0 { 1.0 } else { self.named as f64 / self.visible as f64 }
    }

    fn add(&mut self, made: &[&str], verdict: &Verdict) {
        if verdict.verdict == Outcome::Correct {
            self.invisible += 1;
            return;
        }
        // Named by its id, or by an alternative with the same picture.
        let is_made = |found: &gonio_check::verdict::FoundMistake| {
            made.iter().any(|id| found.id == *id || found.or.iter().any(|or| or == id))
        };
        let whole = verdict.mistakes.iter().all(|found| found.share_explained >= 1.0 && is_made(found));
        if whole && !verdict.mistakes.is_empty() && verdict.mistakes.len() < made.len() {
            self.hidden += 1;
            return;
        }
        self.visible += 1;
        let is_named =
            |id: &&str| verdict.mistakes.iter().any(|found| found.id == **id || found.or.iter().any(|or| or == *id));
        let named: Vec<&str> = verdict.mistakes.iter().map(|found| found.id.as_str()).collect();
        if made.iter().all(is_named) && named.len() == made.len() {
            self.named += 1;
        } else if named.is_empty() {
            self.unnamed += 1;
        } else {
            self.misnamed.push((made.join(" and "), named.join(" and ")));
        }
    }
}

/// The measurement of an exercise.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Score {
    /// The exercise's id.
    pub exercise: String,
    /// Single mistakes.
    pub single: MistakeCounts,
    /// Pairs of mistakes.
    pub pairs: MistakeCounts,
}

/// Makes every variant of every mistake of the catalogue in an exercise's model solution, and `pairs` pairs of them, spread
/// evenly over all pairs, and checks each.
pub fn measure(checker: &mut Checker, exercise: &Exercise, pairs: usize) -> Result<Score, GlError> {
    let mut score = Score { exercise: exercise.id.clone(), ..Score::default() };
    let Some(task) = Task::find(&exercise.id) else { return Ok(score) };
    let hypotheses = Hypotheses::for_model(task.model);
    let is_wrong = |h: &&Hypothesis| h.mistakes.iter().all(|&m| !hypotheses.mistakes[m].harmless);
    let singles: Vec<&Hypothesis> = hypotheses.singles.iter().filter(is_wrong).collect();
    let mut hand_in = |hypothesis: &Hypothesis| -> Result<(Verdict, Option<Evidence>), GlError> {
        let [vertex, fragment] = hypotheses.written(hypothesis);
        let files = vec![SourceFile::new("made.vert", vertex), SourceFile::new("made.frag", fragment)];
        check(checker, exercise, files, &CheckOptions::default())
    };
    let ids =
        |h: &Hypothesis| -> Vec<&str> { h.mistakes.iter().map(|&m| hypotheses.mistakes[m].id.as_str()).collect() };
    // Mistakes that are visible alone: only these can be part of a pair.
    let mut shown: Vec<(&Hypothesis, Option<Evidence>)> = Vec::new();
    for single in &singles {
        let (verdict, evidence) = hand_in(single)?;
        score.single.add(&ids(single), &verdict);
        if verdict.verdict != Outcome::Correct {
            shown.push((single, evidence));
        }
    }
    let all = shown.len() * shown.len().saturating_sub(1) / 2;
    let step = (all / pairs.max(1)).max(1);
    let both = shown.iter().enumerate().flat_map(|(i, a)| shown[i + 1..].iter().map(move |b| (a, b)));
    for ((a, drawn_by_a), (b, drawn_by_b)) in both.step_by(step).take(pairs) {
        let Some(both) = a.and(b).filter(|both| ids(both).windows(2).all(|pair| pair[0] != pair[1])) else { continue };
        let (verdict, evidence) = hand_in(&both)?;
        if [drawn_by_a, drawn_by_b].into_iter().any(|alone| is_same_picture(&evidence, alone)) {
            score.pairs.hidden += 1;
        } else {
            score.pairs.add(&ids(&both), &verdict);
        }
    }
    Ok(score)
}

/// Whether one of two mistakes draws the same picture alone, so that no picture shows that there are two.
fn is_same_picture(both: &Option<Evidence>, alone: &Option<Evidence>) -> bool {
    let (Some(both), Some(alone)) = (both, alone) else { return false };
    Comparison::new(&both.seen, &alone.seen, both.scenes.len()).is_same()
}
