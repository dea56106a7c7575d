//! Finds out where a program goes wrong, by its values and without pictures.
//!
//! The interpreter computes every expression of a student's program at points on the surfaces of the test scenes
//! (`samples`, `program`). The light equation gives the right values of all quantities there, and the catalogue
//! those of known mistakes (`model`). A cause is proven by a counterfactual: with the right value instead of one
//! expression's own, the whole picture becomes right (`target`, `search`).

mod answer;
mod assign;
mod budget;
mod built_in_lights;
mod candidate;
mod conclusion;
mod conventions;
mod diagnosing;
pub mod edit;
mod explain;
pub mod explanation;
mod few_places;
mod form;
pub(crate) mod formula;
pub mod found;
mod influence;
mod limits;
mod line_by_line;
mod methods;
pub(crate) mod model;
mod naming;
pub(crate) mod observed;
mod optics;
pub mod place;
mod prediction;
mod products;
pub(crate) mod program;
pub mod proven_cause;
pub mod quantity_of;
mod ranking;
mod recording;
pub(crate) mod repair;
pub mod right_change;
pub(crate) mod samples;
pub(crate) mod scope;
mod search;
mod seeing;
mod shown;
pub(crate) mod solutions;
mod steps;
mod symptoms;
pub(crate) mod target;
mod trial;
mod unused;
pub(crate) mod values;
mod ward;
pub(crate) mod words;

pub(crate) use answer::{AnswerMethod, Space, peculiarities};
pub(crate) use methods::answer_methods;

use crate::comparison::{Lights, Parameterisation, Second, Task};
use crate::mistakes::ModelSolution;
use crate::roles::{Bindings, NamesFile};
use crate::source::SourceConstants;
use crate::testbench::TestScene;
use conclusion::{Attempt, first_conclusion};
use diagnosing::Diagnosing;
use edit::TextFix;
use explain::MOST_PAIRS;
use explanation::{Explanation, Strengths};
pub(crate) use explanation::{is_absent, is_present};
use found::Found;
use gonio_glsl::{Checked, Parsed, Span, Stage};
use methods::{Hints, methods};
use model::{Mistakes, Model};
use place::MistakePlace;
use program::{Program, Runner};
pub use samples::SceneSamples;
pub use solutions::ModelSolutions;
use std::sync::{Arc, Mutex};

/// Why values cannot be judged.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NotJudged {
    /// The interpreter does not run a construct.
    Unsupported(String),
    /// It takes too long for many counterfactuals.
    TooLong,
}

/// What was found, and with which method of a right answer.
#[derive(Clone, Debug)]
pub struct Diagnosis {
    /// The result.
    pub found: Found,
    /// The method that it refers to.
    pub method: AnswerMethod,
    /// The roles of its inputs, found by their values where the names do not determine them.
    pub bindings: Bindings,
    /// Which quantities are inputs, with these roles.
    pub parameterisation: Parameterisation,
    /// The lights of the right answer.
    pub lights: Lights,
    /// The strengths of ambient, diffuse and specular light, where they are constants of the program and shown.
    pub strengths: Strengths,
    /// Single runs of scenes.
    pub runs: usize,
    /// Mistakes that explain the picture.
    pub explanations: Vec<Explanation>,
    /// Where the program makes these mistakes, as far as its values show it.
    pub places: Vec<MistakePlace>,
    /// Where the program computes the light in the stage of its method, and where in any: the places of a wrong stage, and
    /// of a term that is missing.
    pub light_places: [Option<(Stage, Span)>; 2],
    /// Edits with which every scene is right, the most promising first; empty if none were found.
    pub fixes: Vec<TextFix>,
    /// For ambient, diffuse and specular: whether a right program computes the term and never uses it.
    pub unused_terms: [bool; 3],
    /// Whether a right program draws diffuse light in steps.
    pub has_steps: bool,
    /// Whether the vertex shader of a right program limits its colours to 1.
    pub limits_colours: bool,
    /// Whether a right skybox is drawn at its own depth instead of the largest one.
    pub has_own_depth: bool,
}

/// Most statements of one scene, all points together; the exercises' own answers have about 3,000.
const MOST_STATEMENTS: u64 = 60_000;

/// Most expressions of both stages; students' programs have 100 to 400.
const MOST_EXPRESSIONS: usize = 1_500;

fn is_long(program: &Program, scene: &TestScene) -> bool {
    let expressions = |stage: Stage| program.stage(stage).source.expressions.len();
    if expressions(Stage::Vertex) + expressions(Stage::Fragment) > MOST_EXPRESSIONS {
        return true;
    }
    let samples = [SceneSamples::new(scene.clone())];
    let runner = Runner::new(program, &samples);
    let result = runner.run(0, &[], [&[], &[]]);
    result.vertex.statements + result.fragment.statements > MOST_STATEMENTS
}

/// Finds out whether a pair is right, and otherwise what makes it wrong.
///
/// # Errors
/// The reason why the values of this program cannot be judged.
pub fn diagnose(
    task: &Task,
    [vertex, fragment]: [(&Parsed, &Checked); 2],
    texts: [&str; 2],
    names: &NamesFile,
    constants: &SourceConstants,
    solutions: &Arc<ModelSolutions>,
    depth: DiagnosisDepth,
) -> Result<Diagnosis, NotJudged> {
    let named = Program::new(vertex, fragment, texts, names)
        .map_err(|(stage, why)| NotJudged::Unsupported(format!("{stage}: {why}")))?;
    let (scenes, [of_one, of_two]) = task.test_scenes();
    if scenes.iter().take(1).any(|scene| is_long(&named, scene)) {
        return Err(NotJudged::TooLong);
    }
    let named = built_in_lights::without_unused(named, &scenes);
    let mut assigned = named.clone();
    let mut by_influence = Vec::new();
    if assign::is_open(&assigned) {
        let parameterisation = Parameterisation::new(task, &assigned.bindings, &assigned.declared, constants);
        // In the first scene of a sky, no matrix turns anything.
        let telling = usize::from(task.model == ModelSolution::Skybox);
        let first: Vec<SceneSamples> = (scenes.iter().skip(telling).take(1).cloned())
            .map(|mut scene| {
                parameterisation.apply(&mut scene);
                scene.light.position = constants.light_position.unwrap_or(scene.light.position);
                SceneSamples::new(scene)
            })
            .collect();
        let plain = methods(task)
            .into_iter()
            .map(|method| Model::new(solutions, method, Space::World, &first, 1.0, Mistakes::These(&[])));
        let plain = plain.collect::<Result<Vec<_>, _>>().map_err(NotJudged::Unsupported)?;
        assign::assign(solutions, &mut assigned, &first, &plain);
        by_influence = assign::by_influence(&named, &assigned, &first[0], task.model.is_lit());
        // A light that is turned to view space shows which matrix is V.
        for program in by_influence.iter_mut().filter(|_| task.model.is_lit()) {
            assign::choose_open_matrices(program, &first, &plain);
        }
    }
    // A mistake may hide the roles: then those that the names tell explain more. Another convention makes no mistake.
    let by_values = by_influence.first().unwrap_or(&assigned);
    let mut others = conventions::other_conventions(by_values);
    for other in conventions::other_conventions(&named) {
        if others.iter().all(|known| known.bindings != other.bindings) {
            others.push(other);
        }
    }
    if task.model == ModelSolution::Skybox {
        others.extend(conventions::without_translation(&assigned));
    }
    // What a mistake changes in the number of right values may give inputs other roles.
    let of_values = if by_influence.is_empty() { Attempt::Whole } else { Attempt::Right };
    let mut programs: Vec<(&Program, Attempt)> = by_influence.iter().map(|one| (one, Attempt::Whole)).collect();
    programs.push((&assigned, of_values));
    programs.extend((named.bindings != assigned.bindings).then_some((&named, of_values)));
    let switched: Vec<Program> = programs.iter().flat_map(|(one, _)| assign::with_other_switches(one)).collect();
    // The sun's direction is a convention too, and so is which of several colours is the object's.
    let all = programs.clone();
    let whole = all.iter().filter(|(_, attempt)| *attempt == Attempt::Whole);
    programs.extend(whole.map(|(one, _)| (*one, Attempt::Turned)));
    programs.extend(all.iter().map(|(one, _)| (*one, Attempt::White)));
    programs.extend(switched.iter().map(|one| (one, Attempt::Right)));
    let is_new = |other: &&Program| other.bindings != assigned.bindings;
    programs.extend(others.iter().filter(is_new).map(|one| (one, Attempt::Single)));
    let hints = Hints::new(task, [vertex.1, fragment.1], texts);
    let stages = [vertex, fragment];
    let diagnosing = |one| {
        let (program, attempt): (&Program, Attempt) = one;
        let mut parameterisation = Parameterisation::new(task, &program.bindings, &program.declared, constants);
        match attempt {
            Attempt::Turned => parameterisation = parameterisation.with_turned_sun()?,
            Attempt::White => parameterisation = parameterisation.with_white_material(&program.bindings)?,
            _ => {}
        }
        let count = if parameterisation.second == Second::None { of_one } else { of_one + of_two };
        let applied = |mut scene: TestScene| {
            parameterisation.apply(&mut scene);
            SceneSamples::new(scene)
        };
        let scenes = scenes.iter().take(count).map(|scene| (scene.clone(), applied(scene.clone()))).collect();
        let one = Diagnosing {
            task,
            solutions,
            program,
            stages,
            texts,
            names,
            parameterisation,
            scenes,
            of_one,
            hints: &hints,
            // Other conventions share what one set of roles has.
            most_pairs: if attempt == Attempt::Single { MOST_PAIRS / (2 * others.len()).max(2) } else { MOST_PAIRS },
            shown: Mutex::default(),
        };
        Some((one, attempt))
    };
    first_conclusion(programs.into_iter().filter_map(diagnosing), depth).map_err(NotJudged::Unsupported)
}

/// How far a diagnosis goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DiagnosisDepth {
    /// Only whether the pair is right.
    Right,
    /// Also what makes it wrong.
    Causes,
}
