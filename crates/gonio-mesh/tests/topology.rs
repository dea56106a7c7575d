//! The connectivity of triangles of shapes whose numbers are known on paper.

#![allow(clippy::unwrap_used, missing_docs)]

use gonio_mesh::Mesh;
use gonio_mesh::topology::{TopologyReport, is_closed_outward, report};

fn mesh(positions: &[[f32; 3]], indices: &[u32]) -> Mesh {
    Mesh { positions: positions.to_vec(), indices: indices.to_vec(), ..Mesh::default() }
}

/// The corner of a cube, front faces outside: volume 1/6.
fn tetrahedron() -> Mesh {
    let positions = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    mesh(&positions, &[0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3])
}

/// Edge length 2, around the origin.
fn cube() -> Mesh {
    let positions: Vec<[f32; 3]> = (0..8).map(|i| [1, 2, 4].map(|bit| if i & bit == 0 { -1.0 } else { 1.0 })).collect();
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let indices: Vec<u32> = quads.iter().flat_map(|[a, b, c, d]| [*a, *b, *c, *a, *c, *d]).collect();
    mesh(&positions, &indices)
}

/// `around` by `across` squares, each cut in two; joined at both ends, perhaps turned over on the way around.
fn ring(around: u32, across: u32, is_twisted: bool) -> Mesh {
    let at = |i: u32, j: u32| {
        let (i, j) =
            if i == around { (0, if is_twisted { (across - j % across) % across } else { j }) } else { (i, j) };
        i * across + j % across
    };
    let mut positions = Vec::new();
    let mut indices = Vec::new();
    for i in 0..around {
        for j in 0..across {
            let (a, b) = (f64::from(i) / f64::from(around), f64::from(j) / f64::from(across));
            let (a, b) = (std::f64::consts::TAU * a, std::f64::consts::TAU * b);
            let radius = 3.0 + b.cos();
            positions.push([radius * a.cos(), radius * a.sin(), b.sin()].map(|x| x as f32));
            let quad = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            indices.extend([quad[0], quad[1], quad[2], quad[0], quad[2], quad[3]]);
        }
    }
    mesh(&positions, &indices)
}

/// A strip of `count` squares whose ends are joined after half a turn.
fn moebius(count: u32) -> Mesh {
    let mut positions = Vec::new();
    let mut indices = Vec::new();
    for i in 0..count {
        let turn = std::f64::consts::TAU * f64::from(i) / f64::from(count);
        for side in [-1.0, 1.0] {
            let (out, up) = (2.0 + side * (0.5 * turn).cos(), side * (0.5 * turn).sin());
            positions.push([out * turn.cos(), out * turn.sin(), up].map(|x| x as f32));
        }
        let (a, b) = (2 * i, 2 * i + 1);
        let (c, d) = if i + 1 == count { (1, 0) } else { (a + 2, b + 2) };
        indices.extend([a, c, d, a, d, b]);
    }
    mesh(&positions, &indices)
}

fn both(mut a: Mesh, b: &Mesh, move_by: f32) -> Mesh {
    let offset = a.positions.len() as u32;
    a.positions.extend(b.positions.iter().map(|[x, y, z]| [x + move_by, *y, *z]));
    a.indices.extend(b.indices.iter().map(|i| i + offset));
    a
}

/// Kinds of oddities that have been found.
fn odd(report: &TopologyReport) -> Vec<(&'static str, u64)> {
    let kinds = [
        ("degenerate", &report.degenerate_triangles),
        ("duplicate", &report.duplicate_triangles),
        ("back to back", &report.back_to_back_triangles),
        ("boundary", &report.boundary_edges),
        ("non-manifold edge", &report.non_manifold_edges),
        ("inconsistent", &report.inconsistent_edges),
        ("non-manifold position", &report.non_manifold_positions),
    ];
    for (kind, findings) in kinds {
        assert_eq!(findings.first.len() as u64, findings.count.min(5), "{kind}");
    }
    kinds.into_iter().filter(|(_, findings)| findings.count > 0).map(|(kind, f)| (kind, f.count)).collect()
}

fn sizes(report: &TopologyReport) -> [i64; 4] {
    [report.positions as i64, report.edges as i64, report.triangles as i64, report.euler_characteristic]
}

#[test]
fn solids() {
    for (mesh, size, volume, area) in [
        (tetrahedron(), [4, 6, 4, 2], 1.0 / 6.0, 1.5 + 0.75_f64.sqrt()),
        (cube(), [8, 18, 12, 2], 8.0, 24.0),
        // Seams do not matter.
        (cube().unshared(), [8, 18, 12, 2], 8.0, 24.0),
    ] {
        let report = report(&mesh);
        assert_eq!((sizes(&report), odd(&report)), (size, vec![]));
        assert_eq!((report.pieces, report.genus, report.triangles_to_turn), (1, Some(0), 0));
        assert!(report.closed && report.outward && report.orientable && is_closed_outward(&mesh));
        // To a few units in the last place.
        assert!((report.volume.unwrap() - volume).abs() < 1e-14 && (report.area - area).abs() < 1e-13);
    }
}

#[test]
fn rings() {
    let one = report(&ring(12, 8, false));
    assert_eq!((sizes(&one), odd(&one), one.genus), ([96, 288, 192, 0], vec![], Some(1)));
    assert!(one.closed && one.outward);
    let two = report(&both(ring(12, 8, false), &ring(5, 4, false), 20.0));
    assert_eq!((two.pieces, two.euler_characteristic, two.genus, odd(&two)), (2, 0, Some(2), vec![]));
    let with_ball = report(&both(ring(12, 8, false), &cube(), 20.0));
    assert_eq!((with_ball.pieces, with_ball.euler_characteristic, with_ball.genus), (2, 2, Some(1)));
}

/// Neither has two sides. The strip has one edge all around, of two sides for each square; the bottle none.
#[test]
fn one_sided_surfaces() {
    let strip = report(&moebius(10));
    assert_eq!(sizes(&strip), [20, 40, 20, 0]);
    assert_eq!(odd(&strip), [("boundary", 20), ("inconsistent", 1)]);
    assert!(!strip.orientable && !strip.closed && strip.genus.is_none() && strip.volume.is_none());
    let bottle = report(&ring(12, 8, true));
    assert_eq!((sizes(&bottle), odd(&bottle)), ([96, 288, 192, 0], vec![("inconsistent", 8)]));
    assert!(!bottle.orientable && !bottle.closed && bottle.genus.is_none());
}

#[test]
fn tetrahedra_that_share_too_little() {
    let positions = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]];
    // The edge from 0 to 1: 6 positions, 11 edges.
    let edge = mesh(&positions, &[0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3, 0, 4, 1, 0, 1, 5, 0, 5, 4, 1, 4, 5]);
    let edge_report = report(&edge);
    assert_eq!((sizes(&edge_report), odd(&edge_report)), ([6, 11, 8, 3], vec![("non-manifold edge", 1)]));
    let place = &edge_report.non_manifold_edges.first[0];
    assert_eq!(place.positions, [[0.0; 3], [1.0, 0.0, 0.0]]);
    assert_eq!(place.triangles, [0, 1, 4, 5]);
    assert!(edge_report.closed && edge_report.genus.is_none() && edge_report.pieces == 1);

    // Tip to tip: 7 positions, 12 edges.
    let tip = report(&both(
        tetrahedron(),
        &mesh(
            &[[0.0; 3], [-2.0, 0.0, 0.0], [-1.0, -1.0, 0.0], [-1.0, 0.0, -1.0]],
            &[0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2],
        ),
        0.0,
    ));
    assert_eq!((sizes(&tip), odd(&tip)), ([7, 12, 8, 3], vec![("non-manifold position", 1)]));
    assert_eq!(tip.non_manifold_positions.first[0].positions, [[0.0; 3]]);
    assert_eq!(tip.non_manifold_positions.first[0].triangles, [0, 4]);
    assert!(tip.closed && tip.genus.is_none() && tip.pieces == 1);
}

#[test]
fn holes() {
    let mut open = cube();
    open.indices.truncate(30);
    let found = report(&open);
    assert_eq!((sizes(&found), odd(&found)), ([8, 17, 10, 1], vec![("boundary", 4)]));
    assert!(!found.closed && found.orientable && found.genus.is_none() && found.volume.is_none());
    // The last face was that of x = 1, whose corners are 1, 3, 5, 7; edges are listed from their lower end.
    let ends: Vec<[f32; 3]> = found.boundary_edges.first.iter().flat_map(|f| f.positions.clone()).collect();
    assert!(ends.len() == 8 && ends.iter().all(|p| p[0] == 1.0), "{ends:?}");
    assert!(found.boundary_edges.first.iter().all(|f| f.triangles.len() == 1));
}

#[test]
fn turned_triangles() {
    let mut turned = cube();
    turned.indices.swap(6, 7);
    let found = report(&turned);
    assert_eq!((odd(&found), found.triangles_to_turn), (vec![("inconsistent", 3)], 1));
    assert!(!found.closed && found.orientable);
    assert_eq!(found.genus, Some(0), "it is a ball, however it is wound");
    assert!(found.inconsistent_edges.first.iter().all(|f| f.triangles.contains(&2)), "{found:?}");
    // All of them: nothing contradicts, but the inside is outside.
    let mut inside_out = cube();
    inside_out.indices.chunks_exact_mut(3).for_each(|t| t.swap(0, 1));
    let found = report(&inside_out);
    assert_eq!((odd(&found), found.triangles_to_turn, found.volume), (vec![], 0, Some(-8.0)));
    assert!(found.closed && !found.outward);
    // One piece of two: closed, but not outward.
    let found = report(&both(inside_out, &ring(12, 8, false), 20.0));
    assert!(found.closed && !found.outward && found.volume.unwrap() > 0.0);
}

/// However many are turned, and in whatever order the triangles stand: the fewest to turn back are those, as long as
/// they are fewer than half.
#[test]
fn many_turned_triangles() {
    let whole = ring(24, 16, false);
    let count = whole.triangle_count();
    for (step, turned_in) in [(1, 7), (5, 3), (77, 3), (383, 5)] {
        let mut mesh = whole.clone();
        // A step without a common divisor with their number visits each once.
        let order = (0..count).map(|i| i * step % count);
        mesh.indices = order.flat_map(|t| whole.indices[3 * t..3 * t + 3].to_vec()).collect();
        (0..count).filter(|t| t % turned_in == 0).for_each(|t| mesh.indices.swap(3 * t, 3 * t + 1));
        let found = report(&mesh);
        assert_eq!(found.triangles_to_turn, count.div_ceil(turned_in) as u64, "{step}");
        assert!(found.orientable && !found.closed && found.genus == Some(1), "{step}");
    }
}

#[test]
fn triangles_that_are_there_twice_or_have_no_area() {
    let positions = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [2.0, 0.0, 0.0], [0.0; 3]];
    let found = report(&mesh(&positions, &[0, 1, 2, 1, 2, 4, 0, 2, 1]));
    // The second is the first from another corner on (4 is where 0 is), the third its back.
    assert_eq!(odd(&found), [("duplicate", 1), ("back to back", 1), ("non-manifold edge", 3)]);
    assert_eq!(found.duplicate_triangles.first[0].triangles, [0, 1]);
    assert_eq!(found.back_to_back_triangles.first[0].triangles, [0, 2]);

    let found = report(&mesh(&positions, &[0, 1, 2, 0, 1, 1, 0, 4, 2, 0, 0, 0]));
    assert_eq!((sizes(&found), odd(&found)), ([3, 3, 4, 1], vec![("degenerate", 3), ("boundary", 3)]));
    let degenerate: Vec<usize> = found.degenerate_triangles.first.iter().flat_map(|f| f.triangles.clone()).collect();
    assert_eq!(degenerate, [1, 2, 3]);
    // On a line, with three positions: without area, and yet it joins what is on both sides of it.
    let found = report(&mesh(&positions, &[0, 1, 3]));
    assert_eq!((sizes(&found), odd(&found)), ([3, 3, 1, 1], vec![("degenerate", 1), ("boundary", 3)]));
    // A leaf is closed, and encloses nothing.
    let found = report(&mesh(&positions, &[0, 1, 2, 0, 2, 1]));
    assert_eq!((odd(&found), found.closed, found.outward), (vec![("back to back", 1)], true, false));
    assert_eq!(found.volume, Some(0.0));
}

#[test]
fn an_empty_mesh_has_no_surface() {
    let empty = report(&Mesh::default());
    assert_eq!((sizes(&empty), odd(&empty), empty.pieces), ([0; 4], vec![], 0));
    assert!(!empty.closed && !empty.outward && empty.genus.is_none());
    let point = report(&mesh(&[[1.0; 3]], &[0, 0, 0]));
    assert_eq!((odd(&point), point.closed, point.pieces), (vec![("degenerate", 1)], false, 0));
}

/// The quick answer and the long one are the same, on every surface above and with any one triangle turned or gone.
#[test]
fn the_report_agrees_with_the_quick_answer() {
    let mut tried = 0;
    for whole in [tetrahedron(), cube(), ring(5, 4, false), ring(5, 4, true), moebius(6)] {
        for t in 0..whole.triangle_count() {
            let mut turned = whole.clone();
            turned.indices.swap(3 * t, 3 * t + 1);
            let mut gone = whole.clone();
            gone.indices.drain(3 * t..3 * t + 3);
            for mesh in [&whole, &turned, &gone] {
                assert_eq!(report(mesh).outward, is_closed_outward(mesh));
                tried += 1;
            }
        }
    }
    assert_eq!(tried, 3 * (4 + 12 + 40 + 40 + 12));
}
