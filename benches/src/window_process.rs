//! The measured window, in a separate process and on a separate screen. The application as `gonio view` runs it, with a
//! simulated pointer that drags a light, alternates with the bare renderer, which draws the same light in the same context.

use crate::measure::{self, Cost};
use eframe::egui::{
    Context, Event, Modifiers, PointerButton, Pos2, RawInput, Rect, Ui, ViewportCommand, Visuals, vec2,
};
use eframe::glow;
use gonio_app::App;
use gonio_app::exported;
use gonio_app::platform::desktop::{self, WindowOptions};
use gonio_gl::Gl;
use gonio_light::LightKind;
use gonio_render::{DisplayOptions, DisplayTexture, GpuScene, Renderer};
use gonio_scene::Frame;
use serde::Serialize;
use std::cell::RefCell;
use std::collections::VecDeque;
use std::rc::Rc;
use std::time::Instant;

/// The first argument of this program that makes it this process; then follow the scene, the window's width and height,
/// and `as-shipped` or `all-samples`. It prints [`Measured`] as JSON.
pub const NAME: &str = "window-process";
/// The second way: pictures keep their samples while something moves.
pub const ALL_SAMPLES: &str = "all-samples";
/// The first way: the application may draw fewer samples while something moves.
pub const AS_SHIPPED: &str = "as-shipped";

/// Frames of each side per turn.
pub const FRAMES: usize = 16;
/// Measured turns of each side.
pub const TURNS: usize = 10;
/// The pointer's first movement, which exceeds egui's limit for a click, and the radius of its circle, in points.
const START: f32 = 12.0;
const RADIUS: f32 = 60.0;
/// Frames per circle, so that the light moves as far in each as by a slow hand.
const AROUND: usize = 80;
/// Frames to wait for a widget before an error.
const MOST_FRAMES: usize = 2000;
/// Frames to wait after each action: hovering takes effect a frame later, and menus and tooltips appear and disappear.
const REST: usize = 4;

/// Median times of a frame in milliseconds.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct Pieces {
    /// The whole frame: wall time, and CPU time of all cores.
    pub wall: f64,
    pub cpu: f64,
    /// The application's update: layout of panels and the scene's commands (software drivers transform vertices there).
    pub ui: f64,
    /// The time from there until all commands are issued: tessellation and egui's painting.
    pub paint: f64,
    /// The time for waiting for the picture, passing it to the X server and polling the next event.
    pub rest: f64,
}

/// Median times of a bare picture in milliseconds.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct BarePieces {
    pub wall: f64,
    pub cpu: f64,
    /// The time until all commands are issued.
    pub submit: f64,
}

/// The measurements of this process.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Measured {
    pub renderer: String,
    pub triangles: usize,
    /// Pixels of the picture in the window, and the samples that it was drawn with while the light moved.
    pub size: [u32; 2],
    pub samples: u32,
    pub window: Pieces,
    pub bare: BarePieces,
    /// Window to bare renderer: medians of the turns' ratios.
    pub wall_ratio: f64,
    pub cpu_ratio: f64,
}

/// Opens the window, measures, prints and ends.
pub fn run(arguments: &[String]) -> Result<(), String> {
    let [scene, width, height, way] = arguments else { return Err("a scene, a width, a height and a way".into()) };
    let side = |text: &String| text.parse::<f32>().map_err(|e| format!("`{text}`: {e}"));
    let size = Some([side(width)?, side(height)?]);
    let mut script = VecDeque::new();
    if way == ALL_SAMPLES {
        script.extend([Step::Click("tab-compare"), Step::Click("adaptive"), Step::Click("tab-lights")]);
    }
    script.push_back(Step::Grab("light-0-handle"));
    let end: Rc<RefCell<Option<Result<Measured, String>>>> = Rc::default();
    let result = end.clone();
    let options = WindowOptions { inputs: vec![scene.clone()], size, ..WindowOptions::default() };
    desktop::run_within(options, move |app, gl| {
        Box::new(Hand { app, gl, script, place: Pos2::ZERO, waited: 0, state: State::Loading, end })
    })?;
    let measured = result.borrow_mut().take().unwrap_or_else(|| Err("the window was closed".into()))?;
    println!("{}", serde_json::to_string(&measured).map_err(|e| e.to_string())?);
    Ok(())
}

/// A step before the measurement.
#[derive(Clone, Copy)]
enum Step {
    /// Presses a widget.
    Click(&'static str),
    /// Presses a widget and holds it.
    Grab(&'static str),
}

enum State {
    Loading,
    /// Frames since the pointer moved there, in the first step of the script.
    Doing(usize),
    Measuring(Box<Run>),
    Done,
}

/// The application with the simulated pointer.
struct Hand {
    app: App,
    gl: Option<Gl>,
    script: VecDeque<Step>,
    /// The pointer's position in points.
    place: Pos2,
    /// Frames waited for the widget.
    waited: usize,
    state: State,
    end: Rc<RefCell<Option<Result<Measured, String>>>>,
}

/// Both sides, in turn.
struct Run {
    bare: Bare,
    /// The position where the light was grabbed.
    center: Pos2,
    /// Frames since then.
    frames: usize,
    /// The start of the last frame and the CPU time used by then; `None` if the next frame does not count.
    began: Option<(Instant, f64)>,
    /// Pictures that were drawn before this turn.
    pictures: u64,
    turn: Turn,
    /// Times of the current frame.
    ui_s: f64,
    /// The frames of a turn, and the medians of those that are over.
    turns: Vec<Turn>,
}

#[derive(Clone, Default)]
struct Turn {
    frames: Vec<Pieces>,
    /// The light's position in each frame.
    lights: Vec<LightKind>,
    window: Pieces,
    bare: BarePieces,
}

/// The renderer without the window.
struct Bare {
    renderer: Renderer,
    scene: GpuScene,
    canvas: DisplayTexture,
    frame: Frame,
}

impl eframe::App for Hand {
    fn raw_input_hook(&mut self, ctx: &Context, input: &mut RawInput) {
        // No other input.
        input
            .events
            .retain(|event| !matches!(event, Event::PointerMoved(_) | Event::PointerGone | Event::MouseMoved(_)));
        input.focused = true;
        if let Err(why) = self.begin(ctx, input) {
            self.finish(Err(why));
        }
        input.events.insert(0, Event::PointerMoved(self.place));
        ctx.request_repaint();
    }

    fn ui(&mut self, ui: &mut Ui, frame: &mut eframe::Frame) {
        let start = Instant::now();
        eframe::App::ui(&mut self.app, ui, frame);
        let ui_s = start.elapsed().as_secs_f64();
        if let State::Measuring(run) = &mut self.state {
            run.ui_s = ui_s;
            // The response is that of the frame before.
            if let (Some(last), Some(issued)) = (run.turn.frames.last_mut(), frame.info().cpu_usage) {
                last.paint = 1e3 * f64::from(issued) - last.ui;
                last.rest = last.wall - 1e3 * f64::from(issued);
            }
            match run.end_of_turn(&self.app) {
                Ok(None) => {}
                Ok(Some(measured)) => self.finish(Ok(measured)),
                Err(why) => self.finish(Err(why)),
            }
        }
    }

    fn clear_color(&self, visuals: &Visuals) -> [f32; 4] {
        eframe::App::clear_color(&self.app, visuals)
    }

    fn on_exit(&mut self, gl: Option<&glow::Context>) {
        // GPU objects are dropped while their context is current.
        self.state = State::Done;
        self.gl = None;
        self.app.on_exit(gl);
    }
}

impl Hand {
    /// Ends the measurement: the next frames close the window.
    fn finish(&mut self, result: Result<Measured, String>) {
        self.end.borrow_mut().get_or_insert(result);
        self.state = State::Done;
    }

    /// Moves the pointer in the frame that begins.
    fn begin(&mut self, ctx: &Context, input: &mut RawInput) -> Result<(), String> {
        match &mut self.state {
            // The moved light is not saved: the first time, the application only says so.
            State::Done => ctx.send_viewport_cmd(ViewportCommand::Close),
            State::Loading => {
                let session = self.app.session();
                if let Some(why) = session.messages.last_error() {
                    return Err(why.to_owned());
                }
                if session.busy.is_none() && session.facts.pictures > 0 {
                    self.state = State::Doing(0);
                }
                self.waited += 1;
            }
            State::Doing(frames) => {
                let now = *frames;
                *frames += 1;
                self.do_it(ctx, input, now)?;
            }
            State::Measuring(run) => {
                run.begin_frame(&self.app);
                self.place = run.pointer();
            }
        }
        if self.waited > MOST_FRAMES {
            return Err("the scene was not shown".into());
        }
        Ok(())
    }

    fn do_it(&mut self, ctx: &Context, input: &mut RawInput, frames: usize) -> Result<(), String> {
        let Some(&step) = self.script.front() else { return Ok(()) };
        let (Step::Click(id) | Step::Grab(id)) = step;
        match frames {
            0 => match place_of(ctx, id) {
                Some(rect) => self.place = rect.center(),
                None if self.waited > MOST_FRAMES => return Err(format!("the widget `{id}` did not appear")),
                None => (self.waited, self.state) = (self.waited + 1, State::Doing(0)),
            },
            REST => input.events.push(button(self.place, true)),
            n if n == REST + 1 && matches!(step, Step::Click(_)) => input.events.push(button(self.place, false)),
            n if n == REST + 1 => self.place += vec2(START, 0.0),
            n if n > 2 * REST => {
                self.script.pop_front();
                self.state = match step {
                    Step::Click(_) => State::Doing(0),
                    Step::Grab(_) => State::Measuring(Box::new(Run::new(&self.app, self.gl.as_ref(), self.place)?)),
                };
            }
            _ => {}
        }
        Ok(())
    }
}

fn button(pos: Pos2, pressed: bool) -> Event {
    Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers: Modifiers::NONE }
}

/// Returns the position of a widget in the last frame.
fn place_of(ctx: &Context, id: &str) -> Option<Rect> {
    let [x, y, width, height] = exported::widgets(ctx).into_iter().find(|widget| widget.id == id)?.rect;
    Some(Rect::from_min_size(Pos2::new(x, y), vec2(width, height)))
}

impl Run {
    fn new(app: &App, gl: Option<&Gl>, center: Pos2) -> Result<Self, String> {
        Ok(Run {
            bare: Bare::new(app, gl.ok_or("the window has no OpenGL")?)?,
            center,
            frames: 0,
            began: None,
            pictures: 0,
            turn: Turn::default(),
            ui_s: 0.0,
            turns: Vec::new(),
        })
    }

    fn pointer(&mut self) -> Pos2 {
        let angle = self.frames as f32 * std::f32::consts::TAU / AROUND as f32;
        self.frames += 1;
        self.center + RADIUS * vec2(angle.cos() - 1.0, angle.sin())
    }

    /// A frame ends where the next one begins.
    fn begin_frame(&mut self, app: &App) {
        let cpu = measure::cpu_time().as_secs_f64();
        let now = Instant::now();
        match self.began.replace((now, cpu)) {
            None => self.pictures = app.session().facts.pictures,
            Some((before, cpu_before)) => {
                let [wall, cpu, ui] = [(now - before).as_secs_f64(), cpu - cpu_before, self.ui_s].map(|s| 1e3 * s);
                self.turn.frames.push(Pieces { wall, cpu, ui, ..Pieces::default() });
                self.turn
                    .lights
                    .extend(app.session().loaded.as_ref().and_then(|l| l.frame(0.0).lights.first().map(|l| l.kind)));
            }
        }
    }

    /// After the last frame of a turn: the bare renderer's turn, and the sum of all after the last.
    fn end_of_turn(&mut self, app: &App) -> Result<Option<Measured>, String> {
        if self.turn.frames.len() < FRAMES {
            return Ok(None);
        }
        let mut turn = std::mem::take(&mut self.turn);
        self.began = None;
        let facts = &app.session().facts;
        // Including the picture of the frame being painted. When the pointer only starts to move there is one less.
        let pictures = facts.pictures - self.pictures;
        if !self.turns.is_empty() && pictures != FRAMES as u64 + 1 {
            return Err(format!("{pictures} pictures were drawn in {} frames", FRAMES + 1));
        }
        if turn.lights.windows(2).any(|pair| pair[0] == pair[1]) {
            return Err(format!("the light did not move: {:?}", turn.lights));
        }
        self.bare.like(app)?;
        let bare = self.bare.turn(&turn.lights)?;
        let of = |value: fn(&Pieces) -> f64| measure::median(turn.frames.iter().map(value));
        turn.window = Pieces {
            wall: of(|f| f.wall),
            cpu: of(|f| f.cpu),
            ui: of(|f| f.ui),
            paint: of(|f| f.paint),
            rest: of(|f| f.rest),
        };
        turn.bare = bare;
        self.turns.push(turn);
        // The first turn compiles shaders and fills caches.
        Ok((self.turns.len() > TURNS).then(|| self.measured(app)))
    }

    fn measured(&self, app: &App) -> Measured {
        let of = |value: fn(&Turn) -> f64| measure::median(self.turns.iter().skip(1).map(value));
        let session = app.session();
        Measured {
            renderer: session.facts.renderer.clone(),
            triangles: session.loaded.as_ref().map_or(0, |l| l.meshes.iter().map(|m| m.triangle_count()).sum()),
            size: session.facts.size,
            samples: session.facts.samples,
            window: Pieces {
                wall: of(|t| t.window.wall),
                cpu: of(|t| t.window.cpu),
                ui: of(|t| t.window.ui),
                paint: of(|t| t.window.paint),
                rest: of(|t| t.window.rest),
            },
            bare: BarePieces { wall: of(|t| t.bare.wall), cpu: of(|t| t.bare.cpu), submit: of(|t| t.bare.submit) },
            wall_ratio: of(|t| t.window.wall / t.bare.wall),
            cpu_ratio: of(|t| t.window.cpu / t.bare.cpu),
        }
    }
}

impl Bare {
    fn new(app: &App, gl: &Gl) -> Result<Self, String> {
        let loaded = app.session().loaded.as_ref().ok_or("there is no scene")?;
        let mut renderer = Renderer::new(gl.clone()).map_err(|e| e.message)?;
        let scene = renderer.upload(loaded).map_err(|e| e.message)?;
        let canvas = DisplayTexture::new(gl, [1, 1]).map_err(|e| e.message)?;
        Ok(Bare { renderer, scene, canvas, frame: loaded.frame(0.0) })
    }

    /// Sets up the picture of the application's last frame.
    fn like(&mut self, app: &App) -> Result<(), String> {
        let session = app.session();
        let ([width, height], samples) = (session.facts.size, session.facts.samples);
        let frame = session.loaded.as_ref().ok_or("there is no scene")?.frame(0.0);
        self.frame = Frame { width, height, samples, ..frame };
        Ok(())
    }

    /// Draws a picture for each position of the light and waits for each.
    fn turn(&mut self, lights: &[LightKind]) -> Result<BarePieces, String> {
        let mut costs: Vec<(Cost, f64)> = Vec::new();
        for light in lights {
            let (painted, cost) = measure::here(|| {
                let start = Instant::now();
                if let Some(first) = self.frame.lights.first_mut() {
                    first.kind = *light;
                }
                let painted =
                    self.renderer.paint(&self.scene, &self.frame, &DisplayOptions::default(), &mut self.canvas);
                let submit = start.elapsed().as_secs_f64();
                self.canvas.wait();
                painted.map(|_| submit)
            });
            costs.push((cost, painted.map_err(|e| e.message)?));
        }
        let of = |value: fn(&(Cost, f64)) -> f64| 1e3 * measure::median(costs.iter().map(value));
        Ok(BarePieces { wall: of(|c| c.0.wall_s), cpu: of(|c| c.0.cpu_s), submit: of(|c| c.1) })
    }
}
