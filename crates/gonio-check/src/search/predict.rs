//! Predictions by the driver: the picture of a model under a hypothesis.

use super::fit::{Fit, fit};
use super::parameterisation::{Lights, Parameterisation};
use crate::interpreter::EvaluationPlan;
use crate::mistakes::{Hypotheses, Hypothesis, ModelSolution};
use crate::roles::{self, Bindings, Declared, NamesFile, VariableKind};
use crate::testbench::{Atlas, TestScene, Testbench, for_context};
use gonio_gl::{Gl, GlError};
use gonio_render::user_program::UserProgram;
use std::cell::RefCell;
use std::collections::{BTreeMap, HashMap};
use std::rc::Rc;

/// A model with its hypotheses, and the programs that were made of it.
pub struct CompiledModel {
    /// Its hypotheses.
    pub hypotheses: Hypotheses,
    /// The same on the CPU, where the model can be worked out there.
    pub plan: Option<Rc<EvaluationPlan>>,
    gl: Gl,
    /// Where it can: one program a hypothesis that was drawn. Where not: one that is every hypothesis, under no choice.
    programs: RefCell<HashMap<BTreeMap<usize, usize>, Rc<ModelProgram>>>,
}

/// A program and what its uniforms mean.
pub struct ModelProgram {
    /// Linked.
    pub program: UserProgram,
    /// But for those that choose among hypotheses.
    pub bindings: Bindings,
}

/// The picture that a model draws, and the strengths that were fitted for it.
#[derive(Clone, Debug)]
pub struct Prediction {
    /// In all test scenes.
    pub atlas: Atlas,
    /// See [`Strengths`].
    pub strengths: Strengths,
}

/// The fitted strengths of ambient, diffuse and specular, for red, green and blue; `None` for terms with a given
/// strength.
pub type Strengths = [Option<[f64; 3]>; 3];

impl CompiledModel {
    /// Reads it. What the driver makes of it shows when it is drawn.
    pub fn new(gl: &Gl, model: ModelSolution) -> Self {
        let hypotheses = Hypotheses::for_model(model);
        // The CPU knows how surfaces are lit, and not where else they are drawn.
        let is_lit_surface = !model.is_of_places() && model != ModelSolution::Panorama;
        let plan = is_lit_surface.then(|| EvaluationPlan::new(&hypotheses)).flatten().map(Rc::new);
        CompiledModel { hypotheses, plan, gl: gl.clone(), programs: RefCell::default() }
    }

    /// 330 core, or 300 es where the context is such.
    pub fn program(&self, hypothesis: &Hypothesis) -> Result<Rc<ModelProgram>, GlError> {
        let is_own = self.plan.is_some();
        let choices = if is_own { hypothesis.choices.clone() } else { BTreeMap::new() };
        if let Some(known) = self.programs.borrow().get(&choices) {
            return Ok(Rc::clone(known));
        }
        let sources = if is_own { self.hypotheses.written(hypothesis) } else { self.hypotheses.sources() };
        let [vertex, fragment] = sources.map(|source| for_context(&self.gl, &source));
        let program = UserProgram::new(&self.gl, &vertex, &fragment)
            .map_err(|broken| GlError::new(format!("gonio's own shader does not compile on this driver: {broken}")))?;
        // Those that choose among hypotheses have words of the equation in their names.
        let known: Vec<Declared> = declared(&program)
            .into_iter()
            .filter(|declared| !declared.name.starts_with("way_") && declared.name != "written_exponent")
            .collect();
        let bindings = roles::bind(&known, &model_names());
        let program = Rc::new(ModelProgram { program, bindings });
        self.programs.borrow_mut().insert(choices, Rc::clone(&program));
        Ok(program)
    }

    /// What it is given: nothing but hypotheses changes afterwards.
    pub fn inputs(&self, parameterisation: &Parameterisation, lights: Lights) -> ModelInputs {
        ModelInputs {
            terms: (0..3).filter(|&term| parameterisation.to_find[term]).collect(),
            exponent: parameterisation.written_exponent.unwrap_or(1.0),
            parameterisation: parameterisation.clone(),
            lights,
        }
    }

    /// Draws it without the terms whose strengths have to be found, or with one of them alone, or with all; light is added up.
    fn draw(
        &self,
        testbench: &Testbench,
        inputs: &ModelInputs,
        lit: Lit,
        hypothesis: &Hypothesis,
        test_scenes: usize,
    ) -> Result<Atlas, GlError> {
        let mut sum: Option<Atlas> = None;
        for &(light, is_changed) in inputs.lights.each() {
            let plain = Hypothesis::default();
            let hypothesis = if is_changed { hypothesis } else { &plain };
            let ModelProgram { program, bindings } = &*self.program(hypothesis)?;
            let given = testbench.inputs(program, bindings, |test_scene| inputs.apply(test_scene, light, lit));
            let atlas = testbench.draw(program, &given, &self.ways(inputs, hypothesis), test_scenes)?;
            match &mut sum {
                None => sum = Some(atlas),
                Some(sum) => {
                    for (sum, pixel) in sum.pixels.iter_mut().zip(&atlas.pixels).filter(|(s, _)| Atlas::is_drawn(s)) {
                        sum.iter_mut().zip(pixel).take(3).for_each(|(sum, light)| *sum += light);
                    }
                }
            }
        }
        sum.ok_or_else(|| GlError::new("a model without any light"))
    }

    /// What it draws. `seen` is what strengths are found for.
    pub fn predict(
        &self,
        testbench: &Testbench,
        inputs: &ModelInputs,
        seen: &Atlas,
        hypothesis: &Hypothesis,
        test_scenes: usize,
    ) -> Result<Prediction, GlError> {
        let draw = |lit| self.draw(testbench, inputs, lit, hypothesis, test_scenes);
        if inputs.must_find() && self.is_whole(hypothesis) {
            let whole = draw(Lit::Whole)?;
            let mut dark = whole.clone();
            for pixel in dark.pixels.iter_mut().filter(|pixel| Atlas::is_drawn(pixel)) {
                *pixel = [0.0, 0.0, 0.0, 1.0];
            }
            let Fit { predicted, .. } = fit(seen, &dark, &[whole]);
            return Ok(Prediction { atlas: predicted, strengths: [None; 3] });
        }
        let known = draw(Lit::Known)?;
        if !inputs.must_find() {
            return Ok(Prediction { atlas: known, strengths: [None; 3] });
        }
        let atlases = inputs.terms.iter().map(|&term| draw(Lit::Term(term))).collect::<Result<Vec<_>, _>>()?;
        let Fit { strengths: found, predicted } = fit(seen, &known, &atlases);
        let mut strengths = [None; 3];
        for ((term, strength), atlas) in inputs.terms.iter().zip(found).zip(&atlases) {
            // Of a term that this hypothesis does not put out, no strength can be told.
            let shows =
                atlas.pixels.iter().zip(&known.pixels).any(|(a, b)| a[0] != b[0] || a[1] != b[1] || a[2] != b[2]);
            strengths[*term] = shows.then_some(strength);
        }
        Ok(Prediction { atlas: predicted, strengths })
    }

    /// Whether its picture is no sum of terms.
    pub fn is_whole(&self, hypothesis: &Hypothesis) -> bool {
        hypothesis.mistakes.iter().any(|&mistake| self.hypotheses.mistakes[mistake].whole)
    }

    /// What it draws with strengths that were found already.
    pub fn predict_with(
        &self,
        testbench: &Testbench,
        inputs: &ModelInputs,
        hypothesis: &Hypothesis,
        test_scenes: usize,
        strengths: [[f64; 3]; 3],
    ) -> Result<Atlas, GlError> {
        let known = self.draw(testbench, inputs, Lit::Known, hypothesis, test_scenes)?;
        let mut atlas = known.clone();
        for &term in &inputs.terms {
            let alone = self.draw(testbench, inputs, Lit::Term(term), hypothesis, test_scenes)?;
            for (pixel, (alone, known)) in atlas.pixels.iter_mut().zip(alone.pixels.iter().zip(&known.pixels)) {
                for channel in 0..3 {
                    pixel[channel] += strengths[term][channel] as f32 * (alone[channel] - known[channel]);
                }
            }
        }
        Ok(atlas)
    }

    /// What chooses a hypothesis, for whoever draws it alone.
    pub fn ways_of(&self, hypothesis: &Hypothesis) -> Vec<(String, Vec<f32>)> {
        let way = |line: usize| hypothesis.choices.get(&line).copied().unwrap_or(0);
        let lines = if self.plan.is_some() { 0..0 } else { 0..self.hypotheses.variables.len() };
        lines.map(|line| (self.hypotheses.uniform(line), vec![way(line) as f32])).collect()
    }

    /// What chooses a hypothesis, where one program is all of them.
    fn ways(&self, inputs: &ModelInputs, hypothesis: &Hypothesis) -> Vec<(String, Vec<f32>)> {
        let mut ways = self.ways_of(hypothesis);
        ways.push(("written_exponent".to_owned(), vec![inputs.exponent]));
        ways
    }
}

/// What the names mean that models have for what belongs to no one: the place of the light that is not being added.
pub fn model_names() -> NamesFile {
    let meaning = crate::roles::Meaning::Role(crate::roles::Role::LightPos(1));
    NamesFile { names: [("other_light_pos".to_owned(), meaning)].into() }
}

/// Which terms of those whose strengths have to be found are lit.
#[derive(Clone, Copy)]
pub enum Lit {
    /// None of them.
    Known,
    /// One alone.
    Term(usize),
    /// All.
    Whole,
}

/// The inputs of a model in every test scene.
pub struct ModelInputs {
    /// Terms whose strengths have to be found.
    pub terms: Vec<usize>,
    /// What may be varied.
    pub parameterisation: Parameterisation,
    /// The exponent that stands in the student's source.
    pub exponent: f32,
    /// The lights.
    pub lights: Lights,
}

impl ModelInputs {
    /// Changes a test scene to what the model is given for one of its lights.
    pub fn apply(&self, test_scene: &mut TestScene, light: usize, lit: Lit) {
        match lit {
            Lit::Known => self.parameterisation.apply_to_model(test_scene, self.lights, light, None),
            Lit::Term(term) => self.parameterisation.apply_to_model(test_scene, self.lights, light, Some(term)),
            Lit::Whole => self.parameterisation.apply_whole(test_scene, self.lights, light),
        }
    }

    /// Whether some strengths have to be found.
    pub fn must_find(&self) -> bool {
        !self.terms.is_empty()
    }
}

/// What a program uses, as names are found for it.
pub fn declared(program: &UserProgram) -> Vec<Declared> {
    let of = |kind: VariableKind| {
        move |variable: &gonio_render::user_program::ProgramVariable| Declared {
            name: variable.name.clone(),
            glsl_type: variable.glsl_type.clone(),
            array: variable.elements,
            kind,
        }
    };
    let uniforms = program.uniforms().filter(|uniform| uniform.name != gonio_glsl::DRAWN_ALL_THE_SAME);
    program.attributes().map(of(VariableKind::Attribute)).chain(uniforms.map(of(VariableKind::Uniform))).collect()
}
