//! When two pictures are the same, and how much of a difference another picture explains.

use crate::testbench::Atlas;

/// A channel's difference that counts: one step of 8 bits. Set by what a framebuffer can show; the arithmetic of drivers
/// differs by a hundredth of it.
pub const PIXEL_TOLERANCE: f32 = 1.0 / 255.0;

/// The share of a picture's pixels that may differ by more. Set by outlines: where matrices are multiplied in another order,
/// a triangle's edge may fall on the other side of a pixel's middle.
pub const PIXELS_TOLERANCE: f64 = 0.01;

/// How two pixels differ: 0 to 1. Above 1 nothing is told apart, as in a framebuffer; below 0 it is, for a negative term takes
/// away from others. No number (NaN) is the same as no number.
pub fn pixel_difference(a: &[f32; 4], b: &[f32; 4]) -> f32 {
    match (Atlas::is_drawn(a), Atlas::is_drawn(b)) {
        (false, false) => return 0.0,
        (true, true) => {}
        _ => return 1.0,
    }
    a.iter().zip(b).take(3).map(|(&a, &b)| channel_difference(a, b)).fold(0.0, f32::max)
}

/// How two numbers of a channel differ: 0 to 1.
pub fn channel_difference(a: f32, b: f32) -> f32 {
    match (a.is_nan(), b.is_nan()) {
        (true, true) => 0.0,
        (false, false) => (a.min(1.0) - b.min(1.0)).abs().min(1.0),
        _ => 1.0,
    }
}

/// A test scene's differences, added up.
#[derive(Clone, Copy, Debug, Default)]
pub struct SceneDifference {
    drawn: usize,
    beyond: usize,
    squares: f64,
    worst: f32,
}

impl SceneDifference {
    /// One pixel more.
    pub fn add(&mut self, difference: f32) {
        self.drawn += 1;
        self.beyond += usize::from(difference > PIXEL_TOLERANCE);
        self.squares += f64::from(difference * difference);
        self.worst = self.worst.max(difference);
    }

    /// So many pixels that only one of the two pictures has.
    pub fn add_lost(&mut self, count: usize) {
        self.drawn += count;
        self.beyond += count;
        self.squares += count as f64;
        self.worst = if count > 0 { 1.0 } else { self.worst };
    }
}

impl FromIterator<SceneDifference> for Comparison {
    fn from_iter<T: IntoIterator<Item = SceneDifference>>(tallies: T) -> Self {
        let mut comparison = Comparison { beyond: Vec::new(), squares: Vec::new(), worst: Vec::new() };
        for tally in tallies {
            let drawn = tally.drawn.max(1) as f64;
            comparison.beyond.push(tally.beyond as f64 / drawn);
            comparison.squares.push(tally.squares / drawn);
            comparison.worst.push(tally.worst);
        }
        comparison
    }
}

/// Two atlases side by side, test scene by test scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// For each test scene, the share of pixels beyond [`PIXEL_TOLERANCE`], of those drawn in either picture.
    pub beyond: Vec<f64>,
    /// For each test scene, the mean of the squared differences.
    pub squares: Vec<f64>,
    /// For each test scene, the largest difference.
    pub worst: Vec<f32>,
}

impl Comparison {
    /// Compares as many test scenes as there are.
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

    /// Of the first test scenes alone.
    pub fn first(&self, test_scenes: usize) -> Comparison {
        let count = test_scenes.min(self.beyond.len());
        Comparison {
            beyond: self.beyond[..count].to_vec(),
            squares: self.squares[..count].to_vec(),
            worst: self.worst[..count].to_vec(),
        }
    }

    /// Whether a test scene's pictures are the same.
    pub fn agrees(&self, test_scene: usize) -> bool {
        self.beyond.get(test_scene).is_some_and(|&share| share <= PIXELS_TOLERANCE)
    }

    /// Whether all are.
    pub fn is_same(&self) -> bool {
        self.beyond.iter().all(|&share| share <= PIXELS_TOLERANCE)
    }

    /// How much of this difference is explained by a prediction that leaves `residual`: 1 where nothing is left, 0 where as much is
    /// left as there was, never less. Every test scene counts for as much as it differs by, but none for more than ten times
    /// another that differs at all.
    pub fn explained_by(&self, residual: &Comparison) -> f64 {
        let floor = 0.1 * self.squares.iter().copied().fold(0.0, f64::max);
        let (mut all, mut left) = (0.0, 0.0);
        for (squares, residual) in self.squares.iter().zip(&residual.squares) {
            let weight = 1.0 / squares.max(floor).max(1e-12);
            all += weight * squares;
            left += weight * residual;
        }
        if all <= 0.0 { 0.0 } else { (1.0 - left / all).max(0.0) }
    }
}
