//! Quantities of the light equation in words.

use super::model::{Quantity, Space};
use super::repair::{Make, Repair};

/// The variables of the model solutions, and what they are.
const WORDS: [(&str, &str); 71] = [
    ("world_position", "the position"),
    ("world_place", "the position"),
    ("model_position", "the position in model space"),
    ("world_normal", "the normal"),
    ("v_normal", "the normal"),
    ("N", "the unit normal"),
    ("to_light", "the vector from the surface to the light"),
    ("L", "the unit direction from the surface to the light"),
    ("-L", "the unit direction from the light to the surface"),
    ("to_eye", "the vector from the surface to the eye"),
    ("V", "the unit direction from the surface to the eye"),
    ("from_eye", "the vector from the eye to the surface"),
    ("I", "the unit direction from the eye to the surface"),
    ("R", "the reflected or refracted direction"),
    ("looked_up", "the direction to look up in the cubemap"),
    ("H", "the unit half vector"),
    ("L + V", "the sum of the directions to the light and to the eye"),
    ("dot(N, L)", "the cosine between normal and light"),
    ("dot(N, V)", "the cosine between normal and eye"),
    ("dot(N, H)", "the cosine between normal and half vector"),
    ("dot(R, V)", "the cosine between reflected direction and eye"),
    ("vec4(position, 1.0)", "the position in model space"),
    ("diffuse + specular", "the sum of the diffuse and the specular term"),
    ("(diffuse + specular)", "the sum of the diffuse and the specular term"),
    ("cos_theta", "the cosine between normal and light, at least 0"),
    ("cos_highlight", "the cosine of the highlight"),
    ("cos_phi", "the cosine of the highlight, at least 0"),
    ("spec", "the cosine of the highlight to the power of the shininess"),
    ("d", "the distance from the surface to the light"),
    ("attenuation", "the attenuation"),
    ("ambient", "the ambient term"),
    ("diffuse", "the diffuse term"),
    ("specular", "the specular term"),
    ("diffuse_light", "the diffuse term times the attenuation"),
    ("specular_light", "the specular term times the attenuation"),
    ("attenuated", "the sum of diffuse and specular light, attenuated"),
    ("lit", "the sum of all terms"),
    ("colour", "the sum of all terms times the material's colour"),
    ("FragColor", "the colour of the right answer"),
    ("found", "the colour of the cubemap in the right direction"),
    ("gl_Position", "the position on the screen: P V M times the position"),
    ("light_pos", "the position of the light"),
    ("u_view_pos", "the position of the eye"),
    ("materialColour", "the material's colour"),
    ("light.ambient_strength", "the ambient strength"),
    ("light.diffuse_strength", "the diffuse strength"),
    ("light.specular_strength", "the specular strength"),
    ("light.constant", "the constant of the attenuation"),
    ("light.linear", "the linear constant of the attenuation"),
    ("light.quadratic", "the quadratic constant of the attenuation"),
    ("shininess", "the shininess"),
    ("roughness", "the roughness"),
    ("PI", "pi"),
    ("cos_delta", "the cosine between normal and half vector"),
    ("tan_squared", "the squared tangent of the angle between normal and half vector"),
    ("tangent", "the tangent of the angle between normal and half vector"),
    ("delta", "the angle between normal and half vector"),
    ("alpha_squared", "the square of the roughness"),
    ("exponent", "the exponent of Ward's model"),
    ("normalisation", "the normalisation of Ward's model, 4 pi alpha^2"),
    ("divisor", "the normalisation of Ward's model times the root of the cosines"),
    ("gauss", "the exponential of Ward's model"),
    ("cos_view", "the cosine between normal and eye"),
    ("root", "the root of the cosines of light and eye"),
    ("diffuse_brdf", "the diffuse BRDF"),
    ("specular_brdf", "Ward's specular BRDF"),
    ("brdf", "the sum of the diffuse and the specular BRDF"),
    ("irradiance", "the light of the lamp that the surface receives"),
    ("ward", "Ward's specular BRDF without its strength"),
    ("refractionIndice", "the index of refraction"),
    ("ratio", "the ratio of the indices of refraction"),
];

/// A quantity's name in words.
fn words(name: &str) -> Option<&'static str> {
    WORDS.iter().find(|(known, _)| *known == name).map(|(_, words)| *words)
}

/// A product of quantities in words: "the attenuation times the diffuse term".
fn product(name: &str) -> String {
    let factors: Vec<&str> = name.split(" * ").filter_map(words).collect();
    match factors.as_slice() {
        [_, ..] if factors.len() == name.split(" * ").count() => factors.join(" times "),
        _ => format!("`{name}`"),
    }
}

/// A right quantity in words: "the unit normal, in view space".
#[must_use]
pub fn quantity(quantity: &Quantity) -> String {
    let name = words(&quantity.name).map_or_else(|| product(&quantity.name), str::to_owned);
    let of_vertices = if quantity.interpolated { ", interpolated" } else { "" };
    match quantity.space {
        Space::View => format!("{name}, in view space{of_vertices}"),
        Space::World => format!("{name}{of_vertices}"),
    }
}

/// What an expression should be.
#[must_use]
pub fn should_be(repair: &Repair, quantities: &[Quantity], added: &str) -> String {
    let of = |index: usize| quantities.get(index).map(quantity).unwrap_or_default();
    match repair.make {
        Make::Quantity(index) => format!("should be {}", of(index)),
        Make::Negative => "should have the other sign".to_owned(),
        Make::Unit => "should be normalised".to_owned(),
        Make::NotNegative => "should be at least 0".to_owned(),
        Make::Linear => "should not be raised to 1 / 2.2".to_owned(),
        Make::Times(index) => format!("should be multiplied by {}", of(index)),
        Make::Over(index) => format!("should be divided by {}", of(index)),
        Make::Plus(_) => format!("should have `{added}` added"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cause::ModelSolutions;
    use crate::cause::model::{AnswerMethod, Mistakes, Model};
    use crate::cause::samples::SceneSamples;
    use crate::mistakes::ModelSolution;
    use crate::testbench::scene;

    #[test]
    fn every_quantity_but_matrices_has_words() {
        let samples: Vec<SceneSamples> = scene::lit().into_iter().take(1).map(SceneSamples::new).collect();
        for model in ModelSolution::ALL.into_iter().filter(|model| {
            model.is_lit() || *model == ModelSolution::Reflection || *model == ModelSolution::Refraction
        }) {
            let method = AnswerMethod::new(model);
            let model =
                Model::new(&ModelSolutions::default(), method, Space::World, &samples, 1.0, Mistakes::These(&[]))
                    .unwrap();
            for q in model.quantities.iter().filter(|q| q.values.size <= 4) {
                assert!(!product(&q.name).contains('`') || q.name == "v_col", "{}", q.name);
            }
        }
    }
}
