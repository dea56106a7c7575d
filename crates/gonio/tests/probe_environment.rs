//! `gonio probe` in an environment: its terms, their sum, and the sky where no object is visible.
#![allow(clippy::unwrap_used, missing_docs)]

mod common;

use common::{Lab, asset};
use serde_json::Value;

fn numbers(v: &Value) -> Vec<f64> {
    v.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
}

#[test]
fn every_term_of_glass_is_listed() {
    let lab = Lab::new();
    let cube = asset("cube.obj");
    let size = ["--size", "48x32", "--backend", "cpu", "--environment", "debug"];
    let options = ["--material", "glass,surfaces=two,transmission=0.6,reflectivity=0.5,dispersion=0.02"];
    let args = [&["probe", &cube, "--at", "24,16"], &size[..], &options[..]].concat();
    let run = lab.run(&args).good();
    let terms =
        ["environment `debug`", "surfaces              two", "E(R)", "(1-F) * tint * E(T)", "L = (1-t)", "indices"];
    for word in terms {
        assert!(run.text().contains(word), "{word} is not in {}", run.text());
    }
    let json = lab.run(&[&args[..], &["--json"]].concat()).good().json();
    let probe = &json["probe"];
    let (optics, seen) = (&probe["optics"], &probe["terms"]["environment"]);
    assert_eq!((&optics["fresnel"], &optics["surfaces"]), (&"exact".into(), &"two".into()));
    let (t, sight) = (optics["transmission"].as_f64().unwrap(), &seen["sight"]);
    let [lit, diffuse, specular] = [&probe["lit"], &seen["diffuse"], &seen["specular"]].map(numbers);
    let [f, reflected, through] = [&sight["fresnel"], &sight["reflected"], &sight["transmitted"]].map(numbers);
    let w = optics["reflectivity"].as_f64().unwrap() * f[1];
    let reference = numbers(&json["reference"]);
    for c in 0..3 {
        let lit = lit[c] + diffuse[c] + specular[c];
        let sum = (1.0 - t) * ((1.0 - w) * lit + w * reflected[c]) + t * (f[c] * reflected[c] + through[c]);
        // The same sum in another order.
        assert!((sum - reference[c]).abs() < 1e-12, "{c}: {sum} is not {}", reference[c]);
    }
    assert!(f[0] > 0.0 && f[0] < f[1] && f[1] < f[2] && reflected != [0.0; 3]);
}

#[test]
fn where_no_object_is_visible_the_sky_is() {
    let lab = Lab::new();
    let cube = asset("cube.obj");
    // The upper left of the debug cubemap ahead; it hides the background.
    let args = ["probe", &cube, "--at", "0,0", "--backend", "cpu", "--environment", "debug", "--background", "0,0,0"];
    let run = lab.run(&args).good();
    assert!(run.text().contains("none is visible there, only the environment"), "{}", run.text());
    let json = lab.run(&[&args[..], &["--json"]].concat()).good().json();
    let sky = numbers(&json["reference"]);
    assert!(json["hit"] == false && sky[..3] != [0.0; 3] && sky[3] == 1.0, "{sky:?}");
    // Unseen, it leaves the background.
    let args = [&args[..], &["--environment-visible=false", "--json"]].concat();
    assert_eq!(lab.run(&args).good().json()["reference"], serde_json::json!([0.0, 0.0, 0.0, 1.0]));
}
