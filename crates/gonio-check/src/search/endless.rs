//! Programs whose loops take too many turns: `gonio-glsl` counts them, the same in every context.

use crate::verdict::{Outcome, Verdict};
use gonio_gl::GlError;
use gonio_glsl::DRAWN_ALL_THE_SAME;
use gonio_render::user_program::UserProgram;

/// A picture, for this purpose: its pixels' numbers.
pub(crate) trait Numbers {
    /// Whether each number is the other picture's, bit for bit.
    fn equals(&self, other: &Self) -> bool;
}

impl Numbers for crate::testbench::Atlas {
    fn equals(&self, other: &Self) -> bool {
        // By bits, for NaN is no difference.
        let bits = |atlas: &Self| atlas.pixels.iter().flatten().map(|number| number.to_bits()).collect::<Vec<_>>();
        bits(self) == bits(other)
    }
}

impl Numbers for crate::panorama::Tiles {
    fn equals(&self, other: &Self) -> bool {
        let numbers = |tiles: &Self| tiles.faces.iter().flatten().flatten().map(|n| n.to_bits()).collect::<Vec<_>>();
        numbers(self) == numbers(other)
    }
}

/// Draws the student's program by `draw`, which is given fixed uniforms and the number of test scenes: each of `counts`, of
/// which the last is the whole. `None` where a vertex or fragment took more turns than [`gonio_glsl::LoopBound::STUDENTS`].
///
/// Such vertices and fragments are drawn or not by a uniform: two pictures that differ tell of them. The first test scene is
/// tried alone, for a program with an endless loop takes long in each.
pub(crate) fn drawn<T: Numbers>(
    program: &UserProgram,
    fixed: &[(String, Vec<f32>)],
    counts: &[usize],
    mut draw: impl FnMut(&[(String, Vec<f32>)], usize) -> Result<T, GlError>,
) -> Result<Option<T>, GlError> {
    let whole = counts.last().copied().unwrap_or(0);
    if program.uniform_index(DRAWN_ALL_THE_SAME).is_none() {
        return draw(fixed, whole).map(Some);
    }
    let mut fixed = fixed.to_vec();
    fixed.push((DRAWN_ALL_THE_SAME.to_owned(), vec![0.0]));
    let mut seen = None;
    for &count in counts {
        let mut drawn = |all_the_same: f32| {
            if let Some((_, value)) = fixed.last_mut() {
                *value = vec![all_the_same];
            }
            draw(&fixed, count)
        };
        let (all, ended) = (drawn(1.0)?, drawn(0.0)?);
        if !all.equals(&ended) {
            return Ok(None);
        }
        seen = Some(ended);
    }
    Ok(seen)
}

/// The verdict on such a program.
pub(crate) fn verdict(exercise: &str) -> Verdict {
    Verdict::new(exercise, Outcome::Unsure, "a loop in a shader never ends")
}
