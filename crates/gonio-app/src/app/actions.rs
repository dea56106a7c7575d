//! Carries out actions: requests of widgets and keys, saving and copying.

use super::App;
use crate::action::Action;
use crate::document::TruthSettings;
use crate::exercise::Start;
use crate::files::link;
use crate::platform::{CaptureAccess, FileDialog};
use crate::saving::{self, DisplayedPicture, Product};
use crate::session::{MessageSeverity, PathField, RecordedFrame, Tab};
use gonio_image::encode::exr;
use gonio_language::tr;
use std::path::Path;

const NOTHING_CONVERTED: &str = "window-the-model-is-not-converted-yet";
const NOTHING_DRAWN: &str = "window-there-is-no-picture-yet-wait";

impl App {
    /// Carries out an action.
    pub(super) fn act(&mut self, ctx: &egui::Context, action: Action) {
        match action {
            Action::Open(inputs) => {
                let files = self.platform.files();
                self.open(ctx, inputs, files);
            }
            Action::OpenPaths(paths) => self.platform.open_paths(paths, self.purpose(), ctx),
            Action::ChooseFiles => {
                if self.platform.choose_files(self.purpose(), ctx) == FileDialog::Unavailable {
                    self.session.asking = Some(PathField { saves: None, text: String::new() });
                }
            }
            Action::Save(Product::Capture) if self.session.capture_access != CaptureAccess::Ready => {
                let obstacle = self.session.capture_access.obstacle().unwrap_or_default();
                self.session.messages.report(MessageSeverity::Note, obstacle);
            }
            Action::Save(product) => {
                let name = match product {
                    Product::PlotSvg | Product::PlotPng => self.bench.file_name(product),
                    _ if product.model_format().is_some() => self.converted_name(product),
                    Product::Environment(product) => self.environment_file_name(product),
                    _ => product.file_name(&self.session.title),
                };
                if self.platform.choose_place(product, &name, ctx) == FileDialog::Unavailable {
                    self.session.asking = Some(PathField { saves: Some(product), text: name });
                }
            }
            Action::SaveTo(product, place) => self.save(ctx, product, &place),
            Action::ShowLine(file, line) => self.show_line(file, line),
            Action::CopyPicture => self.copy_picture(ctx),
            Action::CopyLink => match link::of_scene(&self.document.scene) {
                Ok(fragment) => {
                    ctx.copy_text(self.platform.link(&fragment));
                    self.session.announcement = tr!("window-copied-the-link").into();
                }
                Err(error) => self.session.messages.report(MessageSeverity::Error, error),
            },
            Action::CopyText(text) => {
                ctx.copy_text(text);
                self.session.announcement = tr!("window-copied").into();
            }
            Action::Undo => {
                if let Some(step) = self.history.undo(&mut self.document) {
                    self.session.announcement = tr!("window-undone", step = step);
                }
            }
            Action::Redo => {
                if let Some(step) = self.history.redo(&mut self.document) {
                    self.session.announcement = tr!("window-redone", step = step);
                }
            }
            Action::Frame => {
                if let Some(loaded) = &self.session.loaded {
                    let [width, height] = self.session.facts.size.map(f64::from);
                    self.document.scene.camera = loaded.framed(&self.document.scene.camera, width / height.max(1.0));
                }
            }
            Action::PlayOrPause => self.session.clock.playing = !self.session.clock.playing,
            Action::SetTime(time) => self.session.clock.time = time,
            Action::Show(tab) => self.session.tab = tab,
            Action::ToggleProbe => {
                self.session.tab = if self.session.tab == Tab::Probe { Tab::Lights } else { Tab::Probe };
            }
            Action::ToggleObserver => self.session.observer.toggle(),
            Action::Overlay(overlay) => {
                if self.document.panes.current_mut().is_some_and(|pane| !pane.toggle_overlay(overlay)) {
                    self.session.announcement = tr!("window-overlays-are-not-drawn-over-a").into();
                }
            }
            Action::Special(view) => {
                if let Some(pane) = self.document.panes.current_mut() {
                    pane.show_special(if pane.special == Some(view) { None } else { Some(view) });
                }
            }
            Action::ToggleTruth => {
                if let Some(pane) = self.document.panes.current_mut() {
                    pane.show_truth(if pane.truth.is_some() { None } else { Some(TruthSettings::default()) });
                }
            }
            Action::ToggleGround => {
                self.session.settings.hides_ground = !self.session.settings.hides_ground;
                self.platform.keep(&self.session.settings);
            }
            Action::ToggleHelp => self.session.help = !self.session.help,
            Action::ToggleTheme => {
                let theme = if ctx.theme() == egui::Theme::Dark { egui::Theme::Light } else { egui::Theme::Dark };
                ctx.set_theme(theme);
                self.session.settings.dark = Some(theme == egui::Theme::Dark);
                self.platform.keep(&self.session.settings);
            }
            Action::SetLanguage(language) => {
                language.make_current();
                self.session.settings.language = Some(language);
                self.platform.announce_language(language);
                self.platform.keep(&self.session.settings);
            }
            Action::RecordFrame => self.record_frame(ctx),
            Action::CloseShaders => {
                if let Some(shaders) = self.session.shaders.take() {
                    shaders.close(&mut self.session.messages);
                    self.session.tab = Tab::default();
                    self.watch(ctx);
                }
            }
            Action::Dismiss(id) => self.session.messages.dismiss(id),
            Action::RestoreScene => self.restore_scene(ctx),
            Action::RestoreDraft => self.restore_scene_draft(ctx),
            Action::DiscardDraft => self.discard_scene_draft(),
            Action::TurnZUp => self.turn_z_up(ctx),
            Action::DismissAll => self.session.messages.dismiss_all(),
            Action::ExpandMessages => self.session.messages.is_expanded = !self.session.messages.is_expanded,
            Action::ShowBench => self.bench.open(),
            Action::ShowGallery => self.show_gallery(),
            Action::ShowStations => self.stations.open(),
            Action::ShowEnvironment => self.show_environment(),
            Action::CloseEnvironment => self.close_environment(),
            Action::RepairEnvironment => self.repair_environment(ctx),
            Action::ShowBake => self.show_bake(),
            Action::CloseBake => self.close_bake(),
            Action::StartBake => self.start_bake(ctx),
            Action::CancelBake => self.cancel_bake(),
            Action::ShowExercise => self.exercise.is_open = true,
            Action::ListExercises => self.exercise.list(),
            Action::StartExercise(exercise) => self.begin_exercise(ctx, Start { exercise, files: Vec::new() }),
        }
        ctx.request_repaint();
    }

    /// Records the OpenGL calls of the current pane's picture. If that fails, the record is empty, and the next attempt is
    /// at the next picture.
    fn record_frame(&mut self, ctx: &egui::Context) {
        let Some(pane_renderer) = &mut self.pane_renderer else { return };
        let record = pane_renderer.record(self.document.panes.current).unwrap_or_else(|error| {
            self.session
                .messages
                .report(MessageSeverity::Error, tr!("window-the-frame-cannot-be-recorded", error = error));
            None
        });
        let before = self.session.recorded_frame.take();
        let taken = RecordedFrame::new(ctx, record.unwrap_or_default(), self.session.facts.pictures, before.as_ref());
        self.session.recorded_frame = Some(taken);
    }

    pub(super) fn save(&mut self, ctx: &egui::Context, product: Product, place: &str) {
        if let Some(format) = product.model_format() {
            return self.convert_model(ctx, product, format, place);
        }
        if let Product::Environment(product) = product {
            return self.convert_environment(ctx, product, place);
        }
        if product == Product::Capture {
            return match self.capture(place) {
                Ok(place) => self.session.messages.report(MessageSeverity::Note, tr!("window-captured", place = place)),
                Err(error) => self.session.messages.report(MessageSeverity::Error, error),
            };
        }
        let folder = cfg!(not(target_arch = "wasm32")).then(|| Path::new(place).parent()).flatten();
        let saved = self.produced(product, folder).and_then(|bytes| self.platform.write(place, &bytes));
        match saved {
            Ok(place) => {
                self.session.announcement = tr!("window-saved", place = place);
                if product == Product::Scene {
                    self.saved = self.document.scene.clone();
                }
            }
            Err(error) => self.session.messages.report(MessageSeverity::Error, error),
        }
    }

    /// Writes a RenderDoc capture of the current pane's picture. Returns its place.
    fn capture(&mut self, place: &str) -> Result<String, String> {
        let pane_renderer = self.pane_renderer.as_mut().ok_or(tr!(NOTHING_DRAWN))?;
        let gl = pane_renderer.gl().clone();
        let redraw = pane_renderer.redraw(self.document.panes.current, self.session.shaders.as_ref());
        let mut redraw = redraw.map_err(|error| error.to_string())?.ok_or(tr!(NOTHING_DRAWN))?;
        self.platform.capture(place, &gl, &mut redraw)
    }

    fn produced(&mut self, product: Product, folder: Option<&Path>) -> Result<Vec<u8>, String> {
        let picture = &self.document.scene.picture;
        let size = (product == Product::SizedPicture).then_some([picture.width, picture.height]);
        match product {
            Product::Scene => Ok(saving::scene_file(&self.document.scene, folder).into_bytes()),
            Product::Picture | Product::SizedPicture => {
                saving::encode_png(&self.shown(size)?).map_err(|error| error.to_string())
            }
            Product::PlotSvg | Product::PlotPng => self.bench.product(product),
            Product::BakedObj | Product::BakedGlb | Product::BakedZip => self.baked_product(product, folder),
            // They are written once they were converted.
            Product::ModelGlb | Product::ModelObj | Product::ModelPly => Err(tr!(NOTHING_CONVERTED).to_owned()),
            // It is written while it is drawn.
            Product::Capture | Product::Environment(_) => Err(tr!(NOTHING_DRAWN).to_owned()),
            Product::Light => {
                let pane = self.document.panes.current;
                let light =
                    self.pane_renderer.as_mut().map(|pane_renderer| pane_renderer.light(pane, size)).transpose();
                let light = light.map_err(|error| error.to_string())?.flatten().ok_or(tr!(NOTHING_DRAWN))?;
                exr::encode_compact([light.width, light.height], &light.pixels).map_err(|error| error.to_string())
            }
        }
    }

    /// The current pane's picture as displayed.
    fn shown(&mut self, size: Option<[u32; 2]>) -> Result<DisplayedPicture, String> {
        let pane = self.document.panes.current;
        let shaders = self.session.shaders.as_ref();
        let shown =
            self.pane_renderer.as_mut().map(|pane_renderer| pane_renderer.shown(pane, size, shaders)).transpose();
        shown.map_err(|error| error.to_string())?.flatten().ok_or_else(|| tr!(NOTHING_DRAWN).to_owned())
    }

    pub(super) fn copy_picture(&mut self, ctx: &egui::Context) {
        match self.shown(None) {
            Ok(DisplayedPicture { size: [width, height], rgba, .. }) => {
                let size = [width as usize, height as usize];
                ctx.copy_image(egui::ColorImage::from_rgba_premultiplied(size, &rgba));
                self.session.announcement = tr!("window-copied-the-picture").into();
            }
            Err(error) => self.session.messages.report(MessageSeverity::Error, error),
        }
    }

    /// Adds the input to the recent files.
    pub(super) fn remember(&mut self, inputs: &[String]) {
        let [input] = inputs else { return };
        if let Some(lasting) = self.platform.lasting(input) {
            self.session.settings.opened(lasting);
            self.platform.keep(&self.session.settings);
        }
    }
}
