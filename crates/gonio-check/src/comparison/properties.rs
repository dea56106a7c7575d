//! Self-consistency: properties of every light equation, tested with the student's program alone.

use super::compare::{PIXEL_TOLERANCE, channel_difference};
use super::parameterisation::Parameterisation;
use crate::roles::{Bindings, Role};
use crate::testbench::{Atlas, TestLight, TestScene, Testbench};
use crate::verdict::{Outcome, PropertyState, PropertyVerdict, Verdict};
use glam::{EulerRot, Quat};
use gonio_gl::GlError;
use gonio_language::tr;
use gonio_render::user_program::UserProgram;

/// Number of test scenes that are used: a stretched torus and a coarse sphere.
const TEST_SCENES: usize = 2;
/// The share of pixels that may differ, because of outlines: in a rotated world, matrices and their rounding errors
/// differ.
const MOST_BEYOND: f64 = 0.02;
/// Attenuations grow by this factor to leave no light but the ambient one.
const FAR: f32 = 1e9;

/// A student's program and its inputs.
pub struct Student<'a> {
    /// The testbench that draws it.
    pub testbench: &'a Testbench,
    /// The program.
    pub program: &'a UserProgram,
    /// The roles of its variables.
    pub bindings: &'a Bindings,
    /// Uniforms with values from `names.toml`.
    pub fixed: &'a [(String, Vec<f32>)],
    /// The parameterisation of the program.
    pub parameterisation: &'a Parameterisation,
}

/// The ids, and those of the sentences if the property holds and if it does not.
const WORDS: [(&str, &str, &str); 5] = [
    ("finite", "check-property-finite", "check-property-finite.violated"),
    ("unchanged-when-turned", "check-property-unchanged-when-turned", "check-property-unchanged-when-turned.violated"),
    ("linear-in-light", "check-property-linear-in-light", "check-property-linear-in-light.violated"),
    ("additive-over-lights", "check-property-additive-over-lights", "check-property-additive-over-lights.violated"),
    ("falls-with-distance", "check-property-falls-with-distance", "check-property-falls-with-distance.violated"),
];

impl Student<'_> {
    fn has(&self, is_match: impl Fn(Role) -> bool) -> bool {
        self.bindings.bound.iter().any(|bound| is_match(bound.role))
    }

    fn draw(&self, change: impl Fn(&mut TestScene)) -> Result<Atlas, GlError> {
        let inputs = self.testbench.inputs(self.program, self.bindings, |test_scene| {
            self.parameterisation.apply(test_scene);
            change(test_scene);
        });
        self.testbench.draw(self.program, &inputs, self.fixed, TEST_SCENES)
    }

    /// Tests all properties; `seen` is the program's picture in `test_scenes` test scenes.
    pub fn properties(&self, seen: &Atlas, test_scenes: usize) -> Result<Vec<PropertyVerdict>, GlError> {
        let finite = (0..test_scenes).filter(|&tile| {
            let is_number = |p: &[f32; 4]| p.iter().take(3).all(|c| c.is_finite());
            !seen.tile(tile).iter().filter(|p| Atlas::is_drawn(p)).all(is_number)
        });
        let found =
            [Some(finite.collect()), self.turned(seen)?, self.linear(seen)?, self.additive()?, self.attenuated(seen)?];
        let verdict = |((id, right, wrong), found): (&(&str, &'static str, &'static str), Option<Vec<usize>>)| {
            let (state, sentence) = match &found {
                None => (PropertyState::NotApplicable, right),
                Some(failing) if failing.is_empty() => (PropertyState::Right, right),
                Some(_) => (PropertyState::Wrong, wrong),
            };
            let name = |tile: usize| self.testbench.test_scenes().get(tile).map(|test_scene| test_scene.name.clone());
            let scenes = found.unwrap_or_default().into_iter().filter_map(name).collect();
            PropertyVerdict { id: (*id).to_owned(), sentence: tr!(sentence).to_owned(), state, scenes }
        };
        Ok(WORDS.iter().zip(found).map(verdict).collect())
    }

    fn turned(&self, seen: &Atlas) -> Result<Option<Vec<usize>>, GlError> {
        // A constant light does not move.
        if self.parameterisation.has_written_light() {
            return Ok(None);
        }
        let turn = Quat::from_euler(EulerRot::YXZ, 0.7, 0.5, 0.3);
        let turned = self.draw(|test_scene| *test_scene = test_scene.turned(turn))?;
        Ok(failing(seen, |tile, index, channel| turned.tile(tile)[index][channel]))
    }

    fn linear(&self, seen: &Atlas) -> Result<Option<Vec<usize>>, GlError> {
        let coloured = self.has(|role| matches!(role, Role::LightColor(_)));
        let strong = self.has(|role| (0..3).any(|term| role.scales(term)));
        if !coloured && !strong {
            return Ok(None);
        }
        let scaled = |factor: f32| {
            move |test_scene: &mut TestScene| {
                for light in std::iter::once(&mut test_scene.light).chain(&mut test_scene.other) {
                    if coloured {
                        light.brightness *= factor;
                    } else {
                        light.ambient *= factor;
                        light.diffuse *= factor;
                        light.specular *= factor;
                    }
                }
            }
        };
        let (half, none) = (self.draw(scaled(0.5))?, self.draw(scaled(0.0))?);
        Ok(failing(seen, |tile, index, channel| {
            let none = none.tile(tile)[index][channel];
            none + 2.0 * (half.tile(tile)[index][channel] - none)
        }))
    }

    fn additive(&self) -> Result<Option<Vec<usize>>, GlError> {
        if !self.parameterisation.dims_second() {
            return Ok(None);
        }
        let lit = |first: bool, second: bool| {
            self.draw(move |test_scene| {
                let place = test_scene.elsewhere();
                let other = TestLight { position: place, ambient: 0.05, ..test_scene.light };
                test_scene.other = Some(if second { other } else { other.dark() });
                test_scene.light = if first { test_scene.light } else { test_scene.light.dark() };
            })
        };
        let (both, first, second, none) = (lit(true, true)?, lit(true, false)?, lit(false, true)?, lit(false, false)?);
        Ok(failing(&both, |tile, index, channel| {
            let of = |atlas: &Atlas| atlas.tile(tile)[index][channel];
            of(&first) + of(&second) - of(&none)
        }))
    }

    fn attenuated(&self, seen: &Atlas) -> Result<Option<Vec<usize>>, GlError> {
        let all = [
            self.has(|role| matches!(role, Role::AttenuationConstant(_))),
            self.has(|role| matches!(role, Role::AttenuationLinear(_))),
            self.has(|role| matches!(role, Role::AttenuationQuadratic(_))),
        ];
        if !all.iter().all(|has| *has) {
            return Ok(None);
        }
        let scaled = |factor: f32| {
            move |test_scene: &mut TestScene| {
                for light in std::iter::once(&mut test_scene.light).chain(&mut test_scene.other) {
                    light.attenuation = light.attenuation.map(|constant| constant * factor);
                }
            }
        };
        let (twice, far) = (self.draw(scaled(2.0))?, self.draw(scaled(FAR))?);
        Ok(failing(seen, |tile, index, channel| {
            let far = far.tile(tile)[index][channel];
            far + 2.0 * (twice.tile(tile)[index][channel] - far)
        }))
    }
}

/// Returns the tiles in which a picture is not as expected. Overexposed pixels and NaN are ignored; `None` if there
/// are no others.
fn failing(seen: &Atlas, expected: impl Fn(usize, usize, usize) -> f32) -> Option<Vec<usize>> {
    let counted = |tile: usize| {
        let (mut all, mut beyond) = (0_usize, 0_usize);
        for (index, pixel) in seen.tile(tile).iter().enumerate() {
            let expected = [0, 1, 2].map(|channel| expected(tile, index, channel));
            let [r, g, b] = expected;
            let is_usable = |pixel: &[f32; 4]| {
                Atlas::is_drawn(pixel) && pixel.iter().take(3).all(|c| c.is_finite() && *c < 1.0 && *c > -1e3)
            };
            if is_usable(pixel) && is_usable(&[r, g, b, 1.0]) {
                all += 1;
                let channels = pixel.iter().zip(&expected);
                let difference = channels.map(|(a, b)| channel_difference(*a, *b)).fold(0.0, f32::max);
                beyond += usize::from(difference > PIXEL_TOLERANCE);
            }
        }
        (all, beyond)
    };
    let counts: Vec<(usize, usize)> = (0..TEST_SCENES).map(counted).collect();
    let fails = |tile: &usize| counts[*tile].1 as f64 > MOST_BEYOND * counts[*tile].0 as f64;
    counts.iter().any(|(all, _)| *all > 0).then(|| (0..TEST_SCENES).filter(fails).collect())
}

/// If no mistake is named, the summary reports the violated properties.
pub fn report_violations(verdict: &mut Verdict) {
    if verdict.verdict != Outcome::Wrong || !verdict.mistakes.is_empty() {
        return;
    }
    let wrong = verdict.properties.iter().filter(|property| property.state == PropertyState::Wrong);
    // NaN is already among the warnings.
    let sentences: Vec<&str> = wrong.filter(|p| p.id != "finite").map(|property| property.sentence.as_str()).collect();
    if !sentences.is_empty() {
        verdict.summary = format!("{}; {}", verdict.summary, sentences.join("; "));
    }
}
