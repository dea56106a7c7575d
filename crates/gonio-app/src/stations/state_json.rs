//! The stations' part of the exported state.

use super::StationRoom;
use serde_json::{Map, Value, json};

/// One JSON object:
///
/// | key | value |
/// |---|---|
/// | `open` | whether they are shown in place of the scene |
/// | `stations`, `chosen` | the names of all stations, once they are known; that of the chosen one, or null |
/// | `values` | the parameters of the chosen station with their values |
/// | `picture` | `name`; `size` in pixels; `serial`; `samples` of each pixel, 0 while it is coarse; whether it is the `newest`; |
/// | | `first_ms`, milliseconds from the request to its first picture, or null |
/// | `running`, `paused`, `playing` | whether something is computed; whether the user has paused that; whether a film runs |
/// | `plot` | its `serial`, and `error`, or null |
/// | `checks` | for each `quantity`, `expected`, `measured`, `bound` and `holds`; null until those of the values are known |
pub fn build(room: &StationRoom) -> Value {
    let names: Vec<&str> = room.stations.iter().map(|station| station.description.name.as_str()).collect();
    let station = room.station();
    let values: Option<Map<String, Value>> = station.map(|station| {
        station.values.iter().map(|(parameter, value)| (parameter.name.to_string(), json!(value.x))).collect()
    });
    let work = &room.work;
    let checks: Vec<Value> = work
        .checks
        .iter()
        .map(|check| {
            json!({
                "quantity": check.quantity,
                "expected": check.expected,
                "measured": check.measured,
                "bound": check.bound,
                "holds": check.holds(),
            })
        })
        .collect();
    json!({
        "open": room.is_open,
        "stations": names,
        "chosen": station.map(|station| &station.description.name),
        "values": values,
        "picture": {
            "name": station.and_then(|station| station.description.pictures.get(station.picture)).map(|(name, _)| name),
            "size": work.picture.size,
            "serial": work.picture.serial,
            "samples": work.picture.samples,
            "newest": work.picture.is_newest,
            "first_ms": work.first_ms,
        },
        "running": room.is_open && work.is_running(),
        "paused": work.is_paused,
        "playing": room.film.is_playing,
        "plot": {
            "serial": work.plot_serial,
            "error": work.plot.as_ref().and_then(|plot| plot.as_ref().err()),
        },
        "checks": work.has_checks.then_some(checks),
    })
}
