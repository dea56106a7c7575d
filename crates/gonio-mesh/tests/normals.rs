//! Normals of shapes whose normals are known.

#![allow(clippy::unwrap_used, missing_docs)]

use glam::Vec3;
use gonio_mesh::normals::{Averaging, complete, complete_with, make_averaged, make_averaged_with, make_flat};
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
fn complete_adds_only_missing_normals() {
    let with_all = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 1 0 0\nf 1//1 2//1 3//1\n");
    let (same, diagnostics) = complete(with_all.clone());
    assert_eq!((same, diagnostics.len()), (with_all, 0));

    let some = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 1 0 0\nf 1//1 2 3\n");
    let (mesh, diagnostics) = complete(some);
    assert_eq!(mesh.normals, [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, 1.0]]);
    assert_eq!(mesh.normal_source, NormalSource::FileAndAveraged);
    assert_eq!(diagnostics[0].message, "2 of 3 corners have no normal: using averaged normals");

    let (mesh, diagnostics) = complete(cube([""; 6]));
    assert_eq!((mesh.normal_source, mesh.positions.len()), (NormalSource::Averaged, 8));
    assert_eq!(diagnostics[0].message, "there are no normals: they are averaged");

    let (mesh, diagnostics) = complete(cube(["s off\n"; 6]));
    assert_eq!((mesh.normal_source, mesh.positions.len()), (NormalSource::Flat, 36));
    assert_eq!(diagnostics[0].message, "there are no normals, and smoothing is off: the triangles are flat");
}

fn creased(mesh: &Mesh, degrees: f64) -> Mesh {
    make_averaged_with(mesh, &Averaging { crease_angle_rad: Some(degrees.to_radians()) }).0
}

fn normal_of_corner(mesh: &Mesh, corner: usize) -> Vec3 {
    Vec3::from(mesh.normals[mesh.indices[corner] as usize])
}

/// A cube's faces meet at 90 degrees: less keeps its edges, no less rounds them.
#[test]
fn a_cube_is_creased_below_a_right_angle() {
    let (all, _) = make_averaged(&cube([""; 6]));
    for degrees in [0.0, 30.0, 89.99] {
        let mesh = creased(&cube([""; 6]), degrees);
        assert_eq!((mesh.positions.len(), mesh.normal_source), (24, NormalSource::Averaged), "{degrees}");
        let flat = make_flat(&cube([""; 6]));
        for corner in 0..36 {
            assert_eq!(normal_of_corner(&mesh, corner), normal_of_corner(&flat, corner), "{degrees}");
        }
    }
    for degrees in [90.0, 120.0, 180.0, 360.0, f64::NAN] {
        let mesh = creased(&cube([""; 6]), degrees);
        assert_eq!(mesh.positions.len(), 8, "{degrees}");
        for corner in 0..36 {
            assert!(normal_of_corner(&mesh, corner).distance(normal_of_corner(&all, corner)) < 1e-7, "{degrees}");
        }
    }
    assert_eq!(creased(&cube([""; 6]), 180.0), all);
    assert_eq!(make_averaged_with(&cube(["s 1\n"; 6]), &Averaging::default()), make_averaged(&cube(["s 1\n"; 6])));
}

/// A tin of 36 sides: they meet at 10 degrees, the lids at 90. With 30 degrees the wall is round, each of its corners
/// being the mean of two sides, and the lid flat.
#[test]
fn a_tin_has_a_round_wall_and_flat_lids() {
    let mut text = String::new();
    let rim = |i: usize| std::f64::consts::TAU * i as f64 / 36.0;
    for (z, i) in [-1, 1].into_iter().flat_map(|z| (0..36).map(move |i| (z, i))) {
        text.push_str(&format!("v {} {} {z}\n", rim(i).cos(), rim(i).sin()));
    }
    let list = |corners: Vec<usize>| corners.iter().map(|c| format!(" {}", c + 1)).collect::<String>();
    text.push_str(&format!("f{}\nf{}\n", list((36..72).collect()), list((0..36).rev().collect())));
    for i in 0..36 {
        let next = (i + 1) % 36;
        text.push_str(&format!("f{}\n", list(vec![i, next, next + 36, i + 36])));
    }
    let mesh = creased(&read(&text), 30.0);
    assert_eq!((mesh.triangle_count(), mesh.positions.len()), (140, 144));
    for (corner, &vertex) in mesh.indices.iter().enumerate() {
        let [x, y, z] = mesh.positions[vertex as usize];
        let expected = if corner < 3 * 68 { Vec3::new(0.0, 0.0, z) } else { Vec3::new(x, y, 0.0) };
        assert!(normal_of_corner(&mesh, corner).distance(expected) < 1e-6, "corner {corner}");
    }
}

/// Three leaves of a book, 40 degrees apart. Each is held against the corner's own face: with 45 degrees the middle
/// one sees all three, and the outer ones two.
#[test]
fn a_crease_is_measured_from_the_corners_own_face() {
    let leaf = |degrees: f64| {
        let (s, c) = degrees.to_radians().sin_cos();
        format!("v 0 {c} {s}\n")
    };
    let text = format!("v 0 0 0\nv 1 0 0\n{}{}{}f 1 2 3\nf 1 2 4\nf 1 2 5\n", leaf(0.0), leaf(40.0), leaf(80.0));
    let along = |degrees: f64| {
        let (s, c) = degrees.to_radians().sin_cos();
        Vec3::new(0.0, -s as f32, c as f32)
    };
    for (crease, expected) in [(45.0, [20.0, 40.0, 60.0]), (39.0, [0.0, 40.0, 80.0]), (85.0, [40.0; 3])] {
        let mesh = creased(&read(&text), crease);
        for (leaf, degrees) in expected.into_iter().enumerate() {
            assert!(normal_of_corner(&mesh, 3 * leaf).distance(along(degrees)) < 1e-6, "{crease}, leaf {leaf}");
        }
    }
}

#[test]
fn creases_lie_within_smoothing_groups() {
    // Front and top in one group, the rest in another; nothing is rounder than without the crease.
    let groups = ["s 1\n", "s 2\n", "s 2\n", "s 2\n", "s 1\n", "s off\n"];
    let (all, _) = make_averaged(&cube(groups));
    let rounded = creased(&cube(groups), 100.0);
    for corner in 0..36 {
        assert!(normal_of_corner(&rounded, corner).distance(normal_of_corner(&all, corner)) < 1e-7);
    }
    assert_eq!(creased(&cube(groups), 45.0).positions.len(), 24);
    // Where all are off and averaging is asked for, they count as none.
    assert_eq!(creased(&cube(["s off\n"; 6]), 100.0).positions.len(), 8);
    let averaging = Averaging { crease_angle_rad: Some(1.0) };
    let (mesh, diagnostics) = complete_with(cube([""; 6]), &averaging);
    assert_eq!((mesh.positions.len(), diagnostics.len()), (24, 1));
}

/// Triangles with one common corner, whose normals are `normals`, all with the same angle there.
fn star(normals: &[Vec3]) -> Mesh {
    let mut mesh = Mesh { positions: vec![[0.0; 3]], ..Mesh::default() };
    for normal in normals {
        let (a, b) = normal.any_orthonormal_pair();
        let first = mesh.positions.len() as u32;
        mesh.positions.extend([a.to_array(), b.to_array()]);
        mesh.indices.extend([0, first, first + 1]);
    }
    mesh
}

/// Directions all over the sphere: a spiral (E. B. Saff and A. B. J. Kuijlaars, 1997).
fn directions(count: usize) -> Vec<Vec3> {
    let spiral = |i: usize| {
        let z = 1.0 - 2.0 * (i as f64 + 0.5) / count as f64;
        let (s, c) = (2.399_963_229_728_653 * i as f64).sin_cos();
        let r = (1.0 - z * z).sqrt();
        Vec3::new((r * c) as f32, (r * s) as f32, z as f32)
    };
    (0..count).map(spiral).collect()
}

/// Many faces around one place are found another way than few: the answer is the definition's. On the spiral hardly
/// any face lies just on the edge of the crease, where rounding decides.
#[test]
fn crowded_places_follow_the_definition() {
    for (count, degrees) in [(60, 50.0), (65, 50.0), (3000, 25.0), (3000, 140.0)] {
        let normals = directions(count);
        let mesh = creased(&star(&normals), degrees);
        let least = degrees.to_radians().cos() as f32;
        for (t, own) in normals.iter().enumerate().step_by(count / 60) {
            let near = normals.iter().filter(|n| n.dot(*own) >= least);
            let sum = near.fold(glam::DVec3::ZERO, |sum, n| sum + n.as_dvec3());
            let expected = sum.normalize().as_vec3();
            // One face more or less of some thousand moves the mean by less than this.
            let tolerance = if count > 100 { 2e-3 } else { 1e-5 };
            let found = normal_of_corner(&mesh, 3 * t);
            assert!(found.distance(expected) < tolerance, "{count}, {degrees}: {found} instead of {expected}");
        }
    }
}

/// With more faces around one place than are told apart, those of nearly one direction are one: the mean of the many
/// faces within 40 degrees is the own direction, to a fraction of a cell of 1.6 degrees.
#[test]
fn overcrowded_places_are_survived() {
    let normals = directions(70_000);
    let mesh = creased(&star(&normals), 40.0);
    for (t, own) in normals.iter().enumerate().step_by(500) {
        assert!(normal_of_corner(&mesh, 3 * t).distance(*own) < 0.03, "{t}");
    }
}

/// The tip of a cone with 20,000 faces: each corner's mean leans by symmetry in its own face's direction.
#[test]
fn the_tip_of_a_cone() {
    let count = 20_000;
    let normals: Vec<Vec3> = (0..count)
        .map(|i| {
            let (s, c) = (std::f64::consts::TAU * f64::from(i) / f64::from(count)).sin_cos();
            Vec3::new((0.6 * c) as f32, (0.6 * s) as f32, 0.8)
        })
        .collect();
    let mesh = creased(&star(&normals), 20.0);
    for (t, own) in normals.iter().enumerate().step_by(97) {
        let found = normal_of_corner(&mesh, 3 * t);
        let (x, y) = (own.x / 0.6, own.y / 0.6);
        // A right angle to the side; less steep than the face, but no less than the chord of 20 degrees allows.
        assert!((found.x * y - found.y * x).abs() < 1e-3, "{found} at {own}");
        assert!(found.z > 0.8 && found.z < 0.83, "{found}");
    }
}

/// A flat face cut into triangles stays one, also at a crease angle of 0; faces without area take what is there.
#[test]
fn a_crease_of_0_keeps_flat_faces_whole() {
    let text = "v 0.1 0.2 0.3\nv 1.1 0.2 0.3\nv 1.1 1.2 0.3\nv 0.1 1.2 0.3\nf 1 2 3\nf 1 3 4\nf 1 3 3\n";
    let (mesh, diagnostics) = make_averaged_with(&read(text), &Averaging { crease_angle_rad: Some(0.0) });
    assert_eq!((mesh.positions.len(), diagnostics.len()), (4, 0));
    assert!(mesh.normals.iter().all(|n| *n == [0.0, 0.0, 1.0]), "{:?}", mesh.normals);
}
