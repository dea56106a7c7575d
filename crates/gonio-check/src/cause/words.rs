//! Quantities of the light equation in words.

use super::model::{Quantity, Space};
use super::repair::{Make, Repair};
use gonio_language::tr;

/// The variables of the model solutions, and the ids of their texts.
const WORDS: [(&str, &str); 87] = [
    ("world_position", "check-quantity-position"),
    ("world_place", "check-quantity-position"),
    ("model_position", "check-quantity-position-in-model-space"),
    ("world_normal", "check-quantity-normal"),
    ("v_normal", "check-quantity-normal"),
    ("N", "check-quantity-unit-normal"),
    ("to_light", "check-quantity-vector-to-light"),
    ("L", "check-quantity-direction-to-light"),
    ("-L", "check-quantity-direction-from-light"),
    ("to_eye", "check-quantity-vector-to-eye"),
    ("V", "check-quantity-direction-to-eye"),
    ("from_eye", "check-quantity-vector-from-eye"),
    ("v_from_eye", "check-quantity-vector-from-eye"),
    ("I", "check-quantity-direction-from-eye"),
    ("R", "check-quantity-reflected-or-refracted-direction"),
    ("looked_up", "check-quantity-looked-up-direction"),
    ("H", "check-quantity-unit-half-vector"),
    ("L + V", "check-quantity-sum-of-directions"),
    ("dot(N, L)", "check-quantity-cosine-of-light"),
    ("2.0 * dot(N, L)", "check-quantity-twice-the-cosine-of-light"),
    ("dot(N, L) * N", "check-quantity-normal-times-the-cosine"),
    ("2.0 * dot(N, L) * N", "check-quantity-normal-times-twice-the-cosine"),
    ("dot(N, V)", "check-quantity-cosine-of-eye"),
    ("dot(N, I)", "check-quantity-cosine-of-incidence"),
    ("2.0 * dot(N, I)", "check-quantity-twice-the-cosine-of-incidence"),
    ("dot(N, I) * N", "check-quantity-normal-times-the-cosine-of-incidence"),
    ("2.0 * dot(N, I) * N", "check-quantity-normal-times-twice-the-cosine-of-incidence"),
    ("ratio * ratio", "check-quantity-squared-ratio"),
    ("1.0 - dot(N, I) * dot(N, I)", "check-quantity-squared-sine-of-incidence"),
    ("k", "check-quantity-squared-cosine-of-refraction"),
    ("sqrt(k)", "check-quantity-cosine-of-refraction"),
    ("dot(N, H)", "check-quantity-cosine-of-half-vector"),
    ("dot(R, V)", "check-quantity-cosine-of-reflection"),
    ("vec4(position, 1.0)", "check-quantity-position-in-model-space"),
    ("diffuse + specular", "check-quantity-sum-of-terms"),
    ("(diffuse + specular)", "check-quantity-sum-of-terms"),
    ("cos_theta", "check-quantity-cosine-clamped"),
    ("cos_highlight", "check-quantity-highlight-cosine"),
    ("cos_phi", "check-quantity-highlight-cosine-clamped"),
    ("spec", "check-quantity-highlight"),
    ("d", "check-quantity-distance-to-light"),
    ("attenuation", "check-quantity-attenuation"),
    ("ambient", "check-quantity-ambient-term"),
    ("diffuse", "check-quantity-diffuse-term"),
    ("specular", "check-quantity-specular-term"),
    ("diffuse_light", "check-quantity-diffuse-attenuated"),
    ("specular_light", "check-quantity-specular-attenuated"),
    ("attenuated", "check-quantity-attenuated-sum"),
    ("lit", "check-quantity-sum-of-all-terms"),
    ("colour", "check-quantity-coloured-sum"),
    ("v_col", "check-quantity-coloured-sum"),
    ("FragColor", "check-quantity-right-colour"),
    ("found", "check-quantity-cubemap-colour"),
    ("gl_Position", "check-quantity-position-on-screen"),
    ("place", "check-quantity-position-on-screen-of-the-sky"),
    ("direction", "check-quantity-looked-up-direction"),
    ("turned", "check-quantity-turned-position"),
    ("light_pos", "check-quantity-position-of-the-light"),
    ("u_view_pos", "check-quantity-position-of-the-eye"),
    ("materialColour", "check-quantity-material-s-colour"),
    ("light.ambient_strength", "check-quantity-ambient-strength"),
    ("light.diffuse_strength", "check-quantity-diffuse-strength"),
    ("light.specular_strength", "check-quantity-specular-strength"),
    ("light.constant", "check-quantity-attenuation-constant"),
    ("light.linear", "check-quantity-attenuation-linear"),
    ("light.quadratic", "check-quantity-attenuation-quadratic"),
    ("shininess", "check-quantity-shininess"),
    ("roughness", "check-quantity-roughness"),
    ("PI", "check-quantity-pi"),
    ("cos_delta", "check-quantity-cosine-of-half-vector"),
    ("tan_squared", "check-quantity-squared-tangent"),
    ("tangent", "check-quantity-tangent"),
    ("delta", "check-quantity-angle"),
    ("alpha_squared", "check-quantity-square-of-the-roughness"),
    ("exponent", "check-quantity-exponent-of-ward"),
    ("normalisation", "check-quantity-normalisation-of-ward"),
    ("divisor", "check-quantity-divisor-of-ward"),
    ("gauss", "check-quantity-exponential-of-ward"),
    ("cos_view", "check-quantity-cosine-of-eye"),
    ("root", "check-quantity-root-of-cosines"),
    ("diffuse_brdf", "check-quantity-diffuse-brdf"),
    ("specular_brdf", "check-quantity-ward-s-specular-brdf"),
    ("brdf", "check-quantity-sum-of-brdfs"),
    ("irradiance", "check-quantity-irradiance"),
    ("ward", "check-quantity-ward-without-strength"),
    ("refractionIndice", "check-quantity-index-of-refraction"),
    ("ratio", "check-quantity-ratio-of-indices"),
];

/// A quantity's name in words.
fn words(name: &str) -> Option<&'static str> {
    WORDS.iter().find(|(known, _)| *known == name).map(|(_, id)| tr!(id))
}

/// A quantity's name in words, or a product of such: "the attenuation times the diffuse term".
fn product(name: &str) -> String {
    if let Some(whole) = words(name) {
        return whole.to_owned();
    }
    let factors: Option<Vec<&str>> = name.split(" * ").map(words).collect();
    let product = factors.and_then(|factors| {
        let factors = factors.into_iter().map(str::to_owned);
        factors.reduce(|product, factor| tr!("check-quantity-product", product = product, factor = factor))
    });
    product.unwrap_or_else(|| format!("`{name}`"))
}

/// A right quantity in words: "the unit normal, in view space".
#[must_use]
pub fn quantity(quantity: &Quantity) -> String {
    let name = product(&quantity.name);
    let name = match quantity.space {
        Space::View => tr!("check-quantity-in-view-space", quantity = name),
        Space::World => name,
    };
    if quantity.interpolated { tr!("check-quantity-interpolated", quantity = name) } else { name }
}

/// What an expression should be.
#[must_use]
pub fn should_be(repair: &Repair, quantities: &[Quantity], added: &str) -> String {
    let of = |index: usize| quantities.get(index).map(quantity).unwrap_or_default();
    match repair.make {
        Make::Quantity(index) => tr!("check-should-be", quantity = of(index)),
        Make::Negative => tr!("check-should-have-the-other-sign").to_owned(),
        Make::Unit => tr!("check-should-be-normalised").to_owned(),
        Make::NotNegative => tr!("check-should-be-at-least-zero").to_owned(),
        Make::Linear => tr!("check-should-be-linear").to_owned(),
        Make::Times(index) => tr!("check-should-be-multiplied", quantity = of(index)),
        Make::Over(index) => tr!("check-should-be-divided", quantity = of(index)),
        Make::Plus(_) => tr!("check-should-be-added", added = added),
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
        let others = [ModelSolution::Reflection, ModelSolution::Refraction, ModelSolution::Skybox];
        for model in ModelSolution::ALL.into_iter().filter(|model| model.is_lit() || others.contains(model)) {
            let method = AnswerMethod::new(model);
            let model =
                Model::new(&ModelSolutions::default(), method, Space::World, &samples, 1.0, Mistakes::These(&[]))
                    .unwrap();
            for q in model.quantities.iter().filter(|q| q.values.size <= 4) {
                assert!(!product(&q.name).contains('`'), "{}", q.name);
            }
        }
    }
}
