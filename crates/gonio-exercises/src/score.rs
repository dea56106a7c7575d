//! Measures the checker: makes each mistake of the catalogue in the exercise's model solution, and checks the result; and
//! compares verdicts on generated programs with their labels.

use crate::check::{Checker, check};
use crate::exercise::Exercise;
use gonio_check::CheckOptions;
use gonio_check::comparison::{Comparison, Evidence};
use gonio_check::feedback::Feedback;
use gonio_check::mistakes::{Hypotheses, Hypothesis};
use gonio_check::submission::SourceFile;
use gonio_check::verdict::{FoundMistake, Outcome, Verdict};
use gonio_gl::GlError;
use gonio_submissions::{GeneratedPair, LabelledMistake};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Counts of mistakes by how they were named.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct MistakeCounts {
    /// Mistakes that are visible in some scene.
    pub visible: usize,
    /// Mistakes that were named, alone or among alternatives with the same picture.
    pub named: usize,
    /// Mistakes in submissions that were called wrong without a mistake being named.
    pub unnamed: Vec<String>,
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
            self.unnamed.push(made.join(" and "));
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
    let Some(task) = exercise.task() else { return Ok(score) };
    let hypotheses = Hypotheses::for_model(task.model);
    let is_wrong = |h: &&Hypothesis| h.mistakes.iter().all(|&m| !hypotheses.mistakes[m].harmless);
    let singles: Vec<&Hypothesis> = hypotheses.singles.iter().filter(is_wrong).collect();
    let mut hand_in = |hypothesis: &Hypothesis| -> Result<(Verdict, Option<Evidence>), GlError> {
        let [vertex, fragment] = hypotheses.written(hypothesis);
        let files = vec![SourceFile::new("made.vert", vertex), SourceFile::new("made.frag", fragment)];
        check(checker, exercise, files, &CheckOptions::default(), Feedback::Fix)
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

/// The comparison of a verdict with its label.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ScoredPair {
    /// The exercise's id.
    pub exercise: String,
    /// Its number in the series.
    pub index: u64,
    /// The mistakes that were made, by the generator's names.
    pub made: Vec<String>,
    /// Whether some mistake is in no list, so that it has no name.
    pub in_no_list: bool,
    /// The outcome, as verdicts write it.
    pub verdict: String,
    /// Whether the outcome is right.
    pub outcome_right: bool,
    /// The mistakes that the checker named.
    pub named: Vec<String>,
    /// Whether all mistakes were named, and no other.
    pub names_right: bool,
    /// Whether the checker pointed at a line of each mistake.
    pub lines_right: bool,
    /// Whether the rewritten programs got the same verdict; `None` if there are none.
    pub same_when_rewritten: Option<bool>,
    /// The other verdicts that rewritten programs got: outcome and mistakes.
    pub other_verdicts: Vec<String>,
    /// Whether a fix was proposed and passes; `None` unless a single mistake was named.
    pub fix_passes: Option<bool>,
    /// Mistakes that were left out because no picture shows them.
    pub invisible: usize,
}

fn answers(found: &FoundMistake, made: &LabelledMistake) -> bool {
    made.ids.iter().any(|id| found.id == *id || found.or.iter().any(|or| or == id))
}

/// Whether a verdict names each mistake that was made, and no other.
fn names_all(verdict: &Verdict, made: &[LabelledMistake]) -> bool {
    let is_named = |made: &LabelledMistake| verdict.mistakes.iter().any(|found| answers(found, made));
    verdict.mistakes.len() == made.len() && made.iter().all(is_named)
}

fn is_at(found: &FoundMistake, made: &LabelledMistake) -> bool {
    let (Some(file), Some(line)) = (&found.file, found.line) else { return false };
    made.places.iter().any(|(known, at)| known == file && *at == line)
}

/// Whether two mistakes are the same, or alternatives that no picture tells apart. Which of these comes first depends on
/// what the source shows.
fn is_same_mistake(a: &FoundMistake, b: &FoundMistake) -> bool {
    a.id == b.id || a.or.contains(&b.id) || b.or.contains(&a.id)
}

/// Whether verdicts on the same program in two styles agree: the outcome, and each mistake.
fn is_same_verdict(a: &Verdict, b: &Verdict) -> bool {
    let mut left: Vec<&FoundMistake> = b.mistakes.iter().collect();
    let all_found = a.mistakes.iter().all(|found| {
        let at = left.iter().position(|other| is_same_mistake(found, other));
        at.map(|at| left.swap_remove(at)).is_some()
    });
    a.verdict == b.verdict && all_found && left.is_empty()
}

impl ScoredPair {
    /// Compares a verdict with the label, and with the verdicts on the rewritten programs.
    /// `fixed` is the verdict on the files with the proposed fix, if there is one.
    pub fn new(pair: &GeneratedPair, verdict: &Verdict, rewritten: &[Verdict], fixed: Option<&Verdict>) -> Self {
        let right = if pair.mistakes.is_empty() { Outcome::Correct } else { Outcome::Wrong };
        let found = &verdict.mistakes;
        let names_right = names_all(verdict, &pair.mistakes);
        // The text may show which of two names with the same picture applies.
        let is_same = |other: &Verdict| {
            let both_name_all = names_right && names_all(other, &pair.mistakes);
            is_same_verdict(other, verdict) || both_name_all && other.verdict == verdict.verdict
        };
        let located = pair.mistakes.iter().all(|made| found.iter().any(|found| is_at(found, made)));
        let in_no_list = pair.mistakes.iter().any(|made| made.ids.is_empty());
        let has_fix_to_make = names_right && !in_no_list && pair.mistakes.len() == 1;
        ScoredPair {
            exercise: pair.exercise.to_owned(),
            index: pair.index,
            made: pair.mistakes.iter().map(|made| made.key.to_owned()).collect(),
            in_no_list,
            verdict: outcome_word(verdict.verdict).to_owned(),
            outcome_right: verdict.verdict == right,
            named: found.iter().map(|found| found.id.clone()).collect(),
            names_right,
            lines_right: located,
            same_when_rewritten: (!rewritten.is_empty()).then(|| rewritten.iter().all(is_same)),
            other_verdicts: rewritten.iter().filter(|other| !is_same(other)).map(in_short).collect(),
            fix_passes: has_fix_to_make.then(|| fixed.is_some_and(|fixed| fixed.verdict == Outcome::Correct)),
            invisible: pair.invisible.len(),
        }
    }

    /// Whether everything is as it should be.
    pub fn is_right(&self) -> bool {
        let complete = self.made.is_empty() || (self.names_right || self.in_no_list) && self.lines_right;
        self.outcome_right && complete && self.same_when_rewritten != Some(false)
    }

    /// One line about what is not.
    pub fn complaint(&self) -> String {
        let made = if self.made.is_empty() { "correct".to_owned() } else { self.made.join(" and ") };
        let mut text = format!("{} pair {}: {made}: {}", self.exercise, self.index, self.verdict);
        if !self.named.is_empty() {
            text.push_str(&format!(", {}", self.named.join(" and ")));
        }
        if self.outcome_right && !self.made.is_empty() && !self.lines_right {
            text.push_str(", at another line");
        }
        for other in &self.other_verdicts {
            text.push_str(&format!("; after a rewrite: {other}"));
        }
        text
    }
}

/// The outcome and the mistakes of a verdict.
fn in_short(verdict: &Verdict) -> String {
    let named = verdict.mistakes.iter().map(|found| found.id.as_str()).collect::<Vec<_>>().join(" and ");
    let separator = if named.is_empty() { "" } else { ", " };
    format!("{}{separator}{named}", outcome_word(verdict.verdict))
}

/// The word for an outcome.
fn outcome_word(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Correct => "correct",
        Outcome::Wrong => "wrong",
        Outcome::DoesNotCompile => "does not compile",
        Outcome::Unsure => "unsure",
    }
}

/// How many of how many.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Share {
    /// Those that are as they should be.
    pub right: usize,
    /// All of them.
    pub all: usize,
}

impl Share {
    fn add(&mut self, right: bool) {
        self.right += usize::from(right);
        self.all += 1;
    }

    /// Whether a share is reached; an empty one reaches everything.
    pub fn reaches(self, least: f64) -> bool {
        self.right as f64 >= least * self.all as f64
    }
}

impl std::fmt::Display for Share {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.all {
            0 => f.write_str("-"),
            all => write!(f, "{} of {all} ({:.0} %)", self.right, 100.0 * self.right as f64 / all as f64),
        }
    }
}

/// The counts of an exercise, or of all.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct GeneratedScore {
    /// The exercise's id, or `all`.
    pub exercise: String,
    /// Correct programs that were called correct.
    pub correct: Share,
    /// Correct programs that were called wrong.
    pub false_alarms: usize,
    /// Programs of any kind whose outcome is right.
    pub outcomes: Share,
    /// Single mistakes of the catalogue that were named.
    pub single_named: Share,
    /// Single mistakes of the catalogue that were named, with the right line.
    pub single_located: Share,
    /// Single mistakes in no list that were called wrong.
    pub unlisted_found: Share,
    /// Single mistakes in no list with the right line.
    pub unlisted_located: Share,
    /// Pairs of mistakes of the catalogue that were named.
    pub pairs_named: Share,
    /// Pairs of mistakes with both lines right.
    pub pairs_located: Share,
    /// Programs whose rewrites got the same verdict.
    pub same_when_rewritten: Share,
    /// Named single mistakes with a proposed fix that passes; `None` if there are none.
    pub fixes: Option<Share>,
    /// Mistakes that were left out because no picture shows them.
    pub invisible: usize,
}

impl GeneratedScore {
    /// The counts of each exercise, and of all.
    pub fn of(pairs: &[ScoredPair]) -> Vec<GeneratedScore> {
        let mut scores: BTreeMap<&str, GeneratedScore> = BTreeMap::new();
        let mut total = GeneratedScore { exercise: "all".to_owned(), ..GeneratedScore::default() };
        for pair in pairs {
            let score = scores.entry(&pair.exercise).or_default();
            score.exercise.clone_from(&pair.exercise);
            score.add(pair);
            total.add(pair);
        }
        scores.into_values().chain([total]).collect()
    }

    fn add(&mut self, pair: &ScoredPair) {
        self.outcomes.add(pair.outcome_right);
        self.invisible += pair.invisible;
        match pair.made.len() {
            0 => {
                self.correct.add(pair.outcome_right);
                self.false_alarms += usize::from(pair.verdict == "wrong" || pair.verdict == "does not compile");
            }
            1 if pair.in_no_list => {
                self.unlisted_found.add(pair.outcome_right);
                self.unlisted_located.add(pair.outcome_right && pair.lines_right);
            }
            1 => {
                self.single_named.add(pair.names_right);
                self.single_located.add(pair.names_right && pair.lines_right);
            }
            _ => {
                if !pair.in_no_list {
                    self.pairs_named.add(pair.names_right);
                }
                self.pairs_located.add(pair.lines_right);
            }
        }
        if let Some(same) = pair.same_when_rewritten {
            self.same_when_rewritten.add(same);
        }
        if let Some(passes) = pair.fix_passes {
            self.fixes.get_or_insert_default().add(passes);
        }
    }

    /// Whether the goals are reached: no false alarm, 97 % of single mistakes with their line, 90 % of pairs, the same
    /// verdict after every rewrite, 95 % of fixes.
    pub fn reaches_the_goals(&self) -> bool {
        self.false_alarms == 0
            && self.single_located.reaches(0.97)
            && self.pairs_named.reaches(0.9)
            && self.same_when_rewritten.reaches(1.0)
            && self.fixes.is_none_or(|fixes| fixes.reaches(0.95))
    }
}

/// Checks a generated pair and its rewrites, and compares the verdicts with the label.
///
/// # Errors
/// Faults of the generator and errors of the driver, in words.
pub fn score_generated(checker: &mut Checker, exercise: &Exercise, pair: &GeneratedPair) -> Result<ScoredPair, String> {
    let sources = |files: &[(String, String)]| -> Vec<SourceFile> {
        files.iter().map(|(name, text)| SourceFile::new(name, text.clone())).collect()
    };
    let mut check_files = |files: Vec<SourceFile>| -> Result<Verdict, String> {
        let checked = check(checker, exercise, files, &CheckOptions::default(), Feedback::Fix);
        checked.map(|(verdict, _)| verdict).map_err(|error| error.to_string())
    };
    let files = sources(&pair.files);
    let verdict = check_files(files.clone())?;
    let rewritten = pair.rewrites.iter().map(|files| check_files(sources(files))).collect::<Result<Vec<_>, _>>()?;
    let fix = &verdict.proposed_fix;
    let changed = if fix.is_empty() { None } else { gonio_check::with_edits(&files, fix) };
    let fixed = changed.map(check_files).transpose()?;
    Ok(ScoredPair::new(pair, &verdict, &rewritten, fixed.as_ref()))
}
