//! The view's part of the exported state.

use super::work::{ExercisePage, Hints, Work};
use super::{ExerciseView, pictures};
use crate::step::code::MarkKind;
use serde_json::{Value, json};

/// One JSON object:
///
/// | key | value |
/// |---|---|
/// | `open` | whether it is shown in place of the scene |
/// | `id` | the exercise's id, or null if the list is shown |
/// | `files` | for each, `name` and whether it is `changed` (not saved), in `conflict` with the disk, `restored` from a draft, and `shown` in a tab |
/// | `drafts` | number of files with unsaved text that is kept for the next window |
/// | `before` | number of sets of files that were open before and can be put back |
/// | `file`, `page`, `shown`, `scene` | the file in the editor, the page beside it, the picture mode, and the scene |
/// | `test`, `hints`, `lamp` | whether the scene is one of the checker's; how much of the verdict is shown; the lamp's place, or null |
/// | `marks` | marked lines of all files: `file`, `line`, `kind` (error, warning, mistake), `text` |
/// | `unusable` | the reason why there are no shaders to draw, or null |
/// | `drawn`, `older`, `tried` | whether a pair is drawn; whether it is an older one; whether the newer one is being tried outside of the window |
/// | `trials` | number of pairs that were tried outside of the window first |
/// | `pictures` | number of pictures drawn |
/// | `step` | null without a pinned pixel, else `pixel`, `busy`, `message` (why there are no values), `stage`, and of the current shader `step`, `steps`, `line`, `function`, `iterations`, `values` (`line`, `text`), `variables` (`name`, `value`, `changed`) and `expression` under the pointer |
/// | `checking` | whether a check is running |
/// | `verdict` | null before the first check, else `word`, `summary`, `mistakes` (ids), `error` (why there is none), `stale` |
pub fn build(view: &ExerciseView) -> Value {
    let mut state = view.work.as_ref().map_or_else(|| json!({ "id": null }), of_work);
    state["open"] = view.is_open.into();
    state["pictures"] = view.pictures().into();
    state["drafts"] = view.drafts().into();
    state["step"] = view.stepper.state();
    state
}

fn of_work(work: &Work) -> Value {
    let files: Vec<Value> = work
        .files
        .iter()
        .map(|file| {
            json!({
                "name": file.name,
                "changed": file.is_changed(),
                "conflict": file.other.is_some(),
                "restored": file.is_restored(),
                "shown": file.is_shown(),
            })
        })
        .collect();
    let marks: Vec<Value> = (0..work.files.len())
        .flat_map(|index| work.marks(index).into_iter().map(move |mark| (index, mark)))
        .map(|(index, mark)| {
            let kind = match mark.kind {
                MarkKind::Error => "error",
                MarkKind::Warning => "warning",
                MarkKind::Mistake => "mistake",
            };
            let file = work.files.get(index).map(|file| &file.name);
            json!({ "file": file, "line": mark.line, "kind": kind, "text": mark.text })
        })
        .collect();
    let verdict = work.judged.as_ref().map(|judged| {
        let found = judged.verdict.as_ref().ok();
        json!({
            "word": found.map(|verdict| verdict.verdict),
            "summary": found.map(|verdict| &verdict.summary),
            "mistakes": found.map(|v| v.mistakes.iter().map(|mistake| &mistake.id).collect::<Vec<_>>()),
            "error": judged.verdict.as_ref().err(),
            "stale": work.is_judged_before(),
        })
    });
    let page = match work.page {
        ExercisePage::Editor => "editor",
        ExercisePage::Text => "text",
        ExercisePage::Verdict => "verdict",
        ExercisePage::Variables => "variables",
    };
    let hints = match work.hints {
        Hints::Symptom => "symptom",
        Hints::Name => "name",
        Hints::Line => "line",
        Hints::Fix => "fix",
    };
    json!({
        "id": work.exercise.id,
        "files": files,
        "before": work.before.len(),
        "file": work.files.get(work.current).map(|file| &file.name),
        "page": page,
        "shown": pictures::word(work.shown),
        "scene": work.scene().map(|scene| scene.name.as_ref()),
        "test": work.scene().is_some_and(|scene| scene.is_test),
        "hints": hints,
        "lamp": work.lamp().map(|lamp| lamp.to_array()),
        "marks": marks,
        "unusable": work.program.unusable,
        "drawn": work.program.is_drawn,
        "older": work.program.is_old,
        "tried": work.program.is_tried,
        "trials": work.trials,
        "checking": work.checking,
        "verdict": verdict,
    })
}
