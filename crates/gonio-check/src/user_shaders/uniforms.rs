//! The uniforms of a user's program: where each value comes from, and how it is chosen.

use super::inputs::{self, DrawInputs};
use crate::compile::ParsedStage;
use crate::roles::{Declared, Role};
use crate::words::words_of;
use gonio_glsl::{OutputVersion, Type};
use gonio_language::tr;
use gonio_scene::{Frame, Scene};

/// Where the value of a uniform comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UniformSource {
    /// The scene, by this role.
    Scene(Role),
    /// Its initialiser in the shader.
    Initialiser,
    /// `names.toml`.
    NamesFile,
    /// The user.
    Chosen,
    /// Nobody: a plausible value.
    Guess,
}

/// A uniform of a user's program that is not a sampler.
#[derive(Clone, Debug, PartialEq)]
pub struct UserUniform {
    /// Its name in OpenGL.
    pub name: String,
    /// Its type: `float`, `vec3`, `mat4`.
    pub glsl_type: String,
    /// Elements of an array of a basic type, otherwise 1.
    pub elements: u32,
    /// Where its value comes from.
    pub source: UniformSource,
    /// The numbers if they do not come from the scene, columns of a matrix first.
    pub values: Vec<f32>,
    /// The role that a value of the user replaces, and the values of the others.
    unchosen: (UniformSource, Vec<f32>),
}

impl UserUniform {
    /// `values`: those of the source if they do not come from the scene, of all elements or of one.
    pub(super) fn new(declared: &Declared, source: UniformSource, values: Option<Vec<f32>>) -> Self {
        let size = components(&declared.glsl_type) * declared.array.max(1) as usize;
        let mut values = values.unwrap_or_else(|| guess(&declared.glsl_type, is_color_name(&declared.name)));
        let one = values.clone();
        while values.len() < size && !one.is_empty() {
            values.extend(&one);
        }
        values.resize(size, 0.0);
        UserUniform {
            name: declared.name.clone(),
            glsl_type: declared.glsl_type.clone(),
            elements: declared.array.max(1),
            source,
            unchosen: (source, values.clone()),
            values,
        }
    }

    /// Whether the name is that of a colour and the type can hold one.
    pub fn is_color(&self) -> bool {
        matches!(self.glsl_type.as_str(), "vec3" | "vec4") && self.elements == 1 && is_color_name(&self.name)
    }

    /// Takes a value of the user: the numbers of all elements, or of one for all.
    ///
    /// # Errors
    /// It takes another number of values; one sentence.
    pub fn choose(&mut self, values: &[f32]) -> Result<(), String> {
        let (expected, given) = (self.values.len(), values.len());
        let element = components(&self.glsl_type);
        if given != expected && given != element {
            let numbers = if expected == 1 {
                tr!("check-inputs-1-number")
            } else {
                &tr!("check-inputs-numbers", expected = expected)
            };
            return Err(tr!(
                "check-inputs-uniform-takes-numbers",
                name = self.name,
                glsl_type = self.glsl_type,
                numbers = numbers,
                given = given
            ));
        }
        self.values = values.iter().copied().cycle().take(expected).collect();
        self.source = UniformSource::Chosen;
        Ok(())
    }

    /// Returns to the value that it had before the user chose one.
    pub fn reset(&mut self) {
        (self.source, self.values) = self.unchosen.clone();
    }

    /// Where its value comes from, as a part of a sentence: "from the camera".
    pub fn origin(&self) -> String {
        match self.source {
            UniformSource::Scene(role) => inputs::origin(role),
            UniformSource::Initialiser => tr!("check-inputs-its-initialiser").to_owned(),
            UniformSource::NamesFile => "names.toml".to_owned(),
            UniformSource::Chosen => tr!("check-inputs-your-value").to_owned(),
            UniformSource::Guess => tr!("check-inputs-not-recognised-a-guess").to_owned(),
        }
    }

    /// The numbers for the first part of the scene, to be shown.
    pub fn values_in(&self, scene: &Scene, frame: &Frame) -> Vec<f32> {
        let object = scene.objects.first();
        let material = object.and_then(|object| scene.materials.get(object.parts.first()?.material));
        match (object, material) {
            (Some(object), Some(material)) => {
                let input = DrawInputs { frame, world_from_model: object.world_from_model, material };
                let mut values = self.values_for(&input);
                values.resize(self.values.len(), 0.0);
                values
            }
            _ => self.values.clone(),
        }
    }

    /// The numbers for one draw.
    pub(super) fn values_for(&self, input: &DrawInputs<'_>) -> Vec<f32> {
        match self.source {
            UniformSource::Scene(role) => {
                inputs::values(role, &self.glsl_type, self.elements, input).unwrap_or_else(|| self.values.clone())
            }
            _ => self.values.clone(),
        }
    }
}

/// Numbers of a value of this type; 1 if it is unknown.
pub(super) fn components(glsl_type: &str) -> usize {
    Type::named(glsl_type).and_then(|ty| ty.components()).map_or(1, |count| count as usize)
}

fn is_color_name(name: &str) -> bool {
    const COLORS: [&str; 9] = ["color", "colour", "col", "albedo", "tint", "rgb", "rgba", "farbe", "couleur"];
    // `baseColour` and `skycolor`; the last part of `light.colour`.
    words_of(name)
        .iter()
        .any(|word| COLORS.contains(&word.as_str()) || word.ends_with("color") || word.ends_with("colour"))
}

/// A value with which most shaders show something: the middle of 0 to 1, grey, the identity.
fn guess(glsl_type: &str, is_color: bool) -> Vec<f32> {
    match Type::named(glsl_type) {
        Some(Type::Matrix { columns, rows, .. }) => {
            (0..columns).flat_map(|c| (0..rows).map(move |r| if c == r { 1.0 } else { 0.0 })).collect()
        }
        Some(Type::Vector(_, size)) => {
            let value = if is_color { 0.8 } else { 0.5 };
            (0..size).map(|i| if i == 3 { 1.0 } else { value }).collect()
        }
        Some(Type::Scalar(gonio_glsl::Scalar::Float | gonio_glsl::Scalar::Double)) => vec![0.5],
        _ => vec![1.0],
    }
}

/// The values of the initialisers of uniforms, by OpenGL's names.
pub(super) fn initial_values(stage: &ParsedStage<'_>) -> Vec<(String, Vec<f32>)> {
    // A version without initialisers lists them.
    let translated = gonio_glsl::translate(&stage.parsed, &stage.checked, OutputVersion::Es300);
    let renamed = |name: String| {
        let rename = translated.renames.iter().find(|rename| rename.to == name);
        rename.map_or(name, |rename| rename.from.clone())
    };
    translated
        .uniform_defaults
        .clone()
        .into_iter()
        .filter(|default| !matches!(default.ty, Some(Type::Opaque(_))))
        .filter_map(|default| {
            let values = default.value?.into_iter().map(|value| value as f32).collect();
            Some((renamed(default.name), values))
        })
        .collect()
}

/// Reads `NAME=VALUE[,VALUE...]`: numbers, `true` and `false`, or a colour `#rrggbb` as it is shown.
///
/// # Errors
/// A sentence that names the part that is not a value.
pub fn parse_setting(text: &str) -> Result<(String, Vec<f32>), String> {
    let wrong = || tr!("check-inputs-invalid-uniform-expected-name-value-value", text = text);
    let (name, values) = text.split_once('=').ok_or_else(wrong)?;
    let name = name.trim();
    if name.is_empty() || values.trim().is_empty() {
        return Err(wrong());
    }
    if let Some(digits) = values.trim().strip_prefix('#') {
        let number = u32::from_str_radix(digits, 16).ok().filter(|_| digits.len() == 6).ok_or_else(wrong)?;
        let [_, r, g, b] = number.to_be_bytes();
        return Ok((name.to_owned(), [r, g, b].map(|byte| f32::from(byte) / 255.0).to_vec()));
    }
    let value = |word: &str| match word.trim() {
        "true" => Ok(1.0),
        "false" => Ok(0.0),
        word => word
            .parse::<f32>()
            .ok()
            .filter(|value| value.is_finite())
            .ok_or_else(|| tr!("check-inputs-invalid-value-of-the-uniform-expected", word = word, name = name)),
    };
    let values = values.split(',').map(value).collect::<Result<_, _>>()?;
    Ok((name.to_owned(), values))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_are_numbers_truth_values_or_colours() {
        let read = |text| parse_setting(text);
        assert_eq!(read("scale=2"), Ok(("scale".to_owned(), vec![2.0])));
        assert_eq!(read("light.pos= 1,-2 ,3e1"), Ok(("light.pos".to_owned(), vec![1.0, -2.0, 30.0])));
        assert_eq!(read("on=true,false"), Ok(("on".to_owned(), vec![1.0, 0.0])));
        assert_eq!(read("tint=#ff0033"), Ok(("tint".to_owned(), vec![1.0, 0.0, 0.2])));
        for wrong in ["scale", "=1", "scale=", "tint=#12", "tint=#gg0000", "a=1,,2", "a=nan", "a=1e99"] {
            assert!(read(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn a_chosen_value_must_fit_and_can_be_taken_back() {
        let mut uniform =
            UserUniform::new(&Declared::uniform("u_tint", "vec3"), UniformSource::Scene(Role::MaterialColor), None);
        assert!(uniform.is_color());
        let error = uniform.choose(&[1.0, 2.0]).unwrap_err();
        assert_eq!(error, "`u_tint` is a vec3 and takes 3 numbers, not 2");
        assert_eq!(uniform.choose(&[1.0, 2.0, 3.0]), Ok(()));
        assert_eq!((uniform.source, uniform.origin().as_str()), (UniformSource::Chosen, "your value"));
        uniform.reset();
        assert_eq!(uniform.source, UniformSource::Scene(Role::MaterialColor));
        // One value for all elements of an array.
        let array = Declared { array: 3, ..Declared::uniform("weights", "vec2") };
        let mut uniform = UserUniform::new(&array, UniformSource::Guess, None);
        assert_eq!(uniform.choose(&[1.0, 2.0]), Ok(()));
        assert_eq!(uniform.values, [1.0, 2.0, 1.0, 2.0, 1.0, 2.0]);
    }
}
