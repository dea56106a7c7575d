//! Atlases of models, and of meshes that no one should make.
#![allow(clippy::unwrap_used, missing_docs)]

use gonio_atlas::raster::for_each_texel;
use gonio_atlas::{AtlasUv, UnwrapError, UnwrapSettings, UvSource, unwrap, uv_report};
use gonio_mesh::{Limits, Mesh, NoSidecars, Part, obj, sphere};
use std::path::Path;

const SIZE: u32 = 1024;

fn asset(name: &str) -> Mesh {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/models").join(name);
    let bytes = std::fs::read(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    obj::read(&bytes, &mut NoSidecars, &Limits::default()).unwrap().mesh
}

fn unwrapped(mesh: &Mesh) -> AtlasUv {
    unwrap(mesh, &UnwrapSettings::default(), &|_| true).unwrap()
}

/// The chart of each texel whose centre is covered; a panic where two triangles cover one.
fn owners(atlas: &AtlasUv, name: &str) -> Vec<Option<u32>> {
    let mut owner = vec![None; (SIZE * SIZE) as usize];
    for (t, corners) in atlas.tex_coords.as_chunks::<3>().0.iter().enumerate() {
        let chart = atlas.chart_of_triangle[t];
        for_each_texel(*corners, SIZE, |x, y| {
            let owner = &mut owner[(y * SIZE + x) as usize];
            assert!(owner.is_none(), "{name}: two triangles cover the texel {x} {y}");
            *owner = Some(chart.unwrap_or_else(|| panic!("{name}: a degenerate triangle covers the texel {x} {y}")));
        });
    }
    owner
}

/// Charts keep the margin, less one texel on either side for the centres.
fn check_distances(owner: &[Option<u32>], margin: f64, name: &str) {
    let reach = (margin - 2.0).floor() as i64;
    assert!(reach > 0, "{name}: a margin of {margin} texels");
    let side = i64::from(SIZE);
    for (index, chart) in owner.iter().enumerate() {
        let Some(chart) = chart else { continue };
        let (x, y) = (index as i64 % side, index as i64 / side);
        for (dx, dy) in [(reach, 0), (0, reach), (reach * 7 / 10, reach * 7 / 10), (reach * 7 / 10, -reach * 7 / 10)] {
            let (x, y) = (x + dx, y + dy);
            if (0..side).contains(&x) && (0..side).contains(&y) {
                let other = owner[(y * side + x) as usize];
                assert!(other.is_none_or(|other| other == *chart), "{name}: {chart} and {other:?} at {x} {y}");
            }
        }
    }
}

/// A chart whose triangles touch `margin`-dilated others would fail here, one that overlaps itself in [`owners`].
#[test]
fn no_texel_belongs_to_two_charts_and_none_overlaps_itself() {
    let models = [
        ("suzanne", asset("suzanne.obj"), 0.55),
        ("still life", asset("still_life.obj"), 0.70),
        ("cube", asset("cube.obj"), 0.55),
        ("sphere", sphere::sphere(60).unwrap(), 0.55),
    ];
    for (name, mesh, least_coverage) in models {
        let atlas = unwrapped(&mesh);
        let report = uv_report(&mesh, &atlas, SIZE);
        let owner = owners(&atlas, name);
        check_distances(&owner, report.margin_texels, name);
        // Not turned over, and not folded: the area of the triangles is that of the texels that they cover once.
        assert_eq!((report.mirrored_triangles, report.overlapping_texels), (0, 0), "{name}");
        let covered = owner.iter().filter(|owner| owner.is_some()).count() as f64 / f64::from(SIZE * SIZE);
        assert!((covered - report.coverage).abs() < 0.003, "{name}: {covered} of {}", report.coverage);
        assert!(report.coverage > least_coverage, "{name}: {}", report.coverage);
        assert!(report.angle_stretch < 1.06 && report.area_stretch < 1.06, "{name}: {report:?}");
        assert!(atlas.tex_coords.iter().flatten().all(|c| (0.0..=1.0).contains(c)), "{name}");
    }
}

/// The cube's six sides are squares of the same size: exact angles and areas.
#[test]
fn a_cube_is_six_undistorted_squares() {
    let mesh = asset("cube.obj");
    let atlas = unwrapped(&mesh);
    let report = uv_report(&mesh, &atlas, SIZE);
    assert_eq!(report.charts, 6);
    assert!(report.angle_stretch < 1.000_01 && report.area_stretch < 1.000_01, "{report:?}");
}

/// A ramp of three turns: seen from above they lie exactly on top of each other, and no normal differs by much.
fn spiral() -> Mesh {
    let mut mesh = Mesh::default();
    let steps = 3 * 32;
    for i in 0..=steps {
        let angle = i as f32 / 32.0 * std::f32::consts::TAU;
        for radius in [1.0, 2.0] {
            mesh.positions.push([radius * angle.cos(), 0.02 * i as f32, radius * angle.sin()]);
        }
    }
    for i in 0..steps {
        let a = 2 * i;
        mesh.indices.extend([a, a + 2, a + 1, a + 1, a + 2, a + 3]);
    }
    mesh
}

#[test]
fn a_surface_above_itself_is_cut() {
    let mesh = spiral();
    let atlas = unwrapped(&mesh);
    owners(&atlas, "spiral");
    assert!(atlas.chart_count >= 2, "{} charts", atlas.chart_count);
}

/// Three sheets at one edge, a triangle twice, one inside out, triangles without area, and one far away.
fn wreck() -> Mesh {
    let mut mesh = Mesh {
        positions: vec![
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, -1.0, 0.1],
            [0.0, 0.0, 1.0],
            [0.5, 0.0, 0.0],
            [1e6, 1e6, 1e6],
        ],
        ..Mesh::default()
    };
    mesh.indices = vec![
        0, 1, 2, 1, 0, 3, 0, 1, 4, 0, 1, 2, 2, 1, 0, // sheets
        0, 0, 0, 0, 5, 1, 6, 6, 1, 4, 4, 4, // without area
    ];
    mesh
}

#[test]
fn broken_meshes_have_atlases() {
    let mesh = wreck();
    let atlas = unwrapped(&mesh);
    owners(&atlas, "wreck");
    let report = uv_report(&mesh, &atlas, SIZE);
    assert_eq!((report.degenerate_triangles, report.overlapping_texels), (4, 0));
    assert!(report.charts == 5, "{}", report.charts);
    // Very large and very small meshes are the same mesh.
    let charts = |scale: f32| {
        let mut mesh = asset("cube.obj");
        mesh.positions.iter_mut().flatten().for_each(|x| *x *= scale);
        unwrapped(&mesh).chart_count
    };
    assert_eq!((charts(1e30), charts(1e-18)), (6, 6));
}

#[test]
fn what_cannot_be_unwrapped_is_said() {
    let flat = Mesh { indices: vec![0, 0, 1], positions: vec![[0.0; 3], [1.0; 3]], ..Mesh::default() };
    assert_eq!(unwrap(&flat, &UnwrapSettings::default(), &|_| true), Err(UnwrapError::NoArea));
    assert_eq!(unwrap(&Mesh::default(), &UnwrapSettings::default(), &|_| true), Err(UnwrapError::NoArea));
    let kept = UnwrapSettings { source: UvSource::Kept, ..UnwrapSettings::default() };
    assert_eq!(unwrap(&spiral(), &kept, &|_| true), Err(UnwrapError::NoTexCoords));
    assert_eq!(unwrap(&spiral(), &UnwrapSettings::default(), &|share| share < 0.5), Err(UnwrapError::Stopped));
}

#[test]
fn kept_coordinates_stay_and_repacked_charts_stay_whole() {
    let mesh = asset("still_life.obj");
    let kept = unwrap(&mesh, &UnwrapSettings { source: UvSource::Kept, ..Default::default() }, &|_| true).unwrap();
    let own: Vec<[f32; 2]> = mesh.indices.iter().map(|&i| mesh.tex_coords[i as usize]).collect();
    assert_eq!(kept.tex_coords, own);
    let repacked = UnwrapSettings { source: UvSource::Repacked, ..Default::default() };
    let packed = unwrap(&mesh, &repacked, &|_| true).unwrap();
    assert_eq!(packed.chart_of_triangle, kept.chart_of_triangle);
    let margin = uv_report(&mesh, &packed, SIZE).margin_texels;
    assert!((margin - 10.24).abs() < 1e-9, "{margin}");
}

/// Two squares side by side, parts of one mesh with a common edge.
fn two_parts() -> Mesh {
    let positions = (0..6).map(|i| [(i % 3) as f32, (i / 3) as f32, 0.0]).collect();
    let part = |material, first_triangle| Part { material, first_triangle, triangle_count: 2, ..Part::default() };
    Mesh {
        positions,
        tex_coords: (0..6).map(|i| [(i % 3) as f32 / 2.0, (i / 3) as f32 / 2.0]).collect(),
        indices: vec![0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4],
        parts: vec![part(0, 0), part(1, 2)],
        ..Mesh::default()
    }
}

/// Parts of other density have a chart of their own, whose edges are longer by that factor.
#[test]
fn density_is_equal_unless_it_is_weighted() {
    let mesh = two_parts();
    for source in [UvSource::New, UvSource::Repacked] {
        for (density_of_part, charts, ratio) in [(vec![], 1, 1.0), (vec![3.0, 3.0], 1, 1.0), (vec![1.0, 2.5], 2, 2.5)] {
            let name = format!("{source:?}, {density_of_part:?}");
            let atlas =
                unwrap(&mesh, &UnwrapSettings { source, density_of_part, ..Default::default() }, &|_| true).unwrap();
            assert_eq!(atlas.chart_count, charts, "{name}");
            let edge = |corner: usize| {
                let [a, b] = [0, 1].map(|k| atlas.tex_coords[corner + k].map(f64::from));
                (a[0] - b[0]).hypot(a[1] - b[1])
            };
            assert!((edge(6) / edge(0) - ratio).abs() < 1e-5, "{name}: {} and {}", edge(6), edge(0));
            assert_eq!(uv_report(&mesh, &atlas, SIZE).overlapping_texels, 0, "{name}");
        }
    }
}

/// Parts of another group have a chart of their own, of the same density.
#[test]
fn groups_share_no_chart() {
    let mesh = two_parts();
    for source in [UvSource::New, UvSource::Repacked] {
        for (group_of_part, charts) in [(vec![], 1), (vec![7, 7], 1), (vec![7, 8], 2), (vec![7], 2)] {
            let name = format!("{source:?}, {group_of_part:?}");
            let settings = UnwrapSettings { source, group_of_part, ..Default::default() };
            let atlas = unwrap(&mesh, &settings, &|_| true).unwrap();
            assert_eq!(atlas.chart_count, charts, "{name}");
            assert!((uv_report(&mesh, &atlas, SIZE).area_stretch - 1.0).abs() < 1e-4, "{name}");
        }
    }
}

/// Two triangles with the same coordinates, half of the square: every texel is covered twice, and the report says so.
#[test]
fn overlaps_are_counted() {
    let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    let at = |z: f32| corners.map(|[x, y]| [x, y, z]);
    let mesh = Mesh {
        positions: [at(0.0), at(1.0)].concat(),
        tex_coords: [corners, corners].concat(),
        indices: (0..6).collect(),
        ..Mesh::default()
    };
    let kept = unwrap(&mesh, &UnwrapSettings { source: UvSource::Kept, ..Default::default() }, &|_| true).unwrap();
    let report = uv_report(&mesh, &kept, 100);
    // The centres on the diagonal belong to no triangle by the top-left rule, or to both.
    assert!((4950..=5050).contains(&report.overlapping_texels), "{report:?}");
    assert!((report.coverage - 1.0).abs() < 1e-9 && report.charts == 2, "{report:?}");
}

/// Separate triangles on a square of `side` x `side` of them.
fn scattered(side: u32) -> Mesh {
    let mut mesh = Mesh::default();
    for i in 0..side * side {
        let (x, y) = ((i % side) as f32, (i / side) as f32);
        mesh.positions.extend([[x, y, 0.0], [x + 0.4, y, 0.0], [x, y + 0.4, 0.0]]);
        mesh.indices.extend([3 * i, 3 * i + 1, 3 * i + 2]);
    }
    mesh
}

/// Thousands of charts leave no room for the margin; it is reduced, and no texel is shared. The second number is packed on
/// shelves.
#[test]
fn many_charts_reduce_the_margin() {
    for side in [64, 160] {
        let mesh = scattered(side);
        let atlas = unwrapped(&mesh);
        assert_eq!(atlas.chart_count, (side * side) as usize);
        assert!(atlas.margin < 0.01 && atlas.margin > 0.0, "{}", atlas.margin);
        owners(&atlas, "triangles");
        let report = uv_report(&mesh, &atlas, SIZE);
        assert!(report.coverage > 0.05 && report.area_stretch < 1.01, "{report:?}");
    }
}
