//! Draws a student's program in test scenes that distinguish mistakes, and compares the pictures with those of right
//! answers.

mod compare;
mod conclusion;
mod fit;
mod parameterisation;
mod pictures;
mod predict;
mod properties;
mod task;

pub use compare::{Comparison, PIXEL_TOLERANCE, PIXELS_TOLERANCE, pixel_difference};
pub use conclusion::mistake as named;
pub(crate) use conclusion::{
    MOST_FOR_WRONG, bound, fixed, peculiarities_of, scenes as scene_verdicts, warn_of_undefined,
};
pub(crate) use fit::weighted_strengths;
pub use parameterisation::{Lights, Parameterisation, Second};
pub(crate) use pictures::{PossibleAnswer, RightAnswer};
pub(crate) use predict::model_names;
pub use predict::{CompiledModel, declared};
pub(crate) use properties::report_violations;
pub use task::{PLACES, TASKS, Task};

use crate::cause::ModelSolutions;
use crate::mistakes::ModelSolution;
use crate::roles::{Declared, NamesFile};
use crate::source::SourceConstants;
use crate::testbench::{Atlas, Testbench};
use crate::verdict::{Outcome, Verdict};
use gonio_gl::{DeferredGl, Dialect, Gl, GlError};
use gonio_glsl::{DRAWN_ALL_THE_SAME, OutputVersion};
use gonio_language::tr;
use gonio_render::user_program::UserProgram;
use std::collections::HashMap;
use std::rc::Rc;
use std::sync::Arc;

/// The information from the source of a pair of shaders that a check uses.
pub struct Prepared {
    /// Uniforms that the source declares, used or not.
    pub declared: Vec<Declared>,
    /// Roles of names that are otherwise unclear.
    pub names: NamesFile,
    /// Constants in the source that could be uniforms.
    pub constants: SourceConstants,
    /// For ambient, diffuse and specular: whether the source computes it but never uses it.
    pub unused_terms: [bool; 3],
    /// The support of the source for a mistake with a panorama where pictures do not decide: 0 contradicted, 1 the very
    /// expression is there.
    pub source_support: SourceSupport,
}

/// The support of the source for a mistake of the catalogue.
pub type SourceSupport = Box<dyn Fn(&str) -> f32>;

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
    gl: Rc<DeferredGl>,
    models: HashMap<ModelSolution, CompiledModel>,
    testbenches: HashMap<&'static str, (Testbench, [usize; 2])>,
    /// The model solutions for the interpreter.
    pub(crate) solutions: Arc<ModelSolutions>,
}

impl ShaderChecker {
    /// Creates a checker for this OpenGL context.
    pub fn new(gl: &Gl) -> Self {
        Self::deferred(DeferredGl::from(gl))
    }

    /// Creates a checker for an OpenGL context that may be opened later: what needs none precedes it.
    pub fn deferred(gl: DeferredGl) -> Self {
        ShaderChecker {
            gl: Rc::new(gl),
            models: HashMap::new(),
            testbenches: HashMap::new(),
            solutions: Arc::default(),
        }
    }

    /// Returns the OpenGL context.
    ///
    /// # Errors
    /// It cannot be opened.
    pub fn gl(&self) -> Result<&Gl, GlError> {
        self.gl.get()
    }

    /// Returns the version of GLSL that the context compiles.
    pub fn target(&self) -> OutputVersion {
        match self.gl.dialect() {
            Dialect::Es300 => OutputVersion::Es300,
            Dialect::Core330 => OutputVersion::Core330,
        }
    }

    /// Returns a model solution, which is compiled on first use.
    ///
    /// # Errors
    /// OpenGL cannot be opened.
    pub fn model(&mut self, model: ModelSolution) -> Result<&CompiledModel, GlError> {
        let gl = self.gl.get()?;
        Ok(self.models.entry(model).or_insert_with(|| CompiledModel::new(gl, model)))
    }

    /// Returns a fragment shader for this context that shows distances, for programs with any colours.
    pub fn places_fragment(&self) -> String {
        let [_, fragment] = ModelSolution::Places.sources();
        crate::testbench::for_dialect(self.gl.dialect(), fragment)
    }

    fn prepare(&mut self, task: &'static Task) -> Result<(), GlError> {
        for model in std::iter::once(task.model).chain(task.other.map(|(model, _)| model)) {
            self.model(model)?;
        }
        if !self.testbenches.contains_key(task.exercise) {
            let (test_scenes, whole) = task.test_scenes();
            self.testbenches.insert(task.exercise, (Testbench::new(self.gl.get()?, test_scenes)?, whole));
        }
        Ok(())
    }
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

/// The summary of the verdict on a program with an endless loop.
pub fn endless() -> &'static str {
    tr!("check-a-loop-in-a-shader-never")
}

/// Returns the verdict on a program with an endless loop.
pub(crate) fn endless_verdict(exercise: &str) -> Verdict {
    Verdict::new(exercise, Outcome::Unsure, endless())
}
