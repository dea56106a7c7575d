//! Generated large OBJ files.

use std::f64::consts::{PI, TAU};
use std::fmt::Write;

/// Writes the vertices of a grid on the unit sphere, from north to south, `sectors + 1` in each ring: first all `v`, then all
/// `vt`, then all `vn`.
fn write_grid(text: &mut String, sectors: usize, ring_angles: &[f64]) {
    let points: Vec<[f64; 3]> = ring_angles
        .iter()
        .flat_map(|theta| {
            (0..=sectors).map(|sector| {
                let phi = TAU * sector as f64 / sectors as f64;
                [theta.sin() * phi.cos(), theta.cos(), -theta.sin() * phi.sin()]
            })
        })
        .collect();
    for [x, y, z] in &points {
        let _ = writeln!(text, "v {x:.6} {y:.6} {z:.6}");
    }
    for theta in ring_angles {
        for sector in 0..=sectors {
            let _ = writeln!(text, "vt {:.6} {:.6}", sector as f64 / sectors as f64, 1.0 - theta / PI);
        }
    }
    for [x, y, z] in &points {
        let _ = writeln!(text, "vn {x:.6} {y:.6} {z:.6}");
    }
}

/// Returns a unit sphere of `2 * n * (n - 1)` triangles, `n` sectors and `n` rings of them, with texture coordinates and
/// normals.
pub fn uv_sphere(n: usize) -> String {
    let mut text = String::with_capacity(n * n * 225);
    let angles: Vec<f64> = (0..=n).map(|ring| PI * ring as f64 / n as f64).collect();
    write_grid(&mut text, n, &angles);
    for ring in 0..n {
        for sector in 0..n {
            let (a, b) = (ring * (n + 1) + sector + 1, (ring + 1) * (n + 1) + sector + 1);
            let (c, d) = (a + 1, b + 1);
            if ring > 0 {
                let _ = writeln!(text, "f {a}/{a}/{a} {b}/{b}/{b} {c}/{c}/{c}");
            }
            if ring + 1 < n {
                let _ = writeln!(text, "f {c}/{c}/{c} {b}/{b}/{b} {d}/{d}/{d}");
            }
        }
    }
    text
}

/// Triangles of [`ngon_sphere`].
pub const NGON_TRIANGLES: u64 = 1_001_820;

/// A sphere of polygons with negative indices: rows of quadrilaterals, every third row of hexagons, caps of 708 corners,
/// and a concave star of 714 corners beside it.
pub fn ngon_sphere() -> String {
    const SECTORS: usize = 708;
    const ROWS: usize = 706;
    const STAR: usize = 714;
    let mut text = String::with_capacity(100 << 20);
    let angles: Vec<f64> = (0..=ROWS).map(|ring| PI * (ring + 1) as f64 / (ROWS + 2) as f64).collect();
    write_grid(&mut text, SECTORS, &angles);
    for corner in 0..STAR {
        let (sin, cos) = (TAU * corner as f64 / STAR as f64).sin_cos();
        let radius = if corner % 2 == 0 { 1.0 } else { 0.8 };
        let _ = writeln!(text, "v {:.6} {:.6} 0.000000\nvt 0.5 0.5\nvn 0 0 1", radius * cos + 3.0, radius * sin);
    }
    let count = (ROWS + 1) * (SECTORS + 1) + STAR;
    let mut face = |corners: &mut dyn Iterator<Item = usize>| {
        text.push('f');
        for corner in corners {
            let back = count - corner;
            let _ = write!(text, " -{back}/-{back}/-{back}");
        }
        text.push('\n');
    };
    for row in 0..ROWS {
        let (upper, lower) = (row * (SECTORS + 1), (row + 1) * (SECTORS + 1));
        let step = if row % 3 == 2 { 2 } else { 1 };
        for sector in (0..SECTORS).step_by(step) {
            let below = (0..=step).map(|i| lower + sector + i);
            let above = (0..=step).rev().map(|i| upper + sector + i);
            face(&mut below.chain(above));
        }
    }
    face(&mut (0..SECTORS));
    face(&mut (0..SECTORS).rev().map(|sector| ROWS * (SECTORS + 1) + sector));
    face(&mut (count - STAR..count));
    text
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    /// Triangles by counting corners, and whether every index is there.
    fn triangles(text: &str) -> u64 {
        let vertices = text.lines().filter(|line| line.starts_with("v ")).count() as i64;
        let faces = text.lines().filter_map(|line| line.strip_prefix("f "));
        faces
            .map(|face| {
                let mut corners = 0;
                for index in face.split(' ').flat_map(|corner| corner.split('/')) {
                    let index: i64 = index.parse().unwrap();
                    assert!((1..=vertices).contains(&index) || (-vertices..0).contains(&index), "{face}");
                    corners += 1;
                }
                corners / 3 - 2
            })
            .sum()
    }

    #[test]
    fn files_have_the_stated_number_of_triangles() {
        assert_eq!(triangles(&uv_sphere(12)), 2 * 12 * 11);
        assert_eq!(triangles(&ngon_sphere()), NGON_TRIANGLES);
    }
}
