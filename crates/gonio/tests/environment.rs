//! `gonio environment`, and scenes with an environment: commands and the pixels that they write.
#![allow(clippy::unwrap_used)]

mod common;

use common::{Lab, Run};
use glam::DVec3;
use gonio_environment::{Cubemap, Face, Layout, Panorama};
use gonio_image::decode::{self, Decoded, DecodedContent};
use gonio_image::encode::{exr, hdr, png};
use gonio_image::{DecodeLimits, Image};
use gonio_light::color::OutputTransform;

/// Directions of the debug cubemap and the colours of their faces (sRGB), from its documentation.
const GROUNDS: [(&str, [u8; 3]); 6] = [
    ("+X", [240, 168, 48]),
    ("-X", [184, 74, 0]),
    ("+Y", [120, 208, 168]),
    ("-Y", [0, 104, 80]),
    ("+Z", [116, 190, 236]),
    ("-Z", [0, 84, 148]),
];

fn distance(a: [u8; 3], b: [u8; 3]) -> u32 {
    a.iter().zip(b).map(|(a, b)| u32::from(a.abs_diff(b))).sum()
}

/// The direction whose ground colour is nearest to a colour.
fn direction_of(color: [u8; 3]) -> &'static str {
    GROUNDS.iter().min_by_key(|(_, ground)| distance(color, *ground)).unwrap().0
}

/// The pixel of an 8-bit picture at a position from -1 to 1, to the right and down.
fn at(picture: &image::RgbImage, s: f64, t: f64) -> [u8; 3] {
    let index = |v: f64, side: u32| (0.5 * (v + 1.0) * f64::from(side)) as u32;
    picture.get_pixel(index(s, picture.width()), index(t, picture.height())).0
}

/// A position on a debug face without any drawing.
const GROUND: f64 = 0.62;
/// The mark in the visible upper left corner of a debug face.
const MARK: f64 = -0.9;

impl Lab {
    fn environment(&self, args: &[&str]) -> Run {
        self.run(&[&["environment"], args].concat())
    }

    fn convert(&self, args: &[&str]) -> Run {
        self.environment(&[&["convert"], args].concat()).good()
    }

    fn rgb(&self, name: &str) -> image::RgbImage {
        self.picture(name).into_rgb8()
    }

    fn decoded(&self, name: &str) -> Decoded {
        decode::decode(name, &self.read(name), &DecodeLimits::default()).unwrap_or_else(|e| panic!("{e}"))
    }

    fn image(&self, name: &str) -> Image {
        match self.decoded(name).shape {
            DecodedContent::Picture(image) => image,
            DecodedContent::Faces(_) => panic!("{name} has six faces"),
        }
    }

    /// Names in a folder, sorted.
    fn within(&self, folder: &str) -> Vec<String> {
        let entries = std::fs::read_dir(self.path(folder)).unwrap();
        let mut names: Vec<String> = entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    /// Six faces as files.
    fn write_faces(&self, folder: &str, ending: &str, faces: &[Image; 6], encode: impl Fn(&Image) -> Vec<u8>) {
        std::fs::create_dir(self.path(folder)).unwrap();
        for (face, image) in Face::ALL.into_iter().zip(faces) {
            self.write(&format!("{folder}/{}.{ending}", face.name()), encode(image));
        }
    }
}

fn names(ending: &str) -> Vec<String> {
    let mut names = Face::ALL.map(|f| format!("{}.{ending}", f.name())).to_vec();
    names.sort();
    names
}

/// Light from 0.2 to 2.2 that differs in every direction.
fn light(d: DVec3) -> DVec3 {
    let wave = |k: DVec3, phase: f64| 1.2 + (k.dot(d) + phase).sin();
    DVec3::new(
        wave(DVec3::new(3.0, 1.0, -2.0), 0.3),
        wave(DVec3::new(2.0, -4.0, 1.5), 2.0),
        wave(DVec3::new(1.0, 2.5, 5.0), 4.0),
    )
}

fn hdr_panorama(width: u32) -> Vec<u8> {
    hdr::encode(&Panorama::from_function(width, width / 2, light).image).unwrap().bytes
}

#[test]
fn the_debug_cubemap_is_right_in_both_layouts() {
    for (layout, of_files) in [
        ("opengl", [("posx", "+X"), ("negx", "-X"), ("posy", "+Y"), ("negy", "-Y"), ("posz", "+Z"), ("negz", "-Z")]),
        // `posz` is ahead.
        (
            "photographic",
            [("posx", "+X"), ("negx", "-X"), ("posy", "+Y"), ("negy", "-Y"), ("posz", "-Z"), ("negz", "+Z")],
        ),
    ] {
        let lab = Lab::new();
        let run = lab.convert(&["debug", "out", "--size", "64", "--layout", layout]);
        assert!(run.stderr.contains(&format!("six faces of 64 x 64, {layout} layout")), "{}", run.stderr);
        assert_eq!((lab.names(), lab.within("out")), (vec!["out".to_owned()], names("png")));
        for (file, direction) in of_files {
            let picture = lab.rgb(&format!("out/{file}.png"));
            assert_eq!(picture.dimensions(), (64, 64));
            let ground = at(&picture, GROUND, GROUND);
            assert_eq!(direction_of(ground), direction, "{layout} {file}");
            // The mark is in the visible upper left corner. OpenGL's faces are mirrored: the columns of its sides and
            // the rows of its top and bottom are reversed.
            let marked = match (layout, file) {
                ("photographic", _) => (MARK, MARK),
                (_, "posy" | "negy") => (MARK, -MARK),
                _ => (-MARK, MARK),
            };
            for corner in [(MARK, MARK), (-MARK, MARK), (MARK, -MARK), (-MARK, -MARK)] {
                let is_ink = distance(at(&picture, corner.0, corner.1), ground) > 150;
                assert_eq!(is_ink, corner == marked, "{layout} {file} {corner:?}");
            }
        }
    }
}

#[test]
fn an_environment_rotates_as_documented() {
    let lab = Lab::new();
    // A positive yaw rotates the part ahead to the left, a positive pitch rotates it up; a roll rotates the right side up.
    for (angles, file, direction) in [
        ("90,0,0", "negx", "-Z"),
        ("0,90,0", "posy", "-Z"),
        ("0,0,90", "posy", "+X"),
        ("-90,0,0", "posx", "-Z"),
        // Pitch before yaw: the part ahead is raised and stays above.
        ("90,90,0", "posy", "-Z"),
    ] {
        lab.convert(&["debug", "out", "--size", "32", "--rotate", angles]);
        let ground = at(&lab.rgb(&format!("out/{file}.png")), GROUND, GROUND);
        assert_eq!(direction_of(ground), direction, "{angles}");
    }
}

/// If only the arrangement changes, no texel is resampled.
#[test]
fn every_arrangement_contains_the_same_faces() {
    let lab = Lab::new();
    lab.write("panorama.hdr", hdr_panorama(32));
    lab.convert(&["panorama.hdr", "faces"]);
    assert_eq!(lab.within("faces"), names("exr"));
    let mut before = "faces".to_owned();
    for (kind, file, size) in [
        ("cross", "a.exr", (32, 24)),
        ("vertical-cross", "b.exr", (24, 32)),
        ("strip", "c.exr", (48, 8)),
        ("vertical-strip", "d.exr", (8, 48)),
    ] {
        lab.convert(&[&before, file, "--to", kind, "--from-layout", "opengl"]);
        let image = lab.image(file);
        assert_eq!((image.width, image.height), size, "{kind}");
        before = file.to_owned();
    }
    lab.convert(&[&before, "e.ktx2", "--from-layout", "opengl"]);
    // KTX2 has OpenGL's layout by default.
    lab.convert(&["e.ktx2", "photographic", "--layout", "photographic"]);
    lab.convert(&["photographic", "again"]);
    assert_eq!(lab.within("again"), names("exr"));
    for file in names("exr") {
        let bytes = |folder: &str| lab.read(&format!("{folder}/{file}"));
        assert!(bytes("again") == bytes("faces") && bytes("photographic") != bytes("faces"), "{file}");
    }
}

#[test]
fn a_panorama_survives_conversion_to_faces_and_back() {
    let lab = Lab::new();
    lab.write("panorama.hdr", hdr_panorama(128));
    lab.convert(&["panorama.hdr", "faces", "--size", "64", "--format", "exr"]);
    for (i, face) in Face::ALL.into_iter().enumerate() {
        let image = lab.image(&format!("faces/{}.exr", face.name()));
        let direction = face.direction(0.0, 0.0, Layout::OpenGl);
        let [r, g, b, _] = image.at(32, 32);
        let expected = light(direction);
        // The middle of a texel is 1/64 from the face's middle; waves of length 1 to 6 change by up to 0.1 over that distance.
        assert!(DVec3::new(r.into(), g.into(), b.into()).abs_diff_eq(expected, 0.15), "{i}: {r} {g} {b} {expected}");
    }
    for (output, more, size) in [
        ("back.hdr", &["--from-layout", "opengl", "--size", "128"][..], (128, 64)),
        ("odd.exr", &["--from-layout", "opengl", "--size", "100x30", "--filter", "bicubic"], (100, 30)),
        ("own.exr", &["--from-layout", "opengl"], (256, 128)),
    ] {
        lab.convert(&[&["faces", output], more].concat());
        let image = lab.image(output);
        assert_eq!((image.width, image.height), size, "{output}");
        let expected = Panorama::from_function(size.0, size.1, light).image;
        let difference = |(a, b): (&[f32; 4], &[f32; 4])| (a[0] - b[0]).abs().max((a[1] - b[1]).abs());
        let worst = image.pixels.iter().zip(&expected.pixels).map(difference).fold(0.0, f32::max);
        // Two bilinear lookups on grids of 1/20, and RGBE's hundredth of 2.2.
        assert!(worst < 0.05, "{output}: {worst}");
    }
    // A mirrored world differs.
    lab.convert(&["faces", "mirrored.hdr", "--size", "128"]);
    assert!(lab.read("mirrored.hdr") != lab.read("back.hdr"));
}

#[test]
fn faces_have_the_requested_format() {
    let lab = Lab::new();
    lab.write("panorama.hdr", hdr_panorama(32));
    for (folder, more, ending) in [
        ("a", &["--format", "png"][..], "png"),
        ("b", &["--format", "hdr"], "hdr"),
        ("c", &["--format", "exr"], "exr"),
        ("d", &["--bits", "16"], "png"),
        ("e.v2", &[], "exr"),
    ] {
        lab.convert(&[&["panorama.hdr", folder, "--size", "4"], more].concat());
        assert_eq!(lab.within(folder), names(ending), "{folder}");
    }
    assert_eq!(lab.picture("a/posx.png").color(), image::ColorType::Rgb8);
    assert_eq!(lab.picture("d/posx.png").color(), image::ColorType::Rgb16);
    // RGBE's mantissas have 8 bits: half a step of 2.2.
    let (hdr, exr) = (lab.image("b/posx.hdr"), lab.image("c/posx.exr"));
    let close = |(a, b): (&[f32; 4], &[f32; 4])| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 0.01);
    assert!(hdr.pixels.iter().zip(&exr.pixels).all(close));
    // A second set in the folder is a warning: a reader could not choose between them.
    let run = lab.convert(&["panorama.hdr", "a", "--size", "4"]);
    let path = std::path::Path::new("a").join("posx.png");
    assert!(run.stderr.contains(&format!("warning: `{}` belongs to another set", path.display())), "{}", run.stderr);
    lab.convert(&["a/*.exr", "again.exr"]);
}

#[test]
fn exposure_and_tone_map_act_on_8_bits() {
    let lab = Lab::new();
    let grey = |value: f32| hdr::encode(&Image::new(8, 4, [value, value, value, 1.0])).unwrap().bytes;
    lab.write("grey.hdr", grey(0.25));
    lab.write("white.hdr", grey(4.0));
    for (input, more, expected) in [
        // sRGB of 1/8, 1/4, 1/2.
        ("grey.hdr", &["--exposure", "-1"][..], 99),
        ("grey.hdr", &[], 137),
        ("grey.hdr", &["--exposure", "1"], 188),
        ("white.hdr", &["--exposure", "-3"], 188),
        // 1 / (1 + 1)
        ("white.hdr", &["--exposure", "-2", "--tone-map", "reinhard"], 188),
    ] {
        let run = lab.convert(&[&[input, "out.png"], more].concat());
        assert_eq!(lab.rgb("out.png").get_pixel(3, 2).0, [expected; 3], "{input} {more:?}");
        assert!(!run.stderr.contains("clipped"), "{}", run.stderr);
    }
    let run = lab.convert(&["white.hdr", "out.png"]);
    assert!(run.stderr.contains("warning: 100.0 % of the pixels are too bright"), "{}", run.stderr);
    for more in [["--exposure", "1"], ["--tone-map", "aces"]] {
        let args = [&["environment", "convert", "white.hdr", "out.exr"], &more[..]].concat();
        lab.run(&args).refused(&["--exposure and --tone-map apply to PNG only"]);
    }
}

#[test]
fn a_conversion_is_reported() {
    let lab = Lab::new();
    lab.write("panorama.hdr", hdr_panorama(32));
    let json = lab.convert(&["panorama.hdr", "out", "--size", "4", "--json"]).json();
    assert_eq!((&json["from"]["arrangement"], &json["to"]), (&"equirectangular".into(), &"faces".into()));
    assert_eq!((&json["layout"], &json["filter"]), (&"opengl".into(), &"area".into()), "{json}");
    assert_eq!((json["size"].to_string(), json["outputs"].as_array().unwrap().len()), ("[4,4]".to_owned(), 6));
    let json = lab.convert(&["out", "back.png", "--size", "64", "--json"]).json();
    assert_eq!((&json["from"]["layout"], &json["layout"]), (&"photographic".into(), &serde_json::Value::Null));
    assert_eq!((&json["filter"], json["size"].to_string()), (&"bilinear".into(), "[64,32]".to_owned()));
    let quiet = lab.convert(&["out", "back.png", "--size", "64", "--quiet"]);
    assert_eq!((quiet.text(), quiet.stderr.as_str()), ("", ""));
}

/// Faces of 32 texels; and the same with `negy` turned by a quarter and `posx`, `negx` swapped. (With half a turn the world
/// would be the same as with `posz`, `negz` swapped and `posy` turned, but for its own half turn.)
fn right_and_wrong() -> ([Image; 6], [Image; 6]) {
    let right = Cubemap::from_function(32, |d| 0.4 * light(d)).faces(Layout::Photographic);
    let mut wrong = right.clone();
    wrong.swap(Face::PosX as usize, Face::NegX as usize);
    let below = &right[Face::NegY as usize];
    for (i, pixel) in wrong[Face::NegY as usize].pixels.iter_mut().enumerate() {
        *pixel = below.at(i as u32 / 32, 31 - i as u32 % 32);
    }
    (right, wrong)
}

#[test]
fn a_check_names_and_writes_the_repair() {
    let lab = Lab::new();
    let (right, wrong) = right_and_wrong();
    let png8 = |image: &Image| png::encode(image, &OutputTransform::default(), png::Depth::Eight).unwrap();
    lab.write_faces("right", "png", &right, png8);
    lab.write_faces("wrong", "png", &wrong, png8);
    let run = lab.environment(&["check", "right"]).good();
    assert!(run.text().starts_with("right: six faces of 32 x 32, photographic layout\n"), "{}", run.text());
    let run = lab.environment(&["check", "wrong"]);
    assert_eq!(run.code, 1, "{}", run.stderr);
    for sentence in ["`negy` is turned by 90 degrees clockwise", "`posx` and `negx` are swapped"] {
        assert!(run.text().contains(sentence), "{}", run.text());
    }
    assert_eq!(lab.names(), ["right", "wrong"], "nothing is written without --repair");

    let run = lab.environment(&["check", "wrong", "--repair", "repaired"]).good();
    assert!(run.text().contains("repaired: "), "{}", run.text());
    assert_eq!(lab.within("repaired"), names("png"));
    for file in names("png") {
        let pixels = |folder: &str| lab.rgb(&format!("{folder}/{file}")).into_raw();
        assert!(pixels("repaired") == pixels("right"), "{file}");
    }
    lab.environment(&["check", "repaired"]).good();

    let json = lab.environment(&["check", "wrong", "--json"]);
    assert_eq!(json.code, 1);
    let json = json.json();
    assert_eq!((&json["fits"], &json["details"]["verdict"]), (&false.into(), &"Misplaced".into()), "{json}");
    assert_eq!(json["details"]["changed"], serde_json::json!(["posx", "negx", "negy"]));
    assert_eq!((json["details"]["edges"].as_array().unwrap().len(), json["outputs"].to_string()), (12, "[]".into()));
    let json = lab.environment(&["check", "right", "--json"]).good().json();
    assert_eq!((&json["fits"], &json["layout"]), (&true.into(), &"photographic".into()));
}

/// Texels change their position only, in every format.
#[test]
fn a_repair_preserves_every_bit() {
    let lab = Lab::new();
    let (right, wrong) = right_and_wrong();
    let exr = |precision| move |image: &Image| exr::encode(image, precision).unwrap().bytes;
    let png16 = |image: &Image| png::encode(image, &OutputTransform::default(), png::Depth::Sixteen).unwrap();
    let rgbe = |image: &Image| hdr::encode(image).unwrap().bytes;
    for (name, ending, encode) in [
        ("deep", "png", &png16 as &dyn Fn(&Image) -> Vec<u8>),
        ("rgbe", "hdr", &rgbe),
        ("half", "exr", &exr(exr::ExrPrecision::Half)),
        ("float", "exr", &exr(exr::ExrPrecision::Float)),
    ] {
        lab.write_faces(&format!("{name}-right"), ending, &right, encode);
        lab.write_faces(&format!("{name}-wrong"), ending, &wrong, encode);
        lab.environment(&["check", &format!("{name}-wrong"), "--repair", &format!("{name}-out")]).good();
        assert_eq!(lab.within(&format!("{name}-out")), names(ending));
        for file in names(ending) {
            let pixels = |what: &str| lab.image(&format!("{name}-{what}/{file}"));
            assert!(pixels("out") == pixels("right"), "{name} {file}");
        }
    }
    // As one picture, and as KTX2: in the format of the input.
    for (kind, file, out) in [("cross", "c.exr", "c2.exr"), ("ktx2", "k.ktx2", "k2.ktx2")] {
        lab.convert(&["half-wrong", file, "--to", kind]);
        let layout = if kind == "cross" { "opengl" } else { "photographic" };
        let run = lab.environment(&["check", file, "--from-layout", layout]);
        run.refused(&["--from-layout"]);
        lab.environment(&["check", file, "--layout", "opengl", "--repair", out]).good();
        lab.environment(&["check", out, "--layout", "opengl"]).good();
    }
    let run = lab.environment(&["check", "c.exr", "--layout", "opengl", "--repair", "c.png"]);
    run.refused(&["--repair", "light above 1", ".exr or .hdr"]);
    lab.environment(&["check", "half-wrong", "--repair", "one.exr"]).refused(&["--repair of six faces needs a folder"]);
}

#[test]
fn a_panorama_is_checked_at_its_seams() {
    let lab = Lab::new();
    let panorama = Panorama::from_function(64, 32, |d| 0.4 * light(d) * if d.y > 0.0 { 1.0 } else { 0.8 }).image;
    let mut turned = Image::new(32, 64, [0.0; 4]);
    for (i, pixel) in turned.pixels.iter_mut().enumerate() {
        *pixel = panorama.at(i as u32 / 32, 31 - i as u32 % 32);
    }
    let mut cut = Image::new(48, 32, [0.0; 4]);
    for (i, pixel) in cut.pixels.iter_mut().enumerate() {
        *pixel = panorama.at(8 + i as u32 % 48, i as u32 / 48);
    }
    for (name, image) in [("right.hdr", &panorama), ("turned.hdr", &turned), ("cut.hdr", &cut)] {
        lab.write(name, hdr::encode(image).unwrap().bytes);
    }
    let check = |args: &[&str]| lab.environment(&[&["check"], args].concat());
    assert!(check(&["right.hdr"]).good().text().contains("the panorama closes"));
    let run = check(&["turned.hdr"]);
    assert!(run.code == 1 && run.text().contains("turned by 90 degrees"), "{}", run.text());
    check(&["turned.hdr", "--repair", "back.hdr"]).good();
    assert!(lab.image("back.hdr") == lab.image("right.hdr"));
    let run = check(&["cut.hdr"]);
    assert!(run.code == 1 && run.text().contains("do not meet"), "{}", run.text());
    check(&["cut.hdr", "--repair", "no.hdr"]).refused(&["what is missing cannot be repaired"]);
    check(&["turned.hdr", "--repair", "folder"]).refused(&["--repair of a panorama needs the name of a picture"]);
    assert_eq!(lab.names(), ["back.hdr", "cut.hdr", "right.hdr", "turned.hdr"]);
    check(&["nothing.hdr"]).refused(&["nothing.hdr", "there is no such file or folder"]);
}

/// A sphere in the middle of the debug cubemap, seen from +Z.
const IN_THE_MIDDLE: [&str; 9] = [
    "builtin:sphere-smooth",
    "--environment",
    "debug",
    "--environment-size",
    "64",
    "--camera-position",
    "0,0,4",
    "--camera-target",
    "0,0,0",
];

#[test]
fn a_mirror_shows_every_side_in_its_place() {
    let lab = Lab::new();
    // So fine that no pixel mixes ink and ground.
    let more = ["-o", "a.png", "--material", "mirror", "--size", "320x240", "--environment-size", "256"];
    let run = lab.render(&[&IN_THE_MIDDLE[..3], &IN_THE_MIDDLE[5..], &more].concat()).good();
    assert!(!run.stderr.contains("warning"), "{}", run.stderr);
    let picture = lab.rgb("a.png");
    // Behind the sphere is -Z.
    assert_eq!(direction_of(at(&picture, -0.9, 0.75)), "-Z");
    // Where its normal is 45 degrees from the view, it reflects the right, left, upper and lower sides, beside the letters in
    // the middle of the faces.
    let seen = [(0.39, 0.146), (-0.39, 0.146), (0.0, -0.604), (0.0, 0.479)];
    assert_eq!(seen.map(|(s, t)| direction_of(at(&picture, s, t))), ["+X", "-X", "+Y", "-Y"]);
}

#[test]
fn mirrors_and_glass_look_the_same_on_cpu_and_gpu() {
    let lab = Lab::new();
    for material in ["mirror", "glass", "water dispersion=0.1"] {
        for (backend, file) in [("cpu", "cpu.png"), ("gl", "gl.png")] {
            let more = ["-o", file, "--material", material, "--environment", "sky", "--environment-size", "64"];
            let drawn = ["render", IN_THE_MIDDLE[0], "--size", "160x120", "--samples", "1", "--backend", backend];
            lab.run(&[&drawn[..], &more, &IN_THE_MIDDLE[5..]].concat()).good();
        }
        // The project's tolerance: 0.5 % of the pixels by more than a step, edges included.
        lab.run(&["diff", "gl.png", "cpu.png", "--tolerance", "1", "--max-differing", "0.5"]).good();
        // The picture does show that material.
        let plain =
            ["render", IN_THE_MIDDLE[0], "-o", "plain.png", "--size", "160x120", "--samples", "1", "--backend", "cpu"];
        let more = ["--environment", "sky", "--environment-size", "64"];
        lab.run(&[&plain[..], &more, &IN_THE_MIDDLE[5..]].concat()).good();
        let differs = lab.run(&["diff", "plain.png", "cpu.png", "--tolerance", "1", "--max-differing", "10"]);
        assert_eq!(differs.code, 1, "{material}");
    }
}

#[test]
fn a_probe_and_a_printed_scene_contain_the_environment() {
    let lab = Lab::new();
    let more = ["--at", "32,24", "--size", "64x48", "--material", "mirror", "--backend", "cpu"];
    let run = lab.run(&[&["probe"], &IN_THE_MIDDLE[..], &more].concat()).good();
    assert!(run.text().contains("environment `debug`, intensity 1"), "{}", run.text());
    let scene = lab.run(&[&["scene"], &IN_THE_MIDDLE[..]].concat()).good();
    for line in ["[environment]", "image = \"debug\"", "layout = \"opengl\"", "size = 64", "light = true"] {
        assert!(scene.text().lines().any(|l| l == line), "`{line}` is not in {}", scene.text());
    }
    lab.write("scene.toml", scene.text());
    let draw = |input: &[&str], file: &str| {
        lab.render(&[input, &["-o", file]].concat()).good();
        lab.read(file)
    };
    assert!(draw(&["scene.toml"], "a.png") == draw(&IN_THE_MIDDLE[..], "b.png"));
    // Options replace values of the file.
    let blurred = draw(&["scene.toml", "--environment-blur", "0.5"], "c.png");
    assert!(blurred != lab.read("a.png"));
    assert!(draw(&["scene.toml", "--environment-visible=false"], "d.png") != lab.read("a.png"));
    assert!(draw(&["scene.toml", "--environment-rotate", "180,0,0"], "e.png") != lab.read("a.png"));
}
