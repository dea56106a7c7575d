//! Messages, the JSON Schema, and detection of what a file is.

use crate::{Memory, TRIANGLE};
use gonio_mesh::Limits;
use gonio_scene::load::{describe, load};
use gonio_scene::toml_file::read;
use gonio_scene::{SceneFile, inspect};
use serde_json::{Value, json};
use std::path::Path;

const OBJECT: &str = "[[object]]\nmodel = \"builtin:cube\"\n";

/// `text` after a valid object (two lines) gives exactly this message.
#[track_caller]
fn check_message(text: &str, expected: &str) {
    let whole = format!("{OBJECT}{text}");
    match read(&whole) {
        Err(error) => assert_eq!(error.to_string(), expected, "{whole}"),
        Ok(_) => panic!("no error in {whole}"),
    }
}

#[test]
fn unknown_keys_suggest_the_nearest_known_one() {
    check_message(
        "[[light]]\nkind = \"ambient\"\ncolr = [1, 1, 1]\n",
        "5:1: unknown key `colr` in [[light]]; did you mean `color`? Known keys: kind, name, enabled, position, \
         direction, radius, size, color, spectrum, intensity, constant, linear, quadratic, inner_angle, outer_angle, motion",
    );
    check_message(
        "[lights]\n",
        "3:2: unknown key `lights` in a scene; did you mean `light`? Known keys: picture, camera, background, \
         environment, equation, object, light",
    );
    check_message(
        "[picture]\n  xyzzy = 3\n",
        "4:3: unknown key `xyzzy` in [picture]. Known keys: width, height, samples, color, tone_map, exposure, \
         texture_filter",
    );
    check_message(
        "[object.material]\nshinyness = 3\n",
        "4:1: unknown key `shinyness` in [object.material]; did you mean `shininess`? Known keys: ambient, diffuse, \
         diffuse_spectrum, specular, emitted, shininess, refraction_index, opacity, textures, medium, reflectivity, \
         transmission, fresnel, tint, absorption, brdf, brdf_file, dispersion, surfaces",
    );
}

#[test]
fn wrong_types_name_the_key() {
    check_message("[camera]\nfov_y = \"wide\"\n", "4:9: `fov_y`: expected a number, found a string");
    check_message(
        "[camera]\nposition = [1, 2]\n",
        "4:12: `position`: expected three numbers [x, y, z], found a list of 2",
    );
    check_message(
        "[camera]\nposition = [1, 2, 3, 4]\n",
        "4:12: `position`: expected three numbers [x, y, z], found a list of 4",
    );
    check_message(
        "[camera]\nposition = [1, \"2\", 3]\n",
        "4:16: `position`: expected three numbers [x, y, z], found a string among them",
    );
    check_message("[picture]\nwidth = 10.5\n", "4:9: `width`: expected a whole number of at least 0, found 10.5");
    check_message("[picture]\nwidth = -1\n", "4:9: `width`: expected a whole number of at least 0, found -1");
    check_message("[equation]\ngated = 1\n", "4:9: `gated`: expected true or false, found a number");
    check_message("[[object]]\nmodel = 3\n", "4:9: `model`: expected a string, found a number");
    let whole = read("camera = 3\n[[object]]\nmodel = \"builtin:cube\"\n").unwrap_err();
    assert_eq!(whole.to_string(), "1:10: [camera]: expected a table, found a number");
    let whole = read("[object]\nmodel = \"builtin:cube\"\n").unwrap_err();
    assert_eq!(whole.to_string(), "1:1: `object` is a list of tables: write [[object]] with two brackets");
}

#[test]
fn words_and_colours() {
    check_message(
        "shading = \"gouraut\"\n",
        "3:11: `shading`: invalid shading `gouraut`: expected one of flat, flat-per-face, gouraud, phong; did you mean \
         `gouraud`?",
    );
    check_message(
        "[equation]\nconvention = \"xyzzy\"\n",
        "4:14: `convention`: invalid convention `xyzzy`: expected one of lab, physical",
    );
    check_message(
        "[background]\ntop = \"#12345\"\n",
        "4:7: `top`: invalid colour `#12345`: expected #rrggbb (sRGB), r,g,b (linear) or one linear number",
    );
    check_message(
        "[background]\ntop = 1\n",
        "4:7: `top`: expected a colour, [r, g, b] in linear light or \"#rrggbb\" in sRGB, found a number",
    );
    check_message(
        "[background]\ntop = [1, -1, 0]\n",
        "4:7: `top` is a colour: its numbers must be finite and not negative",
    );
}

#[test]
fn values_out_of_range() {
    check_message("[camera]\nfov_y = 180\n", "4:9: `fov_y` must be greater than 0 and less than 180 degrees, not 180");
    check_message("[camera]\nnear = 0\n", "4:8: `near` must be greater than 0 and finite, not 0");
    check_message(
        "[camera]\nnear = 2\nfar = 1\n",
        "5:7: `far` must be greater than `near`, but 1 is not greater than 2",
    );
    check_message(
        "[camera]\nposition = [nan, 0, 0]\n",
        "4:12: `position` must have finite numbers, not [NaN, 0.0, 0.0]",
    );
    check_message("[camera]\nup = [0, 0, 0]\n", "4:6: `up` is a direction and must not be zero");
    check_message(
        "[camera]\nposition = [1, 1, 1]\ntarget = [1, 1, 1]\n",
        "5:10: the camera's `target` is its `position`; it must look somewhere",
    );
    check_message(
        "[camera]\ntarget = [1, 1, 1]\npitch = 3\n",
        "5:9: the camera has both `target` and `pitch`; it looks at a target or along yaw and pitch",
    );
    check_message("[picture]\nwidth = 16385\n", "4:9: `width` of the picture must be 1 to 16384 pixels, not 16385");
    check_message(
        "[picture]\nwidth = 16384\nheight = 16384\n",
        "4:9: a picture of 16384x16384 is too large; at most 67108864 pixels",
    );
    check_message("[picture]\nsamples = 3\n", "4:11: `samples` must be 1, 2, 4, 8 or 16, not 3");
    check_message("[picture]\nexposure = inf\n", "4:12: `exposure` must be -64 to 64 stops, not inf");
    check_message(
        "scale = [1, 0, 1]\n",
        "3:9: `scale` must not be 0 along any axis; a flat model has no inside to light",
    );
    check_message("material = { shininess = 0.5 }\n", "3:26: `shininess` must be 1 to 1000000, not 0.5");
    check_message("[[object]]\nname = \"x\"\n", "3:1: this object needs `model`, a file or `builtin:NAME`");
    assert!(read("").unwrap_err().to_string().starts_with("1:1: the scene has no object; add [[object]]"));
}

#[test]
fn lights_take_the_keys_of_their_kind() {
    check_message(
        "[[light]]\nkind = \"ambient\"\nposition = [0, 0, 0]\n",
        "5:12: `position` does not belong to an ambient light; it takes kind, name, color, intensity",
    );
    check_message(
        "[[light]]\nkind = \"directional\"\ndirection = [0, -1, 0]\nlinear = 1\n",
        "6:10: `linear` does not belong to a directional light; it takes kind, name, direction, color, intensity",
    );
    check_message(
        "[[light]]\nposition = [0, 0, 0]\n",
        "3:1: this light needs `kind`, one of ambient, directional, point, spot, rectangle",
    );
    check_message("[[light]]\nkind = \"point\"\n", "3:1: this point light needs `position`");
    check_message(
        "[[light]]\nkind = \"spot\"\nposition = [0, 0, 0]\n",
        "3:1: this spot light needs `direction`, the way its light travels",
    );
    let spot = "[[light]]\nkind = \"spot\"\nposition = [0, 0, 0]\ndirection = [0, -1, 0]\n";
    check_message(
        &format!("{spot}inner_angle = 40\nouter_angle = 30\n"),
        "7:15: `inner_angle` must not be greater than `outer_angle`, but 40 is greater than 30",
    );
    check_message(
        &format!("{spot}outer_angle = 91\n"),
        "7:15: `outer_angle` must be 0 to 90 degrees (half of the cone), not 91",
    );
    check_message(&format!("{spot}intensity = -1\n"), "7:13: `intensity` must be finite and not negative, not -1");
    check_message(&format!("{spot}radius = -1\n"), "7:10: `radius` must be 0 or more world units, not -1");
    check_message(
        &format!("{spot}size = [1, 1]\n"),
        "7:8: `size` does not belong to a spot light; it takes kind, name, position, direction, radius, color, \
         intensity, constant, linear, quadratic, inner_angle, outer_angle, motion",
    );
    let rectangle = "[[light]]\nkind = \"rectangle\"\nposition = [0, 0, 0]\n";
    check_message(rectangle, "3:1: this rectangle light needs `direction`, the way its light travels");
    let rectangle = format!("{rectangle}direction = [0, -1, 0]\n");
    check_message(
        &format!("{rectangle}radius = 1\n"),
        "7:10: `radius` does not belong to a rectangle light; it takes kind, name, position, direction, size, color, \
         intensity, constant, linear, quadratic, motion",
    );
    check_message(
        &format!("{rectangle}size = [1, 0]\n"),
        "7:8: `size` must be two lengths greater than 0, the rectangle's width and height, not [1.0, 0.0]",
    );
    check_message(
        &format!("{rectangle}size = 2\n"),
        "7:8: `size`: expected two numbers [width, height], found a number",
    );
    let fault = read(&format!("{OBJECT}{spot}constant = 0\n")).unwrap_err().to_string();
    assert!(fault.starts_with("7:12: one of `constant`, `linear` and `quadratic` must be greater"), "{fault}");
}

#[test]
fn motions_take_the_keys_of_their_kind() {
    let point = "[[light]]\nkind = \"point\"\nposition = [0, 0, 0]\n[light.motion]\n";
    check_message(&format!("{point}period = 2\n"), "6:1: this motion needs `kind`, one of oscillate, circle, path");
    check_message(&format!("{point}kind = \"circle\"\n"), "6:1: this motion needs `period`, in seconds");
    check_message(&format!("{point}kind = \"circle\"\nperiod = 2\n"), "6:1: the motion `circle` needs `center`");
    check_message(
        &format!("{point}kind = \"oscillate\"\nperiod = 0\namplitude = [0, 0, 1]\n"),
        "8:10: `period` must be greater than 0, in seconds, not 0",
    );
    check_message(
        &format!("{point}kind = \"oscillate\"\nperiod = 1\ncenter = [0, 0, 1]\n"),
        "9:10: `center` does not belong to the motion `oscillate`; it takes kind, period, amplitude",
    );
    check_message(
        &format!("{point}kind = \"path\"\nperiod = 1\npoints = [[0, 0, 0], [inf, 0, 1]]\n"),
        "9:22: `points` must have finite numbers, not [inf, 0.0, 1.0]",
    );
    check_message(
        &format!("{point}kind = \"path\"\nperiod = 1\npoints = [[1, 0, 0], [0, 0, 1]]\n"),
        "5:12: a light on a path starts at the first of `points`; leave `position` out or make it the same",
    );
}

#[test]
fn spectra_rise_and_replace_a_colour() {
    let lamp = "[[light]]\nkind = \"ambient\"\n";
    let both = "[[light]]\nkind = \"ambient\"\ncolor = [1, 1, 1]\n";
    let lights: [(&str, &str, &str); 8] = [
        (lamp, "[[500, 1], [500, 2]]", "5:23: `spectrum` must have rising wavelengths, but 500 follows 500"),
        (lamp, "[[299, 1]]", "5:13: `spectrum` must have wavelengths of 300 to 1000 nm, not 299"),
        (lamp, "[[500, -1]]", "5:13: `spectrum` must have values of 0 to 1000000000, not -1"),
        (lamp, "[[500, nan]]", "5:13: `spectrum` must have values of 0 to 1000000000, not NaN"),
        (lamp, "[[400, 0], [500, 0]]", "5:12: `spectrum` must have a value greater than 0"),
        (
            lamp,
            "[[800, 1], [900, 1]]",
            "5:12: `spectrum` must have visible light: power between 380 and 780 nm at two wavelengths or more",
        ),
        (lamp, "[500, 1]", "5:13: `spectrum`: expected two numbers [wavelength in nm, value], found a number"),
        (both, "[[400, 1], [500, 1]]", "6:12: the light has both `color` and `spectrum`; leave one of them out"),
    ];
    for (light, spectrum, expected) in lights {
        check_message(&format!("{light}spectrum = {spectrum}\n"), expected);
    }
    check_message(
        "[object.material]\ndiffuse_spectrum = [[400, 0.5], [500, 1.5]]\n",
        "4:33: `diffuse_spectrum` must have values of 0 to 1, not 1.5",
    );
    check_message(
        "[object.material]\ndiffuse = [1, 1, 1]\ndiffuse_spectrum = [[400, 0.5], [500, 1]]\n",
        "5:20: the material has both `diffuse` and `diffuse_spectrum`; leave one of them out",
    );
}

#[test]
fn objects_move_like_lights() {
    check_message("[object.motion]\nperiod = 2\n", "3:1: this motion needs `kind`, one of oscillate, circle, path");
    check_message(
        "motion = { kind = \"circle\", period = 0, center = [0, 0, 0] }\n",
        "3:38: `period` must be greater than 0, in seconds, not 0",
    );
    check_message(
        "translate = [1, 0, 0]\nmotion = { kind = \"path\", period = 1, points = [[0, 0, 1]] }\n",
        "3:13: an object on a path starts at the first of `points`; leave `translate` out or make it the same",
    );
}

#[test]
fn errors_of_toml_have_a_place() {
    let error = read("[camera]\nfov_y = = 3\n").unwrap_err();
    assert_eq!((error.place.line, error.place.column.is_some()), (Some(2), true));
    assert!(error.message.starts_with("this is not TOML: "), "{error}");
    let error = read("[camera]\nfov_y = 3\nfov_y = 3\n").unwrap_err();
    assert_eq!(error.place.line, Some(3), "{error}");
}

#[test]
fn columns_are_bytes_and_a_byte_order_mark_is_none() {
    check_message("name = \"\u{e9}\" # \u{e9}\nmaterial = { opacity = 2 }\n", "4:24: `opacity` must be 0 to 1, not 2");
    let error = read("\u{feff}[picture]\nwidth = 0\n").unwrap_err();
    assert_eq!((error.place.line, error.place.column), (Some(2), Some(9)));
}

#[test]
fn the_committed_schema_is_current() {
    let committed: Value = serde_json::from_str(include_str!("../../../../assets/scene.schema.json")).unwrap();
    assert!(
        committed == SceneFile::json_schema(),
        "assets/scene.schema.json is out of date: cargo run -p gonio -- scene --schema -o assets/scene.schema.json"
    );
}

/// Enough of JSON Schema for ours: type, properties, additionalProperties, required, items, enum, const,
/// oneOf, anyOf, allOf, $ref, minimum, minItems, maxItems, pattern (only the colour's).
fn valid(root: &Value, schema: &Value, value: &Value) -> bool {
    let Some(rules) = schema.as_object() else { return schema != &json!(false) };
    rules.iter().all(|(rule, wants)| match rule.as_str() {
        "$ref" => {
            let pointer = wants.as_str().unwrap().strip_prefix('#').unwrap();
            valid(root, root.pointer(pointer).unwrap(), value)
        }
        "type" => match wants {
            Value::Array(types) => types.iter().any(|t| is_of(value, t.as_str().unwrap())),
            one => is_of(value, one.as_str().unwrap()),
        },
        "enum" => wants.as_array().unwrap().contains(value),
        "const" => wants == value,
        "oneOf" => wants.as_array().unwrap().iter().filter(|s| valid(root, s, value)).count() == 1,
        "anyOf" => wants.as_array().unwrap().iter().any(|s| valid(root, s, value)),
        "allOf" => wants.as_array().unwrap().iter().all(|s| valid(root, s, value)),
        "properties" => {
            value.as_object().is_none_or(|o| o.iter().all(|(k, v)| wants.get(k).is_none_or(|s| valid(root, s, v))))
        }
        "additionalProperties" => value
            .as_object()
            .is_none_or(|o| wants != &json!(false) || o.keys().all(|k| schema["properties"].get(k).is_some())),
        "required" => value
            .as_object()
            .is_none_or(|o| wants.as_array().unwrap().iter().all(|k| o.contains_key(k.as_str().unwrap()))),
        "items" => value.as_array().is_none_or(|a| a.iter().all(|v| valid(root, wants, v))),
        "minimum" => value.as_f64().is_none_or(|v| v >= wants.as_f64().unwrap()),
        "maximum" => value.as_f64().is_none_or(|v| v <= wants.as_f64().unwrap()),
        "minItems" => value.as_array().is_none_or(|a| a.len() as u64 >= wants.as_u64().unwrap()),
        "maxItems" => value.as_array().is_none_or(|a| a.len() as u64 <= wants.as_u64().unwrap()),
        "pattern" => value.as_str().is_none_or(|s| {
            assert_eq!(wants, "^#([0-9a-fA-F]{3}|[0-9a-fA-F]{6})$");
            let digits = s.strip_prefix('#').unwrap_or("-");
            [3, 6].contains(&digits.len()) && digits.chars().all(|c| c.is_ascii_hexdigit())
        }),
        "$schema" | "title" | "description" | "default" | "format" | "definitions" => true,
        other => panic!("the schema has a rule that this test does not know: {other}"),
    })
}

fn is_of(value: &Value, kind: &str) -> bool {
    match kind {
        "object" => value.is_object(),
        "array" => value.is_array(),
        "string" => value.is_string(),
        "boolean" => value.is_boolean(),
        "null" => value.is_null(),
        "number" => value.is_number(),
        "integer" => value.is_u64() || value.is_i64(),
        other => panic!("{other}"),
    }
}

fn valid_toml(text: &str) -> bool {
    let schema = SceneFile::json_schema();
    let value = serde_json::to_value(toml::from_str::<toml::Table>(text).unwrap()).unwrap();
    valid(&schema, &schema, &value)
}

#[test]
fn it_accepts_the_shipped_scenes_and_refuses_wrong_ones() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../assets/scenes");
    let mut seen = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let text = std::fs::read_to_string(&path).unwrap();
        assert!(valid_toml(&text), "{}", path.display());
        let stem = path.file_stem().unwrap().to_string_lossy().into_owned();
        assert_eq!(gonio_scene::files::builtin(&stem), Some(text.as_bytes()), "every shipped scene is built in");
        seen += 1;
    }
    assert!(seen >= 4);
    let object = "[[object]]\nmodel = \"builtin:cube\"\n";
    assert!(valid_toml(object));
    for right in [
        "[environment]\nimage = \"sky\"\nlayout = \"photographic\"\nsize = 64\nrotate = [1, 2, 3]\nintensity = 2\n",
        "[environment]\nimage = \"a.hdr\"\nlight = true\nvisible = false\nblur = 0.5\nbackground = \"b\"\n",
        "[object.material]\nmedium = \"glass\"\nreflectivity = 1\ntransmission = 0.5\nfresnel = \"schlick\"\n",
        "[object.material]\ntint = \"#fff\"\nabsorption = [0, 1, 2]\ndispersion = 0.02\nsurfaces = \"two\"\n",
    ] {
        let text = if right.starts_with("[object") { format!("{object}{right}") } else { format!("{right}{object}") };
        assert!(valid_toml(&text), "{text}");
        gonio_scene::toml_file::read(&text).unwrap();
    }
    for wrong in [
        "[camera]\nfov = 3\n",
        "[camera]\nfov_y = \"wide\"\n",
        "[camera]\nposition = [1, 2]\n",
        "[background]\ntop = \"red\"\n",
        "[background]\ntop = [-1, 0, 0]\n",
        "[equation]\nspecular = \"blin\"\n",
        "[[light]]\nposition = [0, 0, 0]\n",
        "[picture]\nwidth = 2.5\n",
        "[environment]\nimage = 3\n",
        "[environment]\nlayout = \"direct3d\"\n",
        "[environment]\nrotate = [1, 2]\n",
        "[environment]\nsize = 1.5\n",
        "[environment]\nenvironment = \"sky\"\n",
        "[object.material]\nmedium = \"honey\"\n",
        "[object.material]\nsurfaces = 2\n",
    ] {
        assert!(!valid_toml(&format!("{object}{wrong}")), "{wrong}");
    }
}

/// A triangle whose `asset` is its last key, behind more than the first kilobytes.
fn gltf() -> String {
    let nodes = r#"{"name": "asset", "translation": [1, 2, 3]}, "#.repeat(500);
    format!(
        r#"{{"scene": 0, "scenes": [{{"nodes": [500]}}], "nodes": [{nodes}{{"mesh": 0}}],
        "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}}}]}}],
        "buffers": [{{"byteLength": 36, "uri": "data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}}],
        "bufferViews": [{{"buffer": 0, "byteLength": 36}}],
        "accessors": [{{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3}}],
        "asset": {{"version": "2.0"}}}}"#
    )
}

fn collada() -> String {
    let comment = "-".repeat(5000).replace("--", "- ");
    format!(
        r##"<?xml version="1.0"?><!-- {comment} --><COLLADA version="1.4.1"><library_geometries><geometry id="g"><mesh>
        <source id="s"><float_array id="a">0 0 0 1 0 0 1 1 0</float_array><technique_common>
        <accessor source="#a" stride="3"/></technique_common></source>
        <vertices id="v"><input semantic="POSITION" source="#s"/></vertices>
        <triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
        </mesh></geometry></library_geometries><library_visual_scenes><visual_scene id="w">
        <node><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
        <scene><instance_visual_scene url="#w"/></scene></COLLADA>"##
    )
}

fn utf_16(text: &str) -> Vec<u8> {
    format!("\u{feff}{text}").encode_utf16().flat_map(u16::to_le_bytes).collect()
}

#[test]
fn an_inspected_model_can_be_described_and_loaded() {
    let obj = format!("{}{TRIANGLE}", "# a comment\n".repeat(1000));
    for text in [gltf(), collada(), obj] {
        for content in [text.clone().into_bytes(), utf_16(&text)] {
            for name in ["a.gltf", "a.dae", "a.obj", "a.json", "a.txt", "-", "a"] {
                let files = Memory::default().with(name, content.clone());
                let inspected = inspect::inspect(name, &files, &Limits::default()).unwrap();
                assert_eq!(inspected.geometry.triangles, 1, "{name}");
                let scene = load(describe(&[name], &files).unwrap(), Path::new(""), &files).unwrap();
                assert_eq!(scene.settings.objects[0].model, name);
            }
        }
    }
}

/// The name decides what the content leaves open, for describing as for inspecting.
#[test]
fn errors_come_from_the_reader_of_the_extension() {
    for (name, content) in [("a.gltf", "{\"a\": 1}"), ("a.ply", "hello"), ("a.dae", "<?xml version='1.0'?>")] {
        let files = Memory::default().with(name, content);
        let inspected = inspect::inspect(name, &files, &Limits::default()).err().unwrap().to_string();
        let loaded = load(describe(&[name], &files).unwrap(), Path::new(""), &files).err().unwrap().to_string();
        assert_eq!(loaded, inspected);
    }
}

#[test]
fn scene_files_may_be_utf_16() {
    let text = "# ж\n[[object]]\nmodel = \"builtin:cube\"\nname = \"Würfel\"\n";
    for name in ["s.toml", "s", "-"] {
        let files = Memory::default().with(name, utf_16(text));
        assert_eq!(describe(&[name], &files).unwrap().objects[0].model, "builtin:cube", "{name}");
    }
    let wrong = utf_16("# ж\n[camera]\nfov_y = 200\n");
    let error = describe(&["s.toml"], &Memory::default().with("s.toml", wrong)).unwrap_err().to_string();
    assert_eq!(error, "s.toml:3:9: `fov_y` must be greater than 0 and less than 180 degrees, not 200");
    let mut damaged = utf_16("[camera]\n# ");
    damaged.extend([0x00, 0xD8]);
    let error = describe(&["s.toml"], &Memory::default().with("s.toml", damaged)).unwrap_err().to_string();
    assert_eq!(error, "s.toml:2:3: a scene file must be UTF-8 or UTF-16 text, and this file is neither");
}
