//! A frame's environment: the sky behind everything, and its reflection and refraction.

use super::shared::Shared;
use crate::environment_on_gpu::{CubeTexture, EnvironmentOnGpu, Gloss, Seamless};
use crate::glsl::{SurfaceOptics, SurroundingsKey, fresnel_number, sky_sources, texture_unit};
use crate::scene_on_gpu::{GpuObject, GpuScene};
use glam::DMat3;
use gonio_environment::BrdfTable;
use gonio_environment::small_lights::MOST_LIGHTS;
use gonio_gl::objects::DebugGroup;
use gonio_gl::program::Program;
use gonio_gl::target::{SamplesOf, Target};
use gonio_gl::{Gl, GlError};
use gonio_light::{Optics, Surfaces};
use gonio_scene::{Frame, MaterialBrdf, SceneMaterial, Surroundings, TextureFilter};
use std::rc::Rc;

/// A frame's environment, bound until it is dropped.
pub(super) struct BoundEnvironment<'a> {
    textures: &'a EnvironmentOnGpu,
    surroundings: Surroundings,
    /// Levels of textures are chosen by distances on the screen, not always the first.
    mipmapped: bool,
    /// The environment for glossy surfaces that it lights.
    gloss: Option<&'a Gloss>,
    _seamless: Seamless<'a>,
}

impl<'a> BoundEnvironment<'a> {
    /// Binds the environment of a frame; `None` if it has none.
    pub fn bound(shared: &'a Shared, scene: &'a GpuScene, frame: &Frame) -> Result<Option<Self>, GlError> {
        let gl = &shared.gl;
        let (Some(textures), Some(surroundings)) = (scene.environment.as_ref(), frame.surroundings) else {
            return Ok(None);
        };
        // Computed at the first use, which takes a second.
        let any_gloss = || scene.materials.iter().any(|m| m.brdf.is_none() && m.material.specular != [0.0; 3]);
        let needs_gloss = surroundings.lights && frame.equation.terms.specular && any_gloss();
        let gloss = needs_gloss.then(|| textures.gloss(gl)).transpose()?;
        gloss.map_or(&textures.map, |gloss| &gloss.map).bind(gl, texture_unit("glossy_map"));
        if let Some(gloss) = gloss {
            gl.active_texture(glow::TEXTURE0 + texture_unit("environment_brdf"));
            gl.bind_texture(glow::TEXTURE_2D, Some(gloss.brdf.handle()));
        }
        let any_function = || scene.materials.iter().any(|m| m.brdf.is_some());
        let for_functions = if surroundings.lights && any_function() { textures.rest(gl)? } else { &textures.map };
        for_functions.bind(gl, texture_unit("function_map"));
        let mipmapped = matches!(frame.texture_filter, TextureFilter::Mipmap | TextureFilter::Anisotropic);
        textures.map.bind(gl, texture_unit("environment_map"));
        Ok(Some(BoundEnvironment { textures, surroundings, mipmapped, gloss, _seamless: Seamless::new(gl) }))
    }

    /// The environment of a frame for [`Self::draw_sky`] alone; `None` if it has none.
    pub fn sky(shared: &'a Shared, scene: &'a GpuScene, frame: &Frame) -> Option<Self> {
        let (textures, surroundings) = (scene.environment.as_ref()?, frame.surroundings?);
        let _seamless = Seamless::new(&shared.gl);
        Some(BoundEnvironment { textures, surroundings, mipmapped: false, gloss: None, _seamless })
    }

    /// The part of it that the program of a material shows.
    pub fn key(&self, object: &GpuObject, optics: &Optics, is_view: bool) -> SurroundingsKey {
        let sight = match optics {
            optics if optics.is_plain() => SurfaceOptics::Nothing,
            // A view may show refraction even if its weight is 0.
            optics if optics.transmission <= 0.0 && !is_view => SurfaceOptics::Mirror,
            optics if optics.surfaces == Surfaces::Two && object.body.is_some() => SurfaceOptics::Body,
            _ => SurfaceOptics::Glass,
        };
        let mipmapped = self.mipmapped && sight != SurfaceOptics::Nothing;
        SurroundingsKey { sight, mipmapped, lights: self.surroundings.lights }
    }

    /// Sets the uniforms that are the same for all materials.
    pub fn set_frame(&self, program: &Program, frame: &Frame) {
        if self.surroundings.lights {
            let switch = |on: bool| if on { 1.0 } else { 0.0 };
            program.set_vec3_array("harmonics[0]", self.textures.polynomial());
            program.set_f32("glossy_last_level", self.gloss.map_or(0, |gloss| gloss.map.last_level) as f32);
            program.set_f32("environment_brdf_size", BrdfTable::SIZE as f32);
            program.set_f32("environment_diffuse_switch", switch(frame.equation.terms.diffuse));
            program.set_f32("environment_specular_switch", switch(frame.equation.terms.specular));
        }
        program.set_mat3("environment_from_world", &self.surroundings.environment_from_world.as_mat3());
        program.set_f32("environment_intensity", self.surroundings.intensity as f32);
        program.set_f32("environment_half_size", 0.5 * self.textures.map.size as f32);
    }

    /// Sets the lobe of a material with a BRDF of its own: of wide ones, small lights are points.
    pub fn set_function(&self, program: &Program, brdf: &MaterialBrdf) {
        let lobe = brdf.lobe();
        let [ax, ay] = lobe.alpha.map(|alpha| alpha as f32);
        let leans = if lobe.lean.is_some() { 1.0 } else { 0.0 };
        program.set_vec4("function_lobe", [ax, ay, lobe.lean.unwrap_or(0.0) as f32, leans]);
        program.set_i32("function_lobe_count", lobe.lobe_count as i32);
        program.set_i32("function_cosine_count", lobe.cosine_count as i32);
        let map = if lobe.is_wide() { "function_map" } else { "environment_map" };
        program.set_i32("function_map", texture_unit(map) as i32);
        let lights = if lobe.is_wide() { self.textures.small_lights() } else { &[] };
        program.set_i32("small_light_count", lights.len() as i32);
        let world_from_environment = self.surroundings.environment_from_world.transpose();
        let [mut directions, mut irradiances] = [[[0.0_f32; 3]; MOST_LIGHTS]; 2];
        for (light, (direction, irradiance)) in lights.iter().zip(directions.iter_mut().zip(&mut irradiances)) {
            *direction = (world_from_environment * light.direction).as_vec3().to_array();
            *irradiance = light.irradiance.as_vec3().to_array();
        }
        program.set_vec3_array("small_light_directions[0]", &directions);
        program.set_vec3_array("small_light_irradiances[0]", &irradiances);
    }

    /// Sets a material's optics.
    pub fn set_material(&self, gl: &Gl, program: &Program, object: &GpuObject, material: &SceneMaterial) {
        let optics = &material.optics;
        let indices = optics.indices(material.material.refraction_index.into());
        program.set_f32("reflectivity", optics.reflectivity as f32);
        program.set_f32("transmission", optics.transmission as f32);
        program.set_i32("fresnel_kind", fresnel_number(optics.fresnel));
        program.set_dvec3("indices", indices.into());
        program.set_i32("index_count", if indices == [indices[1]; 3] { 1 } else { 3 });
        program.set_dvec3("tint", optics.tint);
        if let Some(body) = &object.body {
            body.bind(gl, texture_unit("body_table"));
            body.set(program, optics);
        }
    }

    /// Whether it is seen behind the objects.
    pub fn is_visible(&self) -> bool {
        self.surroundings.visible
    }

    /// Draws it where nothing opaque has been drawn: at the largest depth, with alpha 1. Depth is tested but not written.
    pub fn draw_sky(&self, shared: &Shared, frame: &Frame, target: &Target) -> Result<(), GlError> {
        let gl = &shared.gl;
        let _group = DebugGroup::new(gl, "sky");
        let program = shared.sky_program()?;
        program.bind();
        let unit = texture_unit("environment_map");
        let (seen, level) = match self.surroundings.blur {
            blur if blur > 0.0 => self.textures.seen_blurred(gl, blur)?,
            _ => (self.textures.seen(), self.sky_level(self.textures.seen(), frame, target)),
        };
        program.set_i32("environment_map", unit as i32);
        program.set_mat3("environment_from_clip", &self.environment_from_clip(frame).as_mat3());
        program.set_f32("environment_intensity", self.surroundings.intensity as f32);
        program.set_f32("environment_level", level as f32);
        seen.bind(gl, unit);
        gl.depth_func(glow::LEQUAL);
        gl.depth_mask(false);
        gl.disable(glow::CULL_FACE);
        gl.bind_vertex_array(Some(shared.no_attributes.handle()));
        gl.draw_arrays(glow::TRIANGLES, 0, 3);
        gl.bind_vertex_array(None);
        gl.depth_mask(true);
        gl.depth_func(glow::LESS);
        self.textures.map.bind(gl, unit);
        Ok(())
    }

    /// From (x, y, 1), x and y from -1 to 1 over the picture, to a direction in the environment. The position of the
    /// eye does not matter: the environment is infinitely far away.
    fn environment_from_clip(&self, frame: &Frame) -> DMat3 {
        let camera = &frame.camera;
        let half_height = (0.5 * camera.fov_y_rad).tan();
        let half_width = half_height * f64::from(frame.width) / f64::from(frame.height);
        let world_from_clip = DMat3::from_cols(half_width * camera.right, half_height * camera.up, camera.front);
        self.surroundings.environment_from_world * world_from_clip
    }

    /// One level for the whole picture: the one whose texels are as far apart as shaded pixels, in the middle of the
    /// picture and of a face. Where the samples of a pixel are a grid of finer pixels, each is shaded and then averaged,
    /// so the level of a whole pixel would blur twice.
    fn sky_level(&self, seen: &CubeTexture, frame: &Frame, target: &Target) -> f64 {
        if !self.mipmapped {
            return 0.0;
        }
        let finer = if let (SamplesOf::Grid, side) = target.to_average() { side } else { 1 };
        let rows = f64::from(frame.height) * f64::from(finer);
        let pixel = 2.0 * (0.5 * frame.camera.fov_y_rad).tan() / rows;
        (0.5 * f64::from(seen.size) * pixel).max(1.0).log2()
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
