//! Inputs that cannot be read, each with one clear sentence.

use crate::memory::{Memory, TRIANGLE};
use gonio_scene::files::{BuiltinOnly, Disk};
use gonio_scene::load::{describe, load};
use std::path::Path;

#[track_caller]
fn describe_says(name: &str, bytes: &[u8], expected: &str) {
    let files = Memory::default().with(name, bytes);
    let error = describe(&[name], &files).unwrap_err().to_string();
    assert_eq!(error, expected);
}

const READABLE: &str = "models (.obj .gltf .glb .dae .ply .stl .mesh .meshb, also .gz and .zst) and scene files (.toml) \
                        can be read";

#[test]
fn what_cannot_be_read_is_named() {
    describe_says("a.obj", b"", &format!("a.obj: the file is empty; {READABLE}"));
    describe_says("a.txt", b"hello\n", &format!("a.txt: this .txt file is of no known kind; {READABLE}"));
    describe_says("a.dat", b"\x01\x02\0\0\0", &format!("a.dat: this is binary data of no known kind; {READABLE}"));
    describe_says("a.obj", b"\x7fELF\0\0\0", &format!("a.obj: this is a program; {READABLE}"));
    describe_says("a.obj", b"\x89PNG\r\n", &format!("a.obj: this is a PNG image; {READABLE}"));
    describe_says("a.glb", b"{\"a\": {}}", &format!("a.glb: this is a JSON file that is not glTF; {READABLE}"));
    describe_says("a.dae", b"<html>", &format!("a.dae: this is an XML or HTML file; {READABLE}"));
}

/// A model's format is told by its content, whatever its name says.
#[test]
fn what_a_file_is_is_told_by_its_content_first() {
    let model = |name: &str, content: &[u8]| {
        let files = Memory::default().with(name, content);
        describe(&[name], &files).unwrap().objects[0].model == name
    };
    let mut stl = vec![b' '; 80];
    stl.extend(1_u32.to_le_bytes());
    stl.extend([0; 50]);
    let contents: [&[u8]; 11] = [
        TRIANGLE.as_bytes(),
        b"glTF\x02\0\0\0",
        b"{\"asset\": {\"version\": \"2.0\"}}",
        b"<?xml version=\"1.0\"?><COLLADA>",
        b"ply\nformat ascii 1.0\n",
        b"solid a\n facet normal 0 0 1\n",
        &stl,
        b"# mine\n\nMeshVersionFormatted 1\n",
        &[1, 0, 0, 0, 2, 0, 0, 0],
        b"\x1F\x8B\x08\0",
        b"\x28\xB5\x2F\xFD",
    ];
    for content in contents {
        for name in ["a.obj", "a.txt", "a", "a.stl"] {
            assert!(model(name, content), "{name}: {:?}", String::from_utf8_lossy(content));
        }
    }
    let scene = "[[object]]\nmodel = \"builtin:cube\"\n";
    for name in ["scene.txt", "scene.toml", "scene"] {
        let files = Memory::default().with(name, scene);
        assert_eq!(describe(&[name], &files).unwrap().objects[0].model, "builtin:cube");
    }
}

#[test]
fn what_is_not_there() {
    let missing = describe(&["no/such.obj"], &Disk).unwrap_err().to_string();
    assert!(missing.starts_with("no/such.obj: there is no such file; check the path"), "{missing}");
    let folder = describe(&["src"], &Disk).unwrap_err().to_string();
    assert_eq!(folder, "src: this is a folder; name a file in it");
    let unknown = describe(&["builtin:suzane"], &BuiltinOnly).unwrap_err().to_string();
    assert!(
        unknown.starts_with(
            "builtin:suzane: nothing of this name is built in; did you mean `builtin:suzanne`? there are "
        ),
        "{unknown}"
    );
    assert!(describe(&[], &Disk).is_err());
}

#[test]
fn errors_in_a_scene_name_file_line_and_column() {
    let files = Memory::default().with("dir/s.toml", "[camera]\nfov_y = 200\n[[object]]\nmodel = \"m.obj\"\n");
    let error = describe(&["dir/s.toml"], &files).unwrap_err().to_string();
    assert_eq!(error, "dir/s.toml:2:9: `fov_y` must be greater than 0 and less than 180 degrees, not 200");
    let files = Memory::default().with("s.toml", b"[camera]\n# \xff\n".to_vec());
    let error = describe(&["s.toml"], &files).unwrap_err().to_string();
    assert_eq!(error, "s.toml:2:3: a scene file must be UTF-8 text, and here it is not");
}

#[test]
fn models_of_a_scene_lie_beside_it() {
    let files = Memory::default()
        .with("dir/s.toml", "[[object]]\nmodel = \"sub/t.obj\"\n[[object]]\nmodel = \"builtin:cube\"\n")
        .with("dir/sub/t.obj", TRIANGLE)
        .with("dir/sub/t.mtl", "newmtl m\n");
    let scene = load(describe(&["dir/s.toml"], &files).unwrap(), Path::new(""), &files).unwrap();
    assert_eq!(scene.settings.objects[0].model, "dir/sub/t.obj");
    assert_eq!((scene.objects[0].name.as_str(), scene.objects[1].name.as_str()), ("t", "cube"));
    let missing = Memory::default().with("dir/s.toml", "[[object]]\nmodel = \"sub/t.obj\"\n");
    let error = load(describe(&["dir/s.toml"], &missing).unwrap(), Path::new(""), &missing).unwrap_err().to_string();
    assert!(error.starts_with("dir/sub/t.obj: there is no such file"), "{error}");
}

#[test]
fn a_model_without_triangles_is_an_error_and_options_are_checked_too() {
    let files = Memory::default().with("p.obj", "v 0 0 0\nv 1 0 0\n");
    let error = load(describe(&["p.obj"], &files).unwrap(), Path::new(""), &files).unwrap_err().to_string();
    assert!(error.starts_with("p.obj") && error.contains("triangle"), "{error}");
    let mut scene = describe(&["builtin:cube"], &BuiltinOnly).unwrap();
    scene.picture.width = 100_000;
    let error = load(scene, Path::new(""), &BuiltinOnly).unwrap_err().to_string();
    assert_eq!(error, "`width` of the picture must be 1 to 16384 pixels, not 100000");
}

#[test]
fn several_inputs_are_one_scene() {
    let files = Memory::default()
        .with("s.toml", "[picture]\nwidth = 77\n[[object]]\nmodel = \"builtin:cube\"\n[[light]]\nkind = \"ambient\"\n");
    let scene = describe(&["builtin:suzanne", "s.toml", "builtin:sphere-smooth"], &files).unwrap();
    let models: Vec<&str> = scene.objects.iter().map(|o| o.model.as_str()).collect();
    assert_eq!(models, ["builtin:suzanne", "builtin:cube", "builtin:sphere-smooth"]);
    assert_eq!((scene.picture.width, scene.lights.len()), (77, 1));
}

/// A file may name as its texture what never ends.
#[cfg(unix)]
#[test]
fn devices_are_not_read() {
    let error = describe(&["/dev/zero"], &Disk).unwrap_err().to_string();
    assert_eq!(error, "/dev/zero: the file cannot be read: it is a device, not a file");
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join("m.obj");
    std::fs::write(&model, "mtllib m.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    std::fs::write(folder.path().join("m.mtl"), "newmtl m\nmap_Kd /dev/zero\n").unwrap();
    let scene = describe(&[&model.display().to_string()], &Disk).unwrap();
    let scene = gonio_scene::load::load(scene, std::path::Path::new(""), &Disk).unwrap();
    let said: Vec<String> = scene.diagnostics.iter().map(ToString::to_string).collect();
    assert!(said.iter().any(|said| said.contains("/dev/zero")), "{said:?}");
}
