//! Its part of the exported state.

use super::Baking;
use super::view::background_name;
use crate::session::Session;
use serde_json::{Value, json};

/// Null until the tab of baking is opened, else one JSON object:
///
/// | key | value |
/// |---|---|
/// | `running`, `step`, `share` | whether a bake is at work, its step (or null), and the share that is done |
/// | `failed` | why the last one failed, or null |
/// | `job` | the settings of the next one |
/// | `result` | null, or the newest: its `serial`, `maps`, `files`, `charts`, `coverage`, `overlaps`, and whether it is `stale` |
/// | `view` | the `background` of the atlas, its `zoom` and its `square`: left, top and side in points of the window |
/// | `place` | the marked place, or null: `chart`, `uv`, `position` |
pub fn build(session: &Session) -> Value {
    let baking: &Baking = &session.baking;
    if !baking.is_open {
        return Value::Null;
    }
    let running = baking.running.as_ref();
    let result = baking.result.as_ref().map(|result| {
        let report = &result.atlas.report;
        json!({
            "serial": result.facts.serial,
            "maps": result.atlas.pictures.iter().map(|map| map.kind.name()).collect::<Vec<_>>(),
            "files": result.atlas.files.iter().map(|(name, _)| name).collect::<Vec<_>>(),
            "charts": report.charts,
            "coverage": report.coverage,
            "overlaps": report.overlapping_texels,
            "stale": result.facts.generation != session.generation,
        })
    });
    let view = baking.result.as_ref().map(|result| {
        let square = baking.view.square.map(|square| [square.left(), square.top(), square.width()]);
        json!({ "background": background_name(result, baking.view.background), "zoom": baking.view.zoom, "square": square })
    });
    let place = baking
        .place(&session.probing)
        .map(|place| json!({ "chart": place.chart, "uv": place.uv.to_array(), "position": place.position.to_array() }));
    json!({
        "running": baking.is_running(),
        "step": running.map(|running| &running.step.0),
        "share": running.map(|running| running.step.1),
        "failed": baking.failed,
        "job": baking.job,
        "result": result,
        "view": view,
        "place": place,
    })
}
