//! The parameters of the term that was clicked last, in a line below the equation.

use super::{formula, formula_line, switch};
use crate::action::Action;
use crate::document::Document;
use crate::session::{Session, Tab, Term};
use crate::widgets::{NumberField, Vector, choice, dropdown, named_options, toggle};
use egui::{RichText, Sense, Ui, vec2};
use gonio_language::tr;
use gonio_light::brdf::BrdfKind;
use gonio_light::{Convention, Specular};
use gonio_scene::settings::EquationSettings;
use gonio_scene::{SceneSettings, defaults};

pub fn show(
    ui: &mut Ui,
    document: &mut Document,
    session: &mut Session,
    scene: &SceneSettings,
    actions: &mut Vec<Action>,
) {
    let term = session.equation.selected;
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(10.0, 2.0);
        ui.set_min_height(32.0);
        if !(term == Term::Environment && scene.environment.is_none()) {
            formula_line(ui, &formula::definition(scene, term), 16.0, document, Sense::hover());
            ui.add_space(6.0);
        }
        match term {
            Term::Diffuse => {
                convention(ui, document);
                brdf(ui, document);
            }
            Term::Specular => specular(ui, document),
            Term::Environment => match &mut document.scene.environment {
                Some(environment) => {
                    ui.label(tr!("scene-intensity-label"));
                    NumberField::new("equation-environment-intensity", tr!("scene-intensity-of-the-environment"))
                        .range(0.0..=1e6)
                        .default(1.0)
                        .show(ui, &mut environment.intensity);
                }
                None => drop(ui.label(tr!("scene-this-scene-has-no-environment-select"))),
            },
            Term::Ambient | Term::Light | Term::Attenuation | Term::Spot => {
                for (is, about) in [
                    (Term::Ambient, tr!("scene-the-sum-of-the-ambient-lights")),
                    (Term::Light, tr!("scene-each-light-adds-one-summand")),
                    (Term::Attenuation, tr!("scene-set-per-light-1-for-directional")),
                    (Term::Spot, tr!("scene-0-at-the-edge-of-the")),
                ] {
                    if is == term {
                        ui.label(RichText::new(about).weak());
                    }
                }
                if term == Term::Light {
                    let tip = tr!("scene-objects-cast-shadows-the-light-of");
                    toggle(ui, "shadows", "shadows", &mut document.scene.equation.shadows, tip);
                }
                link(ui, Tab::Lights, actions);
            }
            Term::Emitted => {
                ui.label(RichText::new(tr!("scene-set-per-material")).weak());
                link(ui, Tab::Objects, actions);
            }
            Term::Cosine => {
                let tip = tr!("scene-flip-the-normal-of-back-faces");
                toggle(ui, "two-sided", "two-sided", &mut document.scene.equation.two_sided, tip);
            }
        }
    });
}

fn link(ui: &mut Ui, tab: Tab, actions: &mut Vec<Action>) {
    let text = tab.title();
    let link = ui.link(text);
    crate::exported::note(
        ui,
        &link,
        &format!("equation-to-{}", tab.id()),
        crate::exported::WidgetRole::Button,
        text,
        "",
    );
    if link.clicked() {
        actions.push(Action::Show(tab));
    }
}

fn convention(ui: &mut Ui, document: &mut Document) {
    if document.scene.equation.brdf.is_some() {
        return;
    }
    let own = document.panes.current().and_then(|pane| pane.convention);
    let mut value = own.unwrap_or(document.scene.equation.convention);
    let options = named_options!(Convention);
    if !choice(ui, "convention", "convention", &mut value, &options, Convention::Lab) {
        return;
    }
    match document.panes.current_mut() {
        Some(pane) if own.is_some() => pane.convention = Some(value),
        _ => {
            let e = &mut document.scene.equation;
            e.convention = value;
            e.cosine_weighted = defaults::cosine_weighted(value);
            e.shadows = defaults::shadows(value);
        }
    }
}

fn specular(ui: &mut Ui, document: &mut Document) {
    if document.scene.equation.brdf.is_none() {
        let mut value = switch::specular_of(document);
        let options = named_options!(Specular);
        if choice(ui, "specular", tr!("scene-specular-model"), &mut value, &options, Specular::default()) {
            switch::set_specular(document, value);
        }
        let e = &mut document.scene.equation;
        toggle(ui, "gated", "gated", &mut e.gated, tr!("scene-no-specular-light-where-n-l"));
        let tip = tr!("scene-multiply-the-specular-term-by-n");
        toggle(ui, "cosine-weighted", tr!("scene-times-n-l"), &mut e.cosine_weighted, tip);
    }
    brdf(ui, document);
}

/// The BRDFs in place of both terms.
fn brdf(ui: &mut Ui, document: &mut Document) {
    let e: &mut EquationSettings = &mut document.scene.equation;
    let mut options: Vec<(Option<BrdfKind>, &str, &str)> =
        vec![(None, "none", tr!("scene-the-lab-s-diffuse-and-specular"))];
    options.extend(BrdfKind::ALL.iter().map(|kind| (Some(*kind), kind.name(), kind.description())));
    ui.label(RichText::new("BRDF").weak()).on_hover_text(tr!("scene-a-brdf-1-sr-in-place"));
    ui.scope(|ui| {
        ui.set_max_width(110.0);
        dropdown(ui, "brdf", "BRDF", &mut e.brdf, &options);
    });
    let Some(kind) = e.brdf else { return };
    if kind != BrdfKind::Lambert {
        let tip = tr!("scene-with-the-factor-that-conserves-energy");
        toggle(ui, "brdf-normalised", "normalised", &mut e.brdf_normalised, tip);
    }
    if kind == BrdfKind::Lafortune {
        ui.horizontal(|ui| {
            ui.set_max_width(220.0);
            Vector::new("lafortune", tr!("scene-diagonal-of-a"))
                .tip(tr!("scene-diagonal-of-a-along-tangent-bitangent"))
                .default([1.0, 1.0, -1.0])
                .range(-10.0..=10.0)
                .show(ui, &mut e.lafortune);
        });
    }
}
