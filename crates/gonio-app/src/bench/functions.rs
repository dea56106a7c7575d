//! The functions on the bench: models and files with the values of their parameters.

use super::job::Job;
use crate::files::base_name;
use crate::platform::Platform;
use egui::Context;
use gonio_bsdf::{BsdfModel, ModelSpec, NamedBsdf, NamedBsdfError, ParameterValues};
use gonio_language::tr;
use gonio_plot::MOST_FUNCTIONS;

/// The functions of a bench that is opened for the first time: three highlights of about the same width.
const FIRST: [&str; 3] = ["phong-normalised", "blinn-normalised:c=128", "ward-normalised:c=0.12"];

/// A function on the bench.
pub struct BenchFunction {
    /// The function with its present values.
    pub named: NamedBsdf,
    /// The index of its colour in the palette.
    pub color: usize,
    /// Whether it is plotted.
    pub is_shown: bool,
    /// Whether its parameters are listed.
    pub is_unfolded: bool,
    /// Why its last values cannot be used, in one sentence.
    pub error: Option<String>,
    /// A number that no other function, and no other values of this one, have had.
    pub version: u64,
}

/// A file that was opened: its function, or one sentence on why there is none.
type OpenedFile = Result<NamedBsdf, String>;

/// The functions, and files that are being read.
#[derive(Default)]
pub struct BenchFunctions {
    /// The functions in order.
    pub list: Vec<BenchFunction>,
    /// The index of the function that is checked.
    pub chosen: usize,
    opening: Vec<Job<OpenedFile>>,
    versions: u64,
}

impl BenchFunctions {
    /// The functions of a new bench.
    pub fn first() -> Self {
        let specs = FIRST.into_iter().filter_map(|text| ModelSpec::parse(text).ok());
        Self::of(specs.map(|spec| NamedBsdf::of_model(&spec)).collect())
    }

    /// These functions, of which the palette has colours for the first seven.
    pub fn of(named: Vec<NamedBsdf>) -> Self {
        let mut functions = BenchFunctions::default();
        named.into_iter().take(MOST_FUNCTIONS).for_each(|named| functions.push(named));
        if let Some(function) = functions.list.first_mut() {
            function.is_unfolded = true;
        }
        functions.chosen = 0;
        functions
    }

    /// Adds a model with its defaults. An error is one sentence.
    pub fn add_model(&mut self, model: &'static BsdfModel) -> Result<(), String> {
        self.add(NamedBsdf::of_model(&ModelSpec::new(model)))
    }

    fn add(&mut self, named: NamedBsdf) -> Result<(), String> {
        if self.list.len() >= MOST_FUNCTIONS {
            return Err(tr!("bench-was-not-added-the-bench-holds", name = named.name, MOST_FUNCTIONS = MOST_FUNCTIONS));
        }
        self.list.iter_mut().for_each(|function| function.is_unfolded = false);
        self.push(named);
        self.list.iter_mut().next_back().into_iter().for_each(|function| function.is_unfolded = true);
        Ok(())
    }

    fn push(&mut self, named: NamedBsdf) {
        let is_free = |color: &usize| !self.list.iter().any(|function| function.color == *color);
        let color = (0..MOST_FUNCTIONS).find(is_free).unwrap_or(0);
        self.versions += 1;
        let version = self.versions;
        self.list.push(BenchFunction { named, color, is_shown: true, is_unfolded: false, error: None, version });
        self.chosen = self.list.len() - 1;
    }

    /// Removes a function.
    pub fn remove(&mut self, index: usize) {
        if index < self.list.len() {
            self.list.remove(index);
        }
        if self.chosen > index || self.chosen >= self.list.len() {
            self.chosen = self.chosen.saturating_sub(1);
        }
    }

    /// Gives a function other values.
    pub fn set_values(&mut self, index: usize, values: ParameterValues) {
        let Some(function) = self.list.get_mut(index) else { return };
        match function.named.with_values(values.clone()) {
            Ok(named) => {
                self.versions += 1;
                (function.named, function.version, function.error) = (named, self.versions, None);
            }
            Err(error) => {
                // The sliders keep the values, the plot keeps the function that ended.
                function.named.values = values;
                function.error = Some(format!("{}:{error}", function.named.name));
            }
        }
    }

    /// Starts to read files. The bench takes the functions when they are ready.
    pub fn open(&mut self, files: Vec<(String, Vec<u8>)>, platform: &mut dyn Platform, ctx: &Context) {
        for (name, bytes) in files {
            self.opening.push(Job::start(platform, ctx, move || read(&name, &bytes)));
        }
    }

    /// Whether files are being read.
    pub fn is_opening(&self) -> bool {
        !self.opening.is_empty()
    }

    /// Takes the functions of files that were read. Returns warnings and errors, a sentence each, and whether each is an error.
    pub fn take_opened(&mut self) -> Vec<(bool, String)> {
        let mut sentences = Vec::new();
        for job in std::mem::take(&mut self.opening) {
            match job.poll() {
                None => self.opening.push(job),
                Some(Some(Ok(named))) => {
                    sentences
                        .extend(named.warnings.iter().map(|warning| (false, format!("{}: {warning}", named.name))));
                    sentences.extend(self.add(named).err().map(|error| (true, error)));
                }
                Some(Some(Err(error))) => sentences.push((true, error)),
                Some(None) => sentences.push((true, tr!("bench-a-file-could-not-be-read").into())),
            }
        }
        sentences
    }

    /// The function that is checked.
    pub fn chosen(&self) -> Option<&BenchFunction> {
        self.list.get(self.chosen)
    }
}

/// Reads a file. An error is `FILE:LINE:COLUMN: MESSAGE` where the place is known.
fn read(name: &str, bytes: &[u8]) -> OpenedFile {
    let name = base_name(name);
    NamedBsdf::of_file(name, bytes, "").map_err(|error| match error {
        NamedBsdfError::Brdf(error) => format!("{name}:{error}"),
        error => format!("{name}: {error}"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio_bsdf::MODELS;

    #[test]
    fn colours_stay_with_their_functions() {
        let mut functions = BenchFunctions::first();
        assert_eq!(functions.list.iter().map(|f| f.color).collect::<Vec<_>>(), [0, 1, 2]);
        functions.remove(1);
        assert_eq!(functions.list.iter().map(|f| f.color).collect::<Vec<_>>(), [0, 2]);
        assert!(functions.add_model(MODELS[0]).is_ok());
        assert_eq!(functions.list.iter().map(|f| f.color).collect::<Vec<_>>(), [0, 2, 1]);
        for model in &MODELS[1..5] {
            assert!(functions.add_model(model).is_ok());
        }
        assert!(functions.add_model(MODELS[5]).is_err_and(|error| error.contains("the bench holds 7 functions")));
        assert_eq!(functions.list.len(), MOST_FUNCTIONS);
    }

    #[test]
    fn removing_keeps_a_chosen_function() {
        let mut functions = BenchFunctions::first();
        functions.chosen = 2;
        functions.remove(0);
        assert_eq!((functions.chosen, functions.list.len()), (1, 2));
        functions.remove(1);
        functions.remove(0);
        functions.remove(0);
        assert!(functions.chosen().is_none() && functions.list.is_empty());
    }

    #[test]
    fn errors_of_files_name_line_and_column() {
        let error =
            read("folder/mine.glsl", b"vec3 BRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y)\n{\n    return 1.0 +;\n}\n");
        assert!(error.as_ref().is_err_and(|error| error.starts_with("mine.glsl:3:")), "{error:?}");
        assert!(read("a.binary", b"abc").is_err_and(|error| error.starts_with("a.binary: ")));
    }
}
