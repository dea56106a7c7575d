//! The browser: a canvas in a page, dropped files, and checks and traced pictures in workers beside the page.

mod bake;
mod document;
mod stations;
mod trace;

pub use trace::PageTraces;

use super::{
    CheckRequest, CheckResult, Event, FileDialog, FrameShown, MOMENT, Pending, Platform, Purpose, Ready, SceneInput,
};
use crate::baking::{BakeRequest, BakeTask};
use crate::files::link::StationLink;
use crate::files::{ExerciseFile, Layered, MemoryFiles, link, zip};
use crate::saving::Product;
use crate::session::Settings;
use crate::stations::StationTask;
use crate::truth::Tracer;
use gonio_gl::Gl;
use gonio_language::{Language, tr};
use gonio_scene::files::{FileBytes, FileSource, is_builtin};
use js_sys::{Array, Function, Object, Promise, Reflect, Uint8Array};
use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::io::{Error, ErrorKind};
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use wasm_bindgen::{JsCast, JsValue};
use wasm_bindgen_futures::{JsFuture, spawn_local};

/// The built-in files that the page has fetched so far. Clones share them.
#[derive(Clone, Default)]
pub struct PageFiles {
    fetched: Arc<Mutex<BTreeMap<String, Fetched>>>,
}

/// State of a requested file.
enum Fetched {
    NotYet,
    Here(FileBytes),
    Failed,
}

impl PageFiles {
    /// Adds a built-in file, or notes that it could not be fetched: `name` is its path below `assets`.
    pub fn give(&self, name: String, bytes: Option<Vec<u8>>) {
        let fetched = bytes.map_or(Fetched::Failed, |bytes| Fetched::Here(bytes.into()));
        self.lock().insert(name, fetched);
    }

    /// Announces a file that is not one of the samples: reading it waits until it has arrived.
    pub fn expect(&self, name: String) {
        self.lock().entry(name).or_insert(Fetched::NotYet);
    }

    fn lock(&self) -> MutexGuard<'_, BTreeMap<String, Fetched>> {
        self.fetched.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl FileSource for PageFiles {
    fn read_within(&self, _: &Path, _: u64) -> Result<FileBytes, Error> {
        Err(Error::new(ErrorKind::NotFound, tr!("window-only-built-in-files-can-be")))
    }
    fn list(&self, _: &Path) -> Vec<PathBuf> {
        Vec::new()
    }
    fn builtin(&self, name: &str) -> Option<FileBytes> {
        match self.lock().get(name) {
            Some(Fetched::Here(bytes)) => Some(bytes.clone()),
            Some(Fetched::NotYet | Fetched::Failed) | None => None,
        }
    }
    fn is_coming(&self, name: &str) -> bool {
        match self.lock().get(name) {
            Some(fetched) => matches!(fetched, Fetched::NotYet),
            None => is_builtin(name),
        }
    }
}

/// The OpenGL of the canvas.
pub fn gl_of(creation: &eframe::CreationContext<'_>) -> Option<Gl> {
    creation.gl.clone().map(Gl::of_window)
}

/// The browser's side of the application.
pub struct Web {
    files: PageFiles,
    checks: PageChecks,
    traces: PageTraces,
    /// Events since the last poll. Files are read between two frames.
    events: Rc<RefCell<Vec<Event>>>,
}

impl Web {
    /// Creates the platform with the files that the page fetches and its functions for checks and traced pictures.
    pub fn new(files: PageFiles, checks: PageChecks, traces: PageTraces) -> Self {
        Web { files, checks, traces, events: Rc::default() }
    }

    /// Reads files, and turns them into an event.
    fn take(&self, files: Vec<document::NamedFile>, purpose: Purpose, ctx: &egui::Context) {
        let (page, events, ctx) = (self.files.clone(), self.events.clone(), ctx.clone());
        wasm_bindgen_futures::spawn_local(async move {
            let event = match (unpacked(files).await, purpose) {
                (Ok(memory), Purpose::Scene) => Ok(Event::Open(Box::new(scene_input(memory, page)))),
                (Ok(memory), Purpose::Exercise) => exercise_files(&memory).map(Event::ExerciseFiles),
                (Ok(memory), Purpose::Bench) => exercise_files(&memory)
                    .map(|files| Event::BenchFiles(files.into_iter().map(|file| (file.name, file.bytes)).collect())),
                (Err(error), _) => Err(error),
            };
            let event = event.unwrap_or_else(Event::Failed);
            events.borrow_mut().push(event);
            ctx.request_repaint();
        });
    }
}

/// The contents of the files, with zip files unpacked.
async fn unpacked(files: Vec<document::NamedFile>) -> Result<MemoryFiles, String> {
    let mut memory = MemoryFiles::default();
    for file in files {
        let name = file.name.clone();
        let bytes = file.bytes().await.map_err(|error| tr!("window-cannot-be-read", folder = name, error = error))?;
        if zip::is_zip(&bytes) {
            memory.add_all(zip::unpack(&bytes).map_err(|error| format!("`{name}`: {error}"))?);
        } else {
            memory.insert(&name, bytes);
        }
    }
    Ok(memory)
}

/// The files for an exercise; in a page they have no paths.
fn exercise_files(memory: &MemoryFiles) -> Result<Vec<ExerciseFile>, String> {
    let file = |name: String| {
        let bytes = memory
            .read(Path::new(&name))
            .map_err(|error| tr!("window-cannot-be-read", folder = name, error = error))?
            .to_vec();
        Ok(ExerciseFile { name, path: None, bytes })
    };
    memory.names().into_iter().map(file).collect()
}

fn scene_input(memory: MemoryFiles, page: PageFiles) -> SceneInput {
    let names = memory.names();
    // Scenes may also name built-in models, which the page fetches.
    let files = Arc::new(Layered { first: Arc::new(memory), then: Arc::new(page) });
    SceneInput::gathered(names, files)
}

impl Platform for Web {
    fn files(&self) -> Arc<dyn FileSource> {
        Arc::new(self.files.clone())
    }

    fn first(&self) -> Option<Result<SceneInput, String>> {
        let text = link::scene_file(&document::fragment())?;
        Some(text.and_then(|text| {
            let mut memory = MemoryFiles::default();
            memory.insert("linked.toml", text.into_bytes());
            Ok(scene_input(memory, self.files.clone()))
        }))
    }

    fn linked_station(&self) -> Option<StationLink> {
        StationLink::parse(&document::fragment())
    }

    fn choose_files(&mut self, purpose: Purpose, ctx: &egui::Context) -> FileDialog {
        let web = Web {
            files: self.files.clone(),
            checks: self.checks.clone(),
            traces: self.traces.clone(),
            events: self.events.clone(),
        };
        let inner = ctx.clone();
        if let Err(error) = document::choose(move |files| web.take(files, purpose, &inner)) {
            self.events.borrow_mut().push(Event::Failed(error));
            ctx.request_repaint();
        }
        FileDialog::Opened
    }

    fn open_paths(&mut self, paths: Vec<String>, _: Purpose, ctx: &egui::Context) {
        let error = tr!("window-a-web-page-cannot-open-by", names = paths.join(", "));
        self.events.borrow_mut().push(Event::Failed(error));
        ctx.request_repaint();
    }

    fn choose_place(&mut self, product: Product, name: &str, ctx: &egui::Context) -> FileDialog {
        // The browser asks for a place, or uses the downloads folder.
        self.events.borrow_mut().push(Event::SaveTo(product, name.to_owned()));
        ctx.request_repaint();
        FileDialog::Opened
    }

    fn poll(&mut self, purpose: Purpose, ctx: &egui::Context) -> Vec<Event> {
        let dropped = ctx.input(|i| i.raw.dropped_files.clone());
        if !dropped.is_empty() {
            self.take(dropped.into_iter().map(document::NamedFile::dropped).collect(), purpose, ctx);
        }
        std::mem::take(&mut *self.events.borrow_mut())
    }

    fn write(&mut self, place: &str, bytes: &[u8]) -> Result<String, String> {
        document::download(place, bytes).map(|()| place.to_owned())
    }

    fn link(&self, fragment: &str) -> String {
        format!("{}#{fragment}", document::address())
    }

    /// A browser requests another frame once the last one is on its way to the screen.
    fn shown(&mut self, ctx: &egui::Context) -> FrameShown {
        let (seen, ctx) = (Rc::new(Cell::new(false)), ctx.clone());
        let is_seen = seen.clone();
        wasm_bindgen_futures::spawn_local(async move {
            document::frame_shown(MOMENT).await;
            is_seen.set(true);
            ctx.request_repaint();
        });
        Box::new(move |_| seen.get())
    }

    fn expect_check(&mut self) {
        // A checker that cannot be loaded is reported by the check.
        let _ = self.checks.expect.call0(&JsValue::NULL);
    }

    fn check(&mut self, request: CheckRequest, ctx: &egui::Context) -> Box<dyn Pending<CheckResult>> {
        match self.checks.begin(&request, ctx) {
            Ok(checking) => Box::new(checking),
            Err(error) => Box::new(Ready::new(Err(error))),
        }
    }

    fn tracer(&mut self, ctx: &egui::Context) -> Box<dyn Tracer> {
        self.traces.start(ctx)
    }

    fn bake(&mut self, request: BakeRequest, ctx: &egui::Context) -> Box<dyn BakeTask> {
        self.traces.bake(&request, ctx)
    }

    fn stations(&mut self, ctx: &egui::Context) -> Box<dyn StationTask> {
        self.traces.stations(ctx)
    }

    fn asked_language(&self) -> Option<Language> {
        document::parameter("language").as_deref().and_then(Language::from_tag)
    }

    fn preferred_language(&self) -> Language {
        Language::preferred(document::languages().iter().map(String::as_str))
    }

    fn announce_language(&self, language: Language) {
        document::set_language(language.code());
    }

    fn settings(&self) -> Settings {
        document::kept().map_or_else(Settings::default, |text| Settings::from_text(&text))
    }

    fn keep(&mut self, settings: &Settings) {
        document::keep(&settings.to_text());
    }

    fn keep_draft(&mut self, key: &str, text: &str) -> Result<(), String> {
        document::keep_draft(key, text)
    }

    fn remove_draft(&mut self, key: &str) {
        document::remove_draft(key);
    }

    fn take_draft(&mut self, key: &str) -> Option<String> {
        document::take_draft(key)
    }
}

/// The page's functions for checks (`web/page/checking.js`). The arguments of the one that begins a check are the exercise's id, an array of files, each
/// with `name` and `bytes`, whether variants of the lab's own solutions are accepted, and the code of a language. It returns an object: `answer`, a
/// promise of the verdict as JSON, and `end`, a function that stops the check.
#[derive(Clone)]
pub struct PageChecks {
    begin: Function,
    expect: Function,
}

impl PageChecks {
    /// Uses these functions; `expect`, without arguments, loads the checker ahead of a check.
    pub fn new(begin: Function, expect: Function) -> Self {
        PageChecks { begin, expect }
    }

    /// Starts a check. An error is one sentence.
    pub fn begin(&self, request: &CheckRequest, ctx: &egui::Context) -> Result<PageCheck, String> {
        let failed = |error: JsValue| tr!("window-the-check-could-not-be-started", error = message_of(&error));
        let files = Array::new();
        for (name, bytes) in &request.files {
            let file = Object::new();
            Reflect::set(&file, &"name".into(), &name.into()).map_err(failed)?;
            Reflect::set(&file, &"bytes".into(), &Uint8Array::from(bytes.as_slice())).map_err(failed)?;
            files.push(&file);
        }
        let exercise = JsValue::from_str(&request.exercise);
        let language = JsValue::from_str(Language::current().code());
        let arguments = Array::of4(&exercise, &files, &request.as_the_lab.into(), &language);
        let begun = self.begin.apply(&JsValue::NULL, &arguments).map_err(failed)?;
        let promise: Promise = Reflect::get(&begun, &"answer".into()).and_then(JsCast::dyn_into).map_err(failed)?;
        let end: Function = Reflect::get(&begun, &"end".into()).and_then(JsCast::dyn_into).map_err(failed)?;
        let answer = Rc::new(RefCell::new(None));
        let (slot, ctx) = (answer.clone(), ctx.clone());
        spawn_local(async move {
            let verdict = JsFuture::from(promise).await.map_err(|error| message_of(&error)).and_then(|json| {
                let json = json.as_string().unwrap_or_default();
                serde_json::from_str(&json)
                    .map_err(|error| tr!("window-the-verdict-could-not-be-understood", error = error))
            });
            *slot.borrow_mut() = Some(verdict);
            ctx.request_repaint();
        });
        Ok(PageCheck { answer, end })
    }
}

/// The message of a JavaScript error.
fn message_of(error: &JsValue) -> String {
    let message = error.dyn_ref::<js_sys::Error>().map(|error| String::from(error.message()));
    message.or_else(|| error.as_string()).unwrap_or_else(|| format!("{error:?}"))
}

/// A running check.
pub struct PageCheck {
    answer: Rc<RefCell<Option<CheckResult>>>,
    end: Function,
}

impl Pending<CheckResult> for PageCheck {
    fn poll(&mut self) -> Option<CheckResult> {
        self.answer.borrow_mut().take()
    }
}

impl Drop for PageCheck {
    fn drop(&mut self) {
        // A check that has answered ignores this.
        let _ = self.end.call0(&JsValue::NULL);
    }
}
