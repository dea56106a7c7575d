//! The environment of a scene, ready to be looked up.

use glam::{DMat3, DQuat, DVec3};
use gonio_environment::{CubeMips, Cubemap, GlossyMips, Harmonics, SeparatedLights};
use std::sync::OnceLock;

/// An environment with its files read.
#[derive(Clone, Debug)]
pub struct LoadedEnvironment {
    /// The name that the user gave.
    pub name: String,
    /// The environment that is reflected and refracted, and that lights the objects.
    pub mips: CubeMips,
    /// The environment behind the objects, if it is a different one.
    pub background: Option<CubeMips>,
    /// Computed when first needed, which takes seconds; a mirror needs none of them.
    harmonics: OnceLock<Harmonics>,
    glossy: OnceLock<GlossyMips>,
    seen_glossy: OnceLock<GlossyMips>,
    separated: OnceLock<SeparatedLights>,
    preparation: Preparation,
}

/// How an environment is prepared. Functions, because a program that never makes an environment then does without their code: the
/// renderer of the web page's first picture is one.
#[derive(Clone, Copy, Debug)]
struct Preparation {
    harmonics: fn(&Cubemap) -> Harmonics,
    glossy: fn(&CubeMips, u32) -> GlossyMips,
    separated: fn(&CubeMips) -> SeparatedLights,
}

impl LoadedEnvironment {
    /// One environment for everything.
    pub fn new(name: impl Into<String>, map: Cubemap) -> Self {
        LoadedEnvironment {
            name: name.into(),
            mips: CubeMips::new(map),
            background: None,
            harmonics: OnceLock::new(),
            glossy: OnceLock::new(),
            seen_glossy: OnceLock::new(),
            separated: OnceLock::new(),
            preparation: Preparation {
                harmonics: Harmonics::from_cubemap,
                glossy: GlossyMips::new,
                separated: SeparatedLights::new,
            },
        }
    }

    /// Returns it with another environment behind the objects.
    pub fn with_background(mut self, map: Cubemap) -> Self {
        self.background = Some(CubeMips::new(map));
        self.seen_glossy = OnceLock::new();
        self
    }

    /// The environment behind the objects.
    pub fn seen(&self) -> &CubeMips {
        self.background.as_ref().unwrap_or(&self.mips)
    }

    /// The diffuse light of [`Self::mips`].
    pub fn harmonics(&self) -> &Harmonics {
        self.harmonics.get_or_init(|| (self.preparation.harmonics)(self.mips.full()))
    }

    /// [`Self::mips`] as rough mirrors show it.
    pub fn glossy(&self) -> &GlossyMips {
        self.glossy.get_or_init(|| self.blurred(&self.mips))
    }

    /// [`Self::mips`] in two parts, for sums over few directions.
    pub fn separated(&self) -> &SeparatedLights {
        self.separated.get_or_init(|| (self.preparation.separated)(&self.mips))
    }

    /// [`Self::seen`], blurred.
    pub fn seen_glossy(&self) -> &GlossyMips {
        match &self.background {
            Some(background) => self.seen_glossy.get_or_init(|| self.blurred(background)),
            None => self.glossy(),
        }
    }

    fn blurred(&self, mips: &CubeMips) -> GlossyMips {
        (self.preparation.glossy)(mips, GlossyMips::SIZE)
    }
}

/// The part of the environment in a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surroundings {
    /// Carries directions in the world to directions in the environment. A rotation.
    pub environment_from_world: DMat3,
    /// Its radiance is multiplied by this, in the background too.
    pub intensity: f64,
    /// Whether it lights the objects: diffuse light and glossy reflection.
    pub lights: bool,
    /// Whether it is seen behind the objects instead of the background.
    pub visible: bool,
    /// Blur of the background: 0 is sharp, 1 is what a surface of roughness 1 shows.
    pub blur: f64,
}

impl Default for Surroundings {
    fn default() -> Self {
        Surroundings {
            environment_from_world: DMat3::IDENTITY,
            intensity: 1.0,
            lights: false,
            visible: true,
            blur: 0.0,
        }
    }
}

/// Carries directions of an environment that is turned by yaw, pitch and roll (degrees) to the world: turned about Z
/// (roll), then about X (pitch), then about Y (yaw).
pub fn world_from_environment([yaw, pitch, roll]: [f64; 3]) -> DMat3 {
    let turn = |axis: DVec3, degrees: f64| DQuat::from_axis_angle(axis, degrees.to_radians());
    DMat3::from_quat(turn(DVec3::Y, yaw) * turn(DVec3::X, pitch) * turn(DVec3::Z, roll))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_turn_as_documented() {
        let ahead = |rotate| world_from_environment(rotate) * DVec3::NEG_Z;
        // Two functions of pi / 2.
        let near = |got: DVec3, expected: DVec3| assert!(got.abs_diff_eq(expected, 1e-15), "{got} is not {expected}");
        near(ahead([90.0, 0.0, 0.0]), DVec3::NEG_X);
        near(ahead([0.0, 90.0, 0.0]), DVec3::Y);
        near(ahead([0.0, 0.0, 90.0]), DVec3::NEG_Z);
        near(world_from_environment([0.0, 0.0, 90.0]) * DVec3::X, DVec3::Y);
        // Yaw is applied last: the raised direction is then turned to the left.
        near(ahead([90.0, 45.0, 0.0]), DVec3::new(-0.5_f64.sqrt(), 0.5_f64.sqrt(), 0.0));
    }
}
