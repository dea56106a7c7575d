//! Ward's model where light or eye are behind the surface: programs return 0 there, or keep the cosines above 0.

use super::values::Values;

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

/// Whether a quantity may be anything where light or eye are behind the surface.
pub(super) fn is_open_behind(name: &str) -> bool {
    IN_FRONT.contains(&name)
}

/// Whether light and eye are in front of the surface, at each point.
pub(super) fn in_front(normal: &Values, to_light: &Values, to_eye: &Values) -> Vec<bool> {
    let cosine =
        |point: usize, to: &Values| -> f32 { normal.at(point).iter().zip(to.at(point)).map(|(a, b)| a * b).sum() };
    let is_it = |point: usize| cosine(point, to_light) > LEAST_COSINE && cosine(point, to_eye) > LEAST_COSINE;
    (0..normal.points()).map(is_it).collect()
}

#[cfg(test)]
mod tests {
    use crate::cause::model::{AnswerMethod, Mistakes, Model, Space};
    use crate::cause::samples::SceneSamples;
    use crate::cause::solutions::ModelSolutions;
    use crate::mistakes::ModelSolution;
    use crate::testbench::scene;
    use glam::{DVec3, Vec3};
    use gonio_glsl::Stage;
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
