//! The tooltip of a term: its definition, and its values in this scene.

use super::{formula, formula_line, switch};
use crate::document::Document;
use crate::session::{Session, Term};
use crate::widgets::compact;
use egui::{RichText, Sense, Ui};
use gonio_light::Specular;
use gonio_scene::SceneSettings;
use gonio_scene::scene_file::LightSourceKind;

/// The tooltip of a term.
pub fn show(ui: &mut Ui, document: &Document, session: &Session, scene: &SceneSettings, term: Term) {
    ui.set_max_width(340.0);
    ui.label(RichText::new(term.description().trim()).strong());
    formula_line(ui, &formula::definition(scene, term), 16.0, document, Sense::hover());
    if let Some(now) = now(scene, session, term) {
        ui.label(now);
    }
    let how = match switch::is_on(document, term) {
        None if term == Term::Light => "Click: show the lights",
        None => return,
        Some(on) if switch::SUMMANDS.contains(&term) => {
            if on {
                "Click: switch off. Double click: show it alone"
            } else {
                "Click: switch on. Double click: show it alone"
            }
        }
        Some(true) => "Click: switch off (counts as 1)",
        Some(false) => "Click: switch on",
    };
    ui.label(RichText::new(how).small().weak());
}

/// The values of a term in this scene.
fn now(scene: &SceneSettings, session: &Session, term: Term) -> Option<String> {
    let count = |kind: LightSourceKind| scene.lights.iter().filter(|l| l.kind == kind && l.enabled).count();
    let e = &scene.equation;
    Some(match term {
        Term::Ambient => {
            let lights = scene.lights.iter().filter(|l| l.kind == LightSourceKind::Ambient && l.enabled);
            let sum = lights.fold([0.0; 3], |sum, light| {
                let (color, intensity) = (light.color.0, light.intensity);
                [0, 1, 2].map(|i| sum[i] + color[i] * intensity)
            });
            let [r, g, b] = sum.map(compact);
            format!("The scene's ambient light is {r}, {g}, {b}")
        }
        Term::Emitted => {
            let materials = session.loaded.iter().flat_map(|loaded| &loaded.materials);
            let shining = materials.filter(|m| m.material.emitted.iter().any(|v| *v > 0.0)).count();
            match shining {
                0 => "No material of this scene emits light".into(),
                1 => "One material of this scene emits light".into(),
                n => format!("{n} materials of this scene emit light"),
            }
        }
        Term::Environment => {
            let environment = scene.environment.as_ref()?;
            format!("Environment {}, intensity {}", environment.image, compact(environment.intensity))
        }
        Term::Diffuse => match e.brdf {
            Some(brdf) => format!("The diffuse part of the BRDF {brdf}"),
            None => format!("By the {} convention", e.convention),
        },
        Term::Specular => match (e.brdf, e.specular) {
            (Some(brdf), _) => format!("The lobe of the BRDF {brdf}"),
            (None, Specular::None) => "None; a click selects Blinn-Phong".into(),
            (None, specular) => {
                format!("{specular}{}", if e.gated { ", 0 where the light is behind the surface" } else { "" })
            }
        },
        Term::Light => {
            let lit = scene.lights.iter().filter(|l| l.kind != LightSourceKind::Ambient);
            let on = lit.clone().filter(|l| l.enabled).count();
            format!("{on} of {} lights are on", lit.count())
        }
        Term::Attenuation => {
            let places = count(LightSourceKind::Point) + count(LightSourceKind::Spot);
            match places {
                0 => "This scene has only directional lights: att is 1".into(),
                1 => "Applies to one light; directional lights have att = 1".into(),
                n => format!("Applies to {n} lights; directional lights have att = 1"),
            }
        }
        Term::Spot => match count(LightSourceKind::Spot) {
            0 => "This scene has no spot light: spot is 1".into(),
            1 => "Applies to one spot light; other lights have spot = 1".into(),
            n => format!("Applies to {n} spot lights; other lights have spot = 1"),
        },
        Term::Cosine => "0 where the light is behind the surface".into(),
    })
}
