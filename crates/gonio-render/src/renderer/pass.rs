//! One pass over the objects: the program, buffers and uniforms of each draw.

use super::shared::Shared;
use super::surroundings::BoundEnvironment;
use crate::geometry::MeshOnGpu;
use crate::glsl::{
    LightLoops, MapSet, MaterialFunction, Reflectance, SceneKey, SurroundingsKey, TEXTURE_UNITS, quantity_number,
    texture_unit,
};
use crate::light_table::LightTable;
use crate::scene_on_gpu::{GpuObject, GpuScene, Run};
use crate::textures;
use glam::{DMat4, DVec3};
use gonio_gl::GlError;
use gonio_gl::objects::DebugGroup;
use gonio_gl::program::Program;
use gonio_gl::trace::DrawSubject;
use gonio_light::color::{ColorEncoding, ToneMap};
use gonio_light::light::ambient_color;
use gonio_light::{Convention, Quantity};
use gonio_mesh::AmbientRule;
use gonio_scene::scene_file::Shading;
use gonio_scene::{BoundTexture, Frame, SceneMaterial, ViewSpec};
use std::collections::HashMap;
use std::rc::Rc;

/// One draw call.
pub(super) struct Draw<'a> {
    pub object: &'a GpuObject,
    pub run: Run,
}

/// One pass over the objects: sets what each draw needs.
pub(super) struct Pass<'a> {
    pub shared: &'a Shared,
    pub scene: &'a GpuScene,
    pub frame: &'a Frame,
    pub view: Option<ViewSpec>,
    pub white: glow::Texture,
    pub lights: &'a LightTable,
    /// The environment.
    pub around: Option<BoundEnvironment<'a>>,
    /// Whether shadow maps are bound.
    pub shadows: bool,
    /// The tone map and encoding, if displayed colours are drawn.
    pub display: Option<(ToneMap, ColorEncoding)>,
    /// Whether the top row comes first, as on a display texture.
    pub top_row_first: bool,
    /// Programs whose uniforms of the frame are set.
    pub prepared: HashMap<SceneKey, Rc<Program>>,
}

impl Pass<'_> {
    /// Links the program of a draw. Checking the result waits for all earlier draws on the web, so this is called for all draws
    /// before the first one.
    pub fn prepare(&mut self, draw: &Draw<'_>) -> Result<(), GlError> {
        let material = &self.scene.materials[draw.run.material];
        let key = self.key(draw.object, self.scene.geometry_of(draw.object)?, material)?;
        self.prepared(key).map(drop)
    }

    pub fn draw(&mut self, draw: &Draw<'_>) -> Result<(), GlError> {
        let gl = &self.shared.gl;
        let object = draw.object;
        let material = &self.scene.materials[draw.run.material];
        let _group =
            DebugGroup::new(gl, &format!("{} {} [{}]", object.object.name, draw.run.name, material.material.name));
        let _drawing = gl.drawing(|| DrawSubject {
            index: self.scene.index_of(object),
            object: object.object.name.clone(),
            part: draw.run.name.clone(),
            material: material.material.name.clone(),
        });
        let geometry = self.scene.geometry_of(object)?;
        let key = self.key(object, geometry, material)?;
        let program = self.prepared(key)?;
        program.bind();
        geometry.bind(gl);
        self.set_object(&program, key, object);
        self.set_material(&program, key, object, material);
        let first = draw.run.first_triangle * 3 * size_of::<u32>();
        let count = draw.run.triangle_count * 3;
        if object.object.closed {
            gl.enable(glow::CULL_FACE);
            gl.cull_face(glow::BACK);
        } else {
            gl.disable(glow::CULL_FACE);
        }
        gl.front_face(if object.mirrored != self.top_row_first { glow::CW } else { glow::CCW });
        gl.draw_elements(glow::TRIANGLES, count as i32, glow::UNSIGNED_INT, first as i32);
        Ok(())
    }

    fn key(&self, object: &GpuObject, geometry: &MeshOnGpu, material: &SceneMaterial) -> Result<SceneKey, GlError> {
        let equation = &self.frame.equation;
        let reflectance = match (&material.brdf, equation.brdf) {
            (Some(brdf), _) => {
                let function = MaterialFunction::new(brdf).map_err(GlError::new)?;
                Reflectance::Material(self.shared.functions.borrow_mut().id_of(function))
            }
            (None, Some(brdf)) => Reflectance::Brdf(brdf.kind),
            (None, None) => Reflectance::Lab(equation.specular),
        };
        let maps = &material.maps;
        let others = [&maps.specular, &maps.emitted, &maps.shininess, &maps.opacity];
        Ok(SceneKey {
            shading: object.object.shading,
            reflectance,
            maps: if others.iter().any(|m| m.is_some()) {
                MapSet::All
            } else if maps.diffuse.is_some() {
                MapSet::Diffuse
            } else {
                MapSet::None
            },
            normal_map: maps.normal.is_some() && object.object.shading == Shading::Phong,
            vertex_colors: geometry.has_colors,
            // Closed objects never show their back faces. Onto a window, they share the program of open ones.
            two_sided: self.frame.two_sided && (!object.object.closed || self.display.is_some()),
            view: self.is_view(),
            lights: LightLoops::for_ends(self.lights.ends),
            shadows: self.shadows,
            surroundings: self
                .around
                .as_ref()
                .map_or(SurroundingsKey::NONE, |around| around.key(object, &material.optics, self.is_view())),
            display: self.display,
        })
    }

    /// The environment, if the program shows it.
    fn around_of(&self, key: SceneKey) -> Option<&BoundEnvironment<'_>> {
        self.around.as_ref().filter(|_| key.surroundings != SurroundingsKey::NONE)
    }

    /// Whether a debug view is drawn, not the picture.
    pub fn is_view(&self) -> bool {
        self.view.is_some_and(|v| v.quantity != Quantity::Total)
    }

    /// The program with the frame's uniforms set.
    fn prepared(&mut self, key: SceneKey) -> Result<Rc<Program>, GlError> {
        if let Some(program) = self.prepared.get(&key) {
            return Ok(program.clone());
        }
        let program = self.shared.scene_program(key)?;
        program.bind();
        for (sampler, unit) in TEXTURE_UNITS {
            program.set_i32(sampler, unit as i32);
        }
        let frame = self.frame;
        let equation = &frame.equation;
        let switch = |on: bool| if on { 1.0 } else { 0.0 };
        let is_brdf = equation.brdf.is_some();
        let diff =
            if is_brdf || equation.convention == Convention::Physical { std::f32::consts::FRAC_1_PI } else { 1.0 };
        for (end, name) in self.lights.ends.iter().zip(["directional_end", "point_end", "spot_end"]) {
            program.set_i32(name, *end as i32);
        }
        // Also without lights, because the compiler may keep the array: every uniform is set.
        let none = [[0.0; 4]];
        let values = if self.lights.uniforms().is_empty() { &none } else { self.lights.uniforms() };
        program.set_vec4_array("light_values[0]", values);
        program.set_dvec3("eye_in_world", frame.camera.position);
        program.set_f32("diff_factor", diff);
        program.set_f32("diffuse_switch", switch(equation.terms.diffuse));
        program.set_f32("specular_switch", switch(equation.terms.specular));
        program.set_f32("attenuation_switch", switch(equation.terms.attenuation));
        program.set_f32("spot_switch", switch(equation.terms.spot));
        program.set_f32("emitted_switch", switch(equation.terms.emitted));
        program.set_i32("gated", equation.gated.into());
        program.set_i32("cosine_weighted", equation.cosine_weighted.into());
        program.set_i32("brdf_normalised", equation.brdf.is_some_and(|b| b.normalised).into());
        program.set_dvec3("lafortune_diagonal", equation.brdf.map_or(DVec3::ZERO, |b| b.lafortune));
        let ambient = if equation.terms.ambient && !is_brdf { ambient_color(&frame.lights) } else { DVec3::ZERO };
        program.set_dvec3("ambient_light", ambient);
        if self.display.is_some() {
            program.set_f32("exposure", frame.output.exposure as f32);
        }
        if let Some(view) = self.view {
            let chosen = match view.light {
                Some(index) => LightTable::row_of_light(&frame.lights, index),
                None => (0..frame.lights.len()).find_map(|index| LightTable::row_of_light(&frame.lights, index)),
            };
            program.set_i32("view_quantity", quantity_number(view.quantity));
            program.set_i32("view_light", chosen.map_or(-1, |row| row as i32));
            program.set_i32("view_of_one_light", view.light.is_some().into());
            let camera = &frame.camera;
            let plane = camera.front.extend(-camera.front.dot(camera.position)).as_vec4();
            program.set_vec4("depth_plane", plane.to_array());
        }
        if let Some(around) = self.around_of(key) {
            around.set_frame(&program, frame);
        }
        self.prepared.insert(key, program.clone());
        Ok(program)
    }

    fn set_object(&self, program: &Program, key: SceneKey, object: &GpuObject) {
        let frame = self.frame;
        let aspect = f64::from(frame.width) / f64::from(frame.height);
        // Multiplied in f64, so that a model far from the origin keeps its place to the pixel.
        let mut clip_from_model: DMat4 =
            frame.camera.clip_from_view(aspect) * frame.camera.view_from_world() * object.world_from_model;
        if self.top_row_first {
            clip_from_model = DMat4::from_scale(DVec3::new(1.0, -1.0, 1.0)) * clip_from_model;
        }
        program.set_mat4("clip_from_model", &clip_from_model.as_mat4());
        program.set_mat4("world_from_model", &object.world_from_model.as_mat4());
        program.set_mat3("normal_world_from_model", &object.normal_world_from_model);
        program.set_f32("handedness", if object.mirrored { -1.0 } else { 1.0 });
        if key.shadows {
            program.set_i32("closed_receiver", object.object.closed.into());
        }
    }

    fn set_material(&self, program: &Program, key: SceneKey, object: &GpuObject, material: &SceneMaterial) {
        let m = &material.material;
        let ambient = match m.ambient {
            AmbientRule::FollowsDiffuse => [0.0, 0.0, 0.0, 1.0],
            AmbientRule::Value([r, g, b]) => [r, g, b, 0.0],
        };
        program.set_vec4("k_ambient", ambient);
        program.set_vec3("k_diffuse", m.diffuse.into());
        program.set_vec3("k_specular", m.specular.into());
        program.set_vec3("k_emitted", m.emitted.into());
        program.set_f32("shininess", m.shininess.max(1.0));
        program.set_f32("opacity", m.opacity);
        program.set_f32("refraction_index", m.refraction_index);
        if let Some(brdf) = &material.brdf {
            if let Some(around) = self.around.as_ref().filter(|_| key.surroundings.lights) {
                around.set_function(program, brdf);
            }
            let gl = &self.shared.gl;
            if let Some(table) = brdf.table.as_ref().and_then(|table| self.scene.table(table)) {
                gl.active_texture(glow::TEXTURE0 + texture_unit("merl_table"));
                gl.bind_texture(glow::TEXTURE_2D, Some(table.handle()));
            }
        }
        let maps = &material.maps;
        if key.maps != MapSet::None {
            self.bind_map(program, "diffuse_map", "diffuse_map_transform", maps.diffuse.as_ref());
        }
        if key.maps == MapSet::All {
            self.bind_map(program, "specular_map", "specular_map_transform", maps.specular.as_ref());
            self.bind_map(program, "emitted_map", "emitted_map_transform", maps.emitted.as_ref());
            program.set_f32("roughness", maps.roughness.unwrap_or(-1.0));
            self.bind_map(program, "shininess_map", "shininess_map_transform", maps.shininess.as_ref());
            self.bind_map(program, "opacity_map", "opacity_map_transform", maps.opacity.as_ref());
        }
        if let Some(around) = self.around_of(key) {
            around.set_material(&self.shared.gl, program, object, material);
        }
        if key.normal_map {
            self.bind_map(program, "normal_map", "normal_map_transform", maps.normal.as_ref());
        }
    }

    fn bind_map(&self, program: &Program, sampler: &str, transform: &'static str, map: Option<&BoundTexture>) {
        let gl = &self.shared.gl;
        let texture = map.and_then(|m| self.scene.textures.get(m.texture)).map_or(self.white, |t| t.handle());
        gl.active_texture(glow::TEXTURE0 + texture_unit(sampler));
        gl.bind_texture(glow::TEXTURE_2D, Some(texture));
        let map = map.copied().unwrap_or(BoundTexture::plain(0));
        // Sampling is the texture's state, and a texture may serve two materials: set at each use.
        textures::set_sampling(gl, self.frame.texture_filter, map.wrap, self.shared.info.anisotropy);
        program.set_mat3x2(transform, &map.uv_matrix());
    }
}

/// The barest loop that draws a scene, which the frame benchmark compares with `Renderer::render`.
#[cfg(feature = "bench")]
impl super::Renderer {
    /// Draws the frame of the last `render` again, `frames` times, and waits for each: clear, one call for the one run of
    /// the one object, resolve. Program, uniforms, textures and target are as `render` left them; nothing is looked up,
    /// set, counted or labelled.
    ///
    /// Only for benchmarks: `scene` must be the scene that was drawn last, of one opaque object of one run.
    pub fn bare_loop(&mut self, scene: &GpuScene, frames: usize) -> Result<(), GlError> {
        let wrong = || GlError::new("the bare loop draws one opaque object of one material that was rendered before");
        let gl = &self.shared.gl;
        let target = self.targets.last().ok_or_else(wrong)?;
        let [object] = scene.objects.as_slice() else { return Err(wrong()) };
        let [run] = object.opaque.as_slice() else { return Err(wrong()) };
        if !object.transparent.is_empty() {
            return Err(wrong());
        }
        let geometry = scene.geometry_of(object)?;
        geometry.bind(gl);
        let first = run.first_triangle * 3 * size_of::<u32>();
        let count = run.triangle_count * 3;
        if object.object.closed {
            gl.enable(glow::CULL_FACE);
            gl.cull_face(glow::BACK);
        }
        gl.front_face(if object.mirrored { glow::CW } else { glow::CCW });
        for _ in 0..frames {
            target.begin(gl, 0, target.size[1]);
            gl.draw_elements(glow::TRIANGLES, count as i32, glow::UNSIGNED_INT, first as i32);
            target.resolve(gl);
            gl.finish();
        }
        gl.disable(glow::CULL_FACE);
        gl.front_face(glow::CCW);
        gl.bind_vertex_array(None);
        self.shared.check_error("the bare loop")
    }
}
