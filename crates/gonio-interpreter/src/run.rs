//! Runs a compiled shader over points: inputs, options, results; and leads from the outputs of a vertex shader to the
//! inputs of a fragment shader.

use crate::code::{CompiledStage, InputRate};
use crate::lanes::{LANES, LaneSet};
use crate::machine::Machine;
use crate::source::{ExprId, StatementId};
use crate::texture::{NoTexture, TextureSource};
use std::collections::BTreeMap;
use std::ops::Range;

/// The values of an expression, input or output at points: bits of floats, of integers, or 0 and 1 for booleans. The
/// components are those of OpenGL: matrices by columns, arrays element by element.
#[derive(Debug, Clone, PartialEq)]
pub enum PointValues {
    /// The same components at all points.
    Same(Vec<u32>),
    /// Different ones.
    Each {
        /// For each component, a number for each point.
        components: Vec<Vec<u32>>,
        /// For each [`LANES`] points, those that have a value; all if there is no set.
        written: Option<Vec<LaneSet>>,
    },
}

impl PointValues {
    /// Creates floats that are the same at all points.
    #[must_use]
    pub fn floats(components: &[f32]) -> Self {
        Self::Same(components.iter().map(|x| x.to_bits()).collect())
    }

    /// Creates integers (or booleans, or the number of a texture for a sampler) that are the same at all points.
    #[must_use]
    pub fn ints(components: &[i32]) -> Self {
        Self::Same(components.iter().map(|x| *x as u32).collect())
    }

    /// Creates floats from one slice for each component.
    #[must_use]
    pub fn each(components: &[&[f32]]) -> Self {
        let bits = |all: &&[f32]| all.iter().map(|x| x.to_bits()).collect();
        Self::Each { components: components.iter().map(bits).collect(), written: None }
    }

    /// Returns a component at a point.
    #[must_use]
    pub fn component(&self, component: usize, point: usize) -> Option<u32> {
        match self {
            Self::Same(components) => components.get(component).copied(),
            Self::Each { components, .. } => components.get(component)?.get(point).copied(),
        }
    }

    /// Returns a component at a point as a float; 0 if there is none.
    #[must_use]
    pub fn float(&self, component: usize, point: usize) -> f32 {
        self.component(component, point).map_or(0.0, f32::from_bits)
    }

    /// Returns a component at each of some points as a float; 0 where there is none.
    pub fn floats_at(&self, component: usize, points: Range<usize>) -> impl Iterator<Item = f32> {
        let (same, each): (u32, &[u32]) = match self {
            Self::Same(components) => (components.get(component).copied().unwrap_or(0), &[]),
            Self::Each { components, .. } => {
                let all = components.get(component).map_or(&[][..], Vec::as_slice);
                (0, &all[points.start.min(all.len())..points.end.min(all.len())])
            }
        };
        (0..points.len()).map(move |at| f32::from_bits(each.get(at).copied().unwrap_or(same)))
    }

    /// Whether a point has a value.
    #[must_use]
    pub fn is_written(&self, point: usize) -> bool {
        match self {
            Self::Same(_) | Self::Each { written: None, .. } => true,
            Self::Each { written: Some(sets), .. } => {
                sets.get(point / LANES).is_some_and(|set| set.contains(point % LANES))
            }
        }
    }
}

/// The inputs of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct StageInputs {
    points: usize,
    values: Vec<Option<PointValues>>,
}

impl StageInputs {
    /// Creates the inputs for a number of points, all of them unset. Unset uniforms have the value of their
    /// initializer, or 0; unset inputs of points are (0, 0, 0, 1), and count as never written; `gl_VertexID` is the
    /// number of the point.
    #[must_use]
    pub fn new(stage: &CompiledStage, points: usize) -> Self {
        Self { points, values: vec![None; stage.inputs.len()] }
    }

    /// Sets an input by its index in [`CompiledStage::inputs`]. Missing components are (0, 0, 0, 1), extra ones are
    /// ignored.
    pub fn set(&mut self, input: usize, values: PointValues) -> bool {
        let found = self.values.get_mut(input);
        found.map(|found| *found = Some(values)).is_some()
    }

    /// Sets an input by name; returns whether there is one.
    pub fn set_named(&mut self, stage: &CompiledStage, name: &str, values: PointValues) -> bool {
        stage.input(name).is_some_and(|input| self.set(input, values))
    }

    /// Returns the number of points.
    #[must_use]
    pub fn points(&self) -> usize {
        self.points
    }

    /// Returns the values of an input, if they are set.
    #[must_use]
    pub fn values(&self, input: usize) -> Option<&PointValues> {
        self.values.get(input)?.as_ref()
    }
}

/// Replaces the value of an expression: from there on, the shader goes on with these.
#[derive(Debug, Clone, PartialEq)]
pub struct Substitute {
    /// The expression. The base of a member access, such as `light` in `light.position`, cannot be replaced.
    pub expr: ExprId,
    /// Only this evaluation within each block, from 0; `None` for all.
    pub occurrence: Option<u32>,
    /// The new values at all points of the run.
    pub values: PointValues,
}

/// How to run a shader.
#[derive(Clone, Copy)]
pub struct RunOptions<'a> {
    /// The textures.
    pub textures: &'a dyn TextureSource,
    /// Whether each four consecutive points are a 2x2 quad: (0, 0), (1, 0), (0, 1), (1, 1), y upwards. Without quads
    /// derivatives are 0 and never written.
    pub quads: bool,
    /// The expressions whose values are recorded.
    pub watched: &'a [ExprId],
    /// The values to replace.
    pub substitutes: &'a [Substitute],
    /// The point whose steps are recorded.
    pub traced_point: Option<usize>,
    /// Whether to find where infinities and NaN arise; takes about twice the time.
    pub find_non_finite: bool,
    /// The bound on the time of the whole run: about 0.1 microseconds each. An endless loop ends there.
    pub most_work: u64,
    /// Most numbers that are recorded.
    pub most_observed: usize,
}

impl Default for RunOptions<'_> {
    fn default() -> Self {
        Self {
            textures: &NoTexture,
            quads: false,
            watched: &[],
            substitutes: &[],
            traced_point: None,
            find_non_finite: false,
            most_work: 30_000_000,
            most_observed: 1 << 24,
        }
    }
}

/// A bound on the work of a run was reached: probably an endless loop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct EndedEarly {
    /// The last statement.
    pub statement: Option<StatementId>,
    /// A point that was still running.
    pub point: usize,
}

/// Something odd that a run survived.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum AnomalyKind {
    /// A value was read that was never written; it is 0.
    ReadBeforeWritten,
    /// An index was outside of its array: reads give 0, writes do nothing.
    IndexOutOfRange,
    /// An infinity or NaN was computed from finite numbers.
    NonFinite,
}

/// An oddity at one expression.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Anomaly {
    /// Its kind.
    pub kind: AnomalyKind,
    /// The expression.
    pub expr: ExprId,
    /// The first point.
    pub point: usize,
    /// At how many evaluations and points it happened.
    pub count: usize,
}

/// The oddities of a run, by expression.
#[derive(Debug, Clone, Default)]
pub(crate) struct Anomalies {
    found: BTreeMap<(ExprId, AnomalyKind), Anomaly>,
}

impl Anomalies {
    pub fn add(&mut self, kind: AnomalyKind, expr: ExprId, point: usize, count: usize) {
        let known = self.found.entry((expr, kind)).or_insert(Anomaly { kind, expr, point, count: 0 });
        known.count += count;
    }
}

/// One evaluation of a watched expression, for the points of one block.
#[derive(Debug, Clone, PartialEq)]
pub struct Evaluation {
    /// The expression.
    pub expr: ExprId,
    /// The call, by [`CompiledStage::frames`].
    pub frame: u32,
    /// The iterations of the loops around it, the outermost one first, from 0.
    pub iterations: Vec<u32>,
    /// Its number among the evaluations of this expression in this block.
    pub occurrence: u32,
    /// The first point of the block.
    pub first_point: usize,
    /// The points that evaluate it, relative to the first one.
    pub points: LaneSet,
    /// Those whose value is computed from written values alone.
    pub written: LaneSet,
    /// The values, relative to the first point; meaningless at points that do not evaluate it.
    pub values: PointValues,
}

/// A statement that the traced point has executed. A statement that goes on after a call, and a loop that goes on after its
/// body, are further steps.
#[derive(Debug, Clone, PartialEq)]
pub struct TraceStep {
    /// The statement; `None` for the initialization of global variables.
    pub statement: Option<StatementId>,
    /// The call, by [`CompiledStage::frames`].
    pub frame: u32,
    /// The iterations of the loops around it.
    pub iterations: Vec<u32>,
    /// The variables that it wrote, in order.
    pub writes: Vec<TraceWrite>,
}

/// The value of a variable after a write.
#[derive(Debug, Clone, PartialEq)]
pub struct TraceWrite {
    /// The variable, by [`CompiledStage::variables`].
    pub variable: u32,
    /// The assignment or call that wrote it; `None` for an initializer.
    pub expr: Option<ExprId>,
    /// Its scalars, at most 256.
    pub values: Vec<u32>,
    /// Whether each scalar was ever written.
    pub written: Vec<bool>,
}

/// The result of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct StageRun {
    /// The number of points.
    pub points: usize,
    /// The values of [`CompiledStage::outputs`].
    pub outputs: Vec<PointValues>,
    /// Whether each point was discarded; empty if none was.
    pub discarded: Vec<bool>,
    /// Oddities, in the order of their expressions.
    pub anomalies: Vec<Anomaly>,
    /// The values of watched expressions, block by block in the order of evaluation.
    pub evaluations: Vec<Evaluation>,
    /// The steps of the traced point.
    pub trace: Vec<TraceStep>,
    /// With [`RunOptions::find_non_finite`], the expression that gave each point its first infinity or NaN.
    pub non_finite: Vec<Option<ExprId>>,
    /// Whether there was more to record.
    pub is_truncated: bool,
    /// The statements that all points have executed together.
    pub statements: u64,
    /// Why the run ended early; outputs of later blocks are 0 and never written then.
    pub ended: Option<EndedEarly>,
}

impl StageRun {
    /// Returns an output by name.
    #[must_use]
    pub fn output(&self, stage: &CompiledStage, name: &str) -> Option<&PointValues> {
        self.outputs.get(stage.output(name)?)
    }
}

/// Runs a shader at all points.
#[must_use]
pub fn run(stage: &CompiledStage, inputs: &StageInputs, options: &RunOptions<'_>) -> StageRun {
    let points = inputs.points();
    let mut machine = Machine::new(stage, inputs, options);
    let blocks = points.div_ceil(LANES);
    let mut outputs: Vec<(Vec<Vec<u32>>, Vec<LaneSet>)> = stage
        .outputs
        .iter()
        .map(|output| (vec![Vec::with_capacity(points); output.size as usize], Vec::with_capacity(blocks)))
        .collect();
    let mut discarded = Vec::new();
    let mut ended = None;
    for block in 0..blocks {
        let start = block * LANES;
        let count = (points - start).min(LANES);
        ended = machine.block(start, count).err();
        if ended.is_some() {
            break;
        }
        machine.seen.end_block(count);
        for (output, (components, written)) in stage.outputs.iter().zip(&mut outputs) {
            let mut all = LaneSet::FULL;
            for (at, component) in (0..output.size).zip(components.iter_mut()) {
                all = all.and(machine.registers.written(output.reg + at));
                machine.registers.operand(output.reg + at).append_to(component, count);
            }
            written.push(all);
        }
        let lost = machine.control.discarded;
        if !lost.is_empty() {
            discarded.resize(start, false);
            discarded.extend((0..count).map(|lane| lost.contains(lane)));
        }
    }
    if !discarded.is_empty() {
        discarded.resize(points, false);
    }
    let outputs = outputs.into_iter().map(|(mut components, written)| {
        components.iter_mut().for_each(|all| all.resize(points, 0));
        PointValues::Each { components, written: Some(written) }
    });
    StageRun {
        points,
        outputs: outputs.collect(),
        discarded,
        anomalies: machine.anomalies.found.into_values().collect(),
        evaluations: machine.seen.evaluations,
        trace: machine.seen.steps,
        non_finite: if options.find_non_finite { machine.seen.all_origins } else { Vec::new() },
        is_truncated: machine.seen.is_truncated,
        statements: machine.statements,
        ended,
    }
}

/// A fragment's place in a triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fragment {
    /// The points of the vertex shader's run; the last one is the provoking vertex of `flat` varyings.
    pub corners: [u32; 3],
    /// The weights of the corners on the screen, for `noperspective` varyings; their sum is 1.
    pub screen: [f32; 3],
    /// The weights of the corners in space, for all others; their sum is 1.
    pub weights: [f32; 3],
}

impl Fragment {
    /// Creates a fragment from weights a, b, c on the screen and the fourth components w of the corners'
    /// `gl_Position`: in space they are a / wa, b / wb, c / wc, divided by their sum (OpenGL 4.6, equation 14.8).
    #[must_use]
    pub fn on_screen(corners: [u32; 3], screen: [f32; 3], w: [f32; 3]) -> Self {
        let shares: [f32; 3] = std::array::from_fn(|at| screen[at] / w[at]);
        let sum: f32 = shares.iter().sum();
        Self { corners, screen, weights: shares.map(|share| share / sum) }
    }
}

/// A varying: an output of the vertex shader, and the input of the fragment shader that receives it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Varying {
    /// Index in the vertex shader's outputs.
    pub output: usize,
    /// Index in the fragment shader's inputs.
    pub input: usize,
    /// How it is interpolated.
    pub interpolation: Interpolation,
}

/// How a varying is interpolated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Interpolation {
    /// `smooth`: linear in space.
    Perspective,
    /// `noperspective`: linear on the screen.
    Linear,
    /// `flat`: the value of the provoking vertex.
    Flat,
}

/// Matches the outputs of a vertex shader with the inputs of a fragment shader: by location, else by name, or by the
/// built-in names of old OpenGL (`gl_FrontColor` becomes `gl_Color`).
#[must_use]
pub fn varyings(vertex: &CompiledStage, fragment: &CompiledStage) -> Vec<Varying> {
    let mut found = Vec::new();
    for (input, declared) in fragment.inputs.iter().enumerate() {
        if declared.rate != InputRate::PerPoint {
            continue;
        }
        let name = match &*declared.name {
            "gl_Color" => "gl_FrontColor",
            "gl_SecondaryColor" => "gl_FrontSecondaryColor",
            name => name,
        };
        let by_location = declared.location.and_then(|at| vertex.outputs.iter().position(|o| o.location == Some(at)));
        let Some(output) = by_location.or_else(|| vertex.output(name)) else { continue };
        let words = [&declared.interpolation, &vertex.outputs[output].interpolation];
        let is = |word: &str| words.iter().any(|w| w.as_deref() == Some(word));
        let interpolation = if is("flat") {
            Interpolation::Flat
        } else if is("noperspective") {
            Interpolation::Linear
        } else {
            Interpolation::Perspective
        };
        found.push(Varying { output, input, interpolation });
    }
    found
}

/// Interpolates the varyings of a vertex shader's run for fragments. A fragment has a value where all its corners have
/// one.
#[must_use]
pub fn interpolate(
    vertex: &CompiledStage,
    outputs: &[PointValues],
    fragment: &CompiledStage,
    fragments: &[Fragment],
) -> StageInputs {
    let mut inputs = StageInputs::new(fragment, fragments.len());
    for varying in varyings(vertex, fragment) {
        let Some(values) = outputs.get(varying.output) else { continue };
        let size = fragment.inputs[varying.input].size as usize;
        let is_float = crate::layout::scalar_of(&fragment.inputs[varying.input].ty) == gonio_glsl::Scalar::Float;
        let at = |fragment: usize, component: usize| -> u32 {
            let Fragment { corners, screen, weights } = fragments[fragment];
            let weights = if varying.interpolation == Interpolation::Linear { screen } else { weights };
            if varying.interpolation == Interpolation::Flat || !is_float {
                return values.component(component, corners[2] as usize).unwrap_or(0);
            }
            let corner = |at: usize| weights[at] * values.float(component, corners[at] as usize);
            (corner(0) + corner(1) + corner(2)).to_bits()
        };
        let components = (0..size).map(|component| (0..fragments.len()).map(|f| at(f, component)).collect()).collect();
        let is_written = |f: &Fragment| f.corners.iter().all(|corner| values.is_written(*corner as usize));
        let written = fragments
            .chunks(LANES)
            .map(|chunk| LaneSet::filter(|lane| chunk.get(lane).is_some_and(is_written)))
            .collect();
        inputs.set(varying.input, PointValues::Each { components, written: Some(written) });
    }
    inputs
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::compile::compile;
    use gonio_glsl::Stage;

    fn compiled(stage: Stage, source: &str) -> CompiledStage {
        let mut parsed = gonio_glsl::parse(source);
        let checked = gonio_glsl::check(&mut parsed, stage);
        compile(&parsed, &checked).unwrap()
    }

    #[test]
    fn varyings_are_interpolated_as_their_qualifiers_say() {
        let vertex = "#version 330 core\nin float x;\nout float a;\nflat out int b;\nnoperspective out vec2 c;\nout float never;\n\
                  void main() { a = x; b = int(x); c = vec2(x); gl_Position = vec4(0.0, 0.0, 0.0, x); if (x > 1.5) never = x; }";
        let vertex = compiled(Stage::Vertex, vertex);
        let fragment = "#version 330 core\nin float a;\nflat in int b;\nnoperspective in vec2 c;\nin float never;\nout vec4 r;\n\
                    void main() { r = vec4(a, float(b), c.y, never); }";
        let fragment = compiled(Stage::Fragment, fragment);
        let mut inputs = StageInputs::new(&vertex, 3);
        inputs.set_named(&vertex, "x", PointValues::each(&[&[1.0, 2.0, 4.0]]));
        let vertices = run(&vertex, &inputs, &RunOptions::default());
        let place = Fragment::on_screen([0, 1, 2], [0.5, 0.25, 0.25], [1.0, 2.0, 4.0]);
        let inputs = interpolate(&vertex, &vertices.outputs, &fragment, &[place]);
        let result = run(&fragment, &inputs, &RunOptions::default());
        // 1 / (0.5 / 1 + 0.25 / 2 + 0.25 / 4) in space, 0.5 + 0.5 + 1 on the screen.
        let r = &result.outputs[0];
        assert_eq!([0, 1, 2].map(|component| r.float(component, 0)), [1.0 / 0.6875, 4.0, 2.0]);
        assert_eq!(result.anomalies.len(), 1, "one corner never wrote `never`");
    }

    #[test]
    fn members_of_varyings_take_locations_of_their_own() {
        let members = "struct Members { mat2 m; vec3 a; float b[2]; vec3 c; };\n";
        let vertex = format!(
            "#version 450 core\n{members}layout(location = 1) out Members from;\nlayout(location = 8) out Block {{ vec3 d; vec3 e; }} to;\n\
             void main() {{ gl_Position = vec4(0.0); }}"
        );
        let fragment = format!(
            "#version 450 core\n{members}layout(location = 1) in Members into;\nlayout(location = 8) in Other {{ vec3 d; vec3 e; }} other;\n\
             out vec4 r;\nvoid main() {{ r = vec4(into.c, other.e.x); }}"
        );
        let (vertex, fragment) = (compiled(Stage::Vertex, &vertex), compiled(Stage::Fragment, &fragment));
        let pairs = varyings(&vertex, &fragment);
        let pairs = pairs.iter().map(|v| (&*vertex.outputs[v.output].name, &*fragment.inputs[v.input].name));
        let expected = [("m", "m"), ("a", "a"), ("b", "b"), ("c", "c")];
        let mut expected: Vec<(String, String)> =
            expected.iter().map(|(a, b)| (format!("from.{a}"), format!("into.{b}"))).collect();
        expected.extend(["d", "e"].map(|name| (format!("Block.{name}"), format!("Other.{name}"))));
        assert_eq!(pairs.map(|(a, b)| (a.to_owned(), b.to_owned())).collect::<Vec<_>>(), expected);
    }
}
