//! Bakes of the page: by a worker with the module of the path tracer.

use super::message_of;
use super::trace::PageTraces;
use crate::baking::{BakeReply, BakeRequest, BakeTask};
use gonio_atlas::AtlasUv;
use gonio_bake::{BakedAtlas, MapKind, MapPicture};
use gonio_image::EncodedPicture;
use gonio_language::tr;
use js_sys::{Array, Float32Array, Reflect, Uint8Array, Uint32Array};
use std::cell::RefCell;
use std::collections::VecDeque;
use std::rc::Rc;
use wasm_bindgen::closure::Closure;
use wasm_bindgen::{JsCast, JsValue};

impl PageTraces {
    /// Starts a bake in a worker. If that fails, the task says so.
    pub fn bake(&self, request: &BakeRequest, ctx: &egui::Context) -> Box<dyn BakeTask> {
        let replies: Rc<RefCell<VecDeque<BakeReply>>> = Rc::default();
        let (queue, ctx) = (replies.clone(), ctx.clone());
        let receive: Closure<dyn FnMut(JsValue)> = Closure::new(move |message: JsValue| {
            queue.borrow_mut().push_back(reply(&message));
            ctx.request_repaint();
        });
        let worker = self.begin(&receive);
        let sent = worker
            .as_ref()
            .map_err(|error| message_of(error))
            .and_then(|worker| super::trace::send_bake(worker, request).map_err(|error| message_of(&error)));
        if let Err(error) = sent {
            replies
                .borrow_mut()
                .push_back(BakeReply::Failed(tr!("window-the-textures-could-not-be-baked-3", error = error)));
        }
        Box::new(WorkerBake { worker: worker.ok(), replies, _receive: receive })
    }
}

struct WorkerBake {
    worker: Option<JsValue>,
    replies: Rc<RefCell<VecDeque<BakeReply>>>,
    // The worker calls it until it is ended.
    _receive: Closure<dyn FnMut(JsValue)>,
}

impl BakeTask for WorkerBake {
    fn poll(&mut self) -> Option<BakeReply> {
        self.replies.borrow_mut().pop_front()
    }
}

impl Drop for WorkerBake {
    fn drop(&mut self) {
        if let Some(worker) = &self.worker {
            super::trace::end(worker);
        }
    }
}

fn get(object: &JsValue, name: &str) -> Option<JsValue> {
    Reflect::get(object, &name.into()).ok().filter(|value| !value.is_undefined())
}

fn reply(message: &JsValue) -> BakeReply {
    if let Some(failed) = get(message, "failed").and_then(|failed| failed.as_string()) {
        return BakeReply::Failed(failed);
    }
    if let Some(baked) = get(message, "baked") {
        return match atlas(&baked) {
            Some(atlas) => BakeReply::Finished(Box::new(atlas)),
            None => BakeReply::Failed(tr!("window-the-textures-could-not-be-baked-2").to_owned()),
        };
    }
    let step = get(message, "step").and_then(|step| step.as_string()).unwrap_or_default();
    BakeReply::Progress(step, get(message, "share").and_then(|share| share.as_f64()).unwrap_or_default())
}

fn atlas(baked: &JsValue) -> Option<BakedAtlas> {
    let floats = |name: &str| Some(get(baked, name)?.dyn_into::<Float32Array>().ok()?.to_vec());
    let text = |object: &JsValue, name: &str| get(object, name)?.as_string();
    let number = |object: &JsValue, name: &str| get(object, name)?.as_f64();
    let bytes = |object: &JsValue, name: &str| Some(get(object, name)?.dyn_into::<Uint8Array>().ok()?.to_vec());
    let list = |name: &str| get(baked, name)?.dyn_into::<Array>().ok();
    let picture = |object: &JsValue| {
        let size = number(object, "size")? as u32;
        Some(EncodedPicture { width: size, height: size, rgba: bytes(object, "rgba")? })
    };
    let map = |object: JsValue| {
        let name = text(&object, "kind")?;
        let kind = MapKind::ALL.iter().copied().find(|kind| kind.name() == name)?;
        let factor = number(&object, "factor")? as f32;
        Some(MapPicture { kind, file: text(&object, "file")?, factor, picture: picture(&object)? })
    };
    let charts = get(baked, "charts")?.dyn_into::<Uint32Array>().ok()?.to_vec();
    let uv = AtlasUv {
        tex_coords: floats("texCoords")?.as_chunks::<2>().0.to_vec(),
        chart_of_triangle: charts.into_iter().map(|chart| (chart != u32::MAX).then_some(chart)).collect(),
        chart_count: number(baked, "chartCount")? as usize,
        margin: number(baked, "margin")?,
    };
    Some(BakedAtlas {
        uv,
        report: serde_json::from_str(&text(baked, "report")?).ok()?,
        corners: floats("corners")?.as_chunks::<3>().0.to_vec(),
        layout: picture(&get(baked, "layout")?)?,
        pictures: list("pictures")?.iter().map(map).collect::<Option<_>>()?,
        files: list("files")?
            .iter()
            .map(|file| Some((text(&file, "name")?, bytes(&file, "bytes")?)))
            .collect::<Option<_>>()?,
        warnings: list("warnings")?.iter().filter_map(|warning| warning.as_string()).collect(),
    })
}
