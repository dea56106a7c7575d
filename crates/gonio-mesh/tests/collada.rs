//! COLLADA: small documents with their expected results, effects one by one, lights, cameras, hostile files.

#![allow(clippy::unwrap_used, missing_docs)]

#[path = "collada/hostile.rs"]
mod hostile;
#[path = "collada/summary.rs"]
mod summary;

use gonio_fixtures::assert_as_expected;
use gonio_mesh::{AmbientRule, Channel, Limits, Material, Model, ModelLightKind, NoSidecars, ReadError, Wrap, collada};
use summary::{cases, check, files, numbers};

fn read(bytes: &[u8]) -> Result<Model, ReadError> {
    collada::read(bytes, &mut NoSidecars, &Limits::default())
}

fn documents() -> Vec<(String, Vec<u8>)> {
    files(cases("collada.txt", "dae", 63))
}

fn document(name: &str) -> Model {
    let (_, bytes) = documents().into_iter().find(|(known, _)| known == name).unwrap();
    read(&bytes).unwrap()
}

#[test]
fn every_file_has_its_expected_result() {
    assert_as_expected(cases("collada.txt", "dae", 63), |case| summary::summary(&read(&case.bytes)));
}

#[test]
fn every_prefix_is_survived() {
    let mut refused = 0;
    for (name, bytes) in documents() {
        // A prefix is no document; that is quick to find, but not for 5,000 prefixes of 5,000 bytes each.
        let step = 1 + bytes.len() / 1500;
        for length in (0..bytes.len()).step_by(step) {
            match read(&bytes[..length]) {
                Ok(model) => {
                    check(&model);
                    let rest = bytes[length..].trim_ascii();
                    assert!(rest.is_empty() || name == "byte_order_mark.dae", "{name} of {length} bytes was read");
                }
                Err(_) => refused += 1,
            }
        }
    }
    assert!(refused > 20_000, "{refused}");
}

#[test]
fn every_changed_byte_is_survived() {
    let (mut read_well, mut refused) = (0, 0);
    for (_, bytes) in documents().into_iter().filter(|(_, bytes)| bytes.len() < 1500) {
        for at in 0..bytes.len() {
            for byte in *b"<&9-\"\xFF" {
                let mut changed = bytes.clone();
                changed[at] = byte;
                match read(&changed) {
                    Ok(model) => {
                        check(&model);
                        read_well += 1;
                    }
                    Err(_) => refused += 1,
                }
            }
        }
    }
    assert!(read_well > 20_000 && refused > 20_000, "{read_well} {refused}");
}

/// A triangle with one material, whose effect is given; `images` stand in their library.
fn with_effect(images: &str, profile: &str) -> String {
    format!(
        r##"<COLLADA version="1.4.1">
<library_images>{images}</library_images>
<library_materials><material id="m" name="M"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g"><mesh>
<source id="s"><float_array id="a">0 0 0 1 0 0 1 1 0</float_array><technique_common><accessor source="#a" stride="3"/></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#s"/></vertices>
<triangles material="x"><input semantic="VERTEX" source="#v" offset="0"/><input semantic="TEXCOORD" source="#s" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="scene"><node><instance_geometry url="#g"><bind_material><technique_common>
<instance_material symbol="x" target="#m"/></technique_common></bind_material></instance_geometry></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#scene"/></scene>
<library_effects><effect id="e"><profile_COMMON>
{profile}
</profile_COMMON></effect></library_effects>
</COLLADA>"##
    )
}

/// The material of an effect whose shader has this content, and the messages.
fn material(shader: &str, content: &str) -> (Material, Vec<String>) {
    const PARAMETERS: &str = r#"<newparam sid="pic"><sampler2D><source>surface</source></sampler2D></newparam>
<newparam sid="surface"><surface type="2D"><init_from>image</init_from></surface></newparam>
<newparam sid="shade"><float4>0.1 0.2 0.3 1</float4></newparam><newparam sid="amount"><float>0.5</float></newparam>"#;
    let profile = format!("{PARAMETERS}<technique sid=\"t\">\n<{shader}>\n{content}\n</{shader}></technique>");
    let text = with_effect(r#"<image id="image"><init_from>a.png</init_from></image>"#, &profile);
    let mut model = read(text.as_bytes()).unwrap();
    (model.materials.remove(0), model.diagnostics.iter().map(ToString::to_string).collect())
}

fn quiet(shader: &str, content: &str) -> Material {
    let (material, messages) = material(shader, content);
    assert_eq!(messages, [""; 0], "{content}");
    material
}

#[test]
fn every_value_of_an_effect_arrives() {
    let found = quiet(
        "phong",
        "<emission><color>0.1 0.2 0.3 1</color></emission><ambient><color>0.4 0.5 0.6 1</color></ambient>\n\
         <diffuse><color>0.7 0.8 0.9 1</color></diffuse><specular><color>0.25 0.5 0.75 1</color></specular>\n\
         <shininess><float>50</float></shininess><index_of_refraction><float>1.33</float></index_of_refraction>\n\
         <transparent opaque=\"A_ONE\"><color>1 1 1 0.5</color></transparent><transparency><float>0.5</float></transparency>\n\
         <reflective><color>1 0 0 1</color></reflective><reflectivity><float>0.75</float></reflectivity>",
    );
    assert_eq!((found.name.as_str(), found.ambient), ("M", AmbientRule::Value([0.4, 0.5, 0.6])));
    assert_eq!((found.emitted, found.diffuse, found.specular), ([0.1, 0.2, 0.3], [0.7, 0.8, 0.9], [0.25, 0.5, 0.75]));
    assert_eq!((found.shininess, found.refraction_index, found.opacity), (50.0, 1.33, 0.25));
    let sources: Vec<(&str, u64, &str)> =
        found.sources.iter().map(|s| (s.property, s.line.unwrap(), s.written.as_str())).collect();
    // The shader's content begins on line 17.
    let expected = [
        ("ambient", 17, "<ambient> 0.4 0.5 0.6 1"),
        ("diffuse", 18, "<diffuse> 0.7 0.8 0.9 1"),
        ("specular", 18, "<specular> 0.25 0.5 0.75 1"),
        ("emitted", 17, "<emission> 0.1 0.2 0.3 1"),
        ("shininess", 19, "<shininess> 50"),
        ("refraction_index", 19, "<index_of_refraction> 1.33"),
        ("opacity", 20, "<transparent> 1 1 1 0.5, <transparency> 0.5"),
    ];
    assert_eq!(sources, expected);
    assert_eq!(found.sources[6].rule, "A_ONE");
    let unused: Vec<(&str, &str)> = found.unused.iter().map(|s| (s.property, s.written.as_str())).collect();
    assert_eq!(unused, [("reflective", "<reflective> 1 0 0 1"), ("reflectivity", "<reflectivity> 0.75")]);
}

#[test]
fn defaults_are_documented() {
    let lambert = quiet("lambert", "");
    assert_eq!((lambert.ambient, lambert.diffuse), (AmbientRule::FollowsDiffuse, [0.8; 3]));
    assert_eq!((lambert.specular, lambert.emitted, lambert.shininess), ([0.0; 3], [0.0; 3], 32.0));
    assert_eq!((lambert.refraction_index, lambert.opacity, lambert.sources.len()), (1.5, 1.0, 0));
    let constant = quiet("constant", "<emission><color>1 2 3</color></emission>");
    assert_eq!((constant.diffuse, constant.emitted), ([0.0; 3], [1.0, 2.0, 3.0]));
}

#[test]
fn the_four_opaque_rules() {
    let opacity = |mode: &str, color: &str, factor: &str| {
        let factor = if factor.is_empty() {
            String::new()
        } else {
            format!("<transparency><float>{factor}</float></transparency>")
        };
        quiet("blinn", &format!("<transparent{mode}><color>{color}</color></transparent>{factor}")).opacity
    };
    assert_eq!(opacity("", "0 0 0 0.25", ""), 0.25);
    assert_eq!(opacity(" opaque=\"A_ONE\"", "0 0 0 1", "0.75"), 0.75);
    assert_eq!(opacity(" opaque=\"A_ZERO\"", "0 0 0 0.5", "0.5"), 0.75);
    assert_eq!(opacity(" opaque=\"A_ZERO\"", "0 0 0 0", "1"), 1.0);
    // The luminance of grey is grey, up to the rounding of the three weights.
    assert!((opacity(" opaque=\"RGB_ZERO\"", "0.25 0.25 0.25 1", "1") - 0.75).abs() < 1e-6);
    assert!((opacity(" opaque=\"RGB_ONE\"", "0 1 0 1", "0.5") - 0.35758).abs() < 1e-6);
    assert_eq!(opacity(" opaque=\"RGB_ONE\"", "1 1 1 1", "1"), 1.0);
    assert_eq!(quiet("phong", "<transparency><float>0.5</float></transparency>").opacity, 0.5);
    assert_eq!(quiet("phong", "<transparency><param ref=\"amount\"/></transparency>").opacity, 0.5);
}

#[test]
fn invisible_materials_become_opaque() {
    let (found, messages) = material("phong", "<transparency><float>0</float></transparency>");
    assert_eq!(found.opacity, 1.0);
    let expected = "17:15: warning: the material \"M\" would be invisible (<transparency> 0, A_ONE): treated as \
         opaque, because programs confuse the two";
    assert_eq!(messages, [expected]);
    let (found, messages) = material("phong", "<transparent opaque=\"RGB_ZERO\"><color>1 1 1 1</color></transparent>");
    assert_eq!((found.opacity, messages.len()), (1.0, 1));
}

#[test]
fn transparent_textures_are_opacity_maps() {
    let map = |mode: &str| {
        let content = format!(
            "<transparent opaque=\"{mode}\"><texture texture=\"pic\" texcoord=\"uv\"/></transparent><transparency><float>0.5</float></transparency>"
        );
        let found = quiet("phong", &content);
        assert_eq!(found.opacity, 1.0);
        found.opacity_map.unwrap().texel
    };
    let of = |mode: &str| (map(mode).channel, map(mode).base, map(mode).gain);
    assert_eq!(of("A_ONE"), (Some(Channel::Alpha), 0.0, 0.5));
    assert_eq!(of("A_ZERO"), (Some(Channel::Alpha), 1.0, -0.5));
    assert_eq!(of("RGB_ONE"), (Some(Channel::Luminance), 0.0, 0.5));
    assert_eq!(of("RGB_ZERO"), (Some(Channel::Luminance), 1.0, -0.5));
}

#[test]
fn small_shininess_is_a_part_of_128() {
    let content = |value: &str| {
        format!("<specular><color>1 1 1 1</color></specular><shininess><float>{value}</float></shininess>")
    };
    let (found, messages) = material("phong", &content("0.5"));
    assert_eq!(found.shininess, 64.0);
    let rule = "between 0 and 1: multiplied by 128";
    assert_eq!(
        messages,
        [format!("17:55: note: the shininess of \"M\" is 0.5, {rule} (some programs write it as a fraction)")]
    );
    assert_eq!(found.sources[1].rule, rule);
    assert_eq!(quiet("phong", &content("1.5")).shininess, 1.5);
    let zero = quiet("phong", &content("0"));
    assert_eq!((zero.shininess, zero.sources[1].rule.as_str()), (1.0, "raised to the minimum of 1"));
    // Without a highlight there is no message.
    assert_eq!(quiet("phong", "<shininess><float>0.001</float></shininess>").shininess, 1.0);
}

#[test]
fn textures_take_the_place_of_colours() {
    let found = quiet(
        "phong",
        "<emission><texture texture=\"pic\" texcoord=\"uv\"/></emission><diffuse><texture texture=\"pic\" texcoord=\"uv\"/></diffuse>\n\
         <ambient><texture texture=\"pic\" texcoord=\"uv\"/></ambient><specular><param ref=\"shade\"/></specular>",
    );
    assert_eq!((found.diffuse, found.emitted, found.specular), ([1.0; 3], [1.0; 3], [0.1, 0.2, 0.3]));
    let (diffuse, emitted) = (found.diffuse_map.unwrap(), found.emitted_map.unwrap());
    assert_eq!((diffuse.path.as_str(), diffuse.line, diffuse.wrap), ("a.png", Some(17), [Wrap::Repeat; 2]));
    assert_eq!((emitted.path.as_str(), found.ambient), ("a.png", AmbientRule::FollowsDiffuse));
    assert_eq!(found.sources[2].written, "<diffuse> texture \"pic\" = \"a.png\"");
}

#[test]
fn textures_that_lead_nowhere_are_reported() {
    let (found, messages) = material("phong", "<diffuse><texture texture=\"nothing\" texcoord=\"uv\"/></diffuse>");
    assert_eq!((found.diffuse_map, found.diffuse), (None, [0.8; 3]));
    assert_eq!(
        messages,
        ["17:10: warning: this texture refers to \"nothing\", which is neither a sampler nor an image: it is ignored"]
    );
    // The picture itself, as old programs write it.
    let found = quiet("phong", "<diffuse><texture texture=\"image\" texcoord=\"uv\"/></diffuse>");
    assert_eq!(found.diffuse_map.unwrap().path, "a.png");
    let (found, messages) = material("phong", "<diffuse><param ref=\"nothing\"/></diffuse>");
    assert_eq!(found.diffuse, [0.8; 3]);
    assert_eq!(
        messages,
        ["17:10: warning: diffuse of \"M\" refers to \"nothing\", which is not a color: it is ignored"]
    );
    let (_, messages) = material(
        "phong",
        "<diffuse><texture texture=\"pic\" texcoord=\"uv\"/></diffuse><specular><texture texture=\"pic\" texcoord=\"uw\"/></specular>",
    );
    assert_eq!(
        messages,
        ["17:68: warning: textures of \"M\" use the texture coordinates \"uv\" and \"uw\": using \"uv\" for all"]
    );
}

#[test]
fn bump_and_normal_maps_of_extras() {
    for (kind, is_normal) in [("bumptype=\"NORMALMAP\"", true), ("bumptype=\"HEIGHTFIELD\"", false), ("", false)] {
        let extra = format!(
            "<extra><technique profile=\"FCOLLADA\"><bump {kind}><texture texture=\"pic\" texcoord=\"uv\"/></bump></technique></extra>"
        );
        let found = quiet("phong", &extra);
        let [taken, other] =
            if is_normal { [found.normal_map, found.bump_map] } else { [found.bump_map, found.normal_map] };
        assert_eq!((taken.unwrap().path.as_str(), other), ("a.png", None));
    }
}

#[test]
fn pictures_in_the_document() {
    for inner in ["<data>89504E47 0d0a</data>", "<init_from><hex format=\"PNG\">89504e470D0A</hex></init_from>"] {
        let image = format!("<image id=\"image\" name=\"inner\">{inner}</image>");
        let profile = "<technique><phong><diffuse><texture texture=\"image\"/></diffuse><emission><texture texture=\"image\"/></emission></phong></technique>";
        let model = read(with_effect(&image, profile).as_bytes()).unwrap();
        assert_eq!(model.images.len(), 1);
        assert_eq!((model.images[0].name.as_str(), model.images[0].bytes.as_slice()), ("inner", &b"\x89PNG\r\n"[..]));
        assert_eq!(model.materials[0].diffuse_map.as_ref().unwrap().embedded, Some(0));
    }
    let image = "<image id=\"image\"><data>8950x</data></image>";
    let model = read(
        with_effect(image, "<technique><phong><diffuse><texture texture=\"image\"/></diffuse></phong></technique>")
            .as_bytes(),
    );
    let messages: Vec<String> = model.unwrap().diagnostics.iter().map(ToString::to_string).collect();
    assert_eq!(messages, ["2:35: warning: the data of this image is not hexadecimal: it is ignored"]);
}

#[test]
fn materials_without_an_effect_are_the_default_one() {
    let model = read(with_effect("", "<technique/>").as_bytes()).unwrap();
    assert_eq!(model.materials, [Material { name: "M".to_owned(), ..Material::default() }]);
    let messages: Vec<String> = model.diagnostics.iter().map(ToString::to_string).collect();
    let expected =
        "12:18: warning: the material \"M\" has no readable profile_COMMON effect: using the default material";
    assert_eq!(messages, [expected]);
}

#[test]
fn blenders_light_and_camera() {
    let model = document("blender.dae");
    let [light] = model.lights.as_slice() else { panic!("{:?}", model.lights) };
    assert_eq!((light.name.as_str(), light.kind), ("Light", ModelLightKind::Point));
    // Z up to Y up: (1, 2, 3) is (1, 3, -2).
    assert_eq!(light.position, [1.0, 3.0, -2.0]);
    assert_eq!((light.color, light.intensity, light.attenuation), ([1.0, 0.5, 0.25], 1000.0, [1.0, 0.0, 0.00111109]));
    let [camera] = model.cameras.as_slice() else { panic!("{:?}", model.cameras) };
    assert_eq!((camera.name.as_str(), camera.position), ("Camera", [0.0, 5.0, 0.0]));
    // It looks down its -z, which is -y of the model; its y is up there: -z.
    assert_eq!((numbers(&camera.direction), numbers(&camera.up)), ("0 -1 0".to_owned(), "0 0 -1".to_owned()));
    // tan(45 degrees) / 2.
    assert!((camera.fov_y_rad.unwrap() - 2.0 * 0.5_f64.atan()).abs() < 1e-12);
    assert_eq!(camera.clip, [Some(0.1), Some(100.0)]);
    let wood = &model.materials[0];
    assert_eq!(
        (wood.diffuse_map.as_ref().unwrap().path.as_str(), wood.refraction_index),
        ("textures/planks.png", 1.45)
    );
}

#[test]
fn mayas_texture_and_opacity() {
    let model = document("maya.dae");
    let blinn = &model.materials[0];
    let map = blinn.diffuse_map.as_ref().unwrap();
    assert_eq!((map.path.as_str(), map.scale, map.offset), ("C:/My Maps/skin.tga", [2.0, 1.0], [0.0, 0.25]));
    assert_eq!(map.wrap, [Wrap::Mirror, Wrap::Clamp]);
    assert_eq!(blinn.bump_map.as_ref().unwrap().path, "./bumps.tga");
    assert_eq!((blinn.specular, blinn.shininess), ([0.5, 0.4, 0.3], 32.0));
    assert!((blinn.opacity - 0.75).abs() < 1e-6, "{}", blinn.opacity);
    assert_eq!(blinn.ambient, AmbientRule::Value([0.0; 3]));
    let wood = &document("sketchup.dae").materials[0];
    assert_eq!(wood.diffuse_map.as_ref().unwrap().path, "untitled/Wood_Cherry Original.jpg");
}

/// A triangle, and these lights or cameras (`library`) at these nodes, in units of 10 cm.
fn with_nodes(library: &str, nodes: &str) -> Model {
    let text = with_effect("", "<technique><lambert/></technique>");
    let text =
        text.replace("<library_images>", &format!("<asset><unit meter=\"0.1\"/></asset>{library}<library_images>"));
    read(text.replace("<node><instance_geometry", &format!("{nodes}<node><instance_geometry")).as_bytes()).unwrap()
}

#[test]
fn lights_of_every_kind() {
    let library = "<library_lights>\
        <light id=\"a\" name=\"A\"><technique_common><ambient><color>0.1 0.2 0.3</color></ambient></technique_common></light>\
        <light id=\"d\"><technique_common><directional><color>1 1 1</color></directional></technique_common></light>\
        <light id=\"s\"><technique_common><spot><color>0.5 0.5 0.5</color><linear_attenuation>2</linear_attenuation>\
        <quadratic_attenuation>3</quadratic_attenuation><falloff_angle>60</falloff_angle><falloff_exponent>0.25</falloff_exponent>\
        </spot></technique_common></light>\
        <light id=\"w\"><technique_common><spot/></technique_common></light>\
        <light id=\"x\"><technique_common><area/></technique_common></light></library_lights>";
    let all: String = ["a", "d", "s", "w", "x"].iter().map(|id| format!("<instance_light url=\"#{id}\"/>")).collect();
    let nodes = format!("<node><translate>1 2 3</translate><rotate>0 1 0 90</rotate>{all}</node>");
    let model = with_nodes(library, &nodes);
    let [ambient, sun, spot, wide] = model.lights.as_slice() else { panic!("{:?}", model.lights) };
    assert_eq!((ambient.kind, ambient.name.as_str()), (ModelLightKind::Ambient, "A"));
    assert_eq!((ambient.color, ambient.intensity), ([0.1, 0.2, 0.3], 1.0));
    assert_eq!((sun.kind, numbers(&sun.direction)), (ModelLightKind::Directional, "-1 0 0".to_owned()));
    assert_eq!((numbers(&spot.position), numbers(&spot.direction)), ("0.1 0.2 0.3".to_owned(), "-1 0 0".to_owned()));
    let ModelLightKind::Spot { inner_angle_rad, outer_angle_rad } = spot.kind else { panic!("{spot:?}") };
    assert!((outer_angle_rad.to_degrees() - 30.0).abs() < 1e-4 && (inner_angle_rad.to_degrees() - 22.5).abs() < 1e-4);
    // Per metre instead of per 10 cm.
    assert_eq!(numbers(&spot.attenuation), "1 20 300");
    let right_angle = std::f32::consts::FRAC_PI_2;
    assert_eq!(wide.kind, ModelLightKind::Spot { inner_angle_rad: right_angle, outer_angle_rad: right_angle });
    assert_eq!((wide.color, wide.attenuation), ([1.0; 3], [1.0, 0.0, 0.0]));
    let messages: Vec<&str> = model.diagnostics.iter().map(|d| d.message.as_str()).collect();
    assert_eq!(messages, ["the light \"x\" has the unknown type \"area\": it is left out"]);
}

#[test]
fn cameras_of_every_kind() {
    let camera = |id: &str, kind: &str| {
        format!("<camera id=\"{id}\"><optics><technique_common>{kind}</technique_common></optics></camera>")
    };
    let cameras = [
        camera("y", "<perspective><yfov>40</yfov><xfov>90</xfov><znear>2</znear></perspective>"),
        camera("x", "<perspective><xfov>90</xfov></perspective>"),
        camera("o", "<orthographic><xmag>3</xmag></orthographic>"),
        camera("f", "<perspective><yfov>180</yfov></perspective>"),
    ];
    let library = format!("<library_cameras>{}</library_cameras>", cameras.concat());
    let all: String = ["y", "x", "o", "f"].iter().map(|id| format!("<instance_camera url=\"#{id}\"/>")).collect();
    let model =
        with_nodes(&library, &format!("<node><lookat>0 0 10 0 10 10 1 0 0</lookat><scale>1 -5 3</scale>{all}</node>"));
    let [y, x, o] = model.cameras.as_slice() else { panic!("{:?}", model.cameras) };
    assert!((y.fov_y_rad.unwrap().to_degrees() - 40.0).abs() < 1e-9);
    assert_eq!(
        (numbers(&y.position), numbers(&y.direction), numbers(&y.up)),
        ("0 0 1".into(), "0 1 0".into(), "-1 0 0".into())
    );
    assert_eq!(y.clip, [Some(0.2), None]);
    assert!((x.fov_y_rad.unwrap() - 2.0 * (9.0_f64 / 16.0).atan()).abs() < 1e-12);
    assert_eq!(o.fov_y_rad, None);
    let messages: Vec<&str> = model.diagnostics.iter().map(|d| d.message.as_str()).collect();
    let expected = [
        "this camera has an xfov but no aspect_ratio: using 16:9",
        "the camera \"f\" has invalid parameters: it is left out",
    ];
    assert_eq!(messages, expected);
}

/// A document whose scene holds these nodes; `#g` is a triangle.
fn scene(nodes: &str) -> String {
    let text = with_effect("", "<technique><lambert/></technique>");
    let (before, rest) = text.split_once("<visual_scene id=\"scene\">").unwrap();
    let (_, after) = rest.split_once("</visual_scene>").unwrap();
    format!("{before}<visual_scene id=\"scene\">{nodes}</visual_scene>{after}")
}
