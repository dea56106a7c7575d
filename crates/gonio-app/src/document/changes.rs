//! A change of the document in words, for undo and redo.

use super::Document;
use gonio_language::tr;
use gonio_scene::SceneSettings;
use gonio_scene::scene_file::ObjectSpec;
use gonio_scene::settings::LightSettings;

/// Describes the step between two documents as a past participle with its object: "moved key light".
pub fn description(before: &Document, after: &Document) -> String {
    if before.scene != after.scene {
        return of_scenes(&before.scene, &after.scene);
    }
    match (before.panes.list.len(), after.panes.list.len()) {
        (fewer, more) if fewer < more => tr!("window-added-a-pane").to_owned(),
        (more, fewer) if fewer < more => tr!("window-removed-a-pane").to_owned(),
        _ if before.panes.arrangement != after.panes.arrangement => {
            tr!("window-changed-the-arrangement-of-the-panes").to_owned()
        }
        _ => tr!("window-changed-what-a-pane-shows").to_owned(),
    }
}

fn of_scenes(before: &SceneSettings, after: &SceneSettings) -> String {
    let names = |lights: &[LightSettings]| lights.iter().map(|light| light.name.clone()).collect::<Vec<_>>();
    if let Some(change) = of_lists(&names(&before.lights), &names(&after.lights), "window-light-number") {
        return change;
    }
    let names = |objects: &[ObjectSpec]| objects.iter().map(|object| object.name.clone()).collect::<Vec<_>>();
    if let Some(change) = of_lists(&names(&before.objects), &names(&after.objects), "window-object-number") {
        return change;
    }
    let lights = before.lights.iter().zip(&after.lights).enumerate().find(|(_, (before, after))| before != after);
    if let Some((index, (before, after))) = lights {
        return tr!(of_light(before, after), name = named(&after.name, "window-light-number", index));
    }
    let objects = before.objects.iter().zip(&after.objects).enumerate().find(|(_, (before, after))| before != after);
    if let Some((index, (before, after))) = objects {
        return tr!(of_object(before, after), name = named(&after.name, "window-object-number", index));
    }
    let what = if before.equation != after.equation {
        tr!("window-changed-the-equation")
    } else if before.environment != after.environment {
        tr!("window-changed-the-environment")
    } else if before.background != after.background {
        tr!("window-changed-the-background")
    } else if before.picture != after.picture {
        tr!("window-changed-the-picture-s-settings")
    } else {
        tr!("window-moved-the-camera")
    };
    what.to_owned()
}

/// What was added to or removed from a list of names; `None` if it has as many. `numbered` is the id of a nameless one.
fn of_lists(before: &[String], after: &[String], numbered: &'static str) -> Option<String> {
    let (verb, longer, shorter) = match before.len().cmp(&after.len()) {
        std::cmp::Ordering::Less => ("window-added", after, before),
        std::cmp::Ordering::Greater => ("window-removed", before, after),
        std::cmp::Ordering::Equal => return None,
    };
    let index = longer.iter().zip(shorter).take_while(|(a, b)| a == b).count();
    let name = longer.get(index).map_or("", String::as_str);
    Some(tr!(verb, name = named(name, numbered, index)))
}

/// A name, or the text `numbered` with the number of something without one.
fn named(name: &str, numbered: &'static str, index: usize) -> String {
    if name.is_empty() { tr!(numbered, number = index + 1) } else { name.to_owned() }
}

/// The id of a change of a light.
fn of_light(before: &LightSettings, after: &LightSettings) -> &'static str {
    if before.enabled != after.enabled {
        if after.enabled { "window-switched-on" } else { "window-switched-off" }
    } else if before.position != after.position {
        "window-moved"
    } else if before.direction != after.direction {
        "window-turned"
    } else if before.name != after.name {
        "window-renamed"
    } else if before.color != after.color || before.spectrum != after.spectrum {
        "window-changed-the-colour-of"
    } else if before.intensity != after.intensity {
        "window-changed-the-intensity-of"
    } else {
        "window-changed"
    }
}

/// The id of a change of an object.
fn of_object(before: &ObjectSpec, after: &ObjectSpec) -> &'static str {
    if before.translate != after.translate {
        "window-moved"
    } else if before.rotate != after.rotate || before.up != after.up {
        "window-turned"
    } else if before.scale != after.scale {
        "window-scaled"
    } else if before.name != after.name {
        "window-renamed"
    } else if (&before.material, &before.parts) != (&after.material, &after.parts) {
        "window-changed-the-material-of"
    } else {
        "window-changed"
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio_scene::scene_file::{LightSourceKind, UpAxis};

    #[test]
    fn a_step_is_described_by_what_it_changed() {
        let mut key = LightSettings::new(LightSourceKind::Point);
        key.name = "key light".to_owned();
        let mut before = Document::default();
        before.scene.lights = vec![key.clone(), LightSettings::new(LightSourceKind::Point)];
        before.scene.objects = vec![ObjectSpec { name: "cube".into(), ..ObjectSpec::default() }];
        let change = |edit: &dyn Fn(&mut Document)| {
            let mut after = before.clone();
            edit(&mut after);
            description(&before, &after)
        };
        assert_eq!(change(&|d| d.scene.lights[0].position = Some([1.0; 3])), "moved key light");
        assert_eq!(change(&|d| d.scene.lights[1].enabled = !d.scene.lights[1].enabled), "switched off light 2");
        assert_eq!(change(&|d| drop(d.scene.lights.remove(0))), "removed key light");
        assert_eq!(change(&|d| d.scene.lights.push(key.clone())), "added key light");
        assert_eq!(change(&|d| d.scene.objects[0].rotate[1] = 4.0), "turned cube");
        assert_eq!(change(&|d| d.scene.objects[0].up = UpAxis::Z), "turned cube");
        assert_eq!(change(&|d| d.scene.equation.diffuse = false), "changed the equation");
        assert_eq!(change(&|d| d.scene.picture.exposure = 2.0), "changed the picture's settings");
        assert_eq!(change(&|d| d.scene.camera.position = [9.0; 3]), "moved the camera");
        assert_eq!(change(&|d| d.panes.pair = [0, 0]), "changed what a pane shows");
    }
}
