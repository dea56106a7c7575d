//! The work beside the interface: lists both shaders at a pixel, and evaluates an expression.

use super::values::ShaderSteps;
use crate::exercise::preview::DrawnProgram;
use gonio_check::testbench::TestScene;
use gonio_exercises::preview::{Note, PreviewShape};
use gonio_exercises::step::{
    ExpressionPicture, ExpressionValue, PixelSurface, StepListing, StepOptions, StepWork, SteppedPair, SteppedPlace,
    SteppedScene,
};
use std::sync::Arc;

/// Steps that are shown; an endless loop has more.
const MOST_STEPS: usize = 10_000;
/// The bounds on the work: the page has one thread.
const WORK: StepWork = if cfg!(target_arch = "wasm32") {
    StepWork::BRIEF
} else {
    StepWork { point: StepWork::BRIEF.point, ..StepWork::PATIENT }
};

/// Pixels along the longer side of the picture.
const SIDE: u32 = 200;
/// The background of pictures.
const BACKGROUND: [u8; 3] = [33, 36, 41];

/// The pinned pixel, as shares of the picture's width and height from the top left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pin {
    /// The shares.
    pub share: [f32; 2],
    /// Whether the nearest pixel where something is drawn is meant.
    pub is_nearest: bool,
}

/// The student's picture as it is drawn.
#[derive(Clone)]
pub struct SteppedPicture {
    /// The program.
    pub program: Arc<DrawnProgram>,
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// The objects with their inputs.
    pub objects: Vec<(PreviewShape, TestScene)>,
}

impl PartialEq for SteppedPicture {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.program, &other.program) && self.size == other.size && self.objects == other.objects
    }
}

impl SteppedPicture {
    fn options(&self) -> StepOptions {
        let size = self.size[0].max(self.size[1]);
        // The picture is the middle of a square.
        StepOptions { size, origin: self.size.map(|side| (size - side) / 2), work: WORK }
    }

    /// A pixel of the picture, both counted from the top left, in the square.
    pub fn in_square(&self, [x, y]: [u32; 2]) -> [u32; 2] {
        let StepOptions { size, origin: [left, bottom], .. } = self.options();
        let from_bottom = (self.size[1].saturating_sub(1)).saturating_sub(y) + bottom;
        [x + left, size.saturating_sub(1).saturating_sub(from_bottom)]
    }

    /// The inverse of [`SteppedPicture::in_square`]; `None` outside of the picture.
    fn in_picture(&self, [x, y]: [u32; 2]) -> Option<[u32; 2]> {
        let [left, top] = self.in_square([0, 0]);
        let pixel = [x.checked_sub(left)?, y.checked_sub(top)?];
        (pixel[0] < self.size[0] && pixel[1] < self.size[1]).then_some(pixel)
    }

    /// The pixel at these shares.
    pub fn pixel(&self, share: [f32; 2]) -> [u32; 2] {
        [0, 1].map(|axis| {
            let side = self.size[axis];
            ((share[axis] * side as f32) as u32).min(side.saturating_sub(1))
        })
    }
}

/// A picture and the pixel to list.
#[derive(Clone, PartialEq)]
pub struct Request {
    /// The picture.
    pub picture: SteppedPicture,
    /// The pixel.
    pub pin: Pin,
}

/// The listings at a pixel.
#[derive(Clone)]
pub struct Listed {
    /// The pair.
    pub pair: Arc<SteppedPair>,
    /// The pair in the scene.
    pub scene: Arc<SteppedScene>,
    /// Column and row from the top left of the picture.
    pub pixel: [u32; 2],
    /// The surface there.
    pub surface: PixelSurface,
    /// The fragment shader.
    pub fragment: Arc<ShaderSteps>,
    /// The vertex shader at each corner of the triangle.
    pub corners: Vec<Arc<ShaderSteps>>,
}

/// Lists the shaders at the pixel. `before`: what can be used again.
pub fn list(
    request: &Request,
    before: Option<((Arc<SteppedPair>, Arc<SteppedScene>), Request)>,
) -> Result<Listed, String> {
    let Request { picture, pin } = request;
    let is_same_program = |before: &Request| Arc::ptr_eq(&before.picture.program, &picture.program);
    let known = before.filter(|(_, before)| is_same_program(before));
    let pair = match &known {
        Some(((pair, _), _)) => pair.clone(),
        None => {
            let pair = SteppedPair::new(&picture.program.source, &picture.program.bindings);
            Arc::new(pair.map_err(|note| sentence(&note))?)
        }
    };
    let scene = match known.filter(|(_, before)| before.picture == *picture) {
        Some(((_, scene), _)) => scene,
        None => Arc::new(SteppedScene::new(pair.clone(), &picture.objects, picture.options())),
    };
    let asked = picture.in_square(picture.pixel(pin.share));
    let square = if pin.is_nearest { scene.nearest_drawn(asked) } else { Some(asked) };
    let found = square
        .and_then(|square| Some((picture.in_picture(square)?, scene.surface(square)?, scene.step_pixel(square)?)));
    let Some((pixel, surface, fragment)) = found else {
        return Err(match scene.endless_vertex() {
            Some(vertex) => format!("The vertex shader does not end at vertex {vertex}, so nothing is drawn."),
            None => "Nothing is drawn at this pixel: click on an object.".to_owned(),
        });
    };
    let corners = surface.vertices.iter().filter_map(|vertex| scene.step_vertex(*vertex)).map(steps);
    Ok(Listed { fragment: steps(fragment), corners: corners.collect(), pair, pixel, surface, scene })
}

fn steps(mut listing: StepListing) -> Arc<ShaderSteps> {
    listing.is_truncated |= listing.steps.len() > MOST_STEPS;
    listing.steps.truncate(MOST_STEPS);
    Arc::new(ShaderSteps::new(listing))
}

/// The reason why a pair cannot be stepped through.
fn sentence(note: &Note) -> String {
    let message = &note.message;
    let place = message.line.map_or(String::new(), |line| format!("{}:{line}: ", message.file));
    let help = message.explanation.as_ref().map_or(String::new(), |help| format!("; {help}"));
    format!("{place}{}{help}.", message.text)
}

/// A line and column of the current shader's file, both from 1.
pub type Target = [u32; 2];

/// An expression with its value and its picture.
#[derive(Clone, Debug)]
pub struct Hovered {
    /// The expression and its values.
    pub value: ExpressionValue,
    /// Its picture, or one sentence on why there is none.
    pub picture: Result<ExpressionPicture, String>,
    /// Width and height of the pictures in pixels.
    pub size: [u32; 2],
    /// The picture of the quantity that belongs here, if it is known.
    pub right: Option<ExpressionPicture>,
}

/// The expression at a line and column, with its value at the place and its picture.
pub fn evaluate(
    pair: &Arc<SteppedPair>,
    scene: &SteppedScene,
    picture: &SteppedPicture,
    place: SteppedPlace,
    target: Target,
) -> Option<Hovered> {
    let value = scene.expression_value(place, target)?;
    let options = StepOptions { work: WORK, ..StepOptions::square(SIDE) };
    let small = SteppedScene::new(pair.clone(), &picture.objects, options);
    let mut drawn = small.picture_of(place.stage(), &value, BACKGROUND);
    let size = cropped_size(picture.size);
    if let Ok(drawn) = &mut drawn {
        drawn.rgba = cropped(&drawn.rgba, size);
    }
    Some(Hovered { value, picture: drawn, size, right: None })
}

/// The visible part of the square.
fn cropped_size(size: [u32; 2]) -> [u32; 2] {
    let longer = size[0].max(size[1]).max(1);
    size.map(|side| (SIDE * side).div_ceil(longer).clamp(1, SIDE))
}

fn cropped(rgba: &[u8], [width, height]: [u32; 2]) -> Vec<u8> {
    let (left, top) = ((SIDE - width) / 2, (SIDE - height) / 2);
    let row = |y: u32| {
        let start = ((top + y) * SIDE + left) as usize * 4;
        rgba.get(start..start + width as usize * 4).unwrap_or_default()
    };
    (0..height).flat_map(row).copied().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_visible_part_is_the_middle_of_the_square() {
        assert_eq!(cropped_size([800, 400]), [SIDE, SIDE / 2]);
        assert_eq!(cropped_size([3, 900]), [1, SIDE]);
        let rows: Vec<u8> = (0..SIDE).flat_map(|y| vec![y as u8; SIDE as usize * 4]).collect();
        let cropped = cropped(&rows, [SIDE, SIDE / 2]);
        assert_eq!((cropped.len() as u32, cropped[0] as u32), (SIDE * SIDE / 2 * 4, SIDE / 4));
    }
}
