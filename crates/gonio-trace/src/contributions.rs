//! Where the light of one pixel comes from.

use crate::lights::LightOrigin;
use crate::path::Recorder;
use crate::render::{TraceScene, TraceSettings};
use glam::{DVec3, Vec4};

/// The parts of a pixel's light, linear RGB. Their sum is `total`, but for rounding.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PixelContributions {
    /// Paths that were followed.
    pub samples: u32,
    /// The pixel of the picture.
    pub total: DVec3,
    /// The standard error of `total`, per channel; 0 with fewer than two paths.
    pub standard_error: DVec3,
    /// Light that no surface scattered: lamps and surfaces that shine, and the background.
    pub emitted: DVec3,
    /// Light that one surface scattered, by its source; in the order of lights, objects, environment, ambient term. Only
    /// sources that gave light.
    pub direct: Vec<(LightOrigin, DVec3)>,
    /// Light that two surfaces scattered.
    pub first_bounce: DVec3,
    /// Light that more surfaces scattered.
    pub rest: DVec3,
}

/// The light of one path, in its lanes.
#[derive(Default)]
struct PathParts {
    emitted: Vec4,
    direct: Vec<(LightOrigin, Vec4)>,
    first_bounce: Vec4,
    rest: Vec4,
}

impl Recorder for PathParts {
    fn add(&mut self, scatterings: u32, origin: LightOrigin, light: Vec4) {
        if light == Vec4::ZERO {
            return;
        }
        match scatterings {
            0 => self.emitted += light,
            1 => match self.direct.iter_mut().find(|(known, _)| *known == origin) {
                Some((_, sum)) => *sum += light,
                None => self.direct.push((origin, light)),
            },
            2 => self.first_bounce += light,
            _ => self.rest += light,
        }
    }
}

impl TraceScene {
    /// Follows the first `samples` paths of the pixel in column `x` and row `y` of the frame: those of the picture. `progress` is
    /// called with the share done, and returns whether to go on; the result is that of the paths so far.
    pub fn contributions(
        &self,
        settings: &TraceSettings,
        x: u32,
        y: u32,
        samples: u32,
        progress: &dyn Fn(f64) -> bool,
    ) -> PixelContributions {
        let mut sums = PixelContributions::default();
        let mut squares = DVec3::ZERO;
        for index in 0..samples {
            if !progress(f64::from(index) / f64::from(samples)) {
                break;
            }
            let posed = self.posed_for(settings, index);
            let summed = posed.summed(self.frame(), settings);
            let world = posed.world(self.frame(), settings, summed.as_deref());
            let mut parts = PathParts::default();
            let (light, _, wavelengths) = self.sample(&world, settings, x, y, index, &mut parts);
            sums.samples += 1;
            // As in a film, a path that is not finite counts as black.
            if !light.is_finite() {
                continue;
            }
            let rgb = |lanes: Vec4| world.materials.mode.rgb(lanes, &wavelengths).as_dvec3();
            let direct: Vec<(LightOrigin, DVec3)> =
                parts.direct.iter().map(|&(origin, lanes)| (origin, rgb(lanes))).collect();
            let (first_bounce, rest) = (rgb(parts.first_bounce), rgb(parts.rest));
            // A path that no surface scattered may have found the background.
            let scattered = !direct.is_empty() || parts.first_bounce != Vec4::ZERO || parts.rest != Vec4::ZERO;
            sums.emitted += if scattered { rgb(parts.emitted) } else { light };
            for (origin, light) in direct {
                match sums.direct.iter_mut().find(|(known, _)| *known == origin) {
                    Some((_, sum)) => *sum += light,
                    None => sums.direct.push((origin, light)),
                }
            }
            sums.first_bounce += first_bounce;
            sums.rest += rest;
            sums.total += light;
            squares += light * light;
        }
        let n = f64::from(sums.samples.max(1));
        for sum in [&mut sums.total, &mut sums.emitted, &mut sums.first_bounce, &mut sums.rest]
            .into_iter()
            .chain(sums.direct.iter_mut().map(|(_, sum)| sum))
        {
            *sum /= n;
        }
        if sums.samples > 1 {
            let variance = (squares / n - sums.total * sums.total).max(DVec3::ZERO);
            sums.standard_error = (variance / (n - 1.0)).map(f64::sqrt);
        }
        sums.direct.sort_by_key(|(origin, _)| match *origin {
            LightOrigin::Light(index) => (0, index),
            LightOrigin::Object(index) => (1, index),
            LightOrigin::Environment => (2, 0),
            LightOrigin::Ambient => (3, 0),
        });
        sums
    }
}
