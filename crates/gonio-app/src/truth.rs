//! Traced pictures: what the panes that show the rendering equation ask for, and the answers.
//!
//! A [`Tracer`] of the platform works beside the window, in a thread or in a worker, and sends finer and finer pictures. Any
//! change of the light in a pane is a new request, which cancels the one before.

use crate::document::TruthSettings;
use glam::DVec3;
use gonio_language::tr;
use gonio_scene::files::FileSource;
use gonio_scene::{Frame, Picture, Scene, SceneSettings};
use std::path::PathBuf;
use std::sync::Arc;
use web_time::{Duration, Instant};

/// Tracing stops at this error of a pixel, relative to the picture's mean luminance.
pub const ERROR_GOAL: f64 = 0.005;

/// The time between two pictures of one stage (in `tracer.js` too), milliseconds, `since` milliseconds after the request: the finer the picture is, the
/// less a newer one differs, and showing it takes time of the interface.
pub fn picture_interval(since: f64) -> f64 {
    (0.2 * since).clamp(150.0, 1000.0)
}

/// The time from the end of a picture to the frame that shows it. At 0 there would be two frames.
pub const REPAINT_DELAY: Duration = Duration::from_millis(1);

/// A picture to trace.
#[derive(Clone)]
pub struct TraceRequest {
    /// The scene with the pane's settings.
    pub scene: Arc<Scene>,
    /// Size, time and camera.
    pub frame: Frame,
    /// The simplifications.
    pub settings: TruthSettings,
    /// Changes with geometry, materials and environment: [`crate::session::Session::generation`].
    pub generation: u64,
    /// The pixel whose light is listed by the way it took: column and row.
    pub pixel: Option<[u32; 2]>,
    /// The source of the scene's files, for a worker that has to read them again.
    pub files: Arc<dyn FileSource>,
    /// The paths that were read from it.
    pub paths: Vec<PathBuf>,
}

impl TraceRequest {
    /// Whether both ask for the same light: exposure, tone mapping and encoding do not matter.
    pub fn is_same_light(&self, other: &TraceRequest) -> bool {
        let Frame { camera, width, height, .. } = other.frame;
        let frame = Frame { camera, width, height, ..self.frame.clone() };
        frame == self.frame && self.is_same_but_camera(other)
    }

    /// Whether the scenes differ in camera and size alone, so that nothing has to be built again.
    pub fn is_same_but_camera(&self, other: &TraceRequest) -> bool {
        let Frame { camera, width, height, samples, output, .. } = other.frame.clone();
        let (a, b) = (&self.scene, &other.scene);
        let settings = || {
            let (camera, picture) = (b.settings.camera.clone(), b.settings.picture.clone());
            SceneSettings { camera, picture, ..a.settings.clone() } == b.settings
        };
        self.generation == other.generation
            && self.settings == other.settings
            && Frame { camera, width, height, samples, output, ..self.frame.clone() } == other.frame
            && a.meshes.len() == b.meshes.len()
            && a.meshes.iter().zip(&b.meshes).all(|(a, b)| Arc::ptr_eq(a, b))
            && (Arc::ptr_eq(a, b) || settings())
    }
}

/// A picture so far.
#[derive(Clone, Debug, PartialEq)]
pub struct TraceReply {
    /// Linear, premultiplied; `None` if it has not changed.
    pub picture: Option<Picture>,
    /// What is known about it; `None` if it is the first of an earlier request, and stands in for that of the newest.
    pub facts: Option<TraceFacts>,
    /// The light of the request's pixel, if it has changed.
    pub light: Option<PixelLight>,
}

impl TraceReply {
    /// Both replies in one.
    pub fn and(self, newer: TraceReply) -> TraceReply {
        let TraceReply { picture, facts, light } = newer;
        TraceReply { picture: picture.or(self.picture), facts: facts.or(self.facts), light: light.or(self.light) }
    }
}

/// The light of a pixel, by the way it took.
#[derive(Clone, Debug, PartialEq)]
pub struct PixelLight {
    /// Column and row.
    pub pixel: [u32; 2],
    /// Paths that were followed.
    pub paths: f64,
    /// What a part is, the index of its light or object, and its linear RGB: as `PixelContributions::to_numbers` of gonio-trace
    /// lists them.
    pub parts: Vec<(u32, usize, DVec3)>,
}

impl PixelLight {
    /// Reads the numbers of `PixelContributions::to_numbers`.
    pub fn from_numbers(pixel: [u32; 2], numbers: &[f64]) -> Option<Self> {
        let (&paths, parts) = numbers.split_first()?;
        let part = |&[part, index, r, g, b]: &[f64; 5]| (part as u32, index as usize, DVec3::new(r, g, b));
        Some(PixelLight { pixel, paths, parts: parts.as_chunks().0.iter().map(part).collect() })
    }
}

/// Facts about a traced picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TraceFacts {
    /// Paths per pixel, in the mean; below 1 while pixels are large. 0 before the first picture.
    pub paths: f64,
    /// Root of the mean square error of a pixel's luminance, relative to the picture's mean, if it is known.
    pub error: Option<f64>,
    /// The share of the current pass that is done, 0 to 1.
    pub pass: f64,
    /// Whether the error is below [`ERROR_GOAL`].
    pub done: bool,
}

/// How soon a traced picture was there, and how long the interface was busy meanwhile.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TraceTimes {
    /// Milliseconds from the start of the frame that requested the picture to the end of the frame that showed the first one.
    pub first_ms: Option<f64>,
    /// Milliseconds of the longest frame since the request.
    pub longest_ms: f64,
}

/// Traces one picture at a time, beside the window. Dropping it ends the work.
pub trait Tracer {
    /// Starts this picture, and stops the one before as soon as that covers the pane: otherwise nothing would be seen while
    /// something is dragged.
    fn trace(&mut self, request: TraceRequest);
    /// Goes on with the picture, and looks at another pixel.
    fn probe(&mut self, pixel: Option<[u32; 2]>);
    /// Returns the newest picture, once. The window is repainted when there is one. An error is one sentence; nothing follows it.
    fn poll(&mut self) -> Option<Result<TraceReply, String>>;
}

/// The traced picture of one pane.
#[derive(Default)]
pub struct TracedPane {
    tracer: Option<Box<dyn Tracer>>,
    requested: Option<TraceRequest>,
    /// The newest picture: of an older request until the first of the new one is there.
    pub picture: Option<Arc<Picture>>,
    /// Counts the pictures.
    pub serial: u64,
    /// Counts the requests: each starts the picture again.
    pub requests: u64,
    /// Facts about the picture of the current request.
    pub facts: TraceFacts,
    /// The light of the pixel that was asked for last.
    pub light: Option<PixelLight>,
    /// Times of the current request.
    pub times: TraceTimes,
    /// The number of the request whose times are taken, and the start of the frame that made it.
    timed: Option<(u64, Instant)>,
    /// Why there is no picture, in one sentence.
    pub failed: Option<String>,
}

impl TracedPane {
    /// Takes the newest picture. Returns an error once.
    pub fn poll(&mut self) -> Option<String> {
        match self.tracer.as_mut()?.poll()? {
            Ok(TraceReply { picture, facts, light }) => {
                self.facts = facts.unwrap_or(self.facts);
                if let Some(picture) = picture {
                    self.picture = Some(Arc::new(picture));
                    self.serial += 1;
                }
                let asked = self.requested.as_ref().and_then(|request| request.pixel);
                if let Some(light) = light.filter(|light| Some(light.pixel) == asked) {
                    self.light = Some(light);
                }
                None
            }
            Err(error) => {
                // The request stays, so that the same is not tried again.
                self.tracer = None;
                self.failed = Some(error.clone());
                Some(error)
            }
        }
    }

    /// Asks for a picture, unless it is being traced already. `start` makes a tracer.
    pub fn follow(&mut self, request: TraceRequest, start: impl FnOnce() -> Box<dyn Tracer>) {
        if let Some(before) = self.requested.as_mut().filter(|before| before.is_same_light(&request)) {
            if before.pixel != request.pixel {
                (before.pixel, self.light) = (request.pixel, None);
                if let Some(tracer) = &mut self.tracer {
                    tracer.probe(request.pixel);
                }
            }
            return;
        }
        (self.facts, self.light, self.failed) = (TraceFacts::default(), None, None);
        self.tracer.get_or_insert_with(start).trace(request.clone());
        self.requested = Some(request);
        self.requests += 1;
    }

    /// Takes the times of a frame of the interface, at its end.
    pub fn take_times(&mut self, start: Instant, end: Instant) {
        let milliseconds = |from: Instant| 1e3 * end.duration_since(from).as_secs_f64();
        match self.timed {
            Some((request, asked)) if request == self.requests => {
                if self.facts.paths > 0.0 {
                    self.times.first_ms.get_or_insert(milliseconds(asked));
                }
            }
            _ if self.requests == 0 => return,
            _ => (self.timed, self.times) = (Some((self.requests, start)), TraceTimes::default()),
        }
        self.times.longest_ms = self.times.longest_ms.max(milliseconds(start));
    }

    /// Ends the work, and keeps the picture.
    pub fn stop(&mut self) {
        (self.tracer, self.requested) = (None, None);
    }

    /// Whether a picture is being traced.
    pub fn is_running(&self) -> bool {
        self.tracer.is_some() && !self.facts.done
    }

    /// The facts in words: `12 paths per pixel, error 3.4 %`.
    pub fn caption(&self) -> String {
        if self.failed.is_some() {
            return tr!("window-not-possible-here").to_owned();
        }
        let TraceFacts { paths, error, .. } = self.facts;
        let text = match paths {
            0.0 => return tr!("window-the-first-paths-are-on-their").to_owned(),
            _ if paths < 1.0 / 1.5 => tr!("window-1-path-per-pixels", paths = format!("{:.0}", 1.0 / paths)),
            _ if paths < 1.5 => tr!("window-1-path-per-pixel").to_owned(),
            _ => tr!("window-paths-per-pixel", paths = format!("{paths:.0}")),
        };
        let Some(error) = error else { return text };
        let percent = 100.0 * error;
        let percent = if percent < 10.0 { format!("{percent:.1}") } else { format!("{percent:.0}") };
        tr!("window-paths-and-error", paths = text, percent = percent)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio_scene::files::BuiltinOnly;
    use gonio_scene::load;
    use std::cell::RefCell;
    use std::path::Path;
    use std::rc::Rc;

    fn request() -> TraceRequest {
        let described = load::describe(&["builtin:cube"], &BuiltinOnly).unwrap_or_else(|error| panic!("{error}"));
        let scene = load::load(described, Path::new(""), &BuiltinOnly).unwrap_or_else(|error| panic!("{error}"));
        let frame = scene.frame(0.0);
        TraceRequest {
            scene: Arc::new(scene),
            frame,
            settings: TruthSettings::default(),
            generation: 1,
            pixel: None,
            files: Arc::new(BuiltinOnly),
            paths: Vec::new(),
        }
    }

    /// Counts requests, and answers each with an error.
    struct Counting(Rc<RefCell<usize>>);

    impl Tracer for Counting {
        fn trace(&mut self, _: TraceRequest) {
            *self.0.borrow_mut() += 1;
        }
        fn probe(&mut self, _: Option<[u32; 2]>) {}
        fn poll(&mut self) -> Option<Result<TraceReply, String>> {
            Some(Err("no".into()))
        }
    }

    /// Answers each pixel with its number of calls.
    struct Probing(u32, Option<[u32; 2]>);

    impl Tracer for Probing {
        fn trace(&mut self, request: TraceRequest) {
            self.1 = request.pixel;
        }
        fn probe(&mut self, pixel: Option<[u32; 2]>) {
            (self.0, self.1) = (self.0 + 1, pixel);
        }
        fn poll(&mut self) -> Option<Result<TraceReply, String>> {
            let numbers = [f64::from(self.0), 1.0, 2.0, 0.25, 0.5, 1.0];
            let light = self.1.and_then(|pixel| PixelLight::from_numbers(pixel, &numbers));
            Some(Ok(TraceReply { picture: None, facts: Some(TraceFacts::default()), light }))
        }
    }

    #[test]
    fn another_pixel_is_probed_in_the_same_picture() {
        let mut pane = TracedPane::default();
        let mut light_of = |change: fn(&mut TraceRequest)| {
            let mut request = request();
            change(&mut request);
            pane.requested =
                pane.requested.take().map(|before| TraceRequest { scene: request.scene.clone(), ..before });
            pane.follow(request, || Box::new(Probing(0, None)));
            let before = pane.light.as_ref().map(|light| light.pixel);
            assert_eq!(pane.poll(), None);
            (before, pane.light.clone(), pane.requests, pane.serial)
        };
        let light = |pixel, paths| Some(PixelLight { pixel, paths, parts: vec![(1, 2, DVec3::new(0.25, 0.5, 1.0))] });
        assert_eq!(light_of(|_| ()), (None, None, 1, 0));
        assert_eq!(light_of(|request| request.pixel = Some([3, 4])), (None, light([3, 4], 1.0), 1, 0));
        assert_eq!(light_of(|request| request.pixel = Some([3, 4])), (Some([3, 4]), light([3, 4], 1.0), 1, 0));
        // Of another pixel, and of none, the numbers are gone at once.
        assert_eq!(light_of(|request| request.pixel = Some([5, 4])), (None, light([5, 4], 2.0), 1, 0));
        assert_eq!(light_of(|_| ()), (None, None, 1, 0));
        let other = |request: &mut TraceRequest| (request.generation, request.pixel) = (2, Some([5, 4]));
        assert_eq!(light_of(other), (None, light([5, 4], 3.0), 2, 0));
    }

    #[test]
    fn replies_of_one_frame_are_joined() {
        let picture = Picture { width: 1, height: 1, pixels: vec![[0.5; 4]] };
        let light = PixelLight::from_numbers([0, 0], &[7.0]);
        let facts = TraceFacts { paths: 2.0, ..TraceFacts::default() };
        let older = TraceReply { picture: Some(picture.clone()), facts: None, light: None };
        // The facts about an earlier picture are not those about the newest.
        let standing_in = TraceReply { facts: Some(facts), ..older.clone() }.and(older.clone());
        assert_eq!(standing_in.facts, Some(facts));
        let both = older.and(TraceReply { picture: None, facts: Some(facts), light: light.clone() });
        assert_eq!(both, TraceReply { picture: Some(picture), facts: Some(facts), light });
    }

    #[test]
    fn only_light_starts_a_picture_again() {
        let count = Rc::new(RefCell::new(0));
        let mut pane = TracedPane::default();
        let mut requests_after = |change: fn(&mut TraceRequest)| {
            let mut request = request();
            change(&mut request);
            // Scenes are read again by each request, and share no mesh.
            pane.requested =
                pane.requested.take().map(|before| TraceRequest { scene: request.scene.clone(), ..before });
            pane.follow(request, || Box::new(Counting(count.clone())));
            *count.borrow()
        };
        assert_eq!(requests_after(|_| ()), 1);
        assert_eq!(requests_after(|request| request.frame.output.exposure = 2.0), 1, "exposure is not light");
        assert_eq!(requests_after(|request| request.frame.width = 7), 2);
        assert_eq!(requests_after(|request| (request.frame.width, request.frame.time) = (7, 1.0)), 3);
        assert_eq!(requests_after(|_| ()), 4);
        assert_eq!(requests_after(|request| request.generation = 2), 5);
    }

    #[test]
    fn a_failure_is_reported_once_and_not_tried_again() {
        let (count, request) = (Rc::new(RefCell::new(0)), request());
        let mut pane = TracedPane::default();
        pane.follow(request.clone(), || Box::new(Counting(count.clone())));
        assert_eq!((pane.poll().as_deref(), pane.poll()), (Some("no"), None));
        pane.follow(request, || Box::new(Counting(count.clone())));
        assert_eq!((*count.borrow(), pane.is_running()), (1, false));
    }

    #[test]
    fn times_are_those_of_the_request_and_of_its_frames() {
        let mut pane = TracedPane::default();
        let begin = Instant::now();
        let at = |milliseconds| begin + Duration::from_millis(milliseconds);
        pane.take_times(at(0), at(9));
        assert_eq!(pane.times, TraceTimes::default(), "nothing was requested");
        pane.requests = 1;
        pane.take_times(at(10), at(14));
        assert_eq!(pane.times, TraceTimes { first_ms: None, longest_ms: 4.0 });
        pane.facts.paths = 0.1;
        pane.take_times(at(30), at(32));
        pane.take_times(at(40), at(41));
        assert_eq!(pane.times, TraceTimes { first_ms: Some(22.0), longest_ms: 4.0 });
        (pane.requests, pane.facts) = (2, TraceFacts::default());
        pane.take_times(at(50), at(51));
        assert_eq!(pane.times, TraceTimes { first_ms: None, longest_ms: 1.0 });
        assert_eq!([0.0, 2000.0, 1e6].map(picture_interval), [150.0, 400.0, 1000.0]);
    }

    #[test]
    fn facts_are_said_in_words() {
        let said = |paths, error| {
            TracedPane { facts: TraceFacts { paths, error, ..TraceFacts::default() }, ..TracedPane::default() }
                .caption()
        };
        assert_eq!(said(1.0 / 64.0, None), "1 path per 64 pixels");
        assert_eq!(said(0.5, None), "1 path per 2 pixels");
        assert_eq!([0.7, 1.0, 1.4].map(|paths| said(paths, None)), ["1 path per pixel"; 3]);
        assert_eq!(said(12.0, Some(0.034)), "12 paths per pixel, error 3.4 %");
        assert_eq!(said(2.0, Some(0.5)), "2 paths per pixel, error 50 %");
    }
}
