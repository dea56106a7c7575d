//! The steps of the formulas of reflection and refraction, which programs write by hand.

use super::model::{Model, Quantity, STAGES};
use super::observed::has_space;
use super::values::Values;
use gonio_glsl::Stage;

fn dot(a: &Values, b: &Values) -> Values {
    a.map(1, |point, a, to| to[0] = a.iter().zip(b.at(point)).map(|(a, b)| a * b).sum())
}

fn each(a: &Values, f: impl Fn(f32) -> f32) -> Values {
    a.map(1, |_, a, to| to[0] = f(a[0]))
}

impl Model {
    /// Adds the steps of `R = I - 2 (N . I) N`, and of Snell's law: `k = 1 - ratio^2 (1 - (N . I)^2)` and
    /// `R = ratio I - (ratio (N . I) + sqrt(k)) N`, with either sign of the cosine.
    pub(super) fn add_steps_of_optics(&mut self) {
        for stage in STAGES {
            let of = |name: &str| self.right(name, stage, false).cloned();
            // In lighting, these are steps of other formulas.
            let (Some(normal), Some(incident), None) = (of("N"), of("I"), of("L")) else { continue };
            let cosine = dot(&normal, &incident);
            let along_normal = |factor: f32| {
                normal.map(3, |p, a, to| to.iter_mut().zip(a).for_each(|(to, a)| *to = factor * cosine.at(p)[0] * a))
            };
            let mut steps = vec![
                ("dot(N, V)", each(&cosine, |cosine| -cosine)),
                ("dot(N, I)", cosine.clone()),
                ("2.0 * dot(N, I)", each(&cosine, |cosine| 2.0 * cosine)),
                ("dot(N, I) * N", along_normal(1.0)),
                ("2.0 * dot(N, I) * N", along_normal(2.0)),
            ];
            if let Some(ratio) = of("ratio") {
                let squared_sine = each(&cosine, |cosine| 1.0 - cosine * cosine);
                let k = ratio.map(1, |point, ratio, to| to[0] = 1.0 - ratio[0] * ratio[0] * squared_sine.at(point)[0]);
                steps.extend([
                    ("ratio * ratio", each(&ratio, |ratio| ratio * ratio)),
                    ("1.0 - dot(N, I) * dot(N, I)", squared_sine),
                    ("sqrt(k)", each(&k, f32::sqrt)),
                    ("k", k),
                ]);
            }
            self.push_steps(stage, steps);
        }
    }

    fn push_steps(&mut self, stage: Stage, steps: Vec<(&str, Values)>) {
        let space = self.space;
        self.quantities.extend(steps.into_iter().map(|(name, values)| {
            let name = name.to_owned();
            let space = if has_space(&name) { space } else { Default::default() };
            Quantity { name, stage, space, values, ..Quantity::default() }
        }));
    }
}
