//! Ranks hypotheses by how well they explain what a program draws.
//!
//! Harmless peculiarities come first, then single mistakes, then pairs: the simplest explanation without a residual is named.

use super::compare::Comparison;
use super::on_cpu::{ComparisonDetail, CpuComparer};
use super::parameterisation::Lights;
use super::predict::{CompiledModel, ModelInputs, Strengths};
use crate::mistakes::{Hypothesis, Mistake, ModelSolution};
use crate::testbench::{Atlas, Testbench};
use gonio_gl::GlError;

/// A hypothesis that was tried.
#[derive(Clone, Debug)]
pub struct Tried<'a> {
    /// The index of the model solution.
    pub model: usize,
    /// Its mistakes and harmless peculiarities.
    pub mistakes: Vec<&'a Mistake>,
    /// The choices behind it.
    pub hypothesis: Hypothesis,
    /// The residual difference.
    pub residual: Comparison,
    /// The fitted strengths.
    pub strengths: Strengths,
    /// The picture that it draws, if the driver drew it.
    pub atlas: Option<Atlas>,
    /// The share of the difference that it explains, 0 to 1.
    pub explained: f64,
}

impl Tried<'_> {
    /// Returns the ids of the mistakes without harmless peculiarities.
    pub fn wrong(&self) -> Vec<&str> {
        self.mistakes.iter().filter(|m| !m.harmless).map(|m| m.id.as_str()).collect()
    }

    /// Returns the number of strengths above 0. Of two equal predictions, the one with fewer terms is simpler.
    fn terms_found(&self) -> usize {
        self.strengths.iter().flatten().filter(|strength| strength.iter().any(|s| s.abs() > 1e-3)).count()
    }

    /// Returns the largest share of a test scene's difference that it explains.
    pub(super) fn best_share(&self, difference: &Comparison) -> f64 {
        let share = |(seen, residual): (&f64, &f64)| if *seen > 1e-6 { 1.0 - residual / seen } else { 0.0 };
        difference.squares.iter().zip(&self.residual.squares).map(share).fold(0.0, f64::max)
    }

    /// Orders simpler and better explanations first.
    pub(super) fn order(&self, other: &Self) -> std::cmp::Ordering {
        let key = |tried: &Self| {
            let wrong = tried.mistakes.iter().filter(|m| !m.harmless).count();
            let model_is_other = tried.model > 0;
            (wrong, model_is_other, tried.mistakes.len(), tried.terms_found(), tried.hypothesis.mistakes.clone())
        };
        other
            .residual
            .is_same()
            .cmp(&self.residual.is_same())
            .then_with(|| if self.residual.is_same() { key(self).cmp(&key(other)) } else { std::cmp::Ordering::Equal })
            .then_with(|| other.explained.total_cmp(&self.explained))
    }
}

/// The result of the search.
pub struct Found<'a> {
    /// The nearest right answer.
    pub nearest_right: Tried<'a>,
    /// All tried hypotheses, best first, each set of mistakes once.
    pub ranking: Vec<Tried<'a>>,
}

/// The support of the source for a mistake in a model: 0 contradicted, 1 the very expression is there.
pub type Support<'s> = &'s dyn Fn(&str, usize) -> f32;

impl Found<'_> {
    /// Orders equally simple explanations without a residual by the support of the source.
    fn prefer(&mut self, support: Support<'_>) {
        let Some(first) = self.ranking.first().filter(|first| first.residual.is_same()) else { return };
        let (model, count) = (first.model, first.wrong().len());
        let equal =
            |tried: &Tried<'_>| tried.residual.is_same() && tried.model == model && tried.wrong().len() == count;
        let end = self.ranking.iter().position(|tried| !equal(tried)).unwrap_or(self.ranking.len());
        let support = |tried: &Tried<'_>| {
            let each = tried.wrong().into_iter().map(|id| support(id, model));
            each.sum::<f32>()
        };
        // The sort is stable: without evidence in the source, the order of the catalogue remains.
        self.ranking[..end].sort_by(|a, b| support(b).total_cmp(&support(a)));
    }
}

/// Hypotheses are ranked in this many test scenes; the first ones of each exercise distinguish most.
const TELLING: usize = 4;
/// Number of the best hypotheses that are then tried in all test scenes.
pub(super) const KEPT: usize = 16;
/// Most mistakes that are tried again with every peculiarity.
const TRIED_AGAIN: usize = 10;
/// Most hypotheses that the driver draws before a verdict.
const MOST_DRAWN: usize = 12;

/// The difference to explain: the residual of the plain model solution.
pub(super) struct Difference {
    pub(super) full: Comparison,
    pub(super) coarse: Comparison,
}

impl Difference {
    fn at(&self, detail: ComparisonDetail) -> &Comparison {
        if detail == ComparisonDetail::Full { &self.full } else { &self.coarse }
    }
}

/// A variant of the answer, right or wrong, that hypotheses change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SearchEntry {
    /// The model solution.
    pub model: ModelSolution,
    /// The lights that it covers.
    pub lights: Lights,
    /// Whether it is a right answer.
    pub is_right: bool,
    /// The id of the mistake, if it is one.
    pub word: Option<&'static str>,
}

/// The inputs of a search.
pub struct Search<'a> {
    /// The testbench that draws programs.
    pub testbench: &'a Testbench,
    /// The variants of the answer, the right one first.
    pub entries: &'a [SearchEntry],
    /// The model solution of each variant.
    pub models: &'a [&'a CompiledModel],
    /// The inputs of each model solution.
    pub model_inputs: &'a [ModelInputs],
    /// The comparer of each model solution on the CPU, if the interpreter supports it.
    pub comparers: &'a [Option<CpuComparer<'a>>],
    /// The pictures of the student's program.
    pub seen: &'a Atlas,
    /// Number of test scenes that count: those with one term alone do not if strengths are fitted.
    pub test_scenes: usize,
}

impl<'a> Search<'a> {
    /// Ranks many hypotheses at low resolution, and tries the best in full.
    pub(super) fn best_of(
        &self,
        model: usize,
        hypotheses: Vec<Hypothesis>,
        difference: &Difference,
    ) -> Result<Vec<Tried<'a>>, GlError> {
        if self.test_scenes <= TELLING || hypotheses.len() <= KEPT {
            return hypotheses.into_iter().map(|h| self.attempt(model, h, difference)).collect();
        }
        let tried = hypotheses.into_iter().map(|h| self.attempt_in(model, h, difference, ComparisonDetail::Coarse));
        let mut tried = tried.collect::<Result<Vec<_>, _>>()?;
        tried.sort_by(|a, b| a.order(b));
        tried.into_iter().take(KEPT).map(|tried| self.attempt(model, tried.hypothesis, difference)).collect()
    }

    pub(super) fn attempt(
        &self,
        model: usize,
        hypothesis: Hypothesis,
        difference: &Difference,
    ) -> Result<Tried<'a>, GlError> {
        self.attempt_in(model, hypothesis, difference, ComparisonDetail::Full)
    }

    pub(super) fn attempt_in(
        &self,
        model: usize,
        hypothesis: Hypothesis,
        difference: &Difference,
        detail: ComparisonDetail,
    ) -> Result<Tried<'a>, GlError> {
        let mut tried = self.unrated(model, hypothesis, detail)?;
        tried.explained = difference.at(detail).explained_by(&tried.residual);
        Ok(tried)
    }

    /// Tries a hypothesis on the CPU if possible, otherwise by the driver.
    fn unrated(&self, model: usize, hypothesis: Hypothesis, detail: ComparisonDetail) -> Result<Tried<'a>, GlError> {
        let Some(comparers) = self.comparers.get(model).and_then(Option::as_ref) else {
            let test_scenes =
                if detail == ComparisonDetail::Full { self.test_scenes } else { TELLING.min(self.test_scenes) };
            return self.drawn(model, hypothesis, test_scenes);
        };
        let (residual, strengths) = comparers.compare(&hypothesis, detail)?;
        let mistakes = self.mistakes(model, &hypothesis);
        Ok(Tried { model, mistakes, hypothesis, residual, strengths, atlas: None, explained: 0.0 })
    }

    /// Tries a hypothesis by the driver.
    pub fn drawn(&self, model: usize, hypothesis: Hypothesis, test_scenes: usize) -> Result<Tried<'a>, GlError> {
        let compiled = self.models[model];
        let prediction =
            compiled.predict(self.testbench, &self.model_inputs[model], self.seen, &hypothesis, test_scenes)?;
        let residual = Comparison::new(self.seen, &prediction.atlas, test_scenes);
        let mistakes = self.mistakes(model, &hypothesis);
        let (strengths, atlas) = (prediction.strengths, Some(prediction.atlas));
        Ok(Tried { model, mistakes, hypothesis, residual, strengths, atlas, explained: 0.0 })
    }

    fn mistakes(&self, model: usize, hypothesis: &Hypothesis) -> Vec<&'a Mistake> {
        hypothesis.mistakes.iter().map(|&index| self.models[model].hypotheses.mistakes[index]).collect()
    }

    /// Draws the best hypotheses with the driver, until the best one of all is a drawn one.
    fn confirm(&self, found: &mut Found<'a>, difference: &Comparison, support: Support<'_>) -> Result<(), GlError> {
        for _ in 0..MOST_DRAWN {
            found.prefer(support);
            let Some(first) = found.ranking.first_mut().filter(|first| first.atlas.is_none()) else { break };
            let drawn = self.drawn(first.model, first.hypothesis.clone(), self.test_scenes)?;
            let stays = drawn.residual.is_same() == first.residual.is_same();
            let explained = if stays { first.explained } else { difference.explained_by(&drawn.residual) };
            *first = Tried { explained, ..drawn };
            if !stays {
                found.ranking.sort_by(|a, b| a.order(b));
            }
        }
        Ok(())
    }

    /// Returns all compatible sets of at most three peculiarities, the empty one first.
    pub(super) fn peculiar(&self, model: usize) -> Vec<Hypothesis> {
        let hypotheses = &self.models[model].hypotheses;
        let single: Vec<&Hypothesis> =
            hypotheses.singles.iter().filter(|h| h.mistakes.iter().all(|&m| hypotheses.mistakes[m].harmless)).collect();
        let mut sets = vec![Hypothesis::default()];
        let mut first_of_last = 0;
        for _ in 0..3 {
            let end = sets.len();
            for index in first_of_last..end {
                for one in &single {
                    let comes_later = sets[index].mistakes.last().is_none_or(|last| one.mistakes[0] > *last);
                    if let (true, Some(both)) = (comes_later, sets[index].and(one)) {
                        sets.push(both);
                    }
                }
            }
            first_of_last = end;
        }
        sets
    }

    pub(super) fn wrong(&self, model: usize) -> impl Iterator<Item = &'a Hypothesis> {
        let hypotheses = &self.models[model].hypotheses;
        let another = self.model_inputs[model].parameterisation.knows_another();
        hypotheses
            .singles
            .iter()
            .filter(|h| h.mistakes.iter().all(|&m| !hypotheses.mistakes[m].harmless))
            // Without another light, mistakes with it are skipped.
            .filter(move |h| another || !hypotheses.mentions(h, "other_light_pos"))
    }

    /// Finds the simplest explanation; the support of the source decides between equal ones.
    pub fn run(&self, support: Support<'_>) -> Result<Found<'a>, GlError> {
        // Most answers are right in the usual way.
        let plain = self.drawn(0, Hypothesis::default(), self.test_scenes)?;
        if plain.residual.is_same() {
            return Ok(Found { nearest_right: plain.clone(), ranking: vec![plain] });
        }
        let coarse = self.unrated(0, Hypothesis::default(), ComparisonDetail::Coarse)?.residual;
        let difference = Difference { full: plain.residual.clone(), coarse };
        let mut nearest_right = plain.clone();
        let mut all = vec![plain];
        // Try right answers by other methods.
        let mut bases: Vec<(usize, Hypothesis)> = Vec::new();
        for model in 0..self.models.len() {
            let sets = self.peculiar(model).into_iter();
            let tried = sets.map(|set| self.attempt(model, set, &difference));
            let mut tried = tried.collect::<Result<Vec<_>, _>>()?;
            tried.sort_by(|a, b| a.order(b));
            if let Some(best) = tried.first_mut().filter(|best| best.residual.is_same()) {
                let drawn = self.drawn(model, best.hypothesis.clone(), self.test_scenes)?;
                *best = Tried { explained: best.explained, ..drawn };
            }
            let is_right = self.entries.get(model).is_some_and(|entry| entry.is_right);
            if let Some(best) = tried.first().filter(|best| is_right && best.order(&nearest_right).is_lt()) {
                nearest_right = best.clone();
            }
            bases.push((model, Hypothesis::default()));
            if let Some(best) = tried.first().filter(|best| !best.mistakes.is_empty()) {
                bases.push((model, best.hypothesis.clone()));
            }
            // This peculiarity is so common that it is always tried.
            let common = tried.iter().find(|t| t.mistakes.len() == 1 && t.mistakes[0].id == "normal-kept-unnormalised");
            if let Some(common) = common.filter(|common| bases.iter().all(|(_, base)| *base != common.hypothesis)) {
                bases.push((model, common.hypothesis.clone()));
            }
            let is_same = tried.first().is_some_and(|best| best.residual.is_same());
            all.extend(tried);
            if is_same {
                return Ok(self.found(nearest_right, all));
            }
        }
        // Try one mistake, plain or with peculiarities.
        let mut singles = Vec::new();
        for (model, base) in &bases {
            let with_base = self.wrong(*model).filter_map(|one| one.and(base)).collect();
            singles.extend(self.best_of(*model, with_base, &difference)?);
        }
        singles.sort_by(|a, b| a.order(b));
        let again = self.with_every_peculiarity(&singles, &difference)?;
        singles.extend(again);
        singles.sort_by(|a, b| a.order(b));
        if !singles.iter().any(|tried| tried.residual.is_same()) {
            let pairs = self.pairs(&difference, &singles)?;
            if !pairs.iter().any(|tried| tried.residual.is_same()) {
                all.extend(self.guided(&bases, &difference, support)?);
            }
            let named = pairs.iter().filter(|tried| tried.residual.is_same()).min_by(|a, b| a.order(b));
            if let Some(named) = named.cloned() {
                all.extend(self.replacements(&named, &difference)?);
            }
            all.extend(pairs);
        }
        all.extend(singles);
        let mut found = self.found(nearest_right, all);
        self.confirm(&mut found, &difference.full, support)?;
        Ok(found)
    }

    /// Tries the best single mistakes again with every set of peculiarities.
    fn with_every_peculiarity(
        &self,
        singles: &[Tried<'a>],
        difference: &Difference,
    ) -> Result<Vec<Tried<'a>>, GlError> {
        let mut again = Vec::new();
        if singles.iter().any(|tried| tried.residual.is_same()) {
            return Ok(again);
        }
        for tried in singles.iter().take(TRIED_AGAIN) {
            let alone = self.without_peculiarities(tried);
            for set in self.peculiar(tried.model) {
                if let Some(both) = alone.and(&set) {
                    again.push(self.attempt(tried.model, both, difference)?);
                }
            }
        }
        Ok(again)
    }

    pub(super) fn without_peculiarities(&self, tried: &Tried<'a>) -> Hypothesis {
        let hypotheses = &self.models[tried.model].hypotheses;
        let is_wrong = |h: &&Hypothesis| {
            h.mistakes.iter().all(|&m| !hypotheses.mistakes[m].harmless && tried.hypothesis.mistakes.contains(&m))
                && h.choices.iter().all(|(line, way)| tried.hypothesis.choices.get(line) == Some(way))
        };
        hypotheses.singles.iter().find(is_wrong).cloned().unwrap_or_default()
    }

    fn found(&self, nearest_right: Tried<'a>, mut all: Vec<Tried<'a>>) -> Found<'a> {
        all.sort_by(|a, b| a.order(b));
        let mut seen = std::collections::BTreeSet::new();
        all.retain(|tried| {
            let words: Vec<String> = tried.wrong().into_iter().map(str::to_owned).collect();
            seen.insert((tried.model, words))
        });
        Found { nearest_right, ranking: all }
    }
}
