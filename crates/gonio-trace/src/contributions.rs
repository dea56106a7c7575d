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

/// Paths of one pixel, followed a few at a time.
pub struct PixelPaths {
    pixel: [u32; 2],
    /// Sums, not means; without an error.
    sums: PixelContributions,
    squares: DVec3,
}

impl PixelPaths {
    /// No paths of the pixel in column `pixel[0]` and row `pixel[1]` of the frame.
    pub fn new(pixel: [u32; 2]) -> Self {
        PixelPaths { pixel, sums: PixelContributions::default(), squares: DVec3::ZERO }
    }

    /// Column and row.
    pub fn pixel(&self) -> [u32; 2] {
        self.pixel
    }

    /// The number of paths so far.
    pub fn samples(&self) -> u32 {
        self.sums.samples
    }

    /// Follows the next path of the pixel. Scene, settings, camera and size must be the same for all.
    pub fn follow(&mut self, scene: &TraceScene, settings: &TraceSettings) {
        let posed = scene.posed_for(settings, self.sums.samples);
        let summed = posed.summed(scene.frame(), settings);
        let world = posed.world(scene.frame(), settings, summed.as_deref());
        let mut parts = PathParts::default();
        let [x, y] = self.pixel;
        let (light, _, wavelengths) = scene.sample(&world, settings, x, y, self.sums.samples, &mut parts);
        let sums = &mut self.sums;
        sums.samples += 1;
        // As in a film, a path that is not finite counts as black.
        if !light.is_finite() {
            return;
        }
        let rgb = |lanes: Vec4| world.materials.mode.rgb(lanes, &wavelengths).as_dvec3();
        let direct: Vec<(LightOrigin, DVec3)> =
            parts.direct.iter().map(|&(origin, lanes)| (origin, rgb(lanes))).collect();
        // A path that no surface scattered may have found the background.
        let scattered = !direct.is_empty() || parts.first_bounce != Vec4::ZERO || parts.rest != Vec4::ZERO;
        sums.emitted += if scattered { rgb(parts.emitted) } else { light };
        for (origin, light) in direct {
            match sums.direct.iter_mut().find(|(known, _)| *known == origin) {
                Some((_, sum)) => *sum += light,
                None => sums.direct.push((origin, light)),
            }
        }
        sums.first_bounce += rgb(parts.first_bounce);
        sums.rest += rgb(parts.rest);
        sums.total += light;
        self.squares += light * light;
    }

    /// The means of all paths so far.
    pub fn contributions(&self) -> PixelContributions {
        let mut means = self.sums.clone();
        let n = f64::from(means.samples.max(1));
        for sum in [&mut means.total, &mut means.emitted, &mut means.first_bounce, &mut means.rest]
            .into_iter()
            .chain(means.direct.iter_mut().map(|(_, sum)| sum))
        {
            *sum /= n;
        }
        if means.samples > 1 {
            let variance = (self.squares / n - means.total * means.total).max(DVec3::ZERO);
            means.standard_error = (variance / (n - 1.0)).map(f64::sqrt);
        }
        means.direct.sort_by_key(|(origin, _)| match *origin {
            LightOrigin::Light(index) => (0, index),
            LightOrigin::Object(index) => (1, index),
            LightOrigin::Environment => (2, 0),
            LightOrigin::Ambient => (3, 0),
        });
        means
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
        let mut paths = PixelPaths::new([x, y]);
        while paths.samples() < samples && progress(f64::from(paths.samples()) / f64::from(samples)) {
            paths.follow(self, settings);
        }
        paths.contributions()
    }
}

impl PixelContributions {
    /// All of it as numbers, for a message between programs: the number of paths, and then five numbers for each part:
    /// what it is, an index, and its red, green and blue.
    ///
    /// | first | part | index |
    /// |---|---|---|
    /// | 0 | emitted | |
    /// | 1 | direct, of a light | of the light |
    /// | 2 | direct, of an object | of the object |
    /// | 3 | direct, of the environment | |
    /// | 4 | the ambient term | |
    /// | 5 | first bounce | |
    /// | 6 | the rest | |
    /// | 7 | the total | |
    /// | 8 | its standard error | |
    pub fn to_numbers(&self) -> Vec<f64> {
        let direct = self.direct.iter().map(|&(origin, light)| match origin {
            LightOrigin::Light(index) => (1, index, light),
            LightOrigin::Object(index) => (2, index, light),
            LightOrigin::Environment => (3, 0, light),
            LightOrigin::Ambient => (4, 0, light),
        });
        let after = [(5, self.first_bounce), (6, self.rest), (7, self.total), (8, self.standard_error)];
        let parts = std::iter::once((0, 0, self.emitted)).chain(direct).chain(after.map(|(part, v)| (part, 0, v)));
        let numbers = parts.flat_map(|(part, index, v)| [f64::from(part), index as f64, v.x, v.y, v.z]);
        std::iter::once(f64::from(self.samples)).chain(numbers).collect()
    }
}
