//! Terms that a program computes and never uses.

use super::diagnosing::Diagnosing;
use super::explanation::{Strengths, is_absent};
use super::model::{AnswerMethod, Mistakes, Model, STAGES, Space, observe};
use super::observed::{DIFFUSE_NAMES, SPECULAR_NAMES};
use super::program::{Change, Program, Runner};
use super::recording::Recorded;
use super::samples::SceneSamples;
use super::seeing::see;

/// Places in the first scene at which values are compared.
const PLACES: usize = 64;

impl Diagnosing<'_> {
    /// For ambient, diffuse and specular: whether a right program assigns the term to variables, and none of them has an
    /// influence on the picture. The ambient term is constant and cannot be recognised.
    pub(super) fn unused_terms(&self, method: AnswerMethod, strengths: Strengths) -> Result<[bool; 3], String> {
        let is_absent = |term: usize| is_absent(strengths[term]);
        let terms: Vec<(usize, &[&str])> =
            [(1, &DIFFUSE_NAMES[..]), (2, &SPECULAR_NAMES)].into_iter().filter(|(term, _)| is_absent(*term)).collect();
        let mut unused = [false; 3];
        if terms.is_empty() {
            return Ok(unused);
        }
        let samples: Vec<SceneSamples> = self.scenes.iter().take(1).map(|(_, samples)| samples.few(PLACES)).collect();
        let exponent = self.parameterisation.written_exponent.unwrap_or(1.0);
        let model = Model::new(self.solutions, method, Space::World, &samples, exponent, Mistakes::These(&[]))?;
        let runner = Runner::new(self.program, &samples);
        let exprs = STAGES.map(|stage| assigned(self.program, stage));
        let observed = observe(&runner, &[], 0..samples.len(), [&exprs[0], &exprs[1]]);
        let Some(before) = see(&runner, &[], 0..samples.len()) else { return Ok(unused) };
        let has_influence = |seen: &Recorded| {
            let noise = seen.values.map(seen.values.size, |point, _, to| to.fill(point as f32 * 0.37 + 1.5));
            let change =
                Change { stage: seen.stage, exprs: vec![seen.expr], occurrence: Some(seen.occurrence), values: noise };
            let after = see(&runner, &[change], 0..samples.len());
            after.is_none_or(|after| !after.colour.is_same(&before.colour))
        };
        for (term, names) in terms {
            let is_term = |seen: &&Recorded| {
                !seen.values.is_constant()
                    && model.quantities.iter().any(|quantity| {
                        quantity.stage == seen.stage
                            && names.contains(&quantity.name.as_str())
                            && seen.values.factor_of(&quantity.values).is_some()
                    })
            };
            let mut all = observed.iter().filter(is_term).peekable();
            unused[term] = all.peek().is_some() && !all.any(has_influence);
        }
        Ok(unused)
    }
}

/// The expressions that are all that a variable is set to.
fn assigned(program: &Program, stage: gonio_glsl::Stage) -> Vec<gonio_interpreter::ExprId> {
    let numbers = program.numbers(stage).into_iter();
    numbers.filter(|expr| program.is_whole_value(stage, *expr)).collect()
}
