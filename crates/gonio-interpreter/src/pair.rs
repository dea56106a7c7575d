//! From the outputs of a vertex shader to the inputs of a fragment shader.

use crate::code::{CompiledStage, InputRate};
use crate::lanes::{LANES, LaneSet};
use crate::run::{PointValues, StageInputs, StageRun};

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
    run: &StageRun,
    fragment: &CompiledStage,
    fragments: &[Fragment],
) -> StageInputs {
    let mut inputs = StageInputs::new(fragment, fragments.len());
    for varying in varyings(vertex, fragment) {
        let Some(values) = run.outputs.get(varying.output) else { continue };
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
