//! The bench's part of the exported state.

use super::BenchView;
use serde_json::{Value, json};

/// One JSON object:
///
/// | key | value |
/// |---|---|
/// | `open` | whether it is shown in place of the scene |
/// | `functions` | for each, `name`, whether it is `shown`, `color` (index in the palette) and `error`, or null |
/// | `chosen` | the index of the function that is checked |
/// | `opening` | whether files are being read |
/// | `plot` | `kind`, `scale`, `over`, `theta`, `phi`, `cosine`, `view`; `serial` of the plot, whether it is `running`, `error`, |
/// | | `ms` of its computation, and for a polar plot the `center` and `radius` of its half circle |
/// | `checks` | the function that was checked, or null, whether a check is `running`, and the properties `found` |
pub fn build(view: &BenchView) -> Value {
    let functions: Vec<Value> = view
        .functions
        .list
        .iter()
        .map(|function| {
            json!({
                "name": function.named.name,
                "shown": function.is_shown,
                "color": function.color,
                "error": function.error,
            })
        })
        .collect();
    let found: Vec<Value> = view
        .checks
        .found
        .iter()
        .map(|found| json!({ "property": found.property, "passed": found.passed, "value": found.value }))
        .collect();
    let (settings, plot) = (&view.settings, &view.plot);
    let polar = plot.figure().and_then(|figure| figure.polar);
    json!({
        "open": view.is_open,
        "functions": functions,
        "chosen": view.functions.chosen,
        "opening": view.functions.is_opening(),
        "plot": {
            "kind": settings.kind,
            "scale": settings.scale,
            "over": settings.over,
            "theta": settings.theta_i_deg,
            "phi": settings.phi_i_deg,
            "cosine": settings.with_cosine,
            "view": settings.view_deg,
            "size": settings.size,
            "serial": plot.serial,
            "running": plot.is_running(),
            "error": plot.error(),
            "ms": plot.computed_ms,
            "center": polar.map(|polar| polar.center),
            "radius": polar.map(|polar| polar.radius),
        },
        "checks": { "of": view.checks.name(), "running": view.checks.is_running(), "found": found },
    })
}
