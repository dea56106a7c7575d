//! A shader's steps as the editor shows them: the values beside the lines, the variables at the current step, and the steps
//! before and after it.

use crate::widgets;
use gonio_exercises::step::{ListedStep, ListedVariable, ShownValue, StepListing};
use gonio_language::tr;
use std::collections::{BTreeMap, HashMap};

/// Characters of the values beside a line.
const MOST_CHARACTERS: usize = 60;

/// The kind of a value beside a line; of several, the greatest counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ValueKind {
    /// Written and finite.
    Normal,
    /// Never written, or computed from values that were not.
    Unwritten,
    /// NaN or infinite.
    NonFinite,
}

impl ValueKind {
    /// The kind of a value.
    pub fn of(value: &ShownValue) -> Self {
        if value.is_non_finite() {
            ValueKind::NonFinite
        } else if value.is_partly_unwritten() {
            ValueKind::Unwritten
        } else {
            ValueKind::Normal
        }
    }
}

/// The values beside a line.
#[derive(Clone, Debug, PartialEq)]
pub struct LineValues {
    /// The values, short.
    pub text: String,
    /// Names, types and values in full, a line each.
    pub details: String,
    /// The kind of the values.
    pub kind: ValueKind,
}

/// A variable at the current step.
#[derive(Clone, Debug, PartialEq)]
pub struct VariableRow {
    /// Its name.
    pub name: String,
    /// The function that it belongs to; `None` for the current function, for global variables and varyings.
    pub function: Option<String>,
    /// Its GLSL type.
    pub glsl_type: String,
    /// Its value.
    pub value: ShownValue,
    /// Whether the current step wrote it.
    pub is_changed: bool,
    /// Its value before the current step, if that is another one.
    pub before: Option<ShownValue>,
}

/// A movement through the steps. The direction is forward or back.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Movement {
    /// To the next step, into functions.
    Into,
    /// To the next step in this function or its caller.
    Over,
    /// Backwards, into functions.
    BackInto,
    /// Backwards, in this function or its caller.
    BackOver,
    /// To the first step.
    First,
    /// To the step with this index.
    To(usize),
}

/// A shader's steps, and the current one.
#[derive(Clone, Debug)]
pub struct ShaderSteps {
    /// The steps.
    pub listing: StepListing,
    /// Index of the current step: the values are those after it.
    at: usize,
    lines: BTreeMap<u32, LineValues>,
    variables: Vec<VariableRow>,
}

impl ShaderSteps {
    /// Shows the last step.
    pub fn new(listing: StepListing) -> Self {
        let last = listing.steps.len().saturating_sub(1);
        let mut steps = ShaderSteps { listing, at: last, lines: BTreeMap::new(), variables: Vec::new() };
        steps.refresh();
        steps
    }

    /// Index of the current step.
    pub fn at(&self) -> usize {
        self.at
    }

    /// The current step.
    pub fn step(&self) -> Option<&ListedStep> {
        self.listing.steps.get(self.at)
    }

    /// The values beside each line, by its number.
    pub fn lines(&self) -> &BTreeMap<u32, LineValues> {
        &self.lines
    }

    /// The variables after the current step: of its function, of its callers, global ones, varyings.
    pub fn variables(&self) -> &[VariableRow] {
        &self.variables
    }

    /// Moves to another step. Returns whether there is one.
    pub fn go(&mut self, movement: Movement) -> bool {
        let steps = &self.listing.steps;
        let depth = |index: usize| steps.get(index).map_or(0, |step| step.calls.len());
        let (at, last) = (self.at, steps.len().saturating_sub(1));
        let is_outside = |index: &usize| depth(*index) <= depth(at);
        let next = match movement {
            Movement::Into => at + 1,
            Movement::Over => (at + 1..=last).find(is_outside).unwrap_or(last),
            Movement::BackInto => at.saturating_sub(1),
            Movement::BackOver => (0..at).rev().find(is_outside).unwrap_or(0),
            Movement::First => 0,
            Movement::To(index) => index,
        };
        let moved = next.min(last) != at;
        if moved {
            self.at = next.min(last);
            self.refresh();
        }
        moved
    }

    /// Goes to the last step of a line. Returns whether there is one.
    pub fn go_to_line(&mut self, line: u32) -> bool {
        let index = self.listing.steps.iter().rposition(|step| step.line == line);
        index.is_some_and(|index| self.go(Movement::To(index)) || index == self.at)
    }

    fn refresh(&mut self) {
        self.lines = lines(&self.listing, self.at);
        self.variables = variables(&self.listing, self.at);
    }
}

/// A pass over a line: the function, the lines of its calls, and the iterations.
type Pass<'a> = (&'a str, &'a [u32], &'a [u32]);

/// The last pass over a line up to the current step.
struct LinePass<'a> {
    pass: Pass<'a>,
    /// Number of passes so far.
    count: usize,
    conditions: Vec<(&'a str, bool)>,
    writes: Vec<&'a ListedVariable>,
}

fn lines(listing: &StepListing, at: usize) -> BTreeMap<u32, LineValues> {
    let mut passes: BTreeMap<u32, LinePass<'_>> = BTreeMap::new();
    for step in listing.steps.iter().take(at + 1) {
        let pass: Pass<'_> = (&step.function, &step.calls, &step.iterations);
        let empty = |count| LinePass { pass, count, conditions: Vec::new(), writes: Vec::new() };
        let line = passes.entry(step.line).or_insert_with(|| empty(1));
        if line.pass != pass {
            *line = empty(line.count + 1);
        }
        line.conditions.extend(step.conditions.iter().map(|found| (found.expression.as_str(), found.holds)));
        for write in &step.writes {
            line.writes.retain(|known| known.name != write.name);
            line.writes.push(write);
        }
    }
    let mut lines: BTreeMap<u32, LineValues> = BTreeMap::new();
    for (line, pass) in &passes {
        if !pass.writes.is_empty() || !pass.conditions.is_empty() {
            lines.insert(*line, of_pass(pass));
        }
    }
    let mut declared: BTreeMap<u32, Vec<&ListedVariable>> = BTreeMap::new();
    for input in &listing.inputs {
        declared.entry(input.line.unwrap_or(0)).or_default().push(input);
    }
    for (line, inputs) in declared.into_iter().filter(|(line, _)| *line > 0) {
        lines.entry(line).or_insert_with(|| of_values(&inputs, &[], 1));
    }
    lines
}

fn of_pass(pass: &LinePass<'_>) -> LineValues {
    of_values(&pass.writes, &pass.conditions, pass.count)
}

fn of_values(writes: &[&ListedVariable], conditions: &[(&str, bool)], count: usize) -> LineValues {
    // The name of the only variable of a line is in its text.
    let short = |write: &&ListedVariable| match writes.len() {
        1 => short(&write.value),
        _ => format!("{} = {}", write.name.rsplit('.').next().unwrap_or_default(), short(&write.value)),
    };
    let mut text = match writes {
        [] => conditions.iter().map(|(_, holds)| holds.to_string()).collect::<Vec<_>>().join(", "),
        writes => writes.iter().map(short).collect::<Vec<_>>().join(", "),
    };
    if text.chars().count() > MOST_CHARACTERS {
        text = text.chars().take(MOST_CHARACTERS).chain("...".chars()).collect();
    }
    if count > 1 {
        text.push_str(&tr!("exercise-times", count = count));
    }
    let conditions =
        conditions.iter().map(|(expression, holds)| tr!("exercise-is", expression = expression, holds = holds));
    let written = writes.iter().map(|write| format!("{} {} = {}", write.glsl_type, write.name, write.value));
    let mut details: Vec<String> = conditions.chain(written).collect();
    if count > 1 {
        details.push(tr!("exercise-the-last-of-times-so-far", count = count));
    }
    let kind = writes.iter().map(|write| ValueKind::of(&write.value)).max().unwrap_or(ValueKind::Normal);
    LineValues { text, details: details.join("\n"), kind }
}

/// The identity of a variable: the function and the calls to it (neither for global variables), name, line of its declaration.
type VariableKey<'a> = (&'a str, &'a [u32], &'a str, Option<u32>);

fn variables(listing: &StepListing, at: usize) -> Vec<VariableRow> {
    let mut order: Vec<VariableKey<'_>> = Vec::new();
    let mut values: HashMap<VariableKey<'_>, (&ListedVariable, Option<&ListedVariable>)> = HashMap::new();
    let mut depth = 0;
    for (index, step) in listing.steps.iter().take(at + 1).enumerate() {
        let is_inside = |(function, calls, ..): &VariableKey<'_>| {
            *function == step.function && *calls == &step.calls[..] && !step.calls.is_empty()
        };
        if step.calls.len() > depth {
            // A new call begins without the variables of an earlier one.
            order.retain(|key| !is_inside(key));
            values.retain(|key, _| !is_inside(key));
        }
        depth = step.calls.len();
        for write in &step.writes {
            let frame = if write.is_global { ("", &[][..]) } else { (&*step.function, &step.calls[..]) };
            let key = (frame.0, frame.1, &*write.name, write.line);
            match values.get_mut(&key) {
                Some(known) => *known = (write, (index == at).then_some(known.0)),
                None => {
                    order.push(key);
                    values.insert(key, (write, None));
                }
            }
        }
    }
    let Some(step) = listing.steps.get(at) else { return inputs(listing) };
    let row = |key: &VariableKey<'_>, function: Option<String>| {
        let (written, before) = values.get(key)?;
        let is_changed = step.writes.iter().any(|write| std::ptr::eq(write, *written));
        let before = before.filter(|before| before.value != written.value).map(|before| before.value.clone());
        Some(VariableRow {
            name: written.name.clone(),
            function,
            glsl_type: written.glsl_type.clone(),
            value: written.value.clone(),
            is_changed,
            before,
        })
    };
    let mut rows = Vec::new();
    // The step's own function first, then its callers, the nearest first.
    for length in (0..=step.calls.len()).rev() {
        let calls = step.calls.get(..length).unwrap_or_default();
        let is_own = length == step.calls.len();
        for key in order.iter().filter(|(function, of, ..)| !function.is_empty() && *of == calls) {
            if is_own && key.0 != step.function {
                continue;
            }
            rows.extend(row(key, (!is_own).then(|| key.0.to_owned())));
        }
    }
    rows.extend(order.iter().filter(|key| key.0.is_empty()).filter_map(|key| row(key, None)));
    rows.extend(inputs(listing));
    rows
}

/// The varyings or attributes.
fn inputs(listing: &StepListing) -> Vec<VariableRow> {
    let inputs = listing.inputs.iter().filter(|input| !input.is_uniform);
    let row = |input: &ListedVariable| VariableRow {
        name: input.name.clone(),
        function: None,
        glsl_type: input.glsl_type.clone(),
        value: input.value.clone(),
        is_changed: false,
        before: None,
    };
    inputs.map(row).collect()
}

/// A value with about four digits; `?` is a component that was never written.
pub fn short(value: &ShownValue) -> String {
    let list = |parts: &[ShownValue]| parts.iter().map(short).collect::<Vec<_>>().join(", ");
    if value.is_unwritten() {
        return tr!("exercise-never-written").to_owned();
    }
    match value {
        ShownValue::Float(x) if x.is_nan() => "NaN".to_owned(),
        ShownValue::Float(x) if x.is_infinite() => x.to_string(),
        ShownValue::Float(x) => widgets::compact(f64::from(*x)),
        ShownValue::Unwritten => "?".to_owned(),
        ShownValue::Vector(parts) if parts.iter().any(ShownValue::is_unwritten) => {
            let part = |part: &ShownValue| if part.is_unwritten() { "?".to_owned() } else { short(part) };
            format!("({})", parts.iter().map(part).collect::<Vec<_>>().join(", "))
        }
        ShownValue::Vector(parts) => format!("({})", list(parts)),
        ShownValue::Matrix(rows) => {
            format!("[{}]", rows.iter().map(|row| list(row)).collect::<Vec<_>>().join("; "))
        }
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use gonio_glsl::Stage;

    fn variable(name: &str, value: f32) -> ListedVariable {
        ListedVariable {
            name: name.to_owned(),
            glsl_type: "float".to_owned(),
            value: ShownValue::Float(value),
            line: Some(1),
            is_uniform: false,
            is_global: name.starts_with("out"),
        }
    }

    fn step(line: u32, calls: &[u32], iterations: &[u32], writes: &[(&str, f32)]) -> ListedStep {
        ListedStep {
            line,
            function: if calls.is_empty() { "main" } else { "f" }.to_owned(),
            calls: calls.to_vec(),
            iterations: iterations.to_vec(),
            conditions: Vec::new(),
            writes: writes.iter().map(|(name, value)| variable(name, *value)).collect(),
        }
    }

    /// ```glsl
    /// 3  float f(float x) {
    /// 4      float y = 2.0 * x; }
    /// 7  float s = 0.0;
    /// 8  for (int i = 0; i < 2; i++)
    /// 9      s += f(i);
    /// 10 outColour = s;
    /// ```
    fn loop_with_calls() -> ShaderSteps {
        let steps = vec![
            step(7, &[], &[], &[("s", 0.0)]),
            step(3, &[9], &[1], &[("x", 1.0)]),
            step(4, &[9], &[1], &[("y", 2.0)]),
            step(9, &[], &[1], &[("s", 2.0)]),
            step(3, &[9], &[2], &[("x", 5.0)]),
            step(4, &[9], &[2], &[("y", 10.0)]),
            step(9, &[], &[2], &[("s", 12.0)]),
            step(10, &[], &[], &[("outColour", 12.0)]),
        ];
        ShaderSteps::new(StepListing {
            stage: Stage::Fragment,
            file: "a.frag".to_owned(),
            lines: Vec::new(),
            inputs: vec![ListedVariable { line: Some(2), ..variable("v", 0.5) }],
            steps,
            outputs: Vec::new(),
            unwritten: Vec::new(),
            non_finite: None,
            discarded: None,
            endless: None,
            is_truncated: false,
        })
    }

    fn texts(steps: &ShaderSteps) -> Vec<(u32, &str)> {
        steps.lines().iter().map(|(line, values)| (*line, values.text.as_str())).collect()
    }

    fn rows(steps: &ShaderSteps) -> Vec<(String, String, bool)> {
        let row = |row: &VariableRow| {
            let owner = row.function.as_ref().map_or(String::new(), |function| format!("{function}: "));
            (format!("{owner}{}", row.name), row.value.to_string(), row.is_changed)
        };
        steps.variables().iter().map(row).collect()
    }

    fn shown(expected: &[(&str, &str, bool)]) -> Vec<(String, String, bool)> {
        expected.iter().map(|(name, value, changed)| ((*name).to_owned(), (*value).to_owned(), *changed)).collect()
    }

    #[test]
    fn each_line_has_the_values_of_its_last_pass_up_to_the_current_step() {
        let mut steps = loop_with_calls();
        let end =
            [(2, "0.5"), (3, "5   (2 times)"), (4, "10   (2 times)"), (7, "0"), (9, "12   (2 times)"), (10, "12")];
        assert_eq!(texts(&steps), end);
        steps.go(Movement::To(4));
        assert_eq!(texts(&steps), [(2, "0.5"), (3, "5   (2 times)"), (4, "2"), (7, "0"), (9, "2")]);
        steps.go(Movement::First);
        assert_eq!(texts(&steps), [(2, "0.5"), (7, "0")]);
    }

    #[test]
    fn steps_go_into_and_over_functions_forward_and_back() {
        let mut steps = loop_with_calls();
        let mut walk = |movement: Movement| {
            let mut seen = vec![steps.at()];
            while steps.go(movement) {
                seen.push(steps.at());
            }
            seen
        };
        assert_eq!(walk(Movement::BackOver), [7, 6, 3, 0]);
        assert_eq!(walk(Movement::Over), [0, 3, 6, 7]);
        assert_eq!(walk(Movement::BackInto), [7, 6, 5, 4, 3, 2, 1, 0]);
        assert_eq!(walk(Movement::Into), [0, 1, 2, 3, 4, 5, 6, 7]);
        // At the end of a function, a step over continues with its caller.
        steps.go(Movement::To(2));
        assert!(steps.go(Movement::Over) && steps.at() == 3);
        assert!(steps.go_to_line(4) && steps.at() == 5 && !steps.go_to_line(8));
    }

    #[test]
    fn variables_belong_to_calls_and_changed_ones_are_marked() {
        let mut steps = loop_with_calls();
        assert_eq!(rows(&steps), shown(&[("s", "12", false), ("outColour", "12", true), ("v", "0.5", false)]));
        steps.go(Movement::To(5));
        assert_eq!(
            rows(&steps),
            shown(&[("x", "5", false), ("y", "10", true), ("main: s", "2", false), ("v", "0.5", false)])
        );
        // The second call does not know `y` of the first one.
        steps.go(Movement::BackInto);
        assert_eq!(rows(&steps), shown(&[("x", "5", true), ("main: s", "2", false), ("v", "0.5", false)]));
        steps.go(Movement::To(6));
        let s = &steps.variables()[0];
        assert_eq!((s.is_changed, s.before.as_ref()), (true, Some(&ShownValue::Float(2.0))));
    }

    #[test]
    fn undefined_and_infinite_values_are_marked() {
        let vector = |x: f32| ShownValue::Vector(vec![ShownValue::Unwritten, ShownValue::Float(x)]);
        for (value, text, kind) in [
            (
                ShownValue::Vector(vec![ShownValue::Float(0.25), ShownValue::Float(-1.0)]),
                "(0.25, -1)",
                ValueKind::Normal,
            ),
            (vector(1.0), "(?, 1)", ValueKind::Unwritten),
            (vector(f32::NAN), "(?, NaN)", ValueKind::NonFinite),
            (ShownValue::Unwritten, "never written", ValueKind::Unwritten),
            (ShownValue::Float(f32::NEG_INFINITY), "-inf", ValueKind::NonFinite),
            (ShownValue::Float(0.333_333_34), "0.3333", ValueKind::Normal),
        ] {
            assert_eq!((short(&value).as_str(), ValueKind::of(&value)), (text, kind));
        }
    }
}
