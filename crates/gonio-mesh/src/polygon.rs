//! Polygons into triangles: a fan where that is right, ears cut off where it is not.

mod grid;

use glam::{DVec2, DVec3};

/// Corners up to which ears are sought one by one, which takes time that grows with the square of their number.
pub(crate) const MOST_CORNERS_FOR_EARS: usize = 4000;

/// How a polygon was cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Cut {
    /// Convex, or without area: a fan around its first corner.
    Fan,
    /// Concave, or with corners on a straight line: ears.
    Ears,
    /// It crosses or touches itself, so that some triangles overlap or are turned over. (One that winds around twice
    /// without any such triangle is cut as [`Cut::Ears`].)
    NotSimple,
    /// Concave, and so large and winding that the search for ears was given up: fanned, at least in part.
    TooLarge,
}

/// Memory that is used again for each polygon.
#[derive(Default)]
pub(crate) struct Triangulator {
    points: Vec<DVec2>,
    previous: Vec<usize>,
    next: Vec<usize>,
    /// Corners that may lie in an ear: those that are not strictly convex.
    blocking: Vec<usize>,
}

impl Triangulator {
    /// Calls `emit` with the corners (0 to `corners.len() - 1`) of `corners.len() - 2` triangles, which turn as the
    /// polygon does. Fewer than three corners make none.
    pub(crate) fn triangulate(&mut self, corners: &[[f32; 3]], mut emit: impl FnMut([usize; 3])) -> Cut {
        let n = corners.len();
        if n < 3 {
            return Cut::Fan;
        }
        let cut = if n == 3 { Cut::Fan } else { self.choose(corners) };
        match cut {
            Cut::Fan => (1..n - 1).for_each(|i| emit([0, i, i + 1])),
            _ if n > MOST_CORNERS_FOR_EARS => return grid::cut_ears(&self.points, emit),
            _ => return self.cut_ears(emit),
        }
        cut
    }

    /// Whether a quadrilateral is cut from its first corner to its third: most are, and this is quicker than
    /// [`Self::triangulate`], which says the same.
    #[inline]
    pub(crate) fn is_fan_of_two(corners: [[f32; 3]; 4]) -> bool {
        let [origin, b, c, d] = corners.map(|corner| DVec3::from(corner.map(f64::from)));
        let corners = [DVec3::ZERO, b - origin, c - origin, d - origin];
        let normal = corners[1].cross(corners[2]) + corners[2].cross(corners[3]);
        if normal == DVec3::ZERO {
            return true;
        }
        let axes = Axes::across(normal);
        let [a, b, c, d] = corners.map(|corner| axes.project(corner));
        // Four turns to the left are one round: each is less than half of one.
        turn(d, a, b) > 0.0 && turn(a, b, c) > 0.0 && turn(b, c, d) > 0.0 && turn(c, d, a) > 0.0
    }

    /// Projects the polygon along the largest component of its normal, and looks whether it is convex.
    fn choose(&mut self, corners: &[[f32; 3]]) -> Cut {
        let n = corners.len();
        let origin = DVec3::from(corners[0].map(f64::from));
        let at = |i: usize| DVec3::from(corners[i].map(f64::from)) - origin;
        // Newell's normal: twice the vector area, also of a polygon that is not quite flat.
        let mut normal = DVec3::ZERO;
        for i in 1..n - 1 {
            normal += at(i).cross(at(i + 1));
        }
        if normal == DVec3::ZERO {
            return Cut::Fan;
        }
        let axes = Axes::across(normal);
        self.points.clear();
        self.points.extend((0..n).map(|i| axes.project(at(i))));
        if self.is_strictly_convex() { Cut::Fan } else { Cut::Ears }
    }

    /// Every corner turns left, and all turns together make one round: the way in x turns back twice.
    fn is_strictly_convex(&self) -> bool {
        let points = &self.points;
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

    /// Cuts ears (G. H. Meisters, 1975, "Polygons have ears") off the projected polygon until a triangle is left.
    fn cut_ears(&mut self, mut emit: impl FnMut([usize; 3])) -> Cut {
        let n = self.points.len();
        self.previous.clear();
        self.previous.extend((0..n).map(|i| (i + n - 1) % n));
        self.next.clear();
        self.next.extend((0..n).map(|i| (i + 1) % n));
        self.blocking.clear();
        for i in 0..n {
            if self.turn_at(i) <= 0.0 {
                self.blocking.push(i);
            }
        }
        let mut cut = Cut::Ears;
        let mut left = n;
        let mut here = 0;
        let mut fruitless = 0;
        while left > 3 {
            if self.is_ear(here) {
                fruitless = 0;
            } else if fruitless < left {
                fruitless += 1;
                here = self.next[here];
                continue;
            } else {
                // No ear: the polygon crosses or touches itself. The corner nearest to an ear goes.
                cut = Cut::NotSimple;
                fruitless = 0;
                here = self.least_bad(here, left);
            }
            let (before, after) = (self.previous[here], self.next[here]);
            emit([before, here, after]);
            self.next[before] = after;
            self.previous[after] = before;
            left -= 1;
            // Only the neighbours' angles changed.
            self.blocking.retain(|&i| i != here);
            for i in [before, after] {
                let blocks = self.turn_at(i) <= 0.0;
                match self.blocking.iter().position(|&b| b == i) {
                    Some(place) if !blocks => drop(self.blocking.swap_remove(place)),
                    None if blocks => self.blocking.push(i),
                    _ => {}
                }
            }
            here = after;
        }
        emit([self.previous[here], here, self.next[here]]);
        if self.turn_at(here) < 0.0 { Cut::NotSimple } else { cut }
    }

    fn turn_at(&self, i: usize) -> f64 {
        turn(self.points[self.previous[i]], self.points[i], self.points[self.next[i]])
    }

    /// A corner that turns left and whose triangle holds no other corner, its border included.
    fn is_ear(&self, here: usize) -> bool {
        let (before, after) = (self.previous[here], self.next[here]);
        let [a, b, c] = [before, here, after].map(|i| self.points[i]);
        turn(a, b, c) > 0.0
            && !self.blocking.iter().any(|&i| {
                let p = self.points[i];
                i != before
                    && i != after
                    && p != a
                    && p != b
                    && p != c
                    && turn(a, b, p) >= 0.0
                    && turn(b, c, p) >= 0.0
                    && turn(c, a, p) >= 0.0
            })
    }

    /// A corner without area, or else the smallest that turns left.
    fn least_bad(&self, start: usize, left: usize) -> usize {
        let mut best = (f64::INFINITY, start);
        let mut here = start;
        for _ in 0..left {
            let area = self.turn_at(here);
            let badness = if area < 0.0 { f64::MAX } else { area };
            if badness < best.0 {
                best = (badness, here);
            }
            here = self.next[here];
        }
        best.1
    }
}

/// The plane of two coordinate axes that a polygon is projected to, so that it turns left.
struct Axes {
    /// Which axis is left out.
    along: usize,
    /// Whether the other two change places.
    is_swapped: bool,
}

impl Axes {
    /// Across the largest component of a normal.
    #[inline]
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

    #[inline]
    fn project(&self, p: DVec3) -> DVec2 {
        let (a, b) = match self.along {
            0 => (p.y, p.z),
            1 => (p.z, p.x),
            _ => (p.x, p.y),
        };
        if self.is_swapped { DVec2::new(b, a) } else { DVec2::new(a, b) }
    }
}

/// Twice the area of the triangle: positive where it turns left.
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

    /// The quick answer for quadrilaterals is the general one.
    #[test]
    fn quadrilaterals_are_known_at_once() {
        let mut triangulator = Triangulator::default();
        let (mut fans, mut others) = (0, 0);
        for seed in 0..20_000 {
            let digit = |i: u32| ((crate::weld::mix(seed) >> (5 * i)) % 4) as f32;
            let corners: [[f32; 3]; 4] = std::array::from_fn(|c| std::array::from_fn(|i| digit((3 * c + i) as u32)));
            let is_fan = triangulator.choose(&corners) == Cut::Fan;
            assert_eq!(Triangulator::is_fan_of_two(corners), is_fan, "{corners:?}");
            if is_fan { fans += 1 } else { others += 1 }
        }
        assert!(fans > 1000 && others > 1000, "{fans} {others}");
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
