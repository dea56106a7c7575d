//! Environment, background, exposure and tone mapping.

use crate::action::Action;
use crate::document::Document;
use crate::exported::{self, WidgetRole};
use crate::session::Session;
use crate::widgets::{NumberField, choice, color, dropdown, heading, named_options, row, toggle};
use egui::Ui;
use gonio_language::{name, tr};
use gonio_light::Quantity;
use gonio_light::color::{ColorEncoding, ToneMap};
use gonio_scene::scene_file::{BackgroundSpec, PictureSpec};
use gonio_scene::settings::EnvironmentSettings;
use gonio_scene::texture::TextureFilter;
use gonio_scene::{SceneSettings, ViewSpec};

pub fn show(ui: &mut Ui, document: &mut Document, session: &mut Session, actions: &mut Vec<Action>) {
    if session.loaded.is_none() {
        return;
    }
    heading(ui, tr!("scene-view-of-this-pane"));
    view(ui, document);
    heading(ui, tr!("scene-environment"));
    environment_image(ui, &mut document.scene);
    row(ui, "", "", |ui| {
        let title = tr!("environment-faces-and-conversion");
        let button = ui.button(title);
        exported::note(ui, &button, "environment-panel", WidgetRole::Button, title, "");
        let tip = tr!("environment-the-environment-as-six-faces-and");
        if button.on_hover_text(tip).clicked() {
            actions.push(Action::ShowEnvironment);
        }
    });
    environment(ui, &mut document.scene);
    heading(ui, tr!("scene-background"));
    background(ui, &mut document.scene.background);
    heading(ui, tr!("scene-display"));
    output(ui, &mut document.scene.picture);
}

/// The quantities in groups.
const GROUPS: [(&str, &[Quantity]); 4] = {
    use Quantity::*;
    [
        (
            "scene-vectors",
            &[Normal, GeometricNormal, Tangent, View, Light, Reflection, Half, Refraction, ViewReflection],
        ),
        (
            "scene-terms",
            &[
                Ambient,
                Emitted,
                Diffuse,
                Specular,
                EnvironmentDiffuse,
                EnvironmentSpecular,
                Reflected,
                Transmitted,
                Albedo,
                Total,
            ],
        ),
        ("scene-factors", &[CosTheta, Spec, Attenuation, Spot, Visibility, Fresnel]),
        ("scene-places", &[Position, Depth, Distance, Uv]),
    ]
};

fn view(ui: &mut Ui, document: &mut Document) {
    let lights = document.scene.lights.len();
    let names: Vec<String> = (0..lights).map(|i| super::lights::name_of(document, i)).collect();
    let Some(pane) = document.panes.current_mut() else { return };
    let mut quantity = pane.view.map(|view| view.quantity);
    let titles: Vec<(Quantity, String)> =
        GROUPS.iter().flat_map(|(group, members)| members.iter().map(move |q| (*q, titled(tr!(group), *q)))).collect();
    let mut options = vec![(None, tr!("scene-the-picture"), tr!("scene-l-o-with-exposure-tone-mapping"))];
    options.extend(titles.iter().map(|(q, title)| (Some(*q), title.as_str(), q.description().trim())));
    let tip = tr!("scene-a-vector-term-or-factor-of");
    if row(ui, tr!("scene-view"), tip, |ui| dropdown(ui, "view", tr!("scene-what-is-shown"), &mut quantity, &options)) {
        pane.view = quantity.map(|quantity| ViewSpec { quantity, light: None });
    }
    let Some(view) = &mut pane.view else { return };
    if !view.quantity.per_light() && !view.quantity.summed_over_lights() {
        return;
    }
    let (first, tip) = if view.quantity.summed_over_lights() {
        (tr!("scene-sum-of-all"), tr!("scene-sum-over-all-lights"))
    } else {
        (tr!("scene-the-first"), tr!("scene-the-first-light-that-is-not"))
    };
    let mut options = vec![(None, first, tip)];
    options.extend(names.iter().enumerate().map(|(i, name)| (Some(i), name.as_str(), "")));
    row(ui, tr!("scene-of-light"), tr!("scene-light-whose-contribution-is-shown"), |ui| {
        dropdown(ui, "view-light", tr!("scene-of-which-light"), &mut view.light, &options);
    });
}

fn titled(group: &str, quantity: Quantity) -> String {
    let group = group.trim_end_matches('s').to_lowercase();
    let name = name(quantity.name());
    match quantity.symbol() {
        Some(symbol) => format!("{group}: {name} ({symbol})"),
        None => format!("{group}: {name}"),
    }
}

/// The choice of the environment's image.
pub fn environment_image(ui: &mut Ui, scene: &mut SceneSettings) {
    const BUILTIN: [(&str, &str); 3] = [
        ("debug", "scene-six-labelled-colours-one-per-face"),
        ("sky", "scene-a-sky-with-a-sun"),
        ("room", "scene-a-room-with-windows"),
    ];
    let image = scene.environment.as_ref().map(|environment| environment.image.clone());
    let own = image.clone().filter(|image| BUILTIN.iter().all(|(name, _)| name != image));
    let mut names: Vec<(&str, &str)> = vec![("none", tr!("scene-only-the-background-colours"))];
    names.extend(BUILTIN.map(|(name, tip)| (name, tr!(tip))));
    if let Some(own) = &own {
        names.push((own.as_str(), tr!("scene-from-the-scene")));
    }
    let options: Vec<(usize, &str, &str)> = names.iter().enumerate().map(|(i, (name, tip))| (i, *name, *tip)).collect();
    let before = image.as_deref().and_then(|image| names.iter().position(|(name, _)| *name == image)).unwrap_or(0);
    let mut chosen = before;
    row(ui, tr!("scene-image"), tr!("scene-surroundings-of-the-scene-drop-a"), |ui| {
        dropdown(ui, "environment", "environment", &mut chosen, &options);
    });
    if chosen != before {
        let name = names.get(chosen).map_or("", |(name, _)| name);
        let kept = scene.environment.take();
        scene.environment = (chosen != 0).then(|| EnvironmentSettings {
            image: name.to_owned(),
            rotate: kept.as_ref().map_or([0.0; 3], |e| e.rotate),
            intensity: kept.as_ref().map_or(1.0, |e| e.intensity),
            light: kept.as_ref().map_or(scene.lights.is_empty(), |e| e.light),
            ..EnvironmentSettings::default()
        });
    }
}

fn environment(ui: &mut Ui, scene: &mut SceneSettings) {
    let Some(environment) = &mut scene.environment else { return };
    row(ui, tr!("scene-light"), tr!("scene-whether-the-environment-lights-the-objects"), |ui| {
        let tip = tr!("scene-diffuse-light-and-glossy-reflection");
        toggle(ui, "environment-light", tr!("scene-lights-the-objects"), &mut environment.light, tip);
    });
    row(ui, tr!("scene-background"), tr!("scene-whether-the-environment-is-visible-behind"), |ui| {
        toggle(
            ui,
            "environment-visible",
            tr!("scene-is-visible"),
            &mut environment.visible,
            tr!("scene-behind-the-objects"),
        );
    });
    row(ui, tr!("scene-intensity"), tr!("scene-factor-on-the-light-of-the"), |ui| {
        let number =
            NumberField::new("environment-intensity", "intensity").tip(tr!("scene-factor-on-the-light-of-the"));
        number.range(0.0..=1e6).default(1.0).step(0.01).show(ui, &mut environment.intensity);
    });
    row(ui, tr!("scene-rotation"), tr!("scene-yaw-pitch-and-roll-about-y"), |ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        for ((name, tip), value) in
            [("yaw", tr!("scene-yaw-to-the-left")), ("pitch", tr!("scene-pitch-upwards")), ("roll", tr!("scene-roll"))]
                .into_iter()
                .zip(&mut environment.rotate)
        {
            let id = format!("environment-{name}");
            let number = NumberField::new(&id, name).tip(tip).unit("\u{b0}").range(-360.0..=360.0).default(0.0);
            number.step(1.0).width(66.0).show(ui, value);
        }
    });
    row(ui, tr!("scene-blur"), tr!("scene-blur-of-the-visible-environment"), |ui| {
        let number = NumberField::new("environment-blur", "blur").tip(tr!("scene-blur-of-the-visible-environment"));
        number.range(0.0..=1.0).default(0.0).show(ui, &mut environment.blur);
    });
}

fn background(ui: &mut Ui, background: &mut BackgroundSpec) {
    let usual = BackgroundSpec::default();
    row(ui, tr!("scene-top"), tr!("scene-colour-at-the-upper-edge-linear"), |ui| {
        color(ui, "background-top", tr!("scene-background-at-the-top"), &mut background.top, Some(usual.top), "");
    });
    row(ui, tr!("scene-bottom"), tr!("scene-colour-at-the-lower-edge-linear"), |ui| {
        color(
            ui,
            "background-bottom",
            tr!("scene-background-at-the-bottom"),
            &mut background.bottom,
            Some(usual.bottom),
            "",
        );
    });
    row(ui, "", "", |ui| {
        let tip = tr!("scene-saved-pictures-get-an-alpha-channel");
        toggle(ui, "background-transparent", "transparent", &mut background.transparent, tip);
    });
}

fn output(ui: &mut Ui, picture: &mut PictureSpec) {
    row(ui, tr!("scene-exposure"), tr!("scene-stops-each-doubles-the-light"), |ui| {
        let number = NumberField::new("exposure", "exposure").tip(tr!("scene-stops-each-doubles-the-light"));
        number.unit(" EV").range(-64.0..=64.0).default(0.0).step(0.02).show(ui, &mut picture.exposure);
    });
    row(ui, tr!("scene-tone-map-2"), tr!("scene-maps-light-above-1-to-the"), |ui| {
        choice(ui, "tone-map", tr!("scene-tone-map"), &mut picture.tone_map, &named_options!(ToneMap), ToneMap::None);
    });
    row(ui, tr!("scene-encoding"), tr!("scene-conversion-of-linear-light-to-the"), |ui| {
        let options = named_options!(ColorEncoding);
        choice(ui, "encoding", tr!("scene-colour-encoding"), &mut picture.color, &options, ColorEncoding::Srgb);
    });
    row(ui, tr!("scene-samples-3"), tr!("scene-samples-per-pixel-for-smooth-edges"), |ui| {
        let options = [(1, "1", ""), (2, "2", ""), (4, "4", ""), (8, "8", ""), (16, "16", "")];
        choice(ui, "samples", tr!("scene-samples-per-pixel"), &mut picture.samples, &options, 4);
    });
    row(ui, tr!("scene-textures"), tr!("scene-texture-filter-2"), |ui| {
        let options = named_options!(TextureFilter);
        dropdown(ui, "texture-filter", tr!("scene-texture-filter"), &mut picture.texture_filter, &options);
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A quantity that is added must be put into a group, once.
    #[test]
    fn every_quantity_can_be_chosen_once() {
        for quantity in Quantity::ALL {
            let times = GROUPS.iter().flat_map(|(_, members)| members.iter()).filter(|q| *q == quantity).count();
            assert_eq!(times, 1, "{quantity}");
        }
    }
}
