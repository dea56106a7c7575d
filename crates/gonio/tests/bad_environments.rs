//! Everything that can be wrong with an environment: each mistake ends in exit code 2 and one sentence, and leaves no files.
#![allow(clippy::unwrap_used)]

mod common;

use common::Lab;
use gonio_environment::{CubeMips, Cubemap, Face};
use gonio_image::Image;
use gonio_image::encode::{exr, hdr, ktx2};

fn png(width: u32, height: u32) -> Vec<u8> {
    let picture = image::RgbImage::from_fn(width, height, |x, y| image::Rgb([x as u8, y as u8, 99]));
    let mut bytes = std::io::Cursor::new(Vec::new());
    picture.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
    bytes.into_inner()
}

/// A PNG header with this size and nothing after it. (The checksum is wrong, because the size is checked first.)
fn png_header(width: u32, height: u32) -> Vec<u8> {
    let mut bytes = png(1, 1);
    bytes.truncate(33);
    bytes[16..20].copy_from_slice(&width.to_be_bytes());
    bytes[20..24].copy_from_slice(&height.to_be_bytes());
    let crc = crc32(&bytes[12..29]);
    bytes[29..33].copy_from_slice(&crc.to_be_bytes());
    bytes
}

/// The checksum of a PNG's chunks (its specification, annex D).
fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0, |crc, byte| {
        (0..8).fold(crc ^ u32::from(*byte), |c: u32, _| if c & 1 == 1 { 0xedb8_8320 ^ (c >> 1) } else { c >> 1 })
    })
}

/// A DDS header of an uncompressed cubemap, 4 x 4 RGBA, with all its texels.
fn dds() -> Vec<u8> {
    let mut words = vec![124_u32, 0x100f, 4, 4, 16, 0, 0];
    words.extend([0; 11]);
    // The pixel format: 32 bits of RGBA.
    words.extend([32, 0x41, 0, 32, 0xff, 0xff00, 0x00ff_0000, 0xff00_0000]);
    // A complex texture, a cubemap with all six faces.
    words.extend([0x1008, 0xfe00, 0, 0, 0]);
    let mut bytes = b"DDS ".to_vec();
    bytes.extend(words.iter().flat_map(|w| w.to_le_bytes()));
    bytes.extend((0..6 * 64).map(|i| i as u8));
    bytes
}

impl Lab {
    fn faces(&self, folder: &str, face: impl Fn(Face) -> Option<Vec<u8>>) {
        std::fs::create_dir(self.path(folder)).unwrap();
        for f in Face::ALL {
            if let Some(bytes) = face(f) {
                self.write(&format!("{folder}/{}.png", f.name()), bytes);
            }
        }
    }

    /// Converting, checking and drawing with it fail with the same error and write nothing.
    #[track_caller]
    fn refuses(&self, input: &str, pieces: &[&str]) {
        let before = self.names();
        self.run(&["environment", "convert", input, "out"]).refused(pieces);
        self.run(&["environment", "check", input, "--repair", "out"]).refused(pieces);
        self.render(&["builtin:cube", "--environment", input, "-o", "out.png"]).refused(pieces);
        assert_eq!(self.names(), before);
    }
}

#[test]
fn folders_without_exactly_six_faces() {
    let lab = Lab::new();
    lab.faces("five", |f| (f != Face::NegZ).then(|| png(4, 4)));
    lab.refuses("five", &["five: 5 of six faces found", "missing: `negz` (`negz.png`)"]);
    lab.refuses("five/posy.png", &["missing: `negz` (`negz.png`)"]);
    lab.refuses("five/pos*.png", &["3 of six faces found", "negx"]);
    lab.faces("sizes", |f| Some(if f == Face::PosZ { png(2, 2) } else { png(4, 4) }));
    lab.refuses("sizes", &["posz.png: ", "2 x 2", "4"]);
    lab.faces("oblong", |f| Some(if f == Face::NegY { png(4, 3) } else { png(4, 4) }));
    lab.refuses("oblong", &["negy.png: ", "4 x 3", "square"]);
    std::fs::create_dir(lab.path("empty")).unwrap();
    lab.refuses("empty", &["empty: the folder is empty; it must hold six faces, for example posx.png"]);
    std::fs::create_dir(lab.path("texts")).unwrap();
    lab.write("texts/readme.txt", "sky");
    lab.refuses("texts", &["texts: there are no pictures here: expected six, for example posx.png"]);
    lab.write("square.png", png(4, 4));
    lab.refuses("square.png", &["named like faces", "posx"]);
    lab.refuses("no*.png", &["no file matches this pattern"]);
}

#[test]
fn unknown_names() {
    let lab = Lab::new();
    lab.refuses("skyy", &["skyy: there is no such file or folder; did you mean `sky`, which is built in?"]);
    lab.refuses("builtin:rooom", &["unknown built-in environment `rooom`", "did you mean `room`?"]);
    lab.refuses("no/where.hdr", &["no/where.hdr: there is no such file or folder; check the path"]);
    lab.write("words.hdr", "these are words");
    lab.refuses("words.hdr", &["words.hdr: this is not a known picture format; PNG, JPEG"]);
    lab.write("nothing.hdr", "");
    lab.refuses("nothing.hdr", &["nothing.hdr: the file is empty"]);
    lab.write("photo.webp", b"RIFF....WEBPVP8 ");
    lab.refuses("photo.webp", &["this is a WebP picture; PNG, JPEG"]);
}

#[test]
fn models_and_environments_are_not_exchanged() {
    let lab = Lab::new();
    lab.write("model.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    lab.refuses("model.obj", &["model.obj: this is a model, not a picture; to draw it, name it as the input"]);
    let grey = Image::new(8, 4, [0.5, 0.5, 0.5, 1.0]);
    lab.write("sky.ktx2", CubeMips::new(Cubemap::new(4, [0.5; 4])).to_ktx2(ktx2::Ktx2Format::Srgb8).bytes);
    lab.write("panorama.hdr", hdr::encode(&grey).unwrap().bytes);
    lab.write("panorama.exr", exr::encode(&grey, exr::ExrPrecision::Half).unwrap().bytes);
    lab.write("panorama.png", png(8, 4));
    lab.write("sky.dds", dds());
    let before = lab.names();
    for (name, what) in [
        ("sky.ktx2", "a KTX2 texture"),
        ("panorama.hdr", "a Radiance picture"),
        ("panorama.exr", "an OpenEXR picture"),
        ("panorama.png", "a PNG image"),
        ("sky.dds", "a DDS texture"),
        ("sky", "a built-in environment"),
    ] {
        let pieces =
            [&format!("{name}: this is {what}"), "not a model", "name it as the environment with --environment"];
        lab.render(&[name, "-o", "out.png"]).refused(&pieces);
        // It is valid as an environment.
        if name != "sky" {
            assert!(lab.run(&["environment", "check", name]).code < 2, "{name}");
        }
    }
    assert_eq!(lab.names(), before);
}

/// Each file truncated near its end, in its middle and in its header, and with its middle overwritten.
#[test]
fn truncated_and_damaged_files() {
    let lab = Lab::new();
    let mut image = Image::new(32, 16, [0.0, 0.0, 0.0, 1.0]);
    for (i, pixel) in image.pixels.iter_mut().enumerate() {
        // All different, so that no run-length code hides a gap.
        *pixel = [i as f32 * 0.37 % 1.0, i as f32 * 0.11 % 3.0, i as f32 * 0.73 % 2.0, 1.0];
    }
    let map = Cubemap::from_function(8, |d| d.abs());
    for (name, bytes) in [
        ("a.png", png(32, 16)),
        ("a.hdr", hdr::encode(&image).unwrap().bytes),
        ("a.exr", exr::encode(&image, exr::ExrPrecision::Half).unwrap().bytes),
        ("a.ktx2", CubeMips::new(map).to_ktx2(ktx2::Ktx2Format::Half).bytes),
        ("a.dds", dds()),
    ] {
        lab.write(name, &bytes);
        // It is read and checked; the result of the check does not matter.
        assert!(lab.run(&["environment", "check", name]).code < 2, "{name}");
        for keep in [bytes.len() - 3, bytes.len() / 2, 20] {
            lab.write(name, &bytes[..keep]);
            lab.run(&["environment", "convert", name, "out", "--size", "4"]).refused(&[&format!("{name}: ")]);
        }
        let mut rubbish = bytes.clone();
        let length = bytes.len();
        let damaged = 16..(length * 3 / 4).min(200);
        rubbish[damaged].fill(0xa5);
        lab.write(name, rubbish);
        lab.refuses(name, &[&format!("{name}: ")]);
        std::fs::remove_file(lab.path(name)).unwrap();
        assert!(lab.names().is_empty(), "{name}: {:?}", lab.names());
    }
}

#[test]
fn panoramas_of_wrong_proportions_and_very_wide_ones() {
    let lab = Lab::new();
    lab.write("odd.png", png(9, 3));
    let warning = "warning: odd.png: 9 x 3 pixels are not the size of a cross, a strip or a 2:1 panorama; the picture is \
                   read as an equirectangular panorama, 360 degrees across its width and 180 along its height";
    for args in [
        &["environment", "convert", "odd.png", "out", "--size", "4"][..],
        &["render", "builtin:cube", "--environment", "odd.png", "-o", "a.png", "--size", "8x8", "--backend", "cpu"],
    ] {
        let run = lab.run(args).good();
        assert!(run.stderr.lines().any(|l| l == warning), "{}", run.stderr);
    }
    // 32768 wide: the limit of the reader, and twice that of most GPUs.
    lab.write("wide.png", png(32768, 2));
    lab.run(&["environment", "convert", "wide.png", "small", "--size", "4"]).good();
    let args = ["render", "builtin:cube", "--environment", "wide.png", "-o", "a.png", "--size", "8x8"];
    let run = lab.run(&[&args[..], &["--backend", "cpu"]].concat()).good();
    assert!(
        run.stderr.contains("cubemap of 8192 texels along an edge, and is converted to one of 1024"),
        "{}",
        run.stderr
    );

    // The sizes in a header are checked before anything is allocated.
    let before = lab.names();
    lab.write("claims.png", png_header(32768, 16384));
    let args = ["environment", "convert", "claims.png", "out.hdr"];
    // The default is a share of the machine's memory.
    let run = lab.run(&[&args[..], &["--max-memory", "8GiB"]].concat());
    run.refused(&["claims.png: this PNG ends before the picture is whole"]);
    let run = lab.run(&[&args[..], &["--max-memory", "1GiB"]].concat());
    run.refused(&["claims.png: 32768 x 16384 pixels are 8.0 GiB", "the limit is 1.0 GiB", "--max-memory"]);
    lab.write("claims.png", png_header(65536, 65536));
    lab.run(&args).refused(&["claims.png: 65536 x 65536 pixels are 64.0 GiB", "the limit is"]);
    std::fs::remove_file(lab.path("claims.png")).unwrap();
    assert_eq!(lab.names(), before);
}

#[test]
fn impossible_outputs_are_refused_before_anything_is_read() {
    let lab = Lab::new();
    lab.write("file", "x");
    std::fs::create_dir(lab.path("folder.png")).unwrap();
    let before = lab.names();
    let convert = |args: &[&str]| lab.run(&[&["environment", "convert", "nothing.hdr"], args].concat());
    convert(&["file"]).refused(&["`file` is a file; six faces need a folder"]);
    convert(&["file/faces"]).refused(&["`file/faces` cannot be written"]);
    convert(&["folder.png"]).refused(&["`folder.png`", "it is a folder"]);
    convert(&["no/faces"]).refused(&["there is no folder `no`; create it first"]);
    convert(&["no/a.hdr"]).refused(&["there is no folder `no`; create it first"]);
    convert(&["a.jpg"]).refused(&["`a.jpg`: unsupported format `.jpg`: expected .png, .exr, .hdr or .ktx2"]);
    convert(&["a.pgn"]).refused(&["did you mean .png?"]);
    convert(&["a", "--to", "cross"]).refused(&["`a` cannot be written as cross", ".png, .exr or .hdr"]);
    convert(&["a.png", "--to", "faces"]).refused(&["six faces need a folder", "leave out its extension"]);
    convert(&["a.png", "--to", "ktx2"]).refused(&["must end in .ktx2"]);
    convert(&["a.png", "--format", "exr"]).refused(&["ends in .png, but --format is exr"]);
    convert(&["a.ktx2", "--format", "exr"]).refused(&["leave out --format"]);
    convert(&["a.exr", "--bits", "16"]).refused(&["--bits applies to PNG only"]);
    convert(&["a.exr", "--layout", "photographic"]).refused(&["--layout applies to faces"]);
    convert(&["a.ktx2", "--layout", "photographic"]).refused(&["OpenGL's layout only"]);
    convert(&["a", "--size", "8x4"]).refused(&["--size of faces is one number"]);
    convert(&["a", "--size", "9999"]).refused(&["six faces of 9999 x 9999 are too large", "8192"]);
    convert(&["a.hdr", "--size", "32768x32768"]).refused(&["32768 x 32768 is too large", "--size is at most 32768"]);
    let check = |args: &[&str]| lab.run(&[&["environment", "check", "nothing.hdr"], args].concat());
    check(&["--repair", "file"]).refused(&["`file` is a file; six faces need a folder"]);
    check(&["--repair", "no/a.png"]).refused(&["there is no folder `no`"]);
    assert_eq!(lab.names(), before);
    // The same applies to environments that are computed, not read.
    lab.run(&["environment", "convert", "sky", "a", "--size", "30000"]).refused(&["too large"]);
    let small = ["environment", "convert", "sky", "a", "--max-memory", "1MiB"];
    lab.run(&small).refused(&["6 times 512 x 512 pixels are 24.0 MiB", "the limit is 1.0 MiB"]);
    assert_eq!(lab.names(), before);
}

/// A file may have at most one block: writing fails in the middle, as on a full disk.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_leaves_no_faces() {
    let lab = Lab::new();
    std::fs::create_dir(lab.path("there")).unwrap();
    lab.write("there/posx.exr", "the face of yesterday");
    let script = r#"ulimit -f 1; trap "" XFSZ; exec "$0" "$@""#;
    for folder in ["new", "there"] {
        let output = std::process::Command::new("sh")
            .args(["-c", script, env!("CARGO_BIN_EXE_gonio"), "environment", "convert", "sky", folder, "--size", "64"])
            .current_dir(lab.path(""))
            .output()
            .unwrap();
        common::Run::of(output).refused(&[&format!("`{folder}/posx.exr` cannot be written")]);
    }
    assert_eq!(lab.names(), ["there"]);
    let within: Vec<_> = std::fs::read_dir(lab.path("there")).unwrap().map(|e| e.unwrap().file_name()).collect();
    assert_eq!((within.len(), lab.read("there/posx.exr")), (1, b"the face of yesterday".to_vec()));
}

#[test]
fn wrong_options() {
    let lab = Lab::new();
    let render = |args: &[&str]| lab.run(&[&["render", "builtin:cube", "-o", "out.png"], args].concat());
    render(&["--environment"]).refused(&["--environment", "value"]);
    for (option, value, piece) in [
        ("--environment-blur", "2", "0 to 1"),
        ("--environment-rotate", "a,b", "yaw,pitch,roll in degrees"),
        ("--environment-rotate", "1,2", "for example 90,0,0"),
        ("--environment-size", "0", "1 to 8192"),
        ("--environment-size", "9000", "1 to 8192"),
        ("--environment-intensity", "-1", "expected 0 or more"),
        ("--environment-layout", "opnegl", "opengl"),
        ("--environment-light=maybe", "", "true"),
    ] {
        let given: Vec<&str> = [option, value].into_iter().filter(|v| !v.is_empty()).collect();
        let name = option.split('=').next().unwrap();
        render(&[&["--environment", "sky"], &given[..]].concat()).refused(&[name, piece]);
    }
    render(&["--environment-blur", "0.5"]).refused(&["the environment needs `image`", "add one with --environment"]);
    render(&["--environment", "sky", "--environment-background", "skyy"]).refused(&["skyy", "did you mean `sky`"]);
    render(&["--material", "glas"]).refused(&["--material", "did you mean `glass`"]);
    let convert = |args: &[&str]| lab.run(&[&["environment", "convert", "sky", "out"], args].concat());
    for (option, value, piece) in [
        ("--rotate", "a,b", "yaw,pitch,roll in degrees"),
        ("--size", "0", "1 to 32768"),
        ("--size", "many", "N or WxH"),
        ("--filter", "biliner", "bilinear"),
        ("--to", "faecs", "faces"),
        ("--format", "jpg", "exr"),
        ("--layout", "opengll", "opengl"),
        ("--bits", "12", "8 or 16"),
        ("--exposure", "bright", "invalid number"),
        ("--tone-map", "acess", "aces"),
        ("--from", "crss", "cross"),
    ] {
        convert(&[option, value]).refused(&[option, piece]);
    }
    convert(&["--from", "cross"]).refused(&["this is already faces and cannot be read as cross"]);
    // A layout for an input without faces is a warning and changes nothing.
    let run = convert(&["--from-layout", "opengl", "--size", "1", "--format", "hdr"]).good();
    assert!(run.stderr.contains("warning: sky: the layout has no effect"), "{}", run.stderr);
    assert_eq!(lab.names(), ["out"]);
}
