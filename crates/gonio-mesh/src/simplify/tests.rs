#![allow(clippy::unwrap_used)]

use super::*;
use crate::sphere::sphere;
use crate::{Limits, NoSidecars, NormalSource, topology};
use glam::Vec3;

fn obj(text: &str) -> Mesh {
    let model = crate::obj::read(text.as_bytes(), &mut NoSidecars, &Limits::default());
    model.unwrap_or_else(|e| panic!("{e}")).mesh
}

/// A flat square of n x n quads, u and v along it, in two parts left and right of the middle.
fn sheet(n: usize) -> Mesh {
    let mut mesh = Mesh::default();
    for y in 0..=n {
        for x in 0..=n {
            let [u, v] = [x, y].map(|i| i as f32 / n as f32);
            mesh.positions.push([u, v, 0.0]);
            mesh.normals.push([0.0, 0.0, 1.0]);
            mesh.tex_coords.push([u, v]);
        }
    }
    for half in [0..n / 2, n / 2..n] {
        let first_triangle = mesh.triangle_count();
        for y in 0..n {
            for x in half.clone() {
                let at = |x: usize, y: usize| (y * (n + 1) + x) as u32;
                let [a, b, c, d] = [at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)];
                mesh.indices.extend([a, b, c, a, c, d]);
            }
        }
        let triangle_count = mesh.triangle_count() - first_triangle;
        mesh.parts.push(crate::Part {
            name: String::new(),
            material: mesh.parts.len(),
            first_triangle,
            triangle_count,
        });
    }
    mesh
}

fn area(mesh: &Mesh) -> f32 {
    let of = |t| {
        let [a, b, c] = mesh.triangle_positions(t);
        0.5 * (b - a).cross(c - a).length()
    };
    (0..mesh.triangle_count()).map(of).sum()
}

#[test]
fn a_sphere_stays_round_and_closed() {
    let fine = sphere(16).unwrap();
    for target in [1000, 500, 200, 60] {
        let coarse = simplify(&fine, target);
        let count = coarse.triangle_count();
        // A collapse takes two triangles.
        assert!(count <= target && count + 2 > target, "{count} of {target}");
        assert!(topology::is_closed_outward(&coarse), "{target}");
        for (p, n) in coarse.positions.iter().zip(&coarse.normals) {
            assert!(fine.positions.contains(p) && p == n, "vertices are those of the fine sphere");
        }
        // How deep a triangle's middle lies below the sphere. A regular triangle of this share of the sphere has the
        // squared edge 16 pi / (sqrt(3) count), its middle is about a sixth of that below; five times as much is
        // left for shapes that are not regular.
        let sag = 5.0 * 16.0 * std::f32::consts::PI / 3.0_f32.sqrt() / count as f32 / 6.0;
        for t in 0..count {
            let [a, b, c] = coarse.triangle_positions(t);
            let middle: Vec3 = (a + b + c) / 3.0;
            assert!(1.0 - middle.length() < sag, "{target}: triangle {t} lies {} deep", 1.0 - middle.length());
        }
    }
}

/// Collapsing flat parts costs nothing: the sheet's outline, seam and texture stay the same.
#[test]
fn a_sheet_keeps_its_outline() {
    let fine = sheet(8);
    let coarse = simplify(&fine, 24);
    assert!(coarse.triangle_count() <= 24 && coarse.triangle_count() > 20);
    let halves: Vec<_> = coarse.parts.iter().map(|p| (p.material, p.first_triangle)).collect();
    assert_eq!(halves, [(0, 0), (1, coarse.parts[0].triangle_count)]);
    assert!((area(&coarse) - 1.0).abs() < 1e-6);
    for (p, uv) in coarse.positions.iter().zip(&coarse.tex_coords) {
        assert_eq!(p[..2], uv[..]);
    }
}

#[test]
fn a_cube_keeps_its_twelve_triangles() {
    let cube = obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n\
                    f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
    let flat = normals::make_flat(&cube);
    assert_eq!(simplify(&flat, 1).triangle_count(), 12, "its edges are where normals change");
    // Without normals its corners are places like all others; one of them is gone.
    let coarse = simplify(&cube, 10);
    assert_eq!(coarse.triangle_count(), 10);
    assert!(topology::is_closed_outward(&coarse));
}

/// One normal per triangle is no reason to keep each triangle.
#[test]
fn facets_are_joined_and_made_anew() {
    let fine = normals::make_flat(&sphere(8).unwrap());
    let coarse = simplify(&fine, 100);
    assert!(coarse.triangle_count() <= 100);
    assert_eq!(coarse.positions.len(), 3 * coarse.triangle_count());
    assert_eq!(coarse.normal_source, NormalSource::Flat);
    for t in 0..coarse.triangle_count() {
        let [a, b, c] = coarse.triangle_positions(t);
        let normal = Vec3::from(coarse.normals[3 * t]);
        // Rounded to f32.
        assert!((b - a).cross(c - a).normalize().dot(normal) > 1.0 - 1e-5);
    }
}

#[test]
fn nothing_is_done_where_there_are_few() {
    let mesh = sphere(2).unwrap();
    assert_eq!(simplify(&mesh, 32), mesh);
    assert_eq!(simplify(&Mesh::default(), 0), Mesh::default());
}
