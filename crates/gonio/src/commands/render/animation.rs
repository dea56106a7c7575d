//! Animations: the frames of moving lights and an orbiting camera, and the animated PNG or GIF that they are written to.

use super::plan::PictureFormat;
use crate::error::CliError;
use gonio_image::EncodedPicture;
use gonio_image::encode::png::{self, ColorTag};
use gonio_scene::{Frame, Scene};

/// The time of a frame in seconds as a fraction, with at most 16 bits each.
fn delay(fps: f64) -> (u16, u16) {
    // Whole rates are exact; others to a thousandth of a second.
    if fps.fract() == 0.0 && fps <= f64::from(u16::MAX) {
        (1, fps as u16)
    } else {
        ((1000.0 / fps).round().clamp(1.0, 65535.0) as u16, 1000)
    }
}

/// An animation being written.
pub enum AnimationFile {
    Png(png::Animation),
    Gif(Box<Gif>),
}

/// A GIF being written.
pub struct Gif {
    encoder: Option<gif::Encoder<Vec<u8>>>,
    hundredths: u16,
}

impl AnimationFile {
    /// An animation of `frames` frames at `fps` frames per second, repeated for ever.
    pub fn new(format: PictureFormat, frames: u32, fps: f64) -> Self {
        match format {
            PictureFormat::Gif => {
                let hundredths = (100.0 / fps).round().clamp(1.0, 65535.0) as u16;
                AnimationFile::Gif(Box::new(Gif { encoder: None, hundredths }))
            }
            _ => AnimationFile::Png(png::Animation::new(frames, delay(fps))),
        }
    }

    /// Adds a frame. All have the size of the first.
    pub fn add(&mut self, picture: EncodedPicture<u8>, tag: ColorTag) -> Result<(), CliError> {
        match self {
            AnimationFile::Png(animation) => Ok(animation.add(&picture, tag)?),
            AnimationFile::Gif(gif) => gif.add(picture).map_err(gif_failed),
        }
    }

    /// The bytes of the file.
    pub fn finish(self) -> Result<Vec<u8>, CliError> {
        match self {
            AnimationFile::Png(animation) => Ok(animation.finish()?),
            AnimationFile::Gif(gif) => match gif.encoder {
                Some(encoder) => encoder.into_inner().map_err(gif_failed),
                None => Err(CliError::new("an animation needs at least one frame")),
            },
        }
    }
}

fn gif_failed(error: impl std::fmt::Display) -> CliError {
    CliError::new(format!("cannot encode the picture as GIF: {error}"))
}

impl Gif {
    fn add(&mut self, mut picture: EncodedPicture<u8>) -> Result<(), gif::EncodingError> {
        // Both fit: a picture has at most 16384 pixels along a side.
        let (width, height) = (picture.width as u16, picture.height as u16);
        let encoder = match &mut self.encoder {
            Some(encoder) => encoder,
            None => {
                let mut encoder = gif::Encoder::new(Vec::new(), width, height, &[])?;
                encoder.set_repeat(gif::Repeat::Infinite)?;
                self.encoder.insert(encoder)
            }
        };
        // GIF has no partial transparency.
        for pixel in picture.rgba.chunks_exact_mut(4) {
            pixel[3] = if pixel[3] < 128 { 0 } else { 255 };
        }
        let mut frame = gif::Frame::from_rgba_speed(width, height, &mut picture.rgba, 10);
        frame.delay = self.hundredths;
        frame.dispose = gif::DisposalMethod::Background;
        encoder.write_frame(&frame)
    }
}

/// The frames of an animation.
pub struct Frames<'a> {
    scene: &'a Scene,
    start: f64,
    fps: f64,
    /// Radians from one frame to the next, if the camera orbits.
    step: Option<f64>,
}

impl<'a> Frames<'a> {
    /// `count` frames from `start` seconds on, over which the camera orbits by `orbit` degrees.
    pub fn new(scene: &'a Scene, start: f64, count: u32, fps: f64, orbit: Option<f64>) -> Self {
        // Whole turns loop: the last frame is one step before the first. Part of a turn is shown from end to end.
        let steps = |degrees: f64| if degrees % 360.0 == 0.0 { count } else { count.saturating_sub(1).max(1) };
        let step = orbit.map(|degrees| degrees.to_radians() / f64::from(steps(degrees)));
        Frames { scene, start, fps, step }
    }

    /// The scene of the frame with this index, from 0, if it differs from that of the others: objects move.
    pub fn scene_at(&self, index: u32) -> Option<Scene> {
        self.scene.has_moving_objects().then(|| self.scene.at(self.time(index)))
    }

    /// The frame with this index, from 0.
    pub fn at(&self, index: u32) -> Frame {
        let frame = self.scene.frame(self.time(index));
        match self.step {
            Some(step) => self.scene.orbit(&self.scene.orbit_start(&frame), step * f64::from(index)),
            None => frame,
        }
    }

    fn time(&self, index: u32) -> f64 {
        self.start + f64::from(index) / self.fps
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn delays() {
        assert_eq!(delay(25.0), (1, 25));
        assert_eq!(delay(0.5), (2000, 1000));
        assert_eq!(delay(29.97), (33, 1000));
    }
}
