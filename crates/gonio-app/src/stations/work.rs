//! What the room has requested, and the results.

use super::RoomStation;
use super::controls::ParameterFilm;
use super::task::{RequestNumber, StationNews, StationTask};
use crate::platform::Platform;
use egui::{ColorImage, Context, TextureHandle, TextureOptions};
use gonio_beyond::{LawCheck, MOST_SAMPLES, RefinedPicture, StationRequest, StationResult};
use gonio_bsdf::ParameterValues;
use gonio_plot::{PlotFigure, PlotTheme};
use web_time::{Duration, Instant};

/// The longest time that a playing film waits for a picture without squares.
const PATIENCE: Duration = Duration::from_millis(800);

/// The size of a plot before it is laid out, in pixels.
const FIRST_PLOT: [u32; 2] = [370, 388];

/// A picture on the screen.
#[derive(Default)]
pub struct ShownPicture {
    /// The picture; `None` before the first one.
    pub texture: Option<TextureHandle>,
    /// Its size in pixels.
    pub size: [u32; 2],
    /// Samples of each pixel; 0 while squares of pixels are drawn.
    pub samples: u32,
    /// Whether it belongs to the newest request.
    pub is_newest: bool,
    /// Counts the pictures.
    pub serial: u64,
    /// The last one, for a context that has lost its textures.
    kept: Option<RefinedPicture>,
}

/// Requests and results.
#[derive(Default)]
pub struct RoomWork {
    task: Option<Box<dyn StationTask>>,
    failed: Option<String>,
    /// The newest request, its number, and when it was sent.
    request: Option<StationRequest>,
    number: RequestNumber,
    sent: Option<Instant>,
    /// The first requests with the present station and picture, the present values, the present picture.
    station_since: RequestNumber,
    law_since: RequestNumber,
    picture_since: RequestNumber,
    has_finished: bool,
    /// Whether the user has paused the work.
    pub is_paused: bool,
    /// The sizes of picture and plot in pixels, as they are laid out.
    pub size: [u32; 2],
    pub plot_size: [u32; 2],
    /// A picture with squares while a film plays.
    held: Option<(RequestNumber, RefinedPicture)>,
    /// The picture on the screen.
    pub picture: ShownPicture,
    /// The plot, or why there is none in one sentence.
    pub plot: Option<Result<PlotFigure, String>>,
    /// Counts the plots.
    pub plot_serial: u64,
    /// The checks, and whether they are those of the present values.
    pub checks: Vec<LawCheck>,
    pub has_checks: bool,
    /// Milliseconds from the request to its first picture.
    pub first_ms: Option<f64>,
}

impl RoomWork {
    /// Whether something is being computed.
    pub fn is_running(&self) -> bool {
        self.task.is_some() && self.failed.is_none() && !self.is_paused && !self.has_finished
    }

    /// Whether nothing can be computed any more.
    pub fn has_failed(&self) -> bool {
        self.failed.is_some()
    }

    /// The time since the newest request.
    pub fn waited(&self) -> Duration {
        self.sent.map_or(Duration::ZERO, |sent| sent.elapsed())
    }

    /// Ends the work. What is shown stays for the next visit.
    pub fn end(&mut self) {
        (self.task, self.failed, self.request, self.is_paused) = (None, None, None, false);
    }

    /// Drops the texture.
    pub fn release(&mut self) {
        self.picture.texture = None;
    }

    /// Pauses the work, or goes on.
    pub fn toggle_pause(&mut self) {
        self.is_paused = !self.is_paused;
        if self.is_paused {
            if let Some(task) = &mut self.task {
                task.pause();
            }
        } else {
            // The same request again: the picture goes on.
            self.send();
        }
    }

    /// Takes results; called in every frame. Returns errors, one sentence each.
    pub fn follow(
        &mut self,
        platform: &mut dyn Platform,
        ctx: &Context,
        stations: &mut Vec<RoomStation>,
        film: &ParameterFilm,
    ) -> Vec<String> {
        let mut errors = Vec::new();
        if self.task.is_none() {
            self.task = Some(platform.stations(ctx));
        }
        while let Some(news) = self.task.as_mut().and_then(|task| task.poll()) {
            match news {
                StationNews::Stations(list) if stations.is_empty() => {
                    let station = |description: gonio_beyond::StationDescription| RoomStation {
                        values: ParameterValues::defaults(description.parameters.clone()),
                        description,
                        picture: 0,
                    };
                    stations.extend(list.into_iter().map(station));
                }
                StationNews::Stations(_) => {}
                StationNews::Result(number, result) => self.take(ctx, number, result, film),
                StationNews::Finished(number) => self.has_finished |= number == self.number,
                StationNews::Failed(error) => {
                    self.failed = Some(error.clone());
                    errors.push(error);
                }
            }
        }
        if (!film.is_playing || self.waited() >= PATIENCE)
            && let Some((number, picture)) = self.held.take()
        {
            self.show(ctx, number, picture);
        }
        if self.picture.texture.is_none()
            && let Some(picture) = self.picture.kept.take()
        {
            self.upload(ctx, picture);
        }
        errors
    }

    fn take(&mut self, ctx: &Context, number: RequestNumber, result: StationResult, film: &ParameterFilm) {
        if number < self.station_since {
            return;
        }
        match result {
            // The step that was under way when the user paused ends after that.
            StationResult::Picture(_) if self.is_paused && self.picture.is_newest => {}
            StationResult::Picture(picture) if film.is_playing && picture.samples == 0 => {
                self.held = Some((number, picture));
            }
            StationResult::Picture(picture) => {
                self.held = None;
                self.show(ctx, number, picture);
            }
            StationResult::Plot(plot) => {
                self.plot = Some(plot);
                self.plot_serial += 1;
            }
            StationResult::Checks(checks) if number >= self.law_since => {
                (self.checks, self.has_checks) = (checks, true);
            }
            StationResult::Checks(_) => {}
        }
    }

    fn show(&mut self, ctx: &Context, number: RequestNumber, picture: RefinedPicture) {
        self.picture.is_newest = number >= self.picture_since;
        if self.picture.is_newest && self.first_ms.is_none() {
            self.first_ms = Some(1e3 * self.waited().as_secs_f64());
        }
        self.picture.serial += 1;
        self.upload(ctx, picture);
    }

    fn upload(&mut self, ctx: &Context, picture: RefinedPicture) {
        let size = picture.size.map(|side| side as usize);
        if picture.rgb.len() != 3 * size[0] * size[1] {
            return;
        }
        let image = ColorImage::from_rgb(size, &picture.rgb);
        match &mut self.picture.texture {
            Some(texture) => texture.set(image, TextureOptions::LINEAR),
            None => self.picture.texture = Some(ctx.load_texture("station", image, TextureOptions::LINEAR)),
        }
        (self.picture.size, self.picture.samples) = (picture.size, picture.samples);
        self.picture.kept = Some(picture);
    }

    /// Requests what the room shows now, if that has changed.
    pub fn request(&mut self, ctx: &Context, station: &RoomStation) {
        if self.size.contains(&0) {
            return;
        }
        // On a phone the plot is on a page that may not have been shown yet.
        let plot_size = if self.plot_size.contains(&0) { FIRST_PLOT } else { self.plot_size };
        let request = StationRequest {
            station: station.description.name.clone(),
            values: station.values.iter().map(|(parameter, value)| (parameter.name.to_string(), value.x)).collect(),
            picture: station.picture,
            size: self.size,
            plot_size,
            theme: if ctx.theme() == egui::Theme::Dark { PlotTheme::Dark } else { PlotTheme::Light },
        };
        let before = self.request.as_ref();
        if before == Some(&request) {
            return;
        }
        let next = self.number + 1;
        let is_same =
            |of: fn(&StationRequest, &StationRequest) -> bool| before.is_some_and(|before| of(before, &request));
        if !is_same(|a, b| (&a.station, a.picture) == (&b.station, b.picture)) {
            self.station_since = next;
            (self.picture.texture, self.picture.kept, self.picture.samples) = (None, None, 0);
        }
        if !is_same(|a, b| a.station == b.station) {
            (self.plot, self.checks) = (None, Vec::new());
        }
        if !is_same(StationRequest::is_same_law) {
            (self.law_since, self.has_checks) = (next, false);
        }
        if !is_same(StationRequest::is_same_picture) {
            (self.picture_since, self.first_ms, self.picture.is_newest) = (next, None, false);
            self.sent = Some(Instant::now());
            // Another picture is wanted, so the work goes on.
            self.is_paused = false;
        }
        self.request = Some(request);
        self.send();
    }

    fn send(&mut self) {
        self.number += 1;
        self.has_finished = self.is_paused;
        if let (Some(task), Some(request), false) = (&mut self.task, &self.request, self.is_paused) {
            task.request(self.number, request);
        }
    }

    /// The share of the samples that are computed, on a scale on which half the noise is half the way.
    pub fn share(&self) -> f32 {
        let samples = f64::from(self.picture.samples);
        (((1.0 + samples).ln() / (1.0 + f64::from(MOST_SAMPLES)).ln()) as f32).clamp(0.0, 1.0)
    }
}
