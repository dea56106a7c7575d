//! SARIF, which code scanners exchange (OASIS, *Static Analysis Results Interchange Format*, version 2.1.0).

use super::address::uri_of;
use super::annotations::{Annotation, annotations};
use super::text::line;
use gonio_check::proposed_fix;
use gonio_check::verdict::{ProposedEdit, Verdict};
use serde_json::{Value, json};

const SCHEMA: &str = "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json";

/// A verdict as SARIF: a rule for each kind of message, a result for each message, and the proposed fix at each mistake.
/// `path_of` turns a verdict's name of a file into a path.
#[must_use]
pub fn sarif(verdict: &Verdict, version: &str, path_of: impl Fn(&str) -> String) -> Value {
    let all = annotations(verdict);
    let mut ids: Vec<&str> = Vec::new();
    for annotation in &all {
        if !ids.contains(&annotation.id.as_str()) {
            ids.push(&annotation.id);
        }
    }
    let rules: Vec<Value> = ids.iter().map(|id| json!({ "id": id })).collect();
    let is_mistake = |annotation: &Annotation| verdict.mistakes.iter().any(|found| found.id == annotation.id);
    let results = all.iter().map(|annotation| {
        let text = match &annotation.help {
            Some(help) => format!("{}\n{}", line(&annotation.message), line(help)),
            None => line(&annotation.message),
        };
        let mut result = json!({
            "ruleId": annotation.id,
            "ruleIndex": ids.iter().position(|id| *id == annotation.id),
            "level": annotation.kind.word(),
            "message": { "text": text },
        });
        if let Some(file) = &annotation.file {
            result["locations"] = json!([{ "physicalLocation": physical(annotation, &path_of(file)) }]);
        }
        if !verdict.proposed_fix.is_empty() && is_mistake(annotation) {
            result["fixes"] = json!([fix(&verdict.proposed_fix, &path_of)]);
        }
        result
    });
    json!({
        "$schema": SCHEMA,
        "version": "2.1.0",
        "runs": [{
            "tool": { "driver": { "name": "gonio", "version": version, "rules": rules } },
            "columnKind": "unicodeCodePoints",
            "automationDetails": { "id": format!("gonio/{}", verdict.exercise) },
            "results": results.collect::<Vec<Value>>(),
        }],
    })
}

fn physical(annotation: &Annotation, path: &str) -> Value {
    let mut location = json!({ "artifactLocation": { "uri": uri_of(path) } });
    if let Some(line) = annotation.line {
        location["region"] = json!({ "startLine": line });
        if let Some(column) = annotation.column {
            location["region"]["startColumn"] = column.into();
        }
    }
    location
}

fn fix(edits: &[ProposedEdit], path_of: impl Fn(&str) -> String) -> Value {
    let mut files: Vec<&str> = edits.iter().map(|edit| edit.file.as_str()).collect();
    files.sort_unstable();
    files.dedup();
    let change = |file: &&str| {
        let replacements: Vec<Value> = edits.iter().filter(|edit| edit.file == **file).map(replacement).collect();
        json!({ "artifactLocation": { "uri": uri_of(&path_of(file)) }, "replacements": replacements })
    };
    let changes: Vec<Value> = files.iter().map(change).collect();
    json!({ "description": { "text": proposed_fix::promise(edits) }, "artifactChanges": changes })
}

/// Whole lines without their last line break; an insertion brings its own.
fn replacement(edit: &ProposedEdit) -> Value {
    let (lines, last) = edit.before.lines().fold((0_u32, ""), |(count, _), line| (count + 1, line));
    let (end, column) = match lines {
        0 => (edit.line, 1),
        lines => (edit.line + lines - 1, last.chars().count() + 1),
    };
    let inserted = if lines == 0 { format!("{}\n", edit.after) } else { edit.after.clone() };
    json!({
        "deletedRegion": { "startLine": edit.line, "startColumn": 1, "endLine": end, "endColumn": column },
        "insertedContent": { "text": inserted },
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio_check::verdict::{FoundMistake, Outcome};

    #[test]
    fn a_mistake_is_a_result_with_its_place_and_its_fix() {
        let mut verdict = Verdict::new("ex04", Outcome::Wrong, "");
        let found = |id: &str| FoundMistake::new(id, "a name", 1.0);
        verdict.mistakes = vec![found("normal-raw").at("a é.vert", Some(3), "x"), found("gamma"), found("gamma")];
        let edit = |line, before: &str, after: &str| ProposedEdit {
            file: "a é.vert".into(),
            line,
            before: before.into(),
            after: after.into(),
        };
        verdict.proposed_fix = vec![edit(3, "é;\nxy", "z"), edit(7, "", "new")];
        let report = sarif(&verdict, "1.2.3", |file| format!("/srv/{file}"));
        let run = &report["runs"][0];
        assert_eq!((&report["version"], &run["tool"]["driver"]["version"]), (&"2.1.0".into(), &"1.2.3".into()));
        assert_eq!(run["tool"]["driver"]["rules"], json!([{ "id": "normal-raw" }, { "id": "gamma" }]));
        let results = run["results"].as_array().unwrap();
        assert_eq!((results.len(), &results[2]["ruleIndex"]), (3, &1.into()));
        let place = &results[0]["locations"][0]["physicalLocation"];
        assert_eq!(place["artifactLocation"]["uri"], "file:///srv/a%20%C3%A9.vert");
        assert_eq!(place["region"], json!({ "startLine": 3 }));
        assert!(results[1].get("locations").is_none());
        let replacements = &results[0]["fixes"][0]["artifactChanges"][0]["replacements"];
        let region = json!({ "startLine": 3, "startColumn": 1, "endLine": 4, "endColumn": 3 });
        assert_eq!(replacements[0], json!({ "deletedRegion": region, "insertedContent": { "text": "z" } }));
        let region = json!({ "startLine": 7, "startColumn": 1, "endLine": 7, "endColumn": 1 });
        assert_eq!(replacements[1], json!({ "deletedRegion": region, "insertedContent": { "text": "new\n" } }));
    }
}
