//! The JSON Schema that editors check scene files with.

use gonio_scene::SceneFile;
use serde_json::{Value, json};

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
        gonio_scene::toml_reader::read(&text).unwrap();
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
