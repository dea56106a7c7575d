//! Materials with BRDFs of their own: values known on paper, and measured tables against the models they were made from.
#![allow(clippy::unwrap_used, missing_docs)]

mod common;

use common::{TestScene, ambient, directional, point};
use glam::{DMat4, DVec3};
use gonio_bsdf::{MerlTable, ModelSpec, NamedBsdf};
use gonio_light::{Attenuation, Convention};
use gonio_mesh::Mesh;
use gonio_reference::ReferenceScene;
use gonio_scene::MaterialBrdf;
use std::f64::consts::FRAC_1_PI;
use std::sync::Arc;

/// The unit sphere by latitude and longitude with exact normals.
fn sphere(rings: u32) -> Mesh {
    let segments = 2 * rings;
    let mut mesh = Mesh::default();
    for ring in 0..=rings {
        for segment in 0..segments {
            let theta = std::f64::consts::PI * f64::from(ring) / f64::from(rings);
            let phi = std::f64::consts::TAU * f64::from(segment) / f64::from(segments);
            let p = [theta.sin() * phi.cos(), theta.cos(), -theta.sin() * phi.sin()].map(|v| v as f32);
            mesh.positions.push(p);
            mesh.normals.push(p);
        }
    }
    for ring in 0..rings {
        for segment in 0..segments {
            let next = (segment + 1) % segments;
            let [a, b] = [segment, next].map(|s| ring * segments + s);
            let [c, d] = [segment, next].map(|s| (ring + 1) * segments + s);
            mesh.indices.extend([a, c, d, a, d, b]);
        }
    }
    mesh
}

fn square() -> Mesh {
    Mesh {
        positions: vec![[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]],
        normals: vec![[0.0, 0.0, 1.0]; 4],
        indices: vec![0, 1, 2, 0, 2, 3],
        ..Mesh::default()
    }
}

fn model(text: &str) -> NamedBsdf {
    NamedBsdf::of_model(&ModelSpec::parse(text).unwrap())
}

fn with(mut scene: TestScene, mesh: Mesh, named: NamedBsdf) -> TestScene {
    scene.scene.add_object(mesh, Arc::new(MaterialBrdf::new(named)).into(), DMat4::IDENTITY);
    scene
}

fn pixels(scene: &TestScene) -> Vec<DVec3> {
    let picture = ReferenceScene::new(&scene.scene).render(&scene.frame, None, &|_| ()).picture;
    picture.pixels.iter().map(|p| DVec3::new(p[0].into(), p[1].into(), p[2].into())).collect()
}

/// `pi diff f <N.L>` times the light, and `A` as before: the model of Lambert is the lab's diffuse term in the lab's
/// convention, and `a / pi` in the physical one.
#[test]
fn light_keeps_its_unit() {
    let middle = |convention, brdf: &str| {
        let scene = with(TestScene::new(), square(), model(brdf)).light(directional([0.0, -3.0, -4.0], 2.0));
        let scene = scene.light(ambient(0.5)).frame(|frame| frame.equation.convention = convention);
        pixels(&scene)[33 * 16 + 16].x
    };
    // cos = 0.8; ambient light on k_a = 0.6.
    let expected = |factor: f64| 0.6 * 0.8 * 2.0 * factor + 0.6 * 0.5;
    assert!((middle(Convention::Lab, "lambert:a=0.6") - expected(1.0)).abs() < 1e-6);
    assert!((middle(Convention::Physical, "lambert:a=0.6") - expected(FRAC_1_PI)).abs() < 1e-6);
}

/// The direction of grooves without texture coordinates: around the vertical axis, whatever the object's rotation.
#[test]
fn grooves_run_around_the_vertical_axis() {
    let bright = |direction: [f64; 3]| {
        let named = model("ward-anisotropic:cx=0.6,cy=0.1,b=0.8");
        pixels(&with(TestScene::new(), square(), named).light(directional(direction, 1.0)))[33 * 16 + 16].x
    };
    // ax is the slope along the tangent, the horizontal: light from the left is scattered farther than light from above.
    let (beside, above) = (bright([-0.6, 0.0, -0.8]), bright([0.0, -0.6, -0.8]));
    assert!(beside > 10.0 * above && beside > 0.05, "{beside} and {above}");
}

/// A MERL file written from a model renders within 1 % RMS of the model (issue 19).
#[test]
fn a_table_looks_like_the_model_it_was_made_from() {
    for text in [
        "lambert:a=0.8/0.4/0.2",
        "oren-nayar",
        "blinn-normalised:a=0.2,b=0.5",
        "ward:a=0.2/0.1/0.1,b=0.4,c=0.2",
        "ggx:a=0.1/0.2/0.3,f0=0.6/0.5/0.4,alpha=0.3",
        "ggx:f0=0.9,alpha=0.1",
        "disney:",
    ] {
        let lit = |named: NamedBsdf| {
            let scene = with(TestScene::new(), sphere(48), named)
                .light(directional([-1.0, -2.0, -1.5], 1.0))
                .light(point([3.0, 1.0, 3.0], 0.8, Attenuation::NONE))
                .light(directional([2.0, 0.5, 1.0], 0.6))
                .light(ambient(0.1));
            pixels(&scene.frame(|frame| (frame.width, frame.height, frame.samples) = (96, 96, 4)))
        };
        let table = MerlTable::tabulate(model(text).bsdf.as_ref()).unwrap();
        // By way of the file.
        let table = MerlTable::read(&table.write()).unwrap();
        let (expected, found) = (lit(model(text)), lit(NamedBsdf::of_table("table.binary", table)));
        let square = |sum: f64, v: DVec3| sum + v.length_squared();
        let error = expected.iter().zip(&found).map(|(a, b)| *a - *b).fold(0.0, square).sqrt();
        let whole = expected.iter().copied().fold(0.0, square).sqrt();

        assert!(whole > 1.0 && error <= 0.01 * whole, "{text}: {:.3} %", 100.0 * error / whole);
    }
}
