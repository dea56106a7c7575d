//! The shadows of a scene in OpenGL's memory.

use crate::glsl::texture_unit;
use crate::shadow_map::ShadowPlan;
use gonio_gl::Gl;
use gonio_gl::objects::TextureObject;
use gonio_gl::target::{DepthTarget, OutputTarget};
use gonio_scene::GroundPlane;
use std::rc::Rc;

/// The shadow maps of a scene, as drawn last.
pub(crate) struct ShadowMaps {
    /// The maps' projections and places.
    pub plan: ShadowPlan,
    /// The depths of all maps.
    pub atlas: Rc<DepthTarget>,
    /// The plan as a texture.
    pub table: TextureObject,
}

/// The contact shadow of a scene: an aid, not light of the equation.
pub(crate) struct ContactShadow {
    /// The ground.
    pub plane: GroundPlane,
    /// The share of the sky that the objects hide, on a square around them.
    pub map: OutputTarget,
}

impl ShadowMaps {
    /// Binds the maps and their table.
    pub fn bind(&self, gl: &Gl) {
        for (sampler, texture) in [("shadow_atlas", self.atlas.texture()), ("shadow_table", self.table.handle())] {
            gl.active_texture(glow::TEXTURE0 + texture_unit(sampler));
            gl.bind_texture(glow::TEXTURE_2D, Some(texture));
        }
    }
}
