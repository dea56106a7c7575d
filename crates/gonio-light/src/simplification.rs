//! The steps from the rendering equation to the light equation, each of which can be taken by itself.

named_enum! {
    /// A simplification of the rendering equation, in the order in which the lecture makes them. With all of them a picture is the
    /// light equation's.
    pub enum Simplification {
        /// Light is constant in time: the shutter is open for a moment only.
        Time = "time",
        /// Light has three channels, red, green and blue, instead of a spectrum.
        Wavelengths = "wavelengths",
        /// An object emits the same radiance everywhere: the mean of its emission texture.
        Emission = "emission",
        /// A material is a diffuse and a specular term: no mirror, no glass, no conservation of energy.
        Brdf = "brdf",
        /// Surfaces are lit by light sources only, not by other surfaces.
        Interreflection = "interreflection",
        /// Nothing blocks light.
        Shadows = "shadows",
        /// The specular term loses its cosine, as the scene's equation says.
        Cosine = "cosine",
        /// Light falls with 1/(kc + kl d + kq d^2) instead of the square of the distance.
        Attenuation = "attenuation",
        /// The integral over all directions becomes a sum over point lights.
        Sum = "sum",
        /// An ambient term is added.
        Ambient = "ambient",
    }
    default Time;
    what "simplification";
}

impl Simplification {
    /// The number and the title of its step in the lecture, whose fifth step makes two simplifications.
    pub const fn heading(self) -> (&'static str, &'static str) {
        match self {
            Simplification::Time => ("1", "Constant in time"),
            Simplification::Wavelengths => ("2", "No wavelengths"),
            Simplification::Emission => ("3", "Constant emission"),
            Simplification::Brdf => ("4", "BRDF = diffuse + specular"),
            Simplification::Interreflection => ("5a", "No light from other surfaces"),
            Simplification::Shadows => ("5b", "No shadows"),
            Simplification::Cosine => ("6", "No cosine in the specular term"),
            Simplification::Attenuation => ("7", "Attenuation with distance"),
            Simplification::Sum => ("8", "The integral becomes a sum"),
            Simplification::Ambient => ("9", "Too dark? Ambient light"),
        }
    }
}

/// A set of simplifications.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Simplifications(u16);

impl Simplifications {
    /// The rendering equation.
    pub const NONE: Simplifications = Simplifications(0);
    /// The light equation.
    pub const ALL: Simplifications = Simplifications((1 << Simplification::ALL.len()) - 1);

    /// The set with one more.
    #[must_use]
    pub const fn with(self, one: Simplification) -> Self {
        Simplifications(self.0 | 1 << one as u16)
    }

    /// The set without one.
    #[must_use]
    pub const fn without(self, one: Simplification) -> Self {
        Simplifications(self.0 & !(1 << one as u16))
    }

    /// Whether one is in the set.
    #[inline]
    pub const fn contains(self, one: Simplification) -> bool {
        self.0 & (1 << one as u16) != 0
    }

    /// All in order, up to and including `last`.
    pub const fn up_to(last: Simplification) -> Self {
        Simplifications((2 << last as u16) - 1)
    }

    /// The set as a number: bit `i` is the simplification at `i` in their order.
    pub const fn bits(self) -> u16 {
        self.0
    }

    /// The set of such a number. Further bits are ignored.
    pub const fn from_bits(bits: u16) -> Self {
        Simplifications(bits & Self::ALL.0)
    }

    /// Those of the set, in order.
    pub fn iter(self) -> impl Iterator<Item = Simplification> {
        Simplification::ALL.iter().copied().filter(move |&one| self.contains(one))
    }
}

impl FromIterator<Simplification> for Simplifications {
    fn from_iter<I: IntoIterator<Item = Simplification>>(all: I) -> Self {
        all.into_iter().fold(Simplifications::NONE, Simplifications::with)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sets_contain_what_they_are_made_of() {
        for (index, &one) in Simplification::ALL.iter().enumerate() {
            let up_to = Simplifications::up_to(one);
            assert_eq!(up_to.iter().count(), index + 1);
            assert!(up_to.contains(one) && !up_to.without(one).contains(one));
            assert_eq!(up_to.without(one).with(one), up_to);
            assert_eq!(up_to.iter().collect::<Simplifications>(), up_to);
            assert_eq!(Simplifications::from_bits(up_to.bits() | 0x8000), up_to);
        }
        assert_eq!(Simplifications::up_to(Simplification::Ambient), Simplifications::ALL);
        assert_eq!(Simplifications::NONE.iter().count(), 0);
    }
}
