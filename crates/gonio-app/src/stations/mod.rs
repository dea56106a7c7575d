//! The stations beyond the rendering equation: pictures that become finer, sliders, the law as a plot, and its checks.
//!
//! | file | contents |
//! |---|---|
//! | `task` | the interface to the thread or the worker that computes |
//! | `work` | what is requested from it, and the results |
//! | `controls` | the list of stations, sliders and the film |
//! | `picture` | the picture |
//! | `law` | the plot and the checks |
//! | `page` | the texts |
//! | `state_json` | its part of the exported state |
//!
//! Texts and parameters come from the thread or worker too: on the page, they are not in the first module. It is independent of
//! the scene and its document.

mod controls;
mod law;
mod page;
mod picture;
mod state_json;
mod task;
mod work;

pub use task::{RequestNumber, StationNews, StationTask};

use crate::action::Action;
use crate::files::link::StationLink;
use crate::platform::Platform;
use crate::theme::{self, icons};
use crate::widgets::{icon_button, page_tabs};
use controls::ParameterFilm;
use egui::{Align, Frame, Label, Layout, Margin, Panel, RichText, ScrollArea, Ui};
use gonio_beyond::StationDescription;
use gonio_bsdf::ParameterValues;
use gonio_language::tr;
use work::RoomWork;

/// Below this width (points) everything is stacked: a phone in portrait orientation.
const NARROW: f32 = 860.0;

/// A station with the values of its parameters.
pub(crate) struct RoomStation {
    description: StationDescription,
    values: ParameterValues,
    /// The index of the picture that is shown.
    picture: usize,
}

/// The stations, in place of the scene.
#[derive(Default)]
pub struct StationRoom {
    /// Whether they are shown.
    pub is_open: bool,
    /// The station to show once the list is known.
    link: Option<StationLink>,
    stations: Vec<RoomStation>,
    chosen: usize,
    work: RoomWork,
    film: ParameterFilm,
    page: RoomPage,
}

/// A page below the picture in a narrow window.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum RoomPage {
    #[default]
    Stations,
    Sliders,
    Text,
    Law,
}

impl StationRoom {
    /// Shows the stations.
    pub fn open(&mut self) {
        self.is_open = true;
    }

    /// Shows a station of a link.
    pub fn open_link(&mut self, link: StationLink) {
        (self.is_open, self.link) = (true, Some(link));
    }

    /// Goes back to the scene, and ends the work.
    pub fn leave(&mut self) {
        self.is_open = false;
        self.film.is_playing = false;
        self.work.end();
    }

    /// Drops everything on the GPU, because its context is lost or will be.
    pub fn release(&mut self) {
        self.work.release();
    }

    /// Number of pictures of stations so far.
    pub fn pictures(&self) -> u64 {
        self.work.picture.serial
    }

    /// Its part of the exported state: see [`crate::exported::state`].
    pub fn state(&self) -> serde_json::Value {
        state_json::build(self)
    }

    fn station(&self) -> Option<&RoomStation> {
        self.stations.get(self.chosen)
    }

    /// Shows a frame. Returns errors, one sentence each.
    pub fn ui(&mut self, ui: &mut Ui, platform: &mut dyn Platform, actions: &mut Vec<Action>) -> Vec<String> {
        let ctx = ui.ctx().clone();
        let mut errors = self.work.follow(platform, &ctx, &mut self.stations, &self.film);
        errors.extend(self.follow_link());
        if let Some(station) = self.stations.get_mut(self.chosen) {
            self.film.step(&ctx, station, &self.work);
        }
        let is_leaving = self.toolbar(ui, platform, actions);
        if self.stations.is_empty() {
            egui::CentralPanel::default().show(ui, |ui| {
                let text = if self.work.has_failed() {
                    tr!("bench-the-stations-cannot-be-loaded")
                } else {
                    tr!("bench-loading-the-stations")
                };
                ui.centered_and_justified(|ui| ui.label(RichText::new(text).weak()));
            });
        } else if ui.available_width() < NARROW {
            self.narrow(ui);
        } else {
            self.wide(ui);
        }
        if let Some(station) = self.stations.get(self.chosen) {
            self.work.request(&ctx, station);
        }
        if is_leaving {
            self.leave();
        }
        errors
    }

    /// Shows the station of a link, once the list is known. Returns errors, one sentence each.
    fn follow_link(&mut self) -> Vec<String> {
        if self.stations.is_empty() {
            return Vec::new();
        }
        let Some(link) = self.link.take() else { return Vec::new() };
        if link.name.is_empty() {
            return Vec::new();
        }
        let Some(index) = self.stations.iter().position(|station| station.description.name == link.name) else {
            return vec![tr!("bench-the-link-names-an-unknown-station", name = link.name)];
        };
        self.chosen = index;
        let mut errors = Vec::new();
        if let Some(station) = self.stations.get_mut(index) {
            for (name, value) in &link.values {
                let set = station.values.set(name, value);
                errors.extend(set.err().map(|error| tr!("bench-the-link-is-damaged", error = error)));
            }
        }
        errors
    }

    /// The chosen station with those values that are not the defaults.
    fn link(&self) -> Option<StationLink> {
        let station = self.station()?;
        let changed = station.values.iter().filter(|(parameter, value)| parameter.default_value() != *value);
        let values = changed.map(|(parameter, value)| (parameter.name.to_string(), parameter.format(value))).collect();
        Some(StationLink { name: station.description.name.clone(), values })
    }

    /// The bar above. Returns whether the room is left.
    fn toolbar(&self, ui: &mut Ui, platform: &dyn Platform, actions: &mut Vec<Action>) -> bool {
        let mut is_leaving = false;
        let bar = Frame::NONE.inner_margin(Margin::symmetric(10, 5));
        Panel::top("station bar").frame(bar).resizable(false).show(ui, |ui| {
            ui.horizontal(|ui| {
                is_leaving = icon_button(ui, "leave", icons::CARET_LEFT, tr!("bench-back-to-the-scene")).clicked();
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                    let theme = if ui.visuals().dark_mode { icons::SUN } else { icons::MOON };
                    if icon_button(ui, "theme", theme, tr!("bench-light-or-dark-theme")).clicked() {
                        actions.push(Action::ToggleTheme);
                    }
                    if let Some(link) = self.link()
                        && icon_button(ui, "copy-link", icons::LINK, tr!("bench-copy-a-link-to-this-station")).clicked()
                    {
                        actions.push(Action::CopyText(platform.link(&link.fragment())));
                    }
                    ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                        let title = RichText::new(tr!("bench-beyond-the-rendering-equation")).font(theme::bold(16.0));
                        ui.add(Label::new(title.color(ui.visuals().strong_text_color())).truncate());
                    });
                });
            });
        });
        is_leaving
    }

    /// The layout of a wide window: stations and sliders, the picture, the law.
    fn wide(&mut self, ui: &mut Ui) {
        let inside = Frame::NONE.inner_margin(Margin::symmetric(10, 6));
        let list = Panel::left("stations").frame(inside).default_size(300.0).size_range(240.0..=420.0);
        list.show(ui, |ui| {
            ScrollArea::vertical().id_salt("station side").auto_shrink([false, false]).show(ui, |ui| {
                self.show_list(ui);
                self.show_sliders(ui);
            });
        });
        let width = (0.3 * ui.available_width() + 60.0).clamp(300.0, 460.0);
        let law = Panel::right("station law").frame(inside).default_size(width).size_range(280.0..=620.0);
        law.show(ui, |ui| {
            ScrollArea::vertical().id_salt("station law").auto_shrink([false, false]).show(ui, |ui| {
                clear_of_bar(ui);
                self.show_law(ui);
            });
        });
        egui::CentralPanel::default().frame(inside).show(ui, |ui| {
            ScrollArea::vertical().id_salt("station page").auto_shrink([false, false]).show(ui, |ui| {
                clear_of_bar(ui);
                let height = (0.72 * ui.clip_rect().height()).max(200.0);
                self.show_picture(ui, height);
                if let Some(station) = self.station() {
                    page::look(ui, &station.description);
                    page::equation(ui, &station.description);
                }
            });
        });
    }

    /// The layout of a narrow window: the picture above one page.
    fn narrow(&mut self, ui: &mut Ui) {
        let inside = Frame::NONE.inner_margin(Margin::symmetric(8, 4));
        let height = (0.42 * ui.available_height()).max(160.0);
        Panel::top("station picture").frame(inside).resizable(false).show(ui, |ui| self.show_picture(ui, height));
        let inside = Frame::NONE.inner_margin(Margin::symmetric(10, 4));
        egui::CentralPanel::default().frame(inside).show(ui, |ui| {
            self.pages(ui);
            let scroll = ScrollArea::vertical()
                .id_salt((tr!("bench-station-page"), self.page as u8))
                .auto_shrink([false, false]);
            scroll.show(ui, |ui| match self.page {
                RoomPage::Stations => self.show_list(ui),
                RoomPage::Sliders => self.show_sliders(ui),
                RoomPage::Text => {
                    if let Some(station) = self.station() {
                        page::equation(ui, &station.description);
                        page::look(ui, &station.description);
                    }
                }
                RoomPage::Law => {
                    self.show_law(ui);
                }
            });
        });
    }

    /// The tabs of the pages.
    fn pages(&mut self, ui: &mut Ui) {
        let pages = [
            (RoomPage::Stations, tr!("bench-stations"), "stations"),
            (RoomPage::Sliders, tr!("bench-sliders"), "sliders"),
            (RoomPage::Text, tr!("bench-text"), "text"),
            (RoomPage::Law, tr!("bench-law"), "law"),
        ];
        page_tabs(ui, &mut self.page, &pages);
    }

    fn show_list(&mut self, ui: &mut Ui) {
        if let Some(index) = controls::list(ui, &self.stations, self.chosen)
            && index != self.chosen
        {
            (self.chosen, self.film.is_playing) = (index, false);
        }
    }

    fn show_sliders(&mut self, ui: &mut Ui) {
        if let Some(station) = self.stations.get_mut(self.chosen) {
            controls::sliders(ui, station, &mut self.film);
        }
    }

    fn show_picture(&mut self, ui: &mut Ui, most_height: f32) {
        if let Some(station) = self.stations.get_mut(self.chosen) {
            picture::show(ui, station, &mut self.work, most_height);
        }
    }

    fn show_law(&mut self, ui: &mut Ui) {
        if let Some(station) = self.stations.get(self.chosen) {
            law::plot(ui, &station.description, &mut self.work);
            page::law(ui, &station.description);
            law::checks(ui, &self.work);
        }
    }
}

/// Leaves room for the bar of a scroll area, which floats over its content.
fn clear_of_bar(ui: &mut Ui) {
    ui.set_max_width(ui.available_width() - 6.0);
}
