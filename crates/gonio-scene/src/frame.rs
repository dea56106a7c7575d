//! One moment of a scene, as a renderer wants it.

use crate::camera::Camera;
use crate::texture::TextureFilter;
use glam::DVec3;
use gonio_light::color::OutputTransform;
use gonio_light::{Equation, Light};

/// What is seen where there is no object: linear radiance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Background {
    /// At the picture's top edge.
    pub top: DVec3,
    /// At its bottom edge.
    pub bottom: DVec3,
    /// Nothing: alpha 0.
    pub transparent: bool,
}

impl Background {
    /// Premultiplied RGBA at height `y` in [0, 1], 0 the top edge.
    pub fn at(&self, y: f64) -> [f64; 4] {
        if self.transparent {
            return [0.0; 4];
        }
        let c = self.top.lerp(self.bottom, y);
        [c.x, c.y, c.z, 1.0]
    }
}

/// Everything of a picture that is not geometry or material.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Pixels, > 0.
    pub width: u32,
    /// Pixels, > 0.
    pub height: u32,
    /// Samples per pixel, >= 1.
    pub samples: u32,
    /// Seconds.
    pub time: f64,
    /// The eye.
    pub camera: Camera,
    /// Where the lights are at `time`, in the scene's order.
    pub lights: Vec<Light>,
    /// The form of the equation.
    pub equation: Equation,
    /// The normal is turned to the viewer on back faces.
    pub two_sided: bool,
    /// Behind everything.
    pub background: Background,
    /// From light to the picture's numbers.
    pub output: OutputTransform,
    /// How textures are sampled.
    pub texture_filter: TextureFilter,
    /// Box around all objects, world space.
    pub bounds_min: DVec3,
    /// Box around all objects, world space.
    pub bounds_max: DVec3,
}
