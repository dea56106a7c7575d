//! The parameterisation of a program: which quantities are inputs, and which are written in the source and cannot be
//! varied.

use super::task::Task;
use crate::roles::{Bindings, Role};
use crate::source::{ConstantSun, SourceConstants};
use crate::testbench::{TestLight, TestScene};
use glam::{Mat3, Vec3};

/// The exponent in the lab's programs.
const USUAL_EXPONENT: f32 = 32.0;

/// Ward's alpha in the lab.
const USUAL_ROUGHNESS: f32 = 0.2;

/// The exponents with which a highlight shows in the test scenes.
const EXPONENTS: std::ops::RangeInclusive<f32> = 2.0..=128.0;

/// A light with a direction instead of a position.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Sun {
    /// The direction is an input.
    Given {
        /// Whether it is used as the direction towards the light.
        points_to_light: bool,
    },
    Constant(ConstantSun),
}

/// Whether a program has a second light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Second {
    /// There is no second light.
    None,
    /// There is one that can be switched off.
    Switched,
    /// Only the position of the second light is an input.
    Always,
}

/// The brightness of several colours of one object, if the strengths of all terms are fitted.
const GREY: f32 = 0.5;

/// The lights of a model solution, and those to which a hypothesis applies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lights {
    /// One light.
    One,
    /// The sum of both.
    Both,
    /// Only the first of two.
    First,
    /// Only the second of two.
    Second,
    /// Only the second of two, with an ambient term that belongs to neither.
    SecondOneAmbient,
    /// Only the second of two, with the ambient terms of both.
    SecondAllAmbient,
    /// Both, with one ambient term that belongs to neither.
    OneAmbient,
    /// Both, with a common ambient term that is added for each.
    EachAmbient,
    /// Both, with the mistake only in the second.
    WrongInSecond,
    /// Both, with the mistake only in the first.
    WrongInFirst,
}

impl Lights {
    /// Whether only the last light is there, because it overwrites the others.
    pub fn is_last(self) -> bool {
        matches!(self, Lights::Second | Lights::SecondOneAmbient | Lights::SecondAllAmbient)
    }

    /// Returns the lights, each with whether the hypothesis applies to it.
    pub fn each(self) -> &'static [(usize, bool)] {
        match self {
            Lights::One | Lights::First => &[(0, true)],
            Lights::Second | Lights::SecondOneAmbient | Lights::SecondAllAmbient => &[(1, true)],
            Lights::Both | Lights::OneAmbient | Lights::EachAmbient => &[(0, true), (1, true)],
            Lights::WrongInSecond => &[(0, false), (1, true)],
            Lights::WrongInFirst => &[(0, true), (1, false)],
        }
    }

    /// The mistake, by its id, if these lights are one themselves.
    pub fn mistake(self) -> Option<&'static str> {
        match self {
            Lights::First => Some("second-light-missing"),
            Lights::Second | Lights::SecondOneAmbient | Lights::SecondAllAmbient => Some("lights-overwritten"),
            Lights::EachAmbient => Some("ambient-twice"),
            _ => None,
        }
    }
}

/// The parameterisation of a program: whether its quantities are inputs that can be varied, and the values of the
/// others.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameterisation {
    /// For ambient, diffuse and specular: whether the strength is not an input, so that it must be fitted.
    pub to_find: [bool; 3],
    /// For the same terms: whether the strength is an input although the material's colour is not.
    pub given: [bool; 3],
    /// For the same terms: the usual strength in the exercise.
    usual: [f32; 3],
    /// Whether the material's colour is an input.
    material: bool,
    /// Whether the ambient light may have a colour of its own, beside the material's.
    pub own_ambient: bool,
    light_position: Option<Vec3>,
    shininess: Option<f32>,
    roughness: Option<f32>,
    /// The exponent written in the source, which mistakes of the catalogue call `written_exponent`.
    pub written_exponent: Option<f32>,
    attenuation: [Option<f32>; 3],
    refraction_index: Option<f32>,
    /// The second light.
    pub second: Second,
    /// Whether ambient, diffuse, specular and attenuation are separate inputs of the second light.
    own: [bool; 4],
    /// Whether it has its own colour.
    coloured: bool,
    /// Whether the number of lights is an input.
    counted: bool,
    /// Whether there are more than two lights; the others are dark.
    has_more: bool,
    other_light: Option<Vec3>,
    sun: Option<Sun>,
    /// Whether the up direction is not an input, so that the program assumes Y.
    upright: bool,
    /// Whether the material is white although several inputs give its colour.
    pub white_material: bool,
}

/// Whether a role determines the up direction of the camera.
fn determines_up(role: Role) -> bool {
    matches!(
        role,
        Role::WorldUp
            | Role::ViewUp
            | Role::ViewRight
            | Role::View
            | Role::ModelView
            | Role::ViewProjection
            | Role::ModelViewProjection
    )
}

/// Whether a program has the exercises' own inputs: an exponent, or a name that only the lab uses.
fn is_of_the_lab(declared: &Bindings) -> bool {
    declared.bound.iter().any(|bound| bound.role == Role::Shininess) || has_lab_names(declared)
}

/// Whether a program has a name that only the lab uses.
fn has_lab_names(declared: &Bindings) -> bool {
    const NAMES: [&str; 4] = ["itM", "u_light_pos", "u_view_pos", "materialColour"];
    let all = declared.bound.iter().map(|bound| &bound.declared).chain(&declared.unknown);
    all.into_iter().any(|declared| NAMES.contains(&declared.name.as_str()))
}

impl Parameterisation {
    /// Determines the parameterisation of a program with these bindings, which may declare strengths and colours
    /// without using them.
    pub fn new(task: &Task, bindings: &Bindings, declared: &Bindings, constants: &SourceConstants) -> Self {
        let has = |is_match: &dyn Fn(Role) -> bool| bindings.bound.iter().any(|bound| is_match(bound.role));
        let bindings_or_source = |is_match: &dyn Fn(Role) -> bool| {
            bindings.bound.iter().chain(&declared.bound).any(|bound| is_match(bound.role))
        };
        // Only one exercise has strengths as inputs; elsewhere an unused declaration is a leftover.
        let has_or_declares =
            |is_match: &dyn Fn(Role) -> bool| has(is_match) || (task.attenuated && bindings_or_source(is_match));
        let is_material = |role| {
            matches!(role, Role::MaterialColor | Role::MaterialAmbient | Role::MaterialDiffuse | Role::MaterialSpecular)
        };
        // If a texture gives the colour, an unused declaration of a colour is a leftover.
        let is_textured = has(&|role| role == Role::DiffuseTexture);
        // A colour for the highlight alone is not the object's.
        let is_whole = |role| is_material(role) && role != Role::MaterialSpecular;
        let material = if is_textured { has(&is_whole) } else { bindings_or_source(&is_whole) };
        let given = [
            has_or_declares(&|role| role.scales(0)),
            has_or_declares(&|role| role.scales(1)),
            has_or_declares(&|role| role.scales(2)),
        ];
        let has_ambient_colour = bindings.bound.iter().any(|bound| {
            matches!(bound.role, Role::AmbientColor(_) | Role::MaterialAmbient) && bound.declared.glsl_type != "float"
        });
        // A term that the exercise does not ask for is optional.
        let to_find =
            std::array::from_fn(|term| task.model.is_lit() && !(given[term] && material && task.required[term]));
        let is_direction = |role| matches!(role, Role::LightDirection(_) | Role::LightDirectionInView(_));
        let lit_from_outside =
            has(&|role| matches!(role, Role::LightPos(_) | Role::LightPosInView(_)) || is_direction(role));
        // Whether an input with such a role belongs to this light, from 0, or a later one.
        let of_light = |light: u32, is_match: &dyn Fn(Role) -> bool| {
            bindings.bound.iter().any(|bound| {
                // Element i of an array belongs to light i.
                let last = bound.role.light().map(|first| first.saturating_add(bound.declared.array.max(1) - 1));
                last.is_some_and(|last| last >= light) && is_match(bound.role)
            })
        };
        let of_second = |is_match: &dyn Fn(Role) -> bool| of_light(1, is_match);
        // A direction alone is that of a sun, but the exercises have lamps: it stays dark.
        let is_place = |role| matches!(role, Role::LightPos(_) | Role::LightPosInView(_));
        let coloured = of_second(&|role| matches!(role, Role::LightColor(_)));
        let own = [
            of_second(&|role| role.scales(0)),
            of_second(&|role| role.scales(1)),
            of_second(&|role| role.scales(2)),
            of_second(&|role| role.is_of_attenuation()),
        ];
        let second = if !of_second(&is_place) {
            Second::None
        } else if coloured || own[1] || own[2] || has(&|role| role == Role::LightCount) {
            Second::Switched
        } else {
            Second::Always
        };
        let fixed = |given: bool, written: Option<f32>, usual: f32| (!given).then(|| written.unwrap_or(usual));
        // Beside a position, a direction is the axis of a lamp.
        let is_given = has(&is_direction) && !has(&is_place);
        // The position of the exercise's lamp is not a direction.
        let is_lamp = |sun: &ConstantSun| sun.to_light.dot(task.light_position.normalize_or_zero()) > 0.9999;
        let sun = match constants.sun.filter(|sun| !lit_from_outside && !is_lamp(sun)) {
            Some(sun) => Some(Sun::Constant(sun)),
            // A direction in view space is the position of a light at infinity, as in OpenGL's old pipeline.
            None => is_given.then(|| {
                let is_in_view = has(&|role| matches!(role, Role::LightDirectionInView(_)));
                Sun::Given { points_to_light: constants.points_to_light.unwrap_or(is_in_view) }
            }),
        };
        // The light of a sun does not decrease with distance.
        let usual = if task.attenuated && sun.is_none() { [1.0, 0.14, 0.07] } else { [1.0, 0.0, 0.0] };
        Parameterisation {
            to_find,
            given,
            usual: [0.0, 1.0, if task.required[2] { 1.0 } else { 0.0 }],
            material,
            // A strength is one of the material's colour, unless the exercise leaves the ambient term open.
            own_ambient: material && (!task.required[0] && !has_lab_names(declared) || has_ambient_colour),
            light_position: (!lit_from_outside).then(|| constants.light_position.unwrap_or(task.light_position)),
            // The exercises prescribe the exponent, so another constant is a mistake for those who answer with the
            // exercise's inputs. The lab's own exponent, a constant for one light and an input for another, is the same.
            shininess: match constants.shininess {
                Some(exponent) if exponent == USUAL_EXPONENT => Some(exponent),
                Some(exponent) if EXPONENTS.contains(&exponent) && !is_of_the_lab(declared) => Some(exponent),
                _ => fixed(has(&|role| role == Role::Shininess), None, USUAL_EXPONENT),
            },
            roughness: fixed(has(&|role| role == Role::Roughness), None, USUAL_ROUGHNESS),
            written_exponent: constants.shininess,
            attenuation: std::array::from_fn(|degree| {
                let is_given = has(&|role| match role {
                    Role::AttenuationConstant(_) => degree == 0,
                    Role::AttenuationLinear(_) => degree == 1,
                    Role::AttenuationQuadratic(_) => degree == 2,
                    role => matches!(role, Role::Attenuation(_)),
                });
                fixed(is_given, constants.attenuation[degree], usual[degree])
            }),
            refraction_index: fixed(
                has(&|role| matches!(role, Role::RefractionIndex | Role::RefractionRatio)),
                constants.refraction_index,
                1.52,
            ),
            second,
            own,
            coloured,
            counted: has(&|role| role == Role::LightCount),
            has_more: of_light(2, &is_place),
            other_light: constants.other_light.filter(|_| lit_from_outside),
            sun,
            upright: task.model.is_of_places() && !has(&determines_up),
            white_material: false,
        }
    }

    /// Returns the same with an input direction of the light that is used the other way: towards the light, or from it.
    /// `None` if there is no such input.
    pub fn with_turned_sun(&self) -> Option<Self> {
        let Some(Sun::Given { points_to_light }) = self.sun else { return None };
        Some(Parameterisation { sun: Some(Sun::Given { points_to_light: !points_to_light }), ..self.clone() })
    }

    /// Returns the same with a white material, if several inputs give the colour of the object, such as a texture and a
    /// colour: the program around the shaders sets one of them, and leaves the others white.
    pub fn with_white_material(&self, bindings: &Bindings) -> Option<Self> {
        let count_of = |role: Role| bindings.bound.iter().filter(|bound| bound.role == role).count();
        let is_textured = count_of(Role::DiffuseTexture) > 0;
        // Beside another colour, the material's ambient one belongs to another term.
        let count = count_of(Role::MaterialColor) + count_of(Role::MaterialDiffuse);
        let count = if is_textured { 1 + count + count_of(Role::MaterialAmbient) } else { count };
        (self.material && count > 1).then(|| Parameterisation { material: false, white_material: true, ..self.clone() })
    }

    /// Returns the lights of right answers: an ambient term without a light may belong to each light or to none.
    pub fn right_lights(&self) -> &'static [Lights] {
        match self.second {
            Second::None => &[Lights::One],
            _ if self.coloured && !self.own[0] => &[Lights::Both, Lights::OneAmbient],
            // How many of a list of lights have an ambient term is a choice too: the exercise has one.
            _ if self.counted && self.own[0] => &[Lights::Both, Lights::OneAmbient],
            _ => &[Lights::Both],
        }
    }

    /// Returns the lights of wrong answers: mistakes with one of two lights.
    pub fn wrong_lights(&self) -> &'static [Lights] {
        match self.second {
            Second::None => &[],
            _ if self.counted && !self.own[0] => {
                &[Lights::First, Lights::Second, Lights::EachAmbient, Lights::WrongInSecond, Lights::WrongInFirst]
            }
            _ if self.coloured && !self.own[0] => {
                &[Lights::First, Lights::Second, Lights::SecondOneAmbient, Lights::WrongInSecond, Lights::WrongInFirst]
            }
            _ if self.own[0] && !self.coloured => {
                &[Lights::First, Lights::Second, Lights::SecondAllAmbient, Lights::WrongInSecond, Lights::WrongInFirst]
            }
            _ => &[Lights::First, Lights::Second, Lights::WrongInSecond, Lights::WrongInFirst],
        }
    }

    /// Whether the second light can be dimmed alone.
    pub fn dims_second(&self) -> bool {
        self.second == Second::Switched && (self.coloured || self.own[1])
    }

    /// Whether the position of the light is a constant in the source.
    pub fn has_written_light(&self) -> bool {
        self.light_position.is_some() || self.other_light.is_some()
    }

    /// Changes a test scene for the model, lit by one of the lights: among the terms whose strengths are fitted, all
    /// but `term` are dark.
    pub fn apply_to_model(&self, test_scene: &mut TestScene, lights: Lights, light: usize, term: Option<usize>) {
        self.apply_for(test_scene, lights, light, |index, given, strength| {
            if term != Some(index) {
                0.0
            } else if given {
                strength
            } else {
                1.0
            }
        });
    }

    /// Changes a test scene for the model, lit by one of the lights: terms whose strengths are fitted have equal
    /// strengths.
    pub fn apply_whole(&self, test_scene: &mut TestScene, lights: Lights, light: usize) {
        let usual = |index: usize, given: bool, strength: f32| if given { strength } else { self.usual[index] };
        self.apply_for(test_scene, lights, light, usual);
    }

    fn apply_for(
        &self,
        test_scene: &mut TestScene,
        lights: Lights,
        light: usize,
        strength_of: impl Fn(usize, bool, f32) -> f32,
    ) {
        self.apply(test_scene);
        let is_last = lights.is_last();
        let is_second = light > 0 && !(is_last && self.counted && test_scene.other.is_none());
        let is_missing = is_second && test_scene.other.is_none();
        let is_one_ambient =
            matches!(lights, Lights::OneAmbient | Lights::SecondOneAmbient) || !self.own[0] && !self.coloured;
        if is_second {
            let first = test_scene.light;
            test_scene.light = test_scene.other.unwrap_or_else(|| first.dark());
            // An ambient term that belongs to no light is there beside the last one too.
            if is_one_ambient && is_last {
                // The last of more lights is dark.
                if self.has_more && !self.counted {
                    test_scene.light = test_scene.light.dark();
                }
                test_scene.light.ambient = first.ambient;
            }
            if lights == Lights::SecondAllAmbient {
                test_scene.light.ambient += first.ambient;
            }
            test_scene.other = Some(first);
        }
        let light = &mut test_scene.light;
        let brightness = if self.coloured { light.brightness } else { 1.0 };
        let strengths = [&mut light.ambient, &mut light.diffuse, &mut light.specular];
        for (index, strength) in strengths.into_iter().enumerate() {
            if self.to_find[index] {
                *strength = strength_of(index, self.given[index], *strength);
            }
            *strength *= match index {
                0 if is_last && (is_one_ambient || lights == Lights::SecondAllAmbient) => 1.0,
                0 if is_one_ambient && lights != Lights::EachAmbient => f32::from(u8::from(!is_second)),
                _ if is_missing => 0.0,
                _ => brightness,
            };
        }
    }

    /// Changes a test scene to the inputs that the program has.
    pub fn apply(&self, test_scene: &mut TestScene) {
        if !self.material {
            // Fitted strengths take up any grey, and white in all of several colours would make every picture white.
            let is_grey = self.white_material && self.to_find == [true; 3];
            test_scene.material = if is_grey { Vec3::splat(GREY) } else { Vec3::ONE };
        }
        if let Some(position) = self.light_position {
            test_scene.light.position = position;
        }
        if self.upright {
            test_scene.up = Vec3::Y;
        }
        test_scene.shininess = self.shininess.unwrap_or(test_scene.shininess);
        test_scene.roughness = self.roughness.unwrap_or(test_scene.roughness);
        test_scene.refraction_index = self.refraction_index.unwrap_or(test_scene.refraction_index);
        for (constant, fixed) in test_scene.light.attenuation.iter_mut().zip(self.attenuation) {
            *constant = fixed.unwrap_or(*constant);
        }
        let centre = test_scene.world_from_model.w_axis.truncate();
        match self.sun {
            Some(Sun::Given { points_to_light }) => {
                test_scene.light = TestLight { points_to_light, ..test_scene.light.as_sun(centre) };
            }
            Some(Sun::Constant(sun)) => {
                let to_world = Mat3::from_mat4(test_scene.view_from_world()).transpose();
                let to_light = if sun.in_view { to_world * sun.to_light } else { sun.to_light };
                test_scene.light = TestLight { position: centre + to_light, ..test_scene.light }.as_sun(centre);
            }
            None => {}
        }
        let (light, elsewhere) = (test_scene.light, test_scene.elsewhere());
        match self.second {
            Second::None => test_scene.other = self.other_light.map(|position| TestLight { position, ..light.dark() }),
            Second::Always => test_scene.other = Some(TestLight { position: elsewhere, ..light }),
            // The second light shares the quantities that are not its own with the first.
            Second::Switched => {
                if let Some(other) = &mut test_scene.other {
                    other.diffuse = if self.own[1] { other.diffuse } else { light.diffuse };
                    other.specular = if self.own[2] { other.specular } else { light.specular };
                    other.attenuation = if self.own[3] { other.attenuation } else { light.attenuation };
                    other.ambient = if self.own[0] { other.ambient } else { light.ambient };
                }
            }
        }
    }
}
