//! The model solutions, compiled: each with all its hypotheses as one program, and as methods write them.

use super::line_by_line::{LineByLine, Members, PointInputs, ways_of};
use super::model::ModelProgram;
use super::program::{Program, run_in_scene};
use crate::mistakes::{Hypotheses, Hypothesis, ModelSolution};
use gonio_glsl::Stage;
use gonio_interpreter::{CompiledStage, PointValues, StageInputs};
use std::collections::{BTreeSet, HashMap};
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};

/// One compiled program for all hypotheses of a model solution.
pub(crate) struct AllHypotheses {
    /// The hypotheses.
    pub hypotheses: Arc<Hypotheses>,
    pub(super) program: Program,
    /// Each stage line by line, unless it has branches or loops.
    lines: [OnceLock<Option<LineByLine>>; 2],
    /// For each stage, the changeable lines and the inputs that select their variants.
    ways: [Vec<(usize, usize)>; 2],
    /// Those of the vertex shader on which `gl_Position` depends, by their index among its changeable lines.
    pub(super) of_position: Vec<usize>,
    /// The inputs that are the written exponent.
    pub(super) exponent: [Option<usize>; 2],
}

/// The texts of a model solution, and the bits of the exponent that a student's program contains.
type ProgramKey = ([String; 2], u32);

/// Model solutions with their hypotheses, compiled on first use and kept for further programs.
#[derive(Default)]
pub struct ModelSolutions {
    known: Mutex<HashMap<ModelSolution, Arc<AllHypotheses>>>,
    hypotheses: Mutex<HashMap<ModelSolution, Arc<Hypotheses>>>,
    programs: Mutex<HashMap<ProgramKey, Arc<ModelProgram>>>,
}

/// Hypotheses from which on a stage is evaluated line by line.
pub(super) const LEAST_BY_LINES: usize = 6;
/// Most model solutions, as some method writes them, that are kept.
const MOST_PROGRAMS: usize = 64;

impl ModelSolutions {
    /// The hypotheses of a model solution.
    pub(crate) fn hypotheses(&self, model: ModelSolution) -> Arc<Hypotheses> {
        let mut known = locked(&self.hypotheses);
        Arc::clone(known.entry(model).or_insert_with(|| Arc::new(Hypotheses::for_model(model))))
    }

    /// A model solution in this text.
    ///
    /// # Errors
    /// It cannot be compiled; a test ensures that all can.
    pub(super) fn program(&self, texts: &[String; 2], written_exponent: f32) -> Result<Arc<ModelProgram>, String> {
        let key = (texts.clone(), written_exponent.to_bits());
        if let Some(known) = locked(&self.programs).get(&key) {
            return Ok(Arc::clone(known));
        }
        let new = Arc::new(ModelProgram::new(texts, written_exponent)?);
        let mut programs = locked(&self.programs);
        if programs.len() >= MOST_PROGRAMS {
            programs.clear();
        }
        programs.insert(key, Arc::clone(&new));
        Ok(new)
    }

    /// A model solution.
    ///
    /// # Errors
    /// The interpreter cannot run gonio's own shaders; a test ensures that it can.
    pub(crate) fn get(&self, model: ModelSolution) -> Result<Arc<AllHypotheses>, String> {
        if let Some(known) = locked(&self.known).get(&model) {
            return Ok(Arc::clone(known));
        }
        let new = Arc::new(AllHypotheses::new(self.hypotheses(model))?);
        locked(&self.known).insert(model, Arc::clone(&new));
        Ok(new)
    }
}

/// What is kept, which a panic elsewhere does not damage.
fn locked<T>(kept: &Mutex<T>) -> MutexGuard<'_, T> {
    kept.lock().unwrap_or_else(PoisonError::into_inner)
}

impl AllHypotheses {
    fn new(hypotheses: Arc<Hypotheses>) -> Result<Self, String> {
        let texts = hypotheses.sources();
        let parsed = [Stage::Vertex, Stage::Fragment].map(|stage| {
            let mut parsed = gonio_glsl::parse(&texts[stage as usize]);
            let checked = gonio_glsl::check(&mut parsed, stage);
            (parsed, checked)
        });
        let [vertex, fragment] = &parsed;
        let names = crate::comparison::model_names();
        let texts = texts.each_ref().map(String::as_str);
        let program = Program::new((&vertex.0, &vertex.1), (&fragment.0, &fragment.1), texts, &names)
            .map_err(|(stage, error)| format!("{stage}: {error}"))?;
        let of = |stage: Stage| {
            let input = |line: usize| program.stage(stage).input(&hypotheses.uniform(line)).map(|input| (line, input));
            (0..hypotheses.variables.len()).filter_map(input).collect()
        };
        let ways: [Vec<(usize, usize)>; 2] = [of(Stage::Vertex), of(Stage::Fragment)];
        let exponent = [Stage::Vertex, Stage::Fragment].map(|stage| program.stage(stage).input("written_exponent"));
        let position = hypotheses.with_parts(&BTreeSet::from(["gl_Position".to_owned()]));
        let is_of_position = |at: &usize| position.contains(&hypotheses.variables[ways[0][*at].0]);
        let of_position = (0..ways[0].len()).filter(is_of_position).collect();
        let lines = [OnceLock::new(), OnceLock::new()];
        Ok(AllHypotheses { hypotheses, program, lines, ways, of_position, exponent })
    }

    /// A stage line by line, if that is faster for this number of hypotheses.
    pub(super) fn lines(&self, stage: Stage, count: usize) -> Option<&LineByLine> {
        if count < LEAST_BY_LINES {
            return None;
        }
        let new = || {
            let names: Vec<String> =
                self.ways[stage as usize].iter().map(|(line, _)| self.hypotheses.uniform(*line)).collect();
            let texts = self.hypotheses.sources();
            LineByLine::new(self.program.stage(stage), &texts[stage as usize], &names)
        };
        self.lines[stage as usize].get_or_init(new).as_ref()
    }

    pub(super) fn choices(&self, stage: Stage, hypothesis: &Hypothesis) -> Vec<i32> {
        let ways = &self.ways[stage as usize];
        let mut chosen = vec![0; ways.len()];
        for (line, way) in &hypothesis.choices {
            // They are in the order of their lines.
            if let Ok(at) = ways.binary_search_by_key(line, |(line, _)| *line) {
                chosen[at] = *way as i32;
            }
        }
        chosen
    }

    /// The outputs of the vertex shader at its points with each of several choices.
    pub(super) fn run_vertices(&self, inputs: &StageInputs, choices: &[Vec<i32>]) -> Vec<PointValues> {
        let stage = &self.program.vertex;
        let points = inputs.points();
        if let Some(lines) = self.lines(Stage::Vertex, choices.len()) {
            let (mut same, mut given) = (Vec::new(), PointInputs::new());
            for input in 0..stage.inputs.len() {
                match inputs.values(input) {
                    Some(PointValues::Each { components, .. }) => given.push((input, components.clone())),
                    Some(values) => same.push((input, values.clone())),
                    None => {}
                }
            }
            let given_of = vec![0; choices.len()];
            return lines.run(&Members { points, choices, same: &same, given: &[&given], given_of: &given_of });
        }
        let mut inputs = repeated(inputs, stage, choices.len());
        let choices: Vec<&[i32]> = choices.iter().map(Vec::as_slice).collect();
        self.choose(Stage::Vertex, &choices, points, &mut inputs);
        run_in_scene(stage, &inputs).outputs
    }

    /// The outputs of the fragment shader at its points with each of several choices and their varyings.
    pub(super) fn run_fragments(
        &self,
        points: usize,
        choices: &[Vec<i32>],
        uniforms: &[(usize, PointValues)],
        varyings: &[&PointInputs],
    ) -> Vec<PointValues> {
        let stage = &self.program.fragment;
        if let Some(lines) = self.lines(Stage::Fragment, choices.len()) {
            let mut given: Vec<&PointInputs> = Vec::new();
            let mut known: HashMap<*const PointInputs, u32> = HashMap::new();
            let mut given_of = Vec::with_capacity(varyings.len());
            for one in varyings {
                let next = given.len() as u32;
                let at = *known.entry(std::ptr::from_ref(*one)).or_insert(next);
                if at == next {
                    given.push(one);
                }
                given_of.push(at);
            }
            return lines.run(&Members { points, choices, same: uniforms, given: &given, given_of: &given_of });
        }
        let mut inputs = StageInputs::new(stage, points * choices.len());
        for (input, values) in uniforms {
            inputs.set(*input, values.clone());
        }
        for (at, (input, first)) in varyings.first().into_iter().flat_map(|first| first.iter()).enumerate() {
            let of_all = |c: usize| varyings.iter().flat_map(|one| &one[at].1[c]).copied().collect();
            let components = (0..first.len()).map(of_all).collect();
            inputs.set(*input, PointValues::Each { components, written: None });
        }
        let choices: Vec<&[i32]> = choices.iter().map(Vec::as_slice).collect();
        self.choose(Stage::Fragment, &choices, points, &mut inputs);
        run_in_scene(stage, &inputs).outputs
    }

    /// Selects variants, one after the other for `points` points each.
    pub(super) fn choose(&self, stage: Stage, choices: &[&[i32]], points: usize, inputs: &mut StageInputs) {
        for (at, (_, input)) in self.ways[stage as usize].iter().enumerate() {
            inputs.set(*input, ways_of(choices.iter().map(|choices| choices[at]), points));
        }
    }
}

/// The values of points, several times one after the other.
pub(super) fn repeated(inputs: &StageInputs, stage: &CompiledStage, count: usize) -> StageInputs {
    let mut made = StageInputs::new(stage, inputs.points() * count);
    for input in 0..stage.inputs.len() {
        let Some(values) = inputs.values(input) else { continue };
        let values = match values {
            PointValues::Same(_) => values.clone(),
            PointValues::Each { components, .. } => {
                let components = components.iter().map(|all| all.repeat(count)).collect();
                PointValues::Each { components, written: None }
            }
        };
        made.set(input, values);
    }
    made
}
