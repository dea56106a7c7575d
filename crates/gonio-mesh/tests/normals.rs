//! Normals against what geometry says they are.

#![allow(clippy::unwrap_used, missing_docs)]

use glam::Vec3;
use gonio_mesh::normals::{complete, make_averaged, make_flat};
use gonio_mesh::{Limits, Mesh, NoSidecars, NormalSource, Part, obj};

fn read(text: &str) -> Mesh {
    obj::read(text.as_bytes(), &mut NoSidecars, &Limits::default()).unwrap().mesh
}

const CUBE: &str = "v -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\nv -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\n";
const FACES: [&str; 6] = ["f 1 2 3 4\n", "f 6 5 8 7\n", "f 2 6 7 3\n", "f 5 1 4 8\n", "f 4 3 7 8\n", "f 5 6 2 1\n"];

fn cube(before_faces: [&str; 6]) -> Mesh {
    let faces: String = before_faces.iter().zip(FACES).flat_map(|(s, f)| [*s, f]).collect();
    read(&format!("{CUBE}{faces}"))
}

/// A sphere of radius 2 by latitude and longitude, each position once.
fn sphere(rings: usize, sectors: usize) -> Mesh {
    let mut positions = vec![[0.0, 2.0, 0.0]];
    for i in 1..rings {
        let polar = std::f64::consts::PI * i as f64 / rings as f64;
        for j in 0..sectors {
            let azimuth = std::f64::consts::TAU * j as f64 / sectors as f64;
            let (s, c) = polar.sin_cos();
            positions.push([2.0 * s * azimuth.sin(), 2.0 * c, 2.0 * s * azimuth.cos()].map(|x| x as f32));
        }
    }
    positions.push([0.0, -2.0, 0.0]);
    let last = positions.len() as u32 - 1;
    let at = |i: usize, j: usize| match i {
        0 => 0,
        _ if i == rings => last,
        _ => (1 + (i - 1) * sectors + j % sectors) as u32,
    };
    let mut indices = Vec::new();
    for i in 0..rings {
        for j in 0..sectors {
            let quad = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            for t in [[quad[0], quad[1], quad[2]], [quad[0], quad[2], quad[3]]] {
                if t[0] != t[1] && t[1] != t[2] && t[2] != t[0] {
                    indices.extend(t);
                }
            }
        }
    }
    let triangle_count = indices.len() / 3;
    let parts = vec![Part { triangle_count, ..Part::default() }];
    Mesh { positions, indices, parts, ..Mesh::default() }
}

/// On a sphere cut finely the averaged normal is the direction from the centre. The tolerance is the squared step of
/// the mesh: 3 degrees are 0.05 rad.
#[test]
fn averaged_normals_of_a_sphere_point_outwards() {
    let (mesh, diagnostics) = make_averaged(&sphere(60, 120));
    assert!(diagnostics.is_empty());
    assert_eq!((mesh.normal_source, mesh.normals.len()), (NormalSource::Averaged, mesh.positions.len()));
    assert_eq!(mesh.positions.len(), 59 * 120 + 2);
    for (p, n) in mesh.positions.iter().zip(&mesh.normals) {
        let (radial, n) = (0.5 * Vec3::from(*p), Vec3::from(*n));
        assert!((n.length() - 1.0).abs() < 1e-6 && n.distance(radial) < 0.05 * 0.05, "{n} at {radial}");
    }
}

#[test]
fn flat_normals_of_a_sphere_are_those_of_its_facets() {
    let mesh = make_flat(&sphere(8, 16));
    assert_eq!((mesh.normal_source, mesh.positions.len()), (NormalSource::Flat, mesh.indices.len()));
    for t in 0..mesh.triangle_count() {
        let [a, b, c] = mesh.triangle_positions(t);
        let [n0, n1, n2] = mesh.triangle(t).map(|i| Vec3::from(mesh.normals[i]));
        assert!(n0 == n1 && n1 == n2);
        // At right angles to the edges, of unit length, outwards: to a float's precision.
        assert!(n0.dot(b - a).abs() < 1e-6 && n0.dot(c - a).abs() < 1e-6 && (n0.length() - 1.0).abs() < 1e-6);
        assert!(n0.dot(a) > 0.0);
    }
}

/// A cube's corners see three right angles, however its faces are cut: the normal is the diagonal.
#[test]
fn a_smooth_cube_has_diagonal_normals() {
    for (mesh, what) in [(cube([""; 6]), "no groups"), (cube(["s 1\n"; 6]), "one group"), (cube(["s off\n"; 6]), "off")]
    {
        let (mesh, _) = make_averaged(&mesh);
        assert_eq!(mesh.positions.len(), 8, "{what}");
        for (p, n) in mesh.positions.iter().zip(&mesh.normals) {
            assert!(Vec3::from(*n).distance(Vec3::from(*p).normalize()) < 1e-6, "{what}: {n:?} at {p:?}");
        }
    }
}

#[test]
fn smoothing_groups_part_the_faces() {
    // Front and top in one group, the right in another, the rest flat.
    let (mesh, _) = make_averaged(&cube(["s 1\n", "s off\n", "s 2\n", "s 0\n", "s 1\n", "s 0\n"]));
    let x = 0.5_f32.sqrt();
    let normal_at = |t: usize, position: [f32; 3]| {
        let corner = mesh.triangle(t).into_iter().find(|&i| mesh.positions[i] == position).unwrap();
        Vec3::from(mesh.normals[corner])
    };
    // The edge that front and top share is between them, ...
    assert!(normal_at(0, [1.0, 1.0, 1.0]).distance(Vec3::Z) > 0.1);
    assert!(normal_at(0, [1.0, 1.0, 1.0]).distance(Vec3::new(0.0, x, x)) < 1e-6);
    assert!(normal_at(8, [1.0, 1.0, 1.0]).distance(Vec3::new(0.0, x, x)) < 1e-6);
    // ... the front's lower edge is the front's, and all others are flat.
    assert_eq!(normal_at(0, [-1.0, -1.0, 1.0]), Vec3::Z);
    assert_eq!(normal_at(4, [1.0, -1.0, 1.0]), Vec3::X);
    assert_eq!(normal_at(2, [1.0, -1.0, -1.0]), Vec3::NEG_Z);
    assert_eq!(normal_at(6, [-1.0, 1.0, 1.0]), Vec3::NEG_X);
    assert_eq!(normal_at(9, [-1.0, 1.0, -1.0]), Vec3::Y);
}

#[test]
fn weights_are_angles_and_do_not_see_how_a_face_is_cut() {
    // The square's corner is cut once through it and once past it; its neighbour stands upright. Equal weights would
    // make the normal of the first (1, 0, 2) and of the second (1, 0, 1).
    let through = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 0 1 1\nf 1 2 3\nf 1 3 4\nf 1 4 6 5\n";
    let past = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 0 1 1\nf 1 2 4\nf 2 3 4\nf 1 4 6 5\n";
    let x = 0.5_f32.sqrt();
    for text in [through, past] {
        let (mesh, _) = make_averaged(&read(text));
        let corner = mesh.positions.iter().position(|p| *p == [0.0; 3]).unwrap();
        assert!(Vec3::from(mesh.normals[corner]).distance(Vec3::new(x, 0.0, x)) < 1e-6, "{:?}", mesh.normals);
    }
}

#[test]
fn seams_of_texture_coordinates_stay_smooth() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 1\nvt 0 0\nvt 1 1\nf 1/1 2/1 3/1\nf 2/2 4/2 3/2\n";
    let (mesh, _) = make_averaged(&read(text));
    assert_eq!(mesh.positions.len(), 6);
    assert_eq!(mesh.normals[mesh.indices[1] as usize], mesh.normals[mesh.indices[3] as usize]);
    assert_eq!(mesh.normals[mesh.indices[2] as usize], mesh.normals[mesh.indices[5] as usize]);
}

#[test]
fn triangles_without_area_count_for_nothing() {
    // A point, a line, and a triangle that shares a corner with each.
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nf 1 2 3\nf 1 1 1\nf 1 2 4\n";
    let (mesh, diagnostics) = make_averaged(&read(text));
    let of = |i: usize| mesh.normals[mesh.indices[i] as usize];
    assert!((0..8).all(|i| of(i) == [0.0, 0.0, 1.0]), "{:?}", mesh.normals);
    assert_eq!(of(8), [0.0; 3]);
    assert_eq!(diagnostics.len(), 1);
    assert_eq!(diagnostics[0].message, "1 of 9 corners belong to triangles without area and have no normal");
    assert_eq!(make_flat(&read(text)).normals[3..], [[0.0; 3]; 6]);
}

#[test]
fn tiny_and_huge_triangles_have_normals() {
    for scale in ["1e-30", "1e30"] {
        let text = format!("v 0 0 0\nv {scale} 0 0\nv 0 {scale} 0\nf 1 2 3\n");
        assert_eq!(make_averaged(&read(&text)).0.normals, [[0.0, 0.0, 1.0]; 3], "{scale}");
        assert_eq!(make_flat(&read(&text)).normals, [[0.0, 0.0, 1.0]; 3], "{scale}");
    }
}

#[test]
fn the_two_sides_of_a_leaf_keep_their_own() {
    // Written from different corners and at odd places, so that they cancel but for rounding.
    let mut cancelled = 0;
    for i in 0..20 {
        let x = 0.1 + 0.37 * f64::from(i);
        let text = format!("v {x} 0.2 0.3\nv 1.3 {x} 0.7\nv 0.2 1.7 -{x}\nf 1 2 3\nf 2 1 3\nf 3 1 2\nf 1 3 2\n");
        let (mesh, diagnostics) = make_averaged(&read(&text));
        assert!(diagnostics.is_empty());
        let of = |i: usize| Vec3::from(mesh.normals[mesh.indices[i] as usize]);
        let [a, b, c] = mesh.triangle_positions(0);
        let normal = (b - a).cross(c - a).normalize();
        for (triangle, sign) in [1.0, -1.0, 1.0, -1.0].into_iter().enumerate() {
            for corner in 3 * triangle..3 * triangle + 3 {
                assert!(of(corner).distance(sign * normal) < 1e-5, "{} instead of {}", of(corner), sign * normal);
                cancelled += 1;
            }
        }
    }
    assert_eq!(cancelled, 240);
}

#[test]
fn complete_gives_only_what_lacks() {
    let with_all = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 1 0 0\nf 1//1 2//1 3//1\n");
    let (same, diagnostics) = complete(with_all.clone());
    assert_eq!((same, diagnostics.len()), (with_all, 0));

    let some = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 1 0 0\nf 1//1 2 3\n");
    let (mesh, diagnostics) = complete(some);
    assert_eq!(mesh.normals, [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, 1.0]]);
    assert_eq!(mesh.normal_source, NormalSource::FileAndAveraged);
    assert_eq!(diagnostics[0].message, "2 of 3 corners have no normal: it is averaged");

    let (mesh, diagnostics) = complete(cube([""; 6]));
    assert_eq!((mesh.normal_source, mesh.positions.len()), (NormalSource::Averaged, 8));
    assert_eq!(diagnostics[0].message, "there are no normals: they are averaged");

    let (mesh, diagnostics) = complete(cube(["s off\n"; 6]));
    assert_eq!((mesh.normal_source, mesh.positions.len()), (NormalSource::Flat, 36));
    assert_eq!(diagnostics[0].message, "there are no normals, and smoothing is off: each triangle has its own");
}
