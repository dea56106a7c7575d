//! Steps through the shaders of a picture at one of its pixels, in an exercise or the user's own on a scene: the values beside the lines, the variables at each step, and the
//! value and the picture of the expression under the pointer.
//!
//! | file | contents |
//! |---|---|
//! | `source` | the pictures and their programs |
//! | `values` | a shader's steps: values by line, variables, movements |
//! | `bar` | the buttons and keys, and the table of variables |
//! | `code` | the text of a file with line numbers, marks and colours |
//! | `typing`, `find` | keys of the editor beyond a text field's own; the search in a text |
//! | `margin` | the values beside the lines, the expression under the pointer, and the work beside the interface |
//!
//! The interpreter runs beside the interface ([`Platform::run`]). Requests are made from what is drawn; an answer is shown until
//! the next one, so that values stay visible while the camera moves.

pub mod bar;
pub mod code;
pub mod find;
pub mod margin;
pub mod source;
mod typing;
pub mod values;

use crate::platform::Platform;
use egui::{Context, Rect, TextureHandle};
use gonio_exercises::step::{RightAnswer, SteppedPlace};
use gonio_glsl::Stage;
use gonio_language::tr;
use margin::{Hovered, Listed, Pin, Request, Target};
use serde_json::{Value, json};
use source::{DrawnProgram, SteppedPicture};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::time::Duration;
use values::{Movement, ShaderSteps, VariableRow};
use web_time::Instant;

/// Time without a change until the values of another camera, time or program are computed.
const PAUSE: Duration = Duration::from_millis(150);
/// The same while the changes do not end.
const LONG_PAUSE: Duration = Duration::from_millis(500);

enum Answer {
    Listed(Result<Box<Listed>, String>),
    Hovered(Option<Box<Hovered>>),
    Compared(Option<Arc<RightAnswer>>),
}

/// Time that the pointer rests on a character.
const REST: Duration = Duration::from_millis(200);

/// The pointed character and the answer about it.
#[derive(Default)]
pub struct Hover {
    /// The character, its place in the window, and since when.
    target: Option<(Target, Rect, Instant)>,
    /// Whether the cursor is meant in place of the pointer.
    pub at_cursor: bool,
    asked: Option<Target>,
    /// The answer; nothing if there is no expression.
    answer: Option<(Target, Option<Hovered>)>,
    textures: Vec<TextureHandle>,
}

impl Hover {
    /// Notes the character under the pointer or at the cursor, and its place in the window.
    pub fn point(&mut self, target: Option<(Target, Rect)>) {
        self.target = target.map(|(target, rect)| match self.target {
            Some((before, _, since)) if before == target => (target, rect, since),
            _ => (target, rect, Instant::now()),
        });
    }

    /// The character whose answer is to be computed now.
    pub fn due(&mut self, ctx: &Context) -> Option<Target> {
        let (target, _, since) = self.target?;
        if self.asked == Some(target) {
            return None;
        }
        let left = REST.saturating_sub(since.elapsed());
        if !left.is_zero() {
            ctx.request_repaint_after(left);
            return None;
        }
        self.asked = Some(target);
        Some(target)
    }

    /// Takes an answer.
    pub fn take(&mut self, hovered: Option<Hovered>) {
        self.answer = self.asked.map(|target| (target, hovered));
        self.textures.clear();
    }

    /// Forgets the answer: the values are others.
    pub fn forget(&mut self) {
        // The old answer stays visible until the next one.
        self.asked = None;
    }

    /// The answer, while the pointer is at its expression.
    pub fn shown(&self) -> Option<&Hovered> {
        let ([line, column], ..) = self.target?;
        let (target, hovered) = self.answer.as_ref()?;
        let hovered = hovered.as_ref()?;
        let value = &hovered.value;
        let is_inside = value.line == line && (value.column..value.column + value.length.max(1)).contains(&column);
        (is_inside || *target == [line, column]).then_some(hovered)
    }
}

/// The pinned pixel and its values.
#[derive(Default)]
pub struct Stepper {
    pin: Option<Pin>,
    /// The picture in this frame.
    drawn: Option<SteppedPicture>,
    /// The last listing, or one sentence on why there is none, and its request.
    listed: Option<(Request, Result<Box<Listed>, String>)>,
    running: Option<(Request, Receiver<Answer>)>,
    /// The newest request, when it changed last, and when the last job was started.
    newest: Option<(Request, Instant)>,
    started: Option<Instant>,
    stage: Option<Stage>,
    /// The corner that is shown; by default the nearest one.
    corner: Option<usize>,
    /// A line to scroll to, in the file of the current shader.
    scroll: Option<u32>,
    /// Whether the file of the current shader is to be shown.
    shows_file: bool,
    hover: Hover,
    /// The right answer for a program; nothing if its values cannot be judged.
    compared: Option<(Arc<DrawnProgram>, Option<Arc<RightAnswer>>)>,
    is_new: bool,
    /// Whether the program compiled, but its picture is not drawn yet.
    is_awaited: bool,
}

impl Stepper {
    /// Pins a pixel: shares of the picture's width and height from the top left.
    pub fn pin(&mut self, share: [f32; 2]) {
        // A picture without any height has no shares.
        let share = share.map(|share| if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.5 });
        self.pin_at(Pin { share, is_nearest: false });
    }

    /// Pins the drawn pixel that is nearest to the picture's middle.
    pub fn pin_middle(&mut self) {
        self.pin_at(Pin { share: [0.5; 2], is_nearest: true });
    }

    fn pin_at(&mut self, pin: Pin) {
        (self.pin, self.corner, self.is_new) = (Some(pin), None, true);
        self.is_awaited = self.drawn.is_none();
    }

    /// Whether a pixel was pinned since the last call.
    pub fn is_new(&mut self) -> bool {
        std::mem::take(&mut self.is_new)
    }

    /// Removes the pin and the values.
    pub fn unpin(&mut self) {
        *self = Stepper { drawn: self.drawn.take(), ..Stepper::default() };
    }

    /// Whether a pixel is pinned.
    pub fn is_pinned(&self) -> bool {
        self.pin.is_some()
    }

    /// The pinned place as shares of the picture's width and height from the top left.
    pub fn pinned(&self) -> Option<[f32; 2]> {
        self.pin.filter(|pin| !pin.is_nearest).map(|pin| pin.share)
    }

    /// Moves the pinned pixel by whole pixels.
    fn move_pin(&mut self, by: [i32; 2]) {
        let Some((pin, drawn)) = self.pin.as_mut().zip(self.drawn.as_ref()) else { return };
        let (pixel, size) = (drawn.pixel(pin.share), drawn.size());
        for axis in 0..2 {
            let moved = (pixel[axis].saturating_add_signed(by[axis])).min(size[axis].saturating_sub(1));
            pin.share[axis] = (moved as f32 + 0.5) / size[axis].max(1) as f32;
        }
        self.corner = None;
    }

    /// Notes the picture of this frame, if it is stepped through.
    pub fn note_picture(&mut self, picture: impl FnOnce() -> Option<SteppedPicture>) {
        let drawn = if self.is_pinned() { picture().filter(|picture| !picture.size().contains(&0)) } else { None };
        if let (Some(before), Some(now), Some(pin)) = (&self.drawn, &drawn, &mut self.pin) {
            pin.share = now.same_place(pin.share, before);
        }
        self.drawn = drawn;
        self.is_awaited = false;
    }

    /// Notes that the program compiled; without its picture, the values are awaited.
    pub fn note_compiled(&mut self) {
        self.is_awaited = self.drawn.is_none();
    }

    fn listing(&self) -> Option<&Listed> {
        self.listed.as_ref()?.1.as_deref().ok()
    }

    /// The steps of the current shader.
    pub fn current(&self) -> Option<&ShaderSteps> {
        let (stage, corner, listed) = (self.stage(), self.corner(), self.listing()?);
        if stage == Stage::Vertex { listed.corners.get(corner).map(|steps| &**steps) } else { Some(&listed.fragment) }
    }

    fn current_mut(&mut self) -> Option<&mut ShaderSteps> {
        let (stage, corner) = (self.stage(), self.corner());
        let listed = self.listed.as_mut()?.1.as_deref_mut().ok()?;
        let steps = if stage == Stage::Vertex { listed.corners.get_mut(corner)? } else { &mut listed.fragment };
        // Nothing else holds it between two frames, so nothing is copied.
        Some(Arc::make_mut(steps))
    }

    /// The shader that is stepped through.
    pub fn stage(&self) -> Stage {
        self.stage.unwrap_or(Stage::Fragment)
    }

    fn corner(&self) -> usize {
        self.corner.unwrap_or_else(|| self.nearest_corner())
    }

    fn nearest_corner(&self) -> usize {
        let shares = self.listing().map_or([1.0, 0.0, 0.0], |listed| listed.surface.shares);
        (0..3).max_by(|a, b| shares[*a].total_cmp(&shares[*b])).unwrap_or(0)
    }

    /// The pinned pixel of the shown values.
    pub fn pixel(&self) -> Option<[u32; 2]> {
        self.listing().map(|listed| listed.pixel)
    }

    /// The reason why there are no values, in one sentence.
    pub fn message(&self) -> Option<&str> {
        let listed = self.listed.as_ref().map(|(_, listed)| listed);
        match listed {
            Some(listed) => listed.as_ref().err().map(String::as_str),
            None => {
                (self.drawn.is_none() && !self.is_awaited).then_some(tr!("exercise-the-values-are-shown-once-your"))
            }
        }
    }

    /// Whether values are being computed.
    pub fn is_running(&self) -> bool {
        self.running.is_some() || self.is_outdated() || self.is_pinned() && self.is_awaited
    }

    fn is_outdated(&self) -> bool {
        let wanted = self.request();
        wanted.is_some() && wanted.as_ref() != self.listed.as_ref().map(|(request, _)| request)
    }

    /// Moves to another step of the current shader, and scrolls to it.
    pub fn go(&mut self, movement: Movement) {
        if let Some(steps) = self.current_mut() {
            steps.go(movement);
            self.scroll = self.current().and_then(ShaderSteps::step).map(|step| step.line);
            self.shows_file = true;
        }
    }

    /// Goes to the last step of a line.
    fn go_to_line(&mut self, line: u32) {
        if let Some(steps) = self.current_mut() {
            steps.go_to_line(line);
            (self.scroll, self.shows_file) = (Some(line), true);
        }
    }

    /// The steps of the shader in a file with this name and text, if the text is the one that was run.
    pub fn steps_in(&self, name: &str, text: &str) -> Option<Arc<ShaderSteps>> {
        let (request, listed) = self.listed.as_ref()?;
        let listed = listed.as_deref().ok()?;
        let content = request.picture.content().iter().find(|file| file.name == name)?;
        if content.bytes != text.as_bytes() {
            return None;
        }
        let vertex = listed.corners.get(self.corner())?;
        let both = [&listed.fragment, vertex];
        let current = both[usize::from(self.stage() == Stage::Vertex)];
        [current].into_iter().chain(both).find(|steps| steps.listing.file == name).cloned()
    }

    /// Follows the file in the editor: another file shows another shader. Returns the file to show after a step.
    pub fn follow_file(&mut self, current: &str) -> Option<String> {
        let file = self.current()?.listing.file.clone();
        if file == current {
            self.shows_file = false;
            return None;
        }
        if std::mem::take(&mut self.shows_file) {
            return Some(file);
        }
        let other = if self.stage() == Stage::Vertex { Stage::Fragment } else { Stage::Vertex };
        let before = self.stage.replace(other);
        if self.current().is_none_or(|steps| steps.listing.file != current) {
            self.stage = before;
        }
        None
    }

    /// The exported state: see `state_json`.
    pub fn state(&self) -> Value {
        if !self.is_pinned() {
            return Value::Null;
        }
        let stage = if self.stage() == Stage::Vertex { "vertex" } else { "fragment" };
        let mut state = json!({
            "pixel": self.pixel(),
            "busy": self.is_running(),
            "message": self.message(),
            "stage": stage,
        });
        if let Some((steps, step)) = self.current().and_then(|steps| Some((steps, steps.step()?))) {
            let values = steps.lines().iter().map(|(line, values)| json!({ "line": line, "text": values.text }));
            let variable = |row: &VariableRow| json!({ "name": row.name, "value": row.value.to_string(), "changed": row.is_changed });
            state["step"] = (steps.at() + 1).into();
            state["steps"] = steps.listing.steps.len().into();
            state["line"] = step.line.into();
            state["function"] = step.function.as_str().into();
            state["iterations"] = json!(step.iterations);
            state["values"] = values.collect();
            state["variables"] = steps.variables().iter().map(variable).collect();
            let hovered = self.hover.shown();
            let pictures = hovered.and_then(|hovered| hovered.pictures.as_ref().ok());
            state["expression"] = hovered.map(|hovered| hovered.value.expression.as_str()).into();
            state["quantity"] = pictures.and_then(|both| both.quantity.as_deref()).into();
            state["right_beside"] = pictures.is_some_and(|both| both.right.is_some()).into();
        }
        state
    }

    fn request(&self) -> Option<Request> {
        Some(Request { picture: self.drawn.clone()?, pin: self.pin? })
    }

    /// Takes answers and starts the next job; called in every frame.
    pub fn follow(&mut self, ctx: &Context, platform: &mut dyn Platform) {
        self.take_answer();
        let Some(request) = self.request() else { return };
        let now = Instant::now();
        if self.newest.as_ref().is_none_or(|(newest, _)| *newest != request) {
            self.newest = Some((request.clone(), now));
        }
        if self.running.is_some() {
            return;
        }
        let before = self.listed.as_ref().map(|(request, _)| request);
        if before == Some(&request) {
            self.follow_hover(ctx, platform, &request);
            return;
        }
        // Another pixel is listed at once; a picture that changes, when it has stopped.
        if before.is_some_and(|before| before.picture != request.picture) {
            let still = self.newest.as_ref().map_or(PAUSE, |(_, since)| now - *since);
            let waited = self.started.map_or(LONG_PAUSE, |started| now - started);
            if still < PAUSE && waited < LONG_PAUSE {
                ctx.request_repaint_after(PAUSE - still);
                return;
            }
        }
        self.started = Some(now);
        let reused = self.listing().map(|listed| (listed.pair.clone(), listed.scene.clone()));
        let reused = reused.zip(before.cloned());
        let of = request.clone();
        self.start(ctx, platform, request, move || Answer::Listed(margin::list(&of, reused).map(Box::new)));
    }

    fn start(
        &mut self,
        ctx: &Context,
        platform: &mut dyn Platform,
        request: Request,
        work: impl FnOnce() -> Answer + Send + 'static,
    ) {
        let (sender, receiver) = channel();
        let ctx = ctx.clone();
        platform.run(Box::new(move || {
            // Nobody waits for it if the pin was removed.
            let _ = sender.send(work());
            ctx.request_repaint();
        }));
        self.running = Some((request, receiver));
        self.take_answer();
    }

    fn take_answer(&mut self) {
        let Some((request, receiver)) = &self.running else { return };
        let answer = match receiver.try_recv() {
            Ok(answer) => answer,
            Err(TryRecvError::Empty) => return,
            Err(TryRecvError::Disconnected) => {
                Answer::Listed(Err(tr!("exercise-the-values-could-not-be-computed").to_owned()))
            }
        };
        let mut request = request.clone();
        self.running = None;
        match answer {
            Answer::Hovered(hovered) => self.hover.take(hovered.map(|hovered| *hovered)),
            Answer::Compared(right) => {
                if right.is_some() {
                    self.hover.forget();
                }
                self.compared = request.picture.of_exercise().cloned().map(|program| (program, right));
            }
            Answer::Listed(mut listed) => {
                if let Ok(listed) = &mut listed {
                    if request.pin.is_nearest {
                        let size = request.picture.size();
                        let share = [0, 1].map(|axis| (listed.pixel[axis] as f32 + 0.5) / size[axis].max(1) as f32);
                        let found = Pin { share, is_nearest: false };
                        if self.pin == Some(request.pin) {
                            self.pin = Some(found);
                        }
                        request.pin = found;
                    }
                    self.keep_steps(listed);
                    if self.listed.is_none() {
                        self.scroll = listed.fragment.step().map(|step| step.line);
                    }
                }
                self.hover.forget();
                self.listed = Some((request, listed));
            }
        }
    }

    /// Stays at the same step if the shaders take the same way as before.
    fn keep_steps(&self, listed: &mut Listed) {
        let Some(before) = self.listing() else { return };
        let all = std::iter::once(&mut listed.fragment).chain(&mut listed.corners);
        for (steps, before) in all.zip(std::iter::once(&before.fragment).chain(&before.corners)) {
            let lines = |steps: &ShaderSteps| steps.listing.steps.iter().map(|step| step.line).collect::<Vec<_>>();
            if lines(steps) == lines(before) {
                Arc::make_mut(steps).go(Movement::To(before.at()));
            }
        }
    }

    /// The pixel or vertex of the current shader.
    fn place(&self) -> Option<SteppedPlace> {
        let (request, listed) = self.listed.as_ref()?;
        let listed = listed.as_deref().ok()?;
        Some(match self.stage() {
            Stage::Vertex => SteppedPlace::Vertex(listed.surface.vertices[self.corner()]),
            Stage::Fragment => SteppedPlace::Pixel(request.picture.in_scene(listed.pixel)),
        })
    }

    fn follow_hover(&mut self, ctx: &Context, platform: &mut dyn Platform, request: &Request) {
        let (Some(place), Some(listed)) = (self.place(), self.listing()) else { return };
        let (pair, scene) = (listed.pair.clone(), listed.scene.clone());
        // The user's own shaders have no right answer.
        let program = request.picture.of_exercise();
        let is_same = |compared: &Arc<DrawnProgram>| program.is_some_and(|program| Arc::ptr_eq(compared, program));
        let compared = self.compared.as_ref().filter(|(compared, _)| is_same(compared));
        let right = compared.and_then(|(_, right)| right.clone());
        let uncompared = program.filter(|_| compared.is_none()).cloned();
        if let Some(target) = self.hover.due(ctx) {
            let picture = request.picture.clone();
            let work = move || {
                let hovered = margin::evaluate(&pair, &scene, &picture, place, target, right.as_deref());
                Answer::Hovered(hovered.map(Box::new))
            };
            self.start(ctx, platform, request.clone(), work);
        } else if let Some(program) = uncompared.filter(|_| self.hover.shown().is_some()) {
            // The own value is shown before.
            let work = move || Answer::Compared(RightAnswer::new(program.exercise, &program.source).map(Arc::new));
            self.start(ctx, platform, request.clone(), work);
        }
    }
}
