//! How well the roles of inputs fit a program: by the number of its values that are quantities of the light equation.

use crate::cause::model::{Model, Recorded, STAGES, observe};
use crate::cause::program::{Program, Runner};
use crate::cause::samples::SceneSamples;
use crate::cause::target::on_screen;
use crate::cause::values::Values;
use crate::roles::Role;
use gonio_glsl::Stage;
use gonio_interpreter::ExprId;
use std::collections::{HashMap, HashSet};
use std::sync::{Mutex, PoisonError};

/// The roles of a program's inputs, and the settings of its switches.
type Assignment = (Vec<(String, Role)>, Vec<(String, Vec<u32>)>);

/// Places at which values are compared: many roles are tried.
const SCORED_PLACES: usize = 160;

/// Counts right values, once for each assignment of roles.
pub(in crate::cause) struct Scorer<'a> {
    scene: &'a SceneSamples,
    /// The first places of the scene.
    few: [SceneSamples; 1],
    quantities: Vec<(Stage, &'a Values)>,
    /// Whether the models have a light.
    pub is_lit: bool,
    known: Mutex<HashMap<Assignment, usize>>,
}

impl<'a> Scorer<'a> {
    /// Compares with the quantities of `models` in a scene, which is the first of theirs.
    pub fn new(scene: &'a SceneSamples, models: &'a [Model]) -> Self {
        let all = models.iter().flat_map(|model| &model.quantities).filter(|quantity| quantity.mistake.is_none());
        // Methods differ in a few quantities only.
        let mut seen = HashSet::new();
        let bits = |values: &Values| values.numbers.iter().map(|number| number.to_bits()).collect::<Vec<u32>>();
        let is_new = |(stage, values): &(Stage, &Values)| {
            seen.insert((*stage as usize, values.size, values.present.clone(), bits(values)))
        };
        let quantities = all.map(|quantity| (quantity.stage, &quantity.values)).filter(is_new).collect();
        let is_lit = models.iter().any(|model| model.method.model.is_lit());
        Scorer { scene, few: [scene.few(SCORED_PLACES)], quantities, is_lit, known: Mutex::default() }
    }

    /// How many expressions are quantities of the light equation.
    pub fn score(&self, program: &Program) -> usize {
        let roles = program.bindings.bound.iter().map(|bound| (bound.declared.name.clone(), bound.role)).collect();
        let bits = |values: &[f32]| values.iter().map(|value| value.to_bits()).collect();
        let fixed = program.bindings.fixed.iter().map(|fixed| (fixed.declared.name.clone(), bits(&fixed.values)));
        let assignment = (roles, fixed.collect());
        let known = || self.known.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(score) = known().get(&assignment) {
            return *score;
        }
        let score = self.count(program);
        known().insert(assignment, score);
        score
    }

    fn count(&self, program: &Program) -> usize {
        let runner = Runner::new(program, &self.few);
        // A name that is read counts where its value is computed.
        let exprs = STAGES.map(|stage| {
            let expressions = &program.stage(stage).source.expressions;
            let tokens = |expr: &ExprId| expressions[expr.0 as usize].tokens;
            let mut all = program.numbers(stage);
            all.retain(|expr| tokens(expr).first != tokens(expr).last);
            all
        });
        let observed = observe(&runner, &[], 0..1, [&exprs[0], &exprs[1]]);
        let is_known = |seen: &&Recorded| {
            let mut alike = self.quantities.iter().filter(|(stage, _)| *stage == seen.stage);
            !seen.values.is_constant() && alike.any(|(_, values)| values.is_same_of_first(&seen.values))
        };
        observed.iter().filter(is_known).count()
    }

    /// Whether every vertex is in its place.
    pub fn is_in_place(&self, program: &Program) -> bool {
        let SceneSamples { scene, mesh, .. } = self.scene;
        let clip_from_model = scene.clip_from_view() * scene.view_from_world() * scene.world_from_model;
        let runner = Runner::new(program, std::slice::from_ref(self.scene));
        let result = runner.start(0);
        let Some(position) = result.output(&program.vertex, "gl_Position") else { return false };
        let positions = mesh.positions.chunks_exact(3);
        positions.enumerate().all(|(vertex, at)| {
            let right = clip_from_model * glam::Vec3::from_slice(at).extend(1.0);
            let seen: [f32; 4] = std::array::from_fn(|component| position.float(component, vertex));
            on_screen(&seen, &right.to_array())
        })
    }
}
