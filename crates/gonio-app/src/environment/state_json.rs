//! The environment's part of the exported state.

use crate::session::Session;
use serde_json::{Value, json};

/// One JSON object, or null while the panel is closed:
///
/// | key | value |
/// |---|---|
/// | `serial` | counts the studies |
/// | `running`, `converting` | whether the environment is studied; whether it is converted or repaired |
/// | `error` | why it could not be studied, or null |
/// | `facts` | null until it is studied: `arrangement`, `files`, `format`, `form`, `face_size`, `fits`, `repairable`, `sentences` |
/// | `repaired` | the name of the repaired environment, or null |
pub fn build(session: &Session) -> Value {
    let view = &session.environment;
    if !view.is_open {
        return Value::Null;
    }
    let facts = view.facts().map(|facts| {
        json!({
            "arrangement": facts.arrangement.name(),
            "files": facts.files,
            "format": facts.format,
            "form": facts.description,
            "face_size": facts.face_size,
            "fits": facts.fits,
            "repairable": facts.is_repairable,
            "sentences": facts.sentences,
        })
    });
    json!({
        "serial": view.serial,
        "running": view.work.is_some(),
        "converting": view.conversion.is_some(),
        "error": view.studied.as_ref().and_then(|studied| studied.as_ref().err()),
        "facts": facts,
        "repaired": view.repaired,
    })
}
