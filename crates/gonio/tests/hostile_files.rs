//! Files that try to make gonio wait for ever, read forbidden files, or exhaust the memory.
#![cfg(unix)]
#![allow(clippy::unwrap_used)]

mod common;

use common::{Lab, Run};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

const TRIANGLE: &str = "mtllib t.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n";

/// Time limit of a command. None here takes more than two seconds, except one that waits for a pipe for ever.
const HANGS: Duration = Duration::from_secs(120);

/// Runs a command and stops it if it hangs; the test fails then.
#[track_caller]
fn run(mut command: Command) -> Run {
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let start = Instant::now();
    while child.try_wait().unwrap().is_none() {
        if start.elapsed() > HANGS {
            child.kill().unwrap();
            panic!("it hangs: {command:?}");
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    Run::of(child.wait_with_output().unwrap())
}

/// A line for bash in which `gonio` is the program.
#[track_caller]
fn shell(lab: &Lab, line: &str) -> Run {
    let mut command = Command::new("bash");
    let line = line.replace("gonio", &format!("'{}'", env!("CARGO_BIN_EXE_gonio")));
    command.args(["-c", &line]).current_dir(lab.path("")).stdin(Stdio::null());
    run(command)
}

fn pipe(lab: &Lab, name: &str) {
    assert!(Command::new("mkfifo").arg(lab.path(name)).status().unwrap().success());
}

fn gltf(buffer: &str, image: &str) -> String {
    format!(
        r#"{{"asset":{{"version":"2.0"}},"buffers":[{{"uri":"{buffer}","byteLength":36}}],
        "bufferViews":[{{"buffer":0,"byteLength":36}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}}],
        "images":[{{"uri":"{image}"}}],"textures":[{{"source":0}}],
        "materials":[{{"pbrMetallicRoughness":{{"baseColorTexture":{{"index":0}}}}}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"material":0}}]}}],"nodes":[{{"mesh":0}}]}}"#
    )
}

const DATA: &str = "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";

const COLLADA: &str = r##"<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<library_images><image id="i"><init_from>pipe</init_from></image></library_images>
<library_effects><effect id="e"><profile_COMMON><newparam sid="s"><surface type="2D"><init_from>i</init_from></surface></newparam>
<newparam sid="p"><sampler2D><source>s</source></sampler2D></newparam><technique sid="t"><lambert><diffuse>
<texture texture="p" texcoord="uv"/></diffuse></lambert></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g"><mesh><source id="s"><float_array id="a" count="9">0 0 0 1 0 0 0 1 0</float_array>
<technique_common><accessor source="#a" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source><vertices id="v"><input semantic="POSITION" source="#s"/>
</vertices><triangles count="1" material="m"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh>
</geometry></library_geometries><library_visual_scenes><visual_scene id="w"><node><instance_geometry url="#g"><bind_material>
<technique_common><instance_material symbol="m" target="#m"/></technique_common></bind_material></instance_geometry></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#w"/></scene></COLLADA>"##;

#[test]
fn pipes_named_by_files_are_refused_without_waiting() {
    let lab = Lab::new();
    pipe(&lab, "pipe");
    lab.write("library.obj", TRIANGLE.replace("t.mtl", "pipe"));
    lab.write("texture.obj", TRIANGLE);
    lab.write("t.mtl", "newmtl m\nmap_Kd pipe\nmap_Bump pipe\n");
    lab.write("image.gltf", gltf(DATA, "pipe"));
    lab.write("image.dae", COLLADA);
    for model in ["library.obj", "texture.obj", "image.gltf", "image.dae"] {
        for args in [&["inspect", model][..], &["scene", model], &["convert", model, "out.glb"]] {
            let done = run(lab.command(args)).good();
            let message = done.stderr.clone() + done.text();
            // A scene file needs no pixels, so there may be no message about them.
            assert!(message.contains("`pipe` is a pipe, not a file"), "{args:?}: {message}");
        }
    }
    lab.write("buffer.gltf", gltf("pipe", "none.png"));
    run(lab.command(&["inspect", "buffer.gltf"])).refused(&["buffer.gltf", "`pipe` is a pipe, not a file"]);
    for scene in
        ["[[object]]\nmodel = \"pipe\"\n", "[[object]]\nmodel = \"builtin:cube\"\n[environment]\nimage = \"pipe\"\n"]
    {
        lab.write("s.toml", scene);
        run(lab.command(&["scene", "s.toml"])).refused(&["pipe: the file cannot be read: it is a pipe"]);
    }
}

#[test]
fn a_pipe_named_by_the_user_is_an_input() {
    let lab = Lab::new();
    lab.write("t.obj", TRIANGLE);
    lab.write("t.mtl", "newmtl m\nKd 1 0 0\n");
    let size = "--size 8x8 --samples 1 --backend cpu";
    shell(&lab, &format!("gonio render <(cat t.obj) -o substituted.png {size}")).good();
    shell(&lab, &format!("cat t.obj | gonio render /dev/stdin -o stdin.png {size}")).good();
    shell(&lab, "gzip -c t.obj | gonio inspect -").good();
    assert_eq!(lab.picture("substituted.png"), lab.picture("stdin.png"));
    // It is endless, and read up to the limit only.
    for input in ["<(yes v 0 0 0)", "- < <(yes v 0 0 0)", "/dev/stdin < <(yes v 0 0 0)"] {
        let refused = shell(&lab, &format!("gonio inspect --max-memory 1MiB {input}"));
        refused.refused(&["needs more than 1.0 MiB of memory", "--max-memory raises the limit"]);
    }
}

#[cfg(target_os = "linux")]
#[test]
fn endless_files_are_refused() {
    let lab = Lab::new();
    for (endless, why) in [("/proc/self/pagemap", "although its size is 0"), ("/dev/zero", "is a device")] {
        run(lab.command(&["inspect", endless])).refused(&[endless, why]);
        lab.write("t.obj", TRIANGLE.replace("t.mtl", endless));
        let done = run(lab.command(&["inspect", "t.obj"])).good();
        assert!((done.stderr + std::str::from_utf8(&done.stdout).unwrap()).contains(why));
        lab.write("t.obj", TRIANGLE);
        lab.write("t.mtl", format!("newmtl m\nmap_Kd {endless}\n"));
        let done = lab.render(&["t.obj", "-o", "out.png"]).good();
        assert!(done.stderr.contains(why) && done.stderr.contains("is used without it"), "{}", done.stderr);
    }
}

/// A zstd frame of 5 GiB of zeros: 40,960 blocks of four bytes.
fn bomb() -> Vec<u8> {
    let mut frame = vec![0x28, 0xB5, 0x2F, 0xFD, 0, 13 << 3];
    for block in 1..=40_960 {
        let header = u32::from(block == 40_960) | 1 << 1 | (128 << 10) << 3;
        frame.extend(&header.to_le_bytes()[..3]);
        frame.push(0);
    }
    frame
}

#[test]
fn compressed_bombs_end_early() {
    let lab = Lab::new();
    let bomb = bomb();
    assert!(bomb.len() < 170_000);
    lab.write("bomb.obj.zst", &bomb);
    // With this little address space, an excessive allocation would end the process.
    for limit in ["", "--max-memory 100GiB", "--max-memory 16MiB"] {
        let run = shell(&lab, &format!("ulimit -v 1500000; gonio inspect bomb.obj.zst {limit}"));
        let why = if limit.ends_with("16MiB") {
            "unpacked, it needs more than 15.8 MiB"
        } else {
            "unpacks to more than 256 MiB"
        };
        run.refused(&["bomb.obj.zst: ", why]);
    }
}

fn png(size: u32) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    image::RgbaImage::from_pixel(size, size, image::Rgba([9; 4]))
        .write_to(&mut bytes, image::ImageFormat::Png)
        .unwrap();
    bytes.into_inner()
}

#[test]
fn textures_that_fit_only_separately_are_refused() {
    let lab = Lab::new();
    lab.write("t.obj", TRIANGLE);
    lab.write("t.mtl", "newmtl m\nmap_Kd a.png\nmap_Ks b.png\nmap_Ke c.png\n");
    // 4 MiB each when they are decoded.
    ["a.png", "b.png", "c.png"].iter().for_each(|name| lab.write(name, png(1024)));
    let warnings = |limit: &str| {
        let done = lab.render(&["t.obj", "-o", "out.png", "--max-memory", limit]).good();
        done.stderr.lines().filter(|line| line.contains("the textures together would take more")).count()
    };
    assert_eq!([warnings("13MiB"), warnings("10MiB"), warnings("6MiB")], [0, 1, 2]);
}

#[test]
fn false_sizes_in_headers_are_limited() {
    let lab = Lab::new();
    lab.write("t.obj", TRIANGLE);
    lab.write("t.mtl", "newmtl m\nmap_Kd large.png\n");
    // 16000 x 16000 in the header, with a valid checksum, and no pixels.
    let mut large = png(1);
    large[16..24].copy_from_slice(&[0, 0, 0x3E, 0x80, 0, 0, 0x3E, 0x80]);
    let mut crc = flate2::Crc::new();
    crc.update(&large[12..29]);
    large[29..33].copy_from_slice(&crc.sum().to_be_bytes());
    lab.write("large.png", large);
    let done = lab.render(&["t.obj", "-o", "out.png", "--max-memory", "64MiB"]).good();
    assert!(done.stderr.contains("this one needs 976.6 MiB of memory"), "{}", done.stderr);

    lab.write("large.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 32768 +X 65536\n\u{2}\u{2}");
    lab.run(&["environment", "convert", "room", "room.exr", "--size", "64", "--backend", "cpu"]).good();
    let mut exr = lab.read("room.exr");
    for window in [&b"dataWindow\0box2i\0\x10\0\0\0"[..], b"displayWindow\0box2i\0\x10\0\0\0"] {
        let at = exr.windows(window.len()).position(|bytes| bytes == window).unwrap() + window.len();
        exr[at + 8..at + 16].copy_from_slice(&[0xFF, 0xFF, 0, 0, 0xFF, 0x7F, 0, 0]);
    }
    lab.write("large.exr", exr);
    // The number of blocks in an OpenEXR file contradicts the size.
    for (name, why) in [("large.hdr", "32.0 GiB"), ("large.exr", "damaged")] {
        let line = format!("ulimit -v 1500000; gonio environment check {name} --max-memory 64MiB");
        shell(&lab, &line).refused(&[name, why]);
    }
}

/// A folder with an input, and secrets around it: no command that reads models or scenes may read those.
#[test]
fn every_command_respects_the_sandbox() {
    let lab = Lab::new();
    std::fs::create_dir(lab.path("in")).unwrap();
    lab.write("secret.mtl", "newmtl m\nKd 1 0 0\n");
    lab.write("secret.obj", TRIANGLE);
    lab.write("secret.png", png(8));
    std::os::unix::fs::symlink(lab.path("secret.mtl"), lab.path("in/link.mtl")).unwrap();
    lab.write("in/link.obj", TRIANGLE.replace("t.mtl", "link.mtl"));
    lab.write("in/up.obj", TRIANGLE.replace("t.mtl", "../secret.mtl"));
    lab.write("in/absolute.obj", TRIANGLE.replace("t.mtl", &lab.path("secret.mtl").to_string_lossy()));
    lab.write("in/t.mtl", "newmtl m\nmap_Kd ../secret.png\n");
    lab.write("in/texture.obj", TRIANGLE);
    let says = "is outside the folder of the input, and the sandbox forbids";
    for model in ["in/link.obj", "in/up.obj", "in/absolute.obj", "in/texture.obj"] {
        let picture = ["-o", "out.png", "--size", "8x8", "--samples", "1", "--backend", "cpu"];
        let render = [&["render", model][..], &picture].concat();
        let probe = ["probe", model, "--at", "4,4", "--size", "8x8", "--backend", "cpu"];
        let all: [&[&str]; 5] =
            [&render, &probe, &["inspect", model], &["scene", model], &["convert", model, "out.glb"]];
        for args in all {
            let free = lab.run(args);
            let confined = lab.run(&[args, &["--sandbox"]].concat());
            let text = |run: &Run| run.stderr.clone() + run.text();
            assert!(text(&confined).contains(says), "{args:?}: {}", text(&confined));
            assert!(!text(&free).contains(says), "{args:?}: {}", text(&free));
        }
    }
    lab.write("in/s.toml", "[[object]]\nmodel = \"../secret.obj\"\n");
    lab.run(&["scene", "in/s.toml", "--sandbox"]).refused(&["secret.obj", says, "without --sandbox it is read"]);
    // A file on the command line may be anywhere.
    lab.run(&["scene", "in/texture.obj", "secret.obj", "--sandbox"]).good();
    lab.run(&["scene", "in/s.toml"]).good();
}
