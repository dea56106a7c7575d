//! Compares pictures: whether they are the same.

use crate::testbench::Atlas;

/// The least difference of a channel that counts: one step of 8 bits, the least that a framebuffer can show. The
/// arithmetic of drivers differs by a hundredth of it.
pub const PIXEL_TOLERANCE: f32 = 1.0 / 255.0;

/// The share of pixels that may differ by more, because of outlines: if matrices are multiplied in another order, the
/// edge of a triangle may fall on the other side of a pixel's centre.
pub const PIXELS_TOLERANCE: f64 = 0.01;

/// Returns the difference of two pixels, 0 to 1. Values above 1 are equal, as in a framebuffer; values below 0 are
/// not, because a negative term darkens others. NaN equals NaN.
pub fn pixel_difference(a: &[f32; 4], b: &[f32; 4]) -> f32 {
    match (Atlas::is_drawn(a), Atlas::is_drawn(b)) {
        (false, false) => return 0.0,
        (true, true) => {}
        _ => return 1.0,
    }
    a.iter().zip(b).take(3).map(|(&a, &b)| channel_difference(a, b)).fold(0.0, f32::max)
}

/// Returns the difference of two values of a channel, 0 to 1.
pub fn channel_difference(a: f32, b: f32) -> f32 {
    match (a.is_nan(), b.is_nan()) {
        (true, true) => 0.0,
        (false, false) => (a.min(1.0) - b.min(1.0)).abs().min(1.0),
        _ => 1.0,
    }
}

/// The accumulated differences of a test scene.
#[derive(Clone, Copy, Debug, Default)]
pub struct SceneDifference {
    drawn: usize,
    beyond: usize,
    worst: f32,
}

impl SceneDifference {
    /// Adds a pixel.
    pub fn add(&mut self, difference: f32) {
        self.drawn += 1;
        self.beyond += usize::from(difference > PIXEL_TOLERANCE);
        self.worst = self.worst.max(difference);
    }
}

impl FromIterator<SceneDifference> for Comparison {
    fn from_iter<T: IntoIterator<Item = SceneDifference>>(tallies: T) -> Self {
        let mut comparison = Comparison { beyond: Vec::new(), worst: Vec::new() };
        for tally in tallies {
            let drawn = tally.drawn.max(1) as f64;
            comparison.beyond.push(tally.beyond as f64 / drawn);
            comparison.worst.push(tally.worst);
        }
        comparison
    }
}

/// The comparison of two atlases, test scene by test scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// For each test scene, the share of pixels beyond [`PIXEL_TOLERANCE`], of those drawn in either picture.
    pub beyond: Vec<f64>,
    /// For each test scene, the largest difference.
    pub worst: Vec<f32>,
}

impl Comparison {
    /// Compares the first `test_scenes` test scenes.
    pub fn new(a: &Atlas, b: &Atlas, test_scenes: usize) -> Self {
        let tally = |tile: usize| {
            let mut tally = SceneDifference::default();
            for (p, q) in a.tile(tile).iter().zip(b.tile(tile)) {
                if Atlas::is_drawn(p) || Atlas::is_drawn(q) {
                    tally.add(pixel_difference(p, q));
                }
            }
            tally
        };
        (0..test_scenes).map(tally).collect()
    }

    /// Whether the pictures of a test scene are the same.
    pub fn agrees(&self, test_scene: usize) -> bool {
        self.beyond.get(test_scene).is_some_and(|&share| share <= PIXELS_TOLERANCE)
    }

    /// Whether the pictures of all test scenes are the same.
    pub fn is_same(&self) -> bool {
        self.beyond.iter().all(|&share| share <= PIXELS_TOLERANCE)
    }
}
