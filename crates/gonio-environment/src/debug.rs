//! The debug cubemap: every face is labelled.
//!
//! On each, as seen from inside: the world's direction in large letters (`+X`), the name of its file in a layout
//! (`posx`), arrows along the two axes that run in the face with the axis' letter, a grid of eighths, a border, and a
//! mark in the upper left corner, so that faces that are turned or mirrored show. Upright is +Y on the four sides; the
//! top and the bottom are upright for one who looks straight ahead (-Z) and then raises or lowers the head.
//!
//! Hues distinguish the axes (X orange, Y green, Z blue), lightness the signs (light is positive). The hues are, or are
//! near, those that M. Okabe and K. Ito, *Color Universal Design*, 2008, chose for people who lack one of the eye's
//! three receptors.

use crate::Cubemap;
use crate::face::{Face, Layout};
use crate::face_drawing::FaceDrawing;
use glam::{DVec2, DVec3};
use gonio_light::color::srgb_decode;

/// The ends of a line.
type Ends = (DVec2, DVec2);

/// The debug cubemap with `size` texels an edge (0 counts as 1), with the file names of a layout. From about 64 texels
/// on it can be read.
pub fn debug(size: u32, layout: Layout) -> Cubemap {
    let mut map = Cubemap::new(size, [0.0; 4]);
    for face in Face::ALL {
        // Drawn as it looks from inside, which is the photographic layout.
        let image = draw(face, map.size(), layout).pixels;
        map.lay(face, Layout::Photographic, &image);
    }
    map
}

/// The world's axis through the middle of a photographic face: its number, and whether it is the positive one.
fn axis_of(direction: DVec3) -> (usize, bool) {
    let axis = (0..3).find(|&i| direction[i] != 0.0).unwrap_or(0);
    (axis, direction[axis] > 0.0)
}

/// The letters of the axes.
const LETTERS: [&str; 3] = ["X", "Y", "Z"];

/// sRGB of the negative and the positive side of each axis.
const COLORS: [[[u8; 3]; 2]; 3] =
    [[[184, 74, 0], [240, 168, 48]], [[0, 104, 80], [120, 208, 168]], [[0, 84, 148], [116, 190, 236]]];

fn draw(face: Face, size: u32, layout: Layout) -> gonio_image::Image {
    let middle = face.direction(0.0, 0.0, Layout::Photographic);
    let (axis, positive) = axis_of(middle);
    let linear = |[r, g, b]: [u8; 3]| DVec3::new(r.into(), g.into(), b.into()).map(|v| srgb_decode(v / 255.0));
    let ground = linear(COLORS[axis][usize::from(positive)]);
    // Dark ink on light grounds and light ink on dark ones: at least 6 : 1 in luminance.
    let ink = linear(if positive { [22, 26, 32] } else { [250, 248, 242] });
    // A little darker towards the edges, which also shows where the face ends.
    let mut drawing = FaceDrawing::new(size, |p| ground * (1.06 - 0.12 * p.length_squared()));

    let grid: Vec<_> = (1..8)
        .map(|i| 0.25 * f64::from(i) - 1.0)
        .flat_map(|at| [(DVec2::new(at, -1.0), DVec2::new(at, 1.0)), (DVec2::new(-1.0, at), DVec2::new(1.0, at))])
        .map(line)
        .collect();
    drawing.stroke(&grid, 0.006, ink, if positive { 0.32 } else { 0.2 });
    let rim = 0.985;
    let border = [(-rim, -rim), (rim, -rim), (rim, rim), (-rim, rim), (-rim, -rim)].map(DVec2::from).to_vec();
    drawing.stroke(&[border], 0.03, ink, 0.75);
    // The mark: a filled triangle, of lines as wide as their distance.
    let mark: Vec<_> = (0..12).map(|i| 0.02 * f64::from(i)).map(|d| line((corner(d, 0.0), corner(0.0, d)))).collect();
    drawing.stroke(&mark, 0.03, ink, 0.75);

    let sign = if positive { "+" } else { "-" };
    drawing.write(&format!("{sign}{}", LETTERS[axis]), DVec2::new(0.0, -0.16), 0.66, 0.105, ink);
    let name = Face::from_direction(middle, layout).map_or("", |(there, ..)| there.name());
    drawing.write(name, DVec2::new(0.0, 0.44), 0.225, 0.034, ink);

    let along = |s: f64, t: f64| axis_of(face.direction(s, t, Layout::Photographic) - middle);
    let (across, to_the_right) = along(1.0, 0.0);
    arrow(
        &mut drawing,
        LETTERS[across],
        DVec2::new(if to_the_right { 1.0 } else { -1.0 }, 0.0),
        DVec2::new(0.0, 0.82),
        ink,
    );
    let (upright, downwards) = along(0.0, 1.0);
    arrow(
        &mut drawing,
        LETTERS[upright],
        DVec2::new(0.0, if downwards { 1.0 } else { -1.0 }),
        DVec2::new(-0.82, 0.0),
        ink,
    );
    drawing.finish()
}

/// A point on the diagonal's two sides at the upper left corner, inside the border.
fn corner(right: f64, down: f64) -> DVec2 {
    DVec2::new(-0.97 + right, -0.97 + down)
}

fn line((a, b): Ends) -> Vec<DVec2> {
    vec![a, b]
}

/// An arrow through `middle`, its axis' letter beyond its tip.
fn arrow(drawing: &mut FaceDrawing, letter: &str, towards: DVec2, middle: DVec2, ink: DVec3) {
    let (tip, aside) = (middle + 0.34 * towards, towards.perp());
    let barb = |side: f64| line((tip, tip - 0.11 * towards + side * 0.07 * aside));
    let strokes = [line((middle - 0.34 * towards, tip)), barb(1.0), barb(-1.0)];
    drawing.stroke(&strokes, 0.026, ink, 1.0);
    drawing.write(letter, middle + 0.47 * towards, 0.13, 0.026, ink);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The view from inside to a face's middle: forward, right, up.
    fn views() -> [(DVec3, DVec3, DVec3); 6] {
        let (x, y, z) = (DVec3::X, DVec3::Y, DVec3::Z);
        [(x, z, y), (-x, -z, y), (y, x, z), (-y, x, -z), (-z, x, y), (z, -x, y)]
    }

    /// The mean difference from the ground's colour in a rectangle of the view, from -1 to 1 to the right and up.
    fn ink(map: &Cubemap, view: (DVec3, DVec3, DVec3), rights: [f64; 2], ups: [f64; 2]) -> f64 {
        let (forward, right, up) = view;
        let at = |r: f64, u: f64| map.sample(forward + r * right + u * up);
        // Where nothing is drawn: beside the grid's lines.
        let ground = at(0.62, -0.62);
        let mut sum = 0.0;
        for i in 0..40 {
            for j in 0..40 {
                let within = |[a, b]: [f64; 2], k: i32| a + (b - a) * (f64::from(k) + 0.5) / 40.0;
                sum += (at(within(rights, i), within(ups, j)) - ground).abs().element_sum() / 1600.0;
            }
        }
        sum
    }

    #[test]
    fn every_face_is_upright_and_unmirrored_from_inside() {
        let map = debug(128, Layout::Photographic);
        for view in views() {
            let (forward, right, up) = view;
            // The mark is in the upper left corner, and in no other.
            let corner = |r: f64, u: f64| ink(&map, view, [r - 0.05, r + 0.05], [u - 0.05, u + 0.05]);
            let marked = corner(-0.88, 0.88);
            for (r, u) in [(0.88, 0.88), (-0.88, -0.88), (0.88, -0.88)] {
                assert!(marked > 2.0 * corner(r, u), "{forward}: {marked} and {} at {r} {u}", corner(r, u));
            }
            // Letters are read from the left: a sign is less ink than a letter.
            let (sign, letter) =
                (ink(&map, view, [-0.65, 0.0], [-0.2, 0.55]), ink(&map, view, [0.0, 0.65], [-0.2, 0.55]));
            assert!(letter > 1.1 * sign, "{forward}: {letter} {sign}");
            // Arrows point where their axes grow, and have tip and letter there.
            for (axis, at_right, at_left) in [
                (right, ink(&map, view, [0.2, 0.6], [-0.92, -0.72]), ink(&map, view, [-0.6, -0.2], [-0.92, -0.72])),
                (up, ink(&map, view, [-0.92, -0.72], [0.2, 0.6]), ink(&map, view, [-0.92, -0.72], [-0.6, -0.2])),
            ] {
                let (there, opposite) =
                    if axis.element_sum() > 0.0 { (at_right, at_left) } else { (at_left, at_right) };
                assert!(there > 1.5 * opposite, "{forward} {axis}: {there} {opposite}");
            }
        }
    }

    #[test]
    fn only_the_names_of_the_z_faces_differ() {
        let (photo, gl) = (debug(64, Layout::Photographic), debug(64, Layout::OpenGl));
        for face in Face::ALL {
            let same = photo.face(face) == gl.face(face);
            assert_eq!(same, !matches!(face, Face::PosZ | Face::NegZ), "{face:?}");
        }
    }

    #[test]
    fn faces_have_colors_of_their_own() {
        let map = debug(32, Layout::OpenGl);
        let means = Face::ALL.map(|face| crate::cubemap::mean(map.face(face)));
        for i in 0..6 {
            for j in 0..i {
                assert!((means[i] - means[j]).length() > 0.1, "{i} {j}");
            }
        }
        assert_eq!(debug(0, Layout::OpenGl).size(), 1);
    }
}
