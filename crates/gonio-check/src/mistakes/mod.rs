//! The catalogue of mistakes: each changes one of the model solutions slightly, and has a name, a symptom and a fix.

mod compose;
pub mod faces;
mod texts;

pub(crate) use compose::Assignment;
pub use compose::{Hypotheses, Hypothesis};
pub use texts::MistakeTexts;

use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::sync::LazyLock;

/// A mistake or a harmless peculiarity.
#[derive(Clone, Debug, Default, Deserialize, Serialize, PartialEq, Eq)]
#[serde(deny_unknown_fields)]
pub struct Mistake {
    /// A stable id in kebab-case.
    pub id: String,
    /// The mistake in half a sentence, in English as all texts here; [`Mistake::texts`] are those to show.
    pub name: String,
    /// The model solutions in which it can be made; none for mistakes in files of another kind.
    #[serde(default)]
    pub models: Vec<ModelSolution>,
    /// Whether it is right, although the source differs.
    #[serde(default)]
    pub harmless: bool,
    /// Whether the lab's own solutions do the same.
    #[serde(default)]
    pub lab_does_it: bool,
    /// The symptom in the picture; empty for harmless peculiarities.
    #[serde(default)]
    pub looks_like: String,
    /// How to fix it; empty for harmless peculiarities.
    #[serde(default)]
    pub fix: String,
    /// The section of the lecture that teaches it; empty for harmless peculiarities.
    #[serde(default)]
    pub lecture_section: String,
    /// Whether its picture is not a sum of terms, so that only one common factor can be fitted.
    #[serde(default)]
    pub whole: bool,
    /// Whether it makes cosines exceed 1, so that its picture depends on whether the program limits them.
    #[serde(default)]
    pub exceeds_one: bool,
    /// Other ids whose pictures are the same in principle.
    #[serde(default)]
    pub looks_the_same_as: Vec<String>,
    /// Ways to make it: the variables of the model solution and the values assigned instead.
    #[serde(default)]
    pub change: Vec<BTreeMap<String, String>>,
}

/// The terms of the light equation, in the order of [`crate::verdict::Verdict::terms`].
pub const TERMS: [&str; 3] = ["ambient", "diffuse", "specular"];

/// Returns the term that a mistake concerns, by its id: `specular-missing` concerns the specular term. `None` for
/// mistakes that concern several terms, such as those with a normal, or none.
pub fn term_of(id: &str) -> Option<&'static str> {
    TERMS.into_iter().find(|term| id.strip_prefix(term).is_some_and(|rest| rest.starts_with('-')))
}

/// The files of the catalogue: one for all lighting exercises, and those of single exercises.
const TEXTS: [&str; 4] = [
    include_str!("../../../../exercises/mistakes.toml"),
    include_str!("../../../../exercises/ex01-camera/mistakes.toml"),
    include_str!("../../../../exercises/ex12-which-brdf/mistakes.toml"),
    include_str!("../../../../exercises/s1-panorama-to-cubemap/mistakes.toml"),
];

#[derive(Deserialize)]
struct File {
    mistake: Vec<Mistake>,
}

/// Returns all mistakes in the order of the files, followed by those of single faces. An id occurs more than once if
/// its change differs between model solutions.
pub fn all() -> &'static [Mistake] {
    static ALL: LazyLock<Vec<Mistake>> = LazyLock::new(|| {
        // The files are embedded in the program, and a test reads them.
        let files = TEXTS.iter().filter_map(|text| toml::from_str::<File>(text).ok());
        files.flat_map(|file| file.mistake).chain(faces::mistakes()).collect()
    });
    &ALL
}

/// Returns the mistakes that can be made in a model.
pub fn for_model(model: ModelSolution) -> impl Iterator<Item = &'static Mistake> {
    all().iter().filter(move |mistake| model.has_mistakes_of(&mistake.models))
}

/// Returns the first mistake with this id, of the catalogue or of [`structural`].
pub fn find(id: &str) -> Option<&'static Mistake> {
    all().iter().chain(structural()).find(|mistake| mistake.id == id)
}

/// A right answer that hypotheses change: written so that each quantity has a line of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Deserialize, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum ModelSolution {
    /// The light equation per fragment.
    Phong,
    /// The light equation per vertex.
    Gouraud,
    /// The light equation per fragment, with Ward's BRDF instead of Phong's highlight.
    Ward,
    /// The same per vertex. Its mistakes are those of both.
    WardPerVertex,
    /// A mirror.
    Reflection,
    /// Glass with one refracting surface.
    Refraction,
    /// A skybox.
    Skybox,
    /// A camera built from its position, Front and Up.
    Camera,
    /// The same with the distance as colour. Its mistakes are those of the camera.
    Places,
    /// The faces of a cubemap, computed from a panorama.
    Panorama,
}

macro_rules! shader {
    ($name:literal) => {
        include_str!(concat!("../../../../exercises/models/", $name))
    };
}

impl ModelSolution {
    /// All model solutions with mistakes of their own.
    pub const ALL: [ModelSolution; 8] = [
        ModelSolution::Phong,
        ModelSolution::Gouraud,
        ModelSolution::Ward,
        ModelSolution::Reflection,
        ModelSolution::Refraction,
        ModelSolution::Skybox,
        ModelSolution::Camera,
        ModelSolution::Panorama,
    ];

    /// Returns the vertex and the fragment shader, `#version 330 core`.
    pub fn sources(self) -> [&'static str; 2] {
        match self {
            ModelSolution::Phong => [shader!("phong.vert"), shader!("phong.frag")],
            ModelSolution::Gouraud => [shader!("gouraud.vert"), shader!("gouraud.frag")],
            ModelSolution::Ward => [shader!("phong.vert"), shader!("ward.frag")],
            ModelSolution::WardPerVertex => [shader!("ward_per_vertex.vert"), shader!("gouraud.frag")],
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
        self.has_exponent() || self.has_roughness()
    }

    /// Whether it computes light in the vertex shader.
    pub fn is_per_vertex(self) -> bool {
        matches!(self, ModelSolution::Gouraud | ModelSolution::WardPerVertex)
    }

    /// Whether its highlight is a power of a cosine: that of the reflected direction or, as well, of the half vector.
    pub fn has_exponent(self) -> bool {
        matches!(self, ModelSolution::Phong | ModelSolution::Gouraud)
    }

    /// Whether its highlight depends on a roughness.
    pub fn has_roughness(self) -> bool {
        matches!(self, ModelSolution::Ward | ModelSolution::WardPerVertex)
    }

    /// Whether its colour is a cubemap lookup.
    pub fn is_looked_up(self) -> bool {
        matches!(self, ModelSolution::Skybox | ModelSolution::Reflection | ModelSolution::Refraction)
    }

    /// Whether a mistake of these model solutions can be made in this one.
    fn has_mistakes_of(self, models: &[ModelSolution]) -> bool {
        match self {
            ModelSolution::Places => models.contains(&ModelSolution::Camera),
            // Lines that both of them have, and those of Ward's formula.
            ModelSolution::WardPerVertex => {
                models == [ModelSolution::Ward]
                    || [ModelSolution::Ward, ModelSolution::Gouraud].iter().all(|model| models.contains(model))
            }
            other => models.contains(&other),
        }
    }

    /// Whether it concerns positions on the screen: the picture of two mistakes then resembles neither of them alone.
    pub fn is_of_places(self) -> bool {
        matches!(self, ModelSolution::Camera | ModelSolution::Places)
    }
}

/// Returns the mistakes that are not a change of one line: another model solution, or more than any of them computes.
pub fn structural() -> &'static [Mistake] {
    static ALL: LazyLock<Vec<Mistake>> = LazyLock::new(|| STRUCTURAL.iter().map(structural_mistake).collect());
    &ALL
}

fn structural_mistake((id, name, looks_like, fix): &(&str, &str, &str, &str)) -> Mistake {
    Mistake {
        id: (*id).to_owned(),
        name: (*name).to_owned(),
        models: vec![ModelSolution::Phong, ModelSolution::Gouraud],
        looks_like: (*looks_like).to_owned(),
        fix: (*fix).to_owned(),
        lecture_section: "Where is the rendering equation computed?".to_owned(),
        ..Mistake::default()
    }
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
        "varying-flat",
        "A value is not interpolated: `flat` gives each triangle the value of one of its vertices",
        "Every triangle has a single colour, or shows its edges.",
        "Delete `flat` in both shaders. It is needed for integers only.",
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
    fn the_catalogue_can_be_read() {
        let files = TEXTS.map(|text| toml::from_str::<File>(text).unwrap().mistake);
        assert!(files[0].len() > 90, "{}", files[0].len());
        assert!(files.iter().all(|file| file.len() > 20));
        assert_eq!([files.concat(), faces::mistakes()].concat(), all());
    }

    #[test]
    fn ids_are_kebab_case_and_unique_in_each_model() {
        let mut seen = BTreeSet::new();
        for mistake in all() {
            let word =
                |word: &str| !word.is_empty() && word.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit());
            assert!(mistake.id.split('-').all(word), "{}", mistake.id);
            for model in &mistake.models {
                assert!(seen.insert((mistake.id.clone(), *model)), "{} occurs twice for {model:?}", mistake.id);
            }
        }
    }

    #[test]
    fn every_mistake_has_a_symptom_and_a_fix() {
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
