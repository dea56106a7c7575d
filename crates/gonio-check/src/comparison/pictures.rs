//! The pictures of a program that was judged by its values, beside those of the right answer.

use super::{
    Comparison, Evidence, Lights, Parameterisation, Prepared, Second, ShaderChecker, Task, conclusion,
    drawn_unless_endless, predict, properties,
};
use crate::cause::explanation::Strengths;
use crate::mistakes::{Hypothesis, ModelSolution};
use crate::roles::{self, Bindings};
use crate::testbench::{Atlas, Testbench};
use crate::verdict::{Outcome, Verdict};
use gonio_gl::GlError;
use gonio_glsl::DRAWN_ALL_THE_SAME;
use gonio_render::user_program::UserProgram;

/// The right answer that a program's pictures are compared with.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RightAnswer<'a> {
    /// The roles of the program's inputs.
    pub bindings: &'a Bindings,
    /// Which quantities are inputs.
    pub parameterisation: &'a Parameterisation,
    /// The model solution.
    pub model: ModelSolution,
    /// The choices of a right answer, as lines of the model solution.
    pub choices: &'a Hypothesis,
    /// The lights.
    pub lights: Lights,
    /// The strengths of ambient, diffuse and specular light, where they are constants of the program and shown.
    pub strengths: Strengths,
    /// For the same terms: whether a right program shows it.
    pub due_terms: [bool; 3],
    /// The named mistakes as lines of the model solution, with the choices.
    pub wrong: Option<&'a Hypothesis>,
}

/// A method of a right answer whose picture a program is compared with.
#[derive(Clone, Debug)]
pub(crate) struct PossibleAnswer {
    /// The model solution.
    pub model: ModelSolution,
    /// Its choices, as lines of the model solution.
    pub choices: Hypothesis,
}

/// A program that was drawn.
struct Drawn<'a> {
    task: &'static Task,
    testbench: &'a Testbench,
    program: &'a UserProgram,
    bindings: Bindings,
    fixed: Vec<(String, Vec<f32>)>,
    parameterisation: &'a Parameterisation,
    seen: Atlas,
    /// The number of test scenes that are judged; those of single terms follow.
    scenes: usize,
}

impl Drawn<'_> {
    fn all(&self) -> usize {
        self.testbench.test_scenes().len()
    }

    /// The verdict, apart from its outcome, and its pictures.
    fn compared(self, reference: Atlas, predicted: Option<Atlas>) -> Result<(Verdict, Evidence), GlError> {
        let Drawn { task, testbench, program, bindings, fixed, parameterisation, seen, scenes } = self;
        let all = testbench.test_scenes().len();
        let mut verdict = Verdict::new(task.exercise, Outcome::Wrong, "");
        verdict.scenes = conclusion::scenes(testbench, &Comparison::new(&seen, &reference, scenes));
        conclusion::warn_of_undefined(&mut verdict, &seen);
        if task.model.is_lit() {
            let comparison = Comparison::new(&seen, &reference, all);
            verdict.terms = conclusion::terms(testbench, parameterisation, Some(&comparison));
            let student =
                properties::Student { testbench, program, bindings: &bindings, fixed: &fixed, parameterisation };
            verdict.properties = student.properties(&seen, scenes)?;
        }
        testbench.error()?;
        verdict.bound = conclusion::bound(&bindings);
        let names = testbench.test_scenes().iter().take(scenes).map(|scene| scene.name.clone()).collect();
        Ok((verdict, Evidence { seen, reference, predicted, scenes: names }))
    }
}

impl ShaderChecker {
    /// Draws a program and the usual right answer in the first test scene, for nobody to see: drivers compile at the first draw,
    /// and other threads work meanwhile.
    ///
    /// # Errors
    /// OpenGL cannot be opened. Other errors are those of later draws, which report them.
    pub(crate) fn draw_ahead(
        &mut self,
        task: &'static Task,
        program: &UserProgram,
        prepared: &Prepared,
    ) -> Result<(), GlError> {
        // A loop that may not end may be slow, and is perhaps never drawn.
        if program.uniform_index(DRAWN_ALL_THE_SAME).is_some() || gonio_threads::current_num_threads() == 1 {
            return Ok(());
        }
        self.prepare(task)?;
        let (testbench, _) = &self.testbenches[task.exercise];
        let bindings = roles::bind(&predict::declared(program), &prepared.names);
        let declared = roles::bind(&prepared.declared, &prepared.names);
        let parameterisation = Parameterisation::new(task, &bindings, &declared, &prepared.constants);
        let inputs = testbench.inputs(program, &bindings, |scene| parameterisation.apply(scene));
        let drawn = testbench.draw(program, &inputs, &conclusion::fixed(&bindings), 1);
        let model = &self.models[&task.model];
        let of_model = model.inputs(&parameterisation, Lights::One);
        let right =
            drawn.and_then(|_| model.predict_with(testbench, &of_model, &Hypothesis::default(), 1, [[1.0; 3]; 3]));
        let _ = right.and_then(|_| testbench.error());
        Ok(())
    }

    /// Draws a program in all test scenes. `None` if a loop never ends.
    fn drawn<'a>(
        &'a self,
        task: &'static Task,
        program: &'a UserProgram,
        bindings: Bindings,
        parameterisation: &'a Parameterisation,
    ) -> Result<Option<Drawn<'a>>, GlError> {
        let (testbench, [of_one, of_two]) = &self.testbenches[task.exercise];
        let inputs = testbench.inputs(program, &bindings, |scene| parameterisation.apply(scene));
        let fixed = conclusion::fixed(&bindings);
        let all = testbench.test_scenes().len();
        let seen = drawn_unless_endless(program, &fixed, &[1, all], |fixed, count| {
            let seen = testbench.draw(program, &inputs, fixed, count)?;
            testbench.error()?;
            Ok(seen)
        })?;
        let scenes = of_one + if parameterisation.second == Second::None { 0 } else { *of_two };
        Ok(seen.map(|seen| Drawn { task, testbench, program, bindings, fixed, parameterisation, seen, scenes }))
    }

    /// Compares a program with its right answer in every test scene, with properties and single terms. The outcome is
    /// left to the caller. `None` if a loop never ends.
    ///
    /// # Errors
    /// Errors of the driver.
    pub(crate) fn pictures(
        &mut self,
        task: &'static Task,
        program: &UserProgram,
        prepared: &Prepared,
        right: &RightAnswer<'_>,
    ) -> Result<Option<(Verdict, Evidence)>, GlError> {
        self.prepare(task)?;
        self.model(right.model)?;
        let mut bindings = roles::bind(&predict::declared(program), &prepared.names);
        bindings.adopt(right.bindings);
        let Some(drawn) = self.drawn(task, program, bindings, right.parameterisation)? else { return Ok(None) };
        let model = &self.models[&right.model];
        let of_model = model.inputs(right.parameterisation, right.lights);
        // A missing term has its full strength in the right answer.
        let strength = |term: usize| match right.strengths[term] {
            Some(found) if found.iter().any(|strength| *strength > 1e-3) => found,
            _ => [if right.due_terms[term] { 1.0 } else { 0.0 }; 3],
        };
        let predict = |choices: &Hypothesis, scenes: usize, strengths: [[f64; 3]; 3]| {
            model.predict_with(drawn.testbench, &of_model, choices, scenes, strengths)
        };
        let reference = predict(right.choices, drawn.all(), [0, 1, 2].map(strength))?;
        let own = [0, 1, 2].map(|term| right.strengths[term].unwrap_or([0.0; 3]));
        let predicted = right.wrong.map(|wrong| predict(wrong, drawn.scenes, own)).transpose()?;
        drawn.compared(reference, predicted).map(Some)
    }

    /// Compares the picture of a program that values do not judge with those of right answers, with fitted strengths.
    /// Returns the first answer that is the same, or `None` with the pictures of the first one. `Ok(None)` if a loop never
    /// ends.
    ///
    /// # Errors
    /// Errors of the driver.
    pub(crate) fn resembling(
        &mut self,
        task: &'static Task,
        program: &UserProgram,
        prepared: &Prepared,
        answers: &[PossibleAnswer],
    ) -> Result<Option<(Option<usize>, Verdict, Evidence)>, GlError> {
        self.prepare(task)?;
        for answer in answers {
            self.model(answer.model)?;
        }
        let bindings = roles::bind(&predict::declared(program), &prepared.names);
        let declared = roles::bind(&prepared.declared, &prepared.names);
        let parameterisation = Parameterisation::new(task, &bindings, &declared, &prepared.constants);
        let Some(drawn) = self.drawn(task, program, bindings, &parameterisation)? else { return Ok(None) };
        let mut first = None;
        for (index, answer) in answers.iter().enumerate() {
            let model = &self.models[&answer.model];
            for lights in parameterisation.right_lights() {
                let of_model = model.inputs(&parameterisation, *lights);
                let predict = |scenes| model.predict(drawn.testbench, &of_model, &drawn.seen, &answer.choices, scenes);
                let predicted = predict(drawn.scenes)?;
                if Comparison::new(&drawn.seen, &predicted.atlas, drawn.scenes).is_same() {
                    let reference = predict(drawn.all())?.atlas;
                    let (verdict, evidence) = drawn.compared(reference, None)?;
                    return Ok(Some((Some(index), verdict, evidence)));
                }
                if first.is_none() {
                    first = Some(predict(drawn.all())?.atlas);
                }
            }
        }
        let reference = first.unwrap_or_else(|| drawn.seen.clone());
        let (verdict, evidence) = drawn.compared(reference, None)?;
        Ok(Some((None, verdict, evidence)))
    }
}
