//! Certifies an equirectangular picture: does it close at its sides and over its poles?
//!
//! In a correct panorama the left and the right edge are neighbours, and so are, in the top row and in the bottom one,
//! pixels half a turn apart: a pole is one point. If that holds for columns instead of rows, the picture is turned by a
//! quarter. Edges do not show whether it is upside down or mirrored: upside down, everything closes as before. A
//! brighter lower half is a hint, and is reported as one.

use crate::panorama::Panorama;
use crate::seams::encode;
use gonio_image::Image;

/// A seam shows if its difference is more than this many times that of the rows or columns beside it: one step of a row
/// or column is as far as another, so that it is about 1 where the picture goes on, and 4 or more where rooms and
/// made-up pictures were cut.
const SHOWS: f64 = 3.0;

/// Differences in stops below this are those of 8 bits, and none.
const FLOOR: f64 = 0.02;

/// The lower half is called brighter if it is by so many stops: most rooms and all skies are darker below, by half a
/// stop to three.
const HINT_STOPS: f64 = 1.0;

/// A seam of a panorama.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seam {
    /// Median of the difference across it, in stops (of each pixel the channel that differs most): the outline of a
    /// thing that happens to lie on the seam does not count.
    pub across: f64,
    /// The same between the rows or columns beside it.
    pub inside: f64,
}

impl Seam {
    /// Returns whether the seam is visible.
    pub fn shows(&self) -> bool {
        self.across > SHOWS * self.inside.max(FLOOR)
    }
}

/// The result of [`check_panorama`].
#[derive(Clone, Debug, PartialEq)]
pub struct PanoramaCertificate {
    /// The seam between the left and the right edge.
    pub sides: Seam,
    /// The seam over the upper pole: the top row against itself half a turn further.
    pub top: Seam,
    /// The seam over the lower pole.
    pub bottom: Seam,
    /// Whether it closes only if columns are read as rows: it was turned by 90 degrees.
    pub is_turned: bool,
    /// The brightness of the upper half above that of the lower one, in stops, as a mean of logarithms.
    pub upper_is_brighter_by: f64,
}

/// Checks an equirectangular picture.
pub fn check_panorama(panorama: &Panorama) -> PanoramaCertificate {
    let picture = Stops::new(&panorama.image);
    let (sides, top, bottom) = picture.seams();
    let (turned_sides, turned_top, turned_bottom) = picture.transposed().seams();
    let closes = |sides: Seam, top: Seam, bottom: Seam| !sides.shows() && !top.shows() && !bottom.shows();
    let is_turned = !closes(sides, top, bottom) && closes(turned_sides, turned_top, turned_bottom);
    let half = picture.pixels.len() / 2;
    let mean = |pixels: &[[f64; 3]]| pixels.iter().flatten().sum::<f64>() / (3 * pixels.len()).max(1) as f64;
    let upper_is_brighter_by = mean(&picture.pixels[..half]) - mean(&picture.pixels[picture.pixels.len() - half..]);
    PanoramaCertificate { sides, top, bottom, is_turned, upper_is_brighter_by }
}

impl PanoramaCertificate {
    /// Returns whether the panorama closes everywhere.
    pub fn closes(&self) -> bool {
        !self.sides.shows() && !self.top.shows() && !self.bottom.shows()
    }

    /// Describes the result in sentences without final full stop: findings, hints, and the limits of the check.
    pub fn sentences(&self) -> Vec<String> {
        let mut sentences = Vec::new();
        if self.is_turned {
            sentences.push(
                "the picture is turned by 90 degrees: it closes only if its columns are read as rows; turn it back"
                    .to_owned(),
            );
        } else if self.closes() {
            sentences.push("the panorama closes: left meets right, and each pole is one point".to_owned());
        } else {
            let seams = [
                (self.sides, "the left and the right edge do not meet: the picture does not go all around"),
                (
                    self.top,
                    "the top row is not one point: the picture does not reach the pole above, or it is not a panorama",
                ),
                (
                    self.bottom,
                    "the bottom row is not one point: the picture does not reach the pole below, or it is not a panorama",
                ),
            ];
            for (seam, what) in seams.into_iter().filter(|(seam, _)| seam.shows()) {
                sentences.push(format!("{what} ({:.2} stops, {:.2} beside it)", seam.across, seam.inside));
            }
        }
        if !self.is_turned && self.upper_is_brighter_by < -HINT_STOPS {
            sentences.push(format!(
                "hint: the lower half is brighter by {:.1} stops; the picture may be upside down",
                -self.upper_is_brighter_by
            ));
        }
        sentences.push("edges do not show whether a panorama is mirrored or upside down".to_owned());
        sentences
    }
}

/// A picture in stops.
struct Stops {
    width: usize,
    height: usize,
    pixels: Vec<[f64; 3]>,
}

impl Stops {
    fn new(image: &Image) -> Self {
        let light = |v: f32| f64::from(if v > 0.0 { v.min(1e30) } else { 0.0 });
        let mut pixels: Vec<[f64; 3]> = image.pixels.iter().map(|[r, g, b, _]| [*r, *g, *b].map(light)).collect();
        encode(pixels.iter_mut().collect());
        Stops { width: image.width as usize, height: image.height as usize, pixels }
    }

    fn transposed(&self) -> Stops {
        let pixels = (0..self.width).flat_map(|x| (0..self.height).map(move |y| (x, y)));
        let pixels = pixels.map(|(x, y)| self.pixels[y * self.width + x]).collect();
        Stops { width: self.height, height: self.width, pixels }
    }

    /// Sides, top, bottom.
    fn seams(&self) -> (Seam, Seam, Seam) {
        let (width, height) = (self.width, self.height);
        let row = |y: usize| &self.pixels[y * width..][..width];
        let column = |x: usize| self.pixels.iter().skip(x).step_by(width);
        // A step of one column at either side; the larger counts.
        let left = median(column(0), column(1.min(width - 1)));
        let right = median(column(width - 1), column(width.saturating_sub(2)));
        let sides = Seam { across: median(column(0), column(width - 1)), inside: left.max(right) };
        let pole = |edge: usize, next: usize| {
            // Half a turn apart: the neighbour over the pole is one row's step away, as the next row is.
            let opposite = row(edge).iter().cycle().skip(width / 2).take(width);
            let across = median(row(edge).iter(), opposite);
            Seam { across, inside: median(row(edge).iter(), row(next).iter()) }
        };
        (sides, pole(0, 1.min(height - 1)), pole(height - 1, height.saturating_sub(2)))
    }
}

/// The median over pixels of the largest difference of a channel.
fn median<'a>(a: impl Iterator<Item = &'a [f64; 3]>, b: impl Iterator<Item = &'a [f64; 3]>) -> f64 {
    let largest = |(p, q): (&[f64; 3], &[f64; 3])| p.iter().zip(q).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
    let mut differences: Vec<f64> = a.zip(b).map(largest).collect();
    let middle = differences.len() / 2;
    differences.sort_unstable_by(f64::total_cmp);
    differences.get(middle).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::builtin::room;
    use glam::DVec3;

    fn rich() -> Panorama {
        let wave = |d: DVec3, k: DVec3, phase: f64| (k.dot(d) + phase).sin();
        Panorama::from_function(128, 64, |d| {
            DVec3::new(
                1.2 + wave(d, DVec3::new(3.0, 1.0, -2.0), 0.3),
                1.2 + wave(d, DVec3::new(2.0, -4.0, 1.5), 2.0),
                1.2 + wave(d, DVec3::new(1.0, 2.5, 5.0), 4.0),
            )
        })
    }

    /// The picture whose pixel at (x, y) is that of the old one at `from(x, y)`.
    fn rearranged(
        panorama: &Panorama,
        width: u32,
        height: u32,
        from: impl Fn(u32, u32) -> (u32, u32),
    ) -> PanoramaCertificate {
        let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        let pixels = pixels.map(|(x, y)| from(x, y)).map(|(x, y)| panorama.image.at(x, y)).collect();
        check_panorama(&Panorama { image: Image { width, height, pixels } })
    }

    fn pictures() -> [(&'static str, Panorama); 2] {
        [("rich", rich()), ("room", room().unwrap_or_else(|e| panic!("{e}")))]
    }

    #[test]
    fn a_correct_panorama_closes() {
        for (name, panorama) in pictures() {
            let found = check_panorama(&panorama);
            assert!(found.closes() && !found.is_turned, "{name}: {found:?}");
            // Rolled about the vertical it still does.
            let width = panorama.image.width;
            let rolled = rearranged(&panorama, width, panorama.image.height, |x, y| ((x + 17) % width, y));
            assert!(rolled.closes(), "{name}: {rolled:?}");
        }
    }

    #[test]
    fn turned_and_cut_pictures_are_found() {
        for (name, panorama) in pictures() {
            let (width, height) = (panorama.image.width, panorama.image.height);
            let turned = rearranged(&panorama, height, width, |x, y| (y, height - 1 - x));
            assert!(turned.is_turned, "{name}: {turned:?}");
            assert!(turned.sentences()[0].contains("turned by 90 degrees"));
            // The middle three quarters in width.
            let narrow = rearranged(&panorama, width * 3 / 4, height, |x, y| (x + width / 8, y));
            assert!(narrow.sides.shows() && !narrow.is_turned, "{name}: {narrow:?}");
            // The middle half in height.
            let low = rearranged(&panorama, width, height / 2, |x, y| (x, y + height / 4));
            assert!(low.top.shows() && low.bottom.shows() && !low.sides.shows(), "{name}: {low:?}");
            assert_eq!(low.sentences().iter().filter(|s| s.contains("is not one point")).count(), 2);
        }
    }

    #[test]
    fn upside_down_is_a_hint_but_not_a_finding() {
        let sky = crate::sky::Sky::default().cubemap(64);
        let panorama = Panorama::from_function(128, 64, |d| sky.sample(d) * if d.y < 0.0 { 0.2 } else { 1.0 });
        let upright = check_panorama(&panorama);
        let flipped = rearranged(&panorama, 128, 64, |x, y| (x, 63 - y));
        assert!(flipped.closes() && !flipped.is_turned);
        assert!((upright.upper_is_brighter_by + flipped.upper_is_brighter_by).abs() < 1e-9);
        let hints = |found: &PanoramaCertificate| found.sentences().iter().filter(|s| s.starts_with("hint: ")).count();
        assert_eq!((hints(&upright), hints(&flipped)), (0, 1));
        // The smallest pictures have nothing to tell, and no row or column to miss.
        for (width, height) in [(1, 1), (1, 3), (2, 1)] {
            let grey = Panorama { image: Image::new(width, height, [0.5; 4]) };
            assert!(check_panorama(&grey).closes());
        }
    }
}
