//! The list of stations, the sliders of the chosen one, and its film.

use super::RoomStation;
use super::work::RoomWork;
use crate::exported::{self, WidgetRole};
use crate::theme::{colors, icons};
use crate::widgets::{self, heading, tool_button};
use egui::{Button, Context, RichText, Ui, vec2};
use gonio_bsdf::{DVec3, Parameter};
use gonio_language::tr;
use web_time::{Duration, Instant};

/// Frames of a film from one end of the range to the other.
const FRAMES: f64 = 90.0;
/// Least time of a frame.
const FRAME: Duration = Duration::from_millis(66);

/// A film: the film parameter runs from one end of its range to the other, and begins again.
#[derive(Default)]
pub struct ParameterFilm {
    /// Whether it runs.
    pub is_playing: bool,
    last: Option<Instant>,
}

impl ParameterFilm {
    /// Shows the next frame if the last one was seen.
    pub fn step(&mut self, ctx: &Context, station: &mut RoomStation, work: &RoomWork) {
        if !self.is_playing {
            return;
        }
        ctx.request_repaint_after(FRAME);
        let is_seen = work.picture.is_newest && self.last.is_none_or(|last| last.elapsed() >= FRAME);
        if !is_seen {
            return;
        }
        self.last = Some(Instant::now());
        let name = station.description.film_parameter.clone();
        let Some(parameter) = station.description.parameters.iter().find(|parameter| parameter.name == name) else {
            return;
        };
        let [min, max] = parameter.range();
        let next = station.values.number(&name) + (max - min) / FRAMES;
        station.values.set_value(&name, DVec3::splat(if next > max { min } else { next }));
    }
}

/// Shows the list. Returns the index of a station that was clicked.
pub fn list(ui: &mut Ui, stations: &[RoomStation], chosen: usize) -> Option<usize> {
    let mut picked = None;
    ui.spacing_mut().item_spacing.y = 2.0;
    for (index, station) in stations.iter().enumerate() {
        let is_chosen = index == chosen;
        let mut text = RichText::new(&station.description.title);
        if is_chosen {
            text = text.color(ui.visuals().strong_text_color());
        }
        let mut button = Button::new(text).frame_when_inactive(is_chosen).min_size(vec2(ui.available_width(), 25.0));
        button = button.right_text("").truncate();
        if is_chosen {
            button = button.fill(colors::ACCENT.of(ui).gamma_multiply(0.28));
        }
        let response = ui.add(button);
        let id = format!("station-{}", station.description.name);
        exported::note(ui, &response, &id, WidgetRole::Choice, &station.description.title, is_chosen);
        if response.clicked() {
            picked = Some(index);
        }
    }
    picked
}

/// Shows the parameters. The one of the film has a button before it.
pub fn sliders(ui: &mut Ui, station: &mut RoomStation, film: &mut ParameterFilm) {
    heading(ui, tr!("bench-parameters"));
    let parameters: Vec<(Parameter, DVec3)> = station.values.iter().map(|(p, value)| (p.clone(), value)).collect();
    for (parameter, value) in parameters {
        let is_film = parameter.name == station.description.film_parameter;
        let id = format!("parameter-{}", parameter.name);
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 4.0;
            if is_film {
                let icon = if film.is_playing { icons::PAUSE } else { icons::PLAY };
                let tip = if film.is_playing {
                    tr!("bench-stop-the-film")
                } else {
                    tr!("bench-play-a-film-of-this-parameter")
                };
                if tool_button(ui, "film", icon, tip, Some(colors::ACCENT.of(ui)), true).clicked() {
                    film.is_playing = !film.is_playing;
                }
            } else {
                ui.add_space(26.0);
            }
            if let Some(changed) = widgets::parameter(ui, &id, &parameter, value) {
                station.values.set_value(&parameter.name, changed);
                film.is_playing &= !is_film;
            }
        });
    }
}
