//! A printed scene, read again, is the same scene: to the last bit.

use gonio_scene::SceneFile;
use gonio_scene::files::{BuiltinOnly, builtin, builtin_names};
use gonio_scene::load::{describe, load};
use gonio_scene::toml_file;
use std::path::Path;

fn same_again(scene: SceneFile) {
    let first = load(scene, Path::new(""), &BuiltinOnly).unwrap();
    let whole = SceneFile::from(&first.settings);
    let text = whole.to_toml_string();
    let read = toml_file::read(&text).unwrap_or_else(|e| panic!("{e}\n{text}"));
    assert_eq!(read, whole, "{text}");
    let second = load(read, Path::new(""), &BuiltinOnly).unwrap();
    assert_eq!(second.settings, first.settings, "{text}");
    for time in [0.0, 0.3, 12345.678] {
        assert_eq!(second.frame(time), first.frame(time), "{text}");
    }
    assert_eq!((&second.meshes, &second.textures), (&first.meshes, &first.textures));
    let objects = |scene: &gonio_scene::Scene| {
        scene.objects.iter().map(|o| (o.world_from_model, o.parts.clone(), o.closed)).collect::<Vec<_>>()
    };
    assert_eq!(objects(&second), objects(&first));
    // Serde's own reader, which other programs will use, agrees with ours.
    assert_eq!(toml::from_str::<SceneFile>(&text).unwrap(), whole);
}

#[test]
fn every_builtin_scene_and_model() {
    let names = builtin_names();
    assert!(names.len() >= 10, "{names:?}");
    for name in names {
        assert!(builtin(&name).is_some());
        same_again(describe(&[format!("builtin:{name}").as_str()], &BuiltinOnly).unwrap());
    }
}

#[test]
fn a_scene_with_everything_in_it() {
    let text = r##"
        [picture]
        width = 321
        height = 123
        samples = 16
        color = "direct"
        tone_map = "agx"
        exposure = -0.1
        texture_filter = "linear"
        [camera]
        yaw = 33.3
        pitch = -12.7
        fov_y = 77.7
        [background]
        top = "#123456"
        bottom = [0.1, 0.2, 0.30000000000000004]
        transparent = true
        [equation]
        convention = "physical"
        specular = "phong"
        brdf = "lafortune"
        brdf_normalised = true
        lafortune = [0.1, 0.2, -0.3]
        gated = false
        two_sided = false
        ambient = false
        [[object]]
        model = "builtin:still-life"
        name = "a \"name\" with \\ and é"
        up = "-z"
        translate = [0.1, 1e-9, 123456.789]
        rotate = [1, 2, 3]
        scale = [-1, 2.5, 0.333]
        shading = "flat-per-face"
        normals = "averaged"
        material = { ambient = "#fff", diffuse = [0.1, 0.2, 0.3], specular = "#010203", emitted = [0, 0, 9], shininess = 7.7, refraction_index = 1.33, opacity = 0.3, textures = false, brdf = "ggx:alpha=0.2" }
        [object.motion]
        kind = "circle"
        period = 0.7
        center = [0.1, 0.2, 0.3]
        [[object]]
        model = "builtin:cube"
        motion = { kind = "path", period = 3, points = [[0.1, 0.2, 0.3], [3, 2, 1]] }
        material = { diffuse_spectrum = [[400, 0.1], [700, 0.6]] }
        [[light]]
        kind = "spot"
        position = [1, 2, 3]
        direction = [0.1, -0.7, 0.3]
        color = "#ff8800"
        intensity = 0.1
        constant = 0
        linear = 0.3
        quadratic = 0.7
        inner_angle = 33
        radius = 0.3
        [[light]]
        kind = "rectangle"
        position = [0.3, 2, 0.1]
        direction = [0.1, -1, 0.2]
        size = [0.7, 0.1]
        spectrum = [[400, 0.1], [500, 0.30000000000000004], [700, 0.7]]
        motion = { kind = "oscillate", period = 2, amplitude = [1, 0, 0.1] }
        [[light]]
        kind = "point"
        motion = { kind = "path", period = 3, points = [[0.1, 0.2, 0.3], [3, 2, 1]] }
        [[light]]
        kind = "point"
        position = [1, 1, 1]
        motion = { kind = "circle", period = 0.7, center = [0.1, 0.1, 0.1] }
        [[light]]
        kind = "directional"
        direction = [0.3, -0.3, 0.1]
        [[light]]
        kind = "ambient"
        name = "sky"
    "##;
    same_again(toml_file::read(text).unwrap());
}
