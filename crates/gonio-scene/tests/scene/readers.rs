//! The readers of the page's first picture give the scene that all readers give.

use crate::Memory;
use gonio_mesh::Limits;
use gonio_scene::files::builtin;
use gonio_scene::readers::{Readers, decoded_picture};
use gonio_scene::scene_file::ObjectSpec;
use gonio_scene::{Scene, SceneFile, Texture, load};
use std::path::Path;

const MODEL: &str = "m/still_life.obj";

/// The first scene of window and page, with its files beside it; textures through `picture`.
fn loaded(readers: &Readers, picture: impl Fn(&[u8]) -> Vec<u8>) -> Scene {
    let file = |name: &str| builtin(&format!("models/{name}")).unwrap();
    let mut files =
        Memory::default().with(MODEL, file("still_life.obj")).with("m/still_life.mtl", file("still_life.mtl"));
    for name in ["checker.png", "planks.png"] {
        files = files.with(&format!("m/textures/{name}"), picture(file(&format!("textures/{name}"))));
    }
    let object = ObjectSpec { model: MODEL.to_owned(), ..ObjectSpec::default() };
    let scene = SceneFile { objects: vec![object], ..SceneFile::default() };
    load::load_by(readers, scene, Path::new(""), &files, &Limits::default()).unwrap()
}

#[test]
fn the_first_scene_is_the_same_by_the_readers_for_obj() {
    let texels = |bytes: &[u8]| {
        let texture = Texture::decode("png", bytes).unwrap();
        decoded_picture(texture.width, texture.height, &texture.rgba)
    };
    let (all, obj) = (loaded(Readers::ALL, <[u8]>::to_vec), loaded(Readers::OBJ, texels));
    assert_eq!(all.settings, obj.settings);
    assert_eq!(all.meshes, obj.meshes);
    assert_eq!(all.materials, obj.materials);
    assert!(all.textures.len() == 2 && all.textures == obj.textures);
    assert_eq!(all.diagnostics, obj.diagnostics);
}

#[test]
fn a_picture_that_is_not_decoded_is_left_out_with_a_warning() {
    let scene = loaded(Readers::OBJ, <[u8]>::to_vec);
    assert!(scene.textures.is_empty());
    assert_eq!(scene.diagnostics.iter().filter(|d| d.message.contains("is used without it")).count(), 2);
}
