//! The plot: computed when functions or settings change, in the frame if that is quick, and painted in every frame.

use super::functions::BenchFunctions;
use super::job::Job;
use super::paint;
use crate::exported::{self, WidgetRole};
use crate::platform::Platform;
use egui::{Context, CursorIcon, Rect, RichText, Sense, TextureHandle, Ui, WidgetInfo, vec2};
use gonio_bsdf::NamedBsdf;
use gonio_language::tr;
use gonio_plot::{
    DEFAULT_VIEW_DEG, MOST_FUNCTIONS, PlotError, PlotFigure, PlotKind, PlotSettings, PlotTheme, PlottedBsdf, SIDES,
    figure,
};
use web_time::Instant;

/// Milliseconds of a plot above which the next one is computed beside the interface.
const MOST_MS: f64 = 10.0;
/// The largest side of a sphere's picture while something is dragged, pixels.
const QUICK_SPHERE: u32 = 110;

/// Functions and settings that a plot is computed from.
#[derive(Clone)]
pub struct PlotRequest {
    functions: Vec<(u64, NamedBsdf)>,
    settings: PlotSettings,
}

impl PartialEq for PlotRequest {
    fn eq(&self, other: &Self) -> bool {
        let versions = |request: &Self| request.functions.iter().map(|(version, _)| *version).collect::<Vec<_>>();
        self.settings == other.settings && versions(self) == versions(other)
    }
}

impl PlotRequest {
    /// The plot of the shown functions. Settings that do not change this kind of plot are set to their defaults.
    pub fn new(functions: &BenchFunctions, settings: &PlotSettings) -> Self {
        let shown = || functions.list.iter().filter(|function| function.is_shown);
        let mut settings = settings.clone();
        for (place, function) in settings.series.iter_mut().zip(shown()) {
            *place = function.color;
        }
        let default = PlotSettings::default();
        let kind = settings.kind;
        if matches!(kind, PlotKind::Albedo | PlotKind::Reciprocity | PlotKind::Fresnel | PlotKind::Slice) {
            (settings.theta_i_deg, settings.phi_i_deg) = (default.theta_i_deg, default.phi_i_deg);
        }
        if kind != PlotKind::Lobe {
            settings.view_deg = default.view_deg;
        }
        if kind != PlotKind::Sphere {
            settings.most_sphere_pixels = default.most_sphere_pixels;
        }
        PlotRequest { functions: shown().map(|f| (f.version, f.named.clone())).collect(), settings }
    }

    /// Computes the plot.
    ///
    /// # Errors
    ///
    /// Nothing to plot; one sentence.
    pub fn figure(&self) -> Result<PlotFigure, PlotError> {
        self.with_functions(|functions| figure(functions, &self.settings))
    }

    /// The settings of the plot.
    pub fn settings(&self) -> &PlotSettings {
        &self.settings
    }

    /// Calls `use_them` with the functions as the plots take them.
    pub fn with_functions<T>(&self, use_them: impl FnOnce(&[PlottedBsdf<'_>]) -> T) -> T {
        let plotted = |(_, named): &'_ (u64, NamedBsdf)| named.refraction_index();
        let functions: Vec<PlottedBsdf<'_>> = self
            .functions
            .iter()
            .map(|entry| PlottedBsdf { label: &entry.1.name, bsdf: entry.1.bsdf.as_ref(), ior: plotted(entry) })
            .collect();
        use_them(&functions)
    }

    /// Whether the plot is so quick for functions in Rust that it is computed in the frame.
    fn is_quick(&self) -> bool {
        matches!(
            self.settings.kind,
            PlotKind::Polar | PlotKind::Cartesian | PlotKind::Lobe | PlotKind::Fresnel | PlotKind::Samples
        )
    }
}

/// A computed plot, and how long it took.
type Computed = (Result<PlotFigure, PlotError>, f64);

/// The plot of the bench.
#[derive(Default)]
pub struct BenchPlot {
    /// The request whose plot, or error, is shown.
    request: Option<PlotRequest>,
    figure: Option<PlotFigure>,
    error: Option<String>,
    textures: Vec<TextureHandle>,
    running: Option<(PlotRequest, Job<Computed>)>,
    /// Milliseconds that the computation of the last plot took.
    pub computed_ms: f64,
    /// Number of plots computed so far.
    pub serial: u64,
}

impl BenchPlot {
    /// The plot that is shown.
    pub fn figure(&self) -> Option<&PlotFigure> {
        self.figure.as_ref()
    }

    /// Why there is no plot, in one sentence.
    pub fn error(&self) -> Option<&str> {
        self.error.as_deref()
    }

    /// Whether a plot is being computed.
    pub fn is_running(&self) -> bool {
        self.running.is_some()
    }

    /// Computes a plot if it is not the one that is shown.
    pub fn follow(&mut self, request: PlotRequest, platform: &mut dyn Platform, ctx: &Context) {
        self.take();
        if self.running.is_some() || self.request.as_ref() == Some(&request) {
            return;
        }
        let is_as_before = self.request.as_ref().is_some_and(|before| before.settings.kind == request.settings.kind);
        if request.is_quick() && !(is_as_before && self.computed_ms > MOST_MS) {
            let computed = compute(&request);
            self.show_next(request, computed);
            return;
        }
        let work = request.clone();
        self.running = Some((request, Job::start(platform, ctx, move || compute(&work))));
        self.take();
    }

    fn take(&mut self) {
        let Some(computed) = self.running.as_ref().and_then(|(_, job)| job.poll()) else { return };
        let Some((request, _)) = self.running.take() else { return };
        let stopped = || (Err(PlotError::Drawing(tr!("bench-the-computation-ended-unexpectedly").to_owned())), 0.0);
        self.show_next(request, computed.unwrap_or_else(stopped));
    }

    fn show_next(&mut self, request: PlotRequest, (computed, ms): Computed) {
        self.serial += 1;
        self.computed_ms = ms;
        self.request = Some(request);
        self.textures.clear();
        match computed {
            Ok(figure) => (self.figure, self.error) = (Some(figure), None),
            Err(PlotError::Functions(0)) => (self.figure, self.error) = (None, Some(tr!(NO_FUNCTION).to_owned())),
            Err(error) => (self.figure, self.error) = (None, Some(sentence(&error))),
        }
    }

    /// Drops the textures, because their context is lost.
    pub fn release(&mut self) {
        self.textures.clear();
    }

    /// Shows the plot in all of the available room. Dragging changes the angle of incidence of a polar plot, and the view of a
    /// lobe.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        functions: &BenchFunctions,
        settings: &mut PlotSettings,
        platform: &mut dyn Platform,
    ) {
        let [least, most] = SIDES.map(|side| side as f32);
        let room = ui.available_size().floor().clamp(vec2(least, least), vec2(most, most));
        let (rect, response) = ui.allocate_exact_size(room, Sense::click_and_drag());
        settings.size = [room.x as u32, room.y as u32];
        settings.theme = if ui.visuals().dark_mode { PlotTheme::Dark } else { PlotTheme::Light };
        let is_dragging = ui.input(|input| input.pointer.any_down());
        settings.most_sphere_pixels =
            if is_dragging { QUICK_SPHERE } else { PlotSettings::default().most_sphere_pixels };
        self.drag(&response, rect, settings);
        self.follow(PlotRequest::new(functions, settings), platform, ui.ctx());
        let what = self.summary(functions, settings);
        response.widget_info(|| WidgetInfo::labeled(egui::Role::Image, true, &what));
        exported::note(ui, &response, "bench-plot", WidgetRole::Picture, &what, self.serial);
        match &self.figure {
            Some(figure) => {
                if self.textures.len() != figure.pictures().len() {
                    self.textures = paint::textures(ui.ctx(), figure);
                }
                paint::figure(&ui.painter_at(rect), rect.min, figure, &self.textures);
            }
            None => {
                ui.painter().rect_filled(rect, 6.0, ui.visuals().faint_bg_color);
                if let Some(error) = &self.error {
                    let inner = Rect::from_center_size(rect.center(), vec2(rect.width() - 40.0, 60.0));
                    ui.put(inner, egui::Label::new(RichText::new(error.as_str())).wrap());
                }
            }
        }
        if self.is_running() {
            ui.put(Rect::from_min_size(rect.right_top() + vec2(-30.0, 8.0), vec2(20.0, 20.0)), egui::Spinner::new());
        }
    }

    fn drag(&self, response: &egui::Response, rect: Rect, settings: &mut PlotSettings) {
        let polar = self.figure.as_ref().and_then(|figure| figure.polar);
        if settings.kind == PlotKind::Polar {
            let pointer = response.interact_pointer_pos().filter(|_| response.dragged() || response.clicked());
            if let (Some(at), Some(polar)) = (pointer, polar) {
                let at = at - rect.min;
                if let Some(angle) = polar.theta_i_deg([f64::from(at.x), f64::from(at.y)]) {
                    settings.theta_i_deg = (10.0 * angle).round() / 10.0;
                }
            }
            response.clone().on_hover_cursor(CursorIcon::Grab);
        }
        if settings.kind == PlotKind::Lobe {
            let way = response.drag_delta();
            let [turn, rise] = &mut settings.view_deg;
            *turn = (*turn + 0.5 * f64::from(way.x)).rem_euclid(360.0);
            *rise = (*rise + 0.5 * f64::from(way.y)).clamp(-89.0, 89.0);
            if response.double_clicked() {
                settings.view_deg = DEFAULT_VIEW_DEG;
            }
            response.clone().on_hover_cursor(CursorIcon::Move);
        }
    }

    /// The plot in words, for screen readers.
    fn summary(&self, functions: &BenchFunctions, settings: &PlotSettings) -> String {
        let names: Vec<&str> =
            functions.list.iter().filter(|f| f.is_shown).map(|f| f.named.name.as_str()).take(MOST_FUNCTIONS).collect();
        tr!(
            "bench-plot-of-light-at-degrees",
            name = gonio_language::name(settings.kind.name()),
            functions = names.join(", "),
            degrees = settings.theta_i_deg
        )
    }
}

/// An error with a capital and a full stop.
fn sentence(error: &PlotError) -> String {
    let text = error.to_string();
    let mut letters = text.chars();
    letters.next().into_iter().flat_map(char::to_uppercase).chain(letters).chain(['.']).collect()
}

const NO_FUNCTION: &str = "bench-no-function-is-shown-add-a";

fn compute(request: &PlotRequest) -> Computed {
    let start = Instant::now();
    let figure = request.figure();
    (figure, start.elapsed().as_secs_f64() * 1e3)
}
