//! Draws a scene: lights into the light table, opaque parts, transparent triangles from back to front,
//! samples resolved, and on demand the picture's numbers.

#[cfg(feature = "bench")]
mod bare;

use crate::driver::DriverInfo;
use crate::glsl::{ATTRIBUTES, Dialect, Display, MapSet, OutputKey, Reflectance, SceneKey, TEXTURE_UNITS, quantity_number, texture_unit};
use crate::light_table::LightTable;
use crate::objects::{DebugGroup, TextureObject, VertexArray};
use crate::program::Program;
use crate::scene_on_gpu::{GpuObject, GpuScene, Run, wants_unshared};
use crate::statistics::{GpuStatistics, StatisticsQueries};
use crate::target::{OutputTarget, Precision, Target};
use crate::{Gl, GlError, textures};
use glam::{DMat4, DVec3, Vec2};
use glow::HasContext;
use gonio_light::light::ambient_color;
use gonio_light::{Convention, Quantity};
use gonio_mesh::AmbientRule;
use gonio_scene::description::Shading;
use gonio_scene::picture::EncodedPicture;
use gonio_scene::{BoundTexture, DisplayMap, Frame, LoadedScene, Picture, SceneMaterial, ViewSpec};
use std::cell::RefCell;
use std::collections::HashMap;
use std::rc::Rc;

/// Draws scenes with one OpenGL context.
pub struct Renderer {
    shared: Rc<Shared>,
    light_table: LightTable,
    white: TextureObject,
    target: Option<Rc<Target>>,
    precision: Precision,
}

/// What a finished frame needs as well.
struct Shared {
    gl: Gl,
    info: DriverInfo,
    scene_programs: RefCell<HashMap<SceneKey, Rc<Program>>>,
    output_programs: RefCell<HashMap<OutputKey, Rc<Program>>>,
    /// Core profiles draw nothing without a vertex array, even where no attribute is read.
    no_attributes: VertexArray,
}

/// A frame on the GPU, finished. Reading it back is a separate step.
pub struct Drawn {
    shared: Rc<Shared>,
    target: Rc<Target>,
    display: DisplayMap,
    background: OutputBackground,
    /// What the GPU counted.
    pub statistics: GpuStatistics,
    /// Notes on what the driver could not do as asked, for example fewer samples.
    pub notes: Vec<String>,
}

#[derive(Clone, Copy)]
struct OutputBackground {
    top: DVec3,
    bottom: DVec3,
    alpha: f64,
}

/// One draw call.
struct Draw<'a> {
    object: &'a GpuObject,
    run: Run,
}

impl Renderer {
    /// For a current context.
    pub fn new(gl: Gl) -> Result<Self, GlError> {
        let info = DriverInfo::of(&gl);
        let light_table = LightTable::new(&gl)?;
        let white = textures::white(&gl)?;
        let no_attributes = VertexArray::bound(&gl, "no attributes")?;
        let shared = Rc::new(Shared {
            gl,
            info,
            scene_programs: RefCell::default(),
            output_programs: RefCell::default(),
            no_attributes,
        });
        Ok(Renderer { shared, light_table, white, target: None, precision: Precision::Full })
    }

    /// The driver.
    pub fn info(&self) -> &DriverInfo {
        &self.shared.info
    }

    /// How exactly the next frames keep light; [`Precision::Full`] to begin with.
    pub fn set_precision(&mut self, precision: Precision) {
        self.precision = precision;
    }

    /// Uploads geometry and textures.
    pub fn upload(&mut self, scene: &LoadedScene) -> Result<GpuScene, GlError> {
        let _group = DebugGroup::new(&self.shared.gl, "upload");
        let uploaded = GpuScene::upload(&self.shared.gl, scene, self.shared.info.max_size)?;
        self.shared.check_error("uploading the scene")?;
        Ok(uploaded)
    }

    /// Draws the picture, or a debug view, and waits for it.
    pub fn render(&mut self, scene: &GpuScene, frame: &Frame, view: Option<ViewSpec>) -> Result<Drawn, GlError> {
        let shared = self.shared.clone();
        let gl = &shared.gl;
        let mut notes = Vec::new();
        let target = self.target_for(frame, &mut notes)?;
        let queries = StatisticsQueries::begin(gl, &shared.info)?;
        let draw_calls = {
            let _group = DebugGroup::new(gl, "scene");
            self.draw_scene(scene, frame, view, &target)?
        };
        let statistics = queries.end(gl, draw_calls);
        target.resolve(gl);
        // SAFETY: waits for the commands above; no precondition.
        unsafe { gl.finish() };
        shared.check_error("drawing the scene")?;
        let display = DisplayMap::for_view(view, frame);
        let is_picture = view.is_none_or(|v| v.quantity == Quantity::Total);
        let background = if is_picture {
            let alpha = if frame.background.transparent { 0.0 } else { 1.0 };
            OutputBackground { top: frame.background.top, bottom: frame.background.bottom, alpha }
        } else {
            OutputBackground { top: DVec3::ZERO, bottom: DVec3::ZERO, alpha: 1.0 }
        };
        Ok(Drawn { shared, target, display, background, statistics: statistics.read(), notes })
    }

    fn target_for(&mut self, frame: &Frame, notes: &mut Vec<String>) -> Result<Rc<Target>, GlError> {
        let info = &self.shared.info;
        if frame.width > info.max_size || frame.height > info.max_size {
            return Err(GlError::new(format!(
                "a picture of {} x {} pixels is more than this driver's {} along a side; a smaller --size or \
                 `--backend cpu` will do",
                frame.width, frame.height, info.max_size
            )));
        }
        let samples = frame.samples.min(info.max_samples).max(1);
        if samples < frame.samples {
            notes.push(format!(
                "{} samples per pixel instead of {}: this driver has no more",
                samples, frame.samples
            ));
        }
        let size = [frame.width as i32, frame.height as i32];
        if let Some(target) = &self.target {
            // A target that a finished frame still holds must not be drawn over.
            if target.size == size
                && target.samples == samples as i32
                && target.precision == self.precision
                && Rc::strong_count(target) == 1
            {
                return Ok(target.clone());
            }
        }
        self.target = None;
        let shared = &self.shared;
        let target = Target::new(&shared.gl, shared.info.dialect, size, samples as i32, self.precision)?;
        let target = Rc::new(target);
        self.shared.check_error("making the picture's memory")?;
        self.target = Some(target.clone());
        Ok(target)
    }

    fn draw_scene(
        &mut self,
        scene: &GpuScene,
        frame: &Frame,
        view: Option<ViewSpec>,
        target: &Target,
    ) -> Result<u32, GlError> {
        let shared = self.shared.clone();
        let gl = &shared.gl;
        // SAFETY: plain state; the unit exists (16 are guaranteed).
        unsafe { gl.active_texture(glow::TEXTURE0 + texture_unit("light_table")) };
        self.light_table.fill(gl, &frame.lights);
        target.begin(gl);
        // SAFETY: plain state.
        unsafe {
            gl.enable(glow::DEPTH_TEST);
            gl.depth_func(glow::LESS);
            gl.disable(glow::BLEND);
        }
        let mut pass = Pass {
            shared: &shared,
            scene,
            frame,
            view,
            white: self.white.handle(),
            lights: &self.light_table,
            prepared: HashMap::new(),
        };
        let mut draw_calls = 0;
        for object in &scene.objects {
            for run in &object.opaque {
                pass.draw(&Draw { object, run: run.clone() })?;
                draw_calls += 1;
            }
        }
        let transparent = sorted_transparent(scene, frame);
        if !transparent.is_empty() {
            let _group = DebugGroup::new(gl, "transparent, back to front");
            // SAFETY: plain state; colours are premultiplied.
            unsafe {
                // A debug view shows the nearest surface as if it were opaque.
                if !pass.is_view() {
                    gl.enable(glow::BLEND);
                    gl.blend_func(glow::ONE, glow::ONE_MINUS_SRC_ALPHA);
                    gl.depth_mask(false);
                }
            }
            for draw in &transparent {
                pass.draw(draw)?;
                draw_calls += 1;
            }
            // SAFETY: plain state, put back.
            unsafe {
                gl.disable(glow::BLEND);
                gl.depth_mask(true);
            }
        }
        // SAFETY: plain state, put back.
        unsafe {
            gl.disable(glow::CULL_FACE);
            gl.front_face(glow::CCW);
            gl.bind_vertex_array(None);
        }
        Ok(draw_calls)
    }
}

/// Transparent triangles of all objects, farthest first, neighbours of one material in one draw.
fn sorted_transparent<'a>(scene: &'a GpuScene, frame: &Frame) -> Vec<Draw<'a>> {
    let front = frame.camera.front.as_vec3();
    let mut triangles: Vec<(f32, &GpuObject, usize, usize)> = scene
        .objects
        .iter()
        .flat_map(|o| o.transparent.iter().map(move |t| (t.center_in_world.dot(front), o, t.triangle, t.material)))
        .collect();
    triangles.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut draws: Vec<Draw<'a>> = Vec::new();
    for (_, object, triangle, material) in triangles {
        match draws.last_mut() {
            Some(draw)
                if std::ptr::eq(draw.object, object)
                    && draw.run.material == material
                    && draw.run.first_triangle + draw.run.triangle_count == triangle =>
            {
                draw.run.triangle_count += 1;
            }
            _ => draws.push(Draw {
                object,
                run: Run { name: String::new(), first_triangle: triangle, triangle_count: 1, material },
            }),
        }
    }
    draws
}

/// One pass over the objects: sets what each draw needs.
struct Pass<'a> {
    shared: &'a Shared,
    scene: &'a GpuScene,
    frame: &'a Frame,
    view: Option<ViewSpec>,
    white: glow::Texture,
    lights: &'a LightTable,
    /// Programs whose uniforms of the frame are set.
    prepared: HashMap<SceneKey, Rc<Program>>,
}

impl Pass<'_> {
    fn draw(&mut self, draw: &Draw<'_>) -> Result<(), GlError> {
        let gl = &self.shared.gl;
        let object = draw.object;
        let material = &self.scene.materials[draw.run.material];
        let _group = DebugGroup::new(gl, &format!("{} {} [{}]", object.object.name, draw.run.name, material.material.name));
        let key = self.key(object, material);
        let program = self.prepared(key)?;
        program.bind();
        let geometries = &self.scene.geometries[object.object.mesh];
        let geometry = if wants_unshared(object.object.shading) { &geometries.unshared } else { &geometries.shared };
        let Some(geometry) = geometry else {
            return Err(GlError::new(format!("`{}` was not uploaded for {} shading", object.object.name, object.object.shading)));
        };
        geometry.bind(gl);
        self.set_object(&program, object);
        self.set_material(&program, key, material);
        let first = draw.run.first_triangle * 3 * size_of::<u32>();
        let count = draw.run.triangle_count * 3;
        // SAFETY: the run lies within the index buffer, whose indices lie within the vertex buffers: the
        // mesh's readers guarantee both.
        unsafe {
            if object.object.closed {
                gl.enable(glow::CULL_FACE);
                gl.cull_face(glow::BACK);
            } else {
                gl.disable(glow::CULL_FACE);
            }
            gl.front_face(if object.mirrored { glow::CW } else { glow::CCW });
            gl.draw_elements(glow::TRIANGLES, count as i32, glow::UNSIGNED_INT, first as i32);
        }
        Ok(())
    }

    fn key(&self, object: &GpuObject, material: &SceneMaterial) -> SceneKey {
        let equation = &self.frame.equation;
        let maps = &material.maps;
        let others = [&maps.specular, &maps.emitted, &maps.shininess, &maps.opacity];
        SceneKey {
            shading: object.object.shading,
            reflectance: equation.brdf.map_or(Reflectance::Lab(equation.specular), |b| Reflectance::Brdf(b.kind)),
            maps: if others.iter().any(|m| m.is_some()) {
                MapSet::All
            } else if maps.diffuse.is_some() {
                MapSet::Diffuse
            } else {
                MapSet::None
            },
            normal_map: maps.normal.is_some() && object.object.shading == Shading::Phong,
            // Closed objects never show their back faces.
            two_sided: self.frame.two_sided && !object.object.closed,
            view: self.is_view(),
            many_lights: self.lights.is_in_texture(),
        }
    }

    /// Whether a debug view is drawn, not the picture.
    fn is_view(&self) -> bool {
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
        let diff = if is_brdf || equation.convention == Convention::Physical {
            std::f32::consts::FRAC_1_PI
        } else {
            1.0
        };
        program.set_i32("light_count", self.lights.count as i32);
        if !self.lights.uniforms().is_empty() {
            program.set_vec4_array("light_values[0]", self.lights.uniforms());
        }
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
        if let Some(view) = self.view {
            let chosen = match view.light {
                Some(index) => LightTable::row_of_light(&frame.lights, index),
                None => (self.lights.count > 0).then_some(0),
            };
            program.set_i32("view_quantity", quantity_number(view.quantity));
            program.set_i32("view_light", chosen.map_or(-1, |row| row as i32));
            program.set_i32("view_of_one_light", view.light.is_some().into());
            let camera = &frame.camera;
            let plane = camera.front.extend(-camera.front.dot(camera.position)).as_vec4();
            program.set_vec4("depth_plane", plane.to_array());
        }
        self.prepared.insert(key, program.clone());
        Ok(program)
    }

    fn set_object(&self, program: &Program, object: &GpuObject) {
        let frame = self.frame;
        let aspect = f64::from(frame.width) / f64::from(frame.height);
        // Multiplied in f64, so that a model far from the origin keeps its place to the pixel.
        let clip_from_model: DMat4 =
            frame.camera.clip_from_view(aspect) * frame.camera.view_from_world() * object.world_from_model;
        program.set_mat4("clip_from_model", &clip_from_model.as_mat4());
        program.set_mat4("world_from_model", &object.world_from_model.as_mat4());
        program.set_mat3("normal_world_from_model", &object.normal_world_from_model);
        program.set_f32("handedness", if object.mirrored { -1.0 } else { 1.0 });
    }

    fn set_material(&self, program: &Program, key: SceneKey, material: &SceneMaterial) {
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
        let maps = &material.maps;
        if key.maps != MapSet::None {
            self.bind_map(program, "diffuse_map", "diffuse_map_transform", maps.diffuse.as_ref());
        }
        if key.maps == MapSet::All {
            self.bind_map(program, "specular_map", "specular_map_transform", maps.specular.as_ref());
            self.bind_map(program, "emitted_map", "emitted_map_transform", maps.emitted.as_ref());
            self.bind_map(program, "shininess_map", "shininess_map_transform", maps.shininess.as_ref());
            self.bind_map(program, "opacity_map", "opacity_map_transform", maps.opacity.as_ref());
        }
        if key.normal_map {
            self.bind_map(program, "normal_map", "normal_map_transform", maps.normal.as_ref());
        }
    }

    fn bind_map(&self, program: &Program, sampler: &str, transform: &'static str, map: Option<&BoundTexture>) {
        let gl = &self.shared.gl;
        let texture = map.and_then(|m| self.scene.textures.get(m.texture)).map_or(self.white, |t| t.handle());
        // SAFETY: the texture is this context's; the unit exists (16 are guaranteed).
        unsafe {
            gl.active_texture(glow::TEXTURE0 + texture_unit(sampler));
            gl.bind_texture(glow::TEXTURE_2D, Some(texture));
        }
        let (scale, offset, clamp) = map.map_or(([1.0; 2], [0.0; 2], false), |m| (m.scale, m.offset, m.clamp));
        // Sampling is the texture's state, and a texture may serve two materials: set at each use.
        textures::set_sampling(gl, self.frame.texture_filter, clamp, self.shared.info.anisotropy);
        program.set_vec4(transform, [scale[0], scale[1], offset[0], offset[1]]);
    }
}

impl Shared {
    fn scene_program(&self, key: SceneKey) -> Result<Rc<Program>, GlError> {
        if let Some(program) = self.scene_programs.borrow().get(&key) {
            return Ok(program.clone());
        }
        let [vertex, fragment] = key.sources(self.info.dialect);
        let program = Rc::new(Program::new(&self.gl, &key.name(), &vertex, &fragment, &ATTRIBUTES)?);
        self.scene_programs.borrow_mut().insert(key, program.clone());
        Ok(program)
    }

    fn output_program(&self, key: OutputKey) -> Result<Rc<Program>, GlError> {
        if let Some(program) = self.output_programs.borrow().get(&key) {
            return Ok(program.clone());
        }
        let [vertex, fragment] = key.sources(self.info.dialect);
        let program = Rc::new(Program::new(&self.gl, &format!("output {key:?}"), &vertex, &fragment, &[])?);
        self.output_programs.borrow_mut().insert(key, program.clone());
        Ok(program)
    }

    /// Turns OpenGL's error flag into an error; `doing` completes "... while".
    fn check_error(&self, doing: &str) -> Result<(), GlError> {
        // SAFETY: reads a flag.
        match unsafe { self.gl.get_error() } {
            glow::NO_ERROR => Ok(()),
            glow::OUT_OF_MEMORY => {
                Err(GlError::new(format!("the driver ran out of memory while {doing}; a smaller picture or model may do")))
            }
            code => Err(GlError::new(format!("OpenGL reported error {code:#06x} while {doing}"))),
        }
    }
}

impl Drawn {
    /// The linear values (for debug views: the raw vectors and scalars), premultiplied alpha.
    pub fn linear(&self) -> Result<Picture, GlError> {
        let [width, height] = self.target.size;
        let output = OutputTarget::new(&self.shared.gl, self.target.size, true)?;
        self.output_into(&output, Display::Linear)?;
        let values = output.read_f32(&self.shared.gl);
        self.shared.check_error("reading the picture")?;
        let top_first: &[[f32; 4]] = bytemuck::cast_slice(&values);
        let mut pixels = Vec::with_capacity(top_first.len());
        let affine = self.display.is_affine();
        for (row, line) in top_first.chunks_exact(width as usize).enumerate() {
            let y = (row as f64 + 0.5) / f64::from(height);
            let b = self.background.top.lerp(self.background.bottom, y);
            let b = [b.x, b.y, b.z, 1.0].map(|v| (v * self.background.alpha) as f32);
            pixels.extend(line.iter().map(|p| {
                if affine {
                    return *p;
                }
                let behind = 1.0 - p[3];
                [0, 1, 2, 3].map(|i| p[i] + behind * b[i])
            }));
        }
        Ok(Picture { width: width as u32, height: height as u32, pixels })
    }

    /// As displayed, 8 bits, encoded by the GPU.
    pub fn encoded8(&self) -> Result<EncodedPicture<u8>, GlError> {
        let output = OutputTarget::new(&self.shared.gl, self.target.size, false)?;
        self.output_into(&output, self.encoded())?;
        let rgba = output.read8(&self.shared.gl);
        self.shared.check_error("reading the picture")?;
        Ok(EncodedPicture { width: self.target.size[0] as u32, height: self.target.size[1] as u32, rgba })
    }

    /// As displayed, 16 bits, encoded by the GPU.
    pub fn encoded16(&self) -> Result<EncodedPicture<u16>, GlError> {
        let output = OutputTarget::new(&self.shared.gl, self.target.size, true)?;
        self.output_into(&output, self.encoded())?;
        let rgba = output.read_f32(&self.shared.gl);
        self.shared.check_error("reading the picture")?;
        let rgba = rgba.into_iter().map(|v| (v.clamp(0.0, 1.0) * 65535.0 + 0.5) as u16).collect();
        Ok(EncodedPicture { width: self.target.size[0] as u32, height: self.target.size[1] as u32, rgba })
    }

    /// What a picture file of this frame holds.
    fn encoded(&self) -> Display {
        match self.display {
            DisplayMap::Affine { .. } => Display::Affine,
            DisplayMap::Light(transform) => Display::Light(transform.tone_map, transform.encoding),
        }
    }

    fn output_into(&self, output: &OutputTarget, display: Display) -> Result<(), GlError> {
        let gl = &self.shared.gl;
        let _group = DebugGroup::new(gl, "output");
        let samples = self.target.samples_to_average();
        let program = self.shared.output_program(OutputKey { display, multisampled: samples > 1 })?;
        program.bind();
        program.set_i32("linear_picture", 0);
        program.set_i32("sample_count", samples);
        program.set_i32("top_row_first", 1);
        program.set_vec2("picture_size", Vec2::new(self.target.size[0] as f32, self.target.size[1] as f32));
        program.set_dvec3("background_top", self.background.top);
        program.set_dvec3("background_bottom", self.background.bottom);
        program.set_f32("background_alpha", self.background.alpha as f32);
        match self.display {
            DisplayMap::Affine { scale, bias } => {
                program.set_dvec3("display_scale", scale);
                program.set_dvec3("display_bias", bias);
            }
            DisplayMap::Light(transform) => program.set_f32("exposure", transform.exposure as f32),
        }
        output.bind(gl);
        // SAFETY: the triangle's vertices come from gl_VertexID alone; the texture is the target's.
        unsafe {
            gl.disable(glow::DEPTH_TEST);
            gl.disable(glow::BLEND);
            gl.disable(glow::CULL_FACE);
            gl.active_texture(glow::TEXTURE0);
            self.target.bind_linear(gl);
            gl.bind_vertex_array(Some(self.shared.no_attributes.handle()));
            gl.draw_arrays(glow::TRIANGLES, 0, 3);
            gl.bind_vertex_array(None);
        }
        self.shared.check_error("encoding the picture")
    }
}

/// The dialect that a context speaks.
pub(crate) fn dialect_of(gl: &Gl) -> Dialect {
    if gl.version().is_embedded { Dialect::Es300 } else { Dialect::Core330 }
}
