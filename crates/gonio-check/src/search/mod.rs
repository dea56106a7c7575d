//! Draws a student's program in test scenes that distinguish mistakes, and searches for the hypothesis that explains
//! the pictures.

mod compare;
mod conclusion;
mod fit;
mod on_cpu;
mod parameterisation;
mod predict;
mod properties;
mod ranking;
mod several;
mod task;

pub use compare::{Comparison, PIXEL_TOLERANCE, PIXELS_TOLERANCE, pixel_difference};
pub use conclusion::mistake as named;
pub(crate) use conclusion::{bound, fixed};
pub(crate) use fit::weighted_strengths;
pub use parameterisation::{Lights, Parameterisation, Second};
pub(crate) use predict::model_names;
pub use predict::{CompiledModel, declared};
pub use task::{PLACES, TASKS, Task};

use crate::cause::ModelSolutions;
use crate::mistakes::{Hypothesis, ModelSolution};
use crate::roles::{self, Declared, NamesFile, Role, VariableKind};
use crate::rules::SourceConstants;
use crate::testbench::{Atlas, Testbench};
use crate::verdict::{Outcome, Verdict};
use gonio_gl::{Gl, GlError};
use gonio_glsl::DRAWN_ALL_THE_SAME;
use gonio_render::user_program::UserProgram;
use on_cpu::CpuComparer;
use ranking::{Found, Search, SearchEntry};
use std::collections::HashMap;

/// The information from the source of a pair of shaders that the search uses.
pub struct Prepared {
    /// Uniforms that the source declares, used or not.
    pub declared: Vec<Declared>,
    /// Roles of names that are otherwise unclear.
    pub names: NamesFile,
    /// Constants in the source that could be uniforms.
    pub constants: SourceConstants,
    /// For ambient, diffuse and specular: whether the source computes it but never uses it.
    pub unused_terms: [bool; 3],
    /// The support of the source for a mistake where pictures do not decide: 0 contradicted, 1 the very expression is
    /// there.
    pub source_support: SourceSupport,
}

/// The support of the source for a mistake of the catalogue, in a model.
pub type SourceSupport = Box<dyn Fn(&str, ModelSolution) -> f32>;

/// The pictures of a check, for reports beside a verdict.
#[derive(Clone, Debug)]
pub struct Evidence {
    /// The pictures of the student's program.
    pub seen: Atlas,
    /// The pictures of the right answer.
    pub reference: Atlas,
    /// The picture that the named mistakes predict, if any.
    pub predicted: Option<Atlas>,
    /// The names of the test scenes, in order.
    pub scenes: Vec<String>,
}

/// Checks pairs of shaders in one context. Compiled model solutions are kept.
pub struct ShaderChecker {
    gl: Gl,
    models: HashMap<ModelSolution, CompiledModel>,
    testbenches: HashMap<&'static str, (Testbench, [usize; 2])>,
    /// The model solutions for the interpreter.
    pub(crate) solutions: ModelSolutions,
}

impl ShaderChecker {
    /// Creates a checker for this OpenGL context.
    pub fn new(gl: &Gl) -> Self {
        ShaderChecker {
            gl: gl.clone(),
            models: HashMap::new(),
            testbenches: HashMap::new(),
            solutions: ModelSolutions::default(),
        }
    }

    /// Returns the OpenGL context.
    pub fn gl(&self) -> &Gl {
        &self.gl
    }

    /// Returns a model solution, which is compiled on first use.
    pub fn model(&mut self, model: ModelSolution) -> &CompiledModel {
        let gl = &self.gl;
        self.models.entry(model).or_insert_with(|| CompiledModel::new(gl, model))
    }

    /// Returns a fragment shader for this context that shows distances, for programs with any colours.
    pub fn places_fragment(&self) -> String {
        let [_, fragment] = ModelSolution::Places.sources();
        crate::testbench::for_context(&self.gl, fragment)
    }

    /// Draws the right answer with the strengths and the method of this program.
    fn reference(
        &self,
        task: &Task,
        search: &Search<'_>,
        found: &Found<'_>,
        unused_terms: [bool; 3],
    ) -> Result<Atlas, GlError> {
        let (right_model, right) = conclusion::right_answer(search, found);
        let best = found.ranking.first().filter(|best| best.residual.is_same());
        let Some(strengths) = best.map(|best| best.strengths).filter(|s| s.iter().any(Option::is_some)) else {
            let drawn = search.drawn(right_model, right, search.test_scenes)?;
            return Ok(drawn.atlas.unwrap_or_else(|| search.seen.clone()));
        };
        // A missing term would have its full strength.
        let strength = |term: usize| match strengths[term] {
            Some(found) if found.iter().any(|s| *s > 1e-3) => found,
            _ => [if task.required[term] || unused_terms[term] { 1.0 } else { 0.0 }; 3],
        };
        let peculiar = best.is_some_and(|best| best.mistakes.iter().any(|mistake| mistake.harmless));
        let hypothesis = if peculiar { right } else { Hypothesis::default() };
        let (model, inputs) = (search.models[right_model], &search.model_inputs[right_model]);
        model.predict_with(search.testbench, inputs, &hypothesis, search.test_scenes, [0, 1, 2].map(strength))
    }

    fn prepare(&mut self, task: &'static Task) -> Result<(), GlError> {
        for model in std::iter::once(task.model).chain(task.other.map(|(model, _)| model)) {
            self.model(model);
        }
        if !self.testbenches.contains_key(task.exercise) {
            let (test_scenes, whole) = task.test_scenes();
            self.testbenches.insert(task.exercise, (Testbench::new(&self.gl, test_scenes)?, whole));
        }
        Ok(())
    }

    /// Checks a linked program. Errors are the driver's, not the student's.
    pub fn check(
        &mut self,
        task: &'static Task,
        program: &UserProgram,
        prepared: &Prepared,
    ) -> Result<(Verdict, Option<Evidence>), GlError> {
        self.prepare(task)?;
        let (testbench, [whole, of_two]) = &self.testbenches[task.exercise];
        let bindings = roles::bind(&predict::declared(program), &prepared.names);
        let bound = conclusion::bound(&bindings);
        if !bindings.bound.iter().any(|b| b.declared.kind == VariableKind::Attribute && b.role == Role::Position) {
            let mut verdict = Verdict::new(
                task.exercise,
                Outcome::Unsure,
                "no attribute looks like the position: name it `position`, or assign its role in names.toml",
            );
            verdict.bound = bound;
            return Ok((verdict, None));
        }
        let declared = roles::bind(&prepared.declared, &prepared.names);
        let parameterisation = Parameterisation::new(task, &bindings, &declared, &prepared.constants);
        let inputs = testbench.inputs(program, &bindings, |test_scene| parameterisation.apply(test_scene));
        let fixed = conclusion::fixed(&bindings);
        let all = testbench.test_scenes().len();
        let drawn = drawn_unless_endless(program, &fixed, &[1, all], |fixed, count| {
            let seen = testbench.draw(program, &inputs, fixed, count)?;
            testbench.error()?;
            Ok(seen)
        })?;
        let Some(seen) = drawn else {
            let mut verdict = endless_verdict(task.exercise);
            verdict.bound = bound;
            return Ok((verdict, None));
        };
        let whole = whole + if parameterisation.second == Second::None { 0 } else { *of_two };
        let entries = entries(task, &parameterisation);
        let models: Vec<&CompiledModel> = entries.iter().map(|entry| &self.models[&entry.model]).collect();
        let model_inputs: Vec<_> =
            models.iter().zip(&entries).map(|(model, entry)| model.inputs(&parameterisation, entry.lights)).collect();
        let comparers: Vec<_> = models
            .iter()
            .zip(&model_inputs)
            .map(|(model, inputs)| CpuComparer::new(testbench, model, inputs, &seen, whole))
            .collect();
        let search = Search {
            testbench,
            entries: &entries,
            models: &models,
            model_inputs: &model_inputs,
            comparers: &comparers,
            seen: &seen,
            test_scenes: whole,
        };
        let found = search.run(&|id, model| (prepared.source_support)(id, models[model].hypotheses.model))?;
        let reference = self.reference(task, &search, &found, prepared.unused_terms)?;
        let comparison = Comparison::new(&seen, &reference, whole);
        let mut verdict = conclusion::verdict(task, &search, &found, &comparison, prepared.unused_terms);
        if task.model.is_lit() {
            let (model, right) = conclusion::right_answer(&search, &found);
            // Without a term that can be tested alone there is nothing to draw.
            let alone = match parameterisation.to_find {
                [true, true, true] => None,
                _ => search.drawn(model, right, all)?.atlas,
            };
            let comparison = alone.map(|reference| Comparison::new(&seen, &reference, all));
            verdict.terms = conclusion::terms(testbench, &parameterisation, comparison.as_ref());
            let student = properties::Student {
                testbench,
                program,
                bindings: &bindings,
                fixed: &fixed,
                parameterisation: &parameterisation,
            };
            verdict.properties = student.properties(&seen, whole)?;
            properties::report_violations(&mut verdict);
        }
        testbench.error()?;
        verdict.bound = bound;
        let predicted =
            found.ranking.first().filter(|best| !best.mistakes.is_empty()).and_then(|best| best.atlas.clone());
        let evidence = Evidence {
            reference,
            predicted,
            scenes: testbench.test_scenes().iter().take(whole).map(|s| s.name.clone()).collect(),
            seen,
        };
        Ok((verdict, Some(evidence)))
    }
}

/// Returns the variants of an answer that the search starts from, the usual one first.
fn entries(task: &Task, parameterisation: &Parameterisation) -> Vec<SearchEntry> {
    let mut entries: Vec<SearchEntry> = Vec::new();
    let right = parameterisation.right_lights();
    for &lights in right {
        entries.push(SearchEntry { model: task.model, lights, is_right: true, word: None });
    }
    if let (Some((model, word)), Some(&lights)) = (task.other, right.first()) {
        entries.push(SearchEntry { model, lights, is_right: word.is_none(), word });
    }
    for &lights in parameterisation.wrong_lights() {
        // A light that cannot be switched off may exist for the wrong term only, or for nothing.
        let word = match lights {
            Lights::First if parameterisation.second == Second::Switched => Some("second-light-missing"),
            Lights::Second => Some("lights-overwritten"),
            Lights::EachAmbient => Some("ambient-twice"),
            _ => None,
        };
        entries.push(SearchEntry { model: task.model, lights, is_right: false, word });
    }
    entries
}

/// A picture whose values can be compared.
pub(crate) trait Numbers {
    /// Whether both pictures have the same bits.
    fn equals(&self, other: &Self) -> bool;
}

impl Numbers for crate::testbench::Atlas {
    fn equals(&self, other: &Self) -> bool {
        // Compared by bits, because NaN differs from itself.
        let bits = |atlas: &Self| atlas.pixels.iter().flatten().map(|number| number.to_bits()).collect::<Vec<_>>();
        bits(self) == bits(other)
    }
}

impl Numbers for crate::panorama::Tiles {
    fn equals(&self, other: &Self) -> bool {
        let numbers = |tiles: &Self| tiles.faces.iter().flatten().flatten().map(|n| n.to_bits()).collect::<Vec<_>>();
        numbers(self) == numbers(other)
    }
}

/// Draws the student's program with `draw`, which is given fixed uniforms and the number of test scenes: each of
/// `counts`, of which the last is all. Returns `None` if a vertex or fragment exceeded
/// [`gonio_glsl::LoopBound::STUDENTS`].
///
/// A uniform determines whether such vertices and fragments are drawn, so two pictures that differ reveal them. The
/// first test scene is drawn alone first, because a program with an endless loop is slow in each.
pub(crate) fn drawn_unless_endless<T: Numbers>(
    program: &UserProgram,
    fixed: &[(String, Vec<f32>)],
    counts: &[usize],
    mut draw: impl FnMut(&[(String, Vec<f32>)], usize) -> Result<T, GlError>,
) -> Result<Option<T>, GlError> {
    let whole = counts.last().copied().unwrap_or(0);
    if program.uniform_index(DRAWN_ALL_THE_SAME).is_none() {
        return draw(fixed, whole).map(Some);
    }
    let mut fixed = fixed.to_vec();
    fixed.push((DRAWN_ALL_THE_SAME.to_owned(), vec![0.0]));
    let mut seen = None;
    for &count in counts {
        let mut drawn = |all_the_same: f32| {
            if let Some((_, value)) = fixed.last_mut() {
                *value = vec![all_the_same];
            }
            draw(&fixed, count)
        };
        let (all, ended) = (drawn(1.0)?, drawn(0.0)?);
        if !all.equals(&ended) {
            return Ok(None);
        }
        seen = Some(ended);
    }
    Ok(seen)
}

/// Returns the verdict on a program with an endless loop.
pub(crate) fn endless_verdict(exercise: &str) -> Verdict {
    Verdict::new(exercise, Outcome::Unsure, "a loop in a shader never ends")
}
