//! The application's state as JSON, for tests and screen readers.
//!
//! Every widget is exported with a stable id; the page exposes the state as
//! `window.gonio.state()`.

use crate::document::{BakedLook, Document, History, Pane, PaneArrangement, Panes};
use crate::session::comparison::{DifferenceFacts, PaneFacts};
use crate::session::probing::Reading;
use crate::session::{MessageSeverity, OwnShaders, RecordedFrame, Selection, Session};
use crate::truth::TracedPane;
use egui::{Context, Id, Response, Ui};
use gonio_check::user_shaders::UserUniform;
use gonio_light::Simplification;
use gonio_scene::SceneFile;
use serde::Serialize;
use serde_json::{Value, json};

/// Kind of a widget.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum WidgetRole {
    /// A button.
    Button,
    /// A switch.
    Toggle,
    /// A number that can be dragged or typed.
    Number,
    /// A choice among several names.
    Choice,
    /// A colour.
    Color,
    /// A tab.
    Tab,
    /// A text, or a field for one.
    Text,
    /// The scene.
    Picture,
    /// A term of the equation.
    Term,
    /// A handle in the picture that can be dragged.
    Handle,
}

/// A widget of the last frame.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Widget {
    /// Stable, kebab-case.
    pub id: String,
    /// Its kind.
    pub role: WidgetRole,
    /// Its label.
    pub label: String,
    /// Its content.
    pub value: String,
    /// Left, top, width and height in points of the window (CSS pixels).
    pub rect: [f32; 4],
    /// The part of the window to which it is clipped, as `rect`: in a list, the widget may be scrolled out of it.
    pub clip: [f32; 4],
    /// Whether it can be used now.
    pub enabled: bool,
    /// Whether it has the keyboard focus.
    pub focused: bool,
}

fn key() -> Id {
    Id::unique("gonio: exported widgets")
}

/// Exports a widget of this frame.
pub fn note(ui: &Ui, response: &Response, id: &str, role: WidgetRole, label: &str, value: impl ToString) {
    let sides = |r: egui::Rect| [r.left(), r.top(), r.width(), r.height()];
    let widget = Widget {
        id: id.to_owned(),
        role,
        label: label.to_owned(),
        value: value.to_string(),
        rect: sides(response.rect),
        clip: sides(ui.clip_rect()),
        enabled: response.enabled(),
        focused: response.has_focus(),
    };
    ui.ctx().data_mut(|data| data.get_temp_mut_or_default::<Vec<Widget>>(key()).push(widget));
}

/// Clears the exported widgets; called at the start of a frame.
pub fn begin(ctx: &Context) {
    ctx.data_mut(|data| data.get_temp_mut_or_default::<Vec<Widget>>(key()).clear());
}

/// The widgets of the last frame.
pub fn widgets(ctx: &Context) -> Vec<Widget> {
    ctx.data(|data| data.get_temp::<Vec<Widget>>(key())).unwrap_or_default()
}

/// Number of triangles of all objects.
pub fn triangles(session: &Session) -> usize {
    let objects = session.loaded.iter().flat_map(|loaded| loaded.objects.iter().map(move |object| (loaded, object)));
    objects.filter_map(|(loaded, object)| loaded.meshes.get(object.mesh)).map(|mesh| mesh.triangle_count()).sum()
}

/// The whole state, one JSON object:
///
/// | key | value |
/// |---|---|
/// | `title`, `loaded`, `busy` | the open scene; whether one is loaded; the files being read, or null |
/// | `error`, `messages` | the last error that was not dismissed, or null; all messages |
/// | `announcement` | the last change |
/// | `scene`, `generation` | the document's effective scene, as in scene files; a count of scenes that were read or uploaded again |
/// | `panes`, `pane`, `pane_settings` | their number; the current one; for each, the settings that differ from the scene, and its view |
/// | `arrangement` | `kind`: side-by-side, wipe or difference; `wipe`: the share left of the divider, or null; `pair`: the two panes |
/// | `measured`, `difference` | measurements of each pane; the difference of the pair in 8-bit steps, or null |
/// | `traced` | for each pane null, or its traced picture: the simplifications, paths per pixel, relative error or null; |
/// | | milliseconds until its first picture, or null, and of the longest frame since it was requested |
/// | `shaders` | null, or the user's own: whether the present texts `failed`, their `remarks`, `serial`, all `uniforms`, |
/// | | the `text` that is shown, or null, and the values at the pinned pixel as in an exercise: `step` |
/// | `selection`, `tab`, `help`, `asking` | the selection, the tab, whether the shortcuts are shown; the text of the path field, or null |
/// | `probe`, `observer`, `ground` | the probed pixel by both renderers, or null; whether the observer's view and the ground are shown |
/// | `recorded_frame` | the recorded frame: its `picture`, `passes`, `draws` and `findings`; null until it is recorded |
/// | `undo`, `redo` | whether there is a step to undo, and one to redo |
/// | `time`, `playing` | time of the scene in seconds, and whether it runs |
/// | `dark`, `pixels_per_point`, `size` | theme and scale; the window's width and height in points |
/// | `exercise`, `bench` | added by [`crate::App::state`]: the open exercise, its messages and its verdict; the BRDF bench |
/// | `stations` | added by it too: the stations beyond the rendering equation |
/// | `gallery` | added by it too: the gallery ([`crate::gallery::GalleryView::state`]) |
/// | `bake` | added by it too: null, or the tab of baking ([`crate::baking::state`]) |
/// | `file` | added by it too: the files of the scene ([`crate::inspector::Inspector::state`]) |
/// | `environment` | added by it too: null, or the panel of the environment ([`crate::environment::state`]) |
/// | `recent` | recently opened files |
/// | `triangles`, `frame` | number in the scene; facts about the last picture: `pictures` and `frames` are constant when idle, |
/// | | and `complete` is true then: the picture has all of the scene's samples |
/// | `widgets` | all widgets: [`Widget`] |
pub fn state(ctx: &Context, document: &Document, session: &Session, history: &History) -> Value {
    let messages: Vec<Value> = session
        .messages
        .list()
        .iter()
        .map(|message| {
            let severity = match message.severity {
                MessageSeverity::Note => "note",
                MessageSeverity::Warning => "warning",
                MessageSeverity::Error => "error",
            };
            json!({
                "id": message.id, "severity": severity, "file": message.file, "text": message.text, "times": message.times,
            })
        })
        .collect();
    let panes: Vec<Value> = document
        .panes
        .list
        .iter()
        .map(|pane| {
            json!({
                "shading": pane.shading.map(|s| s.name()),
                "specular": pane.specular.map(|s| s.name()),
                "convention": pane.convention.map(|c| c.name()),
                "view": pane.view.map(|v| v.to_string()),
                "special": pane.special.map(|v| v.name()),
                "overlays": pane.overlays,
                "baked": pane.baked.map(|look| match look {
                    BakedLook::Materials => "materials",
                    BakedLook::Picture => "picture",
                }),
            })
        })
        .collect();
    let selection = match session.selection {
        Selection::None => Value::Null,
        Selection::Light(index) => json!({ "light": index }),
        Selection::Object(index) => json!({ "object": index }),
        Selection::Part(object, part) => {
            let name = session.loaded.as_ref().map(|loaded| loaded.part_name(object, part));
            json!({ "object": object, "part": part, "part_name": name })
        }
        Selection::Camera => json!("camera"),
    };
    let room = ctx.content_rect();
    json!({
        "title": session.title,
        "loaded": session.loaded.is_some(),
        "busy": session.busy,
        "error": session.messages.last_error(),
        "messages": messages,
        "announcement": session.announcement,
        "triangles": triangles(session),
        "generation": session.generation,
        "pane": document.panes.current,
        "pane_settings": panes,
        "arrangement": arrangement(&document.panes),
        "measured": session.comparison.panes.iter().map(measured).collect::<Vec<_>>(),
        "traced": session.traced.iter().zip(&document.panes.list).map(traced).collect::<Vec<_>>(),
        "difference": session.comparison.difference.as_ref().map(difference),
        "recorded_frame": session.recorded_frame.as_ref().map(recorded_frame),
        "shaders": session.shaders.as_ref().map(shaders),
        "selection": selection,
        "probe": session.probing.reading().map(|reading| probe(reading, session)),
        "observer": session.observer.open,
        "ground": !session.settings.hides_ground,
        "help": session.help,
        "asking": session.asking.as_ref().map(|asking| &asking.text),
        "undo": history.can_undo(document),
        "redo": history.can_redo(),
        "recent": session.settings.recent,
        "pixels_per_point": ctx.pixels_per_point(),
        "size": [room.width(), room.height()],
        "time": session.clock.time,
        "playing": session.clock.playing,
        "tab": session.tab.title(),
        "scene": serde_json::to_value(SceneFile::from(&document.scene)).unwrap_or(Value::Null),
        "panes": document.panes.list.len(),
        "dark": ctx.theme() == egui::Theme::Dark,
        "frame": {
            "size": session.facts.size,
            "draw_ms": session.facts.draw_ms,
            "pictures": session.facts.pictures,
            "complete": session.loaded.as_ref().is_some_and(|l| l.settings.picture.samples == session.facts.samples),
            "frames": session.facts.frames,
            "renderer": session.facts.renderer,
            "notes": session.facts.notes,
        },
        "widgets": widgets(ctx),
    })
}

fn shaders(shaders: &OwnShaders) -> Value {
    let uniforms = shaders.program().map(|program| program.inputs.uniforms()).unwrap_or_default();
    let uniform = |uniform: &UserUniform| json!({ "name": uniform.name, "type": uniform.glsl_type, "origin": uniform.origin(), "values": uniform.values });
    json!({
        "failed": shaders.has_failed(),
        "compiled": shaders.program().is_some(),
        "remarks": shaders.remarks().iter().map(|remark| remark.text.as_str()).collect::<Vec<_>>(),
        "serial": shaders.serial(),
        "text": shaders.is_reading().then_some(&shaders.shown),
        "step": shaders.stepper.state(),
        "uniforms": uniforms.iter().map(uniform).collect::<Vec<_>>(),
    })
}

/// The probed pixel in short; the probe's own button copies everything.
fn probe(reading: &Reading, session: &Session) -> Value {
    json!({
        "pinned": session.probing.pinned.is_some(),
        "pixel": [reading.x, reading.y],
        "object": reading.probe.as_ref().map(|probe| &probe.object_name),
        "triangle": reading.probe.as_ref().map(|probe| probe.triangle),
        "reference": reading.reference,
        "displayed": reading.displayed,
        "gpu": reading.gpu,
        "traced": session.pixel_light().map(|light| reading.ways(light)),
    })
}

fn arrangement(panes: &Panes) -> Value {
    let (kind, wipe) = match panes.arrangement {
        PaneArrangement::SideBySide => ("side-by-side", None),
        PaneArrangement::Wipe(share) => ("wipe", Some(share)),
        PaneArrangement::Difference => ("difference", None),
    };
    json!({ "kind": kind, "wipe": wipe, "pair": panes.pair })
}

fn traced((traced, pane): (&TracedPane, &Pane)) -> Value {
    let Some(settings) = pane.truth else { return Value::Null };
    json!({
        "simplified": settings.simplified.iter().map(Simplification::name).collect::<Vec<_>>(),
        "pictures": traced.serial,
        "requests": traced.requests,
        "paths": traced.facts.paths,
        "error": traced.facts.error,
        "done": traced.facts.done,
        "running": traced.is_running(),
        "first_ms": traced.times.first_ms,
        "longest_ms": traced.times.longest_ms,
        "failed": traced.failed,
    })
}

fn measured(facts: &PaneFacts) -> Value {
    json!({
        "triangles": facts.triangles,
        "vertices": facts.vertices,
        "fragments": facts.fragments,
        "counted": facts.counted,
        "preparing": facts.preparing,
    })
}

fn difference(facts: &DifferenceFacts) -> Value {
    json!({
        "size": facts.size,
        "differing": facts.differing,
        "percent": facts.percent(),
        "spread": facts.spread,
        "psnr_db": facts.psnr_db,
        "worst": facts.worst,
    })
}

/// The record in short: `gonio frame --json` prints all of it.
fn recorded_frame(taken: &RecordedFrame) -> Value {
    let record = &taken.record;
    let passes: Vec<Value> = record
        .passes
        .iter()
        .map(|pass| json!({ "name": pass.name, "target": pass.target.name, "draws": pass.draw_count }))
        .collect();
    let draws: Vec<Value> = record
        .draws
        .iter()
        .map(|draw| {
            let samplers: Vec<Value> =
                draw.samplers.iter().map(|s| json!({ "name": s.name, "unit": s.unit, "texture": s.texture })).collect();
            json!({
                "title": draw.title(),
                "pass": draw.pass,
                "vertices": draw.count,
                "uniforms": draw.uniforms.len(),
                "samplers": samplers,
            })
        })
        .collect();
    json!({
        "picture": taken.picture,
        "chosen": taken.draw,
        "passes": passes,
        "draws": draws,
        "findings": taken.findings,
    })
}
