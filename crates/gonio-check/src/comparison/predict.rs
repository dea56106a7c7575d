//! Predicts the picture of a model solution under a hypothesis by drawing it.

use super::fit::{Fit, fit};
use super::parameterisation::{Lights, Parameterisation};
use crate::mistakes::{Hypotheses, Hypothesis, ModelSolution};
use crate::roles::{self, Bindings, Declared, NamesFile, VariableKind};
use crate::testbench::{Atlas, TestScene, Testbench, for_context};
use gonio_gl::{Gl, GlError};
use gonio_language::tr;
use gonio_render::user_program::UserProgram;
use std::cell::RefCell;
use std::collections::{BTreeMap, HashMap};
use std::rc::Rc;

/// A model solution with its hypotheses and compiled programs.
pub struct CompiledModel {
    /// Its hypotheses.
    pub hypotheses: Hypotheses,
    gl: Gl,
    /// One program for each hypothesis that was drawn, or for many hypotheses one program for all, with an empty key.
    programs: RefCell<HashMap<BTreeMap<usize, usize>, Rc<ModelProgram>>>,
}

/// A program and the roles of its uniforms.
pub struct ModelProgram {
    /// The linked program.
    pub program: UserProgram,
    /// The uniforms except those that select hypotheses.
    pub bindings: Bindings,
}

/// The picture that a model draws, and the strengths that were fitted for it.
#[derive(Clone, Debug)]
pub struct Prediction {
    /// The pictures of all test scenes.
    pub atlas: Atlas,
    /// The fitted strengths.
    pub strengths: Strengths,
}

/// The fitted strengths of ambient, diffuse and specular, for red, green and blue; `None` for terms with a given
/// strength.
pub type Strengths = [Option<[f64; 3]>; 3];

impl CompiledModel {
    /// Prepares a model solution; the driver compiles it when it is drawn.
    pub fn new(gl: &Gl, model: ModelSolution) -> Self {
        let hypotheses = Hypotheses::for_model(model);
        CompiledModel { hypotheses, gl: gl.clone(), programs: RefCell::default() }
    }

    /// Whether each hypothesis is a program of its own. Of a panorama, many hypotheses are drawn.
    fn has_own_programs(&self) -> bool {
        self.hypotheses.model != ModelSolution::Panorama
    }

    /// Returns the program for a hypothesis, in version 330 core or 300 es as the context needs.
    pub fn program(&self, hypothesis: &Hypothesis) -> Result<Rc<ModelProgram>, GlError> {
        let is_own = self.has_own_programs();
        let choices = if is_own { hypothesis.choices.clone() } else { BTreeMap::new() };
        if let Some(known) = self.programs.borrow().get(&choices) {
            return Ok(Rc::clone(known));
        }
        let sources = if is_own { self.hypotheses.written(hypothesis) } else { self.hypotheses.sources() };
        let [vertex, fragment] = sources.map(|source| for_context(&self.gl, &source));
        let program = UserProgram::new(&self.gl, &vertex, &fragment)
            .map_err(|broken| GlError::new(tr!("check-own-shader-does-not-compile", error = broken.to_string())))?;
        // The names of uniforms that select hypotheses contain words of the equation.
        let known: Vec<Declared> = declared(&program)
            .into_iter()
            .filter(|declared| !declared.name.starts_with("way_") && declared.name != "written_exponent")
            .collect();
        let bindings = roles::bind(&known, &model_names());
        let program = Rc::new(ModelProgram { program, bindings });
        self.programs.borrow_mut().insert(choices, Rc::clone(&program));
        Ok(program)
    }

    /// Computes the inputs; afterwards only hypotheses change.
    pub fn inputs(&self, parameterisation: &Parameterisation, lights: Lights) -> ModelInputs {
        ModelInputs {
            terms: (0..3).filter(|&term| parameterisation.to_find[term]).collect(),
            exponent: parameterisation.written_exponent.unwrap_or(1.0),
            parameterisation: parameterisation.clone(),
            lights,
        }
    }

    /// Draws the model solution without the terms whose strengths are fitted, with one of them alone, or with all;
    /// light is summed.
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
            let values = testbench.inputs(program, bindings, |test_scene| inputs.apply(test_scene, light, lit));
            let atlas = testbench.draw(program, &values, &self.ways(inputs, hypothesis), test_scenes)?;
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

    /// Draws a hypothesis; strengths are fitted to `seen`.
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
            // The strength of a term that this hypothesis does not output cannot be fitted.
            let shows =
                atlas.pixels.iter().zip(&known.pixels).any(|(a, b)| a[0] != b[0] || a[1] != b[1] || a[2] != b[2]);
            strengths[*term] = shows.then_some(strength);
        }
        Ok(Prediction { atlas: predicted, strengths })
    }

    /// Whether its picture is not a sum of terms.
    pub fn is_whole(&self, hypothesis: &Hypothesis) -> bool {
        hypothesis.mistakes.iter().any(|&mistake| self.hypotheses.mistakes[mistake].whole)
    }

    /// Draws a hypothesis with known strengths.
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

    /// Returns the uniforms that select a hypothesis, for callers that draw it alone.
    pub fn ways_of(&self, hypothesis: &Hypothesis) -> Vec<(String, Vec<f32>)> {
        let way = |line: usize| hypothesis.choices.get(&line).copied().unwrap_or(0);
        let lines = if self.has_own_programs() { 0..0 } else { 0..self.hypotheses.variables.len() };
        lines.map(|line| (self.hypotheses.uniform(line), vec![way(line) as f32])).collect()
    }

    /// Returns the uniforms that select a hypothesis, if one program has all of them.
    fn ways(&self, inputs: &ModelInputs, hypothesis: &Hypothesis) -> Vec<(String, Vec<f32>)> {
        let mut ways = self.ways_of(hypothesis);
        ways.push(("written_exponent".to_owned(), vec![inputs.exponent]));
        ways
    }
}

/// Returns the roles of names that only model solutions have: the position of the light that is not being added.
pub fn model_names() -> NamesFile {
    let meaning = crate::roles::Meaning::Role(crate::roles::Role::LightPos(1));
    NamesFile { names: [("other_light_pos".to_owned(), meaning)].into(), ..NamesFile::default() }
}

/// The terms that are lit, among those whose strengths are fitted.
#[derive(Clone, Copy)]
pub enum Lit {
    /// No such term.
    Known,
    /// One term alone.
    Term(usize),
    /// All terms.
    Whole,
}

/// The inputs of a model solution in each test scene.
pub struct ModelInputs {
    /// Terms whose strengths are fitted.
    pub terms: Vec<usize>,
    /// The parameterisation of the student's program.
    pub parameterisation: Parameterisation,
    /// The constant exponent in the student's source.
    pub exponent: f32,
    /// The lights.
    pub lights: Lights,
}

impl ModelInputs {
    /// Changes a test scene to the inputs of the model for one of its lights.
    pub fn apply(&self, test_scene: &mut TestScene, light: usize, lit: Lit) {
        match lit {
            Lit::Known => self.parameterisation.apply_to_model(test_scene, self.lights, light, None),
            Lit::Term(term) => self.parameterisation.apply_to_model(test_scene, self.lights, light, Some(term)),
            Lit::Whole => self.parameterisation.apply_whole(test_scene, self.lights, light),
        }
    }

    /// Whether some strengths must be fitted.
    pub fn must_find(&self) -> bool {
        !self.terms.is_empty()
    }
}

/// Returns the variables that a program uses.
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
