//! State of the equation panel.

use std::fmt;

/// A part of the light equation that can be pointed at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Term {
    /// `A`
    Ambient,
    /// `E`
    Emitted,
    /// Light of the environment.
    Environment,
    /// `diff`
    Diffuse,
    /// `spec_i`
    #[default]
    Specular,
    /// `L_i`
    Light,
    /// `att_i`
    Attenuation,
    /// `spot_i`
    Spot,
    /// `cos theta_i`
    Cosine,
}

impl Term {
    /// All terms, in the order of the equation.
    pub const ALL: [Term; 9] = [
        Term::Ambient,
        Term::Emitted,
        Term::Environment,
        Term::Diffuse,
        Term::Specular,
        Term::Light,
        Term::Attenuation,
        Term::Spot,
        Term::Cosine,
    ];

    /// The name in ids and announcements.
    pub const fn name(self) -> &'static str {
        match self {
            Term::Ambient => "ambient",
            Term::Emitted => "emitted",
            Term::Environment => "environment",
            Term::Diffuse => "diffuse",
            Term::Specular => "specular",
            Term::Light => "light",
            Term::Attenuation => "attenuation",
            Term::Spot => "spot",
            Term::Cosine => "cosine",
        }
    }

    /// A description in one sentence.
    pub const fn description(self) -> &'static str {
        match self {
            Term::Ambient => "A, ambient light: the same from every direction, never attenuated",
            Term::Emitted => "E, the light that the surface emits",
            Term::Environment => "Light from the environment: diffuse and glossy reflection",
            Term::Diffuse => "diff k_d, the diffuse term: the same in every viewing direction",
            Term::Specular => "k_s spec_i, the specular term: the highlight",
            Term::Light => "L_i, the colour of light i times its intensity",
            Term::Attenuation => "att_i, attenuation: the decrease of light with distance",
            Term::Spot => "spot_i, the soft edge of a spot light's cone",
            Term::Cosine => "<N.L_i>, the cosine of the angle between normal and light direction, at least 0",
        }
    }
}

impl fmt::Display for Term {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// State of the equation panel.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EquationView {
    /// The term whose parameters are shown.
    pub selected: Term,
    /// Whether all definitions are shown.
    pub open: bool,
    /// The switches before a term was shown alone.
    pub before_alone: Option<BeforeAlone>,
}

/// The switches before a term was shown alone.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BeforeAlone {
    /// The other summands, and whether each was on.
    pub terms: Vec<(Term, bool)>,
    /// Indices of the lights that were switched off.
    pub lights: Vec<usize>,
}
