//! A picture of a station that begins coarse and becomes finer.

use crate::station::ImagePlane;
use glam::{DVec2, DVec3};
use gonio_image::Image;
use gonio_trace::Sampler;
use rayon::prelude::*;

/// Most pixels of the first stage.
const FIRST_PIXELS: u64 = 4096;

/// A picture so far: squares of pixels that are halved until they are pixels, then further samples of each pixel.
///
/// The same seed gives the same picture on any number of threads.
pub struct PictureRefinement {
    plane: Box<dyn ImagePlane>,
    size: [u32; 2],
    seed: u64,
    /// Side of the squares of this stage in pixels, a power of two.
    side: u32,
    /// Sums of the samples of this stage.
    sums: Vec<DVec3>,
    /// Rows of this pass that are complete, and complete passes before it.
    rows: u32,
    passes: u32,
    /// The sums of the stage before, and their side.
    coarser: Option<(Vec<DVec3>, u32)>,
}

impl PictureRefinement {
    /// A picture that begins with large squares: something is visible soon.
    pub fn new(plane: Box<dyn ImagePlane>, size: [u32; 2], seed: u64) -> Self {
        let size = size.map(|side| side.max(1));
        let pixels = u64::from(size[0]) * u64::from(size[1]);
        let side = (0..16).map(|power| 1_u32 << power).find(|&side| pixels / u64::from(side).pow(2) <= FIRST_PIXELS);
        let mut started = Self { plane, size, seed, side: 1, sums: Vec::new(), rows: 0, passes: 0, coarser: None };
        started.begin_stage(side.unwrap_or(1 << 15));
        started
    }

    /// A picture without the coarse stages, for files.
    pub fn of_pixels(plane: Box<dyn ImagePlane>, size: [u32; 2], seed: u64) -> Self {
        let mut started = Self::new(plane, size, seed);
        started.begin_stage(1);
        started
    }

    fn stage_size(&self) -> [u32; 2] {
        self.size.map(|pixels| pixels.div_ceil(self.side))
    }

    fn begin_stage(&mut self, side: u32) {
        self.side = side;
        let [width, height] = self.stage_size();
        self.sums = vec![DVec3::ZERO; width as usize * height as usize];
        (self.rows, self.passes) = (0, 0);
    }

    /// Samples of each pixel that are complete; 0 during the coarse stages.
    pub fn samples(&self) -> u32 {
        if self.side == 1 { self.passes } else { 0 }
    }

    /// The share of the current pass that is complete.
    pub fn pass(&self) -> f64 {
        f64::from(self.rows) / f64::from(self.stage_size()[1])
    }

    /// Whether every place of the picture has a sample.
    pub fn is_covered(&self) -> bool {
        self.coarser.is_some() || self.passes > 0
    }

    /// Computes the next rows of this pass, at most `rows` of them. `go_on` is asked before each row, from any thread; where it
    /// returns false, nothing has changed and false is returned.
    pub fn advance(&mut self, rows: u32, go_on: &(dyn Fn() -> bool + Sync)) -> bool {
        let [width, height] = self.stage_size();
        let next = self.rows.saturating_add(rows.max(1)).min(height);
        let row_of =
            |y: u32| -> Option<Vec<DVec3>> { go_on().then(|| (0..width).map(|x| self.sample(x, y, width)).collect()) };
        let found: Option<Vec<Vec<DVec3>>> = (self.rows..next).into_par_iter().map(row_of).collect();
        let Some(found) = found else { return false };
        let start = self.rows as usize * width as usize;
        for (sum, light) in self.sums[start..].iter_mut().zip(found.into_iter().flatten()) {
            *sum += light;
        }
        self.rows = next;
        if self.rows == height {
            self.end_pass();
        }
        true
    }

    fn end_pass(&mut self) {
        (self.rows, self.passes) = (0, self.passes + 1);
        if self.side > 1 {
            self.coarser = Some((std::mem::take(&mut self.sums), self.side));
            self.begin_stage(self.side / 2);
        } else {
            self.coarser = None;
        }
    }

    /// Computes whole passes until each pixel has `samples`. `go_on` gets the share that is complete; where it returns
    /// false, the picture stays as it is and false is returned.
    pub fn complete(&mut self, samples: u32, go_on: &(dyn Fn(f64) -> bool + Sync)) -> bool {
        while self.samples() < samples {
            let share = (f64::from(self.samples()) + self.pass()) / f64::from(samples);
            if !self.advance(32, &|| go_on(share)) {
                return false;
            }
        }
        true
    }

    /// A sample of a square of this stage.
    fn sample(&self, x: u32, y: u32, width: u32) -> DVec3 {
        let mut sampler = Sampler::new(self.seed, y * width + x, self.passes);
        let within = sampler.next_2d().as_dvec2();
        let pixel = (DVec2::new(x.into(), y.into()) + within) * f64::from(self.side);
        let [wide, high] = self.size.map(f64::from);
        let at = (pixel - 0.5 * DVec2::new(wide, high)) * (2.0 / high);
        let light = self.plane.light(DVec2::new(at.x, -at.y), &mut sampler);
        if light.is_finite() { light } else { DVec3::ZERO }
    }

    /// The picture in its full size, in linear light. Places without a sample are black.
    pub fn picture(&self) -> Image {
        let [width, height] = self.size;
        let mut image = Image::new(width, height, [0.0, 0.0, 0.0, 1.0]);
        for (index, pixel) in image.pixels.iter_mut().enumerate() {
            let (x, y) = (index as u32 % width, index as u32 / width);
            let is_new = y / self.side < self.rows;
            let (sums, side, count) = match &self.coarser {
                Some((sums, side)) if !is_new => (sums, *side, 1),
                _ => (&self.sums, self.side, self.passes + u32::from(is_new)),
            };
            let place = (y / side) as usize * width.div_ceil(side) as usize + (x / side) as usize;
            let mean = sums[place].max(DVec3::ZERO) / f64::from(count.max(1));
            let [r, g, b] = mean.as_vec3().to_array();
            *pixel = [r, g, b, 1.0];
        }
        image
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ramp along x and y.
    struct Ramp;

    impl ImagePlane for Ramp {
        fn light(&self, at: DVec2, _: &mut Sampler) -> DVec3 {
            DVec3::new(at.x + 3.0, at.y + 1.0, 0.25)
        }
    }

    #[test]
    fn a_picture_is_covered_early_and_ends_as_that_of_its_pixels() {
        let size = [200, 90];
        let mut coarse = PictureRefinement::new(Box::new(Ramp), size, 3);
        let mut stages = 0;
        while coarse.samples() < 4 {
            let is_covered = coarse.is_covered();
            assert!(coarse.advance(7, &|| true));
            if is_covered {
                assert!(coarse.picture().pixels.iter().all(|p| p[0] > 0.5 && p[2] == 0.25), "a place has no sample");
                stages += 1;
            }
        }
        assert!(stages > 20, "{stages}");
        let mut plain = PictureRefinement::of_pixels(Box::new(Ramp), size, 3);
        assert!(plain.complete(4, &|_| true));
        assert_eq!(coarse.picture(), plain.picture());
        // The centre of the plane is the centre of the picture; rows run downwards.
        let (left, top) = (plain.picture().at(0, 45), plain.picture().at(100, 0));
        assert!((left[0] - (3.0 - 20.0 / 9.0)).abs() < 0.02 && (top[1] - 2.0).abs() < 0.03, "{left:?} {top:?}");
    }

    #[test]
    fn it_stops_where_it_is_told() {
        let mut picture = PictureRefinement::of_pixels(Box::new(Ramp), [40, 30], 0);
        assert!(picture.complete(1, &|_| true));
        let before = picture.picture();
        assert!(!picture.advance(3, &|| false) && !picture.complete(2, &|share| share < 0.5));
        assert_eq!((picture.picture(), picture.samples()), (before, 1));
    }
}
