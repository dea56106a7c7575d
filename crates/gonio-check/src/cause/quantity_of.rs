//! The quantity of the light equation that each expression of a pair is or should be, and its right values at the points
//! of any scene.
//!
//! An expression is what its values are in the test scenes. What a wrong one should be follows from the cause: with the
//! cause's right values, the values that depend on it become right too.

use super::found::Found;
use super::model::{AnswerMethod, Mistakes, Model, Space, TELLING};
use super::observed::{Observed, Observer};
use super::program::{Change, Program, Runner};
use super::proven_cause::ProvenCause;
use super::right_change::{QuantityName, RightChange, values_of};
use super::samples::{SceneSamples, interpolated};
use super::values::Values;
use super::{DiagnosisDepth, ModelSolutions, diagnose, words};
use crate::comparison::{Parameterisation, Task};
use crate::compile::ParsedStage;
use crate::dataflow::Shader;
use crate::roles::NamesFile;
use crate::source::Analysis;
use crate::submission::Submission;
use gonio_glsl::{OutputVersion, Span, Stage};
use gonio_interpreter::ExprId;
use gonio_language::tr;
use std::collections::BTreeMap;
use std::sync::Arc;

/// What an expression is, or what it should be.
#[derive(Clone, Debug, PartialEq)]
pub struct ExpressionQuantity {
    /// The quantity in words, such as "the unit normal, in view space"; `None` if no quantity has its right values.
    pub words: Option<String>,
    /// Whether it has these values. A wrong expression gets them if the causes do.
    pub is_right: bool,
    /// For a cause, what it should be: "should be the unit normal".
    pub cause: Option<String>,
    quantity: Option<QuantityName>,
}

impl ExpressionQuantity {
    /// The same in a sentence.
    #[must_use]
    pub fn sentence(&self) -> String {
        match (&self.cause, &self.words) {
            (Some(should), _) => tr!("check-this-should", should = should),
            (None, Some(words)) if self.is_right => tr!("check-this-is", quantity = words),
            (None, Some(words)) => tr!("check-this-should-be-after-a-wrong-value", quantity = words),
            (None, None) => tr!("check-an-earlier-value-is-wrong").to_owned(),
        }
    }
}

/// A cause with its place in the text of its stage.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedCause {
    /// The stage.
    pub stage: Stage,
    /// The expression.
    pub expr: ExprId,
    /// Its position.
    pub span: Span,
    /// Its text.
    pub text: String,
    /// What it should be: "should be the unit normal".
    pub should: String,
}

/// The right values of an expression at the places of some scenes.
#[derive(Clone, Debug, PartialEq)]
pub struct RightValues {
    /// Components of each value.
    pub size: usize,
    /// The components at each place; `None` where it has no value.
    pub places: Vec<Option<Vec<f32>>>,
}

impl RightValues {
    fn new(values: &Values) -> Self {
        let at = |point: usize| values.present[point].then(|| values.at(point).to_vec());
        RightValues { size: values.size, places: (0..values.points()).map(at).collect() }
    }
}

/// The quantities of a pair's expressions.
pub struct RightQuantities {
    program: Program,
    method: AnswerMethod,
    parameterisation: Parameterisation,
    changes: Vec<RightChange>,
    causes: Vec<PlacedCause>,
    quantities: BTreeMap<(Stage, ExprId), ExpressionQuantity>,
}

impl RightQuantities {
    /// Finds the cause of what is wrong with a pair, and the quantities. `None` if its values cannot be judged.
    #[must_use]
    pub fn new(task: &Task, submission: &Submission, names: &NamesFile) -> Option<Self> {
        let stages = [(&submission.vertex, Stage::Vertex), (&submission.fragment, Stage::Fragment)]
            .map(|(text, stage)| ParsedStage::new(text, stage, OutputVersion::Core330));
        let [vertex, fragment] = stages.each_ref().map(|stage| (&stage.parsed, &stage.checked));
        let [of_vertex, of_fragment] =
            stages.each_ref().map(|stage| Shader { parsed: &stage.parsed, checked: &stage.checked });
        let mut names = names.clone();
        let source = match task.model.is_of_places() {
            true => Analysis::new(&of_vertex, &of_fragment, &names),
            false => Analysis::with_roles_by_use(&of_vertex, &of_fragment, &mut names),
        };
        let constants = source.constants();
        let texts = [&submission.vertex.text, &submission.fragment.text].map(String::as_str);
        let diagnosis =
            diagnose(task, [vertex, fragment], texts, &names, &constants, &Arc::default(), DiagnosisDepth::Causes)
                .ok()?;
        let groups: &[Vec<ProvenCause>] = match &diagnosis.found {
            Found::Endless => return None,
            Found::Causes(groups) => groups,
            Found::Right(_) | Found::Nothing => &[],
        };
        let firsts: Vec<&ProvenCause> = groups.iter().filter_map(|group| group.first()).collect();
        let changes = firsts.iter().flat_map(|cause| cause.right.iter().cloned()).collect();
        let placed = |cause: &&ProvenCause| PlacedCause {
            stage: cause.stage,
            expr: cause.expr,
            span: cause.span,
            text: cause.text.clone(),
            should: cause.should.clone(),
        };
        let causes = firsts.iter().map(placed).collect();
        let mut program = Program::new(vertex, fragment, texts, &names).ok()?;
        program.bindings = diagnosis.bindings;
        let parameterisation = Parameterisation::new(task, &program.bindings, &program.declared, &constants);
        let (method, quantities) = (diagnosis.method, BTreeMap::new());
        let mut found = RightQuantities { program, method, parameterisation, changes, causes, quantities };
        found.recognise(task)?;
        Some(found)
    }

    /// The causes of what is wrong; none if the pair is right, or no single value repairs it.
    #[must_use]
    pub fn causes(&self) -> &[PlacedCause] {
        &self.causes
    }

    /// What an expression is or should be; `None` if no quantity has its values.
    #[must_use]
    pub fn of(&self, stage: Stage, expr: ExprId) -> Option<&ExpressionQuantity> {
        self.quantities.get(&(stage, self.computed(stage, expr)))
    }

    /// The right side of an assignment, or the expression itself.
    fn computed(&self, stage: Stage, expr: ExprId) -> ExprId {
        let expressions = &self.program.stage(stage).source.expressions;
        let text = self.program.text(stage, expr);
        let Some(own) = expressions.get(expr.0 as usize).map(|source| source.span) else { return expr };
        let is_right_side = |span: Span| {
            let before = text.get(..(span.start.saturating_sub(own.start)) as usize).unwrap_or_default().trim_end();
            let target = before.strip_suffix('=').unwrap_or_default();
            span.end == own.end && target.ends_with(|c: char| c.is_alphanumeric() || "_] \t".contains(c))
        };
        let found = expressions.iter().position(|source| is_right_side(source.span));
        found.map_or(expr, |index| ExprId(index as u32))
    }

    /// The right values of an expression at the places of scenes, whatever the stage that computes it.
    #[must_use]
    pub fn at_places(&self, scenes: Vec<SceneSamples>, stage: Stage, expr: ExprId) -> Option<RightValues> {
        let (samples, values) = self.values(scenes, stage, expr)?;
        Some(RightValues::new(&if stage == Stage::Vertex { interpolated(&values, &samples) } else { values }))
    }

    /// The right values of an expression of the vertex shader at all vertices of scenes.
    #[must_use]
    pub fn at_vertices(&self, scenes: Vec<SceneSamples>, expr: ExprId) -> Option<RightValues> {
        self.values(scenes, Stage::Vertex, expr).map(|(_, values)| RightValues::new(&values))
    }

    fn values(
        &self,
        mut samples: Vec<SceneSamples>,
        stage: Stage,
        expr: ExprId,
    ) -> Option<(Vec<SceneSamples>, Values)> {
        let expr = self.computed(stage, expr);
        let of = self.quantities.get(&(stage, expr))?;
        samples.iter_mut().for_each(|samples| self.parameterisation.apply(&mut samples.scene));
        let model = self.model(&samples)?;
        let values = match &of.quantity {
            Some(name) => model.quantities[name.index(stage, &model)?].values.clone(),
            None => {
                let runner = Runner::new(&self.program, &samples);
                values_of(&runner, &self.changes(&runner, &model), stage, expr, None)?
            }
        };
        Some((samples, values))
    }

    fn model(&self, samples: &[SceneSamples]) -> Option<Model> {
        Model::new(
            &ModelSolutions::default(),
            self.method,
            Space::World,
            samples,
            self.parameterisation.written_exponent.unwrap_or(1.0),
            Mistakes::These(&[]),
        )
        .ok()
    }

    /// The right values of all causes at the points of a runner.
    fn changes(&self, runner: &Runner<'_>, model: &Model) -> Vec<Change> {
        let mut changes = Vec::new();
        for right in &self.changes {
            changes.extend(right.change(runner, model, &changes));
        }
        changes
    }

    /// Compares the values of all expressions, before and after the change, with the quantities.
    fn recognise(&mut self, task: &Task) -> Option<()> {
        let (scenes, [whole, _]) = task.test_scenes();
        let samples: Vec<SceneSamples> = (scenes.into_iter().take(whole.min(TELLING)))
            .map(|mut scene| {
                self.parameterisation.apply(&mut scene);
                SceneSamples::new(scene)
            })
            .collect();
        let model = self.model(&samples)?;
        let runner = Runner::new(&self.program, &samples);
        let observer = Observer { runner: &runner, model: &model };
        let before = observer.observe(&[], 0..samples.len());
        let changes = self.changes(&runner, &model);
        let after = if changes.is_empty() { before.clone() } else { observer.observe(&changes, 0..samples.len()) };
        let mut quantities: BTreeMap<(Stage, ExprId), ExpressionQuantity> = BTreeMap::new();
        let mut ambiguous = Vec::new();
        for (old, new) in before.iter().filter_map(|old| Some((old, of_same(old, &after)?))) {
            let cause = self.causes.iter().find(|cause| (cause.stage, cause.expr) == (old.stage, old.expr));
            let cause = cause.map(|cause| cause.should.clone());
            let text = self.program.text(old.stage, old.expr);
            // A number that is written is only a quantity where it should be another one.
            let is_literal = text.starts_with(|c: char| c.is_ascii_digit() || c == '.');
            let is_right = old.values.is_same(&new.values);
            let is = observer.recognise(new.stage, &new.values).map(|is| &model.quantities[is]);
            let is = is.filter(|_| !(is_literal && is_right));
            if is.is_none() && is_right {
                continue;
            }
            let found = ExpressionQuantity {
                words: is.map(words::quantity),
                is_right,
                cause,
                quantity: is.map(QuantityName::new),
            };
            let key = (old.stage, old.expr);
            if quantities.get(&key).is_some_and(|known| *known != found) {
                ambiguous.push(key);
            }
            quantities.insert(key, found);
        }
        // A function's parameter is another quantity in each call.
        ambiguous.iter().for_each(|key| {
            quantities.remove(key);
        });
        self.quantities = quantities;
        Some(())
    }
}

/// The same evaluation in another run.
fn of_same<'o>(old: &Observed, all: &'o [Observed]) -> Option<&'o Observed> {
    all.iter().find(|new| (new.stage, new.expr, new.occurrence) == (old.stage, old.expr, old.occurrence))
}
