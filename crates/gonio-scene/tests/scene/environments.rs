//! What `[environment]` and `--environment` may name, and what becomes of it in a scene.

use crate::{Memory, TRIANGLE};
use glam::DVec3;
use gonio_environment::arrange::{self, Arrangement};
use gonio_environment::{CubeMips, Cubemap, Face, Layout};
use gonio_image::decode::{self, DecodedContent, FileFormat};
use gonio_image::encode::ktx2;
use gonio_image::{DecodeLimits, Image};
use gonio_mesh::{Limits, Severity};
use gonio_scene::environment_file::{BUILTIN_SIZE, EnvironmentMap, EnvironmentReadOptions, OpenedEnvironment, open};
use gonio_scene::files::{Disk, FileSource};
use gonio_scene::load::{describe, load};
use gonio_scene::{Scene, toml_file};
use std::path::Path;

/// A PNG of RGB pixels, top row first.
fn png(width: u32, height: u32, pixels: impl Fn(u32, u32) -> [u8; 3]) -> Vec<u8> {
    let picture = image::RgbImage::from_fn(width, height, |x, y| image::Rgb(pixels(x, y)));
    let mut bytes = std::io::Cursor::new(Vec::new());
    picture.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
    bytes.into_inner()
}

/// Texels along an edge.
const SIZE: u32 = 4;

/// The red of a face.
fn red(face: Face) -> u8 {
    20 + 40 * face as u8
}

/// A face whose left half is blue too.
fn face(face: Face) -> Vec<u8> {
    png(SIZE, SIZE, |x, _| [red(face), 0, if x < SIZE / 2 { 255 } else { 0 }])
}

fn decoded(bytes: &[u8]) -> Image {
    match decode::decode("", bytes, &DecodeLimits::default()).unwrap().shape {
        DecodedContent::Picture(image) => image,
        DecodedContent::Faces(_) => panic!("six faces"),
    }
}

/// The six faces as files of such names, `*` being the face's.
fn six(names: &str) -> Memory {
    let name = |f: Face| names.replace('*', f.name());
    Face::ALL.into_iter().fold(Memory::default(), |files, f| files.with(&name(f), face(f)))
}

/// The six faces in a layout.
fn map(layout: Layout) -> Cubemap {
    Cubemap::from_faces(Face::ALL.map(|f| decoded(&face(f))), layout).unwrap()
}

fn in_layout(layout: Layout) -> EnvironmentReadOptions {
    EnvironmentReadOptions { layout: Some(layout), ..EnvironmentReadOptions::default() }
}

#[track_caller]
fn opened(files: &dyn FileSource, name: &str, reading: EnvironmentReadOptions) -> OpenedEnvironment {
    open(name, reading, Path::new(""), files, &Limits::default()).unwrap_or_else(|e| panic!("{e}"))
}

#[track_caller]
fn refused(files: &dyn FileSource, name: &str) -> String {
    open(name, EnvironmentReadOptions::default(), Path::new(""), files, &Limits::default())
        .map(|o| o.map)
        .unwrap_err()
        .to_string()
}

fn cubemap(opened: &OpenedEnvironment) -> &Cubemap {
    match &opened.map {
        EnvironmentMap::Cubemap(map) => map,
        EnvironmentMap::Panorama(_) => panic!("{} is a panorama", opened.name),
    }
}

#[test]
fn a_folder_a_pattern_and_one_of_six_are_the_same_faces() {
    let files = six("faces/day_*.png").with("faces/night_posx.png", face(Face::PosX)).with("faces/readme.txt", "x");
    for name in ["faces", "faces/day_*.png", "faces/d*_*.p*", "faces/day_negy.png"] {
        let found = opened(&files, name, EnvironmentReadOptions::default());
        assert_eq!((found.layout, found.arrangement), (Some(Layout::Photographic), Arrangement::Faces), "{name}");
        assert!(*cubemap(&found) == map(Layout::Photographic), "{name}");
        let paths: Vec<String> = found.files.iter().map(|p| p.display().to_string()).collect();
        assert_eq!(paths, Face::ALL.map(|f| format!("faces/day_{}.png", f.name())), "{name}");
        assert_eq!((found.name.as_str(), found.format), (name, Some(FileFormat::Png)));
        assert!(!found.high_dynamic_range && found.diagnostics.iter().all(|d| d.severity == Severity::Note));
        assert!(*cubemap(&opened(&files, name, in_layout(Layout::OpenGl))) == map(Layout::OpenGl), "{name}");
    }
    // In the current folder.
    assert!(
        *cubemap(&opened(&six("*.png"), "negz.png", EnvironmentReadOptions::default())) == map(Layout::Photographic)
    );
}

/// Said once without the code that is tested: where each picture is, and that none is mirrored.
#[test]
fn the_photographic_layout_has_posz_ahead_and_the_other_behind() {
    let files = six("*.png");
    let light = |layout, direction: DVec3| {
        let found = opened(&files, "posx.png", in_layout(layout));
        let sample = cubemap(&found).sample_nearest(direction);
        (gonio_light::color::srgb_encode(sample.x) * 255.0, sample.z > 0.5)
    };
    let near = |(value, _): (f64, bool), face: Face| assert!((value - f64::from(red(face))).abs() < 0.01, "{face:?}");
    let (x, y, z) = (DVec3::X, DVec3::Y, DVec3::Z);
    for (face, photographic, open_gl) in [
        (Face::PosX, x, x),
        (Face::NegX, -x, -x),
        (Face::PosY, y, y),
        (Face::NegY, -y, -y),
        (Face::PosZ, -z, z),
        (Face::NegZ, z, -z),
    ] {
        near(light(Layout::Photographic, photographic), face);
        near(light(Layout::OpenGl, open_gl), face);
    }
    // Ahead is -Z: the left half of what is there is towards -X.
    assert!(light(Layout::Photographic, -z - 0.5 * x).1 && !light(Layout::Photographic, -z + 0.5 * x).1);
    // OpenGL's +Z face has its columns along +X: someone who looks there has +X to the left, so it is mirrored.
    assert!(light(Layout::OpenGl, z - 0.5 * x).1 && !light(Layout::OpenGl, z + 0.5 * x).1);
}

#[test]
fn pictures_of_six_faces_are_recognised_by_their_proportions() {
    for arrangement in [Arrangement::Cross, Arrangement::VerticalCross, Arrangement::Strip, Arrangement::VerticalStrip]
    {
        let whole = arrange::from_cubemap(&map(Layout::OpenGl), arrangement, Layout::OpenGl).unwrap();
        let bytes = png(whole.width, whole.height, |x, y| {
            let encode = |v: f32| (gonio_light::color::srgb_encode(v.into()) * 255.0).round() as u8;
            let [r, g, b, _] = whole.at(x, y);
            [encode(r), encode(g), encode(b)]
        });
        let files = Memory::default().with("a.png", bytes);
        let found = opened(&files, "a.png", in_layout(Layout::OpenGl));
        assert_eq!((found.arrangement, found.layout), (arrangement, Some(Layout::OpenGl)));
        assert!(*cubemap(&found) == map(Layout::OpenGl), "{arrangement}");
        // The usual layout is the other one.
        let usual = opened(&files, "a.png", EnvironmentReadOptions::default());
        assert_eq!(usual.layout, Some(Layout::Photographic));
        assert!(*cubemap(&usual) == *cubemap(&opened(&files, "a.png", in_layout(Layout::Photographic))));
        assert!(*cubemap(&usual) != map(Layout::OpenGl), "{arrangement}");
        // Read as a panorama on request.
        let reading = EnvironmentReadOptions {
            arrangement: Some(Arrangement::Equirectangular),
            ..EnvironmentReadOptions::default()
        };
        assert!(matches!(opened(&files, "a.png", reading).map, EnvironmentMap::Panorama(_)));
    }
}

#[test]
fn a_ktx2_file_is_in_opengls_layout() {
    let bytes = CubeMips::new(map(Layout::OpenGl)).to_ktx2(ktx2::Ktx2Format::Srgb8).bytes;
    let files = Memory::default().with("a.ktx2", bytes.clone());
    let found = opened(&files, "a.ktx2", EnvironmentReadOptions::default());
    assert_eq!((found.layout, found.format), (Some(Layout::OpenGl), Some(FileFormat::Ktx2)));
    assert!(*cubemap(&found) == map(Layout::OpenGl));
    assert!(*cubemap(&opened(&files, "a.ktx2", in_layout(Layout::Photographic))) == map(Layout::Photographic));
    // It is no face of six.
    let text = refused(&six("*.png").with("posx.png", bytes), "negx.png");
    assert_eq!(text, "posx.png: this file holds six faces, but one face was expected; name this file alone");
}

#[test]
fn built_in_environments_need_no_file() {
    let none = Memory::default();
    for (name, layout) in [("debug", Some(Layout::OpenGl)), ("sky", None)] {
        let found = opened(&none, name, EnvironmentReadOptions::default());
        assert_eq!((cubemap(&found).size(), found.layout, found.files.len()), (BUILTIN_SIZE, layout, 0), "{name}");
    }
    let small = EnvironmentReadOptions { size: Some(8), ..EnvironmentReadOptions::default() };
    assert!(cubemap(&opened(&none, "builtin:sky", small)) == cubemap(&opened(&none, "SKY", small)));
    assert_eq!(cubemap(&opened(&none, "sky", small)).size(), 8);
    let photographic = EnvironmentReadOptions { layout: Some(Layout::Photographic), ..small };
    assert_eq!(opened(&none, "debug", photographic).layout, Some(Layout::Photographic));
    assert!(matches!(opened(&none, "room", EnvironmentReadOptions::default()).map, EnvironmentMap::Panorama(_)));
    // A size is checked before anything is made.
    let few = Limits { max_bytes: 1 << 20, ..Limits::default() };
    let text = open("sky", EnvironmentReadOptions::default(), Path::new(""), &none, &few)
        .map(|o| o.map)
        .unwrap_err()
        .to_string();
    assert!(text.starts_with("sky: 6 times 512 x 512 pixels are 24.0 MiB"), "{text}");
    // A folder that is called like one can be named otherwise.
    let found = opened(&six("./sky/*.png"), "./sky", EnvironmentReadOptions::default());
    assert!(*cubemap(&found) == map(Layout::Photographic));
    let found = opened(&six("sky/*.png"), "sky", small);
    let note = "this names the built-in environment; write ./sky for the folder";
    assert_eq!((found.diagnostics[0].severity, found.diagnostics[0].message.as_str()), (Severity::Note, note));
}

#[test]
fn errors_name_their_file() {
    let ends = |text: String, message: &str| assert!(text.ends_with(message), "{text}");
    let none = Memory::default();
    assert_eq!(refused(&none, "skyy"), "skyy: there is no such file or folder; did you mean `sky`, which is built in?");
    ends(refused(&none, "sky/day.png"), "check the path, or use debug, sky or room to try things out");
    let message = "unknown built-in environment `rom`: expected one of debug, sky, room; did you mean `room`?";
    ends(refused(&none, "builtin:rom"), message);
    ends(refused(&none, "builtin:suzanne"), "unknown built-in environment `suzanne`: expected one of debug, sky, room");
    ends(refused(&none, "sky_*.png"), "no file matches this pattern");
    let five = Face::ALL[..5].iter().fold(Memory::default(), |m, f| m.with(&format!("a/{}.png", f.name()), face(*f)));
    assert_eq!(refused(&five, "a"), "a: 5 of six faces found; missing: `negz` (`negz.png`)");
    assert_eq!(refused(&five, "a/posx.png"), "a/posx.png: 5 of six faces found; missing: `negz` (`negz.png`)");
    ends(refused(&six("a/*.png").with("b/c.txt", "x"), "b"), "posx.png negx.png posy.png negy.png posz.png negz.png");

    // The face's own file is named.
    let smaller = six("a/*.png").with("a/posz.png", png(2, 2, |_, _| [0; 3]));
    let text = refused(&smaller, "a");
    assert!(text.starts_with("a/posz.png: ") && text.contains("2 x 2"), "{text}");
    let oblong = six("a/*.png").with("a/negy.png", png(4, 3, |_, _| [0; 3]));
    let text = refused(&oblong, "a");
    assert!(text.starts_with("a/negy.png: ") && text.contains("4 x 3"), "{text}");
    let mut cut = face(Face::NegX);
    cut.truncate(cut.len() - 20);
    let text = refused(&six("a/*.png").with("a/negx.png", cut), "a");
    assert!(text.starts_with("a/negx.png: this PNG ends"), "{text}");

    let folder = tempfile::tempdir().unwrap();
    ends(
        refused(&Disk, &folder.path().to_string_lossy()),
        "the folder is empty; it must hold six faces, for example posx.png negx.png posy.png negy.png posz.png negz.png",
    );
}

#[test]
fn models_and_environments_are_distinguished() {
    let panorama = png(8, 4, |_, _| [9; 3]);
    let scene = "[[object]]\nmodel = \"t.obj\"\n";
    let files = Memory::default().with("t.obj", TRIANGLE).with("s.toml", scene).with("p.png", panorama);
    assert_eq!(refused(&files, "t.obj"), "t.obj: this is a model, not a picture; to draw it, name it as the input");
    assert_eq!(
        refused(&files, "s.toml"),
        "s.toml: this is a scene file, not a picture; to draw it, name it as the input"
    );
    let messages = |name: &str| describe(&[name], &files).unwrap_err().to_string();
    let remedy = "not a model; to surround a model by it, name it as the environment";
    assert_eq!(messages("p.png"), format!("p.png: this is a PNG image, {remedy}"));
    assert_eq!(messages("sky"), format!("sky: this is a built-in environment, {remedy}"));
    assert!(messages("skyy").contains("there is no such file"));
}

#[test]
fn options_without_effect_are_reported() {
    let files = six("a/*.png").with("p.png", png(8, 4, |_, _| [9; 3])).with("odd.png", png(9, 3, |_, _| [9; 3]));
    let found = opened(&files, "p.png", in_layout(Layout::OpenGl));
    assert_eq!(found.layout, None);
    assert!(found.diagnostics.iter().any(|d| d.message.starts_with("the layout has no effect")));
    assert!(opened(&files, "p.png", EnvironmentReadOptions::default()).diagnostics.is_empty());
    let odd = opened(&files, "odd.png", EnvironmentReadOptions::default());
    assert_eq!((odd.diagnostics.len(), odd.diagnostics[0].severity), (1, Severity::Warning));
    assert!(odd.diagnostics[0].message.contains("360 degrees across its width"), "{:?}", odd.diagnostics);
    // Six files are no cross.
    let reading = EnvironmentReadOptions { arrangement: Some(Arrangement::Cross), ..EnvironmentReadOptions::default() };
    let error = open("a", reading, Path::new(""), &files, &Limits::default()).map(|o| o.map).unwrap_err();
    let message = "a: this is already faces and cannot be read as cross; leave the arrangement out";
    assert_eq!(error.to_string(), message);
}

/// A scene file in a folder, and what it may be surrounded by.
fn scene(environment: &str) -> (Scene, Memory) {
    let panorama = png(16, 8, |x, y| [10 * x as u8, 20 * y as u8, 99]);
    let ktx2 = CubeMips::new(map(Layout::OpenGl)).to_ktx2(ktx2::Ktx2Format::Srgb8).bytes;
    let text = format!("[environment]\n{environment}\n[[object]]\nmodel = \"builtin:cube\"\n");
    // Paths in memory are compared as they are written.
    let files = six("scenes/faces/*.png").with("scenes/p.png", panorama).with("scenes/../k.ktx2", ktx2);
    let files = files.with("scenes/s.toml", text);
    let described = describe(&["scenes/s.toml"], &files).unwrap_or_else(|e| panic!("{environment}: {e}"));
    (load(described, Path::new(""), &files).unwrap_or_else(|e| panic!("{environment}: {e}")), files)
}

#[test]
fn a_printed_scene_has_the_same_environment() {
    for (environment, image, layout, size) in [
        ("image = \"faces\"\nblur = 0.25", "scenes/faces", Some(Layout::Photographic), Some(4)),
        ("image = \"faces\"\nlayout = \"opengl\"\nsize = 2", "scenes/faces", Some(Layout::OpenGl), Some(2)),
        ("image = \"p.png\"\nrotate = [1, 2.5, -3]\nintensity = 0.3", "scenes/p.png", None, Some(4)),
        ("image = \"../k.ktx2\"\nvisible = false", "scenes/../k.ktx2", Some(Layout::OpenGl), Some(4)),
        ("image = \"debug\"\nsize = 16\nlight = true", "debug", Some(Layout::OpenGl), Some(16)),
        ("image = \"builtin:room\"\nlight = false", "builtin:room", None, Some(128)),
        // Two environments with different layouts or sizes keep their defaults.
        ("image = \"faces\"\nbackground = \"../k.ktx2\"", "scenes/faces", None, Some(4)),
        ("image = \"faces\"\nbackground = \"room\"", "scenes/faces", Some(Layout::Photographic), None),
        (
            "image = \"p.png\"\nbackground = \"faces\"\nlayout = \"opengl\"",
            "scenes/p.png",
            Some(Layout::OpenGl),
            Some(4),
        ),
    ] {
        let (first, files) = scene(environment);
        let spec = first.settings.environment.clone().unwrap();
        assert_eq!((spec.image.as_str(), spec.layout, spec.size), (image, layout, size), "{environment}");
        let whole = gonio_scene::SceneFile::from(&first.settings);
        let text = whole.to_toml_string();
        let read = toml_file::read(&text).unwrap_or_else(|e| panic!("{e}\n{text}"));
        assert_eq!(read, whole, "{text}");
        let second = load(read, Path::new(""), &files).unwrap();
        assert_eq!(second.settings, first.settings, "{text}");
        assert_eq!(second.surroundings(), first.surroundings(), "{text}");
        let of = |scene: &Scene| scene.environment.as_ref().map(|e| (e.mips.clone(), e.background.clone()));
        assert!(of(&first) == of(&second), "{text}");
        assert_eq!(toml::from_str::<gonio_scene::SceneFile>(&text).unwrap(), whole);
    }
}

#[test]
fn the_environment_lights_a_scene_that_has_no_lights() {
    let (alone, _) = scene("image = \"faces\"");
    assert!(alone.surroundings().unwrap().lights && alone.settings.lights.is_empty());
    let (dark, _) = scene("image = \"faces\"\nlight = false");
    assert!(!dark.surroundings().unwrap().lights && !dark.settings.lights.is_empty());
    let lamp = "[[light]]\nkind = \"ambient\"";
    let (lit, _) = scene(&format!("image = \"faces\"\n{lamp}"));
    assert!(!lit.surroundings().unwrap().lights && lit.settings.lights.len() == 1);
    let (both, _) = scene(&format!("image = \"faces\"\nlight = true\n{lamp}"));
    assert!(both.surroundings().unwrap().lights && both.settings.lights.len() == 1);
}

#[test]
fn another_background_leaves_the_light_as_it_is() {
    let (scene, _) = scene("image = \"faces\"\nbackground = \"debug\"\nsize = 4");
    let environment = scene.environment.as_ref().unwrap();
    assert!(*environment.mips.full() == map(Layout::Photographic));
    let message = gonio_environment::debug::debug(4, Layout::OpenGl);
    assert!(*environment.seen().full() == message && environment.seen().full() != environment.mips.full());
}

#[test]
fn panoramas_become_cubemaps_of_their_resolution_up_to_the_default() {
    let (small, _) = scene("image = \"p.png\"");
    assert_eq!(small.environment.as_ref().unwrap().mips.full().size(), 4);
    assert!(small.diagnostics.is_empty(), "{:?}", small.diagnostics);
    // A quarter of a row is an edge: 8192 pixels are as fine as 2048 texels. One row is enough to be so wide.
    let files = Memory::default().with("w.png", png(8192, 2, |_, _| [99; 3]));
    let text = "[environment]\nimage = \"w.png\"\n[[object]]\nmodel = \"builtin:cube\"\n";
    let wide = load(toml_file::read(text).unwrap(), Path::new(""), &files).unwrap();
    assert_eq!(wide.environment.as_ref().unwrap().mips.full().size(), 1024);
    let note = wide.diagnostics.iter().find(|d| d.severity == Severity::Note).unwrap();
    assert!(note.message.contains("cubemap of 2048") && note.message.contains("one of 1024"), "{note:?}");
}

#[test]
fn a_default_layout_is_reported() {
    let messages = |environment: &str| -> Vec<String> {
        let diagnostics = scene(environment).0.diagnostics;
        diagnostics.into_iter().map(|d| d.message).filter(|m| m.contains("read in the layout")).collect()
    };
    let photographic = "the faces are read in the layout `photographic`; if the world looks mirrored, set the \
                        layout `opengl`";
    assert_eq!(messages("image = \"faces\""), [photographic]);
    let by_format = messages("image = \"../k.ktx2\"");
    assert!(matches!(&by_format[..], [one] if one.contains("`opengl`")), "{by_format:?}");
    assert!(messages("image = \"faces\"\nlayout = \"photographic\"").is_empty());
    assert!(messages("image = \"p.png\"").is_empty() && messages("image = \"debug\"").is_empty());
}

#[test]
fn mirrors_and_glass_without_surroundings_are_warned_about() {
    let warned = |material: &str, environment: &str| {
        let text = format!("{environment}[[object]]\nmodel = \"builtin:cube\"\nmaterial = {{ {material} }}\n");
        let scene = load(toml_file::read(&text).unwrap(), Path::new(""), &Memory::default()).unwrap();
        scene.diagnostics.iter().any(|d| d.message.starts_with("mirrors and glass show their surroundings"))
    };
    let sky = "[environment]\nimage = \"sky\"\nsize = 1\n";
    assert!(warned("reflectivity = 0.5", "") && warned("medium = \"glass\"", ""));
    assert!(!warned("reflectivity = 0.5", sky) && !warned("diffuse = [1, 0, 0]", ""));
}

#[test]
fn keys_of_an_environment_are_checked() {
    let check_message = |text: &str, expected: &str| {
        let text = format!("[[object]]\nmodel = \"builtin:cube\"\n[environment]\n{text}");
        assert_eq!(toml_file::read(&text).unwrap_err().to_string(), expected);
    };
    check_message(
        "blur = 0.5\n",
        "3:1: the environment needs `image`: debug, sky, room, a picture or a folder of six faces",
    );
    check_message("image = \"sky\"\nblur = 2\n", "5:8: `blur` must be 0 to 1, not 2");
    check_message("image = \"sky\"\nsize = 0\n", "5:8: `size` must be 1 to 8192 texels, not 0");
    check_message("image = \"sky\"\nintensity = -1\n", "5:13: `intensity` must be 0 to 1000000, not -1");
    check_message(
        "image = \"sky\"\nrotate = [1, 2]\n",
        "5:10: `rotate`: expected three numbers [x, y, z], found a list of 2",
    );
    check_message(
        "image = \"sky\"\nlayout = \"open-gl\"\n",
        "5:10: `layout`: invalid layout of faces `open-gl`: expected one of opengl, photographic; did you mean `opengl`?",
    );
    check_message(
        "imag = \"sky\"\n",
        "4:1: unknown key `imag` in [environment]; did you mean `image`? Known keys: image, layout, size, rotate, \
         intensity, light, visible, blur, background",
    );
}
