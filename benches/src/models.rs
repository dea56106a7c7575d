//! Generated models with a known number of triangles.

use std::f64::consts::{PI, TAU};
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// Returns a torus of `2 * around * along` triangles with normals and texture coordinates, as OBJ.
pub fn torus_obj(around: usize, along: usize) -> String {
    let (major, minor) = (1.0, 0.4);
    let mut text = String::from("# a torus\no torus\n");
    for i in 0..around {
        let (sin_u, cos_u) = (TAU * i as f64 / around as f64).sin_cos();
        for j in 0..along {
            let (sin_v, cos_v) = (TAU * j as f64 / along as f64).sin_cos();
            let ring = major + minor * cos_v;
            let _ = writeln!(text, "v {:.6} {:.6} {:.6}", ring * cos_u, minor * sin_v, -ring * sin_u);
            let _ = writeln!(text, "vn {:.6} {:.6} {:.6}", cos_v * cos_u, sin_v, -cos_v * sin_u);
        }
    }
    // The seams need separate texture coordinates.
    for i in 0..=around {
        for j in 0..=along {
            let _ = writeln!(text, "vt {:.6} {:.6}", i as f64 / around as f64, j as f64 / along as f64);
        }
    }
    for i in 0..around {
        for j in 0..along {
            let corner = |di: usize, dj: usize| {
                let vertex = ((i + di) % around) * along + (j + dj) % along + 1;
                let coordinates = (i + di) * (along + 1) + (j + dj) + 1;
                format!("{vertex}/{coordinates}/{vertex}")
            };
            let (a, b, c, d) = (corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1));
            let _ = writeln!(text, "f {a} {b} {c}\nf {a} {c} {d}");
        }
    }
    text
}

/// Returns a closed unit sphere of `2 * sectors * (rings - 1)` triangles with normals, as OBJ.
pub fn sphere_obj(sectors: usize, rings: usize) -> String {
    let mut text = String::with_capacity(sectors * rings * 150);
    text.push_str("# a unit sphere\no sphere\n");
    let mut point = |x: f64, y: f64, z: f64| {
        let _ = writeln!(text, "v {x:.7} {y:.7} {z:.7}\nvn {x:.7} {y:.7} {z:.7}");
    };
    point(0.0, 1.0, 0.0);
    for ring in 1..rings {
        let (sin_theta, cos_theta) = (0.5 * TAU * ring as f64 / rings as f64).sin_cos();
        for sector in 0..sectors {
            let (sin_phi, cos_phi) = (TAU * sector as f64 / sectors as f64).sin_cos();
            point(sin_theta * cos_phi, cos_theta, -sin_theta * sin_phi);
        }
    }
    point(0.0, -1.0, 0.0);
    let south = 2 + (rings - 1) * sectors;
    let at = |ring: usize, sector: usize| 2 + (ring - 1) * sectors + sector % sectors;
    let mut face = |a: usize, b: usize, c: usize| {
        let _ = writeln!(text, "f {a}//{a} {b}//{b} {c}//{c}");
    };
    for sector in 0..sectors {
        face(1, at(1, sector), at(1, sector + 1));
        face(south, at(rings - 1, sector + 1), at(rings - 1, sector));
    }
    for ring in 1..rings - 1 {
        for sector in 0..sectors {
            let (a, b) = (at(ring, sector), at(ring + 1, sector));
            let (c, d) = (at(ring + 1, sector + 1), at(ring, sector + 1));
            face(a, b, c);
            face(a, c, d);
        }
    }
    text
}

/// Writes a model into `folder` if it does not exist yet, and returns its path.
pub fn written(folder: &Path, name: &str, make: impl FnOnce() -> String) -> Result<PathBuf, String> {
    let path = folder.join(name);
    if !path.exists() {
        // Renamed when it is complete.
        let part = folder.join(format!("{name}.part"));
        std::fs::write(&part, make())
            .and_then(|()| std::fs::rename(&part, &path))
            .map_err(|e| format!("cannot write {}: {e}", path.display()))?;
    }
    Ok(path)
}

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

    /// Positions and triangles of an OBJ as written here.
    fn read(text: &str) -> (Vec<[f64; 3]>, Vec<[usize; 3]>) {
        let three = |line: &str| -> Vec<f64> {
            line.split_whitespace().skip(1).map(|w| w.split('/').next().unwrap().parse().unwrap()).collect()
        };
        let positions = text.lines().filter(|l| l.starts_with("v ")).map(|l| three(l).try_into().unwrap()).collect();
        let triangles = text
            .lines()
            .filter(|l| l.starts_with("f "))
            .map(|l| {
                let corners = three(l);
                [corners[0] as usize - 1, corners[1] as usize - 1, corners[2] as usize - 1]
            })
            .collect();
        (positions, triangles)
    }

    /// Every edge is passed once each way, and the enclosed volume (divergence theorem) is `volume`
    /// within 1 %, because facets are inside the surface.
    fn assert_closed(text: &str, triangle_count: usize, volume: f64) {
        let (positions, triangles) = read(text);
        assert_eq!(triangles.len(), triangle_count);
        let mut edges = std::collections::HashMap::new();
        let mut enclosed = 0.0;
        for t in &triangles {
            for k in 0..3 {
                *edges.entry((t[k], t[(k + 1) % 3])).or_insert(0) += 1;
            }
            let [a, b, c] = t.map(|i| positions[i]);
            let cross = [b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]];
            enclosed += (a[0] * cross[0] + a[1] * cross[1] + a[2] * cross[2]) / 6.0;
        }
        assert!(edges.iter().all(|(&(a, b), &n)| n == 1 && edges.get(&(b, a)) == Some(&1)));
        assert!((enclosed / volume - 1.0).abs() < 0.01, "{enclosed} {volume}");
    }

    #[test]
    fn models_are_closed_and_have_the_stated_volume() {
        assert_closed(&torus_obj(50, 50), 5000, 0.5 * TAU * 0.4 * 0.4 * TAU);
        assert_closed(&sphere_obj(50, 51), 5000, 2.0 / 3.0 * TAU);
    }

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
