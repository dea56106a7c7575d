//! The values of one expression at all pixels, as a picture.

use super::coverage::{Plane, lane_in_quad, ndc};
use super::pair::{SteppedScene, SteppedStage};
use super::right::RightAnswer;
use super::syntax::{ExpressionValue, expressions_at, text_of};
use super::value::float_text;
use crate::report::NAN_COLOUR;
use gonio_check::cause::quantity_of::ExpressionQuantity;
use gonio_glsl::{Scalar, Stage, Type};
use gonio_interpreter::{Evaluation, ExprId, LANES, RunOptions, run};
use gonio_language::tr;

/// The colour of values that were never written: cyan.
pub const NEVER_WRITTEN_COLOUR: [u8; 4] = [0, 255, 255, 255];
/// Two greys of the chequered pattern where the shader does not evaluate the expression.
const NOT_EVALUATED: [u8; 2] = [70, 100];
/// Pixels that are run together.
const CHUNK: usize = 16_384;

/// How values become colours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ExpressionMapping {
    /// A number: black is the least, white the greatest.
    Grey {
        /// The least finite value.
        least: f32,
        /// The greatest finite value.
        greatest: f32,
    },
    /// `false` is black, `true` is white.
    Truth,
    /// Components from 0 to 1, unchanged as red, green and blue.
    Colour,
    /// Components from -1 to 1: (x + 1) / 2 as red, green and blue.
    Direction,
    /// Components in another range, from black to full red, green and blue.
    Range {
        /// The least finite component.
        least: f32,
        /// The greatest finite component.
        greatest: f32,
    },
}

impl std::fmt::Display for ExpressionMapping {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Grey { least, greatest } => {
                let (least, greatest) = (float_text(*least), float_text(*greatest));
                f.write_str(&tr!("check-step-black-is-and-white-is", least = least, greatest = greatest))
            }
            Self::Truth => f.write_str(tr!("check-step-black-is-false-and-white-is")),
            Self::Colour => f.write_str(tr!("check-step-colour")),
            Self::Direction => f.write_str(tr!("check-step-direction")),
            Self::Range { least, greatest } => {
                let (least, greatest) = (float_text(*least), float_text(*greatest));
                f.write_str(&tr!("check-step-range", least = least, greatest = greatest))
            }
        }
    }
}

/// The values of an expression at all pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct ExpressionPicture {
    /// The source of the expression.
    pub expression: String,
    /// Its stage.
    pub stage: Stage,
    /// Its file.
    pub file: String,
    /// Its line in the file.
    pub line: u32,
    /// Its column, in characters from 1.
    pub column: u32,
    /// Its GLSL type.
    pub glsl_type: String,
    /// RGBA rows, the top row first.
    pub rgba: Vec<u8>,
    /// The meaning of the colours.
    pub mapping: ExpressionMapping,
    /// The number of pixels that the objects cover.
    pub drawn: usize,
    /// Pixels where the value is NaN or infinite: magenta.
    pub non_finite: usize,
    /// Pixels where it is computed from values that were never written: [`NEVER_WRITTEN_COLOUR`].
    pub unwritten: usize,
    /// Pixels where it is not evaluated: chequered.
    pub unevaluated: usize,
    /// The most evaluations at one pixel; the last one is shown.
    pub evaluations: u32,
    /// Whether a bound on the work or the memory was reached: some pixels lack their value.
    pub is_truncated: bool,
}

/// The pictures of an expression and of its right values.
#[derive(Clone, Debug, PartialEq)]
pub struct PictureBeside {
    /// The expression's own picture.
    pub own: ExpressionPicture,
    /// The picture of its right values, in the same colours; `None` if they are not known.
    pub right: Option<ExpressionPicture>,
    /// What it is or should be, in one sentence.
    pub quantity: Option<String>,
}

/// The value at a point: up to four components.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct PointValue {
    pub components: [f32; 4],
    pub is_written: bool,
    pub evaluations: u32,
}

/// The values of an expression at the drawn pixels.
pub(super) type PixelValues = Vec<([u32; 2], PointValue)>;

impl SteppedScene {
    /// Draws the smallest expression at a line and column of the student's file, both from 1, and beside it its right
    /// values. The pictures have the colour `background` where nothing is drawn.
    ///
    /// # Errors
    /// The reason why it has no picture, in one sentence.
    pub fn picture(
        &self,
        stage: Stage,
        [line, column]: [u32; 2],
        background: [u8; 3],
        right: Option<&RightAnswer>,
    ) -> Result<PictureBeside, String> {
        let of = self.pair.stage(stage);
        let candidates = expressions_at(of, line, column);
        if candidates.is_empty() {
            let file = &of.text.file;
            return Err(tr!("check-step-there-is-no-expression-point-at", file = file, line = line, column = column));
        }
        self.picture_of_first(stage, &candidates, [line, column], background, right)
    }

    /// The same for an expression whose value at one pixel or vertex is known.
    ///
    /// # Errors
    /// The reason why it has no picture, in one sentence.
    pub fn picture_of(
        &self,
        stage: Stage,
        value: &ExpressionValue,
        background: [u8; 3],
        right: Option<&RightAnswer>,
    ) -> Result<PictureBeside, String> {
        self.picture_of_first(stage, &[value.id], [value.line, value.column], background, right)
    }

    /// Draws the first of some expressions that a pixel evaluates.
    fn picture_of_first(
        &self,
        stage: Stage,
        candidates: &[ExprId],
        [line, column]: [u32; 2],
        background: [u8; 3],
        right: Option<&RightAnswer>,
    ) -> Result<PictureBeside, String> {
        let of = self.pair.stage(stage);
        let file = &of.text.file;
        let (values, is_truncated) = match stage {
            Stage::Fragment => self.values_of_fragments(candidates),
            _ => self.values_of_vertices(candidates),
        };
        let found = values.iter().position(|all| all.iter().any(|(_, value)| value.evaluations > 0));
        let (expr, values) = match found {
            Some(index) => (candidates[index], &values[index]),
            None => {
                let text = text_of(of, candidates[0]);
                let why = if is_truncated {
                    tr!("check-step-the-shader-does-not-end")
                } else {
                    tr!("check-step-choose-another-expression")
                };
                return Err(tr!(
                    "check-step-no-pixel-evaluates",
                    file = file,
                    line = line,
                    column = column,
                    text = text,
                    why = why
                ));
            }
        };
        let source = of.compiled.source.expression(expr);
        let ty = source.and_then(|source| source.ty.clone()).unwrap_or(Type::Void);
        let text = text_of(of, expr);
        let size = match &ty {
            Type::Scalar(_) => 1,
            Type::Vector(_, size) => usize::from(*size),
            _ => {
                return Err(tr!(
                    "check-step-has-the-type-choose-a-number",
                    file = file,
                    line = line,
                    column = column,
                    text = text,
                    written = ty.written()
                ));
            }
        };
        let span = source.map(|source| source.span).unwrap_or_default();
        let (_, line, column) = of.text.place(span.line, span.column);
        let beside = right.and_then(|right| self.right_values(right, stage, expr));
        let beside = beside.filter(|beside| beside.len() == values.len());
        // The same colours for both, so that they can be compared.
        let mapping = mapping(&ty, size, values.iter().chain(beside.iter().flatten()));
        let mut own = ExpressionPicture {
            expression: text,
            stage,
            file: file.clone(),
            line,
            column,
            glsl_type: ty.written(),
            rgba: [background[0], background[1], background[2], 255]
                .repeat(self.size().map(|side| side as usize).iter().product()),
            mapping,
            drawn: values.len(),
            non_finite: 0,
            unwritten: 0,
            unevaluated: 0,
            evaluations: values.iter().map(|(_, value)| value.evaluations).max().unwrap_or(0),
            is_truncated,
        };
        let painted = |picture: &ExpressionPicture, values: &PixelValues| {
            let mut picture = picture.clone();
            values.iter().for_each(|(pixel, value)| picture.paint(*pixel, value, size, self.size()[0]));
            picture
        };
        let beside = beside.map(|beside| painted(&own, &beside));
        own = painted(&own, values);
        let quantity = right.and_then(|right| right.quantity(stage, expr)).map(ExpressionQuantity::sentence);
        Ok(PictureBeside { own, right: beside, quantity })
    }

    /// The values of expressions at all drawn pixels.
    fn values_of_fragments(&self, watched: &[ExprId]) -> (Vec<PixelValues>, bool) {
        let stage = &self.pair.fragment;
        let quads = stage.compiled.takes_derivatives;
        let mut pixels: Vec<Vec<[u32; 2]>> = vec![Vec::new(); self.objects.len()];
        for pixel in self.coverage.covered() {
            if let Some(triangle) = self.coverage.at(pixel) {
                pixels[triangle.object].push(pixel);
            }
        }
        let chunks = pixels.iter().map(|all| all.len().div_ceil(CHUNK)).sum::<usize>().max(1);
        let (mut values, mut is_truncated, mut is_endless) = (vec![Vec::new(); watched.len()], false, false);
        for (object, pixels) in pixels.iter().enumerate() {
            for chunk in pixels.chunks(CHUNK) {
                let inputs = self.fragment_inputs(object, chunk, quads);
                let options = RunOptions {
                    textures: &*self.textures,
                    quads,
                    watched,
                    most_work: (self.options.work.picture / chunks as u64).max(self.options.work.picture / 20),
                    ..RunOptions::default()
                };
                // After an endless loop, the other pixels have no value.
                let result = (!is_endless).then(|| run(&stage.compiled, &inputs, &options));
                is_endless |= result.as_ref().is_some_and(|result| result.ended.is_some());
                is_truncated |= is_endless || result.as_ref().is_some_and(|result| result.is_truncated);
                let evaluations = result.map_or_else(Vec::new, |result| result.evaluations);
                let found = last_values(stage, watched, &evaluations, inputs.points());
                for (all, found) in values.iter_mut().zip(found) {
                    let at = |index: usize, pixel: [u32; 2]| match quads {
                        true => 4 * index + lane_in_quad(pixel, self.coverage.size[1]),
                        false => index,
                    };
                    all.extend(chunk.iter().enumerate().map(|(index, pixel)| (*pixel, found[at(index, *pixel)])));
                }
            }
        }
        (values, is_truncated)
    }

    /// The values of expressions at all vertices, interpolated for all drawn pixels.
    fn values_of_vertices(&self, watched: &[ExprId]) -> (Vec<PixelValues>, bool) {
        let stage = &self.pair.vertex;
        let (mut values, mut is_truncated) = (vec![Vec::new(); watched.len()], false);
        let mut of_objects = Vec::new();
        for object in &self.objects {
            let all: Vec<u32> = (0..object.vertices.points as u32).collect();
            let inputs = self.inputs_of_vertices(object, &all);
            let options = RunOptions {
                textures: &*self.textures,
                watched,
                most_work: self.options.work.vertices,
                ..RunOptions::default()
            };
            let result = run(&stage.compiled, &inputs, &options);
            is_truncated |= result.is_truncated || result.ended.is_some();
            of_objects.push(last_values(stage, watched, &result.evaluations, inputs.points()));
        }
        for pixel in self.coverage.covered() {
            let Some(triangle) = self.coverage.at(pixel) else { continue };
            let Some(plane) = Plane::new(&triangle.clip) else { continue };
            let shares = plane.at(ndc(pixel, self.coverage.size)).shares;
            for (all, found) in values.iter_mut().zip(&of_objects[triangle.object]) {
                let corners = triangle.corners.map(|corner| found[corner as usize]);
                let component = |at: usize| {
                    let sum: f64 = (0..3).map(|i| shares[i] * f64::from(corners[i].components[at])).sum();
                    sum as f32
                };
                let value = PointValue {
                    components: std::array::from_fn(component),
                    is_written: corners.iter().all(|corner| corner.is_written),
                    evaluations: corners.iter().map(|corner| corner.evaluations).min().unwrap_or(0),
                };
                all.push((pixel, value));
            }
        }
        (values, is_truncated)
    }
}

impl ExpressionPicture {
    fn paint(&mut self, [x, y]: [u32; 2], value: &PointValue, size: usize, width: u32) {
        let components = &value.components[..size.min(4)];
        let byte = |x: f32| (x.clamp(0.0, 1.0) * 255.0 + 0.5) as u8;
        let colour = if value.evaluations == 0 {
            self.unevaluated += 1;
            let grey = NOT_EVALUATED[((x / 4 + y / 4) % 2) as usize];
            [grey, grey, grey, 255]
        } else if !value.is_written {
            self.unwritten += 1;
            NEVER_WRITTEN_COLOUR
        } else if components.iter().any(|x| !x.is_finite()) {
            self.non_finite += 1;
            NAN_COLOUR
        } else {
            let range = |x: f32, least: f32, greatest: f32| match greatest > least {
                true => byte((x - least) / (greatest - least)),
                false => 128,
            };
            let rgb = |map: &dyn Fn(f32) -> u8| [0, 1, 2].map(|at| components.get(at).map_or(0, |x| map(*x)));
            let [r, g, b] = match self.mapping {
                ExpressionMapping::Grey { least, greatest } => [range(components[0], least, greatest); 3],
                ExpressionMapping::Truth => [byte(components[0]); 3],
                ExpressionMapping::Colour => rgb(&byte),
                ExpressionMapping::Direction => rgb(&|x| byte(x * 0.5 + 0.5)),
                ExpressionMapping::Range { least, greatest } => rgb(&|x| range(x, least, greatest)),
            };
            [r, g, b, 255]
        };
        let at = (y as usize * width as usize + x as usize) * 4;
        if let Some(pixel) = self.rgba.get_mut(at..at + 4) {
            pixel.copy_from_slice(&colour);
        }
    }
}

/// The last value of each expression at each point.
fn last_values(
    stage: &SteppedStage,
    watched: &[ExprId],
    evaluations: &[Evaluation],
    points: usize,
) -> Vec<Vec<PointValue>> {
    let mut values = vec![vec![PointValue::default(); points]; watched.len()];
    for evaluation in evaluations {
        let Some(index) = watched.iter().position(|expr| *expr == evaluation.expr) else { continue };
        let ty = stage.compiled.source.expression(evaluation.expr).and_then(|found| found.ty.clone());
        let scalar = ty.as_ref().and_then(Type::scalar);
        let number = |bits: u32| match scalar {
            Some(Scalar::Int) => bits as i32 as f32,
            Some(Scalar::UInt | Scalar::Bool) => bits as f32,
            _ => f32::from_bits(bits),
        };
        for lane in (0..LANES).filter(|lane| evaluation.points.contains(*lane)) {
            let Some(value) = values[index].get_mut(evaluation.first_point + lane) else { continue };
            let component = |at: usize| evaluation.values.component(at, lane).map_or(0.0, number);
            *value = PointValue {
                components: std::array::from_fn(component),
                is_written: evaluation.written.contains(lane),
                evaluations: value.evaluations + 1,
            };
        }
    }
    values
}

fn mapping<'v>(
    ty: &Type,
    size: usize,
    values: impl Iterator<Item = &'v ([u32; 2], PointValue)> + Clone,
) -> ExpressionMapping {
    // The fourth component is that of a position or an opacity, and has no colour.
    let shown = size.min(3);
    let finite = || {
        let written = values.clone().map(|(_, value)| value).filter(|value| value.is_written && value.evaluations > 0);
        written.map(|value| &value.components[..shown]).filter(|components| components.iter().all(|x| x.is_finite()))
    };
    let least = finite().flatten().copied().fold(f32::INFINITY, f32::min);
    let greatest = finite().flatten().copied().fold(f32::NEG_INFINITY, f32::max);
    let [least, greatest] = if least > greatest { [0.0; 2] } else { [least, greatest] };
    let first = finite().next();
    let is_constant = finite().all(|components| Some(components) == first);
    let is_unit = |c: &[f32]| (c.iter().map(|x| x * x).sum::<f32>() - 1.0).abs() < 1e-3;
    match ty.scalar() {
        Some(Scalar::Bool) => ExpressionMapping::Truth,
        _ if size == 1 => ExpressionMapping::Grey { least, greatest },
        _ if size == 3 && !is_constant && finite().all(is_unit) => ExpressionMapping::Direction,
        _ if least >= 0.0 && greatest <= 1.0 => ExpressionMapping::Colour,
        _ if least >= -1.0 && greatest <= 1.0 => ExpressionMapping::Direction,
        _ => ExpressionMapping::Range { least, greatest },
    }
}
