//! Which source to sample at a place: one whose light is likely to be strong there.
//!
//! A lamp in a corner may give a thousandth of all light, and all of the light near it. Chosen by its power it would be found by
//! one path in a thousand, a thousand times too bright. So sources are chosen by an estimate of the irradiance that
//! they give to the place without shadows (P. Shirley, C. Wang and K. Zimmerman, *Monte Carlo Techniques for Direct
//! Lighting Calculations*, 1996). All triangles of an object count as one source, in which they are chosen by their power.

use crate::geometry::Place;
use crate::lamps::{Cone, Falloff, LightRules};
use crate::sampling::Discrete;
use glam::Vec3;

/// Where sources are chosen.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Vantage {
    pub position: Vec3,
    /// Unit: light from behind it does not count. Zero where light from everywhere counts.
    normal: Vec3,
}

impl Vantage {
    /// The eye, or a place that is lit from both sides.
    pub fn open(position: Vec3) -> Self {
        Vantage { position, normal: Vec3::ZERO }
    }

    /// A place on a surface that is lit on the side of `view`.
    #[inline]
    pub fn of(place: &Place, view: Vec3) -> Self {
        let normal = place.geometric_normal;
        Vantage { position: place.position, normal: normal * 1.0_f32.copysign(normal.dot(view)) }
    }

    /// The largest cosine of directions within the cone around `direction` whose half angle has this sine; 1 without a normal.
    #[inline]
    fn largest_cos(&self, direction: Vec3, sin_cone: f32) -> f32 {
        if self.normal == Vec3::ZERO {
            return 1.0;
        }
        let cos = self.normal.dot(direction).clamp(-1.0, 1.0);
        let cos_cone = (1.0 - sin_cone * sin_cone).max(0.0).sqrt();
        if sin_cone >= 1.0 || cos >= cos_cone {
            return 1.0;
        }
        (cos * cos_cone + (1.0 - cos * cos).sqrt() * sin_cone).max(0.0)
    }
}

/// Where the light of a group of sources comes from.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Reach {
    /// From a ball, trace space: `intensity` is the mean over all directions.
    Ball {
        center: Vec3,
        radius: f32,
        intensity: f32,
        cone: Option<Cone>,
        /// The way in which it shines, unit; light goes to this side only. Zero for all sides.
        front: Vec3,
        falloff: Option<Falloff>,
    },
    /// From one direction, unit, to the light.
    Directional { direction: Vec3, irradiance: f32 },
    /// From everywhere: an environment.
    Everywhere { irradiance: f32 },
}

impl Reach {
    /// The estimate of the irradiance at a place; 0 only where no light can arrive.
    #[inline]
    fn importance(&self, vantage: &Vantage, rules: &LightRules) -> f32 {
        match self {
            Reach::Ball { center, radius, intensity, cone, front, falloff } => {
                let way = *center - vantage.position;
                let distance = way.length().max(LEAST_DISTANCE);
                let direction = way / distance;
                let sin_cone = radius / distance;
                let mut light = intensity / distance.max(*radius).powi(2) * vantage.largest_cos(direction, sin_cone);
                if let Some(cone) = cone.filter(|_| rules.has_cones && *radius == 0.0) {
                    light *= cone.at(-direction);
                }
                if *front != Vec3::ZERO {
                    light *= (sin_cone - front.dot(direction)).clamp(0.0, 1.0);
                }
                if let Some(falloff) = falloff.filter(|_| rules.attenuation) {
                    light *= falloff.gain(rules, distance).max(f32::MIN_POSITIVE);
                }
                light
            }
            Reach::Directional { direction, irradiance } => irradiance * vantage.largest_cos(*direction, 0.0),
            Reach::Everywhere { irradiance } => *irradiance,
        }
        // Sums of a few stay finite.
        .min(1e30)
    }
}

/// In trace space: nearer lights are not stronger.
const LEAST_DISTANCE: f32 = 1e-6;

/// Sources that follow each other, and are chosen as one.
#[derive(Clone, Debug)]
pub(crate) struct SourceGroup {
    /// The index of the first source.
    pub first: usize,
    /// The power of each source.
    pub powers: Vec<f64>,
    pub reach: Reach,
}

/// How a source is chosen.
#[derive(Debug, Default)]
pub(crate) struct SourceChoice {
    groups: Vec<(usize, Discrete, Reach)>,
    /// The group of each source.
    group_of: Vec<u32>,
    /// All sources by their power, where there are more than [`MOST_GROUPS`].
    by_power: Option<Discrete>,
}

/// Of more groups the estimates would cost more than the rays that they save.
const MOST_GROUPS: usize = 16;

impl SourceChoice {
    /// `groups`: of all sources, in their order.
    pub fn new(groups: Vec<SourceGroup>) -> Self {
        if groups.len() > MOST_GROUPS {
            let powers = groups.into_iter().flat_map(|group| group.powers);
            return SourceChoice { by_power: Some(Discrete::new(powers)), ..SourceChoice::default() };
        }
        let mut choice = SourceChoice::default();
        for (index, SourceGroup { first, powers, reach }) in groups.into_iter().enumerate() {
            choice.group_of.extend(powers.iter().map(|_| index as u32));
            choice.groups.push((first, Discrete::new(powers), reach));
        }
        choice
    }

    /// A source at `u` in `[0, 1)`, and its probability; none where no light can arrive.
    #[inline]
    pub fn sample(&self, vantage: &Vantage, rules: &LightRules, u: f32) -> Option<(usize, f32)> {
        if let Some(all) = &self.by_power {
            let (index, probability, _) = all.sample(u)?;
            return Some((index, probability));
        }
        if let [(first, sources, _)] = self.groups.as_slice() {
            let (index, probability, _) = sources.sample(u)?;
            return Some((first + index, probability));
        }
        self.sample_groups(vantage, rules, u)
    }

    #[inline(never)]
    fn sample_groups(&self, vantage: &Vantage, rules: &LightRules, u: f32) -> Option<(usize, f32)> {
        let (weights, total) = self.weights(vantage, rules);
        let last = weights.iter().rposition(|&weight| weight > 0.0)?;
        let mut at = u * total;
        let mut chosen = 0;
        while chosen < last && at >= weights[chosen] {
            at -= weights[chosen];
            chosen += 1;
        }
        let (first, sources, _) = self.groups.get(chosen)?;
        let (index, probability, _) = sources.sample((at / weights[chosen]).clamp(0.0, 1.0 - f32::EPSILON))?;
        Some((first + index, probability * (weights[chosen] / total)))
    }

    /// The probability with which [`Self::sample`] finds a source.
    #[inline]
    pub fn probability(&self, source: usize, vantage: &Vantage, rules: &LightRules) -> f32 {
        if let Some(all) = &self.by_power {
            return all.probability(source);
        }
        let Some((first, sources, _)) = self.group_of.get(source).and_then(|&group| self.groups.get(group as usize))
        else {
            return 0.0;
        };
        let inside = sources.probability(source - first);
        if self.groups.len() == 1 {
            return inside;
        }
        let (weights, total) = self.weights(vantage, rules);
        if total > 0.0 { inside * (weights[self.group_of[source] as usize] / total) } else { 0.0 }
    }

    #[inline]
    fn weights(&self, vantage: &Vantage, rules: &LightRules) -> ([f32; MOST_GROUPS], f32) {
        let mut weights = [0.0; MOST_GROUPS];
        for (weight, (_, _, reach)) in weights.iter_mut().zip(&self.groups) {
            *weight = reach.importance(vantage, rules);
        }
        (weights, weights.iter().sum())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RULES: LightRules = LightRules { attenuation: false, attenuates: true, has_cones: true, scale: 1.0 };

    fn ball(center: Vec3, radius: f32, intensity: f32) -> Reach {
        Reach::Ball { center, radius, intensity, cone: None, front: Vec3::ZERO, falloff: None }
    }

    /// A sun from above, a weak lamp of four triangles near the origin, a rectangle that shines upwards, and a sky.
    fn choice() -> SourceChoice {
        let lamp = Reach::Ball {
            center: Vec3::new(0.0, -1.0, 0.0),
            radius: 0.1,
            intensity: 0.5,
            cone: None,
            front: Vec3::Y,
            falloff: None,
        };
        let one = |first, reach| SourceGroup { first, powers: vec![1.0], reach };
        SourceChoice::new(vec![
            one(0, Reach::Directional { direction: Vec3::Y, irradiance: 3.0 }),
            SourceGroup {
                first: 1,
                powers: vec![1.0, 2.0, 3.0, 0.0],
                reach: ball(Vec3::new(0.2, 0.1, 0.0), 0.02, 0.01),
            },
            one(5, lamp),
            one(6, Reach::Everywhere { irradiance: 0.2 }),
        ])
    }

    fn vantages() -> Vec<Vantage> {
        let at = |position, normal: Vec3| Vantage { position, normal: normal.normalize_or_zero() };
        vec![
            at(Vec3::ZERO, Vec3::Y),
            at(Vec3::ZERO, Vec3::NEG_Y),
            at(Vec3::new(0.17, 0.1, 0.0), Vec3::new(-0.3, 1.0, 0.0)),
            at(Vec3::new(0.2, 0.1, 0.0), Vec3::NEG_X),
            at(Vec3::new(-5.0, -2.0, 1.0), Vec3::ZERO),
        ]
    }

    #[test]
    fn sources_are_found_as_often_as_their_probability_says() {
        let choice = choice();
        for vantage in vantages() {
            let mut found = [0.0_f32; 7];
            let count = 20_000;
            for i in 0..count {
                let u = (i as f32 + 0.5) / count as f32;
                let (source, probability) =
                    choice.sample(&vantage, &RULES, u).expect("the sky is seen from everywhere");
                assert!((probability - choice.probability(source, &vantage, &RULES)).abs() < 1e-6);
                found[source] += 1.0 / count as f32;
            }
            for (source, share) in found.into_iter().enumerate() {
                let probability = choice.probability(source, &vantage, &RULES);
                assert!((share - probability).abs() < 2e-4, "{vantage:?}: {source} {share} instead of {probability}");
            }
        }
    }

    /// Only what cannot shine on a place is never chosen there.
    #[test]
    fn only_sources_behind_the_place_or_turned_away_are_left_out() {
        let choice = choice();
        let chosen = |vantage: &Vantage| [0, 1, 5, 6].map(|source| choice.probability(source, vantage, &RULES) > 0.0);
        let [up, down, near, inside, below] = vantages().try_into().expect("five");
        assert_eq!(chosen(&up), [true, true, false, true], "the rectangle is behind");
        assert_eq!(chosen(&down), [false, false, true, true], "the sun and the lamp are behind");
        assert_eq!(chosen(&near), [true, true, false, true], "the lamp reaches over the horizon");
        assert_eq!(chosen(&inside), [false, true, true, true], "inside of the lamp");
        assert_eq!(chosen(&below), [true, true, false, true], "the rectangle shines upwards");
    }

    /// A lamp with a thousandth of the light is sampled where it is near.
    #[test]
    fn near_lamps_are_preferred() {
        let strong = ball(Vec3::new(0.0, 10.0, 0.0), 0.0, 1000.0);
        let weak = ball(Vec3::new(0.0, 0.1, 0.0), 0.0, 1.0);
        let groups = [strong, weak].into_iter().enumerate();
        let groups = groups.map(|(first, reach)| SourceGroup { first, powers: vec![1.0], reach }).collect();
        let choice = SourceChoice::new(groups);
        let vantage = Vantage { position: Vec3::ZERO, normal: Vec3::Y };
        // 1 / 0.1^2 against 1000 / 10^2.
        let probability = choice.probability(1, &vantage, &RULES);
        assert!((probability - 100.0 / 110.0).abs() < 1e-5, "{probability}");
    }

    #[test]
    fn many_sources_are_chosen_by_power() {
        let one = |first| SourceGroup { first, powers: vec![1.0 + first as f64], reach: ball(Vec3::ZERO, 1.0, 1.0) };
        let choice = SourceChoice::new((0..40).map(one).collect());
        let vantage = Vantage::open(Vec3::ZERO);
        let sum: f32 = (0..40).map(|source| choice.probability(source, &vantage, &RULES)).sum();
        assert!((sum - 1.0).abs() < 1e-5, "{sum}");
        assert!((choice.probability(39, &vantage, &RULES) - 40.0 / 820.0).abs() < 1e-6);
    }
}
