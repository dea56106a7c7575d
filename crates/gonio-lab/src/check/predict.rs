//! What a model draws under a hypothesis.

use super::fit::{Fit, fit};
use super::freedom::Freedom;
use crate::bank::{Hypotheses, Hypothesis, Model};
use crate::names::{self, Bindings, Declared, Kind, NamesFile};
use crate::stage::{Cast, Sheet, Stage};
use gonio_gl::foreign::ForeignProgram;
use gonio_gl::{Gl, GlError};

/// A model as a program that is every hypothesis.
pub struct CompiledModel {
    /// Its hypotheses.
    pub hypotheses: Hypotheses,
    program: ForeignProgram,
    bindings: Bindings,
}

/// What a model draws, and the strengths that had to be found for it.
#[derive(Clone, Debug)]
pub struct Prediction {
    /// In all situations.
    pub sheet: Sheet,
    /// Of ambient, diffuse and specular, for red, green and blue, where they had to be found.
    pub strengths: [Option<[f64; 3]>; 3],
}

impl Prediction {
    /// How many strengths were found to be there: of two equal predictions that with fewer is the simpler.
    pub fn terms_found(&self) -> usize {
        self.strengths.iter().flatten().filter(|strength| strength.iter().any(|s| s.abs() > 1e-3)).count()
    }
}

impl CompiledModel {
    /// Compiles it: 330 core, or 300 es where the context is such.
    pub fn new(gl: &Gl, model: Model) -> Result<Self, GlError> {
        let hypotheses = Hypotheses::of(model);
        let [vertex, fragment] = hypotheses.sources().map(|source| for_context(gl, &source));
        let program = ForeignProgram::new(gl, &vertex, &fragment)
            .map_err(|broken| GlError::new(format!("the laboratory's own model does not compile here: {broken}")))?;
        // Those that choose among hypotheses have words of the equation in their names.
        let known: Vec<Declared> = declared(&program)
            .into_iter()
            .filter(|declared| !declared.name.starts_with("way_") && declared.name != "written_exponent")
            .collect();
        let bindings = names::bind(&known, &NamesFile::default());
        Ok(CompiledModel { hypotheses, program, bindings })
    }

    /// Works out once what it is given: nothing but hypotheses changes afterwards.
    pub fn cast(&self, stage: &Stage, freedom: &Freedom) -> ModelCast {
        let cast =
            |term| stage.cast(&self.program, &self.bindings, |situation| freedom.apply_to_model(situation, term));
        let terms = (0..3).filter(|&term| freedom.to_find[term]).map(|term| (term, cast(Some(term)))).collect();
        let whole = stage.cast(&self.program, &self.bindings, |situation| freedom.apply_whole(situation));
        ModelCast { known: cast(None), terms, whole, exponent: freedom.written_exponent.unwrap_or(1.0) }
    }

    /// What it draws. `seen` is what strengths are found for.
    pub fn predict(
        &self,
        stage: &Stage,
        cast: &ModelCast,
        seen: &Sheet,
        hypothesis: &Hypothesis,
        situations: usize,
    ) -> Result<Prediction, GlError> {
        let ways = self.ways(cast, hypothesis);
        let known = stage.draw(&self.program, &cast.known, &ways, situations)?;
        if cast.terms.is_empty() {
            return Ok(Prediction { sheet: known, strengths: [None; 3] });
        }
        if hypothesis.made_of.iter().any(|&mistake| self.hypotheses.mistakes[mistake].whole) {
            let whole = stage.draw(&self.program, &cast.whole, &ways, situations)?;
            let mut dark = whole.clone();
            for pixel in dark.pixels.iter_mut().filter(|pixel| Sheet::is_drawn(pixel)) {
                *pixel = [0.0, 0.0, 0.0, 1.0];
            }
            let Fit { predicted, .. } = fit(seen, &dark, &[whole]);
            return Ok(Prediction { sheet: predicted, strengths: [None; 3] });
        }
        let sheets = cast
            .terms
            .iter()
            .map(|(_, cast)| stage.draw(&self.program, cast, &ways, situations))
            .collect::<Result<Vec<_>, _>>()?;
        let Fit { strengths: found, predicted } = fit(seen, &known, &sheets);
        let mut strengths = [None; 3];
        for (((term, _), strength), sheet) in cast.terms.iter().zip(found).zip(&sheets) {
            // Of a term that this hypothesis does not put out, no strength can be told.
            let shows =
                sheet.pixels.iter().zip(&known.pixels).any(|(a, b)| a[0] != b[0] || a[1] != b[1] || a[2] != b[2]);
            strengths[*term] = shows.then_some(strength);
        }
        Ok(Prediction { sheet: predicted, strengths })
    }
}

impl ModelCast {
    /// Whether some strengths have to be found.
    pub fn must_find(&self) -> bool {
        !self.terms.is_empty()
    }
}

impl CompiledModel {
    /// What it draws with strengths that were found already.
    pub fn predict_with(
        &self,
        stage: &Stage,
        cast: &ModelCast,
        hypothesis: &Hypothesis,
        situations: usize,
        strengths: [[f64; 3]; 3],
    ) -> Result<Sheet, GlError> {
        let ways = self.ways(cast, hypothesis);
        let known = stage.draw(&self.program, &cast.known, &ways, situations)?;
        let mut sheet = known.clone();
        for (term, cast) in &cast.terms {
            let alone = stage.draw(&self.program, cast, &ways, situations)?;
            for (pixel, (alone, known)) in sheet.pixels.iter_mut().zip(alone.pixels.iter().zip(&known.pixels)) {
                for channel in 0..3 {
                    pixel[channel] += strengths[*term][channel] as f32 * (alone[channel] - known[channel]);
                }
            }
        }
        Ok(sheet)
    }

    /// What chooses a hypothesis.
    fn ways(&self, cast: &ModelCast, hypothesis: &Hypothesis) -> Vec<(String, Vec<f32>)> {
        let way = |line: usize| hypothesis.choices.get(&line).copied().unwrap_or(0);
        let lines = 0..self.hypotheses.variables.len();
        let mut ways: Vec<(String, Vec<f32>)> =
            lines.map(|line| (self.hypotheses.uniform(line), vec![way(line) as f32])).collect();
        ways.push(("written_exponent".to_owned(), vec![cast.exponent]));
        ways
    }
}

/// What a model is given in every situation.
pub struct ModelCast {
    /// Without the terms whose strengths have to be found.
    known: Cast,
    /// Each of those alone.
    terms: Vec<(usize, Cast)>,
    /// The exponent that stands in the student's source.
    exponent: f32,
    /// All of those together, of equal strength.
    whole: Cast,
}

/// Our own models are written as 330 core; as 300 es they are the same with another first line.
fn for_context(gl: &Gl, source: &str) -> String {
    if gonio_gl::foreign::is_embedded(gl) {
        source.replacen("#version 330 core\n", "#version 300 es\nprecision highp float;\nprecision highp int;\n", 1)
    } else {
        source.to_owned()
    }
}

/// What a program uses, as names are found for it.
pub fn declared(program: &ForeignProgram) -> Vec<Declared> {
    let of = |kind: Kind| {
        move |variable: &gonio_gl::foreign::ForeignVariable| Declared {
            name: variable.name.clone(),
            glsl_type: variable.glsl_type.clone(),
            array: variable.elements,
            kind,
        }
    };
    let uniforms = program.uniforms().filter(|uniform| uniform.name != gonio_glsl::DRAWN_ALL_THE_SAME);
    program.attributes().map(of(Kind::Attribute)).chain(uniforms.map(of(Kind::Uniform))).collect()
}
