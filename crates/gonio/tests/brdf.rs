//! `gonio brdf`: what its commands print and write, and what they refuse.
#![allow(clippy::unwrap_used)]

mod common;
use common::{Lab, Run};
use serde_json::Value;

impl Lab {
    fn brdf(&self, args: &[&str]) -> Run {
        self.run(&[&["brdf"], args].concat())
    }
}

/// The names of the properties that a function of a report does not have.
fn failed(function: &Value) -> Vec<&str> {
    let properties = function["properties"].as_array().unwrap();
    properties.iter().filter(|p| p["passed"] == false).map(|p| p["property"].as_str().unwrap()).collect()
}

const HALF_LAMBERT: &str = "\
// Half of the light, whatever the directions.
vec3 BRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y)
{
    return vec3(0.5 / 3.14159265);
}
";

const NAMED_AS_BUILT_IN: &str = "\
analytic
::begin parameters
float sin 0 1 0.5
::end parameters
::begin shader
vec3 BRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y) { return vec3(sin * sin(dot(N, L))); }
::end shader
";

#[test]
fn models_are_listed_and_shown() {
    let lab = Lab::new();
    let json = lab.brdf(&["list", "--json"]).good().json();
    let models = json["models"].as_array().unwrap();
    assert_eq!(models.len(), 24);
    let text = lab.brdf(&["list"]).good();
    for model in models {
        let name = model["name"].as_str().unwrap();
        assert!(text.text().contains(&format!("{name}  ")), "{name}");
        let shown = lab.brdf(&["show", name]).good();
        for key in ["formula", "source", "remark"] {
            assert!(shown.text().contains(model[key].as_str().unwrap()), "{name} {key}");
        }
    }
    let shown = lab.brdf(&["show", "ward:c=0.25", "--glsl"]).good();
    assert!(shown.text().contains("const float c = 0.25;") && shown.text().contains("vec3 BRDF("), "{}", shown.text());
    let json = lab.brdf(&["show", "oren-nayar:sigma=30", "--json"]).good().json();
    assert_eq!((&json["parameters"][1]["value"], &json["parameters"][1]["unit"]), (&30.0.into(), &"degrees".into()));
    lab.brdf(&["show", "dielectric", "--glsl"]).refused(&["`dielectric` has no GLSL function"]);
}

#[test]
fn checks_end_with_the_exit_code_of_their_verdict() {
    let lab = Lab::new();
    lab.write("own.glsl", HALF_LAMBERT);
    lab.write("bright.glsl", HALF_LAMBERT.replace("0.5", "1.5"));
    lab.write("one-way.glsl", HALF_LAMBERT.replace("0.5 /", "dot(N, V) /"));
    let good = lab.brdf(&["check", "ggx", "own.glsl", "--json"]).good().json();
    assert_eq!(good["passed"], true);
    // An albedo of 1/2 in every direction.
    let energy = &good["functions"][1]["properties"][1];
    assert!((energy["value"].as_f64().unwrap() - 0.5).abs() < 1e-3, "{energy}");
    let bad = lab.brdf(&["check", "bright.glsl", "one-way.glsl", "lafortune-printed:k=3", "--json"]);
    assert_eq!(bad.code, 1, "{}", bad.stderr);
    let json = bad.json();
    let all: Vec<Vec<&str>> = json["functions"].as_array().unwrap().iter().map(failed).collect();
    assert_eq!(all, [vec!["energy"], vec!["reciprocity"], vec!["positivity"]]);
    // Where it happens: the light grazes the surface.
    let grazing = lab.brdf(&["check", "ward:b=1,c=0.5", "--json"]);
    let json = grazing.json();
    assert_eq!((grazing.code, failed(&json["functions"][0])), (1, vec!["energy"]));
    let energy = &json["functions"][0]["properties"][1];
    assert!(
        energy["value"].as_f64().unwrap() > 1.4 && energy["light"]["theta_deg"].as_f64().unwrap() > 89.0,
        "{energy}"
    );
    let text = lab.brdf(&["check", "bright.glsl"]);
    assert!(text.text().contains("FAIL  energy") && text.text().contains("pass  reciprocity"), "{}", text.text());
}

#[test]
fn exports_are_read_again_and_fitted() {
    let lab = Lab::new();
    let truth = "ward:a=0.2/0.1/0.05,b=0.3,c=0.2";
    for name in ["ward.binary", "ward.brdf", "ward.glsl", "ward.csv"] {
        lab.brdf(&["export", truth, "-o", name]).good();
    }
    assert_eq!(lab.names(), ["ward.binary", "ward.brdf", "ward.csv", "ward.glsl"]);
    assert_eq!(lab.read("ward.binary").len(), 34_992_012);
    let shown = lab.brdf(&["show", "ward.brdf:c=0.4"]).good();
    assert!(shown.text().contains("c  0.4"), "{}", shown.text());
    lab.brdf(&["export", "ward.glsl", "-o", "again.csv"]).good();
    let values = |name: &str| {
        let text = String::from_utf8(lab.read(name)).unwrap();
        text.lines()
            .skip(1)
            .map(|line| line.split(',').next_back().unwrap().parse::<f64>().unwrap())
            .collect::<Vec<_>>()
    };
    let (first, again) = (values("ward.csv"), values("again.csv"));
    assert!(first.len() > 4000 && first.iter().any(|value| *value > 0.3));
    // f32 in GLSL.
    assert!(first.iter().zip(&again).all(|(a, b)| (a - b).abs() <= 1e-5 * a.abs().max(1e-3)));
    let fit =
        ["fit", "ward.binary", "--model", "lambert,ward", "-o", "fit.toml", "--residuals", "residuals.png", "--json"];
    let fitted = lab.brdf(&fit).good().json();
    let residuals = lab.picture("residuals.png");
    assert_eq!((residuals.width(), residuals.height()), (900, 800));
    assert_eq!((&fitted["fits"][0]["model"], &fitted["fits"][1]["model"]), (&"ward".into(), &"lambert".into()));
    let c = fitted["fits"][0]["parameters"][2]["value"].as_f64().unwrap();
    assert!((c / 0.2 - 1.0).abs() < 0.02, "{c}");
    let shown = lab.brdf(&["show", "fit.toml", "--json"]).good().json();
    assert!((shown["parameters"][2]["value"].as_f64().unwrap() - c).abs() < 1e-9);
    let silent = lab.brdf(&["plot", "ward.binary", "fit.toml", "-o", "slice.png", "--kind", "slice"]).good();
    assert_eq!((silent.text(), silent.stderr.as_str()), ("", ""));
    let text = lab.brdf(&["fit", "ward.binary", "--model", "ward", "-o", "fit.toml"]).good();
    assert!(text.text().starts_with("  0.00 %  ward:a=0.2/0.1/0.05,b=0.3,c=0.2"), "{}", text.text());
    let quiet = lab.brdf(&["fit", "ward.binary", "--model", "lambert", "-o", "fit.toml", "--quiet"]).good();
    assert_eq!((quiet.text(), quiet.stderr.as_str()), ("", ""));
    assert_eq!(lab.picture("slice.png").width(), 900);
}

/// A function as the target of a fit; without `--model`, anisotropic ones are tried where the target is anisotropic.
#[test]
fn functions_are_fitted_as_measurements_are() {
    let lab = Lab::new();
    lab.brdf(&["export", "ward-anisotropic:a=0.1,b=0.4,cx=0.15,cy=0.4", "-o", "brushed.brdf"]).good();
    let models = |target: &str| {
        let fitted = lab.brdf(&["fit", target, "-o", "fit.toml", "--residuals", "r.svg", "--json"]).good().json();
        let names = fitted["fits"].as_array().unwrap().iter().map(|fit| fit["model"].as_str().unwrap().to_owned());
        (fitted["isotropic"].as_bool().unwrap(), names.collect::<Vec<_>>())
    };
    let (is_isotropic, names) = models("brushed.brdf:cx=0.2");
    assert!(!is_isotropic && names.len() == 3 && names[0] == "ward-anisotropic", "{names:?}");
    let shown = lab.brdf(&["show", "fit.toml", "--json"]).good().json();
    let value = |name: &str| {
        let parameters = shown["parameters"].as_array().unwrap();
        parameters.iter().find(|p| p["name"] == name).unwrap()["value"].as_f64().unwrap()
    };
    assert!((value("cx") - 0.2).abs() < 0.004 && (value("cy") - 0.4).abs() < 0.008);
    let (is_isotropic, names) = models("ggx:alpha=0.3,f0=0.8");
    assert!(is_isotropic && names.len() == 4 && names[0] == "ggx", "{names:?}");
}

#[test]
fn every_kind_is_plotted_in_both_formats() {
    let lab = Lab::new();
    let kinds = ["polar", "cartesian", "lobe", "slice", "sphere", "albedo", "reciprocity", "fresnel", "samples"];
    for kind in kinds {
        for theme in ["light", "dark"] {
            let args =
                ["plot", "ggx:alpha=0.4", "-o", "plot.svg", "--kind", kind, "--theme", theme, "--scale", "cube-root"];
            lab.brdf(&args).good();
            let svg = String::from_utf8(lab.read("plot.svg")).unwrap();
            assert!(svg.starts_with("<svg ") && svg.trim_end().ends_with("</svg>"), "{kind}");
        }
        lab.brdf(&["plot", "ggx", "-o", "plot.png", "--kind", kind, "--size", "300x260", "--theta", "60"]).good();
        let picture = lab.picture("plot.png").to_rgb8();
        assert_eq!(picture.dimensions(), (300, 260));
        let ink = picture.pixels().filter(|pixel| pixel.0 != [255; 3]).count();
        assert!(ink > 1000, "{kind}: {ink}");
    }
    lab.write("a<b>&.glsl", HALF_LAMBERT);
    lab.brdf(&["plot", "a<b>&.glsl", "-o", "escaped.svg"]).good();
    let svg = String::from_utf8(lab.read("escaped.svg")).unwrap();
    assert!(svg.contains("a&lt;b&gt;&amp;.glsl"));
}

#[test]
fn the_bench_is_not_opened_with_functions_that_it_cannot_hold() {
    let lab = Lab::new();
    lab.brdf(&["view", "wart"]).refused(&["unknown model `wart`"]);
    lab.brdf(&["view", "missing.binary"]).refused(&["cannot read `missing.binary`"]);
    let eight = [&["view"][..], &["lambert"; 8]].concat();
    lab.brdf(&eight).refused(&["8 functions on the bench: expected at most 7"]);
}

#[test]
fn bad_input_is_refused_in_one_sentence() {
    let lab = Lab::new();
    let refused = |args: &[&str], pieces: &[&str]| {
        lab.brdf(args).refused(pieces);
    };
    refused(&["plot", "wart", "-o", "x.svg"], &["unknown model `wart`: expected one of lambert, "]);
    refused(
        &["plot", "ward:c=5", "-o", "x.svg"],
        &["invalid value `5` of parameter `c`: expected a number from 0.01 to 1"],
    );
    refused(&["plot", "ward", "-o", "x.gif"], &["expected a file that ends with .svg or .png"]);
    refused(&["plot", "ward", "-o", "x.svg", "--theta", "90"], &["90 degrees: expected 0 to less than 90"]);
    refused(&["plot", "ward", "-o", "x.svg", "--kind", "fresnel"], &["no function has an index of refraction above 1"]);
    refused(&["plot", "missing.brdf", "-o", "x.svg"], &["cannot read `missing.brdf`: no such file"]);
    refused(&["export", "rough-dielectric", "-o", "x.binary"], &["cannot hold a function that transmits light"]);
    refused(&["export", "ward-anisotropic", "-o", "x.binary"], &["cannot hold a function that is anisotropic"]);
    refused(&["export", "ward", "-o", "x.txt"], &["ends with .binary, .glsl, .brdf or .csv"]);
    refused(&["fit", "missing.binary", "-o", "x.toml"], &["cannot read `missing.binary`"]);
    refused(&["fit", "missing.binary", "-o", "x.toml", "--residuals", "x.gif"], &["unknown format of `x.gif`"]);
    refused(&["fit", "missing.binary", "-o", "-", "--residuals", "x.svg", "--json"], &["both write to stdout"]);
    refused(&["fit", "missing.binary", "-o", "x.toml", "--model", "wart"], &["unknown model `wart`"]);
    refused(&["fit", "rough-dielectric", "-o", "x.toml"], &["a function that transmits light cannot be fitted"]);
    refused(
        &["fit", "lambert", "-o", "x.toml", "--model", "ward,phong-printed"],
        &["`phong-printed` cannot be fitted: expected one of lambert"],
    );
    lab.write("cut.binary", [90_i32, 90, 180].map(i32::to_le_bytes).concat());
    refused(
        &["fit", "cut.binary", "-o", "x.toml"],
        &["cut.binary: the file is truncated: it has 12 of 34992012 bytes"],
    );
    refused(&["check", "cut.binary"], &["cut.binary: the file is truncated"]);
    // Longer than what is read of any file.
    std::fs::File::create(lab.path("long.binary")).unwrap().set_len(80_000_000).unwrap();
    let too_long = "the file is too long: it has 80000000 bytes, expected 34992012";
    refused(&["check", "long.binary"], &["long.binary", too_long]);
    let material = ["render", "builtin:cube", "-o", "x.png", "--brdf-file", "long.binary"];
    lab.run(&material).refused(&["long.binary", too_long]);
    lab.write("typo.glsl", HALF_LAMBERT.replace("vec3(0.5", "vec4(0.5"));
    refused(&["check", "typo.glsl"], &["typo.glsl:4:"]);
    // A parameter may have the name of a built-in function.
    lab.write("named.brdf", NAMED_AS_BUILT_IN);
    let drawn = [
        "render",
        "builtin:cube",
        "--size",
        "40x30",
        "--backend",
        "gl",
        "-o",
        "named.png",
        "--brdf-file",
        "named.brdf",
    ];
    lab.run(&drawn).good();
    lab.write("endless.glsl", HALF_LAMBERT.replace("return", "while (true) {} return"));
    refused(&["check", "endless.glsl"], &["endless.glsl:4:5: the function does not end"]);
    lab.write("noise.dat", [0x80, 0xff, 0x00]);
    refused(&["check", "noise.dat"], &["noise.dat: unknown format: expected a MERL .binary"]);
    assert!(!lab.names().iter().any(|name| name.starts_with("x.")), "{:?}", lab.names());
}

/// The same picture by the model, by a fit of its table, by both renderers; and the page of the probe.
#[test]
fn models_and_files_are_materials() {
    let lab = Lab::new();
    let model = "ggx:a=0.1,f0=0.9/0.6/0.3,alpha=0.3";
    lab.brdf(&["export", model, "-o", "ggx.binary"]).good();
    lab.brdf(&["fit", "ggx.binary", "--model", "ggx", "-o", "fit.toml"]).good();
    let draw = |name: &str, backend: &str, option: &[&str]| {
        let fixed = ["render", "builtin:suzanne", "--size", "80x60", "--backend", backend, "-o", name];
        lab.run(&[&fixed, option].concat()).good();
        lab.picture(name).to_rgb8()
    };
    let by_reference = draw("model.png", "cpu", &["--brdf", model]);
    let by_opengl = draw("model-gl.png", "gl", &["--brdf", model]);
    let differing = |a: &image::RgbImage, b: &image::RgbImage| {
        a.as_raw().iter().zip(b.as_raw()).filter(|(a, b)| a.abs_diff(**b) > 3).count()
    };
    let percent = 3 * 80 * 60 / 100;
    // The renderers smooth outlines differently, which are many in a small picture.
    assert!(differing(&by_reference, &by_opengl) < 6 * percent, "{}", differing(&by_reference, &by_opengl));
    for (backend, expected) in [("cpu", &by_reference), ("gl", &by_opengl)] {
        for file in ["fit.toml", "ggx.binary"] {
            let picture = draw("file.png", backend, &["--brdf-file", file]);
            // The table's resolution towards the horizon.
            let count = differing(&picture, expected);
            assert!(count < 3 * percent, "{file}, {backend}: {count} values differ");
        }
    }
    let plain = draw("plain.png", "cpu", &[]);
    assert!(differing(&plain, &by_reference) > 20 * percent);
    let at = ["probe", "builtin:suzanne", "--size", "80x60", "--at", "40,17", "--brdf-file", "fit.toml"];
    let page = lab.run(&at).good();
    assert!(
        page.text().contains("fit.toml: ggx") && page.text().contains("pi * diff * f * <N.L_i>"),
        "{}",
        page.text()
    );
    lab.run(&[
        "trace",
        "builtin:cube",
        "--size",
        "8x6",
        "--samples",
        "1",
        "--brdf",
        "rough-dielectric:",
        "-o",
        "t.png",
    ])
    .good();
    let refused = |option: &[&str], pieces: &[&str]| {
        lab.run(&[&["render", "builtin:cube", "-o", "x.png"], option].concat()).refused(pieces);
    };
    refused(&["--brdf", "ggx:alpha=7"], &["invalid value `7` of parameter `alpha`: expected a number from 0.01 to 1"]);
    refused(&["--brdf", "fit.toml"], &["unknown BRDF `fit.toml` (a file is named by --brdf-file)"]);
    refused(&["--brdf-file", "missing.toml"], &["missing.toml: there is no such file"]);
    refused(&["--brdf-file", "fit.toml:alpha=7"], &["fit.toml: invalid value `7` of parameter `alpha`"]);
    lab.write("typo.glsl", HALF_LAMBERT.replace("vec3(0.5", "vec4(0.5"));
    refused(&["--brdf-file", "typo.glsl"], &["typo.glsl:4:"]);
    refused(&["--brdf", "ggx", "--brdf-file", "fit.toml"], &["cannot be used with"]);
    assert!(!lab.names().iter().any(|name| name.starts_with("x.")), "{:?}", lab.names());
}
