//! The user's own shaders: `gonio render --vertex --fragment`, their values, and `gonio probe` with them.
#![allow(clippy::unwrap_used, missing_docs)]

mod common;

use common::{Lab, asset};
use serde_json::Value;

/// A floor seen from above, so that its normal and the directions at the picture's centre are known.
const FLOOR: &str = "v -1 0 1\nv 1 0 1\nv 1 0 -1\nv -1 0 -1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 1 0\n\
                     f 1/1/1 2/2/1 3/3/1 4/4/1\n";
const FROM_ABOVE: [&str; 8] =
    ["--camera-position", "0.5,2,0.5", "--camera-target", "0.5,0,0.5", "--size", "33x33", "--samples", "1"];

/// Draws the floor with shaders. Returns the run and the colour at the centre of the picture.
fn drawn_by(lab: &Lab, args: &[&str]) -> (common::Run, [u8; 3]) {
    lab.write("floor.obj", FLOOR);
    let run = lab.run(&[&["render", "floor.obj", "-o", "own.png"], args, &FROM_ABOVE[..]].concat()).good();
    (run, lab.picture("own.png").to_rgb8().get_pixel(16, 16).0)
}

/// A fragment shader with these declarations whose colour is this expression.
fn fragment(declarations: &str, color: &str) -> String {
    format!("#version 330 core\n{declarations}\nout vec4 c;\nvoid main() {{ c = vec4({color}, 1.0); }}\n")
}

#[test]
fn your_fragment_shader_gets_what_its_names_ask_for() {
    let lab = Lab::new();
    for (declarations, color, expected) in [
        ("", "1.0, 0.25, 0.0", [255, 64, 0]),
        ("in vec3 v_normal;", "0.5 + 0.5 * v_normal", [128, 255, 128]),
        ("in vec3 eyeNormal;", "0.5 + 0.5 * eyeNormal", [128, 128, 255]),
        ("in vec3 FragPos;", "FragPos", [128, 0, 128]),
        ("in vec2 TexCoords;", "TexCoords, 0.0", [191, 64, 0]),
        ("in vec3 worldPos; uniform vec3 u_view_pos;", "(u_view_pos - worldPos) / 2.0", [0, 255, 0]),
        ("in vec3 pos; uniform vec3 lightPos;", "(lightPos - pos) / 4.0", [32, 128, 0]),
        ("uniform vec2 u_resolution;", "gl_FragCoord.xy / u_resolution, 0.0", [128, 128, 0]),
        ("uniform float u_time;", "u_time, 0.0, 0.0", [64, 0, 0]),
        ("uniform vec3 sheen = vec3(0.0, 0.2, 1.0);", "sheen", [0, 51, 255]),
        ("uniform mat4 P; uniform mat4 V;", "P[2].w * V[3].z, 1.0, 0.0", [255, 255, 0]),
    ] {
        lab.write("a.frag", fragment(declarations, color));
        let light = ["--light", "point position=1,2,0.5 color=1", "--time", "0.25"];
        let (_, drawn) = drawn_by(&lab, &[&["--fragment", "a.frag"], &light[..]].concat());
        // 1/255: positions are interpolated in f32.
        assert!((0..3).all(|i| drawn[i].abs_diff(expected[i]) <= 1), "{declarations}: {drawn:?}, not {expected:?}");
    }
    // The background is that of the usual picture.
    let plain = lab.run(&[&["render", "floor.obj", "-o", "plain.png"], &FROM_ABOVE[..]].concat());
    plain.good();
    let corner = |name| lab.picture(name).to_rgb8().get_pixel(32, 32).0;
    assert_eq!(corner("own.png"), corner("plain.png"));
}

#[test]
fn your_vertex_shader_is_shown_as_its_colour_or_as_a_shape() {
    let lab = Lab::new();
    let vertex = |outputs: &str, statement: &str| {
        format!(
            "attribute vec3 a_position;\nuniform mat4 u_mvp;\n{outputs}\nvoid main() {{ {statement} gl_Position = \
             u_mvp * vec4(a_position, 1.0); }}\n"
        )
    };
    lab.write("a.vert", vertex("varying vec3 v_color;", "v_color = vec3(0.0, 0.4, 1.0);"));
    assert_eq!(drawn_by(&lab, &["--vertex", "a.vert"]).1, [0, 102, 255]);
    // The material's colour, lit from the camera, which looks straight down.
    lab.write("b.vert", vertex("", ""));
    let (_, drawn) = drawn_by(&lab, &["--vertex", "b.vert", "--material", "diffuse=0.2,0.4,0.6"]);
    assert!(drawn.into_iter().zip([51_u8, 102, 153]).all(|(a, b)| a.abs_diff(b) <= 1), "{drawn:?}");
    // Both, of another version.
    lab.write("b.frag", "#version 300 es\nprecision highp float;\nin vec3 v_color;\nout vec4 c;\nvoid main() { c = vec4(v_color.zyx, 1.0); }\n");
    assert_eq!(drawn_by(&lab, &["--vertex", "a.vert", "--fragment", "b.frag"]).1, [255, 102, 0]);
}

#[test]
fn uniforms_and_textures_of_your_shaders_can_be_set() {
    let lab = Lab::new();
    lab.write(
        "a.frag",
        fragment("uniform vec3 tint; uniform bool half_of_it; uniform float idle;", "half_of_it ? tint * 0.5 : tint"),
    );
    let draw = |settings: &[&str]| drawn_by(&lab, &[&["--fragment", "a.frag"], settings].concat());
    assert_eq!(draw(&["--uniform", "tint=#336699", "--uniform", "half_of_it=false"]).1, [0x33, 0x66, 0x99]);
    assert_eq!(draw(&["--uniform", "tint=0.4,0,1", "--uniform", "half_of_it=true"]).1, [51, 0, 128]);
    let (run, _) = draw(&["--uniform", "idle=3"]);
    assert!(run.stderr.contains("`idle` has no effect"), "{}", run.stderr);
    let texels = image::RgbImage::from_fn(2, 2, |_, _| image::Rgb([10, 200, 60]));
    texels.save(lab.path("noise.png")).unwrap();
    lab.write("a.frag", fragment("in vec2 uv; uniform sampler2D noise;", "texture(noise, uv).rgb"));
    assert_eq!(drawn_by(&lab, &["--fragment", "a.frag", "--texture", "noise=noise.png"]).1, [10, 200, 60]);
    let (run, drawn) = drawn_by(&lab, &["--fragment", "a.frag"]);
    assert!(drawn == [255; 3] && run.stderr.contains("--texture"), "{}", run.stderr);
    lab.write("a.frag", fragment("in vec3 normal; uniform samplerCube sky;", "texture(sky, normal).rgb"));
    let (run, _) = drawn_by(&lab, &["--fragment", "a.frag"]);
    assert!(run.stderr.contains("--environment"), "{}", run.stderr);
    let (_, drawn) = drawn_by(&lab, &["--fragment", "a.frag", "--environment", "debug"]);
    assert_ne!(drawn, [0; 3]);
}

#[test]
fn errors_in_your_shaders_are_one_sentence_with_a_place() {
    let lab = Lab::new();
    lab.write("good.frag", fragment("uniform float amount;", "amount, 0.0, 0.0"));
    lab.write("bad.frag", fragment("in vec3 normal;", "normalise(normal)"));
    lab.write("unlinked.frag", fragment("in vec3 glow[2];", "glow[0] + glow[1]"));
    lab.write("binary.frag", b"\0\x01\x02");
    let draw = |args: &[&str]| lab.run(&[&["render", "builtin:cube", "-o", "x.png", "--size", "32x32"], args].concat());
    draw(&["--fragment", "bad.frag"]).refused(&["bad.frag:4:24: ", "normalise", "normalize"]);
    draw(&["--fragment", "unlinked.frag"]).refused(&["unlinked.frag:2:", "glow"]);
    draw(&["--fragment", "binary.frag"]).refused(&["binary.frag", "zero byte"]);
    draw(&["--vertex", "none.vert"]).refused(&["cannot read the vertex shader `none.vert`", "no such file"]);
    draw(&["--fragment", "good.frag", "--uniform", "amuont=1"])
        .refused(&["no uniform `amuont`; did you mean `amount`?"]);
    draw(&["--fragment", "good.frag", "--uniform", "amount=1,2"]).refused(&["`amount` is a float and takes 1 number"]);
    draw(&["--fragment", "good.frag", "--uniform", "amount=x"]).refused(&["invalid value `x`"]);
    draw(&["--fragment", "good.frag", "--texture", "noise=x.png"]).refused(&["cannot read the texture `x.png`"]);
    draw(&["--uniform", "amount=1"]).refused(&["--uniform sets a value of your shaders; add --vertex or --fragment"]);
    for option in [&["--views", "normal"][..], &["--debug", "N"], &["--tone-map", "aces"], &["--overlay", "boxes"]] {
        draw(&[&["--fragment", "good.frag"], option].concat()).refused(&[option[0], "gonio's own shaders"]);
    }
    draw(&["--fragment", "bad.frag", "--backend", "cpu"]).refused(&["bad.frag:4:24: ", "normalise", "normalize"]);
    assert!(!lab.path("x.png").exists());
}

#[test]
fn an_endless_loop_in_your_shader_ends() {
    let lab = Lab::new();
    lab.write("a.frag", "#version 330 core\nout vec4 c;\nvoid main() { while (true) { c += vec4(0.1); } }\n");
    let run = lab.run(&["render", "builtin:cube", "-o", "x.png", "--size", "8x8", "--fragment", "a.frag"]);
    // Pixels that take too long are not drawn.
    run.good();
}

#[test]
fn names_toml_beside_your_shaders_is_read() {
    let lab = Lab::new();
    std::fs::create_dir(lab.path("own")).unwrap();
    let declarations = "in vec3 here; in float k; uniform vec3 sun; uniform float amount = 9.0; uniform float now2;";
    lab.write("own/a.frag", fragment(declarations, "(sun - here) / 4.0 + vec3(amount, 0.0, now2 * k)"));
    let names = "[names]\nsun = \"light-pos\"\nhere = \"position\"\nk = 2\namount = 0.25\nnow2 = \"time\"\nidle = 1\n";
    lab.write("own/names.toml", names);
    let light = ["--light", "point position=1,2,0.5 color=1", "--time", "0.25"];
    for backend in ["gl", "cpu"] {
        let args = [&["--fragment", "own/a.frag", "--backend", backend], &light[..]].concat();
        let (run, drawn) = drawn_by(&lab, &args);
        // ((0.5, 2, 0) / 4 + (0.25, 0, 0.5)) * 255
        assert!(drawn.iter().zip([96_u8, 128, 128]).all(|(a, b)| a.abs_diff(b) <= 1), "{backend}: {drawn:?}");
        assert!(run.stderr.contains("own/names.toml:7: `idle` is not in the shaders"), "{}", run.stderr);
        // An option counts more.
        let (_, drawn) = drawn_by(&lab, &[&args[..], &["--uniform", "amount=0"]].concat());
        assert!(drawn[0].abs_diff(32) <= 1, "{drawn:?}");
    }
    let refused = |names: &str, parts: &[&str]| {
        lab.write("own/names.toml", names);
        for backend in ["gl", "cpu"] {
            let run =
                lab.run(&["render", "builtin:cube", "-o", "x.png", "--backend", backend, "--fragment", "own/a.frag"]);
            run.refused(&[&["own/names.toml:"], parts].concat());
        }
    };
    refused("[names]\n\nsun = \"lihgt-pos\"\n", &["toml:3: unknown role `lihgt-pos`: did you mean `light-pos`?"]);
    refused("[names]\nsun = [1, 2]\n", &["toml:2: `sun` is a vec3 and takes 3 numbers, not 2"]);
    refused("[names]\nsun = \"diffuse-texture\"\n", &["toml:2: `sun` is a uniform, which cannot have the role"]);
    refused("[names]\nsun = 1\nsun = 2\n", &["toml:3: "]);
    assert!(!lab.path("x.png").exists());
}

#[test]
fn the_values_of_an_expression_are_a_picture() {
    let lab = Lab::new();
    lab.write("floor.obj", FLOOR);
    let text = "#version 330 core\nin vec3 FragPos;\nin vec3 v_normal;\nout vec4 c;\nvoid main() {\n    vec3 n = normalize(v_normal);\n    float d = length(FragPos);\n    c = vec4(n * d, 1.0);\n}\n";
    lab.write("a.frag", text);
    let shown = |args: &[&str]| {
        lab.run(&[&["render", "floor.obj", "-o", "shown.png", "--fragment", "a.frag"], args, &FROM_ABOVE[..]].concat())
    };
    let report = shown(&["--show", "6:14", "--json"]).good().json();
    let of = &report["shown"];
    assert_eq!(
        (&of["expression"], &of["type"], &of["stage"]),
        (&"normalize(v_normal)".into(), &"vec3".into(), &"fragment".into())
    );
    let centre = || lab.picture("shown.png").to_rgb8().get_pixel(16, 16).0;
    // The same everywhere: a colour.
    assert_eq!(centre(), [0, 255, 0]);
    let run = shown(&["--show", "7:15"]).good();
    assert!(run.stderr.contains("`length(FragPos)`, float: black is "), "{}", run.stderr);
    shown(&["--show", "1:1"]).refused(&["a.frag:1:1: there is no expression"]);
    shown(&["--show", "6:14", "--file", "vertex"]).refused(&["gonio's own shader", "--vertex"]);
    shown(&["--show", "6:14", "--frames", "2"]).refused(&["--show draws one picture"]);
    lab.run(&["render", "floor.obj", "-o", "x.png", "--show", "6:14"]).refused(&["--show", "--fragment"]);
}

/// The last value that a stage writes to a variable.
fn last(stage: &Value, name: &str) -> Value {
    let steps = stage["steps"].as_array().unwrap().iter();
    let mut writes = steps.flat_map(|step| step["writes"].as_array().unwrap());
    writes.rfind(|write| write["name"] == name).map(|write| write["value"].clone()).unwrap()
}

#[test]
fn your_shaders_are_stepped_through_at_a_pixel_or_a_vertex() {
    let lab = Lab::new();
    lab.write("floor.obj", FLOOR);
    let text = "#version 330 core\nin vec3 FragPos;\nuniform vec3 u_view_pos;\nuniform float gain;\nout vec4 c;\nvoid main() {\n    float d = distance(u_view_pos, FragPos);\n    c = vec4(FragPos * gain, 1.0 / d);\n}\n";
    lab.write("a.frag", text);
    let probe = |args: &[&str]| {
        lab.run(
            &[&["probe", "floor.obj", "--fragment", "a.frag", "--uniform", "gain=0.5"], args, &FROM_ABOVE[..6]]
                .concat(),
        )
    };
    let report = probe(&["--at", "16,16", "--json"]).good().json();
    assert_eq!((&report["command"], &report["size"]), (&"probe".into(), &serde_json::json!([33, 33])));
    let stage = &report["stages"][0];
    assert!((last(stage, "d").as_f64().unwrap() - 2.0).abs() < 1e-5, "{stage}");
    let colour: Vec<f64> = last(stage, "c").as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
    let is_near = colour.iter().zip([0.25, 0.0, 0.25, 0.5]).all(|(a, b)| (a - b).abs() < 1e-5);
    assert!(is_near, "{colour:?}");
    // It is what the driver draws there.
    let args = ["--fragment", "a.frag", "--uniform", "gain=0.5"];
    let (_, drawn) = drawn_by(&lab, &args);
    assert_eq!(drawn, [64, 0, 64]);
    // Without a pixel, the middle; a page for people.
    let page = probe(&["--corners"]).good().text().to_owned();
    assert!(page.contains("pixel 16,16 of 33x33") && page.contains("d = 2"), "{page}");
    assert!(page.contains("gonio's vertex shader (vertex shader, vertex 3)") || page.contains("vertex 1)"), "{page}");
    let report = probe(&["--at-vertex", "2", "--json"]).good().json();
    assert_eq!((&report["stages"][0]["stage"], &report["stages"][0]["vertex"]), (&"vertex".into(), &2.into()));
    probe(&["--at-vertex", "4"]).refused(&["no vertex 4; the scene has 4"]);
    probe(&["--at", "33,1"]).refused(&["outside of the picture of 33x33"]);
    lab.run(&["probe", "floor.obj", "--at", "1,1", "--corners"]).refused(&["--corners", "--fragment"]);
    probe(&["--traced"]).refused(&["--traced", "--fragment"]);
}

/// Draws with both backends, and asserts that they agree: 1 % of the pixels may differ by more than `tolerance`, at outlines.
fn agree(lab: &Lab, args: &[&str], tolerance: u8) {
    let draw = |backend: &str, name: &str| {
        let run = lab.run(&[&["render"], args, &["--size", "96x64", "--backend", backend, "-o", name]].concat()).good();
        assert_eq!(run.stderr.contains("gonio's interpreter"), backend == "cpu", "{}", run.stderr);
        lab.picture(name).to_rgba8()
    };
    let (gl, cpu) = (draw("gl", "gl.png"), draw("cpu", "cpu.png"));
    let differ = |(a, b): &(&image::Rgba<u8>, &image::Rgba<u8>)| (0..4).any(|i| a.0[i].abs_diff(b.0[i]) > tolerance);
    let different = gl.pixels().zip(cpu.pixels()).filter(differ).count();
    let background = *gl.get_pixel(0, 0);
    let drawn = gl.pixels().filter(|pixel| **pixel != background).count();
    assert!(drawn > 300 && different * 100 <= gl.pixels().len(), "{args:?}: {different} of {drawn} pixels differ");
}

#[test]
fn the_cpu_draws_what_the_driver_draws() {
    let lab = Lab::new();
    let texels = image::RgbImage::from_fn(8, 4, |x, y| image::Rgb([x as u8 * 36, y as u8 * 80, 128]));
    texels.save(lab.path("noise.png")).unwrap();
    let suzanne = asset("suzanne.obj");
    let cases: [(&str, &str, &str, &[&str]); 5] = [
        (
            "in vec3 v_normal; in vec3 FragPos; uniform vec3 lightPos;",
            "vec3(max(dot(normalize(v_normal), normalize(lightPos - FragPos)), 0.1))",
            &suzanne,
            &[],
        ),
        ("in vec3 v_normal;", "0.5 + 0.5 * v_normal", &suzanne, &["--shading", "flat"]),
        (
            "in vec2 uv; uniform sampler2D noise;",
            "texture(noise, uv * 3.0).rgb",
            "builtin:sphere-800",
            &["--texture", "noise=noise.png", "--texture-filter", "linear"],
        ),
        (
            "in vec3 FragPos;",
            "0.5 + 20.0 * vec3(dFdx(FragPos.x), dFdy(FragPos.y), fwidth(FragPos.z))",
            "builtin:cube",
            &[],
        ),
        (
            "in vec3 v_normal; uniform vec3 diffuse;",
            "diffuse * gl_FragCoord.z + 0.5 * float(gl_FrontFacing)",
            "builtin:cube",
            &["--samples", "1"],
        ),
    ];
    for (declarations, colour, model, options) in cases {
        lab.write("a.frag", fragment(declarations, colour));
        agree(&lab, &[&[model, "--fragment", "a.frag"], options].concat(), 2);
    }
    let sky = fragment("uniform samplerCube sky;", "textureLod(sky, vec3(0.3, 0.8, 0.5), 1.0).rgb");
    lab.write("a.frag", sky);
    let seen = ["gl", "cpu"]
        .map(|backend| drawn_by(&lab, &["--fragment", "a.frag", "--environment", "debug", "--backend", backend]).1);
    assert!((0..3).all(|i| seen[0][i].abs_diff(seen[1][i]) <= 2) && seen[0] != [0; 3], "{seen:?}");
    // Discarded pixels show what is behind them, and transparent parts are blended from back to front.
    lab.write(
        "a.frag",
        fragment("in vec3 FragPos; in vec3 n;", "0.5 + 0.5 * n")
            .replace("{ c", "{ if (fract(8.0 * FragPos.y) < 0.5) discard; c"),
    );
    agree(&lab, &[&suzanne, "--fragment", "a.frag"], 2);
    lab.write("b.frag", "#version 330 core\nin vec3 n;\nout vec4 c;\nvoid main() { c = vec4(0.5 + 0.5 * n, 0.4); }\n");
    agree(&lab, &[&suzanne, "--fragment", "b.frag", "--material", "opacity=0.4"], 2);
    agree(&lab, &["builtin:sphere-800", "--fragment", "b.frag", "--background", "transparent"], 2);
}

#[test]
fn without_a_driver_the_cpu_draws_your_shaders_and_says_so() {
    let lab = Lab::new();
    lab.write("a.frag", fragment("", "1.0, 0.25, 0.0"));
    let args = ["--fragment", "a.frag", "--egl-library", "libNoSuchEGL.so.1"];
    let (run, drawn) = drawn_by(&lab, &args);
    assert_eq!(drawn, [255, 64, 0]);
    assert!(
        run.stderr.contains("your shaders were run by gonio's interpreter on the CPU: no OpenGL"),
        "{}",
        run.stderr
    );
    let endless = "#version 330 core\nout vec4 c;\nvoid main() {\n    while (true) { c += vec4(0.1); }\n}\n";
    lab.write("a.frag", endless);
    let run = lab.run(&[
        "render",
        "builtin:cube",
        "-o",
        "x.png",
        "--size",
        "8x8",
        "--fragment",
        "a.frag",
        "--backend",
        "cpu",
    ]);
    run.refused(&["a.frag:4: the shader does not end"]);
}

#[test]
fn members_of_uniform_blocks_get_values_by_their_names() {
    let lab = Lab::new();
    let vertex = "#version 330 core\nlayout(std140) uniform Camera { mat4 view; mat4 projection; } camera;\nuniform Object { mat4 \
                  model; };\nin vec3 position;\nout vec3 v_place;\nvoid main() {\n    vec4 p = model * vec4(position, 1.0);\n    \
                  v_place = p.xyz;\n    gl_Position = camera.projection * camera.view * p;\n}\n";
    lab.write("a.vert", vertex);
    let declarations = "struct Lamp { vec3 position; float reach; };\nlayout(std140) uniform Lights { Lamp lamps[2]; vec3 tint; } \
                        lights;\nin vec3 v_place;";
    lab.write(
        "a.frag",
        fragment(declarations, "lights.tint * (lights.lamps[0].position - v_place) * lights.lamps[1].reach / 4.0"),
    );
    let args = ["--vertex", "a.vert", "--fragment", "a.frag", "--light", "point position=1,2,0.5 color=1"];
    let settings = ["--uniform", "Lights.tint=1,0.5,1", "--uniform", "Lights.lamps[1].reach=2"];
    for backend in ["gl", "cpu"] {
        let (run, drawn) = drawn_by(&lab, &[&args[..], &settings, &["--backend", backend]].concat());
        // ((0.5, 2, 0) * 2 / 4 * (1, 0.5, 1)) * 255
        assert!(drawn.iter().zip([64_u8, 128, 0]).all(|(a, b)| a.abs_diff(b) <= 1), "{backend}: {drawn:?}");
        assert!(!run.stderr.contains("warning"), "{}", run.stderr);
    }
    let run = lab.run(&[&["render", "floor.obj", "-o", "x.png", "--uniform", "Lights.tnit=1"], &args[..]].concat());
    run.refused(&["no uniform `Lights.tnit`; did you mean `Lights.tint`?"]);
}
