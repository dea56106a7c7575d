//! The ways to solve a task, and which of them a program takes.

use super::answer::LightingMethod;
use super::answer::{AnswerMethod, Highlight, Space, Uncoloured};
use super::program::Program;
use crate::comparison::Task;
use crate::mistakes::ModelSolution;
use crate::roles::Role;
use gonio_glsl::Checked;

/// The methods of right answers to a task, the usual one first.
pub(super) fn methods(task: &Task) -> Vec<AnswerMethod> {
    let plain = AnswerMethod::new;
    let mut all = Vec::new();
    for model in std::iter::once(task.model).chain(task.other.map(|(model, _)| model)) {
        all.push(plain(model));
        if !model.is_per_vertex() {
            all.push(AnswerMethod { normal_kept: true, ..plain(model) });
        }
        if model.has_exponent() && task.required[2] {
            let half: Vec<AnswerMethod> = all.iter().filter(|method| method.model == model).copied().collect();
            all.extend(half.into_iter().map(|method| AnswerMethod { half_vector: true, ..method }));
        }
    }
    all
}

/// The methods of right answers with all choices of the highlight.
pub(crate) fn answer_methods(task: &Task) -> Vec<AnswerMethod> {
    let choices = [(false, false), (true, false), (false, true)];
    let with_highlights = |method: AnswerMethod| {
        let all = choices.into_iter().flat_map(move |(gated, weighted)| {
            // What the exercise does not ask for may have any colour.
            Uncoloured::all(!task.required[0]).iter().map(move |uncoloured| AnswerMethod {
                highlight: Highlight { gated, weighted, uncoloured: *uncoloured },
                ..method
            })
        });
        all.take(if method.model.is_lit() { usize::MAX } else { 1 })
    };
    methods(task).into_iter().flat_map(with_highlights).collect()
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

    /// The mistake that a program makes in any case: where light has to decrease with distance, it reads no constants of the
    /// attenuation and measures nothing.
    pub fn certain(&self, program: &Program) -> Option<&'static str> {
        const MEASURING: [&str; 4] = ["length", "distance", "sqrt", "inversesqrt"];
        let measures = |stage: usize| MEASURING.iter().any(|name| self.uses(stage, name));
        let has_constants = program.bindings.bound.iter().any(|bound| bound.role.is_of_attenuation());
        let is_missing = self.task.attenuated && !has_constants && !measures(0) && !measures(1);
        is_missing.then_some("attenuation-missing")
    }

    /// Whether some value depends on a condition.
    fn has_choice(&self) -> bool {
        let has_it = |text: &str| ["if", "?", "step", "sign"].iter().any(|word| text.contains(word));
        self.texts.iter().any(|text| has_it(text))
    }

    /// Whether a peculiarity of right answers may be that of the program.
    pub fn is_likely(&self, id: &str) -> bool {
        let has_highlight = self.task.required[2] || self.uses(0, "pow") || self.uses(1, "pow");
        match id {
            "specular-half-vector" => has_highlight && !self.uses(0, "reflect") && !self.uses(1, "reflect"),
            "normal-kept-unnormalised" => !self.uses(0, "normalize"),
            "specular-gated" => has_highlight && self.has_choice(),
            "specular-held" => !self.has_choice(),
            "specular-reflection-normalised" => self.texts.iter().any(|text| normalises_reflection(text)),
            "specular-cosine-weighted" | "specular-not-coloured" => has_highlight,
            _ => true,
        }
    }

    /// The methods with which a picture may be explained: in the stage and the space in which the program computes
    /// light.
    pub fn methods(&self, program: &Program) -> Vec<LightingMethod> {
        let model = match (self.task.model.is_lit(), self.is_gouraud()) {
            (true, true) if self.task.model.has_exponent() => ModelSolution::Gouraud,
            (true, false) if self.task.model.has_exponent() => ModelSolution::Phong,
            (true, true) if self.task.model.has_roughness() => ModelSolution::WardPerVertex,
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

/// Whether a text normalises a reflected vector: `reflect(...)`, its formula, or a variable that is set to one of them.
fn normalises_reflection(text: &str) -> bool {
    const NORMALIZE: &str = "normalize(";
    let text: String = text.chars().filter(|c| !c.is_whitespace()).collect();
    let is_reflected = |value: &str| value.starts_with("reflect(") || value.starts_with('2') || value.starts_with("(2");
    text.match_indices(NORMALIZE).any(|(at, _)| {
        let argument = &text[at + NORMALIZE.len()..];
        let name: &str = &argument[..argument.find(')').unwrap_or(0)];
        let is_set = || text.match_indices(&format!("{name}=")).any(|(at, set)| is_reflected(&text[at + set.len()..]));
        is_reflected(argument) || !name.is_empty() && is_set()
    })
}
