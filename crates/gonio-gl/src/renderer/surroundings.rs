//! A frame's environment: the sky behind everything, and what mirrors and glass need of it.

use super::Shared;
use crate::GlError;
use crate::environment_on_gpu::{CubeTexture, EnvironmentOnGpu, Seamless};
use crate::glsl::{Sight, SurroundingsKey, fresnel_number, sky_sources, texture_unit};
use crate::objects::DebugGroup;
use crate::program::Program;
use crate::scene_on_gpu::GpuScene;
use glam::DMat3;
use glow::HasContext;
use gonio_light::Optics;
use gonio_scene::{Frame, SceneMaterial, Surroundings, TextureFilter};
use std::rc::Rc;

/// A frame's environment, bound until it is dropped.
pub(super) struct Around<'a> {
    textures: &'a EnvironmentOnGpu,
    surroundings: Surroundings,
    /// Levels of textures are chosen by distances on the screen, not always the first.
    mipmapped: bool,
    _seamless: Seamless<'a>,
}

impl<'a> Around<'a> {
    /// Binds what surrounds a frame's scene; `None` where it has no environment.
    pub fn bound(shared: &'a Shared, scene: &'a GpuScene, frame: &Frame) -> Option<Self> {
        let (textures, surroundings) = (scene.environment.as_ref()?, frame.surroundings?);
        let mipmapped = matches!(frame.texture_filter, TextureFilter::Mipmap | TextureFilter::Anisotropic);
        textures.map.bind(&shared.gl, texture_unit("environment_map"));
        Some(Around { textures, surroundings, mipmapped, _seamless: Seamless::new(&shared.gl) })
    }

    /// What a material's program shows of it.
    pub fn key(&self, optics: &Optics, is_view: bool) -> SurroundingsKey {
        if optics.is_plain() {
            return SurroundingsKey::NONE;
        }
        // A view may show what is let through even where none of it counts.
        let sight = if optics.transmission > 0.0 || is_view { Sight::Glass } else { Sight::Mirror };
        SurroundingsKey { sight, mipmapped: self.mipmapped }
    }

    /// Sets what is the same for all materials.
    pub fn set_frame(&self, program: &Program) {
        program.set_mat3("environment_from_world", &self.surroundings.environment_from_world.as_mat3());
        program.set_f32("environment_intensity", self.surroundings.intensity as f32);
        program.set_f32("environment_half_size", 0.5 * self.textures.map.size as f32);
    }

    /// Sets a material's optics.
    pub fn set_material(&self, program: &Program, material: &SceneMaterial) {
        let optics = &material.optics;
        let indices = optics.indices(material.material.refraction_index.into());
        program.set_f32("reflectivity", optics.reflectivity as f32);
        program.set_f32("transmission", optics.transmission as f32);
        program.set_i32("fresnel_kind", fresnel_number(optics.fresnel));
        program.set_dvec3("indices", indices.into());
        program.set_i32("index_count", if indices == [indices[1]; 3] { 1 } else { 3 });
        program.set_dvec3("tint", optics.tint);
    }

    /// Whether it is seen behind the objects.
    pub fn is_visible(&self) -> bool {
        self.surroundings.visible
    }

    /// Draws it where nothing opaque has been drawn: at the largest depth, with alpha 1. Depth is tested, and not
    /// written.
    pub fn draw_sky(&self, shared: &Shared, frame: &Frame) -> Result<(), GlError> {
        let gl = &shared.gl;
        let _group = DebugGroup::new(gl, "sky");
        let program = shared.sky_program()?;
        program.bind();
        let unit = texture_unit("environment_map");
        let seen = self.textures.seen();
        program.set_i32("environment_map", unit as i32);
        program.set_mat3("environment_from_clip", &self.environment_from_clip(frame).as_mat3());
        program.set_f32("environment_intensity", self.surroundings.intensity as f32);
        program.set_f32("environment_level", self.sky_level(seen, frame));
        seen.bind(gl, unit);
        // SAFETY: plain state; the triangle's vertices come from gl_VertexID alone.
        unsafe {
            gl.depth_func(glow::LEQUAL);
            gl.depth_mask(false);
            gl.disable(glow::CULL_FACE);
            gl.bind_vertex_array(Some(shared.no_attributes.handle()));
            gl.draw_arrays(glow::TRIANGLES, 0, 3);
            gl.bind_vertex_array(None);
            gl.depth_mask(true);
            gl.depth_func(glow::LESS);
        }
        self.textures.map.bind(gl, unit);
        Ok(())
    }

    /// From (x, y, 1), x and y from -1 to 1 over the picture, to a direction in the environment. Where the eye is does
    /// not count: the environment is infinitely far away.
    fn environment_from_clip(&self, frame: &Frame) -> DMat3 {
        let camera = &frame.camera;
        let half_height = (0.5 * camera.fov_y_rad).tan();
        let half_width = half_height * f64::from(frame.width) / f64::from(frame.height);
        let world_from_clip = DMat3::from_cols(half_width * camera.right, half_height * camera.up, camera.front);
        self.surroundings.environment_from_world * world_from_clip
    }

    /// One level for the whole picture: that whose texels are as far apart as pixels, in the middle of the picture and
    /// of a face.
    fn sky_level(&self, seen: &CubeTexture, frame: &Frame) -> f32 {
        if !self.mipmapped {
            return 0.0;
        }
        let pixel = 2.0 * (0.5 * frame.camera.fov_y_rad).tan() / f64::from(frame.height);
        (0.5 * f64::from(seen.size) * pixel).max(1.0).log2() as f32
    }
}

impl Shared {
    fn sky_program(&self) -> Result<Rc<Program>, GlError> {
        if let Some(program) = self.sky.borrow().as_ref() {
            return Ok(program.clone());
        }
        let [vertex, fragment] = sky_sources(self.info.dialect);
        let program = Rc::new(Program::new(&self.gl, "sky", &vertex, &fragment, &[])?);
        *self.sky.borrow_mut() = Some(program.clone());
        Ok(program)
    }
}
