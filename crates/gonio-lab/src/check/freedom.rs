//! What a program takes from outside, and what is written in it: only the former can be varied.

use super::task::Task;
use crate::names::{Bindings, Role};
use crate::stage::Situation;
use glam::Vec3;

/// Numbers that stand in the student's source where a uniform could be.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Written {
    /// In the world.
    pub light_position: Option<Vec3>,
    /// The exponent.
    pub shininess: Option<f32>,
    /// kc, kl, kq, where all three are there.
    pub attenuation: [Option<f32>; 3],
    /// Against air.
    pub refraction_index: Option<f32>,
}

/// What may be varied, and what is fixed to which value.
#[derive(Clone, Debug, PartialEq)]
pub struct Freedom {
    /// Of ambient, diffuse and specular: whether the strength is not given from outside, so that it has to be found.
    pub to_find: [bool; 3],
    /// Of the same: whether it is given all the same, and only the material's colour is not.
    given: [bool; 3],
    /// Of the same: what is usual in the exercise.
    usual: [f32; 3],
    /// Whether the material's colour is given from outside.
    material: bool,
    light_position: Option<Vec3>,
    shininess: Option<f32>,
    /// The exponent that stands in the source: what the bank's mistakes call `written_exponent`.
    pub written_exponent: Option<f32>,
    attenuation: [Option<f32>; 3],
    refraction_index: Option<f32>,
}

impl Freedom {
    /// Of a program that takes what is bound, and declares strengths and colours that it may not use.
    pub fn of(task: &Task, bindings: &Bindings, declared: &Bindings, written: &Written) -> Self {
        let has = |wanted: &dyn Fn(Role) -> bool| bindings.bound.iter().any(|bound| wanted(bound.role));
        let bindings_or_source = |wanted: &dyn Fn(Role) -> bool| {
            bindings.bound.iter().chain(&declared.bound).any(|bound| wanted(bound.role))
        };
        // Only one exercise gives strengths; elsewhere one that is declared and not used is a leftover.
        let has_or_declares =
            |wanted: &dyn Fn(Role) -> bool| has(wanted) || (task.attenuated && bindings_or_source(wanted));
        let material = bindings_or_source(&|role| {
            matches!(role, Role::MaterialColor | Role::MaterialAmbient | Role::MaterialDiffuse | Role::MaterialSpecular)
        });
        let given = [
            has_or_declares(&|role| matches!(role, Role::AmbientStrength(_) | Role::AmbientColor(_))),
            has_or_declares(&|role| matches!(role, Role::DiffuseStrength(_) | Role::DiffuseColor(_))),
            has_or_declares(&|role| matches!(role, Role::SpecularStrength(_) | Role::SpecularColor(_))),
        ];
        // A term that the exercise does not ask for may be there or not.
        let to_find =
            std::array::from_fn(|term| task.model.is_lit() && !(given[term] && material && task.wanted[term]));
        let lit_from_outside =
            has(&|role| matches!(role, Role::LightPos(_) | Role::LightPosInView(_) | Role::LightDirection(_)));
        let fixed = |given: bool, written: Option<f32>, usual: f32| (!given).then(|| written.unwrap_or(usual));
        let usual = if task.attenuated { [1.0, 0.14, 0.07] } else { [1.0, 0.0, 0.0] };
        Freedom {
            to_find,
            given,
            usual: [0.0, 1.0, if task.wanted[2] { 1.0 } else { 0.0 }],
            material,
            light_position: (!lit_from_outside).then(|| written.light_position.unwrap_or(task.light_position)),
            // The exercises give the exponent: another one that is written is no choice but a mistake.
            shininess: fixed(has(&|role| role == Role::Shininess), None, 32.0),
            written_exponent: written.shininess,
            attenuation: [
                fixed(has(&|role| matches!(role, Role::AttenuationConstant(_))), written.attenuation[0], usual[0]),
                fixed(has(&|role| matches!(role, Role::AttenuationLinear(_))), written.attenuation[1], usual[1]),
                fixed(has(&|role| matches!(role, Role::AttenuationQuadratic(_))), written.attenuation[2], usual[2]),
            ],
            refraction_index: fixed(
                has(&|role| matches!(role, Role::RefractionIndex | Role::RefractionRatio)),
                written.refraction_index,
                1.52,
            ),
        }
    }

    /// Whether some strengths have to be found.
    pub fn must_find(&self) -> bool {
        self.to_find.iter().any(|find| *find)
    }

    /// Changes a situation for the model: of the terms whose strengths have to be found, all but `term` are dark.
    pub fn apply_to_model(&self, situation: &mut Situation, term: Option<usize>) {
        self.apply(situation);
        let light = &mut situation.light;
        let strengths = [&mut light.ambient, &mut light.diffuse, &mut light.specular];
        for (index, strength) in strengths.into_iter().enumerate().filter(|(index, _)| self.to_find[*index]) {
            if term != Some(index) {
                *strength = 0.0;
            } else if !self.given[index] {
                *strength = 1.0;
            }
        }
    }

    /// Changes a situation for the model: terms whose strengths have to be found are of equal strength.
    pub fn apply_whole(&self, situation: &mut Situation) {
        self.apply(situation);
        let light = &mut situation.light;
        let strengths = [&mut light.ambient, &mut light.diffuse, &mut light.specular];
        for (index, strength) in strengths.into_iter().enumerate().filter(|(index, _)| self.to_find[*index]) {
            if !self.given[index] {
                *strength = self.usual[index];
            }
        }
    }

    /// Changes a situation to what the program can be given.
    pub fn apply(&self, situation: &mut Situation) {
        if !self.material {
            situation.material = Vec3::ONE;
        }
        if let Some(position) = self.light_position {
            situation.light.position = position;
        }
        situation.shininess = self.shininess.unwrap_or(situation.shininess);
        situation.refraction_index = self.refraction_index.unwrap_or(situation.refraction_index);
        for (constant, fixed) in situation.light.attenuation.iter_mut().zip(self.attenuation) {
            *constant = fixed.unwrap_or(*constant);
        }
    }
}
