//! Listings as text for a terminal.

use super::{Stepped, stage_name};
use crate::terminal::{Style, TerminalPage};
use gonio_exercises::step::{ListedLine, ListedStep, ListedVariable, RightValue, StepListing};

const BOLD: Style = Style::Bold;
const CYAN: Style = Style::Cyan;
const DIM: Style = Style::Dim;
const RED: Style = Style::Red;
const YELLOW: Style = Style::Yellow;

/// Most characters of source before the column of values.
const WIDEST_SOURCE: usize = 76;
/// Most characters of values beside a line; more are below it, one value a line.
const WIDEST_VALUES: usize = 72;
/// Steps of repeated lines that are listed from the first on, and the last ones.
const LISTED_STEPS: [usize; 2] = [60, 8];
/// Most characters of a step's place before its values.
const WIDEST_PLACE: usize = 48;
/// Steps that one line refers to by number.
const MOST_NUMBERS: usize = 6;

/// Everything about a pixel or a vertex. `title` and `detail`: what is drawn.
pub fn page(title: &str, detail: &str, [width, height]: [u32; 2], stepped: &Stepped) -> TerminalPage {
    let mut page = TerminalPage::new();
    match &stepped.pixel {
        Some(([x, y], surface)) => {
            page.line(format_args!("{BOLD}{title}{BOLD:#}  {detail}, pixel {x},{y} of {width}x{height}"));
            let ([a, b, c], [p, q, r]) = (surface.vertices, surface.shares);
            page.line(format_args!(
                "{DIM}object {}, triangle {}, vertices {a}, {b}, {c} with weights {p:.4}, {q:.4}, {r:.4}{DIM:#}",
                surface.object, surface.triangle
            ));
        }
        None => page.line(format_args!("{BOLD}{title}{BOLD:#}  {detail}")),
    }
    let of_pixel = usize::from(stepped.pixel.is_some());
    for (index, listing) in stepped.listings.iter().enumerate() {
        let vertex = index.checked_sub(of_pixel).and_then(|index| stepped.vertices.get(index));
        let place = vertex.map_or(String::new(), |vertex| format!(", vertex {vertex}"));
        if vertex.is_none() {
            variables(&mut page, "varyings", listing.inputs.iter().filter(|input| !input.is_uniform));
        } else {
            variables(&mut page, &format!("attributes{place}"), listing.inputs.iter().filter(|i| !i.is_uniform));
        }
        page.heading(format_args!("{} ({} shader{place})", listing.file, stage_name(listing.stage)));
        source(&mut page, listing, stepped.right.get(index).map(Vec::as_slice).unwrap_or_default());
        repeated(&mut page, listing);
        variables(&mut page, "outputs", listing.outputs.iter());
        remarks(&mut page, listing);
    }
    page
}

fn variables<'a>(page: &mut TerminalPage, heading: &str, all: impl Iterator<Item = &'a ListedVariable>) {
    let all: Vec<&ListedVariable> = all.collect();
    if all.is_empty() {
        return;
    }
    page.heading(heading);
    let width = all.iter().map(|variable| variable.name.chars().count()).max().unwrap_or(0).min(40);
    for variable in all {
        let style = value_style(variable);
        page.line(format_args!("  {:<width$}  {style}{}{style:#}", variable.name, variable.value));
    }
}

fn value_style(variable: &ListedVariable) -> Style {
    if variable.value.is_unwritten() {
        YELLOW
    } else if variable.value.is_non_finite() {
        RED
    } else {
        CYAN
    }
}

fn assigned(variable: &ListedVariable) -> String {
    let style = value_style(variable);
    format!("{} = {style}{}{style:#}", variable.name, variable.value)
}

/// The values of a step, and their width without styles.
fn values(step: &ListedStep) -> Vec<(String, usize)> {
    let width =
        |variable: &ListedVariable| variable.name.chars().count() + variable.value.to_string().chars().count() + 3;
    let conditions = step.conditions.iter().map(|condition| {
        let text = format!("`{}` is {}", condition.expression, condition.holds);
        let width = text.chars().count();
        (text, width)
    });
    conditions.chain(step.writes.iter().map(|write| (assigned(write), width(write)))).collect()
}

fn steps_at<'a>(listing: &'a StepListing, line: &ListedLine) -> Vec<(usize, &'a ListedStep)> {
    listing.steps.iter().enumerate().filter(|(_, step)| step.line == line.number).collect()
}

/// The source with values at the end of the lines, and the right values below the lines of causes.
fn source(page: &mut TerminalPage, listing: &StepListing, right: &[RightValue]) {
    let widest = listing.lines.iter().map(|line| line.text.trim_end().chars().count()).max().unwrap_or(0);
    let column = widest.min(WIDEST_SOURCE);
    for line in &listing.lines {
        let steps = steps_at(listing, line);
        let beside: Vec<(String, usize)> = match steps.as_slice() {
            [] => {
                let declared = |input: &&ListedVariable| input.line == Some(line.number) && input.is_uniform;
                let declared = listing.inputs.iter().filter(declared);
                declared.map(|input| (assigned(input), input.name.len() + input.value.to_string().len() + 3)).collect()
            }
            [(_, step)] => values(step),
            several => {
                let numbers: Vec<String> =
                    several.iter().take(MOST_NUMBERS).map(|(number, _)| (number + 1).to_string()).collect();
                let more = if several.len() > MOST_NUMBERS { ", ..." } else { "" };
                let text = format!("{} times: steps {}{more}", several.len(), numbers.join(", "));
                let width = text.chars().count();
                vec![(text, width)]
            }
        };
        let text = line.text.trim_end();
        let dim = if line.ran == Some(false) { format!("{DIM}") } else { String::new() };
        let end = if line.ran == Some(false) { format!("{DIM:#}") } else { String::new() };
        let not_run = if line.ran == Some(false) { "  not run" } else { "" };
        let padding = " ".repeat(column.saturating_sub(text.chars().count()));
        let width: usize = beside.iter().map(|(_, width)| width + 2).sum();
        if beside.is_empty() && not_run.is_empty() {
            page.line(format_args!("{DIM}{:>4}{DIM:#}  {text}", line.number));
        } else if width <= WIDEST_VALUES {
            let beside: Vec<&str> = beside.iter().map(|(text, _)| text.as_str()).collect();
            let beside = beside.join(", ");
            page.line(format_args!("{DIM}{:>4}{DIM:#}  {dim}{text}{padding}{not_run}{end}  {beside}", line.number));
        } else {
            page.line(format_args!("{DIM}{:>4}{DIM:#}  {text}", line.number));
            for (text, _) in &beside {
                page.line(format_args!("{:indent$}{text}", "", indent = 6 + column.min(12)));
            }
        }
        for right in right.iter().filter(|right| right.line == line.number) {
            let RightValue { expression, should, .. } = right;
            let value = right.value.as_ref().map_or_else(String::new, |value| format!(" = {CYAN}{value}{CYAN:#}"));
            page.line(format_args!("      {YELLOW}`{expression}` {should}{YELLOW:#}{value}"));
        }
    }
}

/// The steps of lines that ran several times, in the order of execution.
fn repeated(page: &mut TerminalPage, listing: &StepListing) {
    let mut counts = std::collections::HashMap::new();
    for step in &listing.steps {
        *counts.entry(step.line).or_insert(0_usize) += 1;
    }
    let steps: Vec<(usize, &ListedStep)> =
        listing.steps.iter().enumerate().filter(|(_, step)| counts.get(&step.line).is_some_and(|n| *n > 1)).collect();
    if steps.is_empty() {
        return;
    }
    page.heading("steps of lines that ran several times");
    let [first, last] = LISTED_STEPS;
    let left_out = steps.len().saturating_sub(first + last);
    let places: Vec<String> = steps.iter().map(|(_, step)| place(step)).collect();
    let width = places.iter().map(|place| place.chars().count()).max().unwrap_or(0).min(WIDEST_PLACE);
    for (index, ((number, step), place)) in steps.iter().zip(&places).enumerate() {
        if left_out > 0 && index == first {
            page.line(format_args!("        {DIM}... {left_out} more (--json lists them){DIM:#}"));
        }
        if left_out > 0 && (first..first + left_out).contains(&index) {
            continue;
        }
        let values: Vec<String> = values(step).into_iter().map(|(text, _)| text).collect();
        page.line(format_args!("  {:>5}  {DIM}{place:<width$}{DIM:#}  {}", number + 1, values.join(", ")));
    }
}

/// The line, iterations and call of a step.
fn place(step: &ListedStep) -> String {
    let mut place = format!("line {}", step.line);
    if !step.iterations.is_empty() {
        let numbers: Vec<String> = step.iterations.iter().map(ToString::to_string).collect();
        place.push_str(&format!(", iteration {}", numbers.join(".")));
    }
    if let Some(call) = step.calls.last() {
        place.push_str(&format!(", {} called at line {call}", step.function));
    }
    place
}

fn remarks(page: &mut TerminalPage, listing: &StepListing) {
    let file = &listing.file;
    let mut remarks: Vec<String> = Vec::new();
    if let Some((line, statements)) = listing.endless {
        remarks.push(format!("{RED}{file}:{line}{RED:#}  this loop did not end after {statements} statements"));
    } else if listing.is_truncated {
        remarks.push(format!("{YELLOW}{file}{YELLOW:#}  there are more steps than these"));
    }
    if let Some(line) = listing.discarded {
        remarks
            .push(format!("{YELLOW}{file}:{line}{YELLOW:#}  the pixel is discarded here; its outputs have no effect"));
    }
    if let Some((place, value)) = &listing.non_finite {
        let [line, column] = [place.line, place.column];
        remarks.push(format!(
            "{RED}{file}:{line}:{column}{RED:#}  the first value that is not a finite number: `{}` is {value}",
            place.expression
        ));
    }
    for input in listing.inputs.iter().filter(|input| !input.is_uniform && input.value.is_unwritten()) {
        let why = match listing.stage {
            gonio_glsl::Stage::Vertex => "nothing in the mesh feeds this attribute, which is (0, 0, 0, 1)",
            _ => "the vertex shader never writes this varying",
        };
        let place = input.line.map_or_else(|| file.clone(), |line| format!("{file}:{line}"));
        remarks.push(format!("{YELLOW}{place}{YELLOW:#}  `{}`: {why}", input.name));
    }
    for place in &listing.unwritten {
        let [line, column] = [place.line, place.column];
        remarks.push(format!(
            "{YELLOW}{file}:{line}:{column}{YELLOW:#}  `{}` is read before it is written",
            place.expression
        ));
    }
    for output in listing.outputs.iter().filter(|output| output.value.is_unwritten() && listing.endless.is_none()) {
        let place = output.line.map_or_else(|| file.clone(), |line| format!("{file}:{line}"));
        let is_written = listing.steps.iter().flat_map(|step| &step.writes).any(|write| write.name == output.name);
        let why = if is_written { "is computed from undefined values" } else { "is never written" };
        remarks.push(format!("{YELLOW}{place}{YELLOW:#}  the output `{}` {why}", output.name));
    }
    if !remarks.is_empty() {
        page.heading("remarks");
        remarks.iter().for_each(|remark| page.line(format_args!("  {remark}")));
    }
}
