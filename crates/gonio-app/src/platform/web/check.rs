//! A check in a worker beside the page, which may be ended whatever a shader does: `web/page/checking.js`.

use crate::platform::{CheckRequest, CheckResult, Pending};
use js_sys::{Array, Function, Object, Promise, Reflect, Uint8Array};
use std::cell::RefCell;
use std::rc::Rc;
use wasm_bindgen::{JsCast, JsValue};
use wasm_bindgen_futures::{JsFuture, spawn_local};

/// The page's function that begins a check: it is given the exercise's word, an array of files, each with `name` and
/// `bytes`, and whether the lab's own ways pass. It gives an object: `answer`, a promise of the verdict as JSON, and
/// `end`, a function that gives the check up.
#[derive(Clone)]
pub struct PageChecks(Function);

impl PageChecks {
    /// Uses this function.
    pub fn new(begin: Function) -> Self {
        PageChecks(begin)
    }

    /// Starts a check. An error is one sentence.
    pub fn begin(&self, request: &CheckRequest, ctx: &egui::Context) -> Result<PageCheck, String> {
        let failed = |why: JsValue| format!("the check could not be started: {}", words(&why));
        let files = Array::new();
        for (name, bytes) in &request.files {
            let file = Object::new();
            Reflect::set(&file, &"name".into(), &name.into()).map_err(failed)?;
            Reflect::set(&file, &"bytes".into(), &Uint8Array::from(bytes.as_slice())).map_err(failed)?;
            files.push(&file);
        }
        let exercise = JsValue::from_str(&request.exercise);
        let begun = self.0.call3(&JsValue::NULL, &exercise, &files, &request.as_the_lab.into()).map_err(failed)?;
        let promise: Promise = Reflect::get(&begun, &"answer".into()).and_then(JsCast::dyn_into).map_err(failed)?;
        let end: Function = Reflect::get(&begun, &"end".into()).and_then(JsCast::dyn_into).map_err(failed)?;
        let answer = Rc::new(RefCell::new(None));
        let (told, ctx) = (answer.clone(), ctx.clone());
        spawn_local(async move {
            let verdict = JsFuture::from(promise).await.map_err(|why| words(&why)).and_then(|json| {
                let json = json.as_string().unwrap_or_default();
                serde_json::from_str(&json).map_err(|why| format!("the verdict could not be understood: {why}"))
            });
            *told.borrow_mut() = Some(verdict);
            ctx.request_repaint();
        });
        Ok(PageCheck { answer, end })
    }
}

/// The message of a JavaScript error.
fn words(why: &JsValue) -> String {
    let message = why.dyn_ref::<js_sys::Error>().map(|error| String::from(error.message()));
    message.or_else(|| why.as_string()).unwrap_or_else(|| format!("{why:?}"))
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
