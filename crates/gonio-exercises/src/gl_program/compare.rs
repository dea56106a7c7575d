//! Compares the student's picture with the reference's.

use super::suspects::Case;
use gonio_gl::GlError;
use gonio_gl::trace::SamplingRecord;
use gonio_language::tr;
use gonio_render::gl_program::{
    Constant, GlCall, GlProgramFailure, GlProgramFiles, GlProgramOptions, GlProgramRun, Selector, Step, constant, run,
};
use std::collections::HashMap;

/// Pixels along each side of the compared pictures: enough for the smaller levels of the texture to be read.
pub const SIDE: u32 = 256;
/// Tolerance per channel: one step of 8 bits, and a margin for its rounding. The exercise sets it.
const STEP: f32 = 1.01 / 255.0;
/// The share of pixels that must be equal. The exercise sets it.
pub const ENOUGH: f64 = 0.99;

/// Runs programs and compares them with the reference.
pub struct Judge<'a> {
    gl: &'a gonio_gl::Gl,
    files: &'a GlProgramFiles,
    /// The right program.
    pub reference: &'a [Step],
    /// Its pictures, by the sampling of the texture.
    pictures: HashMap<[String; 4], Vec<[f32; 4]>>,
    /// Number of pictures drawn.
    pub drawn: usize,
}

impl<'a> Judge<'a> {
    /// Creates a judge that has drawn nothing yet.
    pub fn new(gl: &'a gonio_gl::Gl, files: &'a GlProgramFiles, reference: &'a [Step]) -> Self {
        Judge { gl, files, reference, pictures: HashMap::new(), drawn: 0 }
    }

    /// Executes a program.
    pub fn run(&mut self, steps: &[Step], thumbnails: bool) -> Result<GlProgramRun, GlProgramFailure> {
        self.drawn += 1;
        run(self.gl, steps, self.files, GlProgramOptions { size: [SIDE; 2], float: false, thumbnails })
    }

    /// The share of a picture's pixels that are right.
    ///
    /// The exercise does not prescribe a filter or wrap mode: the picture is also compared with the reference that uses the
    /// same ones.
    pub fn share_right(&mut self, run: &GlProgramRun) -> Result<f64, GlError> {
        let sampling = run.record.draws.last().and_then(|draw| draw.samplers.first());
        let sampling = sampling.and_then(|sampler| sampler.sampling.as_ref());
        let own = share(&run.pixels, self.picture(None)?);
        if own >= ENOUGH {
            return Ok(own);
        }
        match sampling {
            Some(sampling) => {
                let same = share(&run.pixels, self.picture(Some(sampling))?);
                Ok(own.max(same))
            }
            None => Ok(own),
        }
    }

    /// The reference's picture, with its own sampling or another one.
    pub fn picture(&mut self, sampling: Option<&SamplingRecord>) -> Result<&[[f32; 4]], GlError> {
        let key = sampling.map_or_else(Default::default, |s| {
            [s.min_filter.clone(), s.mag_filter.clone(), s.wrap[0].clone(), s.wrap[1].clone()]
        });
        if !self.pictures.contains_key(&key) {
            let steps = sampled(self.reference, &key);
            let run = self.run(&steps, false).map_err(|failure| match failure {
                GlProgramFailure::Driver(error) => error,
                other => GlError::new(tr!("check-gl-cannot-draw-the-exercise-s-own", error = other.to_string())),
            })?;
            self.pictures.insert(key.clone(), run.pixels);
        }
        Ok(self.pictures.get(&key).map(Vec::as_slice).unwrap_or_default())
    }

    /// The case to search for mistakes.
    pub fn case<'b>(&'b self, steps: &'b [Step], run: &'b GlProgramRun) -> Case<'b>
    where
        'a: 'b,
    {
        Case::new(steps, run, self.reference)
    }
}

/// The reference with other filters and wrap modes; empty words change nothing.
fn sampled(reference: &[Step], words: &[String; 4]) -> Vec<Step> {
    let parameters = ["TEXTURE_MIN_FILTER", "TEXTURE_MAG_FILTER", "TEXTURE_WRAP_S", "TEXTURE_WRAP_T"];
    let mut steps = reference.to_vec();
    for step in &mut steps {
        let GlCall::TexParameter { parameter, value, .. } = &mut step.call else { continue };
        let Some(place) = parameters.iter().position(|name| *name == parameter.name) else { continue };
        if let Some(constant) = by_words(&words[place]) {
            *value = Selector::Constant(constant);
        }
    }
    steps
}

/// The constant for the words that records use: `linear mipmap linear`.
fn by_words(words: &str) -> Option<Constant> {
    constant(&words.to_uppercase().replace(' ', "_"))
}

/// The share of equal pixels. Alpha is not visible in a window, and is ignored.
fn share(mine: &[[f32; 4]], right: &[[f32; 4]]) -> f64 {
    if mine.len() != right.len() || mine.is_empty() {
        return 0.0;
    }
    let same = |(a, b): &(&[f32; 4], &[f32; 4])| (0..3).all(|i| (a[i] - b[i]).abs() <= STEP);
    let count = mine.iter().zip(right).filter(same).count();
    count as f64 / mine.len() as f64
}
