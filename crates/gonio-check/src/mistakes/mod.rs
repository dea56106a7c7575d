//! The catalogue of mistakes: each a small change to one of the models, with its name, its symptom and its fix.

mod compose;
pub mod faces;

pub use compose::{Hypotheses, Hypothesis};

use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::sync::LazyLock;

/// A mistake, or a harmless peculiarity, in the models that it can be made in.
#[derive(Clone, Debug, Default, Deserialize, Serialize, PartialEq, Eq)]
#[serde(deny_unknown_fields)]
pub struct Mistake {
    /// A stable kebab-case word.
    pub id: String,
    /// The mistake in half a sentence.
    pub name: String,
    /// The models in which it can be made.
    pub models: Vec<ModelSolution>,
    /// A right answer that looks different.
    #[serde(default)]
    pub harmless: bool,
    /// The lab's own solutions do the same.
    #[serde(default)]
    pub lab_does_it: bool,
    /// The symptom in the picture; empty for harmless peculiarities.
    #[serde(default)]
    pub looks_like: String,
    /// How to fix it; empty for harmless peculiarities.
    #[serde(default)]
    pub fix: String,
    /// The section of the lecture that teaches it; empty for what is harmless.
    #[serde(default)]
    pub lecture_section: String,
    /// Its picture is no sum of terms: strengths that have to be found are one factor for all.
    #[serde(default)]
    pub whole: bool,
    /// Other ids whose pictures are the same in principle.
    #[serde(default)]
    pub looks_the_same_as: Vec<String>,
    /// Ways to make it: what is written to which variable of the model instead.
    pub change: Vec<BTreeMap<String, String>>,
}

/// The terms of the light equation, in the order of [`crate::verdict::Verdict::terms`].
pub const TERMS: [&str; 3] = ["ambient", "diffuse", "specular"];

/// The one term that a mistake is made with, by its id: `specular-missing` is the specular term's. `None` for what concerns
/// several terms, such as a normal, or none.
pub fn term_of(id: &str) -> Option<&'static str> {
    TERMS.into_iter().find(|term| id.strip_prefix(term).is_some_and(|rest| rest.starts_with('-')))
}

/// The bank's files: one for all that is light, and those of single exercises.
const TEXTS: [&str; 3] = [
    include_str!("../../../../exercises/mistakes.toml"),
    include_str!("../../../../exercises/ex01-camera/mistakes.toml"),
    include_str!("../../../../exercises/s1-panorama-to-cubemap/mistakes.toml"),
];

#[derive(Deserialize)]
struct File {
    mistake: Vec<Mistake>,
}

/// All of them, in the order of the files, and those of single faces; an id stands more than once where it is another change in another model.
pub fn all() -> &'static [Mistake] {
    static ALL: LazyLock<Vec<Mistake>> = LazyLock::new(|| {
        // The files are part of the program; a test reads them.
        let files = TEXTS.iter().filter_map(|text| toml::from_str::<File>(text).ok());
        files.flat_map(|file| file.mistake).chain(faces::mistakes()).collect()
    });
    &ALL
}

/// Returns the mistakes that can be made in a model.
pub fn for_model(model: ModelSolution) -> impl Iterator<Item = &'static Mistake> {
    all().iter().filter(move |mistake| mistake.models.contains(&model.with_mistakes_of()))
}

/// The first of that id.
pub fn find(id: &str) -> Option<&'static Mistake> {
    all().iter().find(|mistake| mistake.id == id)
}

/// A right answer that hypotheses are changes of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Deserialize, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum ModelSolution {
    /// The light equation per fragment.
    Phong,
    /// The light equation per vertex.
    Gouraud,
    /// A mirror.
    Reflection,
    /// Glass, through one surface.
    Refraction,
    /// The sky around everything.
    Skybox,
    /// A camera built from its position, Front and Up.
    Camera,
    /// The same without colours: what is drawn is how far everything is. Its mistakes are the camera's.
    Places,
    /// The faces of a cubemap, from a panorama.
    Panorama,
}

macro_rules! shader {
    ($name:literal) => {
        include_str!(concat!("../../../../exercises/models/", $name))
    };
}

impl ModelSolution {
    /// Every one that has mistakes of its own.
    pub const ALL: [ModelSolution; 7] = [
        ModelSolution::Phong,
        ModelSolution::Gouraud,
        ModelSolution::Reflection,
        ModelSolution::Refraction,
        ModelSolution::Skybox,
        ModelSolution::Camera,
        ModelSolution::Panorama,
    ];

    /// Vertex and fragment shader, `#version 330 core`.
    pub fn sources(self) -> [&'static str; 2] {
        match self {
            ModelSolution::Phong => [shader!("phong.vert"), shader!("phong.frag")],
            ModelSolution::Gouraud => [shader!("gouraud.vert"), shader!("gouraud.frag")],
            ModelSolution::Reflection => [shader!("mirror.vert"), shader!("reflection.frag")],
            ModelSolution::Refraction => [shader!("mirror.vert"), shader!("refraction.frag")],
            ModelSolution::Skybox => [shader!("skybox.vert"), shader!("skybox.frag")],
            ModelSolution::Camera => [shader!("camera.vert"), shader!("camera.frag")],
            ModelSolution::Places => [shader!("camera.vert"), shader!("places.frag")],
            ModelSolution::Panorama => [shader!("panorama.vert"), shader!("panorama.frag")],
        }
    }

    /// Whether it computes light from lights.
    pub fn is_lit(self) -> bool {
        matches!(self, ModelSolution::Phong | ModelSolution::Gouraud)
    }

    /// Whether it puts out what a cubemap gives in a direction.
    pub fn is_looked_up(self) -> bool {
        matches!(self, ModelSolution::Skybox | ModelSolution::Reflection | ModelSolution::Refraction)
    }

    /// The model whose mistakes apply to this one.
    pub fn with_mistakes_of(self) -> ModelSolution {
        match self {
            ModelSolution::Places => ModelSolution::Camera,
            other => other,
        }
    }

    /// Whether it is about where things are drawn: two mistakes then have a picture that neither of them hints at.
    pub fn is_of_places(self) -> bool {
        matches!(self, ModelSolution::Camera | ModelSolution::Places)
    }
}

/// Mistakes that are another model, or more than any model has, and not a change of a line.
pub fn structural() -> Vec<Mistake> {
    let mistake = |(id, name, looks_like, fix): &(&str, &str, &str, &str)| Mistake {
        id: (*id).to_owned(),
        name: (*name).to_owned(),
        models: vec![ModelSolution::Phong, ModelSolution::Gouraud],
        looks_like: (*looks_like).to_owned(),
        fix: (*fix).to_owned(),
        lecture_section: "Where is the rendering equation computed?".to_owned(),
        ..Mistake::default()
    };
    STRUCTURAL.iter().map(mistake).collect()
}

/// Their ids, names, symptoms and fixes.
const STRUCTURAL: &[(&str, &str, &str, &str)] = &[
    (
        "phong-instead-of-gouraud",
        "The light is computed for each fragment instead of each vertex",
        "The picture is smoother than Gouraud shading is.",
        "Compute the light in the vertex shader and pass the colour to the fragment shader.",
    ),
    (
        "gouraud-instead-of-phong",
        "The light is computed for each vertex instead of each fragment",
        "The light is interpolated across triangles, and highlights are angular or missing.",
        "Pass position and normal to the fragment shader, and compute the light there.",
    ),
    (
        "ambient-in-cone",
        "The spot light's cone cuts the ambient term too",
        "Outside the cone the surface is black, where ambient light should remain.",
        "Multiply only the diffuse and specular terms by the cone's factor.",
    ),
    (
        "attenuation-other-formula",
        "The attenuation is not 1 / (kc + kl d + kq d^2)",
        "The light is too bright or too dark at most distances, or ends abruptly.",
        "`1.0 / (constant + linear * d + quadratic * d * d)`. In a project of your own this may be intended.",
    ),
];

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn the_files_can_be_read() {
        let files = TEXTS.map(|text| toml::from_str::<File>(text).unwrap().mistake);
        assert!(files[0].len() > 90, "{}", files[0].len());
        assert!(files.iter().all(|file| file.len() > 20));
        assert_eq!([files.concat(), faces::mistakes()].concat(), all());
    }

    #[test]
    fn ids_are_kebab_case_and_stand_once_a_model() {
        let mut seen = BTreeSet::new();
        for mistake in all() {
            let word =
                |word: &str| !word.is_empty() && word.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit());
            assert!(mistake.id.split('-').all(word), "{}", mistake.id);
            for model in &mistake.models {
                assert!(seen.insert((mistake.id.clone(), *model)), "{} stands twice for {model:?}", mistake.id);
            }
        }
    }

    #[test]
    fn everything_that_is_wrong_says_how_to_mend_it() {
        for mistake in all().iter().filter(|mistake| !mistake.harmless) {
            for text in [&mistake.looks_like, &mistake.fix, &mistake.lecture_section] {
                assert!(!text.is_empty(), "{}", mistake.id);
            }
            for other in &mistake.looks_the_same_as {
                assert!(find(other).is_some(), "{}: {other}", mistake.id);
            }
        }
    }
}
