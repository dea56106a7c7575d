//! `[points]` in `course.toml` and `exercise.toml`.
//!
//! ```toml
//! [points]
//! total = 20
//! other_mistake = 5            # what a mistake costs that is not listed
//!
//! [points.terms]               # what a wrong term costs
//! diffuse = 8
//!
//! [points.mistakes]            # what a named mistake costs
//! normal-by-model-matrix = 4
//! ```

use gonio_check::mistakes::{self, TERMS};
use gonio_exercises::points::PointScheme;
use gonio_scene::toml_table::{Entry, Fault, TableReader, Value, nearest_word};
use std::collections::BTreeMap;

/// Reads the table. `own` are the ids of the exercise's mistakes, if it has some of its own; else the catalogue's are known.
pub(super) fn read_points(t: &mut TableReader<'_>, own: Option<&[String]>) -> Result<Option<PointScheme>, Fault> {
    let Some(mut table) = t.table("points", "[points]")? else { return Ok(None) };
    let total = table.number("total")?;
    let other_mistake = table.number("other_mistake")?;
    let terms = table.entries("terms", "[points.terms]")?;
    let of_mistakes = table.entries("mistakes", "[points.mistakes]")?;
    table.finish()?;
    let total = total.ok_or_else(|| Fault::at(&table.span, "[points] has no `total`, the points of a right answer"))?;
    if !(total.is_finite() && total > 0.0) {
        return Err(Fault::at(&table.place("total"), format!("`total`: expected a positive number, found {total}")));
    }
    if let Some(cost) = other_mistake.filter(|cost| !is_cost(*cost)) {
        return Err(Fault::at(&table.place("other_mistake"), cost_message("other_mistake", cost)));
    }
    let terms = costs(terms, "term", &TERMS.map(str::to_owned))?;
    let catalogue = || mistakes::all().iter().chain(mistakes::structural()).map(|m| m.id.clone()).collect();
    let known: Vec<String> = own.map_or_else(catalogue, <[String]>::to_vec);
    let mistakes = costs(of_mistakes, "mistake", &known)?;
    Ok(Some(PointScheme { total, terms, mistakes, other_mistake }))
}

fn costs(entries: &[Entry], kind: &str, known: &[String]) -> Result<BTreeMap<String, f64>, Fault> {
    let mut costs = BTreeMap::new();
    for entry in entries {
        if !known.contains(&entry.key) {
            let meant = nearest_word(&entry.key, known.iter().map(String::as_str));
            let meant = meant.map_or(String::new(), |word| format!("; did you mean `{word}`?"));
            return Err(Fault::at(&entry.key_span, format!("unknown {kind} `{}`{meant}", entry.key)));
        }
        match entry.item.value {
            Value::Number(cost) if is_cost(cost) => costs.insert(entry.key.clone(), cost),
            Value::Number(cost) => return Err(Fault::at(&entry.item.span, cost_message(&entry.key, cost))),
            ref other => {
                let message = format!("`{}`: expected a number of points, found {}", entry.key, other.describe());
                return Err(Fault::at(&entry.item.span, message));
            }
        };
    }
    Ok(costs)
}

fn is_cost(cost: f64) -> bool {
    cost.is_finite() && cost >= 0.0
}

fn cost_message(key: &str, cost: f64) -> String {
    format!("`{key}`: expected the points that it costs, a number of at least 0, found {cost}")
}
