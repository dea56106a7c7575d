//! Ward's model where light or eye are behind the surface: programs return 0 there, or keep the cosines above 0.

use super::model::{Model, Quantity};
use super::values::Values;
use gonio_glsl::Stage;

/// Quantities that may be anything there, because a cosine makes them 0 afterwards.
const IN_FRONT: [&str; 11] = [
    "cos_delta",
    "delta",
    "tan_squared",
    "tangent",
    "exponent",
    "gauss",
    "root",
    "divisor",
    "ward",
    "specular_brdf",
    "brdf",
];

/// Cosines below this one count as behind.
const LEAST_COSINE: f32 = 2e-3;

/// Whether light and eye are in front of the surface, at each place.
fn is_in_front(model: &Model) -> Option<Vec<bool>> {
    let of = |name: &str| model.right(name, Stage::Fragment, false);
    let (normal, to_light, to_eye) = (of("N")?, of("L")?, of("V")?);
    let cosine =
        |point: usize, to: &Values| -> f32 { normal.at(point).iter().zip(to.at(point)).map(|(a, b)| a * b).sum() };
    let is_it = |point: usize| cosine(point, to_light) > LEAST_COSINE && cosine(point, to_eye) > LEAST_COSINE;
    Some((0..normal.points()).map(is_it).collect())
}

/// Leaves out the places at which a quantity may be anything. The model's own switch between both is none.
pub(super) fn leave_out_the_dark(model: &mut Model) {
    model.quantities.retain(|quantity| quantity.name != "cut");
    let Some(in_front) = is_in_front(model) else { return };
    let is_open = |quantity: &&mut Quantity| IN_FRONT.contains(&quantity.name.as_str());
    for quantity in model.quantities.iter_mut().filter(is_open) {
        quantity.values.present.iter_mut().zip(&in_front).for_each(|(present, in_front)| *present &= in_front);
    }
}

#[cfg(test)]
mod tests {
    use super::super::model::{AnswerMethod, Mistakes, Space};
    use super::super::prediction::ModelSolutions;
    use super::super::samples::SceneSamples;
    use super::*;
    use crate::mistakes::ModelSolution;
    use crate::testbench::scene;
    use glam::{DVec3, Vec3};
    use gonio_light::ShadingPoint;
    use gonio_light::brdf::ward::lobe_of_roughness;

    #[test]
    fn the_model_solution_is_the_lobe_of_the_papers() {
        let samples: Vec<SceneSamples> = scene::lit().into_iter().map(SceneSamples::new).collect();
        let solutions = ModelSolutions::default();
        let method = AnswerMethod::new(ModelSolution::Ward);
        let model = Model::new(&solutions, method, Space::World, &samples, 1.0, Mistakes::These(&[])).unwrap();
        let of = |name: &str| model.right(name, Stage::Fragment, false).unwrap();
        let vector = |name: &str, point: usize| Vec3::from_slice(of(name).at(point)).as_dvec3().normalize();
        let ward = of("ward");
        let (mut first, mut compared) = (0, 0);
        for samples in &samples {
            for point in (first..first + samples.places.len()).filter(|point| ward.present[*point]) {
                let [normal, light, view] = ["N", "L", "V"].map(|name| vector(name, point));
                let at = ShadingPoint { position: DVec3::ZERO, normal, view, tangent: DVec3::X };
                let expected = lobe_of_roughness(&at, light, f64::from(samples.scene.roughness), false);
                let found = f64::from(ward.at(point)[0]);
                assert!((found - expected).abs() <= 1e-4 * expected + 1e-6, "{found}, not {expected}");
                compared += 1;
            }
            first += samples.places.len();
        }
        assert!(compared > 1_000, "{compared}");
    }
}
