//! Hovering over a variable: its type, its role, and its value at a pixel in the middle of the exercise's picture.
//!
//! The shaders run on the CPU in a thread of their own, within a bound, and are kept until their text changes.

use super::sources::Sources;
use gonio_check::roles::Bindings;
use gonio_check::source_problems::{LineAndColumn, SourceStage, SourceSymbol};
use gonio_exercises::exercise::{Exercise, ExerciseKind};
use gonio_exercises::preview;
use gonio_exercises::step::{EvaluatedValue, StepListing, StepOptions, SteppedPair, SteppedPlace, SteppedScene};
use gonio_glsl::{Stage, Storage, SymbolKind};
use gonio_language::tr;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::mpsc::{Sender, channel};

/// Side of the picture: that of `gonio lab step`, so that both show the same values.
const SIDE: u32 = 512;
/// Stack of the thread.
const STACK_BYTES: usize = 64 << 20;
/// Values of an expression that runs several times.
const MOST_VALUES: usize = 4;

/// A question about a place of a document.
pub struct HoverQuestion {
    /// The shaders.
    pub sources: Sources,
    /// The document's name in the submission.
    pub file: String,
    /// The place.
    pub at: LineAndColumn,
}

/// The answer: paragraphs, and the range of characters that it is about.
pub struct HoverAnswer {
    /// The declaration, in GLSL.
    pub declaration: String,
    /// Sentences below it.
    pub sentences: Vec<String>,
    /// The first character.
    pub start: LineAndColumn,
    /// The character after the last one.
    pub end: LineAndColumn,
}

/// A question, and what is done with its answer.
pub type HoverJob = (HoverQuestion, Box<dyn FnOnce(Option<HoverAnswer>) + Send>);

/// Starts the thread that answers.
///
/// # Errors
/// Those of starting a thread.
pub fn start() -> std::io::Result<Sender<HoverJob>> {
    let (sender, jobs) = channel::<HoverJob>();
    std::thread::Builder::new().stack_size(STACK_BYTES).spawn(move || {
        let mut known: Option<(u64, Option<SampledPair>)> = None;
        for (question, answer) in jobs {
            // A panic has been printed on stderr; the editor gets no answer then.
            let found = catch_unwind(AssertUnwindSafe(|| answered(&question, &mut known))).unwrap_or_else(|_| {
                known = None;
                None
            });
            answer(found);
        }
    })?;
    Ok(sender)
}

/// A pair of shaders that ran over a scene.
struct SampledPair {
    exercise: &'static Exercise,
    scene_name: String,
    pair: Arc<SteppedPair>,
    scene: SteppedScene,
    pixel: Option<[u32; 2]>,
    vertex: u32,
}

impl SampledPair {
    /// `None` if the exercise is not drawn or the shaders cannot run on the CPU.
    fn new(sources: &Sources) -> Option<Self> {
        let exercise = sources.exercise.filter(|exercise| exercise.kind == ExerciseKind::Shaders)?;
        if sources.has_errors() || !preview::is_drawn(exercise) {
            return None;
        }
        let pair = Arc::new(SteppedPair::new(sources.submitted.as_ref()?, &Bindings::default()).ok()?);
        let scene = preview::scenes(exercise).into_iter().next()?;
        let objects = scene.test_scenes(&scene.eye, 0.0, [SIDE; 2]);
        let stepped = SteppedScene::new(Arc::clone(&pair), &objects, StepOptions::square(SIDE));
        let pixel = stepped.nearest_drawn([SIDE / 2; 2]);
        let vertex = pixel.and_then(|pixel| stepped.surface(pixel)).map_or(0, |surface| surface.vertices[0]);
        Some(SampledPair { exercise, scene_name: scene.name.into_owned(), pair, scene: stepped, pixel, vertex })
    }

    fn place(&self, stage: Stage) -> Option<SteppedPlace> {
        match stage {
            Stage::Vertex => Some(SteppedPlace::Vertex(self.vertex)),
            Stage::Fragment => self.pixel.map(SteppedPlace::Pixel),
        }
    }

    fn listing(&self, stage: Stage) -> Option<StepListing> {
        match self.place(stage)? {
            SteppedPlace::Pixel(pixel) => self.scene.step_pixel(pixel),
            SteppedPlace::Vertex(vertex) => self.scene.step_vertex(vertex),
        }
    }

    /// "at pixel 256,256 of the lab's".
    fn place_in_words(&self, stage: Stage) -> String {
        let scene = &self.scene_name;
        match self.place(stage) {
            Some(SteppedPlace::Pixel([x, y])) => tr!("editor-at-pixel", x = x, y = y, scene = scene),
            _ => tr!("editor-at-vertex", vertex = self.vertex, scene = scene),
        }
    }
}

fn answered(question: &HoverQuestion, known: &mut Option<(u64, Option<SampledPair>)>) -> Option<HoverAnswer> {
    let HoverQuestion { sources, file, at } = question;
    let of_file = sources.texts.iter().filter(|(_, text)| text.has_file(file));
    if known.as_ref().is_none_or(|(content, _)| *content != sources.content) {
        *known = Some((sources.content, SampledPair::new(sources)));
    }
    let sampled = known.as_ref().and_then(|(_, sampled)| sampled.as_ref());
    for (stage, text) in of_file {
        let symbol = SourceStage::new(text, *stage).symbol_at(file, *at);
        let value = sampled.filter(|_| text.file == *file).and_then(|sampled| of_expression(sampled, *stage, *at));
        let found = match (value, symbol, sampled) {
            // An expression has a value, and a declared variable may be one.
            (Some(answer), symbol, _) => Some(with_storage(answer, symbol.as_ref())),
            (None, Some(symbol), Some(sampled)) => Some(of_declared(sampled, *stage, symbol)),
            (None, Some(symbol), None) => Some(HoverAnswer::of_symbol(&symbol)),
            (None, None, _) => None,
        };
        if found.is_some() {
            return found;
        }
    }
    None
}

impl HoverAnswer {
    fn of_symbol(symbol: &SourceSymbol) -> Self {
        let glsl_type = symbol.glsl_type.as_deref().unwrap_or("?");
        let (storage, name) = (storage_word(symbol.storage), &symbol.name);
        let declaration = match symbol.kind {
            SymbolKind::Function => format!("{glsl_type} {name}(...)"),
            _ => format!("{storage}{glsl_type} {name}"),
        };
        HoverAnswer { declaration, sentences: Vec::new(), start: symbol.start, end: symbol.end }
    }
}

fn storage_word(storage: Storage) -> &'static str {
    match storage {
        Storage::None => "",
        Storage::Const => "const ",
        Storage::In => "in ",
        Storage::Out => "out ",
        Storage::Uniform => "uniform ",
        Storage::Buffer => "buffer ",
    }
}

/// The smallest expression at a place, with its values.
fn of_expression(sampled: &SampledPair, stage: Stage, at: LineAndColumn) -> Option<HoverAnswer> {
    let found = sampled.scene.expression_value(sampled.place(stage)?, at)?;
    // At the name in a declaration it is the initialiser.
    if [found.line, found.column] > at {
        return None;
    }
    let mut sentences = about_input(sampled, stage, &found.expression);
    let place = sampled.place_in_words(stage);
    sentences.push(match found.evaluations.as_slice() {
        [] => tr!("editor-not-evaluated", place = place),
        [only] => tr!("editor-value", value = only.value, place = place),
        several => {
            let shown: Vec<String> = several.iter().take(MOST_VALUES).map(passed).collect();
            let values = shown.join("; ");
            let more = if several.len() > MOST_VALUES { "; ..." } else { "" };
            tr!("editor-values", values = format!("{values}{more}"), count = several.len(), place = place)
        }
    });
    let start = [found.line, found.column];
    let end = [found.line, found.column.saturating_add(found.length)];
    let declaration = format!("{} {}", found.glsl_type, found.expression);
    Some(HoverAnswer { declaration, sentences, start, end })
}

/// A value with the passes of the loops around it.
fn passed(value: &EvaluatedValue) -> String {
    let passes: Vec<String> = value.iterations.iter().map(u32::to_string).collect();
    if passes.is_empty() { value.value.to_string() } else { format!("{} ({})", value.value, passes.join(", ")) }
}

/// An expression that is a variable alone is shown with its qualifier.
fn with_storage(answer: HoverAnswer, symbol: Option<&SourceSymbol>) -> HoverAnswer {
    let is_variable = |symbol: &&SourceSymbol| answer.declaration.ends_with(&format!(" {}", symbol.name));
    let storage = symbol.filter(is_variable).map_or("", |symbol| storage_word(symbol.storage));
    HoverAnswer { declaration: format!("{storage}{}", answer.declaration), ..answer }
}

/// A variable where it is declared: its value as an input, at the end as an output, or where it was first written.
fn of_declared(sampled: &SampledPair, stage: Stage, symbol: SourceSymbol) -> HoverAnswer {
    let mut answer = HoverAnswer::of_symbol(&symbol);
    answer.sentences = about_input(sampled, stage, &symbol.name);
    let Some(listing) = sampled.listing(stage) else { return answer };
    let writes = listing.steps.iter().filter(|step| step.line == symbol.start[0]).flat_map(|step| &step.writes);
    let mut variables = listing.inputs.iter().chain(&listing.outputs).filter(|v| v.is_global).chain(writes);
    let place = sampled.place_in_words(stage);
    if let Some(found) = variables.find(|variable| variable.name == symbol.name) {
        answer.sentences.push(tr!("editor-value", value = found.value, place = place));
    } else {
        // The members of a struct are inputs of their own.
        let begin = format!("{}.", symbol.name);
        for member in listing.inputs.iter().filter(|input| input.name.starts_with(&begin)) {
            answer.sentences.push(format!("`{} {}` = {}", member.glsl_type, member.name, member.value));
        }
    }
    answer
}

/// The role of an attribute or uniform, and what the exercise says of it.
fn about_input(sampled: &SampledPair, stage: Stage, name: &str) -> Vec<String> {
    let mut sentences = Vec::new();
    if let Some((role, how)) = sampled.pair.role(stage, name) {
        sentences.push(tr!("editor-role", role = role, how = how));
    }
    let inputs = sampled.exercise.inputs();
    if let Some(given) = inputs.uniforms.get(name).or_else(|| inputs.attributes.get(name)) {
        sentences.push(given.meaning.clone());
    }
    sentences
}
