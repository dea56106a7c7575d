//! Finds out where a program goes wrong, by its values and without pictures.
//!
//! The interpreter computes every expression of a student's program at points on the surfaces of the test scenes
//! (`samples`, `program`). The light equation gives the right values of all quantities there, and the catalogue
//! those of known mistakes (`model`). A cause is proven by a counterfactual: with the right value instead of one
//! expression's own, the whole picture becomes right (`target`, [`search`]).

mod assign;
pub mod edit;
pub(crate) mod formula;
pub(crate) mod model;
pub mod naming;
pub(crate) mod observed;
pub(crate) mod program;
pub mod quantity_of;
pub(crate) mod repair;
pub(crate) mod samples;
pub(crate) mod scope;
pub mod search;
pub(crate) mod target;
pub(crate) mod values;
pub(crate) mod words;

use crate::mistakes::ModelSolution;
use crate::roles::{Bindings, NamesFile, Role};
use crate::rules::SourceConstants;
use crate::search::{Parameterisation, Second, Task};
use crate::testbench::TestScene;
use edit::{Editor, TextFix, Trial};
use gonio_glsl::{Checked, Parsed, Stage};
use model::{AnswerMethod, Model};
use observed::Observer;
use program::{Program, Runner};
pub use samples::SceneSamples;
use scope::Scopes;
use search::{Found, Search};
use target::RightPicture;

/// Why values cannot be judged.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NotJudged {
    /// The interpreter does not run a construct.
    Unsupported(String),
    /// It takes too long for many counterfactuals.
    TooLong,
    /// The program is lit by more lights than the equation of these quantities has.
    SeveralLights,
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
    /// Single runs of scenes.
    pub runs: usize,
    /// Edits with which every scene is right, the most promising first; empty if none were found.
    pub fixes: Vec<TextFix>,
}

/// Most methods that are searched for causes.
const MOST_METHODS: usize = 2;

/// Most proven fixes that are kept for the driver.
const MOST_FIXES: usize = 2;

/// The methods of right answers to a task, the usual one first.
fn methods(task: &Task) -> Vec<AnswerMethod> {
    let plain = |model| AnswerMethod { model, normal_kept: false, half_vector: false };
    let mut all = Vec::new();
    for model in std::iter::once(task.model).chain(task.other.map(|(model, _)| model)) {
        all.push(plain(model));
        if model != ModelSolution::Gouraud {
            all.push(AnswerMethod { normal_kept: true, ..plain(model) });
        }
        if model.is_lit() && task.required[2] {
            let half: Vec<AnswerMethod> = all.iter().filter(|method| method.model == model).copied().collect();
            all.extend(half.into_iter().map(|method| AnswerMethod { half_vector: true, ..method }));
        }
    }
    all
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
    vertex: (&Parsed, &Checked),
    fragment: (&Parsed, &Checked),
    texts: [&str; 2],
    names: &NamesFile,
    constants: &SourceConstants,
) -> Result<Diagnosis, NotJudged> {
    let mut program = Program::new(vertex, fragment, texts, names)
        .map_err(|(stage, why)| NotJudged::Unsupported(format!("{stage}: {why}")))?;
    let (scenes, [whole, _]) = task.test_scenes();
    if scenes.iter().take(1).any(|scene| is_long(&program, scene)) {
        return Err(NotJudged::TooLong);
    }
    let first: Vec<SceneSamples> = (scenes.iter().take(1).cloned())
        .map(|mut scene| {
            scene.light.position = constants.light_position.unwrap_or(scene.light.position);
            SceneSamples::new(scene)
        })
        .collect();
    if assign::is_open(&program) {
        let plain = methods(task).into_iter().map(|method| Model::new(method, &first, 1.0, false));
        let plain = plain.collect::<Result<Vec<_>, _>>().map_err(NotJudged::Unsupported)?;
        assign::assign(&mut program, &first, &plain);
    }
    let bindings = program.bindings.clone();
    let parameterisation = Parameterisation::new(task, &program.bindings, &program.declared, constants);
    if parameterisation.second != Second::None {
        return Err(NotJudged::SeveralLights);
    }
    let samples: Vec<SceneSamples> = (scenes.into_iter().take(whole))
        .map(|mut scene| {
            parameterisation.apply(&mut scene);
            SceneSamples::new(scene)
        })
        .collect();
    let runner = Runner::new(&program, &samples);
    let model_of = |method: AnswerMethod, has_mistakes: bool| {
        Model::new(method, &samples, parameterisation.written_exponent.unwrap_or(1.0), has_mistakes)
            .map_err(NotJudged::Unsupported)
    };
    let mut best = None;
    let mut runs = 0;
    let mut wrong = Vec::new();
    for method in methods(task) {
        let model = model_of(method, false)?;
        let Some(target) = RightPicture::new(&model, task, &parameterisation, &samples) else { continue };
        let mut search = Search::new(Observer { runner: &runner, model: &model }, &target);
        match search.is_right() {
            None => {
                return Ok(Diagnosis { found: Found::Endless, method, bindings, runs, fixes: Vec::new() });
            }
            Some(Some(agreement)) => {
                return Ok(Diagnosis { found: Found::Right(agreement), method, bindings, runs, fixes: Vec::new() });
            }
            Some(None) => wrong.push((method, search.at.likeness())),
        }
    }
    let is_lit_at = |stage: Stage| {
        let inputs = program.stage(stage).inputs.iter();
        let mut roles = inputs.filter_map(|input| program.role(&input.name));
        roles.any(|role| matches!(role, Role::LightPos(_) | Role::LightPosInView(_) | Role::LightDirection(_)))
    };
    let has_dot = |checked: &Checked| checked.functions_used.contains("dot");
    let is_gouraud =
        !is_lit_at(Stage::Fragment) && (is_lit_at(Stage::Vertex) || has_dot(vertex.1) && !has_dot(fragment.1));
    // The methods that the program resembles most, the usual one first among equals.
    wrong.sort_by_key(|(method, likeness)| {
        let is_other_stage = task.model.is_lit() && (method.model == ModelSolution::Gouraud) != is_gouraud;
        (is_other_stage, std::cmp::Reverse(*likeness))
    });
    for (method, _) in wrong.iter().take(MOST_METHODS) {
        let model = model_of(*method, true)?;
        let Some(target) = RightPicture::new(&model, task, &parameterisation, &samples) else { continue };
        let mut search = Search::new(Observer { runner: &runner, model: &model }, &target);
        let found = search.run();
        runs += search.runs();
        let rank = found.rank();
        if best.as_ref().is_none_or(|(_, _, known)| rank < *known) {
            best = Some((found, *method, rank));
        }
        if rank == 0 {
            break;
        }
    }
    let (found, method) = match best {
        Some((found, method, _)) => (found, method),
        None => (Found::Nothing, methods(task)[0]),
    };
    let mut fixes = Vec::new();
    if let Found::Causes(groups) = &found {
        let model = model_of(method, true)?;
        if let Some(target) = RightPicture::new(&model, task, &parameterisation, &samples) {
            let at = Observer { runner: &runner, model: &model };
            let scopes = [Scopes::new(vertex.0, vertex.1), Scopes::new(fragment.0, fragment.1)];
            let trial = Trial { at, target: &target, texts, names };
            let tried = Editor::new(at, scopes, texts).fixes(groups);
            fixes = tried.into_iter().filter(|fix| trial.is_right(fix)).take(MOST_FIXES).collect();
        }
    }
    Ok(Diagnosis { found, method, bindings, runs, fixes })
}
