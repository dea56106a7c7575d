//! A picture that begins coarse and becomes finer, for windows: something is visible soon, and work stops soon.
//!
//! The first stage has up to three thousand large pixels, and each further stage has four times as many, until a pixel of the
//! picture has one path. Then paths are added, to all pixels first and later only to the tiles that need them.

use crate::contributions::PixelPaths;
use crate::film::{Film, TileMask};
use crate::render::{TraceScene, TraceSettings};
use gonio_scene::{Camera, Picture};

/// Most pixels of the first stage: with its samples 50 ms on one core, also where paths are long.
const FIRST_PIXELS: u64 = 3072;
/// Samples of the first stage, whose large pixels would otherwise show the noise most.
const FIRST_SAMPLES: u32 = 4;
/// Most samples that a pass adds to a pixel.
const MOST_SAMPLES: u32 = 16;
/// From this number of samples, the error of a tile is known well enough to leave finished ones out.
const TRUSTED: u32 = 16;
/// Paths that are followed through a pixel that is looked at closely, and how many of them at once.
const PIXEL_PATHS: u32 = 4096;
const PIXEL_PATHS_AT_ONCE: u32 = 256;

/// What has been traced so far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RefinementStatus {
    /// Paths per pixel of the picture, in the mean; below 1 while pixels are large.
    pub paths: f64,
    /// Root of the mean square error of a pixel's luminance, relative to the picture's mean; `None` with fewer than two paths
    /// per pixel.
    pub error: Option<f64>,
    /// The share of the current pass that is done, 0 to 1.
    pub pass: f64,
    /// Whether the error is below the goal, with a probability of 95 %.
    pub done: bool,
}

/// A scene, and its picture so far.
pub struct Refinement {
    scene: TraceScene,
    settings: TraceSettings,
    goal: f64,
    camera: Camera,
    size: [u32; 2],
    /// Side of a square of this stage, pixels of the picture: a power of two.
    side: u32,
    film: Film,
    /// Rows of the film that have this pass's samples, and the number of samples.
    rows: u32,
    samples: u32,
    /// The tiles that get them; `None` for all.
    tiles: Option<TileMask>,
    /// The picture of the last stage and its `side`.
    coarser: Option<(Picture, u32)>,
    error: Option<f64>,
    done: bool,
    pixel: Option<PixelPaths>,
}

impl Refinement {
    /// Starts the picture of the scene's frame. It is done when its error, relative to its mean luminance, is below `goal`.
    pub fn new(scene: TraceScene, settings: TraceSettings, goal: f64) -> Self {
        let frame = scene.frame();
        let (camera, size) = (frame.camera, [frame.width.max(1), frame.height.max(1)]);
        let film = Film::new(1, 1);
        let mut started = Refinement {
            scene,
            settings,
            goal,
            camera,
            size,
            side: 1,
            film,
            rows: 0,
            samples: FIRST_SAMPLES,
            tiles: None,
            coarser: None,
            error: None,
            done: false,
            pixel: None,
        };
        started.restart(camera, size);
        started
    }

    /// Starts again with another camera or in another size, in pixels. The scene is not built again.
    pub fn restart(&mut self, camera: Camera, size: [u32; 2]) {
        (self.camera, self.size) = (camera, size.map(|side| side.max(1)));
        let pixels = u64::from(self.size[0]) * u64::from(self.size[1]);
        let side = (0..16).map(|power| 1_u32 << power).find(|&side| pixels / u64::from(side).pow(2) <= FIRST_PIXELS);
        (self.coarser, self.error, self.done, self.pixel) = (None, None, false, None);
        self.begin_stage(side.unwrap_or(1 << 15));
        self.samples = FIRST_SAMPLES;
    }

    fn begin_stage(&mut self, side: u32) {
        self.side = side;
        let [width, height] = self.size.map(|pixels| pixels.div_ceil(side));
        self.scene.look(self.camera, width, height);
        self.film = Film::new(width, height);
        (self.rows, self.samples, self.tiles) = (0, 1, None);
    }

    /// Traces the next `rows` rows of this pass, or as many as it has left. `go_on` is asked now and then, from any thread;
    /// where it says no, nothing has changed and `false` is returned.
    pub fn advance(&mut self, rows: u32, go_on: &(dyn Fn() -> bool + Sync)) -> bool {
        if self.done {
            return true;
        }
        let next = self.rows.saturating_add(rows.max(1)).min(self.film.height);
        let (range, tiles) = (self.rows..next, self.tiles.as_ref());
        if !self.scene.add_to_rows(&mut self.film, &self.settings, self.samples, range, tiles, &|_| go_on()) {
            return false;
        }
        self.rows = next;
        if self.rows == self.film.height {
            self.end_pass();
        }
        true
    }

    fn end_pass(&mut self) {
        if self.side > 1 {
            self.coarser = Some((self.film.picture(), self.side));
            self.begin_stage(self.side / 2);
            return;
        }
        self.coarser = None;
        let least = self.film.least_samples();
        if least >= 2 {
            let error = self.film.error();
            self.error = Some(error.relative);
            self.done = error.upper <= self.goal;
            self.tiles = (least >= TRUSTED).then(|| self.film.unfinished(self.goal));
        }
        self.rows = 0;
        self.samples = least.clamp(1, MOST_SAMPLES);
    }

    /// Follows the next paths through the pixel in column `pixel[0]` and row `pixel[1]` of the picture, which becomes no finer by
    /// it. Returns their sum once there are more of them. `go_on` is asked after each path; where it says no, the rest of them is left
    /// for the next call.
    pub fn probe(&mut self, pixel: [u32; 2], go_on: &dyn Fn() -> bool) -> Option<&PixelPaths> {
        let [width, height] = self.size;
        if pixel[0] >= width || pixel[1] >= height {
            return None;
        }
        let mut paths = self.pixel.take().filter(|paths| paths.pixel() == pixel).unwrap_or(PixelPaths::new(pixel));
        let before = paths.samples();
        let wanted = (before + PIXEL_PATHS_AT_ONCE).min(PIXEL_PATHS);
        self.scene.look(self.camera, width, height);
        while paths.samples() < wanted && go_on() {
            paths.follow(&self.scene, &self.settings);
        }
        // The picture's stage may have larger pixels.
        self.scene.look(self.camera, self.film.width, self.film.height);
        let kept = self.pixel.insert(paths);
        (kept.samples() > before).then_some(kept)
    }

    /// Whether every place of the picture has a path: the first stage is complete.
    pub fn is_covered(&self) -> bool {
        self.coarser.is_some() || (self.side == 1 && self.film.least_samples() > 0)
    }

    /// Rows of the film that a pass has; [`Self::advance`] counts in them.
    pub fn rows(&self) -> u32 {
        self.film.height
    }

    /// What has been traced so far.
    pub fn status(&self) -> RefinementStatus {
        let pixels = f64::from(self.size[0]) * f64::from(self.size[1]);
        let coarser = |(picture, _): &(Picture, u32)| picture.pixels.len() as f64;
        let before = self.coarser.as_ref().map_or(0.0, coarser);
        RefinementStatus {
            paths: (self.film.total_samples() as f64).max(before) / pixels,
            error: self.error,
            pass: f64::from(self.rows) / f64::from(self.film.height.max(1)),
            done: self.done,
        }
    }

    /// The picture in its full size: linear, premultiplied. Large pixels are squares; places without any path are black
    /// and transparent.
    pub fn picture(&self) -> Picture {
        let [width, height] = self.size;
        let now = self.film.picture();
        let complete = self.side == 1 && self.film.least_samples() > 0;
        if complete {
            return now;
        }
        let mut pixels = Vec::with_capacity(now.pixels.len());
        for y in 0..height {
            let (from, side) = match &self.coarser {
                Some((coarser, side)) if y / self.side >= self.rows => (coarser, *side),
                _ => (&now, self.side),
            };
            let row = (y / side * from.width) as usize;
            pixels.extend((0..width).map(|x| from.pixels.get(row + (x / side) as usize).copied().unwrap_or_default()));
        }
        Picture { width, height, pixels }
    }

    /// The scene, to be used again.
    pub fn into_scene(self) -> TraceScene {
        self.scene
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio_scene::files::BuiltinOnly;
    use gonio_scene::{Frame, load};
    use std::path::Path;

    fn refinement(size: [u32; 2], goal: f64) -> Refinement {
        let described = load::describe(&["builtin:cube"], &BuiltinOnly).unwrap_or_else(|error| panic!("{error}"));
        let scene = load::load(described, Path::new(""), &BuiltinOnly).unwrap_or_else(|error| panic!("{error}"));
        let frame = Frame { width: size[0], height: size[1], ..scene.frame(0.0) };
        Refinement::new(TraceScene::new(&scene, &frame), TraceSettings::default(), goal)
    }

    /// The whole picture is covered after the first stage, each stage is finer, and the last is the film of plain samples.
    #[test]
    fn stages_become_finer_until_the_picture_is_the_plain_one() {
        let size = [250, 130];
        let mut refined = refinement(size, 0.0);
        let mut sides = vec![refined.side];
        while refined.side > 1 || refined.film.least_samples() < 2 {
            assert!(refined.advance(7, &|| true));
            if refined.side != sides[sides.len() - 1] {
                sides.push(refined.side);
                let picture = refined.picture();
                assert_eq!([picture.width, picture.height], size);
                assert!(picture.pixels.iter().all(|pixel| pixel[3] > 0.0), "a place has no path");
            }
        }
        assert_eq!(sides, [4, 2, 1]);
        let status = refined.status();
        assert!(status.paths == 2.0 && status.error.is_some_and(|error| error > 0.0) && !status.done, "{status:?}");
        let picture = refined.picture();
        let scene = refined.into_scene();
        let mut plain = Film::new(size[0], size[1]);
        assert!(scene.add_samples(&mut plain, &TraceSettings::default(), 2, None, &|_| true));
        assert_eq!(picture.pixels, plain.picture().pixels);
    }

    /// The same numbers as those of the scene itself, at any stage, and the picture stays as it was.
    #[test]
    fn a_pixel_is_looked_at_closely_at_every_stage() {
        let size = [250, 130];
        let mut refined = refinement(size, 0.0);
        let plain = refinement(size, 0.0);
        let mut scene = plain.into_scene();
        let camera = scene.frame().camera;
        scene.look(camera, size[0], size[1]);
        let expected = |x, y| scene.contributions(&TraceSettings::default(), x, y, 512, &|_| true);
        for stage in [4, 2, 1] {
            while refined.side > stage {
                assert!(refined.advance(16, &|| true));
            }
            let picture = refined.picture();
            let pixel = [120, 60 + stage];
            assert!(refined.probe(pixel, &|| false).is_none(), "no path was followed");
            assert_eq!(refined.probe(pixel, &|| true).map(PixelPaths::samples), Some(256));
            let found = refined.probe(pixel, &|| true).map(PixelPaths::contributions);
            assert_eq!(found, Some(expected(pixel[0], pixel[1])));
            assert!(refined.picture() == picture && refined.advance(1, &|| true));
        }
        let mut more = 0;
        while refined.probe([120, 61], &|| true).is_some() {
            more += 1;
        }
        assert_eq!(more, (PIXEL_PATHS - 512) / PIXEL_PATHS_AT_ONCE, "it ends");
        assert!(refined.probe([250, 0], &|| true).is_none(), "outside");
    }

    #[test]
    fn it_stops_where_it_is_told_and_at_the_goal() {
        let mut refined = refinement([60, 40], 0.2);
        assert!(!refined.advance(10, &|| false));
        assert_eq!(refined.status().paths, 0.0);
        let mut steps = 0;
        while !refined.status().done {
            assert!(refined.advance(40, &|| true));
            steps += 1;
            assert!(steps < 1000, "{:?}", refined.status());
        }
        let status = refined.status();
        assert!(status.error.is_some_and(|error| error <= 0.2), "{status:?}");
        assert!(refined.advance(40, &|| true) && refined.status() == status, "nothing is added to a finished picture");
        // From another place it begins again.
        let camera = refined.scene.frame().camera;
        refined.restart(camera, [30, 20]);
        assert_eq!((refined.status().paths, refined.status().done), (0.0, false));
        assert_eq!(refined.picture().pixels.len(), 600);
    }
}
