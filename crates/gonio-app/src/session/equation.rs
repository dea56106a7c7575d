//! State of the equation panel.

use gonio_language::tr;
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
    pub fn description(self) -> &'static str {
        tr!(match self {
            Term::Ambient => "window-a-ambient-light-the-same-from",
            Term::Emitted => "window-e-the-light-that-the-surface",
            Term::Environment => "window-light-from-the-environment-diffuse-and",
            Term::Diffuse => "window-diff-k-d-the-diffuse-term",
            Term::Specular => "window-k-s-spec-i-the-specular",
            Term::Light => "window-l-i-the-colour-of-light",
            Term::Attenuation => "window-att-i-attenuation-the-decrease-of",
            Term::Spot => "window-spot-i-the-soft-edge-of",
            Term::Cosine => "window-n-l-i-the-cosine-of",
        })
    }
}

impl fmt::Display for Term {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(gonio_language::name(self.name()))
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
