//! The BRDF bench: functions of reflection and transmission, plotted, compared and checked.
//!
//! | file | contents |
//! |---|---|
//! | `functions` | models and files with the values of their parameters, as plain data |
//! | `plot`, `paint` | the plot: when it is computed, and how it is painted |
//! | `checks` | the properties of the chosen function |
//! | `job` | work beside the interface |
//! | `command` | commands of widgets and keys |
//! | `toolbar`, `list`, `settings` | the widgets |
//! | `state_json` | its part of the exported state |
//!
//! The plots are those of `gonio brdf plot`. It is independent of the scene and its document.

mod checks;
mod command;
mod functions;
mod job;
mod list;
pub(crate) mod paint;
mod plot;
mod settings;
mod state_json;
mod toolbar;

pub use functions::{BenchFunction, BenchFunctions};
pub(crate) use job::Job;
pub use plot::PlotRequest;

use crate::action::Action;
use crate::platform::Platform;
use crate::saving::Product;
use crate::widgets::page_tabs;
use checks::BenchChecks;
use command::BenchCommand;
use egui::{Frame, Margin, Panel, ScrollArea, Ui};
use gonio_language::tr;
use gonio_plot::{PlotSettings, png, svg};
use plot::BenchPlot;

/// Below this width (points) everything is stacked: a phone in portrait orientation.
const NARROW: f32 = 720.0;

/// The BRDF bench.
#[derive(Default)]
pub struct BenchView {
    /// Whether it is shown in place of the scene.
    pub is_open: bool,
    /// The functions.
    pub functions: BenchFunctions,
    /// The settings of the plot.
    pub settings: PlotSettings,
    /// The page below the plot in a narrow window.
    page: BenchPage,
    plot: BenchPlot,
    checks: BenchChecks,
    was_open: bool,
}

/// A page below the plot in a narrow window.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum BenchPage {
    #[default]
    Plot,
    Functions,
    Checks,
}

/// A sentence for the user, and whether it is an error.
pub type BenchSentence = (bool, String);

impl BenchView {
    /// Shows the bench, at first with some models.
    pub fn open(&mut self) {
        if !self.was_open {
            self.functions = BenchFunctions::first();
        }
        (self.is_open, self.was_open) = (true, true);
    }

    /// Adds the functions of files: names and contents.
    pub fn open_files(&mut self, files: Vec<(String, Vec<u8>)>, platform: &mut dyn Platform, ctx: &egui::Context) {
        self.functions.open(files, platform, ctx);
    }

    /// The bench's part of the exported state: see [`crate::exported::state`].
    pub fn state(&self) -> serde_json::Value {
        state_json::build(self)
    }

    /// Drops everything on the GPU, because its context is lost or will be.
    pub fn release(&mut self) {
        self.plot.release();
    }

    /// The plot as a file. An error is one sentence.
    pub fn product(&self, product: Product) -> Result<Vec<u8>, String> {
        let request = PlotRequest::new(
            &self.functions,
            &PlotSettings { most_sphere_pixels: PlotSettings::default().most_sphere_pixels, ..self.settings.clone() },
        );
        let bytes = request.with_functions(|functions| match product {
            Product::PlotPng => png(functions, request.settings()),
            _ => svg(functions, request.settings()).map(String::into_bytes),
        });
        bytes.map_err(|error| error.to_string())
    }

    /// The proposed name of a file of the plot.
    pub fn file_name(&self, product: Product) -> String {
        format!("{}.{}", self.settings.kind.name(), product.extension())
    }

    /// Shows a frame. Returns sentences for the user.
    pub fn ui(&mut self, ui: &mut Ui, platform: &mut dyn Platform, actions: &mut Vec<Action>) -> Vec<BenchSentence> {
        let ctx = ui.ctx().clone();
        let mut commands = Vec::new();
        let mut sentences = self.functions.take_opened();
        self.checks.follow(platform, &ctx);
        toolbar::keys(ui, &mut commands);
        toolbar::show(ui, &mut commands);
        if ui.available_width() < NARROW {
            self.narrow(ui, platform, &mut commands);
        } else {
            self.wide(ui, platform, &mut commands);
        }
        for command in commands {
            ctx.request_repaint();
            match command {
                BenchCommand::Add(model) => {
                    sentences.extend(self.functions.add_model(model).err().map(|error| (true, error)));
                }
                BenchCommand::Check => {
                    if let Some(function) = self.functions.chosen() {
                        self.checks.start(function.version, function.named.clone());
                    }
                }
                BenchCommand::Open => actions.push(Action::ChooseFiles),
                BenchCommand::Save(product) => actions.push(Action::Save(product)),
                BenchCommand::Leave => self.is_open = false,
                BenchCommand::Theme => actions.push(Action::ToggleTheme),
            }
        }
        sentences
    }

    /// The layout of a wide window: the functions at the left, the plot with its settings at the right.
    fn wide(&mut self, ui: &mut Ui, platform: &mut dyn Platform, commands: &mut Vec<BenchCommand>) {
        let inside = Frame::NONE.inner_margin(Margin::symmetric(10, 6));
        let side = Panel::left("bench functions").frame(inside).default_size(340.0).size_range(290.0..=560.0);
        side.show(ui, |ui| {
            ScrollArea::vertical().id_salt("bench side").auto_shrink([false, false]).show(ui, |ui| {
                list::show(ui, &mut self.functions);
                self.show_checks(ui, commands);
            });
        });
        let below = Panel::bottom("bench settings").frame(inside).resizable(false);
        below.show(ui, |ui| settings::show(ui, &mut self.settings, &self.functions));
        egui::CentralPanel::default().frame(inside).show(ui, |ui| {
            settings::kinds(ui, &mut self.settings);
            self.plot.show(ui, &self.functions, &mut self.settings, platform);
        });
    }

    /// The layout of a narrow window: the plot above one page.
    fn narrow(&mut self, ui: &mut Ui, platform: &mut dyn Platform, commands: &mut Vec<BenchCommand>) {
        let inside = Frame::NONE.inner_margin(Margin::symmetric(6, 4));
        let height = (0.5 * ui.available_height()).max(220.0);
        let plot = Panel::top("bench plot").frame(inside).exact_size(height).resizable(false);
        plot.show(ui, |ui| self.plot.show(ui, &self.functions, &mut self.settings, platform));
        let inside = Frame::NONE.inner_margin(Margin::symmetric(10, 6));
        egui::CentralPanel::default().frame(inside).show(ui, |ui| {
            self.pages(ui);
            let scroll =
                ScrollArea::vertical().id_salt((tr!("bench-bench-page"), self.page as u8)).auto_shrink([false, false]);
            scroll.show(ui, |ui| match self.page {
                BenchPage::Plot => {
                    settings::kinds(ui, &mut self.settings);
                    settings::show(ui, &mut self.settings, &self.functions);
                }
                BenchPage::Functions => list::show(ui, &mut self.functions),
                BenchPage::Checks => self.show_checks(ui, commands),
            });
        });
    }

    fn show_checks(&self, ui: &mut Ui, commands: &mut Vec<BenchCommand>) {
        if checks::show(ui, &self.functions, &self.checks) {
            commands.push(BenchCommand::Check);
        }
    }

    /// The tabs of the pages.
    fn pages(&mut self, ui: &mut Ui) {
        let pages = [
            (BenchPage::Plot, tr!("bench-plot"), "plot"),
            (BenchPage::Functions, tr!("bench-functions"), "functions"),
            (BenchPage::Checks, tr!("bench-checks"), "checks"),
        ];
        page_tabs(ui, &mut self.page, &pages);
    }
}
