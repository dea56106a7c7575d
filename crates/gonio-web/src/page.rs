//! Functions that the page's loader calls.

use crate::access;
use eframe::egui;
use gonio_app::App;
use gonio_app::platform::web::{PageChecks, PageFiles, PageTraces, Web, gl_of};
use gonio_check::verdict::Verdict;
use std::cell::RefCell;
use std::rc::Rc;
use wasm_bindgen::prelude::*;

/// State that lives as long as the page.
#[derive(Default)]
struct Page {
    files: PageFiles,
    runner: Option<eframe::WebRunner>,
    context: Option<egui::Context>,
    /// Outlives the runner: if the browser resets the graphics, a new runner continues with the same application.
    app: Option<Rc<RefCell<App>>>,
}

thread_local! {
    // The loader calls plain functions; there is one page, and one thread.
    static PAGE: RefCell<Page> = RefCell::default();
}

fn with_page<T>(act: impl FnOnce(&mut Page) -> T) -> T {
    PAGE.with(|page| act(&mut page.borrow_mut()))
}

/// Adds a built-in file, or notes that it could not be fetched (without bytes); `name` is its path below `assets`.
#[wasm_bindgen]
pub fn give(name: String, bytes: Option<Vec<u8>>) {
    with_page(|page| {
        page.files.give(name, bytes);
        // A scene may be waiting for it.
        if let Some(context) = &page.context {
            context.request_repaint();
        }
    });
}

/// Announces a file that is not a sample: `name` is its path below `builtin:`.
#[wasm_bindgen]
pub fn expect(name: String) {
    with_page(|page| page.files.expect(name));
}

/// Starts the application in the canvas with `inputs` to open (none: the first scene), or resumes it after
/// [`pause`]. `check` starts a check of a student's files and `expect_check` announces one (`web/page/checking.js`); `trace` starts
/// a worker for traced pictures (`web/page/tracing.js`). Fails if the canvas has no WebGL 2.
#[wasm_bindgen]
pub async fn start(
    canvas: web_sys::HtmlCanvasElement,
    inputs: Vec<String>,
    check: js_sys::Function,
    expect_check: js_sys::Function,
    trace: js_sys::Function,
) -> Result<(), JsValue> {
    let runner = eframe::WebRunner::new();
    with_page(|page| page.runner = Some(runner.clone()));
    let options = eframe::WebOptions {
        webgl_context_option: eframe::WebGlContextOption::WebGl2,
        // Pictures must equal those of `gonio render`.
        dithering: false,
        ..Default::default()
    };
    let (checks, traces) = (PageChecks::new(check, expect_check), PageTraces::new(trace));
    let created = |creation: &eframe::CreationContext<'_>| -> Result<Box<dyn eframe::App>, _> {
        Ok(Box::new(with_page(|page| page.app(creation, inputs, checks, traces))))
    };
    runner.start(canvas, options, Box::new(created)).await
}

/// The verdict on a check that was ended after so many seconds, as JSON.
#[wasm_bindgen]
pub fn endless_check(exercise: &str, seconds: u32) -> Result<String, String> {
    let verdict = Verdict::endless(exercise, u64::from(seconds));
    serde_json::to_string(&verdict).map_err(|error| format!("the verdict cannot be written: {error}"))
}

/// Stops drawing until the next [`start`], because the graphics context is lost.
#[wasm_bindgen]
pub fn pause() {
    let (runner, app) = with_page(|page| (page.runner.take(), page.app.clone()));
    if let Some(app) = app {
        // Called here because eframe's web runner does not call it, and resources of the old context cannot be deleted later.
        eframe::App::on_exit(&mut *app.borrow_mut(), None);
    }
    // Outside of the borrow of the page, because destroying the runner drops its part of the application.
    if let Some(runner) = runner {
        runner.destroy();
    }
}

/// Number of pictures of the scene and of stations since the page was loaded.
#[wasm_bindgen]
pub fn pictures() -> f64 {
    let count = |app: &App| app.session().facts.pictures + app.stations().pictures();
    with_page(|page| page.app.as_ref().map_or(0.0, |app| count(&app.borrow()) as f64))
}

/// The application's state as JSON: `gonio_app::exported`. Before it is started and after a panic: `null`.
#[wasm_bindgen]
pub fn state() -> String {
    let state = with_page(|page| Some(page.app.as_ref()?.try_borrow().ok()?.state(page.context.as_ref()?).to_string()));
    state.unwrap_or_else(|| "null".to_owned())
}

/// Message and call stack of a panic, if the application has panicked.
#[wasm_bindgen]
pub fn last_panic() -> Option<String> {
    // After a panic, borrows may still be held.
    let runner = PAGE.with(|page| page.try_borrow().ok()?.runner.clone())?;
    runner.panic_summary().map(|summary| format!("{}\n\n{}", summary.message(), summary.callstack()))
}

/// Turns support for screen readers on: `receive` gets every change of the accessibility tree (`web/page/access.js`).
#[wasm_bindgen]
pub fn turn_access_on(receive: js_sys::Function) {
    if let Some(context) = with_page(|page| page.context.clone()) {
        access::start(&context, receive);
    }
}

/// Turns it off.
#[wasm_bindgen]
pub fn turn_access_off() {
    if let Some(context) = with_page(|page| page.context.clone()) {
        access::stop(&context);
    }
}

/// An action on an element of the mirror: `click`, `focus`, `scroll-into-view`, `set-value`, `increment` or `decrement`.
#[wasm_bindgen]
pub fn access_act(id: &str, action: &str, value: JsValue) -> bool {
    access::act(id, action, &value) && repaint()
}

/// A key pressed on an element of the mirror, by the name in its event. False if the application has no use for it.
#[wasm_bindgen]
pub fn access_key(name: &str, ctrl: bool, shift: bool, alt: bool, meta: bool) -> bool {
    access::key(name, [ctrl, shift, alt, meta]) && repaint()
}

/// Notes whether an element of the mirror has the focus.
#[wasm_bindgen]
pub fn access_focus(has_focus: bool) {
    access::set_focus(has_focus);
}

/// Draws the next frame soon. False before the start.
fn repaint() -> bool {
    let context = with_page(|page| page.context.clone());
    context.is_some_and(|context| {
        context.request_repaint();
        true
    })
}

impl Page {
    fn app(
        &mut self,
        creation: &eframe::CreationContext<'_>,
        inputs: Vec<String>,
        checks: PageChecks,
        traces: PageTraces,
    ) -> Shell {
        let context = creation.egui_ctx.clone();
        if let Some(before) = self.context.replace(context.clone()) {
            // Scroll positions and open panels are kept.
            let memory = before.memory(Clone::clone);
            context.memory_mut(|new| *new = memory);
        }
        access::resume(&context);
        let gl = gl_of(creation);
        let app = match &self.app {
            Some(app) => {
                app.borrow_mut().resume(&context, gl);
                app.clone()
            }
            None => {
                let platform = Box::new(Web::new(self.files.clone(), checks, traces));
                Rc::new(RefCell::new(App::new(&context, gl, platform, inputs)))
            }
        };
        self.app = Some(app.clone());
        Shell { app, announced: String::new() }
    }
}

/// The application as an eframe application.
struct Shell {
    app: Rc<RefCell<App>>,
    /// Content of the page's live region.
    announced: String,
}

impl Shell {
    /// Announces a change to screen readers.
    fn announce(&mut self, announcement: &str) {
        if announcement == self.announced {
            return;
        }
        announcement.clone_into(&mut self.announced);
        let region = web_sys::window().and_then(|w| w.document()).and_then(|d| d.get_element_by_id("announcement"));
        if let Some(region) = region {
            region.set_text_content(Some(announcement));
        }
    }
}

impl eframe::App for Shell {
    // Panels draw no background of their own.
    fn clear_color(&self, visuals: &egui::Visuals) -> [f32; 4] {
        eframe::App::clear_color(&*self.app.borrow(), visuals)
    }

    fn raw_input_hook(&mut self, _: &egui::Context, input: &mut egui::RawInput) {
        access::add_events(input);
    }

    fn ui(&mut self, ui: &mut egui::Ui, _: &mut eframe::Frame) {
        let app = self.app.clone();
        let mut app = app.borrow_mut();
        App::ui(&mut app, ui);
        self.announce(&app.session().announcement);
    }
}
