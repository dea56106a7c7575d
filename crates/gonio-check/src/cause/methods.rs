//! The ways to solve a task, and which of them a program takes.

use super::explain::LightingMethod;
use super::model::{AnswerMethod, Mistakes, Model, Recorded, STAGES, Space, observe};
use super::observed::SCALED;
use super::program::{Program, Runner};
use super::samples::SceneSamples;
use crate::mistakes::ModelSolution;
use crate::roles::Role;
use crate::search::Task;
use crate::testbench::TestScene;
use gonio_glsl::Checked;

/// The methods of right answers to a task, the usual one first.
pub(super) fn methods(task: &Task) -> Vec<AnswerMethod> {
    let plain = AnswerMethod::new;
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

/// The functions that a program uses, which tell the methods that it may take.
pub(super) struct Hints<'a> {
    task: &'a Task,
    stages: [&'a Checked; 2],
    texts: [&'a str; 2],
}

impl<'a> Hints<'a> {
    /// Creates the hints of a vertex and a fragment shader.
    pub fn new(task: &'a Task, stages: [&'a Checked; 2], texts: [&'a str; 2]) -> Self {
        Hints { task, stages, texts }
    }

    fn uses(&self, stage: usize, name: &str) -> bool {
        self.stages[stage].functions_used.contains(name)
    }

    /// Whether the vertex shader computes the light.
    pub fn is_gouraud(&self) -> bool {
        const OF_LIGHT: [&str; 5] = ["dot", "normalize", "reflect", "pow", "inversesqrt"];
        let computes = |stage: usize| OF_LIGHT.iter().any(|name| self.uses(stage, name));
        self.task.model.is_lit() && computes(0) && !computes(1)
    }

    /// Whether a peculiarity of right answers may be that of the program.
    pub fn is_likely(&self, id: &str) -> bool {
        let has_highlight = self.task.required[2] || self.uses(0, "pow") || self.uses(1, "pow");
        match id {
            "specular-half-vector" => has_highlight && !self.uses(0, "reflect") && !self.uses(1, "reflect"),
            "normal-kept-unnormalised" => !self.uses(0, "normalize"),
            "specular-gated" => {
                let has_choice = |text: &str| ["if", "?", "step", "sign"].iter().any(|word| text.contains(word));
                has_highlight && self.texts.iter().any(|text| has_choice(text))
            }
            "specular-cosine-weighted" | "specular-not-coloured" => has_highlight,
            _ => true,
        }
    }

    /// The methods with which a picture may be explained: in the stage and the space in which the program computes
    /// light.
    pub fn methods(&self, program: &Program) -> Vec<LightingMethod> {
        let model = match (self.task.model.is_lit(), self.is_gouraud()) {
            (true, true) => ModelSolution::Gouraud,
            (true, false) => ModelSolution::Phong,
            _ => self.task.model,
        };
        let in_view = program.bindings.bound.iter().any(|bound| {
            matches!(bound.role, Role::LightPosInView(_) | Role::NormalMatrixOfModelView | Role::View | Role::ModelView)
        });
        let spaces =
            if in_view && self.task.model.is_lit() { &[Space::World, Space::View][..] } else { &[Space::World] };
        spaces.iter().map(|space| LightingMethod { model, space: *space }).collect()
    }
}

/// The mistakes whose own wrong values the program has.
pub(super) fn suspects(
    program: &Program,
    scenes: &[(TestScene, SceneSamples)],
    method: LightingMethod,
    written_exponent: f32,
) -> Vec<&'static str> {
    const PLACES: usize = 48;
    let of_program: Vec<SceneSamples> = scenes.iter().take(1).map(|(_, samples)| samples.few(PLACES)).collect();
    let runner = Runner::new(program, &of_program);
    let exprs = STAGES.map(|stage| program.numbers(stage));
    let observed = observe(&runner, &[], 0..of_program.len(), [&exprs[0], &exprs[1]]);
    let mut found = Vec::new();
    for half_vector in [false, true] {
        let of_answer = AnswerMethod { half_vector, ..AnswerMethod::new(method.model) };
        let Ok(model) = Model::new(of_answer, method.space, &of_program, written_exponent, Mistakes::All) else {
            continue;
        };
        for q in model.quantities.iter().filter(|q| q.is_direct) {
            let Some(mistake) = q.mistake else { continue };
            let is_scaled = SCALED.contains(&q.name.as_str());
            let is_it = |seen: &Recorded| {
                seen.stage == q.stage
                    && (seen.values.is_same(&q.values) || is_scaled && seen.values.factor_of(&q.values).is_some())
            };
            if !found.contains(&mistake.id.as_str()) && observed.iter().any(is_it) {
                found.push(mistake.id.as_str());
            }
        }
        if !method.model.is_lit() {
            break;
        }
    }
    found
}
