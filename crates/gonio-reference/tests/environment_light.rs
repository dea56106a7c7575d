//! Light of the environment: diffuse by harmonics, glossy by the split sum, and a blurred background.
#![allow(clippy::unwrap_used, missing_docs)]

mod common;

use common::*;
use glam::{DMat3, DVec3};
use gonio_environment::prefilter::dominant_direction;
use gonio_environment::{BrdfTable, Cubemap};
use gonio_light::roughness::roughness_of_shininess;
use gonio_light::{Optics, Quantity};
use gonio_mesh::Material;
use gonio_reference::ReferenceScene;
use gonio_scene::scene_file::Shading;

/// f32 of texels and of the picture.
const ROUNDING: f64 = 1e-6;

const SHADINGS: [Shading; 4] = [Shading::Flat, Shading::FlatPerFace, Shading::Gouraud, Shading::Phong];

fn lit(lab: Lab, intensity: f64) -> Lab {
    lab.frame(|f| {
        let surroundings = f.surroundings.as_mut().unwrap();
        (surroundings.lights, surroundings.intensity) = (true, intensity);
    })
}

fn gloss(shininess: f32) -> Material {
    Material { specular: [0.5, 0.25, 0.125], shininess, ..matte([0.5, 0.25, 1.0]) }
}

#[test]
fn even_light_is_multiplied_by_the_material() {
    for shading in SHADINGS {
        let even = |material| {
            // Something that shines is in every scene, here out of sight.
            let lab = Lab::new().object(square(0.1, 9.0), shading, gloss(10.0));
            let lab = lab.object(square(9.0, 0.0), shading, material);
            lit(lab.environment(Cubemap::new(4, [1.0, 1.0, 0.5, 1.0])), 2.0)
        };
        let near =
            |got: DVec3, wanted: DVec3| assert!(got.abs_diff_eq(wanted, ROUNDING), "{shading}: {got} not {wanted}");
        let light = DVec3::new(2.0, 2.0, 1.0);
        // The irradiance is pi; a black k_s is matte, whatever its shininess.
        let lab = even(matte([0.5, 0.25, 1.0]));
        near(DVec3::from_slice(&lab.middle()), light * DVec3::new(0.5, 0.25, 1.0));
        near(lab.middle_of(Quantity::EnvironmentDiffuse), light * DVec3::new(0.5, 0.25, 1.0));
        near(lab.middle_of(Quantity::EnvironmentSpecular), DVec3::ZERO);
        // Seen along the normal.
        let lab = even(gloss(10.0));
        let (scale, bias) = BrdfTable::get().lookup(1.0, roughness_of_shininess(10.0));
        let specular = light * (DVec3::new(0.5, 0.25, 0.125) * scale + bias);
        near(lab.middle_of(Quantity::EnvironmentSpecular), specular);
        near(DVec3::from_slice(&lab.middle()), specular + light * DVec3::new(0.5, 0.25, 1.0));
        // Exponents below 1 count as 1, as in the light equation.
        let specular_of = |shininess| even(gloss(shininess)).middle_of(Quantity::EnvironmentSpecular);
        assert_eq!(specular_of(0.0), specular_of(1.0), "{shading}");
        // What mirrors show stands in the place of all that is lit.
        let lab = lab.optics(Optics { reflectivity: 0.25, ..Optics::default() });
        let wanted = 0.75 * (specular + light * DVec3::new(0.5, 0.25, 1.0)) + 0.25 * light;
        near(DVec3::from_slice(&lab.middle()), wanted);
        // Each by its switch, and both by the environment's.
        let lab = lab.optics(Optics::default()).frame(|f| f.equation.terms.diffuse = false);
        near(DVec3::from_slice(&lab.middle()), specular);
        let lab = lab.frame(|f| (f.equation.terms.diffuse, f.equation.terms.specular) = (true, false));
        near(DVec3::from_slice(&lab.middle()), light * DVec3::new(0.5, 0.25, 1.0));
        let lab = lab.frame(|f| f.surroundings.as_mut().unwrap().lights = false);
        near(DVec3::from_slice(&lab.middle()), DVec3::ZERO);
    }
}

#[test]
fn light_comes_from_where_the_environment_is_bright() {
    let turn = DMat3::from_rotation_y(0.4) * DMat3::from_rotation_x(-0.3);
    let map = Cubemap::from_function(64, |d| DVec3::ONE + d);
    for shading in SHADINGS {
        let lab = Lab::new().object(sphere(12, 18), shading, gloss(40.0)).environment(map.clone());
        let lab = lit(lab, 1.5).frame(|f| f.surroundings.as_mut().unwrap().environment_from_world = turn);
        let glossy = lab.scene.environment.as_ref().unwrap().glossy();
        let reference = ReferenceScene::new(&lab.scene);
        let pictures = [Quantity::EnvironmentDiffuse, Quantity::EnvironmentSpecular].map(|q| lab.show(q).picture);
        let mut compared = 0;
        for (x, y) in (0..33).flat_map(|y| (0..33).map(move |x| (x, y))) {
            let Some(probe) = reference.probe(&lab.frame, x, y) else { continue };
            let n = shading_normal(&lab, &probe, shading);
            // Of 1 + d under a cosine: pi + 2/3 pi n.
            let diffuse = 1.5 * DVec3::new(0.5, 0.25, 1.0) * (DVec3::ONE + 2.0 / 3.0 * (turn * n));
            let got = rgb(pictures[0].at(x, y));
            // Texels of 64 an edge for an integral.
            assert!(got.abs_diff_eq(diffuse, 1e-3), "{shading} {x},{y}: {got} is not {diffuse}");
            let (v, roughness) = (-ray_of(&lab, x, y), roughness_of_shininess(40.0));
            let (scale, bias) = BrdfTable::get().lookup(n.dot(v).max(0.0), roughness);
            let about = glossy.sample(turn * dominant_direction(n, v, roughness), roughness);
            let specular = 1.5 * (DVec3::new(0.5, 0.25, 0.125) * scale + bias) * about;
            let got = rgb(pictures[1].at(x, y));
            assert!(got.abs_diff_eq(specular, ROUNDING), "{shading} {x},{y}: {got} is not {specular}");
            let seen = probe.terms.environment;
            assert!(probe.radiance.abs_diff_eq(probe.lit + seen.diffuse + seen.specular, 1e-12));
            compared += 1;
        }
        assert!(compared > 100, "{shading}: {compared}");
    }
}

#[test]
fn a_blurred_background_is_that_of_a_rough_mirror() {
    let map = Cubemap::from_function(64, |d| (9.0 * d).map(|v| v.sin()) + 1.0);
    for filter in [gonio_scene::TextureFilter::Linear, gonio_scene::TextureFilter::Mipmap] {
        let lab = Lab::new().environment(map.clone()).frame(|f| {
            let surroundings = f.surroundings.as_mut().unwrap();
            (surroundings.blur, surroundings.intensity) = (0.4, 0.5);
            f.texture_filter = filter;
        });
        let environment = lab.scene.environment.clone().unwrap();
        let picture = lab.draw().picture;
        for (x, y) in [(0, 0), (16, 16), (31, 7)] {
            let (got, wanted) =
                (rgb(picture.at(x, y)), 0.5 * environment.seen_glossy().sample(ray_of(&lab, x, y), 0.4));
            assert!(got.abs_diff_eq(wanted, ROUNDING), "{filter} {x},{y}: {got} is not {wanted}");
            let sharp = 0.5 * environment.seen().sample(ray_of(&lab, x, y), 0.0);
            assert!(!got.abs_diff_eq(sharp, 0.01), "{x},{y} is not blurred");
        }
    }
}
