//! The pictures whose shaders are stepped through: a student's program in an exercise, or the user's own shaders on a scene.

use gonio_check::roles::Bindings;
use gonio_check::submission::SourceFile;
use gonio_check::testbench::TestScene;
use gonio_check::user_shaders::{UserInputs, UserShaders, message_text};
use gonio_exercises::exercise::Exercise;
use gonio_exercises::preview::{PreviewShape, SubmittedPair};
use gonio_exercises::step::{StepOptions, StepWork, SteppedPair, SteppedScene, UserPair};
use gonio_render::VertexData;
use gonio_scene::{Frame, Scene};
use std::sync::Arc;

/// The bounds on the work: the page has one thread.
const WORK: StepWork = if cfg!(target_arch = "wasm32") {
    StepWork::BRIEF
} else {
    StepWork { point: StepWork::BRIEF.point, ..StepWork::PATIENT }
};
/// Pixels along the longer side of an expression's picture.
const SIDE: u32 = 200;

/// The student's program that is drawn.
pub struct DrawnProgram {
    /// The exercise that it answers.
    pub exercise: &'static Exercise,
    /// The files that it was made of.
    pub content: Vec<SourceFile>,
    /// The pair among them.
    pub source: SubmittedPair,
    /// The roles of its variables.
    pub bindings: Bindings,
}

/// The user's own shaders that are drawn.
pub struct OwnProgram {
    /// Their files, and gonio's own shader in the place of a missing one.
    pub content: Arc<[SourceFile]>,
    /// The shaders.
    pub source: UserShaders,
}

/// A picture as it is drawn.
#[derive(Clone)]
pub enum SteppedPicture {
    /// A student's program.
    Exercise {
        /// The program.
        program: Arc<DrawnProgram>,
        /// Width and height, pixels.
        size: [u32; 2],
        /// The objects with their inputs.
        objects: Vec<(PreviewShape, TestScene)>,
    },
    /// The user's own shaders.
    Own {
        /// The shaders.
        program: Arc<OwnProgram>,
        /// The values of their uniforms, and the textures that they read.
        inputs: Arc<UserInputs>,
        /// The scene.
        scene: Arc<Scene>,
        /// Camera, lights, time and size.
        frame: Box<Frame>,
    },
}

impl PartialEq for SteppedPicture {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Exercise { size: a, objects: x, .. }, Self::Exercise { size: b, objects: y, .. }) => {
                self.has_same_program(other) && a == b && x == y
            }
            (Self::Own { inputs: a, scene: b, frame: c, .. }, Self::Own { inputs: x, scene: y, frame: z, .. }) => {
                self.has_same_program(other) && Arc::ptr_eq(a, x) && Arc::ptr_eq(b, y) && c == z
            }
            _ => false,
        }
    }
}

/// A pair of shaders that the interpreter runs.
#[derive(Clone)]
pub enum RunnablePair {
    /// A student's.
    Exercise(Arc<SteppedPair>),
    /// The user's own.
    Own(Arc<UserPair>),
}

impl SteppedPicture {
    /// Width and height, pixels.
    pub fn size(&self) -> [u32; 2] {
        match self {
            Self::Exercise { size, .. } => *size,
            Self::Own { frame, .. } => [frame.width, frame.height],
        }
    }

    /// The files of the program.
    pub fn content(&self) -> &[SourceFile] {
        match self {
            Self::Exercise { program, .. } => &program.content,
            Self::Own { program, .. } => &program.content,
        }
    }

    /// The program of a student, whose values have right answers.
    pub fn of_exercise(&self) -> Option<&Arc<DrawnProgram>> {
        match self {
            Self::Exercise { program, .. } => Some(program),
            Self::Own { .. } => None,
        }
    }

    /// Whether both are drawn by the same program.
    pub fn has_same_program(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Exercise { program: a, .. }, Self::Exercise { program: b, .. }) => Arc::ptr_eq(a, b),
            (Self::Own { program: a, .. }, Self::Own { program: b, .. }) => Arc::ptr_eq(a, b),
            _ => false,
        }
    }

    /// Compiles the program for the interpreter. An error is one sentence.
    pub fn compile(&self) -> Result<RunnablePair, String> {
        let sentence = |message: &_| format!("{}.", message_text(message));
        match self {
            Self::Exercise { program, .. } => SteppedPair::new(&program.source, &program.bindings)
                .map(|pair| RunnablePair::Exercise(Arc::new(pair)))
                .map_err(|note| sentence(&note.message)),
            Self::Own { program, .. } => UserPair::new(&program.source)
                .map(|pair| RunnablePair::Own(Arc::new(pair)))
                .map_err(|messages| messages.first().map(sentence).unwrap_or_default()),
        }
    }

    /// Runs the vertex shader for the picture. A pair of another kind of picture draws nothing.
    pub fn scene(&self, pair: &RunnablePair) -> Option<SteppedScene> {
        match (self, pair) {
            (Self::Exercise { objects, .. }, RunnablePair::Exercise(pair)) => {
                Some(SteppedScene::new(pair.clone(), objects, self.options()))
            }
            (Self::Own { inputs, scene, frame, .. }, RunnablePair::Own(pair)) => {
                Some(own_scene(pair, inputs, scene, frame))
            }
            _ => None,
        }
    }

    /// The same for a small picture, and the size of its visible part, which is in its middle.
    pub fn small_scene(&self, pair: &RunnablePair) -> Option<(SteppedScene, [u32; 2])> {
        let [width, height] = small_size(self.size());
        let scene = match (self, pair) {
            (Self::Exercise { objects, .. }, RunnablePair::Exercise(pair)) => {
                SteppedScene::new(pair.clone(), objects, StepOptions { work: WORK, ..StepOptions::square(SIDE) })
            }
            (Self::Own { inputs, scene, frame, .. }, RunnablePair::Own(pair)) => {
                own_scene(pair, inputs, scene, &Frame { width, height, ..Frame::clone(frame) })
            }
            _ => return None,
        };
        Some((scene, [width, height]))
    }

    /// The picture of an exercise is the middle of a square.
    fn options(&self) -> StepOptions {
        let size = self.size();
        let side = size[0].max(size[1]);
        match self {
            Self::Exercise { .. } => {
                StepOptions { size: [side; 2], origin: size.map(|own| (side - own) / 2), work: WORK }
            }
            Self::Own { .. } => StepOptions { size, origin: [0; 2], work: WORK },
        }
    }

    /// A pixel of the picture, both counted from the top left, in the picture of [`Self::scene`].
    pub fn in_scene(&self, [x, y]: [u32; 2]) -> [u32; 2] {
        let StepOptions { size: [_, height], origin: [left, bottom], .. } = self.options();
        let from_bottom = (self.size()[1].saturating_sub(1)).saturating_sub(y) + bottom;
        [x + left, height.saturating_sub(1).saturating_sub(from_bottom)]
    }

    /// The inverse of [`Self::in_scene`]; `None` outside of the picture.
    pub fn in_picture(&self, [x, y]: [u32; 2]) -> Option<[u32; 2]> {
        let [left, top] = self.in_scene([0, 0]);
        let pixel = [x.checked_sub(left)?, y.checked_sub(top)?];
        (pixel[0] < self.size()[0] && pixel[1] < self.size()[1]).then_some(pixel)
    }

    /// The shares of the place that was at these shares of the picture before: another width shows more or less at its sides.
    pub fn same_place(&self, [x, y]: [f32; 2], before: &Self) -> [f32; 2] {
        let ratio = |[width, height]: [u32; 2]| width as f32 / height as f32;
        let is_own = matches!((self, before), (Self::Own { .. }, Self::Own { .. }));
        if !is_own || self.size() == before.size() {
            return [x, y];
        }
        [0.5 + (x - 0.5) * ratio(before.size()) / ratio(self.size()), y]
    }

    /// The pixel at these shares of width and height from the top left.
    pub fn pixel(&self, share: [f32; 2]) -> [u32; 2] {
        let size = self.size();
        [0, 1].map(|axis| ((share[axis] * size[axis] as f32) as u32).min(size[axis].saturating_sub(1)))
    }
}

fn own_scene(pair: &UserPair, inputs: &UserInputs, scene: &Scene, frame: &Frame) -> SteppedScene {
    let mut pair = pair.clone();
    pair.inputs.take_choices(inputs);
    if pair.inputs.reads(VertexData::Tangent) {
        let mut scene = scene.clone();
        scene.add_tangents();
        return pair.in_scene(&scene, frame, WORK);
    }
    pair.in_scene(scene, frame, WORK)
}

/// A size with the same ratio of its sides.
fn small_size(size: [u32; 2]) -> [u32; 2] {
    let longer = size[0].max(size[1]).max(1);
    size.map(|side| (SIDE * side).div_ceil(longer).clamp(1, SIDE))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_pictures_keep_the_ratio_of_their_sides() {
        assert_eq!(small_size([800, 400]), [SIDE, SIDE / 2]);
        assert_eq!(small_size([3, 900]), [1, SIDE]);
    }
}
