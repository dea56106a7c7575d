//! Draws a scene's objects with a user's program instead of gonio's own.
//!
//! The program's colours are those of the picture: they are not encoded. The background and the sky behind the objects are
//! what [`Renderer::render`] shows there.

use super::output::{Band, DisplaySettings};
use super::pass::Draw;
use super::surroundings::BoundEnvironment;
use super::{PANES, Painted, RenderedFrame, Renderer, sorted_transparent};
use crate::display::DisplayTexture;
use crate::environment_on_gpu::CubeTexture;
use crate::geometry::VertexData;
use crate::scene_on_gpu::{GpuScene, TextureForm};
use crate::textures;
use crate::user_program::UserProgram;
use glam::{DMat4, DVec3};
use gonio_environment::{CubeMips, Cubemap};
use gonio_gl::objects::{DebugGroup, StatisticsQueries, TextureObject, VertexArray};
use gonio_gl::target::{ColorPrecision, Target};
use gonio_gl::trace::DrawSubject;
use gonio_gl::{GlError, SavedState};
use gonio_light::color::{ColorEncoding, OutputTransform, ToneMap};
use gonio_scene::{BoundTexture, Frame, LoadedEnvironment, Overlays, Scene, SceneMaterial, Surroundings, Texture};
use std::rc::Rc;
use std::sync::Arc;

/// The texture that a sampler of a user's program reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SampledTexture {
    /// The colour texture of the material; white if it has none.
    DiffuseMap,
    /// The specular texture of the material; white if it has none.
    SpecularMap,
    /// The normal map of the material; straight up if it has none.
    NormalMap,
    /// The scene's environment as it is shown behind the objects; black if it has none.
    Environment,
    /// A texture of the user, by its index in [`UserPass::files`]; white if there is no such texture.
    File(usize),
    /// White.
    White,
}

/// Values of uniforms, by the number of the uniform.
pub type UniformValues = Vec<(usize, Vec<f32>)>;

/// A user's program and where its inputs come from.
pub struct UserPass<'a> {
    /// The program.
    pub program: &'a UserProgram,
    /// The data that each attribute reads, by its location. Other attributes read (0, 0, 0, 1).
    pub attributes: &'a [(u32, VertexData)],
    /// The texture that each sampler reads, by the number of its uniform.
    pub samplers: &'a [(usize, SampledTexture)],
    /// Textures that are not the scene's.
    pub files: &'a [Arc<Texture>],
    /// The scene that was uploaded, for its textures and its environment.
    pub scene: &'a Scene,
    /// The values of the other uniforms for an object's matrix (world from model) and a material, by number.
    pub values: &'a dyn Fn(DMat4, &SceneMaterial) -> UniformValues,
}

/// Most texels along an edge of the environment that a program reads.
const ENVIRONMENT_SIDE: u32 = 512;
/// The number of texture units that every driver has.
const UNITS: usize = 16;

/// The environment as a user's program reads it, and what it was made from.
pub(super) struct DisplayedEnvironment {
    source: Arc<LoadedEnvironment>,
    surroundings: Surroundings,
    output: OutputTransform,
    map: CubeTexture,
}

/// The textures of a pass on the GPU.
struct PassTextures {
    white: Rc<TextureObject>,
    /// A normal map without bumps.
    flat: Rc<TextureObject>,
    scene: Vec<Option<Rc<TextureObject>>>,
    files: Vec<Rc<TextureObject>>,
}

impl Renderer {
    /// Draws the picture with a user's program, and waits for it. There is a depth test, and nothing is culled. Transparent parts
    /// are drawn last, from back to front, and blended by the alpha that the program writes; elsewhere alpha is ignored, unless
    /// the background is transparent.
    pub fn render_user_pass(
        &mut self,
        scene: &GpuScene,
        frame: &Frame,
        pass: &UserPass<'_>,
    ) -> Result<RenderedFrame, GlError> {
        let shared = self.shared.clone();
        let gl = &shared.gl;
        let target = self.user_target(frame, ColorPrecision::Full)?;
        let queries = StatisticsQueries::begin(gl, &shared.info)?;
        let drawn = self.draw_user_pass(scene, frame, pass, &target);
        let statistics = queries.end(gl, drawn.as_ref().copied().unwrap_or_default());
        drawn?;
        target.resolve(gl);
        gl.finish();
        shared.check_error("drawing with your shaders")?;
        let look = display_settings(frame);
        Ok(RenderedFrame { shared, target, look, statistics: statistics.read(), notes: Vec::new() })
    }

    /// [`Self::render_user_pass`] onto a display texture, which takes the frame's size, with overlays. Does not wait, and leaves
    /// the window's state as [`Renderer::paint`] does.
    pub fn paint_user_pass(
        &mut self,
        scene: &GpuScene,
        frame: &Frame,
        pass: &UserPass<'_>,
        overlays: Overlays,
        canvas: &mut DisplayTexture,
    ) -> Result<Painted, GlError> {
        let shared = self.shared.clone();
        let gl = &shared.gl;
        let _state = SavedState::save(gl);
        let target = self.user_target(frame, ColorPrecision::Half)?;
        canvas.fit([frame.width, frame.height])?;
        let mut draw_calls = self.draw_user_pass(scene, frame, pass, &target)?;
        target.resolve(gl);
        let look = display_settings(frame).to_be_shown();
        let whole = Band { picture_height: target.size[1], first_row: 0, rows: target.size[1] };
        shared.output_into(canvas.output(), &target, whole, &look, look.encoded())?;
        if overlays.any() {
            draw_calls += shared.draw_overlays(overlays, scene, &mut self.cache, frame, canvas)?;
        }
        Ok(Painted { draw_calls, ..Painted::default() })
    }

    /// A target with one shading per pixel, so that `gl_FragCoord` counts pixels.
    fn user_target(&mut self, frame: &Frame, precision: ColorPrecision) -> Result<Rc<Target>, GlError> {
        let most = self.shared.info.max_size;
        let size = [frame.width, frame.height].map(|side| side.clamp(1, most) as i32);
        self.user_program_target(size, frame.samples, precision)
    }

    fn draw_user_pass(
        &mut self,
        scene: &GpuScene,
        frame: &Frame,
        pass: &UserPass<'_>,
        target: &Target,
    ) -> Result<u32, GlError> {
        let shared = self.shared.clone();
        let gl = &shared.gl;
        let _group = DebugGroup::new(gl, "user's shaders");
        let textures = self.pass_textures(pass)?;
        self.prepare_environment(frame, pass)?;
        self.draw_behind(scene, frame, target)?;
        gl.color_mask(true, true, true, frame.background.transparent);
        gl.disable(glow::BLEND);
        gl.disable(glow::CULL_FACE);
        gl.enable(glow::DEPTH_TEST);
        gl.depth_func(glow::LEQUAL);
        let array = VertexArray::bound(gl, "user's shaders")?;
        pass.program.bind();
        for (unit, &(uniform, texture)) in pass.samplers.iter().take(UNITS).enumerate() {
            // All elements of an array read the same.
            pass.program.set_index(uniform, &[unit as f32; UNITS]);
            if let (SampledTexture::Environment, Some(environment)) = (texture, &self.displayed_environment) {
                environment.map.bind(gl, unit as u32);
            }
        }
        let mut draw_calls = 0;
        let opaque = scene
            .objects
            .iter()
            .flat_map(|object| object.opaque.iter().map(move |run| Draw { object, run: run.clone() }));
        let transparent = sorted_transparent(scene, frame);
        let opaque: Vec<Draw<'_>> = opaque.collect();
        for (draws, is_blended) in [(opaque, false), (transparent, true)] {
            if is_blended {
                gl.enable(glow::BLEND);
                let [source, destination] = [glow::SRC_ALPHA, glow::ONE_MINUS_SRC_ALPHA];
                gl.blend_func_separate(source, destination, glow::ONE, destination);
            }
            for draw in &draws {
                let material = &scene.materials[draw.run.material];
                let _drawing = gl.drawing(|| DrawSubject {
                    index: scene.index_of(draw.object),
                    object: draw.object.object.name.clone(),
                    part: draw.run.name.clone(),
                    material: material.material.name.clone(),
                });
                self.bind_pass_textures(frame, pass, &textures, material);
                for (uniform, values) in (pass.values)(draw.object.world_from_model, material) {
                    pass.program.set_index(uniform, &values);
                }
                gl.bind_vertex_array(Some(array.handle()));
                for location in pass.program.locations() {
                    gl.disable_vertex_attrib_array(location);
                    gl.vertex_attrib_4_f32(location, 0.0, 0.0, 0.0, 1.0);
                }
                scene.geometry_of(draw.object)?.feed(gl, pass.attributes);
                gl.front_face(if draw.object.mirrored { glow::CW } else { glow::CCW });
                let first = draw.run.first_triangle * 3 * size_of::<u32>();
                gl.draw_elements(
                    glow::TRIANGLES,
                    (draw.run.triangle_count * 3) as i32,
                    glow::UNSIGNED_INT,
                    first as i32,
                );
                draw_calls += 1;
            }
        }
        gl.disable(glow::BLEND);
        gl.front_face(glow::CCW);
        gl.depth_func(glow::LESS);
        gl.color_mask(true, true, true, true);
        gl.bind_vertex_array(None);
        Ok(draw_calls)
    }

    /// Binds the target, and fills it with the background and the sky as they are shown.
    fn draw_behind(&mut self, scene: &GpuScene, frame: &Frame, target: &Target) -> Result<(), GlError> {
        let shared = self.shared.clone();
        let gl = &shared.gl;
        let one_sample = Frame { samples: 1, ..frame.clone() };
        let (rows, mut notes) = (frame.height as i32, Vec::new());
        let light = self.target_for(scene, &one_sample, rows, ColorPrecision::Half, PANES, &mut notes)?;
        light.begin(gl, 0, rows);
        gl.disable(glow::BLEND);
        gl.enable(glow::DEPTH_TEST);
        if let Some(sky) = BoundEnvironment::sky(&shared, scene, frame).filter(BoundEnvironment::is_visible) {
            sky.draw_sky(&shared, frame, &light)?;
        }
        light.resolve(gl);
        target.begin(gl, 0, rows);
        shared.output_onto_bound(&light, &DisplaySettings::new(None, frame).to_be_shown())
    }

    fn pass_textures(&mut self, pass: &UserPass<'_>) -> Result<PassTextures, GlError> {
        let shared = self.shared.clone();
        let most = shared.info.max_size;
        let reads = |kind| pass.samplers.iter().any(|(_, texture)| *texture == kind);
        let mut wanted = vec![false; pass.scene.textures.len()];
        for material in &pass.scene.materials {
            for kind in [SampledTexture::DiffuseMap, SampledTexture::SpecularMap, SampledTexture::NormalMap] {
                if let Some(bound) = map_of(material, kind).filter(|_| reads(kind))
                    && let Some(wanted) = wanted.get_mut(bound.texture)
                {
                    *wanted = true;
                }
            }
        }
        let cached = &mut self.cache.textures;
        let mut upload = |texture: &Arc<Texture>| {
            cached.get(texture, TextureForm::Bytes, || textures::upload_bytes(&shared.gl, texture, most))
        };
        let made = PassTextures {
            white: upload(&self.white_and_flat[0])?,
            flat: upload(&self.white_and_flat[1])?,
            scene: pass
                .scene
                .textures
                .iter()
                .zip(wanted)
                .map(|(texture, wanted)| wanted.then(|| upload(texture)).transpose())
                .collect::<Result<_, _>>()?,
            files: pass.files.iter().map(&mut upload).collect::<Result<_, _>>()?,
        };
        // The textures stay until another pass replaces them.
        self.cache.tidy();
        Ok(made)
    }

    fn bind_pass_textures(
        &self,
        frame: &Frame,
        pass: &UserPass<'_>,
        textures: &PassTextures,
        material: &SceneMaterial,
    ) {
        let gl = &self.shared.gl;
        for (unit, &(_, kind)) in pass.samplers.iter().take(UNITS).enumerate() {
            let bound = map_of(material, kind).copied();
            let texture = match kind {
                SampledTexture::Environment => continue,
                SampledTexture::File(index) => textures.files.get(index),
                _ => bound.and_then(|bound| textures.scene.get(bound.texture)?.as_ref()),
            };
            let missing = if kind == SampledTexture::NormalMap { &textures.flat } else { &textures.white };
            gl.active_texture(glow::TEXTURE0 + unit as u32);
            gl.bind_texture(glow::TEXTURE_2D, Some(texture.unwrap_or(missing).handle()));
            let wrap = bound.unwrap_or(BoundTexture::plain(0)).wrap;
            textures::set_sampling(gl, frame.texture_filter, wrap, self.shared.info.anisotropy);
        }
    }

    /// Makes the environment that samplers read: the colours that are shown behind the objects, in the directions of the world.
    fn prepare_environment(&mut self, frame: &Frame, pass: &UserPass<'_>) -> Result<(), GlError> {
        let is_read = pass.samplers.iter().any(|(_, texture)| *texture == SampledTexture::Environment);
        let (Some(source), Some(surroundings), true) = (&pass.scene.environment, frame.surroundings, is_read) else {
            self.displayed_environment = None;
            return Ok(());
        };
        let is_current = self.displayed_environment.as_ref().is_some_and(|made| {
            Arc::ptr_eq(&made.source, source) && made.surroundings == surroundings && made.output == frame.output
        });
        if is_current {
            return Ok(());
        }
        let Some(mips) = displayed_environment(pass.scene, frame) else { return Ok(()) };
        let most = self.shared.info.max_cube_size;
        let map = CubeTexture::upload(&self.shared.gl, "environment as shown", mips.levels(), most)?;
        self.displayed_environment =
            Some(DisplayedEnvironment { source: source.clone(), surroundings, output: frame.output, map });
        Ok(())
    }
}

/// The scene's environment as a user's program reads it: the colours that are shown behind the objects, in the directions of
/// the world. `None` if the scene has none.
pub fn displayed_environment(scene: &Scene, frame: &Frame) -> Option<CubeMips> {
    let (source, surroundings) = (scene.environment.as_ref()?, frame.surroundings?);
    let levels = source.mips.levels();
    let level = levels.iter().find(|level| level.size() <= ENVIRONMENT_SIDE).or(levels.last())?;
    let turn = surroundings.environment_from_world;
    let shown = |light: DVec3| frame.output.encode(light * surroundings.intensity);
    let map = Cubemap::from_function(level.size(), |direction| shown(level.sample(turn * direction)));
    Some(CubeMips::new(map))
}

/// The texture of a material that a sampler reads.
pub fn map_of(material: &SceneMaterial, kind: SampledTexture) -> Option<&BoundTexture> {
    match kind {
        SampledTexture::DiffuseMap => material.maps.diffuse.as_ref(),
        SampledTexture::SpecularMap => material.maps.specular.as_ref(),
        SampledTexture::NormalMap => material.maps.normal.as_ref(),
        _ => None,
    }
}

fn display_settings(frame: &Frame) -> DisplaySettings {
    DisplaySettings::new(None, &shown_unchanged(frame))
}

/// The frame for a picture whose colours, background included, are already those that are shown.
pub fn shown_unchanged(frame: &Frame) -> Frame {
    let mut frame = frame.clone();
    frame.output = OutputTransform { exposure: 0.0, tone_map: ToneMap::None, encoding: ColorEncoding::Direct };
    frame.background.transparent = true;
    frame
}
