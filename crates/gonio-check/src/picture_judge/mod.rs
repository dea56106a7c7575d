//! A right answer by its pictures alone: that of a teacher's own exercise, for which there is no model solution.

mod stored;

pub use stored::{StoredPictures, StoredPicturesError};

use crate::compile::{ParsedStage, compile};
use crate::roles::{self, Bindings, NamesFile};
use crate::submission::StageText;
use crate::testbench::{Atlas, TestLight, TestScene, Testbench, scene};
use gonio_gl::{Gl, GlError};
use gonio_glsl::{OutputVersion, Stage};
use gonio_language::{Language, tr};
use gonio_render::user_program::{UserProgram, is_embedded};

/// The test scenes of a kind of exercise.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SceneFamily {
    /// An object and a light.
    #[default]
    Lit,
    /// An object that reflects or refracts its surroundings.
    Mirrored,
    /// A sky around the camera.
    Sky,
    /// Cameras around coloured landmarks.
    Camera,
}

impl SceneFamily {
    /// All families.
    pub const ALL: [SceneFamily; 4] = [SceneFamily::Lit, SceneFamily::Mirrored, SceneFamily::Sky, SceneFamily::Camera];

    /// The word in a file.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            SceneFamily::Lit => "lit",
            SceneFamily::Mirrored => "mirrored",
            SceneFamily::Sky => "sky",
            SceneFamily::Camera => "camera",
        }
    }

    /// The complete scenes.
    #[must_use]
    pub fn scenes(self) -> Vec<TestScene> {
        match self {
            SceneFamily::Lit => scene::lit(),
            SceneFamily::Mirrored => scene::mirrored(),
            SceneFamily::Sky => scene::skies(),
            SceneFamily::Camera => scene::cameras(),
        }
    }
}

/// The test scenes of a judge: complete ones, then those with one term of the light alone, then those without light.
#[derive(Clone, Debug, PartialEq)]
pub struct JudgeScenes {
    /// All of them.
    pub all: Vec<TestScene>,
    /// The number of complete ones, which come first.
    pub whole: usize,
}

impl JudgeScenes {
    /// The scenes of a family, and more of the same kind.
    #[must_use]
    pub fn new(family: SceneFamily, more: Vec<TestScene>) -> Self {
        let mut all = family.scenes();
        let isolated = if family == SceneFamily::Lit { scene::isolated(&all) } else { Vec::new() };
        let mut dark: Vec<TestScene> = Vec::new();
        for alone in &isolated {
            let name = dark_name(&alone.name);
            if dark.iter().all(|known| known.name != name) {
                dark.push(TestScene {
                    name,
                    light: TestLight { brightness: alone.light.brightness, ..alone.light.dark() },
                    ..alone.clone()
                });
            }
        }
        all.extend(more);
        let whole = all.len();
        all.extend(isolated);
        all.extend(dark);
        JudgeScenes { all, whole }
    }

    /// The scenes with this term alone, each with the same scene without any light.
    #[must_use]
    pub fn alone(&self, term: &str) -> Vec<[usize; 2]> {
        let end = format!(", {term} alone");
        let alone = (self.whole..self.all.len()).filter(|at| self.all[*at].name.ends_with(&end));
        let place = |name: String| self.all.iter().position(|scene| scene.name == name);
        alone.filter_map(|at| Some([at, place(dark_name(&self.all[at].name))?])).collect()
    }
}

/// The name of the scene without light that belongs to one with a term alone.
fn dark_name(alone: &str) -> String {
    format!("{}, dark", alone.split(", ").next().unwrap_or_default())
}

/// The source of the pictures of an answer.
#[derive(Clone, Debug, PartialEq)]
pub enum JudgePictures {
    /// A vertex and a fragment shader, which are drawn.
    Shaders([String; 2]),
    /// Pictures that were drawn before, where nobody may read the shaders.
    Drawn(Atlas),
}

/// The texts of a mistake in one language.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct OwnMistakeTexts {
    /// The mistake in half a sentence.
    pub name: String,
    /// The symptom in the picture.
    pub looks_like: String,
    /// How to fix it.
    pub fix: String,
}

/// A mistake that a teacher expects: the reference with other expressions.
#[derive(Clone, Debug, PartialEq)]
pub struct OwnMistake {
    /// An id in kebab-case.
    pub id: String,
    /// The section of the lecture that teaches it.
    pub lecture_section: String,
    /// The texts by language; at least one.
    pub texts: Vec<(Language, OwnMistakeTexts)>,
    /// The pictures of the reference with this mistake.
    pub pictures: JudgePictures,
    /// The wrong expressions; a line with one of them is the line of the mistake.
    pub written: Vec<WrittenMark>,
}

/// An expression without its spaces, as a hash: a file that students may read must not quote the reference.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WrittenMark {
    /// Its length in bytes.
    pub length: usize,
    /// A hash of its bytes (FNV-1a, 64 bits).
    pub hash: u64,
}

impl WrittenMark {
    /// The mark of an expression; `None` for spaces alone.
    #[must_use]
    pub fn new(text: &str) -> Option<Self> {
        let squeezed: String = text.split_whitespace().collect();
        (!squeezed.is_empty()).then(|| WrittenMark { length: squeezed.len(), hash: fnv(squeezed.as_bytes()) })
    }

    /// Whether a line contains the expression, whatever its spaces.
    #[must_use]
    pub fn is_in(&self, line: &str) -> bool {
        let squeezed: String = line.split_whitespace().collect();
        self.length > 0 && squeezed.as_bytes().windows(self.length).any(|part| fnv(part) == self.hash)
    }
}

/// FNV-1a, 64 bits (Fowler, Noll, Vo, draft-eastlake-fnv).
fn fnv(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |sum, byte| (sum ^ u64::from(*byte)).wrapping_mul(0x100_0000_01b3))
}

impl OwnMistake {
    /// The texts in the current language, or in the first one.
    #[must_use]
    pub fn texts(&self) -> OwnMistakeTexts {
        let own = self.texts.iter().find(|(language, _)| *language == Language::current());
        own.or(self.texts.first()).map(|(_, texts)| texts.clone()).unwrap_or_default()
    }
}

/// A right answer by its pictures.
#[derive(Clone, Debug, PartialEq)]
pub struct PictureJudge {
    /// The test scenes.
    pub scenes: JudgeScenes,
    /// Roles and values of inputs whose names say nothing; those of a submission's own `names.toml` precede them.
    pub names: NamesFile,
    /// The right pictures.
    pub reference: JudgePictures,
    /// The mistakes with names.
    pub mistakes: Vec<OwnMistake>,
}

/// A pair of shaders that was drawn in the scenes of a judge.
pub struct DrawnPair {
    /// Its pictures.
    pub pictures: Atlas,
    /// The roles of its inputs.
    pub bindings: Bindings,
}

impl PictureJudge {
    /// A testbench with the scenes.
    ///
    /// # Errors
    /// Errors of the driver.
    pub fn testbench(&self, gl: &Gl) -> Result<Testbench, GlError> {
        Testbench::new(gl, self.scenes.all.clone())
    }

    /// The names of a submission, and those of the exercise that it does not state.
    #[must_use]
    pub fn names_with(&self, own: &NamesFile) -> NamesFile {
        let mut names = own.clone();
        for (name, meaning) in &self.names.names {
            names.names.entry(name.clone()).or_insert_with(|| meaning.clone());
        }
        names
    }

    /// Draws a pair of shaders in all scenes.
    ///
    /// # Errors
    /// The pair does not compile, in one sentence, or the driver failed.
    pub fn draw(&self, testbench: &Testbench, gl: &Gl, shaders: &[String; 2]) -> Result<DrawnPair, GlError> {
        let target = if is_embedded(gl) { OutputVersion::Es300 } else { OutputVersion::Core330 };
        let texts =
            [("reference.vert", &shaders[0]), ("reference.frag", &shaders[1])].map(|(n, t)| StageText::whole(n, t));
        let vertex = ParsedStage::new(&texts[0], Stage::Vertex, target);
        let fragment = ParsedStage::new(&texts[1], Stage::Fragment, target);
        let program: UserProgram = compile(gl, &vertex, &fragment)
            .map_err(|broken| GlError::new(tr!("check-reference-does-not-compile", error = broken.to_string())))?;
        let bindings = roles::bind(&crate::comparison::declared(&program), &self.names);
        let inputs = testbench.inputs(&program, &bindings, |_| {});
        let fixed = crate::comparison::fixed(&bindings);
        let pictures = testbench.draw(&program, &inputs, &fixed, self.scenes.all.len())?;
        testbench.error()?;
        Ok(DrawnPair { pictures, bindings })
    }

    /// The pictures of an answer.
    ///
    /// # Errors
    /// As [`PictureJudge::draw`].
    pub fn pictures(&self, testbench: &Testbench, gl: &Gl, of: &JudgePictures) -> Result<Atlas, GlError> {
        match of {
            JudgePictures::Shaders(shaders) => Ok(self.draw(testbench, gl, shaders)?.pictures),
            JudgePictures::Drawn(atlas) => Ok(atlas.clone()),
        }
    }

    /// Draws the reference and every mistake, for a judge without their shaders.
    ///
    /// # Errors
    /// As [`PictureJudge::draw`].
    pub fn stored(&self, gl: &Gl) -> Result<StoredPictures, GlError> {
        let testbench = self.testbench(gl)?;
        let reference = self.pictures(&testbench, gl, &self.reference)?;
        let mistakes = self
            .mistakes
            .iter()
            .map(|mistake| Ok((mistake.id.clone(), self.pictures(&testbench, gl, &mistake.pictures)?)));
        Ok(StoredPictures {
            scenes: self.scenes.all.clone(),
            reference,
            mistakes: mistakes.collect::<Result<_, GlError>>()?,
        })
    }
}
