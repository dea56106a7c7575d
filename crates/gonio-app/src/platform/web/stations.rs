//! Stations of the page: by a worker with the module of the path tracer (`web/page/stations.js`).

use super::message_of;
use super::trace::{PageTraces, end, set};
use crate::stations::{RequestNumber, StationNews, StationTask};
use gonio_beyond::{LawCheck, RefinedPicture, StationRequest, StationResult};
use gonio_language::tr;
use gonio_plot::PlotFigure;
use js_sys::{Function, Object, Reflect, Uint8Array};
use std::cell::RefCell;
use std::collections::VecDeque;
use std::rc::Rc;
use wasm_bindgen::closure::Closure;
use wasm_bindgen::{JsCast, JsValue};

impl PageTraces {
    /// Starts a worker for stations. If that fails, the task says so.
    pub fn stations(&self, ctx: &egui::Context) -> Box<dyn StationTask> {
        let news: Rc<RefCell<VecDeque<StationNews>>> = Rc::default();
        let (queue, ctx) = (news.clone(), ctx.clone());
        let receive: Closure<dyn FnMut(JsValue)> = Closure::new(move |message: JsValue| {
            queue
                .borrow_mut()
                .push_back(news_of(&message).unwrap_or_else(|| failed(tr!("window-the-worker-s-answer-is-damaged"))));
            ctx.request_repaint();
        });
        let mut task = WorkerStations { worker: self.begin(&receive), news, _receive: receive };
        task.post("stations", JsValue::TRUE);
        Box::new(task)
    }
}

struct WorkerStations {
    worker: Result<JsValue, JsValue>,
    news: Rc<RefCell<VecDeque<StationNews>>>,
    // The worker calls it until it is ended.
    _receive: Closure<dyn FnMut(JsValue)>,
}

impl WorkerStations {
    /// Posts a message with one key.
    fn post(&mut self, key: &str, value: JsValue) {
        let posted = self.worker.clone().and_then(|worker| {
            let message = Object::new();
            set(&message, key, value)?;
            let trace: Function = Reflect::get(&worker, &"trace".into()).and_then(JsCast::dyn_into)?;
            trace.call1(&JsValue::NULL, &message)
        });
        if let Err(error) = posted {
            self.news.borrow_mut().push_back(failed(&message_of(&error)));
        }
    }
}

impl StationTask for WorkerStations {
    fn request(&mut self, number: RequestNumber, request: &StationRequest) {
        let wanted = Object::new();
        let text = serde_json::to_string(request).unwrap_or_default();
        let made = set(&wanted, "number", number.into()).and_then(|()| set(&wanted, "text", text.into()));
        match made {
            Ok(()) => self.post("station", wanted.into()),
            Err(error) => self.news.borrow_mut().push_back(failed(&message_of(&error))),
        }
    }

    fn pause(&mut self) {
        self.post("station", JsValue::NULL);
    }

    fn poll(&mut self) -> Option<StationNews> {
        self.news.borrow_mut().pop_front()
    }
}

impl Drop for WorkerStations {
    fn drop(&mut self) {
        if let Ok(worker) = &self.worker {
            end(worker);
        }
    }
}

fn failed(reason: &str) -> StationNews {
    StationNews::Failed(tr!("window-the-station-cannot-be-computed", reason = reason))
}

/// The news in a message of the worker.
fn news_of(message: &JsValue) -> Option<StationNews> {
    let get = |name: &str| Reflect::get(message, &name.into()).ok().filter(|value| !value.is_undefined());
    let text = |name: &str| get(name)?.as_string();
    let number = |name: &str| Some(get(name)?.as_f64()? as u32);
    if let Some(reason) = text("failed") {
        return Some(failed(&reason));
    }
    if let Some(stations) = text("stations") {
        return Some(StationNews::Stations(serde_json::from_str(&stations).ok()?));
    }
    let result = if let Some(rgb) = get("rgb") {
        let rgb = rgb.dyn_into::<Uint8Array>().ok()?.to_vec();
        let size = [number("width")?, number("height")?];
        StationResult::Picture(RefinedPicture { size, rgb, samples: number("samples")? })
    } else if let Some(plot) = text("plot") {
        StationResult::Plot(serde_json::from_str::<Result<PlotFigure, String>>(&plot).ok()?)
    } else if let Some(checks) = text("checks") {
        StationResult::Checks(serde_json::from_str::<Vec<LawCheck>>(&checks).ok()?)
    } else {
        return Some(StationNews::Finished(number("number")?));
    };
    Some(StationNews::Result(number("number")?, result))
}
