//! Limits of what a scene may make the reader do, and input that is refused.

use crate::{Memory, TRIANGLE, png};
use gonio_mesh::{Cause, Limits, ReadError};
use gonio_scene::Scene;
use gonio_scene::environment_file::{self, EnvironmentReadOptions};
use gonio_scene::files::{Budgeted, BuiltinOnly, Disk, FileRefusal, FileSource, Sandbox};
use gonio_scene::load::{describe, load, load_within};
use std::path::Path;

fn loaded(input: &str, files: &dyn FileSource, max_bytes: u64) -> Result<Scene, ReadError> {
    let limits = Limits { max_bytes, ..Limits::default() };
    load_within(describe(&[input], files)?, Path::new(""), files, &limits)
}

fn warnings(scene: &Scene) -> String {
    scene.diagnostics.iter().map(|d| d.to_string() + "\n").collect()
}

/// A model with one texture, and how many bytes everything is: read, and decoded.
fn textured() -> (Memory, u64, u64) {
    let library = "newmtl m\nmap_Kd a.png\n";
    let picture = png(8, 8, |_, _| [9; 4]);
    let read = (TRIANGLE.len() + library.len() + picture.len()) as u64;
    (Memory::default().with("t.obj", TRIANGLE).with("t.mtl", library).with("a.png", picture), read, 8 * 8 * 4)
}

#[test]
fn everything_that_is_read_for_an_input_counts() {
    let (files, read, decoded) = textured();
    let scene = loaded("t.obj", &files, read + decoded).unwrap();
    assert!(scene.materials[0].maps.diffuse.is_some(), "{}", warnings(&scene));
    // One byte too few for the pixels.
    let scene = loaded("t.obj", &files, read + decoded - 1).unwrap();
    assert!(scene.materials[0].maps.diffuse.is_none());
    let messages = warnings(&scene);
    assert!(
        messages.contains("the textures together would take more than allowed: this one needs 256 bytes"),
        "{messages}"
    );
    // One byte too few for the texture's file.
    let scene = loaded("t.obj", &files, read - 1).unwrap();
    let messages = warnings(&scene);
    assert!(scene.materials[0].maps.diffuse.is_none());
    assert!(messages.contains("the texture `a.png` was not read: `a.png` needs"), "{messages}");
    // The material library does not fit: no model comes of it, since another thread might have left more.
    let error = loaded("t.obj", &files, TRIANGLE.len() as u64 + 5).unwrap_err();
    assert_eq!((error.place.file.as_deref(), error.cause), (Some("t.mtl"), Some(Cause::MemoryLimit)));
    assert!(error.message.contains("it needs 22 bytes of memory, but only 5 bytes of the limit of "), "{error}");
    let error = loaded("t.obj", &files, 10).unwrap_err();
    assert_eq!((error.place.file.as_deref(), error.cause), (Some("t.obj"), Some(Cause::MemoryLimit)));
}

#[test]
fn several_models_share_one_budget() {
    let files = Memory::default().with("a.obj", TRIANGLE).with("b.obj", TRIANGLE).with("t.mtl", "newmtl m\n");
    let load = |max_bytes| {
        let limits = Limits { max_bytes, ..Limits::default() };
        load_within(describe(&["a.obj", "b.obj"], &files).unwrap(), Path::new(""), &files, &limits)
    };
    let both = 2 * TRIANGLE.len() as u64 + 9;
    assert!(load(both).is_ok());
    let error = load(both - 1).unwrap_err();
    assert_eq!(error.cause, Some(Cause::MemoryLimit));
}

#[test]
fn one_buffer_under_many_names_counts_each_time() {
    // Each name is another spelling of the same file, and the reader keeps a copy of each.
    let names: Vec<String> = (0..40).map(|i| format!("{}b.bin", "./".repeat(i))).collect();
    let list = |of: &dyn Fn(usize, &String) -> String| {
        names.iter().enumerate().map(|(i, name)| of(i, name)).collect::<Vec<_>>().join(",")
    };
    let buffers = list(&|_, name| format!(r#"{{"uri":"{name}","byteLength":5000}}"#));
    let views = list(&|i, _| format!(r#"{{"buffer":{i},"byteLength":36}}"#));
    let accessors = list(&|i, _| format!(r#"{{"bufferView":{i},"componentType":5126,"count":3,"type":"VEC3"}}"#));
    let meshes = list(&|i, _| format!(r#"{{"primitives":[{{"attributes":{{"POSITION":{i}}}}}]}}"#));
    let nodes = list(&|i, _| format!(r#"{{"mesh":{i}}}"#));
    let model = format!(
        r#"{{"asset":{{"version":"2.0"}},"buffers":[{buffers}],"bufferViews":[{views}],"accessors":[{accessors}],
            "meshes":[{meshes}],"nodes":[{nodes}]}}"#
    );
    let mut buffer: Vec<u8> = [0.0f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0].map(f32::to_le_bytes).concat();
    buffer.resize(5000, 0);
    let mut files = Memory::default().with("m.gltf", model.clone());
    for name in &names {
        files = files.with(name, buffer.clone());
    }
    let all = model.len() as u64 + 40 * 5000;
    assert!(loaded("m.gltf", &files, all).is_ok());
    assert_eq!(loaded("m.gltf", &files, all - 1).unwrap_err().cause, Some(Cause::MemoryLimit));
}

#[test]
fn pixels_of_an_environment_count() {
    let faces = ["posx", "negx", "posy", "negy", "posz", "negz"];
    let mut files = Memory::default();
    let mut read = 0;
    for face in faces {
        let picture = png(16, 16, |_, _| [9, 9, 9, 255]);
        read += picture.len() as u64;
        files = files.with(&format!("faces/{face}.png"), picture);
    }
    let open = |max_bytes| {
        let limits = Limits { max_bytes, ..Limits::default() };
        environment_file::open("faces", EnvironmentReadOptions::default(), Path::new(""), &files, &limits)
    };
    let decoded = 6 * 16 * 16 * 16;
    assert_eq!(open(read + decoded).err(), None);
    assert!(open(read + decoded - 1).is_err(), "the files and their pixels together are too much");
    assert!(open(decoded - 1).is_err());
}

#[test]
fn an_input_is_described_within_the_budget_too() {
    let (files, ..) = textured();
    let few = Budgeted::new(&files, 20);
    let error = describe(&["t.obj"], &few).unwrap_err();
    assert_eq!((error.place.file.as_deref(), error.cause), (Some("t.obj"), Some(Cause::MemoryLimit)));
}

/// Folders with an input, and a secret beside them.
struct Confined {
    folder: tempfile::TempDir,
}

impl Confined {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        std::fs::create_dir_all(folder.path().join("in/deep")).unwrap();
        let confined = Confined { folder };
        confined.write("secret.mtl", "newmtl m\nKd 1 0 0\n");
        confined.write("in/deep/t.mtl", "newmtl m\nKd 0 1 0\n");
        confined
    }

    fn write(&self, name: &str, text: &str) {
        std::fs::write(self.folder.path().join(name), text).unwrap();
    }

    fn path(&self, name: &str) -> String {
        self.folder.path().join(name).display().to_string()
    }

    /// The diffuse colour of the model `in/m.obj` with this library, and the diagnostics.
    fn load(&self, library: &str) -> ([f32; 3], String) {
        self.write("in/m.obj", &format!("mtllib {library}\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
        let input = self.path("in/m.obj");
        let files = Sandbox::new(Disk, [input.as_str()]);
        let scene = loaded(&input, &files, 1 << 20).unwrap();
        (scene.materials[0].material.diffuse, warnings(&scene))
    }
}

#[test]
fn a_sandbox_keeps_a_model_in_its_folder() {
    let confined = Confined::new();
    const GREEN: [f32; 3] = [0.0, 1.0, 0.0];
    let absolute = confined.path("secret.mtl");
    for inside in ["deep/t.mtl", "./deep/../deep/t.mtl", "DEEP/T.mtl", "../in/deep/t.mtl"] {
        assert_eq!(confined.load(inside).0, GREEN, "{inside}");
    }
    for outside in ["../secret.mtl", "deep/../../secret.mtl", absolute.as_str(), "../SECRET.mtl", "..\\secret.mtl"] {
        let (diffuse, messages) = confined.load(outside);
        assert!(diffuse[0] != 1.0 || diffuse[1] != 0.0, "{outside} was read");
        assert!(
            messages.contains("is outside the folder of the input, and the sandbox forbids"),
            "{outside}: {messages}"
        );
    }
    // The message does not reveal whether the file exists.
    let (_, messages) = confined.load("../none.mtl");
    assert!(messages.contains("../none.mtl` is outside the folder"), "{messages}");
    let (_, messages) = confined.load("none.mtl");
    assert!(messages.contains("was not found") && !messages.contains("sandbox"), "{messages}");
}

#[cfg(unix)]
#[test]
fn a_sandbox_does_not_follow_links_out_of_it() {
    let confined = Confined::new();
    let link = |to: &str, name: &str| std::os::unix::fs::symlink(to, confined.path(name)).unwrap();
    link("../secret.mtl", "in/relative.mtl");
    link(&confined.path("secret.mtl"), "in/absolute.mtl");
    link("..", "in/up");
    link("deep/t.mtl", "in/within.mtl");
    link("../not-there.mtl", "in/dangling.mtl");
    assert_eq!(confined.load("within.mtl").0, [0.0, 1.0, 0.0]);
    for outside in ["relative.mtl", "absolute.mtl", "up/secret.mtl", "up/up/secret.mtl", "dangling.mtl"] {
        let (diffuse, messages) = confined.load(outside);
        assert!(diffuse != [1.0, 0.0, 0.0], "{outside} was read");
        assert!(messages.contains("the sandbox forbids"), "{outside}: {messages}");
    }
}

#[test]
fn a_scene_in_a_sandbox_cannot_name_models_and_environments_outside() {
    let confined = Confined::new();
    confined.write("other.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    for text in [
        "[[object]]\nmodel = \"../other.obj\"\n",
        "[[object]]\nmodel = \"builtin:cube\"\n[environment]\nimage = \"../other.hdr\"\n",
    ] {
        confined.write("in/s.toml", text);
        let input = confined.path("in/s.toml");
        let error = loaded(&input, &Sandbox::new(Disk, [input.as_str()]), 1 << 20).unwrap_err();
        assert_eq!(error.cause, Some(Cause::Sandbox), "{error}");
        assert!(error.place.file.as_deref().is_some_and(|file| file.contains("other.")), "{error}");
    }
    // The user may name both.
    let inputs = [confined.path("in/m.obj"), confined.path("other.obj")];
    confined.write("in/m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let files = Sandbox::new(Disk, inputs.iter().map(String::as_str));
    assert!(describe(&[&inputs[0], &inputs[1]], &files).is_ok());
}

#[cfg(target_os = "linux")]
#[test]
fn files_without_an_end_are_refused() {
    for (path, refusal) in [
        ("/dev/zero", FileRefusal::Device),
        ("/proc/self/pagemap", FileRefusal::Generated),
        ("/proc/self/environ", FileRefusal::Generated),
    ] {
        let error = Disk.read_within(Path::new(path), u64::MAX).err().unwrap();
        assert_eq!(FileRefusal::in_error(&error), Some(&refusal), "{path}");
    }
}

/// If a pipe were opened, this would never end: nobody writes to it.
#[cfg(unix)]
#[test]
fn pipes_and_sockets_are_refused_without_waiting() {
    let folder = tempfile::tempdir().unwrap();
    let pipe = folder.path().join("pipe");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let socket = folder.path().join("socket");
    let _listener = std::os::unix::net::UnixListener::bind(&socket).unwrap();
    let link = folder.path().join("link");
    std::os::unix::fs::symlink("pipe", &link).unwrap();
    for (path, refusal) in [(&pipe, FileRefusal::Pipe), (&link, FileRefusal::Pipe), (&socket, FileRefusal::Socket)] {
        let error = Disk.read_within(path, u64::MAX).err().unwrap();
        assert_eq!(FileRefusal::in_error(&error), Some(&refusal), "{path:?}");
    }
}

#[test]
fn a_file_is_read_to_its_limit_and_no_further() {
    let folder = tempfile::tempdir().unwrap();
    for size in [0_u64, 1, 1000, (1 << 16) - 1, 1 << 16, 100_000] {
        let path = folder.path().join(size.to_string());
        std::fs::write(&path, vec![7; size as usize]).unwrap();
        assert_eq!(Disk.read_within(&path, size).unwrap().len() as u64, size);
        if size > 0 {
            let error = Disk.read_within(&path, size - 1).err().unwrap();
            assert!(
                matches!(FileRefusal::in_error(&error), Some(FileRefusal::OverLimit(over)) if over.needed == Some(size)),
                "{error}"
            );
        }
    }
}

#[track_caller]
fn describe_says(name: &str, bytes: &[u8], expected: &str) {
    let files = Memory::default().with(name, bytes);
    let error = describe(&[name], &files).unwrap_err().to_string();
    assert_eq!(error, expected);
}

const READABLE: &str = "models (.obj .gltf .glb .dae .ply .stl .mesh .meshb, also .gz and .zst) and scene files (.toml) \
                        can be read";

#[test]
fn unsupported_files_are_named() {
    describe_says("a.obj", b"", &format!("a.obj: the file is empty; {READABLE}"));
    describe_says("a.txt", b"hello\n", &format!("a.txt: unknown format of this .txt file; {READABLE}"));
    describe_says("a.dat", b"\x01\x02\0\0\0", &format!("a.dat: unknown binary format; {READABLE}"));
    describe_says("a.obj", b"\x7fELF\0\0\0", &format!("a.obj: this is a program; {READABLE}"));
    describe_says("a.obj", b"\x89PNG\r\n", &format!("a.obj: this is a PNG image; {READABLE}"));
    describe_says("a.glb", b"{\"a\": {}}", &format!("a.glb: this is a JSON file that is not glTF; {READABLE}"));
    describe_says("a.dae", b"<html>", &format!("a.dae: this is an XML or HTML file; {READABLE}"));
}

/// A model's format is detected by its content, whatever its name.
#[test]
fn the_kind_of_a_file_is_detected_by_its_content_first() {
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
fn missing_files() {
    let missing = describe(&["no/such.obj"], &Disk).unwrap_err().to_string();
    assert!(missing.starts_with("no/such.obj: there is no such file; check the path"), "{missing}");
    let folder = describe(&["src"], &Disk).unwrap_err().to_string();
    assert_eq!(folder, "src: this is a folder; name a file in it");
    let unknown = describe(&["builtin:suzane"], &BuiltinOnly).unwrap_err().to_string();
    assert!(unknown.starts_with("builtin:suzane: unknown built-in file: expected one of "), "{unknown}");
    assert!(unknown.ends_with("; did you mean `builtin:suzanne`?"), "{unknown}");
    assert!(describe(&[], &Disk).is_err());
}

#[test]
fn errors_in_a_scene_name_file_line_and_column() {
    let files = Memory::default().with("dir/s.toml", "[camera]\nfov_y = 200\n[[object]]\nmodel = \"m.obj\"\n");
    let error = describe(&["dir/s.toml"], &files).unwrap_err().to_string();
    assert_eq!(error, "dir/s.toml:2:9: `fov_y` must be greater than 0 and less than 180 degrees, not 200");
    let files = Memory::default().with("s.toml", b"[camera]\n# \xff\n".to_vec());
    let error = describe(&["s.toml"], &files).unwrap_err().to_string();
    assert_eq!(error, "s.toml:2:3: a scene file must be UTF-8 text, and this file is not");
}

#[test]
fn models_of_a_scene_are_relative_to_it() {
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
    let messages: Vec<String> = scene.diagnostics.iter().map(ToString::to_string).collect();
    assert!(messages.iter().any(|message| message.contains("/dev/zero")), "{messages:?}");
}
