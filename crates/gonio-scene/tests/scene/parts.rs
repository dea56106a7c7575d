//! Materials of single parts: in scene files, as options, and edited.

use crate::Memory;
use gonio_scene::color_value::Color;
use gonio_scene::edit::{Edited, apply};
use gonio_scene::load::load;
use gonio_scene::part_material::PartMaterial;
use gonio_scene::scene_file::{MaterialOverride, ObjectSpec};
use gonio_scene::{Scene, SceneFile};
use std::path::Path;

/// A cup with a golden rim, and a saucer of the cup's glaze.
const MODEL: &str = "mtllib t.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\n\
                     o Cup\nusemtl Glaze\nf 1/1/1 2/2/1 3/3/1\nusemtl Gold\nf 1/1/1 3/3/1 2/2/1\n\
                     o Saucer\nusemtl Glaze\nf 2/2/1 3/3/1 1/1/1\n";
const MTL: &str = "newmtl Glaze\nKd 0.5 0.6 0.7\nmap_Kd wood.png\nNs 20\nnewmtl Gold\nKd 0.8 0.6 0.1\nNs 90\n";

fn loaded(text: &str) -> Scene {
    let picture = crate::png(2, 2, |x, y| [90, 100 * x as u8, 100 * y as u8, 255]);
    let files = Memory::default().with("t.obj", MODEL).with("t.mtl", MTL).with("wood.png", picture);
    load(gonio_scene::toml_file::read(text).unwrap(), Path::new(""), &files).unwrap()
}

/// The shininess of each part of the first object.
fn shininess(scene: &Scene) -> Vec<f32> {
    scene.objects[0].parts.iter().map(|part| scene.materials[part.material].material.shininess).collect()
}

#[test]
fn a_part_has_its_own_values_by_each_of_its_names() {
    let scene = loaded("[[object]]\nmodel = \"t.obj\"\n");
    assert_eq!(shininess(&scene), [20.0, 90.0, 20.0]);
    assert_eq!([0, 1, 2].map(|part| scene.part_name(0, part)), ["Cup/Glaze", "Gold", "Saucer"]);
    for (name, expected) in [
        ("Glaze", [5.0, 90.0, 5.0]),
        ("Cup", [5.0, 5.0, 20.0]),
        ("Saucer", [20.0, 90.0, 5.0]),
        ("\"Cup/Gold\"", [20.0, 5.0, 20.0]),
    ] {
        let scene = loaded(&format!("[[object]]\nmodel = \"t.obj\"\n[object.parts.{name}]\nshininess = 5\n"));
        assert_eq!(shininess(&scene), expected, "{name}");
        assert!(scene.diagnostics.is_empty(), "{:?}", scene.diagnostics);
    }
}

#[test]
fn a_part_keeps_the_values_of_the_object_and_the_textures_that_it_does_not_replace() {
    let scene = loaded(
        "[[object]]\nmodel = \"t.obj\"\nmaterial = { shininess = 3, opacity = 0.5 }\n\
         parts.Saucer.shininess = 7\nparts.Gold.diffuse = [1, 0, 0]\n",
    );
    let of_part = |part: usize| &scene.materials[scene.objects[0].parts[part].material];
    assert_eq!(shininess(&scene), [3.0, 3.0, 7.0]);
    assert!((0..3).all(|part| of_part(part).material.opacity == 0.5));
    assert!(of_part(2).maps.diffuse.is_some() && of_part(1).maps.diffuse.is_none());
    assert_eq!(of_part(1).material.diffuse, [1.0, 0.0, 0.0]);
    // What the file says is still known.
    assert_eq!(scene.part_material_in_file(0, 1).map(|material| material.diffuse), Some([0.8, 0.6, 0.1]));
}

#[test]
fn parts_survive_the_round_trip_and_an_edit_without_files() {
    let text =
        "[[object]]\nmodel = \"t.obj\"\nparts.\"Cup/Glaze\".brdf = \"ggx:alpha=0.3\"\nparts.Gold.shininess = 8\n";
    let before = loaded(text);
    let file = SceneFile::from(&before.settings);
    assert_eq!(gonio_scene::toml_file::read(&file.to_toml_string()).unwrap(), file);
    assert_eq!(file.objects[0].parts.len(), 2);
    let mut settings = before.settings.clone();
    let red = MaterialOverride { diffuse: Some(Color([1.0, 0.0, 0.0])), ..MaterialOverride::default() };
    settings.objects[0].parts.insert("Saucer".to_owned(), red);
    let Edited::Done(edited) = apply(&before, settings).unwrap() else { panic!("it needs files") };
    assert!(edited.materials_changed);
    let of_part = |part: usize| &edited.loaded.materials[edited.loaded.objects[0].parts[part].material];
    assert!(of_part(0).brdf.is_some() && of_part(1).brdf.is_none() && of_part(2).brdf.is_none());
    assert_eq!(of_part(2).material.diffuse, [1.0, 0.0, 0.0]);
    assert_eq!(of_part(1).material.shininess, 8.0);
}

#[test]
fn an_unknown_part_is_named_with_the_known_ones() {
    let scene = loaded("[[object]]\nmodel = \"t.obj\"\nparts.Sauce.shininess = 5\n");
    let warnings: Vec<&str> = scene.diagnostics.iter().map(|d| d.message.as_str()).collect();
    assert_eq!(
        warnings,
        ["no part and no material is named `Sauce`; did you mean `Saucer`? There are Cup, Glaze, Gold, Saucer"]
    );
    // Of two objects, one is enough.
    let both = "[[object]]\nmodel = \"t.obj\"\nparts.Gold.shininess = 5\n\
                [[object]]\nmodel = \"builtin:cube\"\nparts.Gold.shininess = 5\n";
    assert!(loaded(both).diagnostics.is_empty());
}

#[test]
fn errors_in_a_part_say_where() {
    let error = |text: &str| gonio_scene::toml_file::read(text).unwrap_err();
    let unknown = error("[[object]]\nmodel = \"t.obj\"\n[object.parts.Cup]\nshinyness = 5\n");
    let place = unknown.place.clone();
    assert_eq!((place.line, place.column), (Some(4), Some(1)), "{unknown}");
    assert!(unknown.message.starts_with("unknown key `shinyness` in [object.parts.Cup]; did you mean `shininess`?"));
    let number = error("[[object]]\nmodel = \"t.obj\"\nparts.Cup = 5\n");
    assert_eq!(number.message, "[object.parts.Cup]: expected a table, found a number");
    let range = error("[[object]]\nmodel = \"t.obj\"\nparts.Cup.opacity = 5\n");
    assert_eq!(range.place.line, Some(3), "{range}");
}

#[test]
fn an_option_names_the_part_before_the_values() {
    let read = |text: &str| PartMaterial::from_option_text(text).map(|part| (part.part, part.material));
    let shiny = MaterialOverride { shininess: Some(8.0), ..MaterialOverride::default() };
    assert_eq!(read("Cup:shininess=8"), Ok(("Cup".to_owned(), shiny.clone())));
    assert_eq!(read("a:b:shininess=8"), Ok(("a:b".to_owned(), shiny)));
    let (part, glass) = read("Cup/Glaze:glass").unwrap();
    assert!(part == "Cup/Glaze" && glass.medium.is_some());
    let (_, model) = read("Cup:brdf=ggx:alpha=0.3").unwrap();
    assert_eq!(model.brdf.as_deref(), Some("ggx:alpha=0.3"));
    for text in ["shininess=8", ":shininess=8", "Cup", "Cup:"] {
        let error = read(text).unwrap_err();
        assert!(error.starts_with(&format!("`{text}`")), "{text}: {error}");
    }
    let spec = ObjectSpec { model: "t.obj".into(), ..ObjectSpec::default() };
    assert_eq!(spec.materials().count(), 1);
}
