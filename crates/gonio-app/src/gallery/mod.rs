//! The gallery: the scenes of `gonio tour` in sections, with small pictures that are drawn here. A click opens a scene.
//!
//! | file | contents |
//! |---|---|
//! | `card` | a scene's card |
//! | `thumbnails` | the small pictures: loaded beside the interface, drawn one in each frame |
//!
//! It is independent of the open scene and its document.

mod card;
mod thumbnails;

use crate::action::Action;
use crate::platform::Platform;
use crate::scene_view::drawing::PaneRenderer;
use crate::scene_view::{picture_size, present};
use crate::theme::{self, icons};
use crate::widgets::icon_button;
use egui::{Align, CentralPanel, Frame, Label, Layout, Margin, Panel, RichText, ScrollArea, Ui, vec2};
use gonio_gallery::exhibit::{Exhibit, Section};
use gonio_gallery::{markup, sections};
use gonio_language::tr;
use gonio_scene::ViewSpec;
use serde_json::{Value, json};
use thumbnails::Thumbnails;

/// The widest column of cards, points.
const WIDTH: f32 = 1180.0;
/// The heading of the pictures at the top, which have none.
const FIRST_TITLE: &str = "environment-the-light-equation";

/// A scene that was chosen.
#[derive(Clone, Debug, PartialEq)]
pub struct ChosenExhibit {
    /// The name of the exhibit.
    pub name: String,
    /// The scene file.
    pub toml: String,
    /// The debug view that shows what the exhibit is about.
    pub view: Option<ViewSpec>,
    /// Seconds.
    pub time: f64,
}

/// The gallery, in place of the scene.
#[derive(Default)]
pub struct GalleryView {
    /// Whether it is shown.
    pub is_open: bool,
    /// The sections with scenes; empty until the gallery is opened.
    sections: Vec<Section>,
    thumbnails: Thumbnails,
}

impl GalleryView {
    /// Shows the gallery. An error is one sentence.
    pub fn open(&mut self) -> Result<(), String> {
        if self.sections.is_empty() {
            self.sections = sections::of_scenes().map_err(|error| error.to_string())?;
        }
        self.is_open = true;
        Ok(())
    }

    /// Goes back to the scene, and ends the work.
    pub fn leave(&mut self) {
        self.is_open = false;
        self.thumbnails.stop();
    }

    /// Drops everything on the GPU, because its context is lost or will be.
    pub fn release(&mut self) {
        self.thumbnails = Thumbnails::default();
    }

    /// Its part of the exported state: `open`, the `sections` by their ids, the number of `exhibits`, and of those that are
    /// `drawn`.
    pub fn state(&self) -> Value {
        let exhibits = self.sections.iter().flat_map(|section| section.rows.iter().flatten()).count();
        json!({
            "open": self.is_open,
            "sections": self.sections.iter().map(|section| section.id).collect::<Vec<_>>(),
            "exhibits": exhibits,
            "drawn": self.thumbnails.drawn(),
        })
    }

    /// Shows a frame. Returns the chosen scene, and errors, one sentence each.
    pub fn ui(
        &mut self,
        ui: &mut Ui,
        platform: &mut dyn Platform,
        panes: Option<&mut PaneRenderer>,
        actions: &mut Vec<Action>,
    ) -> (Option<ChosenExhibit>, Vec<String>) {
        let ctx = ui.ctx().clone();
        let mut errors = Vec::new();
        if toolbar(ui, actions) {
            self.leave();
        }
        let mut chosen = None;
        let mut next: Option<(&Exhibit, [u32; 2])> = None;
        let inside = Frame::NONE.inner_margin(Margin::symmetric(14, 10));
        let (sections, thumbnails) = (&self.sections, &self.thumbnails);
        CentralPanel::default().frame(inside).show(ui, |ui| {
            ScrollArea::vertical().id_salt("gallery").auto_shrink([false, false]).show(ui, |ui| {
                let margin = ((ui.available_width() - WIDTH) / 2.0).max(0.0);
                ui.horizontal_top(|ui| {
                    ui.add_space(margin);
                    ui.vertical(|ui| {
                        ui.set_max_width(WIDTH.min(ui.available_width() - 6.0));
                        for section in sections {
                            heading(ui, section);
                            ui.horizontal_wrapped(|ui| {
                                ui.spacing_mut().item_spacing = vec2(10.0, 10.0);
                                for exhibit in section.rows.iter().flatten() {
                                    let card = card::show(ui, exhibit);
                                    if card.is_clicked {
                                        chosen = choice(exhibit);
                                    }
                                    let Some(panes) = panes.as_deref() else { continue };
                                    if !ui.is_rect_visible(card.picture) {
                                        continue;
                                    }
                                    match thumbnails.picture(exhibit, panes) {
                                        Some(shown) => present(ui, card.picture, shown),
                                        None if next.is_none() && !thumbnails.is_done(exhibit) => {
                                            let size = picture_size(card.picture, ui.ctx().pixels_per_point());
                                            next = Some((exhibit, size));
                                        }
                                        None => {}
                                    }
                                }
                            });
                            ui.add_space(10.0);
                        }
                    });
                });
            });
        });
        if let (Some(panes), true) = (panes, self.is_open) {
            let next = next.map(|(exhibit, size)| (exhibit.name.clone(), size));
            let exhibit =
                |name: &str| self.sections.iter().flat_map(|s| s.rows.iter().flatten()).find(|e| e.name == name);
            errors.extend(self.thumbnails.follow(&ctx, platform, panes, next, exhibit).err());
        }
        (chosen, errors)
    }
}

/// The bar above. Returns whether the gallery is left.
fn toolbar(ui: &mut Ui, actions: &mut Vec<Action>) -> bool {
    let mut is_leaving = false;
    let bar = Frame::NONE.inner_margin(Margin::symmetric(10, 5));
    Panel::top("gallery bar").frame(bar).resizable(false).show(ui, |ui| {
        ui.horizontal(|ui| {
            is_leaving = icon_button(ui, "leave", icons::CARET_LEFT, tr!("environment-back-to-the-scene")).clicked();
            ui.label(
                RichText::new(tr!("environment-gallery"))
                    .font(theme::bold(15.0))
                    .color(ui.visuals().strong_text_color()),
            );
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let theme = if ui.visuals().dark_mode { icons::SUN } else { icons::MOON };
                if icon_button(ui, "theme", theme, tr!("environment-light-or-dark-theme-t")).clicked() {
                    actions.push(Action::ToggleTheme);
                }
            });
        });
    });
    is_leaving
}

/// Title and introduction of a section.
fn heading(ui: &mut Ui, section: &Section) {
    let title = if section.title.is_empty() { tr!(FIRST_TITLE) } else { section.title };
    let label = ui.label(RichText::new(title).font(theme::bold(18.0)).color(ui.visuals().strong_text_color()));
    crate::exported::note(ui, &label, &format!("section-{}", section.id), crate::exported::WidgetRole::Text, title, "");
    if !section.introduction.is_empty() {
        ui.add(Label::new(RichText::new(plain(section.introduction)).weak()).wrap());
    }
    ui.add_space(4.0);
}

/// The text of a markup on one line, with `_` before a subscript and `^` before a superscript.
fn plain(text: &str) -> String {
    let mark = |rise: f32| match rise {
        rise if rise < 0.0 => "_",
        rise if rise > 0.0 => "^",
        _ => "",
    };
    markup::runs(text).into_iter().map(|run| format!("{}{}", mark(run.rise), run.text)).collect()
}

fn choice(exhibit: &Exhibit) -> Option<ChosenExhibit> {
    let scene = exhibit.scene()?;
    Some(ChosenExhibit {
        name: exhibit.name.clone(),
        toml: scene.to_toml_string(),
        view: exhibit.view,
        time: exhibit.time,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulas_are_legible_on_one_line() {
        assert_eq!(plain("k_s !{⟨N·H⟩}^g"), "k_s ⟨N·H⟩^g");
        assert_eq!(plain("att_i = \\f{1}{d^2}"), "att_i = 1 / d^2");
        assert_eq!(plain("once for each triangle"), "once for each triangle");
    }
}
