//! Switches of the terms.

use crate::document::Document;
use crate::session::{BeforeAlone, EquationView, Term};
use crate::theme::colors::{self, Tint};
use gonio_light::Specular;

/// The summands of the equation, which can be shown alone.
pub const SUMMANDS: [Term; 5] = [Term::Ambient, Term::Emitted, Term::Environment, Term::Diffuse, Term::Specular];

/// The colour of a term wherever it is shown.
pub fn tint(term: Term) -> Option<Tint> {
    match term {
        Term::Ambient => Some(colors::AMBIENT),
        Term::Emitted => Some(colors::EMITTED),
        Term::Environment => Some(colors::ENVIRONMENT),
        Term::Diffuse => Some(colors::DIFFUSE),
        Term::Specular => Some(colors::SPECULAR),
        Term::Light => Some(colors::LIGHT),
        Term::Attenuation | Term::Spot | Term::Cosine => None,
    }
}

/// The specular model that the current pane shows.
pub fn specular_of(document: &Document) -> Specular {
    let own = document.panes.current().and_then(|pane| pane.specular);
    own.unwrap_or(document.scene.equation.specular)
}

/// Changes the specular model of the current pane if it has one of its own, otherwise of the scene.
pub fn set_specular(document: &mut Document, specular: Specular) {
    match document.panes.current_mut() {
        Some(pane) if pane.specular.is_some() => pane.specular = Some(specular),
        _ => document.scene.equation.specular = specular,
    }
}

/// Whether a term is on; `None` if it cannot be switched.
pub fn is_on(document: &Document, term: Term) -> Option<bool> {
    let e = &document.scene.equation;
    match term {
        Term::Ambient => Some(e.ambient && e.brdf.is_none()),
        Term::Emitted => Some(e.emitted),
        Term::Environment => document.scene.environment.as_ref().map(|env| env.light),
        Term::Diffuse => Some(e.diffuse),
        Term::Specular => Some(e.specular_term && (e.brdf.is_some() || specular_of(document) != Specular::None)),
        Term::Attenuation => Some(e.attenuation),
        Term::Spot => Some(e.spot),
        Term::Light | Term::Cosine => None,
    }
}

/// Switches a term.
pub fn set(document: &mut Document, term: Term, on: bool) {
    let e = &mut document.scene.equation;
    match term {
        Term::Ambient => e.ambient = on,
        Term::Emitted => e.emitted = on,
        Term::Environment => {
            if let Some(environment) = &mut document.scene.environment {
                environment.light = on;
            }
        }
        Term::Diffuse => e.diffuse = on,
        Term::Specular => {
            e.specular_term = on;
            if on && e.brdf.is_none() && specular_of(document) == Specular::None {
                set_specular(document, Specular::default());
            }
        }
        Term::Attenuation => e.attenuation = on,
        Term::Spot => e.spot = on,
        Term::Light | Term::Cosine => {}
    }
}

/// Toggles a term.
pub fn toggle(document: &mut Document, term: Term) {
    if let Some(on) = is_on(document, term) {
        set(document, term, !on);
    }
}

/// Shows a summand alone. If it is alone already, restores the previous switches, or switches everything on.
///
/// The environment's light is reflected by the diffuse and the specular term. It is alone if these are on and no light is.
pub fn alone(document: &mut Document, view: &mut EquationView, term: Term) {
    if !SUMMANDS.contains(&term) {
        return;
    }
    let of_environment = term == Term::Environment;
    let stays = |other: Term| of_environment && matches!(other, Term::Diffuse | Term::Specular);
    let others: Vec<(Term, bool)> = SUMMANDS
        .into_iter()
        .filter(|other| *other != term)
        .filter_map(|other| is_on(document, other).map(|on| (other, on)))
        .collect();
    let lit: Vec<usize> = if of_environment { lights_on(document) } else { Vec::new() };
    if others.iter().any(|(other, on)| *on && !stays(*other)) || !lit.is_empty() {
        for (other, on) in &others {
            if *on != stays(*other) {
                set(document, *other, stays(*other));
            }
        }
        turn(document, &lit, false);
        view.before_alone = Some(BeforeAlone { terms: others, lights: lit });
    } else {
        let everything = || BeforeAlone {
            terms: others.iter().map(|(other, _)| (*other, true)).collect(),
            lights: if of_environment { (0..document.scene.lights.len()).collect() } else { Vec::new() },
        };
        let before = view.before_alone.take().unwrap_or_else(everything);
        for (other, on) in before.terms {
            if is_on(document, other).is_some_and(|now| now != on) {
                set(document, other, on);
            }
        }
        turn(document, &before.lights, true);
    }
    set(document, term, true);
}

/// Whether a summand is shown alone.
pub fn is_alone(document: &Document, term: Term) -> bool {
    let of_environment = term == Term::Environment;
    let stays = |other: Term| of_environment && matches!(other, Term::Diffuse | Term::Specular);
    let is_off = |other: Term| is_on(document, other) != Some(true);
    is_on(document, term) == Some(true)
        && SUMMANDS.into_iter().filter(|other| *other != term).all(|other| stays(other) || is_off(other))
        && (!of_environment || lights_on(document).is_empty())
}

/// Indices of the lights that are on.
fn lights_on(document: &Document) -> Vec<usize> {
    document.scene.lights.iter().enumerate().filter(|(_, light)| light.enabled).map(|(index, _)| index).collect()
}

/// Switches lights; removed ones are skipped.
fn turn(document: &mut Document, lights: &[usize], on: bool) {
    for index in lights {
        if let Some(light) = document.scene.lights.get_mut(*index) {
            light.enabled = on;
        }
    }
}

/// Whether anything is switched off.
pub fn is_incomplete(document: &Document) -> bool {
    let e = &document.scene.equation;
    !(e.ambient && e.emitted && e.diffuse && e.specular_term && e.attenuation && e.spot)
}

/// Switches everything on.
pub fn all_on(document: &mut Document) {
    let e = &mut document.scene.equation;
    for switch in
        [&mut e.ambient, &mut e.emitted, &mut e.diffuse, &mut e.specular_term, &mut e.attenuation, &mut e.spot]
    {
        *switch = true;
    }
}
