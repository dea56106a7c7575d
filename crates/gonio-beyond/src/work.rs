//! A station at work beside a window: a request, and results that become finer.
//!
//! The window's thread and the page's worker both call [`StationWork::advance`] until nothing is left to do or another request
//! arrives. The order is: a coarse picture, the plot, a finer picture, the checks, the rest of the picture's samples.

use crate::refinement::PictureRefinement;
use crate::station::{LawCheck, Station};
use crate::stations::station;
use glam::DVec3;
use gonio_bsdf::ParameterValues;
use gonio_image::encode::png;
use gonio_plot::{PlotFigure, PlotTheme};
use serde::{Deserialize, Serialize};

/// Samples of each pixel of a finished picture.
pub const MOST_SAMPLES: u32 = 64;

/// Milliseconds from a request to its checks: they cannot be interrupted, and while a slider moves nobody reads them.
const CHECKS_AFTER: f64 = 500.0;

/// Milliseconds of one step of the work.
const STEP: f64 = 25.0;

/// Milliseconds between two pictures of one stage, some time after the request: the finer a picture is, the less it changes.
fn picture_interval(since: f64) -> f64 {
    (0.2 * since).clamp(150.0, 1000.0)
}

/// A picture of a station, and the plot beside it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StationRequest {
    /// The name of the station.
    pub station: String,
    /// Parameters with their values, which are held in their ranges; the others have their defaults.
    pub values: Vec<(String, f64)>,
    /// The index of the picture.
    pub picture: usize,
    /// The size of the picture in pixels.
    pub size: [u32; 2],
    /// The size of the plot in pixels.
    pub plot_size: [u32; 2],
    /// The colours of the plot.
    pub theme: PlotTheme,
}

impl StationRequest {
    /// Whether both have the same law and the same checks.
    pub fn is_same_law(&self, other: &Self) -> bool {
        self.station == other.station && self.values == other.values
    }

    /// Whether both ask for the same picture.
    pub fn is_same_picture(&self, other: &Self) -> bool {
        self.is_same_law(other) && (self.picture, self.size) == (other.picture, other.size)
    }

    /// Whether both ask for the same plot.
    pub fn is_same_plot(&self, other: &Self) -> bool {
        self.is_same_law(other) && (self.plot_size, self.theme) == (other.plot_size, other.theme)
    }
}

/// A picture so far, as displayed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RefinedPicture {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Red, green and blue in 8-bit sRGB, the top row first.
    pub rgb: Vec<u8>,
    /// Samples of each pixel; 0 while squares of pixels are drawn. [`MOST_SAMPLES`] if nothing follows.
    pub samples: u32,
}

/// A result of a request.
#[derive(Clone, Debug, PartialEq)]
pub enum StationResult {
    /// The picture so far.
    Picture(RefinedPicture),
    /// The plot, or why there is none in one sentence.
    Plot(Result<PlotFigure, String>),
    /// The checks of the law.
    Checks(Vec<LawCheck>),
}

/// The work on the newest request.
#[derive(Default)]
pub struct StationWork(Option<RequestedWork>);

struct RequestedWork {
    station: &'static Station,
    values: ParameterValues,
    request: StationRequest,
    refinement: PictureRefinement,
    /// Rows of a step.
    rows: u32,
    needs_plot: bool,
    needs_checks: bool,
    /// When the picture was requested, and when it was returned last, milliseconds.
    begun: f64,
    returned: f64,
}

impl StationWork {
    /// Begins a request at a time in milliseconds. Work that it shares with the one before goes on. Returns whether there is
    /// such a station with such a picture; otherwise there is nothing to do.
    pub fn begin(&mut self, request: StationRequest, now: f64) -> bool {
        let before = self.0.take();
        let Some(station) = station(&request.station) else { return false };
        let Some(picture) = station.pictures.get(request.picture) else { return false };
        let mut values = station.defaults();
        for (name, value) in &request.values {
            values.set_value(name, DVec3::splat(*value));
        }
        let kept = |is_same: fn(&StationRequest, &StationRequest) -> bool| {
            before.as_ref().filter(|before| is_same(&before.request, &request))
        };
        let needs_plot = kept(StationRequest::is_same_plot).is_none_or(|before| before.needs_plot);
        let needs_checks = kept(StationRequest::is_same_law).is_none_or(|before| before.needs_checks);
        let is_kept = kept(StationRequest::is_same_picture).is_some();
        self.0 = Some(match before.filter(|_| is_kept) {
            Some(before) => RequestedWork { request, needs_plot, needs_checks, ..before },
            None => RequestedWork {
                station,
                refinement: PictureRefinement::new((picture.image_plane)(&values), request.size, 0),
                values,
                request,
                rows: 4,
                needs_plot,
                needs_checks,
                begun: now,
                returned: now,
            },
        });
        true
    }

    /// Whether there is something to show of the request: a picture, coarse at least, and the plot. Another request that arrives
    /// earlier should wait: otherwise nothing would be seen while a slider moves.
    pub fn is_presentable(&self) -> bool {
        self.0.as_ref().is_none_or(|work| work.refinement.is_covered() && !work.needs_plot)
    }

    /// Works for a few hundredths of a second, or longer for checks and the plot. `clock` returns milliseconds; `go_on` is asked from
    /// any thread, and where it returns false nothing has changed. Returns a result if there is a new one, and whether
    /// something is left to do.
    pub fn advance(
        &mut self,
        clock: &dyn Fn() -> f64,
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> (Option<StationResult>, bool) {
        let Some(work) = &mut self.0 else { return (None, false) };
        let is_done = work.refinement.samples() >= MOST_SAMPLES;
        if work.refinement.is_covered() && work.needs_plot {
            work.needs_plot = false;
            return (Some(StationResult::Plot(work.plot())), true);
        }
        if work.needs_checks && (is_done || work.refinement.is_covered() && clock() - work.begun >= CHECKS_AFTER) {
            work.needs_checks = false;
            return (Some(StationResult::Checks((work.station.checks)(&work.values))), true);
        }
        if is_done {
            return (None, false);
        }
        let start = clock();
        if !work.refinement.advance(work.rows, go_on) {
            return (None, true);
        }
        let end = clock();
        work.rows = (f64::from(work.rows) * STEP / (end - start).max(0.1)).clamp(1.0, 4096.0) as u32;
        let samples = work.refinement.samples();
        let is_stage = work.refinement.pass() == 0.0 && samples <= 2 || samples >= MOST_SAMPLES;
        let is_due = end - work.returned >= picture_interval(end - work.begun);
        // Before it is covered, places would be black.
        let picture = (work.refinement.is_covered() && (is_stage || is_due)).then(|| {
            work.returned = end;
            StationResult::Picture(work.picture())
        });
        (picture, true)
    }
}

impl RequestedWork {
    fn picture(&self) -> RefinedPicture {
        let image = self.refinement.picture();
        let rgb = match self.station.pictures.get(self.request.picture) {
            Some(picture) => png::rows8(&image, &picture.output),
            None => Vec::new(),
        };
        RefinedPicture { size: [image.width, image.height], rgb, samples: self.refinement.samples() }
    }

    fn plot(&self) -> Result<PlotFigure, String> {
        let mut figure = PlotFigure::new(self.request.plot_size, self.request.theme);
        (self.station.plot)(&self.values, &mut figure).map_err(|error| error.to_string())?;
        Ok(figure)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    fn request(picture: usize, time: f64) -> StationRequest {
        StationRequest {
            station: "interference".to_owned(),
            values: vec![("time".to_owned(), time)],
            picture,
            size: [64, 48],
            plot_size: [400, 300],
            theme: PlotTheme::Dark,
        }
    }

    /// The results until nothing is left, by a clock that advances by 60 milliseconds whenever it is read.
    fn results(work: &mut StationWork) -> Vec<StationResult> {
        let now = Cell::new(0.0);
        let clock = || now.replace(now.get() + 60.0);
        let mut results = Vec::new();
        loop {
            let (result, goes_on) = work.advance(&clock, &|| true);
            results.extend(result);
            if !goes_on {
                return results;
            }
        }
    }

    fn kinds(results: &[StationResult]) -> [usize; 3] {
        let count = |of: fn(&StationResult) -> bool| results.iter().filter(|result| of(result)).count();
        let pictures = count(|result| matches!(result, StationResult::Picture(_)));
        let plots = count(|result| matches!(result, StationResult::Plot(Ok(_))));
        [pictures, plots, count(|result| matches!(result, StationResult::Checks(_)))]
    }

    #[test]
    fn a_request_gives_pictures_a_plot_and_checks_and_ends() {
        let mut work = StationWork::default();
        assert!(work.begin(request(0, 12.0), 0.0) && !work.is_presentable());
        let found = results(&mut work);
        let [pictures, plots, checks] = kinds(&found);
        assert!(pictures > 5 && (plots, checks) == (1, 1), "{:?}", kinds(&found));
        assert!(matches!(found.first(), Some(StationResult::Picture(picture)) if picture.rgb.len() == 3 * 64 * 48));
        let last = found.iter().rev().find_map(|result| match result {
            StationResult::Picture(picture) => Some(picture.samples),
            _ => None,
        });
        assert_eq!(last, Some(MOST_SAMPLES));
        assert_eq!(work.advance(&|| 0.0, &|| true), (None, false));
    }

    #[test]
    fn what_two_requests_share_is_computed_once() {
        let mut work = StationWork::default();
        assert!(work.begin(request(0, 12.0), 0.0));
        results(&mut work);
        // The same again, another theme, another picture, another value.
        assert!(work.begin(request(0, 12.0), 0.0));
        assert_eq!(kinds(&results(&mut work)), [0, 0, 0]);
        assert!(work.begin(StationRequest { theme: PlotTheme::Light, ..request(0, 12.0) }, 0.0));
        assert_eq!(kinds(&results(&mut work)), [0, 1, 0]);
        assert!(work.begin(StationRequest { theme: PlotTheme::Light, ..request(1, 12.0) }, 0.0));
        let [pictures, plots, checks] = kinds(&results(&mut work));
        assert!(pictures > 0 && (plots, checks) == (0, 0));
        assert!(work.begin(request(1, 13.0), 0.0));
        let [pictures, plots, checks] = kinds(&results(&mut work));
        assert!(pictures > 0 && (plots, checks) == (1, 1));
    }

    #[test]
    fn there_is_nothing_to_do_without_a_station_and_for_a_picture_that_it_has_not() {
        let mut work = StationWork::default();
        assert_eq!(work.advance(&|| 0.0, &|| true), (None, false));
        assert!(!work.begin(StationRequest { station: "nothing".to_owned(), ..request(0, 12.0) }, 0.0));
        assert!(!work.begin(request(9, 12.0), 0.0));
        assert!(work.is_presentable());
    }
}
