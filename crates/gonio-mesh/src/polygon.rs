//! Triangulates polygons: a fan where that is correct, ear clipping elsewhere.

mod ears;
mod grid;

use crate::ReadError;
use ears::Ring;
use glam::{DVec2, DVec3};

/// Most corners for a simple search for ears, whose time grows with the square of their number.
pub(crate) const MOST_CORNERS_FOR_EARS: usize = 4000;

/// Most corners of a polygon. Triangulation takes a hundred bytes per corner: a file of one polygon, with two bytes per
/// corner, would take fifty times its own size.
pub(crate) const MOST_CORNERS: usize = 1 << 22;

/// Creates the error for a polygon with too many corners.
#[cold]
pub(crate) fn too_many_corners(polygon: &str) -> ReadError {
    ReadError::new(format!("{polygon} has more than {MOST_CORNERS} corners, which is the limit"))
}

/// Most corners of a polygon that is triangulated without allocating: most polygons have no more.
pub(crate) const FEW: usize = 8;

/// How a polygon was triangulated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Cut {
    /// Convex, or without area: a fan around its first corner.
    Fan,
    /// Concave, or with collinear corners: ear clipping.
    Ears,
    /// Self-intersecting, so that some triangles overlap or are reversed. (A polygon that winds around twice without
    /// such triangles is triangulated as [`Cut::Ears`].)
    NotSimple,
    /// Concave, and so large and winding that ear clipping was given up: fanned, at least in part.
    TooLarge,
}

/// Buffers that are reused for each polygon.
#[derive(Default)]
pub(crate) struct Triangulator {
    points: Vec<DVec2>,
    links: Vec<[u32; 2]>,
    blocking: Vec<u64>,
}

impl Triangulator {
    /// Calls `emit` with the corners (0 to `corners.len() - 1`) of `corners.len() - 2` triangles with the winding of
    /// the polygon. Fewer than three corners make none.
    pub(crate) fn triangulate(&mut self, corners: &[[f32; 3]], mut emit: impl FnMut([usize; 3])) -> Cut {
        let n = corners.len();
        if n < 3 {
            return Cut::Fan;
        }
        let mut few = ([DVec2::ZERO; FEW], [[0; 2]; FEW], [0; FEW.div_ceil(64)]);
        let (points, links, blocking) = if n <= FEW {
            (&mut few.0[..n], &mut few.1[..n], &mut few.2[..])
        } else {
            self.points.resize(n, DVec2::ZERO);
            self.links.resize(n, [0; 2]);
            self.blocking.resize(n.div_ceil(64), 0);
            (&mut self.points[..], &mut self.links[..], &mut self.blocking[..])
        };
        if n == 3 || !project(corners, points) || is_strictly_convex(points) {
            (1..n - 1).for_each(|i| emit([0, i, i + 1]));
            return Cut::Fan;
        }
        let ring = Ring::new(points, links);
        if n > MOST_CORNERS_FOR_EARS { grid::cut_ears(ring, emit) } else { ears::cut(ring, blocking, emit) }
    }

    /// Whether a quadrilateral has an area and is convex, and is thus divided from its first corner to its third. This
    /// is faster than [`Self::triangulate`], with the same result.
    #[inline(always)]
    pub(crate) fn is_convex_quadrilateral(corners: [[f32; 3]; 4]) -> bool {
        let [a, b, c, d] = corners;
        let [a, b, c, d] = [widened(a), widened(b), widened(c), widened(d)];
        // The normal from the diagonals: the sum of those of the two triangles.
        let normal = (c - a).cross(d - b);
        if normal == DVec3::ZERO {
            return false;
        }
        let axes = Axes::across(normal);
        let [a, b, c, d] = [axes.project(a), axes.project(b), axes.project(c), axes.project(d)];
        let [ab, bc, cd, da] = [b - a, c - b, d - c, a - d];
        // Four left turns make one revolution: each is less than half of one.
        let turns = [ab.perp_dot(bc), bc.perp_dot(cd), cd.perp_dot(da), da.perp_dot(ab)];
        turns.iter().fold(true, |all, turn| all & (*turn > 0.0))
    }
}

#[inline(always)]
fn widened([x, y, z]: [f32; 3]) -> DVec3 {
    DVec3::new(x.into(), y.into(), z.into())
}

/// Projects a polygon along the largest component of its normal, with its first corner at the origin. Returns false if
/// it has no area.
fn project(corners: &[[f32; 3]], points: &mut [DVec2]) -> bool {
    let origin = widened(corners[0]);
    // Newell's normal: twice the vector area, also for a polygon that is not quite planar.
    let (mut normal, mut before) = (DVec3::ZERO, DVec3::ZERO);
    for corner in &corners[1..] {
        let here = widened(*corner) - origin;
        normal += before.cross(here);
        before = here;
    }
    let axes = Axes::across(normal);
    let origin = axes.project(origin);
    for (point, corner) in points.iter_mut().zip(corners) {
        *point = axes.project(widened(*corner)) - origin;
    }
    normal != DVec3::ZERO
}

/// Whether every corner turns left and the turns add up to one revolution: the direction in x reverses twice.
fn is_strictly_convex(points: &[DVec2]) -> bool {
    let n = points.len();
    let mut previous = points[n - 2];
    let mut here = points[n - 1];
    let mut heading = 0.0;
    let mut first_heading = 0.0;
    let mut turns_back = 0;
    for &next in points {
        if turn(previous, here, next) <= 0.0 {
            return false;
        }
        let step = next.x - here.x;
        if step != 0.0 {
            if heading == 0.0 {
                first_heading = step;
            } else if heading * step < 0.0 {
                turns_back += 1;
            }
            heading = step;
        }
        (previous, here) = (here, next);
    }
    turns_back + i32::from(heading * first_heading < 0.0) <= 2
}

/// The plane of two coordinate axes that a polygon is projected to, so that it turns left.
struct Axes {
    /// The axis that is dropped.
    along: usize,
    /// Whether the other two are swapped.
    is_swapped: bool,
}

impl Axes {
    /// Chooses the plane across the largest component of a normal.
    #[inline(always)]
    fn across(normal: DVec3) -> Self {
        let size = normal.abs();
        let along = if size.x >= size.y && size.x >= size.z {
            0
        } else if size.y >= size.z {
            1
        } else {
            2
        };
        Axes { along, is_swapped: normal[along] <= 0.0 }
    }

    #[inline(always)]
    fn project(&self, p: DVec3) -> DVec2 {
        let (a, b) = match self.along {
            0 => (p.y, p.z),
            1 => (p.z, p.x),
            _ => (p.x, p.y),
        };
        if self.is_swapped { DVec2::new(b, a) } else { DVec2::new(a, b) }
    }
}

/// Returns twice the area of the triangle: positive if it turns left.
#[inline(always)]
fn turn(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (b - a).perp_dot(c - b)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cut(corners: &[[f32; 3]]) -> (Cut, Vec<[usize; 3]>) {
        let mut triangles = Vec::new();
        let cut = Triangulator::default().triangulate(corners, |t| triangles.push(t));
        (cut, triangles)
    }

    fn flat(points: &[[f32; 2]]) -> Vec<[f32; 3]> {
        points.iter().map(|&[x, y]| [x, y, 0.0]).collect()
    }

    /// Areas of the triangles, each positive where it turns as the plane does.
    fn areas(corners: &[[f32; 3]], triangles: &[[usize; 3]]) -> Vec<f64> {
        let at = |i: usize| DVec2::new(f64::from(corners[i][0]), f64::from(corners[i][1]));
        triangles.iter().map(|&[a, b, c]| 0.5 * turn(at(a), at(b), at(c))).collect()
    }

    /// The shoelace formula (Meister, 1769).
    fn shoelace(corners: &[[f32; 3]]) -> f64 {
        let n = corners.len();
        let term = |i: usize| {
            let ([x0, y0, _], [x1, y1, _]) = (corners[i].map(f64::from), corners[(i + 1) % n].map(f64::from));
            x0 * y1 - x1 * y0
        };
        0.5 * (0..n).map(term).sum::<f64>()
    }

    /// Triangles that all turn alike and whose areas sum to the polygon's cover it without overlap. The tolerance is
    /// rounding: a millionth of a millionth of the area.
    fn check_covers(corners: &[[f32; 3]], expected: Cut) {
        let (cut, triangles) = cut(corners);
        assert_eq!(cut, expected);
        assert_eq!(triangles.len(), corners.len() - 2);
        let (areas, area) = (areas(corners, &triangles), shoelace(corners));
        assert!(areas.iter().all(|a| a * area.signum() > 0.0), "{triangles:?}: {areas:?}");
        assert!((areas.iter().sum::<f64>() - area).abs() <= 1e-12 * area.abs(), "{areas:?} is not {area}");
    }

    #[test]
    fn convex_polygons_are_fans() {
        let hexagon: Vec<[f32; 3]> =
            (0..6).map(|i| f32::to_radians(60.0 * i as f32)).map(|a| [a.cos(), a.sin(), 0.0]).collect();
        assert_eq!(cut(&hexagon), (Cut::Fan, vec![[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]]));
        check_covers(&hexagon, Cut::Fan);
        assert_eq!(cut(&hexagon[..2]), (Cut::Fan, vec![]));
    }

    #[test]
    fn concave_polygons_are_covered_from_every_corner_and_side() {
        let shapes: [&[[f32; 2]]; 6] = [
            &[[0.0, 0.0], [2.0, 0.0], [0.5, 0.5], [0.0, 2.0]],
            // L, U and a comb.
            &[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]],
            &[[0.0, 0.0], [3.0, 0.0], [3.0, 3.0], [2.0, 3.0], [2.0, 1.0], [1.0, 1.0], [1.0, 3.0], [0.0, 3.0]],
            &[
                [0.0, 0.0],
                [6.0, 0.0],
                [6.0, 3.0],
                [5.0, 0.5],
                [4.0, 3.0],
                [3.0, 0.5],
                [2.0, 3.0],
                [1.0, 0.5],
                [0.0, 3.0],
            ],
            // Corners on straight lines.
            &[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 1.0], [2.0, 2.0], [1.0, 2.0], [0.0, 2.0], [0.0, 1.0]],
            &[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0], [1.5, 1.0]],
        ];
        for shape in shapes {
            let mut corners = flat(shape);
            for _ in 0..shape.len() {
                corners.rotate_left(1);
                check_covers(&corners, Cut::Ears);
                let reversed: Vec<_> = corners.iter().rev().copied().collect();
                check_covers(&reversed, Cut::Ears);
            }
        }
    }

    #[test]
    fn a_spiral_and_a_star_far_from_the_origin() {
        // Along an arm and back beside it: 200 corners, most of them reflex or sharp.
        let arm = |i: usize, width: f32| {
            let angle = 0.15 * i as f32;
            let radius = 1.0 + 0.2 * angle + width;
            [1000.0 + radius * angle.cos(), 2000.0 + radius * angle.sin(), 0.0]
        };
        let mut spiral: Vec<_> = (0..100).map(|i| arm(i, 0.5)).collect();
        spiral.extend((0..100).rev().map(|i| arm(i, 0.0)));
        check_covers(&spiral, Cut::Ears);
        let star: Vec<_> = (0..50)
            .map(|i| (f32::to_radians(7.2 * i as f32), if i % 2 == 0 { 1.0 } else { 0.3 }))
            .map(|(a, r)| [r * a.cos() - 50.0, r * a.sin(), 0.0])
            .collect();
        check_covers(&star, Cut::Ears);
    }

    /// The same polygon standing in each of the six directions is cut in the same way.
    #[test]
    fn every_plane_is_alike() {
        let shape = flat(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]]);
        let expected = cut(&shape).1;
        let turns: [fn([f32; 3]) -> [f32; 3]; 5] = [
            |[x, y, z]| [z, x, y],
            |[x, y, z]| [y, z, x],
            |[x, y, z]| [y, x, -z],
            |[x, y, z]| [z, y, -x],
            |[x, y, z]| [x, -z, y],
        ];
        for turn in turns {
            let turned: Vec<_> = shape.iter().map(|&p| turn(p)).collect();
            let mut areas = 0.0;
            let (cut, triangles) = cut(&turned);
            for [a, b, c] in triangles.iter().map(|t| t.map(|i| glam::Vec3::from(turned[i]))) {
                areas += 0.5 * (b - a).cross(c - a).length();
            }
            assert_eq!((cut, triangles.len(), areas), (Cut::Ears, expected.len(), 3.0));
        }
    }

    #[test]
    fn what_is_no_polygon_still_gives_triangles() {
        // A bow tie, a pentagram, all corners in one point, all on a line.
        let bow_tie = flat(&[[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 3.0]]);
        let (how, triangles) = cut(&bow_tie);
        assert_eq!((how, triangles.len()), (Cut::NotSimple, 2));
        let pentagram: Vec<_> =
            (0..5).map(|i| f32::to_radians(144.0 * i as f32)).map(|a| [a.cos(), a.sin(), 0.0]).collect();
        assert_eq!(cut(&pentagram).1.len(), 3);
        assert_eq!(cut(&[[1.0; 3]; 6]).1.len(), 4);
        assert_eq!(cut(&flat(&[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0], [3.0, 3.0]])).1.len(), 2);
    }

    #[test]
    fn one_corner_more_than_a_few_is_cut_as_well() {
        for n in [MOST_CORNERS_FOR_EARS, MOST_CORNERS_FOR_EARS + 2] {
            let saw: Vec<_> = (0..n)
                .map(|i| (std::f32::consts::TAU * i as f32 / n as f32, if i % 2 == 0 { 1.0 } else { 0.9 }))
                .map(|(a, r)| [r * a.cos(), r * a.sin(), 0.0])
                .collect();
            check_covers(&saw, Cut::Ears);
        }
    }

    /// The quick answer for quadrilaterals is the general one, but for those without area.
    #[test]
    fn quadrilaterals_are_known_at_once() {
        let (mut convex, mut others) = (0, 0);
        for seed in 0..20_000 {
            let digit = |i: u32| ((crate::weld::mix(seed) >> (5 * i)) % 4) as f32;
            let corners: [[f32; 3]; 4] = std::array::from_fn(|c| std::array::from_fn(|i| digit((3 * c + i) as u32)));
            let has_area = project(&corners, &mut [DVec2::ZERO; 4]);
            let is_convex = has_area && cut(&corners).0 == Cut::Fan;
            assert_eq!(Triangulator::is_convex_quadrilateral(corners), is_convex, "{corners:?}");
            if is_convex { convex += 1 } else { others += 1 }
        }
        assert!(convex > 1000 && others > 1000, "{convex} {others}");
    }

    /// Buffers from one polygon do not affect the next.
    #[test]
    fn memory_is_used_again() {
        // Crossing themselves, they leave corners that are not convex.
        let tangle = |n: usize| -> Vec<[f32; 3]> {
            let digit = |i: usize| (crate::weld::mix((n + i) as u64) % 1000) as f32;
            (0..n).map(|i| [digit(2 * i), digit(2 * i + 1), 0.0]).collect()
        };
        let mut triangulator = Triangulator::default();
        for n in (9..64).rev() {
            let mut triangles = Vec::new();
            let how = triangulator.triangulate(&tangle(n), |triangle| triangles.push(triangle));
            assert_eq!((how, triangles), cut(&tangle(n)), "{n}");
        }
    }

    /// A square with a square hole, made one polygon by a bridge: the usual way of writing holes.
    #[test]
    fn a_hole_behind_a_bridge_stays_open() {
        let corners = flat(&[
            [0.0, 0.0],
            [4.0, 0.0],
            [4.0, 4.0],
            [0.0, 4.0],
            [0.0, 0.0],
            [1.0, 1.0],
            [1.0, 3.0],
            [3.0, 3.0],
            [3.0, 1.0],
            [1.0, 1.0],
        ]);
        check_covers(&corners, Cut::Ears);
    }
}
