//! Debug views, and the probe: the same numbers as the picture's.
#![allow(clippy::unwrap_used, missing_docs)]

mod common;

use common::*;
use glam::{DMat4, DVec3, DVec4};
use gonio_light::quantity::Encoding;
use gonio_light::{Attenuation, Quantity, Specular};
use gonio_mesh::Material;
use gonio_reference::ReferenceScene;
use gonio_scene::scene_file::Shading;
use gonio_scene::{ColorSpace, Maps, ViewSpec};

const SHADINGS: [Shading; 4] = [Shading::Flat, Shading::FlatPerFace, Shading::Gouraud, Shading::Phong];

/// Two balls and a glass pane in front, three lights, textures, a stretched and turned object.
fn busy(shading: Shading) -> TestScene {
    let mut ball = sphere(8, 12);
    ball.tex_coords = ball.positions.iter().map(|p| [p[0] * 2.0, p[1]]).collect();
    ball.tangents = ball.positions.iter().map(|p| [p[2] + 0.01, 0.0, -p[0], 1.0]).collect();
    let rgba = [200, 50, 90, 255, 128, 128, 255, 255, 30, 220, 180, 255, 90, 160, 250, 255];
    let maps = Maps { diffuse: bound(0), normal: bound(0), emitted: bound(0), ..Maps::default() };
    let m = DMat4::from_translation(DVec3::new(-0.3, 0.2, -0.5))
        * DMat4::from_rotation_y(0.5)
        * DMat4::from_scale(DVec3::new(1.2, 0.8, 1.0));
    let material = Material { emitted: [0.1, 0.05, 0.2], ..Material::default() };
    TestScene::new()
        .texture(2, 2, &rgba, ColorSpace::Srgb)
        .placed(ball, shading, material, maps, m)
        .object(sphere(5, 7), shading, Material::default())
        .object(square(0.6, 1.5), shading, Material { opacity: 0.4, ..Material::default() })
        .light(ambient(0.2))
        .light(directional([-1.0, -0.5, -1.0], 0.7))
        .light(point([1.0, 2.0, 2.0], 2.0, Attenuation { constant: 1.0, linear: 0.2, quadratic: 0.1 }))
        .frame(|f| {
            f.equation.specular = Specular::BlinnPhong;
            f.background.top = DVec3::new(0.1, 0.2, 0.3);
        })
}

#[test]
fn the_probe_agrees_with_the_picture() {
    for shading in SHADINGS {
        let lab = busy(shading);
        let reference = ReferenceScene::new(&lab.scene);
        let picture = lab.draw().picture;
        let (mut hits, mut behind) = (0, 0);
        for y in 0..33 {
            for x in 0..33 {
                let pixel = picture.at(x, y);
                match reference.probe(&lab.frame, x, y) {
                    Some(probe) => {
                        assert_eq!(probe.total.to_array().map(|v| v as f32), pixel, "{shading} {x},{y}");
                        if probe.opacity == 1.0 {
                            assert_eq!(probe.total, probe.radiance.extend(1.0));
                        }
                        hits += 1;
                        behind += probe.surfaces_behind;
                    }
                    None => {
                        let c = lab.frame.background.at((f64::from(y) + 0.5) / 33.0).map(|v| v as f32);
                        assert_eq!(pixel, c, "{shading} {x},{y}");
                    }
                }
            }
        }
        assert!(hits > 100 && hits < 33 * 33 && behind > 5, "{shading}: {hits} {behind}");
        assert!(reference.probe(&lab.frame, 33, 0).is_none() && reference.probe(&lab.frame, 0, 33).is_none());
    }
}

/// Triangles smaller than pixels: what a thread remembers of one must not reach another.
#[test]
fn many_triangles_in_a_block_do_not_mix() {
    for shading in [Shading::Gouraud, Shading::FlatPerFace] {
        let lab = TestScene::new()
            .object(sphere(60, 60), shading, Material::default())
            .light(directional([-1.0, -0.5, -1.0], 0.7))
            .light(point([1.0, 2.0, 2.0], 2.0, Attenuation::NONE));
        let reference = ReferenceScene::new(&lab.scene);
        let picture = lab.draw().picture;
        let mut hits = 0;
        for (x, y) in (0..33 * 33).map(|i| (i % 33, i / 33)) {
            if let Some(probe) = reference.probe(&lab.frame, x, y) {
                assert_eq!(probe.total.to_array().map(|v| v as f32), picture.at(x, y), "{shading} {x},{y}");
                hits += 1;
            }
        }
        assert!(hits > 100, "{hits}");
    }
}

#[test]
fn the_probe_names_the_place() {
    let lab = busy(Shading::Gouraud);
    let reference = ReferenceScene::new(&lab.scene);
    let probe = reference.probe(&lab.frame, 16, 16).unwrap();
    assert_eq!((probe.object, probe.object_name.as_str(), probe.part_name.as_str()), (2, "object 2", "part"));
    assert_eq!(probe.vertices, lab.scene.meshes[2].triangle(probe.triangle));
    let corners = probe.vertices.map(|v| DVec3::from(lab.scene.meshes[2].positions[v].map(f64::from)));
    let at = corners[0] * probe.barycentrics.x + corners[1] * probe.barycentrics.y + corners[2] * probe.barycentrics.z;
    assert!(at.distance(probe.position) < 1e-12 && near(probe.depth, 3.5, 1e-6) && probe.front_facing);
    // Gouraud: three corners, their light interpolated, times the material.
    let sums = probe.interpolated.unwrap();
    let diffuse = |i: usize| -> DVec3 { probe.at_vertices[i].lights.iter().map(|l| l.diffuse_light).sum() };
    let expected =
        diffuse(0) * probe.barycentrics.x + diffuse(1) * probe.barycentrics.y + diffuse(2) * probe.barycentrics.z;
    assert!(probe.at_vertices.len() == 3 && sums.diffuse.distance(expected) < 1e-12);
    let total = probe.terms.ambient + probe.surface.diffuse * sums.diffuse + probe.surface.specular * sums.specular;
    assert!(total.distance(probe.radiance) < 1e-12);
    let per_face = busy(Shading::FlatPerFace);
    let probe = ReferenceScene::new(&per_face.scene).probe(&per_face.frame, 16, 16).unwrap();
    assert!(probe.at_vertices.len() == 1 && probe.interpolated.is_some());
    let phong = busy(Shading::Phong);
    let probe = ReferenceScene::new(&phong.scene).probe(&phong.frame, 16, 16).unwrap();
    assert!(probe.at_vertices.is_empty() && probe.interpolated.is_none());
}

#[test]
fn the_probe_is_written_as_json() {
    let lab = busy(Shading::Gouraud);
    let probe = ReferenceScene::new(&lab.scene).probe(&lab.frame, 16, 16).unwrap();
    let json = serde_json::to_value(&probe).unwrap();
    assert_eq!(json["shading"], "gouraud");
    assert_eq!(json["object_name"], "object 2");
    assert_eq!(json["surface"]["shininess"], 64.0);
    assert_eq!(json["at_vertices"].as_array().unwrap().len(), 3);
    // The directional light has no distance; the point light has.
    assert!(json["terms"]["lights"][0]["distance"].is_null());
    assert_eq!(json["terms"]["lights"][1]["distance"], probe.terms.lights[1].distance);
    assert_eq!(json["terms"]["point"]["normal"][2], probe.terms.point.normal.z);
    assert_eq!(json["interpolated"]["diffuse"][0], probe.interpolated.unwrap().diffuse.x);
    assert_eq!(json["total"][3], 1.0);
}

/// Where the equation is evaluated at the fragment, each view shows exactly the probe's term.
#[test]
fn views_show_the_terms_of_the_probe() {
    for shading in [Shading::Flat, Shading::Phong] {
        let lab = busy(shading);
        let reference = ReferenceScene::new(&lab.scene);
        let specs: Vec<ViewSpec> = Quantity::ALL
            .iter()
            .flat_map(|&quantity| {
                let lights: &[Option<usize>] = if quantity.per_light() || quantity.summed_over_lights() {
                    &[None, Some(2), Some(9)]
                } else {
                    &[None]
                };
                lights.iter().map(move |&light| ViewSpec { quantity, light })
            })
            .filter(|v| v.quantity != Quantity::Total)
            .collect();
        let views = reference.views(&lab.frame, &specs, &|_| ());
        assert_eq!(views.len(), specs.len());
        let mut compared = 0;
        for (spec, view) in specs.iter().zip(&views) {
            for (x, y) in [(16, 16), (10, 12), (20, 19), (14, 22), (0, 0)] {
                let pixel = view.picture.at(x, y);
                let expected = match reference.probe(&lab.frame, x, y) {
                    Some(p) => p.terms.quantity(spec.quantity, spec.light, &p.geometry).extend(1.0),
                    None if spec.quantity.encoding() == Encoding::Color => DVec4::W,
                    None => DVec4::ZERO,
                };
                assert_eq!(pixel, expected.to_array().map(|v| v as f32), "{shading} {spec} {x},{y}");
                compared += 1;
            }
        }
        assert!(compared >= 5 * Quantity::ALL.len());
    }
}

#[test]
fn views_together_are_the_views_alone() {
    for shading in SHADINGS {
        let lab = busy(shading).frame(|f| f.samples = 2);
        let reference = ReferenceScene::new(&lab.scene);
        let specs: Vec<ViewSpec> = Quantity::ALL.iter().map(|&q| view(q)).collect();
        let together = reference.views(&lab.frame, &specs, &|_| ());
        for (spec, one) in specs.iter().zip(&together) {
            assert_eq!(reference.render(&lab.frame, Some(*spec), &|_| ()).picture, one.picture, "{shading} {spec}");
        }
        // The view `total` is the picture itself.
        let total = specs.iter().position(|s| s.quantity == Quantity::Total).unwrap();
        assert_eq!(together[total], lab.draw());
        assert!(reference.views(&lab.frame, &[], &|_| ()).is_empty());
    }
}

/// A + E + diffuse + specular is the picture, for every shading; and the terms of single lights add up.
#[test]
fn the_terms_add_up_to_the_picture() {
    use Quantity::*;
    for shading in SHADINGS {
        let mut lab = busy(shading);
        lab.scene.objects.truncate(2); // opaque ones
        let reference = ReferenceScene::new(&lab.scene);
        let of = |quantity, light| ViewSpec { quantity, light };
        let specs = [
            of(Total, None),
            of(Ambient, None),
            of(Emitted, None),
            of(Diffuse, None),
            of(Specular, None),
            of(Diffuse, Some(1)),
            of(Diffuse, Some(2)),
            of(Specular, Some(1)),
            of(Specular, Some(2)),
            of(Normal, None),
        ];
        let views = reference.views(&lab.frame, &specs, &|_| ());
        let value = |view: usize, i: usize| {
            let p = views[view].picture.pixels[i];
            DVec3::new(p[0].into(), p[1].into(), p[2].into())
        };
        let mut hits = 0;
        for i in (0..33 * 33).filter(|&i| views[9].picture.pixels[i][3] == 1.0) {
            // f32 of the pictures.
            let sum: DVec3 = (1..5).map(|v| value(v, i)).sum();
            assert!(value(0, i).distance(sum) < 1e-6, "{shading}: {} {sum}", value(0, i));
            assert!(value(3, i).distance(value(5, i) + value(6, i)) < 1e-6, "{shading}");
            assert!(value(4, i).distance(value(7, i) + value(8, i)) < 1e-6, "{shading}");
            hits += 1;
        }
        assert!(hits > 100);
    }
}

/// On one triangle with different normals at its corners.
#[test]
fn gouraud_views_are_interpolated_from_the_corners() {
    let normals = [[0.6f32, 0.0, 0.8], [-0.6, 0.0, 0.8], [0.0, 0.6, 0.8]];
    let mesh = mesh(&[[-2.0, -2.0, 0.0], [2.0, -2.0, 0.0], [0.0, 2.0, 0.0]], &normals, &[0, 1, 2]);
    let lab = |shading| {
        TestScene::new().object(mesh.clone(), shading, matte([0.5; 3])).light(directional([0.0, 0.0, -1.0], 1.0))
    };
    let reference = lab(Shading::Gouraud);
    let probe = ReferenceScene::new(&reference.scene).probe(&reference.frame, 16, 18).unwrap();
    let pixel = |shading, quantity| {
        let p = lab(shading).show(quantity).picture.at(16, 18);
        DVec3::new(p[0].into(), p[1].into(), p[2].into())
    };
    let n: [DVec3; 3] = normals.map(|n| DVec3::from(n.map(f64::from)).normalize());
    let w = probe.barycentrics;
    let interpolated = n[0] * w.x + n[1] * w.y + n[2] * w.z;
    // Gouraud does not renormalise, Phong does.
    assert!(pixel(Shading::Gouraud, Quantity::Normal).distance(interpolated) < 1e-6 && interpolated.length() < 0.95);
    assert!(pixel(Shading::Phong, Quantity::Normal).distance(interpolated.normalize()) < 1e-6);
    // All corners have N.L = 0.8; Phong's is larger in between.
    assert!(near(pixel(Shading::Gouraud, Quantity::CosTheta).x, 0.8, 1e-6));
    assert!(near(pixel(Shading::Phong, Quantity::CosTheta).x, interpolated.normalize().z, 1e-6));
    // Place and triangle are the fragment's.
    for shading in SHADINGS {
        assert!(pixel(shading, Quantity::Position).distance(probe.position) < 1e-6);
        assert_eq!(pixel(shading, Quantity::GeometricNormal), DVec3::Z);
        assert_eq!(pixel(shading, Quantity::Tangent), DVec3::ZERO);
        assert!(near(pixel(shading, Quantity::Depth).x, 5.0, 1e-6));
    }
}

#[test]
fn per_face_views_are_the_centroids() {
    let mesh = mesh(&[[-2.0, -2.0, 0.0], [2.0, -2.0, 0.0], [0.0, 2.0, 0.0]], &[[0.0, 0.0, 1.0]; 3], &[0, 1, 2]);
    let lab = TestScene::new().object(mesh, Shading::FlatPerFace, matte([0.5; 3])).light(point(
        [0.0, 0.0, 1.0],
        1.0,
        Attenuation::NONE,
    ));
    for (x, y) in [(16, 16), (12, 20), (20, 22)] {
        let d = lab.show(Quantity::Distance).picture.at(x, y)[0];
        assert!(near(d.into(), 13f64.sqrt() / 3.0, 1e-6), "{d}");
    }
}

#[test]
fn a_light_at_the_very_point_makes_no_nan() {
    for shading in SHADINGS {
        let lab = TestScene::new()
            .object(square(1.0, 0.0), shading, Material::default())
            .light(point([0.0, 0.0, 0.0], 1.0, Attenuation::INVERSE_SQUARE))
            .light(point([-1.0, -1.0, 0.0], 1.0, Attenuation::INVERSE_SQUARE))
            .frame(|f| f.equation.specular = Specular::Phong);
        for &quantity in Quantity::ALL {
            let picture = lab.show(quantity).picture;
            assert!(picture.pixels.iter().flatten().all(|v| v.is_finite()), "{shading} {quantity}");
        }
        assert!(lab.middle()[0] >= 0.0);
    }
}
