//! Options as JSON, laid over a scene file: the same keys, the same words, the same limits.

use crate::error::Failure;
use gonio_scene::SceneFile;
use gonio_scene::nearest_word;
use gonio_scene::scene_file::{EnvironmentSpec, LightSpec, MaterialOverride, ObjectSpec};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};

/// The tables of a scene file.
const TABLES: [&str; 5] = ["picture", "camera", "background", "environment", "equation"];
/// The keys of objects, which options set on all of them.
const OF_OBJECTS: [&str; 6] = ["shading", "normals", "crease_angle", "up", "material", "parts"];

/// Replaces values of `file` by those of `options`: tables by their names, `light` as a list, and keys of objects for all objects.
pub fn apply(file: &mut SceneFile, options: Map<String, Value>) -> Result<(), Failure> {
    for (key, value) in options {
        match key.as_str() {
            "picture" => lay_over(&key, &mut file.picture, value)?,
            "background" => lay_over(&key, &mut file.background, value)?,
            "equation" => lay_over(&key, &mut file.equation, value)?,
            "camera" => {
                // A direction is either a target or two angles, and a camera of the file replaces all.
                let has = |name: &str| value.get(name).is_some();
                if has("from_model") {
                    file.camera = Default::default();
                }
                if has("target") {
                    (file.camera.yaw, file.camera.pitch) = (None, None);
                }
                if has("yaw") || has("pitch") {
                    file.camera.target = None;
                }
                lay_over(&key, &mut file.camera, value)?;
            }
            "environment" => environment(&mut file.environment, value)?,
            "light" => file.lights = lights(value)?,
            name if OF_OBJECTS.contains(&name) => {
                for object in &mut file.objects {
                    set_on(object, name, value.clone())?;
                }
            }
            unknown => {
                let known = || TABLES.into_iter().chain(["light"]).chain(OF_OBJECTS);
                let nearest = nearest_word(unknown, known());
                let meant = nearest.map_or(String::new(), |word| format!("; did you mean `{word}`?"));
                let all: Vec<&str> = known().collect();
                return Err(Failure(format!("unknown option `{unknown}`: expected {}{meant}", all.join(", "))));
            }
        }
    }
    Ok(())
}

/// An environment by its name alone, or as a table; `null` removes it.
fn environment(place: &mut Option<EnvironmentSpec>, value: Value) -> Result<(), Failure> {
    match value {
        Value::Null => *place = None,
        Value::String(image) => *place = Some(EnvironmentSpec { image, ..EnvironmentSpec::default() }),
        table => {
            let mut spec = place.take().unwrap_or_default();
            lay_over("environment", &mut spec, table)?;
            *place = Some(spec);
        }
    }
    Ok(())
}

/// Lights as tables, or as the texts of `--light`.
fn lights(value: Value) -> Result<Vec<LightSpec>, Failure> {
    let list = match value {
        Value::Array(list) => list,
        one => vec![one],
    };
    let one = |(index, value): (usize, Value)| match value {
        Value::String(text) => LightSpec::from_option_text(&text).map_err(Failure),
        table => serde_json::from_value(table).map_err(|error| Failure(format!("light {index}: {error}"))),
    };
    list.into_iter().enumerate().map(one).collect()
}

/// Sets one key of an object. Of materials only the values that are given are replaced.
fn set_on(object: &mut ObjectSpec, key: &str, value: Value) -> Result<(), Failure> {
    if key == "material" {
        let material = match value {
            Value::String(text) => MaterialOverride::from_option_text(&text).map_err(Failure)?,
            table => serde_json::from_value(table).map_err(|error| Failure(format!("material: {error}")))?,
        };
        object.material.replace_by(&material);
        return Ok(());
    }
    let table = Value::Object([(key.to_owned(), value)].into_iter().collect());
    lay_over("", object, table)
}

/// Replaces those values of `place` that `value`, a table, has.
fn lay_over<T: Serialize + DeserializeOwned>(name: &str, place: &mut T, value: Value) -> Result<(), Failure> {
    let prefix = if name.is_empty() { String::new() } else { format!("{name}: ") };
    let Value::Object(new) = value else {
        return Err(Failure(format!("{prefix}expected a dict of its values, as in a scene file")));
    };
    let whole = serde_json::to_value(&*place).map_err(Failure::new)?;
    let Value::Object(mut whole) = whole else {
        return Err(Failure(format!("{prefix}cannot be changed; this is a bug in gonio, please report it")));
    };
    whole.extend(new);
    *place = serde_json::from_value(Value::Object(whole)).map_err(|error| Failure(format!("{prefix}{error}")))?;
    Ok(())
}
