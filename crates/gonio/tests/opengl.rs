//! `--backend` draws by OpenGL, or by the CPU in its place with a note about the reason; `gonio frame` lists OpenGL's calls. Needs the
//! OpenGL that the README names; Mesa's llvmpipe is enough.
#![allow(clippy::unwrap_used, missing_docs)]

mod common;

use common::{Lab, asset};

#[test]
fn opengl_and_the_cpu_draw_the_same_picture() {
    let lab = Lab::new();
    let model = asset("still_life.obj");
    for (backend, name) in [("gl", "gl.png"), ("cpu", "cpu.png"), ("auto", "auto.png")] {
        // Linear filtering is defined exactly; the footprints of mipmaps are not.
        let filter = ["--texture-filter", "linear"];
        let args = ["render", &model, "-o", name, "--size", "160x120", "--samples", "1", "--backend", backend];
        let run = lab.run(&[&args[..], &filter[..]].concat());
        let stderr = run.good().stderr;
        assert_eq!(stderr.contains("note: drawn by OpenGL ("), backend == "auto", "{backend}: {stderr}");
    }
    assert_eq!(lab.read("gl.png"), lab.read("auto.png"));
    // The project's tolerance: 0.5 % of the pixels by more than one step, edges included.
    lab.run(&["diff", "gl.png", "cpu.png", "--tolerance", "1", "--max-differing", "0.5"]).good();
    let json =
        lab.run(&["render", &model, "-o", "gl.png", "--size", "64x48", "--backend", "gl", "--json"]).good().json();
    assert_eq!(json["backend"]["name"], "gl");
    assert!(json["backend"]["renderer"].is_string() && json["drawn"]["draw_calls"].as_u64() > Some(0), "{json}");
}

#[test]
fn a_probe_compares_opengl_with_the_reference() {
    let lab = Lab::new();
    let args = ["probe", &asset("suzanne.obj"), "--at", "500,400", "--backend", "gl", "--json"];
    let json = lab.run(&args).good().json();
    // 1e-3: the project's tolerance for linear values.
    assert!(json["gpu"]["difference"].as_f64().unwrap() < 1e-3, "{}", json["gpu"]);
}

#[test]
fn opengl_and_the_cpu_draw_the_same_views() {
    let lab = Lab::new();
    let cube = asset("cube.obj");
    for (backend, name) in [("gl", "gl.exr"), ("cpu", "cpu.exr")] {
        let common = ["--size", "64x48", "--samples", "1", "--backend", backend, "--views", "N,cos-theta,diffuse"];
        lab.run(&[&["render", &cube, "-o", name], &common[..]].concat()).good();
    }
    for layer in ["picture", "normal", "cos-theta", "diffuse"] {
        // Edges may round to either side: 1 % of the pixels of a small picture.
        let args = ["diff", "gl.exr", "cpu.exr", "--layer", layer, "--tolerance", "1", "--max-differing", "1"];
        lab.run(&args).good();
    }
}

#[cfg(all(unix, not(target_os = "macos")))]
#[test]
fn without_an_opengl_library_the_cpu_draws_with_a_note() {
    let lab = Lab::new();
    let cube = asset("cube.obj");
    let args = ["render", &cube, "--size", "48x32", "--samples", "1", "--egl-library", "libNoSuchEGL.so.1"];
    let run = lab.run(&[&args[..], &["-o", "auto.png"]].concat()).good();
    let notes: Vec<&str> = run.stderr.lines().filter(|l| l.contains("CPU reference")).collect();
    assert_eq!(notes.len(), 1, "{}", run.stderr);
    for piece in ["note: drawn by the CPU reference: no OpenGL", "libNoSuchEGL.so.1", "libegl1", "libgl1-mesa-dri"] {
        assert!(notes[0].contains(piece), "{piece} is not in {}", notes[0]);
    }
    lab.render(&[&cube, "-o", "cpu.png"]).good();
    assert_eq!(lab.read("auto.png"), lab.read("cpu.png"));
    let json = lab.run(&[&args[..], &["-o", "auto.png", "--json"]].concat()).good().json();
    assert!(json["backend"]["reason"].as_str().unwrap().contains("no OpenGL"));

    let args = ["render", &cube, "-o", "gl.png", "--backend", "gl", "--egl-library", "libNoSuchEGL.so.1"];
    lab.run(&args).refused(&["libNoSuchEGL.so.1", "libegl1"]);
    assert_eq!(lab.names(), ["auto.png", "cpu.png"]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_driver_that_is_too_old_is_named() {
    let lab = Lab::new();
    let cube = asset("cube.obj");
    let run = |backend: &str| {
        let args = ["render", &cube, "-o", "a.png", "--size", "48x32", "--backend", backend];
        // Mesa then reports this version.
        common::Run::of(lab.command(&args).env("MESA_GL_VERSION_OVERRIDE", "3.1").output().unwrap())
    };
    run("gl").refused(&["3.3", "too old", "--backend cpu"]);
    assert!(lab.names().is_empty());
    let run = run("auto").good();
    assert!(
        run.stderr.contains("note: drawn by the CPU reference: ") && run.stderr.contains("too old"),
        "{}",
        run.stderr
    );
}

const SIZE: [&str; 4] = ["--size", "64x48", "--samples", "4"];

#[test]
fn a_frame_in_tables() {
    let lab = Lab::new();
    let model = asset("still_life.obj");
    let run = lab.run(&[&["frame", &model], &SIZE[..]].concat()).good();
    for words in [
        "findings\n  none",
        "0  scene   into `",
        "1  output  into `encoded picture`   64 x 48  RGBA8",
        "colour cleared to 0 0 0 0, depth to 1",
        "Floor]                0     2 triangles         4",
        "diffuse_map",
        "planks.png",
        "SRGB8_ALPHA8",
        "linear mipmap linear, repeat",
        "scene phong blinn_phong",
    ] {
        assert!(run.text().contains(words), "`{words}` is not in\n{}", run.text());
    }
    // No line is wider than a projected terminal or ends with a space.
    for line in run.text().lines() {
        assert!(line.chars().count() <= 190 && line.trim_end() == line, "{line}");
    }
}

#[test]
fn a_draw_and_a_program_by_number() {
    let lab = Lab::new();
    let model = asset("cube.obj");
    let run = lab.run(&[&["frame", &model, "--draw", "0", "--shading", "gouraud"], &SIZE[..]].concat()).good();
    for words in
        ["draw 0: ", "12 triangles: 36 indices from 0", "mat4 clip_from_model", "3 x float from `", "k_diffuse"]
    {
        assert!(run.text().contains(words), "`{words}` is not in\n{}", run.text());
    }
    let run = lab.run(&[&["frame", &model, "--program", "0", "--shading", "gouraud"], &SIZE[..]].concat()).good();
    for words in ["program 0: scene gouraud", "world_from_model", "#version 330 core", "void main()"] {
        assert!(run.text().contains(words), "`{words}` is not in\n{}", run.text());
    }
    lab.run(&["frame", &model, "--draw", "9"]).refused(&["there is no draw 9; the frame has 2, numbers 0 to 1"]);
    lab.run(&["frame", &model, "--program", "7"]).refused(&["there is no program 7"]);
}

#[test]
fn everything_as_json() {
    let lab = Lab::new();
    let run = lab.run(&[&["frame", &asset("still_life.obj"), "--json"], &SIZE[..]].concat()).good();
    let json = run.json();
    assert_eq!((&json["command"], &json["findings"]), (&"frame".into(), &serde_json::json!([])));
    let frame = &json["frame"];
    let draws = frame["draws"].as_array().unwrap();
    assert!(draws.len() > 2);
    assert_eq!(frame["passes"][0]["target"]["format"], "RGBA16F");
    // From sampler to unit to texture.
    let samplers = draws.iter().flat_map(|draw| draw["samplers"].as_array().unwrap());
    let read = samplers.filter(|s| s["name"] == "diffuse_map").map(|s| (&s["unit"], &s["texture"])).collect::<Vec<_>>();
    assert!(!read.is_empty());
    let textures = frame["textures"].as_array().unwrap();
    for (unit, id) in read {
        assert_eq!(unit, 0);
        let texture = textures.iter().find(|texture| texture["id"] == *id).unwrap();
        assert_eq!(texture["kind"], "2D");
    }
    assert!(draws.iter().all(|draw| draw["fragments_shaded"].as_u64().is_some()));
    let matrix = draws[0]["uniforms"].as_array().unwrap().iter().find(|u| u["name"] == "clip_from_model").unwrap();
    assert_eq!(matrix["value"].as_array().unwrap().len(), 16);
    let program = &frame["programs"][draws[0]["program"].as_u64().unwrap() as usize];
    assert!(program["vertex_source"].as_str().unwrap().starts_with("#version"));
}

#[test]
fn a_debug_view_has_another_program() {
    let lab = Lab::new();
    let run = lab.run(&[&["frame", &asset("cube.obj"), "--debug", "normal"], &SIZE[..]].concat()).good();
    assert!(run.text().contains(" view"), "{}", run.text());
    lab.run(&["frame", &asset("cube.obj"), "--debug", "light:9"]).refused(&["there is no light 9"]);
}

#[test]
fn without_opengl_the_error_names_packages_to_install() {
    let lab = Lab::new();
    let run = lab.run(&["frame", &asset("cube.obj"), "--egl-library", "libnothing.so.1"]);
    let run = run.refused(&["no OpenGL", "libnothing.so.1", "apt-get install"]);
    assert!(!run.stderr.contains("--backend"), "{}", run.stderr);
}

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
    draw(&["--fragment", "good.frag", "--backend", "cpu"]).refused(&["your shaders need OpenGL"]);
    #[cfg(all(unix, not(target_os = "macos")))]
    draw(&["--fragment", "good.frag", "--egl-library", "libNoSuchEGL.so.1"]).refused(&["your shaders need OpenGL: no"]);
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
