//! Traced pictures of the page: by a worker per pane, with a module of its own.

use super::message_of;
use crate::baking::BakeRequest;
use crate::truth::{ERROR_GOAL, PixelLight, REPAINT_DELAY, TraceFacts, TraceReply, TraceRequest, Tracer};
use gonio_language::tr;
use gonio_scene::files::FileSource;
use gonio_scene::{Picture, Scene, SceneFile};
use js_sys::{Array, Float32Array, Float64Array, Function, Object, Reflect, Uint8Array, Uint32Array};
use std::cell::RefCell;
use std::path::PathBuf;
use std::rc::Rc;
use wasm_bindgen::closure::Closure;
use wasm_bindgen::{JsCast, JsValue};

/// The page's function that starts a worker (`web/page/tracing.js`). Its argument is a function that receives each picture. It
/// returns an object: `trace`, a function that requests a picture, and `end`, which ends the worker.
#[derive(Clone)]
pub struct PageTraces(Function);

impl PageTraces {
    /// Uses this function.
    pub fn new(begin: Function) -> Self {
        PageTraces(begin)
    }

    /// Starts a worker. If that fails, the tracer says so.
    pub fn start(&self, ctx: &egui::Context) -> Box<dyn Tracer> {
        let answers = Rc::new(RefCell::new(Answers::default()));
        let (slot, ctx) = (answers.clone(), ctx.clone());
        let receive: Closure<dyn FnMut(JsValue)> = Closure::new(move |message: JsValue| {
            slot.borrow_mut().take(&message);
            ctx.request_repaint_after(REPAINT_DELAY);
        });
        let worker = self.begin(&receive).map_err(|error| message_of(&error));
        Box::new(WorkerTracer { worker, answers, before: None, _receive: receive })
    }

    /// Starts a worker, whose messages `receive` gets.
    pub(super) fn begin(&self, receive: &Closure<dyn FnMut(JsValue)>) -> Result<JsValue, JsValue> {
        self.0.call1(&JsValue::NULL, receive.as_ref())
    }
}

/// Ends a worker.
pub(super) fn end(worker: &JsValue) {
    let end = Reflect::get(worker, &"end".into()).and_then(|end| end.dyn_into::<Function>());
    let _ = end.and_then(|end| end.call0(&JsValue::NULL));
}

/// The newest answer to the newest request.
#[derive(Default)]
struct Answers {
    number: f64,
    newest: Option<Result<TraceReply, String>>,
}

impl Answers {
    fn take(&mut self, message: &JsValue) {
        let number = |name: &str| Reflect::get(message, &name.into()).ok().and_then(|value| value.as_f64());
        let is_newest = number("number").is_none_or(|of| of == self.number);
        if let Some(failed) = Reflect::get(message, &"failed".into()).ok().and_then(|value| value.as_string()) {
            if is_newest {
                self.newest = Some(Err(failed));
            }
            return;
        }
        let floats = |name: &str| Reflect::get(message, &name.into()).ok()?.dyn_into::<Float64Array>().ok();
        let pixels =
            Reflect::get(message, &"pixels".into()).ok().and_then(|value| value.dyn_into::<Float32Array>().ok());
        let picture = pixels.zip(number("width")).zip(number("height")).map(|((pixels, width), height)| {
            // One copy: a picture has megabytes, and this is the interface's thread.
            let mut copy = vec![[0.0; 4]; pixels.length() as usize / 4];
            pixels.subarray(0, 4 * copy.len() as u32).copy_to(copy.as_flattened_mut());
            Picture { width: width as u32, height: height as u32, pixels: copy }
        });
        let light = floats("light").and_then(|light| {
            let light = light.to_vec();
            let (&[x, y], numbers) = light.split_first_chunk()?;
            PixelLight::from_numbers([x as u32, y as u32], numbers)
        });
        let done = Reflect::get(message, &"done".into()).is_ok_and(|value| value.is_truthy());
        let facts = TraceFacts {
            paths: number("paths").unwrap_or_default(),
            error: number("error").filter(|error| !error.is_nan()),
            pass: number("pass").unwrap_or_default(),
            done,
        };
        let reply = if is_newest {
            TraceReply { picture, facts: Some(facts), light }
        } else if picture.is_some() {
            TraceReply { picture, facts: None, light: None }
        } else {
            return;
        };
        self.newest = Some(Ok(match self.newest.take() {
            Some(Ok(before)) => before.and(reply),
            _ => reply,
        }));
    }
}

struct WorkerTracer {
    worker: Result<JsValue, String>,
    answers: Rc<RefCell<Answers>>,
    before: Option<TraceRequest>,
    // The worker calls it until it is ended.
    _receive: Closure<dyn FnMut(JsValue)>,
}

impl Tracer for WorkerTracer {
    fn trace(&mut self, request: TraceRequest) {
        let number = {
            let mut answers = self.answers.borrow_mut();
            (answers.number, answers.newest) = (answers.number + 1.0, None);
            answers.number
        };
        let is_known = self.before.as_ref().is_some_and(|before| before.is_same_but_camera(&request));
        let sent = self
            .worker
            .clone()
            .and_then(|worker| send(&worker, number, &request, is_known).map_err(|error| message_of(&error)));
        if let Err(error) = sent {
            let error = tr!("window-the-scene-could-not-be-traced-2", error = error);
            self.answers.borrow_mut().newest = Some(Err(error));
        }
        self.before = Some(request);
    }

    fn probe(&mut self, pixel: Option<[u32; 2]>) {
        if let Ok(worker) = &self.worker {
            // A worker that does not listen has failed, and has said so.
            let _ = post(worker, &Object::new(), pixel);
        }
    }

    fn poll(&mut self) -> Option<Result<TraceReply, String>> {
        self.answers.borrow_mut().newest.take()
    }
}

impl Drop for WorkerTracer {
    fn drop(&mut self) {
        if let Ok(worker) = &self.worker {
            end(worker);
        }
    }
}

/// Sends a request, without the scene if the worker has read it already.
fn send(worker: &JsValue, number: f64, request: &TraceRequest, is_known: bool) -> Result<(), JsValue> {
    let frame = &request.frame;
    let camera = &frame.camera;
    let [position, front, up] = [camera.position, camera.front, camera.up].map(|v| v.to_array());
    let lens = [camera.fov_y_rad, camera.near, camera.far];
    let message = Object::new();
    set(&message, "number", number.into())?;
    set(&message, "width", frame.width.into())?;
    set(&message, "height", frame.height.into())?;
    set(&message, "camera", Float64Array::from([position, front, up, lens].concat().as_slice()).into())?;
    if !is_known {
        let scene = described(&request.scene, frame.time, &*request.files, &request.paths)?;
        set(&scene, "simplified", request.settings.simplified.bits().into())?;
        set(&scene, "points", request.settings.points_per_light.into())?;
        set(&scene, "goal", ERROR_GOAL.into())?;
        set(&message, "scene", scene.into())?;
    }
    post(worker, &message, request.pixel)
}

/// Sends a scene to bake.
pub(super) fn send_bake(worker: &JsValue, request: &BakeRequest) -> Result<(), JsValue> {
    let message = Object::new();
    let job = serde_json::to_string(&request.job).map_err(|error| JsValue::from_str(&error.to_string()))?;
    set(&message, "job", job.into())?;
    set(&message, "stem", JsValue::from_str(&request.stem))?;
    set(&message, "scene", described(&request.scene, request.time, &*request.files, &request.paths)?.into())?;
    post(worker, &message, None)
}

/// A scene at a time in seconds, with the files at `paths`, for a worker that reads it again.
fn described(scene: &Scene, time: f64, source: &dyn FileSource, paths: &[PathBuf]) -> Result<Object, JsValue> {
    let described = Object::new();
    set(&described, "text", SceneFile::from(&scene.settings).to_toml_string().into())?;
    let files = Array::new();
    for path in paths {
        // Files that are not there were looked for in vain.
        if let Ok(bytes) = source.read(path) {
            let file = Object::new();
            set(&file, "name", JsValue::from_str(&path.to_string_lossy()))?;
            set(&file, "bytes", Uint8Array::from(&bytes[..]).into())?;
            files.push(&file);
        }
    }
    set(&described, "files", files.into())?;
    set(&described, "time", time.into())?;
    Ok(described)
}

pub(super) fn set(object: &Object, name: &str, value: JsValue) -> Result<(), JsValue> {
    Reflect::set(object, &name.into(), &value).map(drop)
}

/// Posts a message with the probed pixel; without a camera the worker goes on with the picture that it has.
fn post(worker: &JsValue, message: &Object, pixel: Option<[u32; 2]>) -> Result<(), JsValue> {
    if let Some(pixel) = pixel {
        set(message, "pixel", Uint32Array::from(&pixel[..]).into())?;
    }
    let trace: Function = Reflect::get(worker, &"trace".into()).and_then(JsCast::dyn_into)?;
    trace.call1(&JsValue::NULL, message).map(drop)
}
