//! `[[scene]]` in `exercise.toml`: a test scene of a teacher's own, which changes one of the checker's.
//!
//! ```toml
//! [[scene]]
//! name = "low sun"
//! like = "stretched"               # the scene that it changes; the first one if it is left out
//! light_pos = [3.0, 0.2, 1.0]      # in the world
//! ambient = 0.1
//! diffuse = 0.9
//! specular = 0.4
//! attenuation = [1.0, 0.1, 0.05]   # k_c, k_l, k_q
//! material = [0.8, 0.3, 0.2]       # linear RGB
//! shininess = 20.0
//! roughness = 0.3
//! refraction_index = 1.5
//! eye = [0.0, 1.0, 3.0]            # in the world
//! target = [0.0, 0.0, 0.0]
//! up = [0.0, 1.0, 0.0]
//! fov_y_deg = 40.0
//! ```

use glam::Vec3;
use gonio_check::picture_judge::SceneFamily;
use gonio_check::testbench::TestScene;
use gonio_scene::toml_table::{Fault, TableReader, nearest_word};

/// Most scenes of an exercise.
const MOST_SCENES: usize = 32;

/// Reads all scenes.
pub(super) fn read_scenes(t: &mut TableReader<'_>, family: SceneFamily) -> Result<Vec<TestScene>, Fault> {
    let known = family.scenes();
    let mut scenes: Vec<TestScene> = Vec::new();
    for mut table in t.tables("scene")? {
        let scene = read_scene(&mut table, &known)?;
        let place = table.place("name");
        if known.iter().chain(&scenes).any(|other| other.name == scene.name) {
            return Err(Fault::at(&place, format!("`name`: there is a scene `{}` already", scene.name)));
        }
        if scenes.len() == MOST_SCENES {
            return Err(Fault::at(&table.span, format!("an exercise has at most {MOST_SCENES} scenes of its own")));
        }
        scenes.push(scene);
    }
    Ok(scenes)
}

fn read_scene(t: &mut TableReader<'_>, known: &[TestScene]) -> Result<TestScene, Fault> {
    let name = t.text("name")?.filter(|name| !name.trim().is_empty());
    let name = name.ok_or_else(|| Fault::at(&t.span, "[[scene]] has no `name`"))?;
    if name.ends_with(" alone") {
        return Err(Fault::at(
            &t.place("name"),
            "`name`: names that end with \"alone\" belong to scenes with one term",
        ));
    }
    let like = t.text("like")?;
    let base = match &like {
        None => known.first(),
        Some(like) => known.iter().find(|scene| scene.name == *like),
    };
    let Some(base) = base else {
        let like = like.unwrap_or_default();
        let names = || known.iter().map(|scene| scene.name.as_str());
        let meant = nearest_word(&like, names()).map_or(String::new(), |word| format!("; did you mean `{word}`?"));
        let message =
            format!("`like`: there is no scene `{like}`, expected {}{meant}", names().collect::<Vec<_>>().join(", "));
        return Err(Fault::at(&t.place("like"), message));
    };
    let mut scene = TestScene { name, shows: "check-scene-of-course", ..base.clone() };
    for (key, place) in [
        ("light_pos", &mut scene.light.position),
        ("material", &mut scene.material),
        ("eye", &mut scene.eye),
        ("target", &mut scene.target),
        ("up", &mut scene.up),
    ] {
        if let Some(vector) = t.vector(key)? {
            *place = Vec3::from_array(vector.map(|number| number as f32));
            if !place.is_finite() {
                return Err(Fault::at(&t.place(key), format!("`{key}`: expected finite numbers")));
            }
        }
    }
    if let Some(attenuation) = t.vector("attenuation")? {
        scene.light.attenuation = attenuation.map(|number| number as f32);
        if attenuation.iter().any(|k| !(0.0..=1e6).contains(k)) || attenuation.iter().sum::<f64>() <= 0.0 {
            let message = "`attenuation`: expected k_c, k_l and k_q of at least 0, not all of them 0";
            return Err(Fault::at(&t.place("attenuation"), message));
        }
    }
    for (key, place, range) in [
        ("ambient", &mut scene.light.ambient, 0.0..=1.0),
        ("diffuse", &mut scene.light.diffuse, 0.0..=1.0),
        ("specular", &mut scene.light.specular, 0.0..=1.0),
        ("shininess", &mut scene.shininess, 1.0..=1000.0),
        ("roughness", &mut scene.roughness, 0.01..=1.0),
        ("refraction_index", &mut scene.refraction_index, 1.0..=4.0),
    ] {
        if let Some(number) = t.number(key)? {
            if !range.contains(&number) {
                let message =
                    format!("`{key}`: expected a number from {} to {}, found {number}", range.start(), range.end());
                return Err(Fault::at(&t.place(key), message));
            }
            *place = number as f32;
        }
    }
    if let Some(degrees) = t.number("fov_y_deg")? {
        if !(1.0..=170.0).contains(&degrees) {
            let message = format!("`fov_y_deg`: expected a number from 1 to 170, found {degrees}");
            return Err(Fault::at(&t.place("fov_y_deg"), message));
        }
        scene.fov_y_rad = degrees.to_radians() as f32;
    }
    t.finish()?;
    let ahead = scene.target - scene.eye;
    if ahead.length() < 1e-4 || ahead.cross(scene.up).length() < 1e-4 {
        let message = format!(
            "the camera of `{}` looks nowhere: eye and target are the same, or up is parallel to them",
            scene.name
        );
        return Err(Fault::at(&t.span, message));
    }
    Ok(scene)
}
