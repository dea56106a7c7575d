//! Varies the inputs of a program, and watches the colours.

use crate::cause::program::{Program, Runner};
use crate::cause::recording::{STAGES, observe};
use crate::cause::samples::SceneSamples;
use crate::cause::seeing::see;
use crate::roles::{Declared, Fixed};
use glam::Vec3;
use gonio_glsl::Stage;
use gonio_interpreter::ExprId;
use std::rc::Rc;

/// The share of numbers that may behave otherwise: where a clamp or a condition decides.
const MOST_OTHERS: f32 = 0.08;

/// An input without a role, or all elements of an array of structs that are the same member.
pub(super) struct Input {
    pub members: Vec<Declared>,
    /// The value of an element from which it is varied.
    pub base: Vec<f32>,
    pub is_exponent: bool,
}

/// What an input is, by its influence.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Influence {
    None,
    Exponent,
    /// The colour is linear in it; for a colour, each channel in its own component.
    Linear {
        is_colour: bool,
    },
    /// A number in which the colour is not linear.
    Number,
    Place,
}

/// A program whose inputs are varied.
pub(super) struct Probe<'a> {
    program: Program,
    samples: SceneSamples,
    inputs: &'a [Input],
    /// For each input, the slope of the colours where nothing else is different.
    slopes: Vec<Option<Rc<Slope>>>,
}

/// What is different from the start in a run.
#[derive(Clone, Default)]
pub(super) struct Varied {
    /// Inputs with other values.
    pub inputs: Vec<(usize, Vec<f32>)>,
    pub has_other_normals: bool,
    pub has_other_eye: bool,
    pub has_other_exponent: bool,
    pub has_other_light: bool,
    pub diffuse: Option<f32>,
}

/// How numbers change with an input.
pub(super) struct Slope {
    pub numbers: Vec<f32>,
    pub is_linear: bool,
}

/// The difference of numbers per step.
fn difference(a: &[f32], b: &[f32], step: f32) -> Vec<f32> {
    a.iter().zip(b).map(|(a, b)| (b - a) / step).collect()
}

impl<'a> Probe<'a> {
    pub fn new(program: Program, samples: SceneSamples, inputs: &'a [Input]) -> Self {
        Probe { program, samples, inputs, slopes: vec![None; inputs.len()] }
    }

    fn samples(&self, varied: &Varied) -> SceneSamples {
        let mut samples = self.samples.clone();
        if varied.has_other_normals {
            for normal in samples.mesh.normals.chunks_exact_mut(3) {
                let other = (Vec3::from_slice(normal) + Vec3::new(0.5, 0.4, -0.3)).normalize_or(Vec3::Y);
                normal.copy_from_slice(&other.to_array());
            }
        }
        if varied.has_other_eye {
            samples.scene.eye += Vec3::new(0.5, 0.4, 0.3);
        }
        if varied.has_other_exponent {
            samples.scene.shininess *= 1.5;
        }
        if varied.has_other_light {
            samples.scene.light.position += Vec3::new(0.5, 0.4, 0.3);
        }
        samples.scene.light.diffuse = varied.diffuse.unwrap_or(samples.scene.light.diffuse);
        samples
    }

    fn fix(&mut self, varied: &Varied) {
        self.program.bindings.fixed.retain(|fixed| {
            let is_probed = |input: &Input| input.members.contains(&fixed.declared);
            !self.inputs.iter().any(is_probed)
        });
        for (at, input) in self.inputs.iter().enumerate() {
            let other = varied.inputs.iter().find(|(input, _)| *input == at).map(|(_, value)| value.clone());
            let mut value = other.unwrap_or_else(|| input.base.clone());
            if input.is_exponent && varied.has_other_exponent {
                value.iter_mut().for_each(|x| *x *= 1.5);
            }
            let fixed = input.members.iter().map(|declared| {
                let values = value.repeat(declared.array.max(1) as usize);
                Fixed { declared: declared.clone(), values }
            });
            self.program.bindings.fixed.extend(fixed);
        }
    }

    /// The colours; `None` if a run does not end.
    pub fn colours(&mut self, varied: &Varied) -> Option<Vec<f32>> {
        self.fix(varied);
        let samples = [self.samples(varied)];
        let seen = see(&Runner::new(&self.program, &samples), &[], 0..1)?;
        Some(seen.colour.numbers)
    }

    /// The values of all expressions of numbers, in the order in which they are computed.
    fn values(&mut self, varied: &Varied) -> Vec<((Stage, ExprId, u32), Vec<f32>)> {
        self.fix(varied);
        let samples = [self.samples(varied)];
        let exprs = STAGES.map(|stage| self.program.numbers(stage));
        let runner = Runner::new(&self.program, &samples);
        let all = observe(&runner, &[], 0..1, [&exprs[0], &exprs[1]]);
        let all = all.into_iter().filter(|seen| seen.values.size == 1);
        all.map(|seen| ((seen.stage, seen.expr, seen.occurrence), seen.values.numbers)).collect()
    }

    fn with_factor(&self, at: usize, factor: f32, varied: &Varied) -> Varied {
        let value = self.inputs[at].base.iter().map(|x| x * factor).collect();
        let mut varied = varied.clone();
        varied.inputs.push((at, value));
        varied
    }

    /// How the colours change with a factor of an input.
    fn slope(&mut self, at: usize, varied: &Varied) -> Option<Slope> {
        let [first, second, third] =
            [1.0, 1.25, 1.75].map(|factor| self.colours(&self.with_factor(at, factor, varied)));
        let (first, second, third) = (first?, second?, third?);
        let numbers = difference(&first, &second, 0.25);
        let is_linear = !differ(&numbers, &difference(&second, &third, 0.5));
        Some(Slope { numbers, is_linear })
    }

    /// The slope of the colours where nothing else is different.
    fn own_slope(&mut self, at: usize) -> Option<Rc<Slope>> {
        if self.slopes[at].is_none() {
            self.slopes[at] = self.slope(at, &Varied::default()).map(Rc::new);
        }
        self.slopes[at].clone()
    }

    /// What an input is; `None` if a run does not end.
    pub fn influence(&mut self, at: usize) -> Option<Influence> {
        if self.inputs[at].is_exponent {
            return Some(Influence::Exponent);
        }
        let start = self.colours(&Varied::default())?;
        let slope = self.own_slope(at)?;
        let is_vector = self.inputs[at].base.len() > 1;
        let mut is_colour = is_vector;
        let mut is_changed = is_shown(&slope.numbers, &start);
        for component in 0..if is_vector { 3 } else { 0 } {
            let mut value = self.inputs[at].base.clone();
            value[component] += 0.4;
            let other = self.colours(&Varied { inputs: vec![(at, value)], ..Varied::default() })?;
            let of_channel = |channel: usize| {
                let change = other.iter().zip(&start).skip(channel).step_by(3).map(|(a, b)| a - b);
                change.collect::<Vec<f32>>()
            };
            for channel in 0..3 {
                let changes = is_shown(&of_channel(channel), &start);
                is_changed |= changes;
                is_colour &= channel == component || !changes;
            }
        }
        Some(match () {
            () if !is_changed => Influence::None,
            () if is_colour && slope.is_linear => Influence::Linear { is_colour: true },
            () if is_vector => Influence::Place,
            () if slope.is_linear => Influence::Linear { is_colour: false },
            () => Influence::Number,
        })
    }

    /// Whether the slope of an input depends on something else.
    fn depends(&mut self, at: usize, on: &Varied) -> bool {
        let (Some(before), Some(after)) = (self.own_slope(at), self.slope(at, on)) else {
            return false;
        };
        differ(&before.numbers, &after.numbers)
    }

    /// Whether the slope of an input depends on the exponent.
    pub fn depends_on_exponent(&mut self, at: usize) -> bool {
        self.depends(at, &Varied { has_other_exponent: true, ..Varied::default() })
    }

    /// The term to which a linear input belongs: 0 for ambient, 1 for diffuse and 2 for specular light. `by_exponent`:
    /// whether its slope depends on the exponent, which is decisive; `None` if no input's does. Then the eye decides, on
    /// which a wrong normal may depend too.
    pub fn term(&mut self, at: usize, places: &[usize], by_exponent: Option<bool>) -> usize {
        if !self.depends(at, &Varied { has_other_normals: true, ..Varied::default() }) {
            return 0;
        }
        let is_specular = by_exponent.unwrap_or_else(|| {
            self.depends(at, &Varied { has_other_eye: true, ..Varied::default() })
                || places.len() > 1 && places.iter().all(|place| self.depends(at, &self.moved(*place)))
        });
        if is_specular { 2 } else { 1 }
    }

    /// Whether the slope of an input depends on where the light is.
    pub fn depends_on_light(&mut self, at: usize, places: &[usize]) -> bool {
        self.depends(at, &Varied { has_other_light: true, ..Varied::default() })
            || places.iter().any(|place| self.depends(at, &self.moved(*place)))
    }

    /// Whether the object is black without an input.
    pub fn is_dark_without(&mut self, at: usize) -> bool {
        let dark = Varied { inputs: vec![(at, vec![0.0; self.inputs[at].base.len()])], ..Varied::default() };
        self.colours(&dark).is_some_and(|colours| colours.iter().all(|x| x.is_nan() || x.abs() <= 1e-4))
    }

    /// Whether the last word of an input's name is a letter.
    pub fn is_named(&self, at: usize, letter: char) -> bool {
        let name = &self.inputs[at].members[0].name;
        name.rsplit(['.', '_']).next().is_some_and(|word| word.chars().eq([letter]))
    }

    /// A place moved elsewhere.
    fn moved(&self, at: usize) -> Varied {
        let value = self.inputs[at].base.iter().zip([0.5, 0.3, 0.7, 0.0]).map(|(x, by)| x + by).collect();
        Varied { inputs: vec![(at, value)], ..Varied::default() }
    }

    /// Whether a place is one on which diffuse light depends; `None` if nothing tells.
    pub fn is_light(&mut self, at: usize, strength: Option<usize>) -> Option<bool> {
        let moved = self.moved(at);
        if let Some(strength) = strength {
            return Some(self.depends(strength, &moved));
        }
        let of_diffuse = |probe: &mut Self, varied: &Varied| {
            let [dim, bright] =
                [0.5, 0.9].map(|diffuse| probe.colours(&Varied { diffuse: Some(diffuse), ..varied.clone() }));
            Some(dim?.iter().zip(bright?).map(|(dim, bright)| bright - dim).collect::<Vec<f32>>())
        };
        let (before, after) = (of_diffuse(self, &Varied::default())?, of_diffuse(self, &moved)?);
        let is_there = before.iter().any(|x| x.abs() > 1e-3);
        is_there.then(|| differ(&before, &after))
    }

    /// The factor of a number in the sums that contain it: the one that varies most.
    pub fn factor(&mut self, at: usize) -> Vec<f32> {
        let before = self.values(&Varied::default());
        let [second, third] = [1.25, 1.75].map(|factor| self.values(&self.with_factor(at, factor, &Varied::default())));
        let base = self.inputs[at].base[0];
        let mut best: (f32, Vec<f32>) = (-1.0, Vec::new());
        for (((key, first), (of_second, second)), (of_third, third)) in before.iter().zip(&second).zip(&third) {
            if key != of_second || key != of_third {
                break;
            }
            let numbers = difference(first, second, 0.25 * base);
            if !is_shown(&numbers, first) || differ(&numbers, &difference(second, third, 0.5 * base)) {
                continue;
            }
            let spread = spread(&numbers);
            if spread > best.0 + 0.02 {
                best = (spread, numbers);
            }
        }
        best.1
    }
}

/// The standard deviation in parts of the mean.
pub(super) fn spread(numbers: &[f32]) -> f32 {
    let finite: Vec<f32> = numbers.iter().copied().filter(|x| x.is_finite() && *x != 0.0).collect();
    let count = finite.len().max(1) as f32;
    let mean = finite.iter().sum::<f32>() / count;
    let variance = finite.iter().map(|x| (x - mean).powi(2)).sum::<f32>() / count;
    variance.sqrt() / mean.abs().max(1e-6)
}

fn root_mean_square(numbers: &[f32]) -> f32 {
    let finite = || numbers.iter().filter(|x| x.is_finite());
    (finite().map(|x| x * x).sum::<f32>() / finite().count().max(1) as f32).sqrt()
}

/// Whether changes are more than rounding.
fn is_shown(changes: &[f32], of: &[f32]) -> bool {
    root_mean_square(changes) > 1e-4 * root_mean_square(of).max(1e-2)
}

/// Whether more than a few numbers differ.
pub(super) fn differ(a: &[f32], b: &[f32]) -> bool {
    let small = 0.02 * root_mean_square(a).max(root_mean_square(b));
    let is_counted = |(a, b): &(&f32, &f32)| a.is_finite() && b.is_finite() && a.abs().max(b.abs()) > small;
    let counted: Vec<(&f32, &f32)> = a.iter().zip(b).filter(is_counted).collect();
    let others = counted.iter().filter(|(a, b)| (**a - **b).abs() > 0.02 * a.abs().max(b.abs()) + 0.1 * small).count();
    others as f32 > MOST_OTHERS * counted.len() as f32
}

/// The bases and exponents of all calls of `pow`.
pub(super) fn powers(program: &Program) -> Vec<(Stage, ExprId, ExprId)> {
    let mut powers: Vec<(Stage, ExprId, ExprId)> = Vec::new();
    for stage in STAGES {
        let all = &program.stage(stage).source.expressions;
        let numbers = program.numbers(stage);
        for call in &numbers {
            let Some(arguments) =
                program.text(stage, *call).strip_prefix("pow").and_then(|text| text.strip_suffix(')'))
            else {
                continue;
            };
            let Some((_, exponent)) = arguments.rsplit_once(',') else { continue };
            let span = all[call.0 as usize].span;
            let inside = |expr: &&ExprId| {
                let own = all[expr.0 as usize].span;
                own.start > span.start && own.end < span.end
            };
            let mut within = numbers.iter().filter(inside);
            let text = exponent.trim();
            let first = within.clone().find(|expr| all[expr.0 as usize].span.start <= span.start + 5);
            let second = within.rfind(|expr| program.text(stage, **expr) == text);
            if let (Some(first), Some(second)) = (first, second) {
                powers.push((stage, *first, *second));
            }
        }
    }
    powers
}

/// Whether values of an input flow into the exponent of a power and not into its base.
pub(super) fn is_exponent(
    program: &Program,
    samples: &SceneSamples,
    powers: &[(Stage, ExprId, ExprId)],
    inputs: &[Input],
    at: usize,
) -> bool {
    if powers.is_empty() {
        return false;
    }
    let mut probe = Probe::new(program.clone(), samples.clone(), inputs);
    let before = probe.values(&Varied::default());
    let after = probe.values(&probe.with_factor(at, 1.3, &Varied::default()));
    let is_changed = |stage: Stage, expr: ExprId| {
        before.iter().zip(&after).any(|((key, before), (_, after))| (key.0, key.1) == (stage, expr) && before != after)
    };
    powers.iter().any(|(stage, base, exponent)| is_changed(*stage, *exponent) && !is_changed(*stage, *base))
}
