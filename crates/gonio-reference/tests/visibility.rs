//! Which surface a ray sees, also with geometry kept from the scene before.

#![allow(clippy::unwrap_used, missing_docs)]

mod common;

use common::*;
use glam::{DMat4, DVec3};
use gonio_light::Quantity;
use gonio_mesh::{Material, Mesh};
use gonio_reference::{ReferenceGeometry, ReferenceScene, sample_positions};
use gonio_scene::scene_file::Shading;
use gonio_scene::{Maps, Scene};
use std::sync::Arc;

/// Sends out light of its own: 1, whatever the lights are.
fn glowing(color: [f32; 3]) -> Material {
    Material { emitted: color, ..with_ambient(matte([0.0; 3]), 0.0) }
}

#[test]
fn two_sided_turns_the_normal_to_the_viewer() {
    for shading in [Shading::Flat, Shading::FlatPerFace, Shading::Gouraud, Shading::Phong] {
        let from_behind = |light: f64, two_sided: bool| {
            TestScene::new()
                .object(square(2.0, 0.0), shading, matte([0.5; 3]))
                .eye([0.0, 0.0, -5.0], [0.0; 3])
                .light(directional([0.0, 0.0, light], 1.0))
                .frame(|f| f.two_sided = two_sided)
                .middle()[0]
        };
        // Light travels along +Z: from the viewer's side onto the back.
        assert!(near(from_behind(1.0, true), 0.5, 1e-6), "{shading}");
        assert_eq!(from_behind(1.0, false), 0.0, "{shading}");
        // From the other side onto the front, which the viewer does not see.
        assert_eq!(from_behind(-1.0, true), 0.0, "{shading}");
        assert!(near(from_behind(-1.0, false), 0.5, 1e-6), "{shading}");
    }
}

#[test]
fn a_mirrored_object_keeps_its_front() {
    let lab = |two_sided| {
        TestScene::new()
            .placed(
                square(2.0, 0.0),
                Shading::Flat,
                matte([0.5; 3]),
                Maps::default(),
                DMat4::from_scale(DVec3::new(-1.0, 1.0, 1.0)),
            )
            .closed()
            .light(directional([0.0, 0.0, -1.0], 1.0))
            .frame(|f| f.two_sided = two_sided)
    };
    assert!(near(lab(true).middle()[0], 0.5, 1e-6) && near(lab(false).middle()[0], 0.5, 1e-6));
}

#[test]
fn back_faces_of_closed_objects_are_culled() {
    let inside = |closed: bool| {
        let lab =
            TestScene::new().object(sphere(24, 48), Shading::Phong, glowing([1.0; 3])).eye([0.0; 3], [0.0, 0.0, -1.0]);
        let lab = lab
            .frame(|f| f.background.top = DVec3::new(0.0, 0.25, 0.0))
            .frame(|f| f.background.bottom = DVec3::new(0.0, 0.25, 0.0));
        if closed { lab.closed() } else { lab }
    };
    assert!(inside(true).draw().picture.pixels.iter().all(|&p| p == [0.0, 0.25, 0.0, 1.0]));
    assert!(inside(false).draw().picture.pixels.iter().all(|&p| p == [1.0, 1.0, 1.0, 1.0]));
    // From outside nothing changes.
    let outside = TestScene::new()
        .object(sphere(24, 48), Shading::Phong, matte([0.5; 3]))
        .light(directional([-1.0, -1.0, -1.0], 1.0));
    let open = outside.draw().picture;
    assert!(open.pixels.iter().filter(|p| p[0] > 0.0).count() > 100);
    assert_eq!(outside.closed().draw().picture, open);
}

#[test]
fn near_and_far_planes_cut() {
    let lab = |near: f64, far: f64| {
        TestScene::new()
            .object(square(1.0, 4.0), Shading::Flat, glowing([1.0, 0.0, 0.0]))
            .object(square(2.0, 0.0), Shading::Flat, glowing([0.0, 1.0, 0.0]))
            .frame(|f| {
                f.camera.near = near;
                f.camera.far = far;
            })
            .middle()
    };
    assert_eq!(lab(0.5, 10.0), [1.0, 0.0, 0.0, 1.0]);
    assert_eq!(lab(1.5, 10.0), [0.0, 1.0, 0.0, 1.0]);
    assert_eq!(lab(1.5, 4.5), [0.0, 0.0, 0.0, 1.0]);
}

/// A floor that passes below the eye and on behind it.
#[test]
fn a_triangle_through_the_near_plane_is_cut_there() {
    let floor = mesh(&[[-90.0, -1.0, 90.0], [90.0, -1.0, 90.0], [0.0, -1.0, -90.0]], &[[0.0, 1.0, 0.0]; 3], &[0, 1, 2]);
    let lab =
        TestScene::new().object(floor, Shading::Flat, glowing([1.0; 3])).eye([0.0; 3], [0.0, 0.0, -1.0]).frame(|f| {
            f.camera.fov_y_rad = 150f64.to_radians();
            f.camera.near = 0.4;
            f.height = 101;
            f.width = 101;
            f.camera.far = 10.0;
        });
    let picture = lab.draw().picture;
    let tan = 75f64.to_radians().tan();
    for y in 0..101 {
        // The ray's slope down meets the floor at this depth.
        let slope = (2.0 * (f64::from(y) + 0.5) / 101.0 - 1.0) * tan;
        let depth = 1.0 / slope;
        let lit = picture.at(50, y)[0] == 1.0;
        assert_eq!(lit, (0.4..=10.0).contains(&depth), "row {y}: depth {depth}");
    }
}

#[test]
fn the_first_of_equally_near_triangles_is_seen() {
    // In several numbers, so that the tree meets them in several orders.
    for others in 1..12 {
        let first = TestScene::new().object(square(2.0, 0.0), Shading::Flat, glowing([1.0, 0.0, 0.0]));
        let lab =
            (0..others).fold(first, |lab, _| lab.object(square(2.0, 0.0), Shading::Flat, glowing([0.0, 1.0, 0.0])));
        assert!(lab.draw().picture.pixels.iter().all(|&p| p == [1.0, 0.0, 0.0, 1.0]), "{others}");
    }
}

/// SplitMix64, in [0, 1).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// A closed surface that every ray from the origin passes exactly once.
fn star(random: &mut Random) -> Mesh {
    let mut mesh = sphere(5 + (random.next() * 30.0) as u32, 5 + (random.next() * 40.0) as u32);
    for p in &mut mesh.positions {
        let radius = (0.5 + random.next()) as f32;
        *p = p.map(|v| v * radius);
    }
    mesh
}

/// Half-transparent walls around the eye: a leak has alpha 0, an edge that counts twice 0.75.
#[test]
fn random_closed_meshes_are_seen_exactly_once_from_inside() {
    let mut random = Random(1);
    for round in 0..25 {
        let direction = [random.next() - 0.5, random.next() - 0.5, random.next() - 0.5];
        // Every third round the eye is exactly at the centre, and looks along an axis: rays meet corners and edges.
        let direction = if round % 3 == 0 { [0.0, 0.0, -1.0] } else { direction };
        let place = DVec3::new(random.next(), random.next(), random.next()) * if round % 3 == 1 { 1000.0 } else { 0.0 };
        let eye = place.to_array();
        let target = (place + DVec3::from(direction)).to_array();
        let material = Material { opacity: 0.5, ..glowing([1.0; 3]) };
        let lab = TestScene::new()
            .placed(star(&mut random), Shading::Flat, material, Maps::default(), DMat4::from_translation(place))
            .eye(eye, target)
            .frame(|f| {
                (f.width, f.height, f.samples) = (65, 65, [1, 3][round % 2]);
                f.camera.fov_y_rad = 1.9;
                f.camera.near = 1e-3;
                f.background.transparent = true;
            });
        for (i, p) in lab.draw().picture.pixels.iter().enumerate() {
            assert_eq!(*p, [0.5; 4], "round {round}, pixel {}, {}", i % 65, i / 65);
        }
    }
}

#[test]
fn a_closed_mesh_has_no_hole_from_outside() {
    for (rings, segments) in [(16, 32), (7, 11)] {
        let lab =
            TestScene::new().object(sphere(rings, segments), Shading::Phong, glowing([1.0; 3])).closed().frame(|f| {
                (f.width, f.height) = (129, 129);
                f.background.transparent = true;
            });
        let picture = lab.draw().picture;
        // A ball inside of every facet: the least distance of a facet from the centre.
        let radius =
            (0.5 * std::f64::consts::PI / f64::from(rings)).cos() * (std::f64::consts::PI / f64::from(segments)).cos();
        let mut inside = 0;
        for y in 0..129 {
            for x in 0..129 {
                let c = &lab.frame.camera;
                let d = c.ray_direction(f64::from(x) + 0.5, f64::from(y) + 0.5, 129, 129);
                let distance = c.position.cross(d).length();
                if distance < radius {
                    assert_eq!(picture.at(x, y), [1.0; 4], "{x},{y}");
                    inside += 1;
                } else if distance > 1.0 {
                    assert_eq!(picture.at(x, y), [0.0; 4], "{x},{y}");
                }
            }
        }
        assert!(inside > 2000, "{inside}");
    }
}

/// Each pixel must see the same as by testing every triangle for every ray.
#[test]
fn the_tree_finds_what_brute_force_finds() {
    let mut random = Random(5);
    let mut soup = Mesh::default();
    for _ in 0..300 {
        let center = DVec3::new(random.next() - 0.5, random.next() - 0.5, random.next() - 0.5) * 3.0;
        for _ in 0..3 {
            let offset = DVec3::new(random.next() - 0.5, random.next() - 0.5, random.next() - 0.5);
            soup.indices.push(soup.positions.len() as u32);
            soup.positions.push((center + offset).to_array().map(|v| v as f32));
            soup.normals.push([0.0, 0.0, 1.0]);
        }
    }
    let lab = TestScene::new().object(soup, Shading::Flat, matte([0.5; 3]));
    let reference = ReferenceScene::new(&lab.scene);
    let mesh = &lab.scene.meshes[0];
    let camera = &lab.frame.camera;
    let mut hits = 0;
    for y in 0..33 {
        for x in 0..33 {
            let d = camera.ray_direction(f64::from(x) + 0.5, f64::from(y) + 0.5, 33, 33);
            // Möller and Trumbore 1997.
            let nearest = (0..mesh.triangle_count())
                .filter_map(|t| {
                    let [a, b, c] = mesh.triangle_positions(t).map(|p| p.as_dvec3());
                    let (e1, e2, s) = (b - a, c - a, camera.position - a);
                    let p = d.cross(e2);
                    let inverse = 1.0 / e1.dot(p);
                    let (u, q) = (s.dot(p) * inverse, s.cross(e1));
                    let (v, t_hit) = (d.dot(q) * inverse, e2.dot(q) * inverse);
                    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t_hit > 0.0).then_some((t_hit, t))
                })
                .min_by(|a, b| a.0.total_cmp(&b.0));
            let probe = reference.probe(&lab.frame, x, y);
            assert_eq!(probe.as_ref().map(|p| p.triangle), nearest.map(|n| n.1), "{x},{y}");
            hits += usize::from(probe.is_some());
        }
    }
    assert!(hits > 300, "{hits}");
}

#[test]
fn samples_are_averaged() {
    // A wall that ends exactly at the middle of the middle column.
    let wall = mesh(
        &[[-9.0, -9.0, 0.0], [0.0, -9.0, 0.0], [0.0, 9.0, 0.0], [-9.0, 9.0, 0.0]],
        &[[0.0, 0.0, 1.0]; 4],
        &[0, 1, 2, 0, 2, 3],
    );
    for samples in [1, 2, 4, 5, 8, 16] {
        let lab = TestScene::new().object(wall.clone(), Shading::Flat, glowing([1.0, 0.5, 0.25])).frame(|f| {
            f.samples = samples;
            f.background.transparent = true;
        });
        let rendered = lab.draw();
        let share = sample_positions(samples).iter().filter(|p| p[0] < 0.5).count() as f32 / samples as f32;
        for y in 0..33 {
            assert_eq!(rendered.picture.at(15, y), [1.0, 0.5, 0.25, 1.0]);
            assert_eq!(rendered.picture.at(16, y), [share, 0.5 * share, 0.25 * share, share], "{samples} samples");
            assert_eq!(rendered.picture.at(17, y), [0.0; 4]);
        }
        let covered = 33 * (16 * samples as u64 + (share * samples as f32) as u64);
        assert_eq!((rendered.fragments, rendered.vertices), (covered, 4));
    }
}

#[test]
fn the_background_is_that_of_the_samples_height() {
    let lab = TestScene::new().frame(|f| {
        (f.width, f.height, f.samples) = (2, 4, 1);
        f.background.top = DVec3::ONE;
        f.background.bottom = DVec3::ZERO;
    });
    let picture = lab.draw().picture;
    for y in 0..4 {
        let grey = 1.0 - (y as f32 + 0.5) / 4.0;
        assert_eq!(picture.at(1, y), [grey, grey, grey, 1.0]);
    }
}

#[test]
fn the_number_of_threads_does_not_change_the_bytes() {
    let lab = TestScene::new()
        .object(sphere(20, 30), Shading::Phong, matte([0.5; 3]))
        .object(square(3.0, 1.2), Shading::Gouraud, Material { opacity: 0.4, ..Material::default() })
        .light(directional([-1.0, -1.0, -1.0], 1.0))
        .frame(|f| (f.width, f.height, f.samples) = (83, 61, 4));
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| lab.draw())
    };
    let one = on(1);
    assert!(one.fragments > 1000);
    assert_eq!(one, on(2));
    assert_eq!(one, on(5));
}

#[test]
fn progress_ends_at_one() {
    let lab = TestScene::new().object(square(1.0, 0.0), Shading::Flat, matte([0.5; 3]));
    let seen = std::sync::Mutex::new(Vec::new());
    ReferenceScene::new(&lab.scene).render(&lab.frame, None, &|share| seen.lock().unwrap().push(share));
    let mut seen = seen.into_inner().unwrap();
    seen.sort_by(f64::total_cmp);
    assert_eq!(seen.last(), Some(&1.0));
    assert!(seen.len() > 1 && seen[0] > 0.0);
}

#[test]
fn odd_geometry_is_left_out() {
    // No object, no triangle, indices beyond the mesh, corners that are no numbers, no area, a matrix without extent.
    assert!(TestScene::new().draw().picture.pixels.iter().all(|&p| p == [0.0, 0.0, 0.0, 1.0]));
    let good = square(1.0, 0.0);
    let mut odd = good.clone();
    odd.positions.extend([[f32::NAN, 0.0, 0.0], [f32::INFINITY, 1.0, 0.0], [0.0, 0.0, 0.0]]);
    odd.indices.extend([0, 1, 99, 0, 1, 4, 0, 1, 5, 0, 0, 1, 6, 6, 6]);
    odd.normals.truncate(2);
    odd.tex_coords.truncate(1);
    let lab = TestScene::new()
        .object(Mesh::default(), Shading::Phong, matte([0.5; 3]))
        .object(odd, Shading::Flat, glowing([1.0; 3]))
        .placed(good, Shading::Phong, glowing([1.0; 3]), Maps::default(), DMat4::from_scale(DVec3::ZERO));
    assert_eq!(lab.middle(), [1.0; 4]);
    assert!(lab.show(Quantity::Normal).picture.pixels.iter().flatten().all(|v| v.is_finite()));
}

fn lab() -> TestScene {
    TestScene::new()
        .object(sphere(6, 8), Shading::Phong, Material::default())
        .object(square(0.5, 1.5), Shading::Flat, Material { opacity: 0.5, ..Material::default() })
        .light(directional([-1.0, -0.5, -1.0], 0.7))
}

fn changed(scene: &Scene, change: impl FnOnce(&mut Scene)) -> Scene {
    let mut scene = scene.clone();
    change(&mut scene);
    scene
}

#[test]
fn a_kept_geometry_draws_other_colours_and_lights() {
    let lab = lab();
    let geometry = Arc::new(ReferenceGeometry::new(&lab.scene));
    let before = ReferenceScene::with_geometry(&lab.scene, geometry.clone()).unwrap();
    let edited = changed(&lab.scene, |s| {
        s.materials[0].material.diffuse = [0.9, 0.1, 0.2];
        s.materials[1].material.opacity = 0.25;
        s.objects[0].shading = Shading::Gouraud;
    });
    let mut frame = lab.frame.clone();
    frame.lights.push(ambient(0.3));
    let kept = ReferenceScene::with_geometry(&edited, geometry).unwrap();
    let drawn = kept.render(&frame, None, &|_| ());
    assert!(drawn == ReferenceScene::new(&edited).render(&frame, None, &|_| ()), "not one bit differs");
    assert!(drawn.picture != before.render(&frame, None, &|_| ()).picture, "it shows");
    assert!(kept.probe(&frame, 16, 16) == ReferenceScene::new(&edited).probe(&frame, 16, 16));
}

#[test]
fn moved_triangles_need_another_geometry() {
    let scene = lab().scene;
    let geometry = Arc::new(ReferenceGeometry::new(&scene));
    type Change = fn(&mut Scene);
    let changes: [(&str, Change); 8] = [
        ("moved", |s| s.objects[0].world_from_model = DMat4::from_translation(DVec3::X)),
        ("removed", |s| drop(s.objects.pop())),
        ("a copy", |s| s.objects.push(s.objects[0].clone())),
        ("another mesh", |s| s.meshes[0] = Arc::new(sphere(6, 8))),
        ("made opaque", |s| s.materials[1].material.opacity = 1.0),
        ("made closed", |s| s.objects[0].closed = true),
        ("another material's number", |s| s.objects[0].parts[0].material = 1),
        ("looked through", |s| {
            (s.materials[0].optics.transmission, s.materials[0].optics.surfaces) = (1.0, gonio_light::Surfaces::Two);
        }),
    ];
    assert!(geometry.fits(&scene.clone()), "a clone is the same scene");
    for (what, change) in changes {
        let other = changed(&scene, change);
        assert!(!geometry.fits(&other), "{what}");
        assert!(ReferenceScene::with_geometry(&other, geometry.clone()).is_none(), "{what}");
    }
}

/// A window builds it beside itself, and forgets the scene meanwhile.
#[test]
fn it_goes_to_another_thread_and_outlives_its_scene() {
    let lab = lab();
    let here = lab.draw();
    let (scene, frame) = (lab.scene, lab.frame);
    let reference = std::thread::spawn(move || ReferenceScene::new(&scene)).join().unwrap();
    assert!(reference.render(&frame, None, &|_| ()) == here);
    assert!(reference.geometry().fits(reference.scene()));
    // Meshes count by what they are, not by what is in them.
    assert!(!reference.geometry().fits(&self::lab().scene));
}
