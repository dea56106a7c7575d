//! The files of the exercises; a test holds that none is missing.

type Folder = (&'static str, &'static [(&'static str, &'static str)]);

macro_rules! folder {
    ($folder:literal: $($name:literal)*) => {
        ($folder, &[$(($name, include_str!(concat!("../../../../exercises/", $folder, "/", $name)))),*])
    };
}

/// Folders and their files, in order.
pub const FOLDERS: &[Folder] = &[
    folder!("ex01-camera": "camera.svg" "exercise.toml" "reference.frag" "reference.vert" "start.frag" "start.vert" "text.md"),
    folder!("ex02-object-reader": "exercise.toml" "models/bracket.obj" "models/cube.obj" "models/fence.obj" "models/gem.obj" "models/house.obj" "models/objects.obj" "models/pyramid.obj" "models/tent.obj" "models/wedge.obj" "reference/obj_reader.cpp" "reference/obj_reader.py" "start/obj_reader.cpp" "start/obj_reader.py" "text.md"),
    folder!("ex03-gouraud-diffuse": "exercise.toml" "normal.svg" "reference.frag" "reference.vert" "start.frag" "start.vert" "text.md"),
    folder!("ex04-phong-diffuse": "exercise.toml" "gouraud-and-phong.svg" "reference.frag" "reference.vert" "start.frag" "start.vert" "text.md"),
    folder!("ex05-gouraud-specular": "exercise.toml" "reference.frag" "reference.vert" "start.frag" "start.vert" "text.md" "vectors.svg"),
    folder!("ex06-phong-specular": "exercise.toml" "highlight.svg" "reference.frag" "reference.vert" "start.frag" "start.vert" "text.md"),
    folder!("ex07-light-equation": "attenuation.svg" "exercise.toml" "reference.frag" "reference.vert" "start.frag" "start.vert" "text.md"),
    folder!("ex08-skybox": "exercise.toml" "reference.frag" "reference.vert" "start.frag" "start.vert" "text.md"),
    folder!("ex09-reflection": "exercise.toml" "reference.frag" "reference.vert" "reflection.svg" "start.frag" "start.vert" "text.md"),
    folder!("ex10-refraction": "exercise.toml" "reference.frag" "reference.vert" "refraction.svg" "start.frag" "start.vert" "text.md"),
    folder!("ex11-texture-unit": "exercise.toml" "host/attribute-not-enabled.txt" "host/mipmaps-missing.txt" "host/offset-wrong.txt" "host/reference.txt" "host/stride-wrong.txt" "host/texture-name-as-unit.txt" "host/unbound-unit.txt" "host/uniform-before-use-program.txt" "host/wrong-target.txt" "start.frag" "start.vert" "text.md" "texture-units.svg"),
    folder!("s1-panorama-to-cubemap": "exercise.toml" "faces.svg" "reference.frag" "reference.vert" "start.frag" "start.vert" "text.md"),
];

/// Pictures: the folder, the name, the file.
pub const PICTURES: &[(&str, &str, &[u8])] = &[(
    "s1-panorama-to-cubemap",
    "panorama.png",
    include_bytes!("../../../../exercises/s1-panorama-to-cubemap/panorama.png"),
)];
