//! Draws a scene: lights into the light table, opaque parts, the sky, transparent triangles from back to
//! front, samples resolved, and on demand the picture's numbers.

mod bands;
mod ground;
mod on_window;
mod outline;
mod output;
mod paint;
mod pass;
mod record;
mod shadows;
mod shared;
mod special;
mod surroundings;
mod user_pass;

pub use bands::RenderedPicture;
pub use ground::GroundLook;
pub use outline::OutlinedPart;
pub use output::RenderedFrame;
pub use paint::{DifferenceScale, Painted};
pub use user_pass::{SampledTexture, UniformValues, UserPass, displayed_environment, map_of, shown_unchanged};

use crate::glsl::texture_unit;
use crate::light_table::LightTable;
use crate::scene_on_gpu::{GpuCache, GpuObject, GpuScene, Run};
use crate::shadows_on_gpu::ShadowMaps;
use crate::textures;
use gonio_gl::Dialect;
use gonio_gl::DriverInfo;
use gonio_gl::objects::StatisticsQueries;
use gonio_gl::objects::{DebugGroup, TextureObject, VertexArray};
use gonio_gl::target::{ColorPrecision, DepthTarget, Sampling, Target};
use gonio_gl::{Gl, GlError, Remedy};
use gonio_scene::{ColorSpace, Frame, Scene, Texture, ViewSpec};
use output::DisplaySettings;
use pass::{Draw, Pass};
use shared::{PANES, Shared, Targets};
use std::cell::RefCell;
use std::collections::HashMap;
use std::rc::Rc;
use std::sync::Arc;
use surroundings::BoundEnvironment;
use user_pass::DisplayedEnvironment;

/// Draws scenes with one OpenGL context.
pub struct Renderer {
    shared: Rc<Shared>,
    light_table: LightTable,
    white: TextureObject,
    pub(crate) targets: Targets,
    pub(crate) cache: GpuCache,
    /// The memory of shadow maps, kept between scenes.
    shadow_atlases: Vec<Rc<DepthTarget>>,
    /// The textures that a user's program reads where a material has none: white, and a normal map without bumps.
    white_and_flat: [Arc<Texture>; 2],
    displayed_environment: Option<DisplayedEnvironment>,
}

impl Renderer {
    /// Creates a renderer for a current context.
    pub fn new(gl: Gl) -> Result<Self, GlError> {
        let info = DriverInfo::new(&gl);
        let light_table = LightTable::new(&gl)?;
        let white = textures::white(&gl)?;
        let no_attributes = VertexArray::bound(&gl, "no attributes")?;
        let shared = Rc::new(Shared {
            gl,
            info,
            scene_programs: RefCell::default(),
            functions: RefCell::default(),
            output_programs: RefCell::default(),
            special_programs: RefCell::default(),
            sky: RefCell::default(),
            difference: RefCell::default(),
            no_attributes,
        });
        Ok(Renderer {
            shared,
            light_table,
            white,
            targets: Targets::default(),
            cache: GpuCache::default(),
            shadow_atlases: Vec::new(),
            white_and_flat: [("white", [255; 4]), ("no bumps", [128, 128, 255, 255])]
                .map(|(name, texel)| Arc::new(Texture::new(name, 1, 1, texel.to_vec(), ColorSpace::Data))),
            displayed_environment: None,
        })
    }

    /// The driver.
    pub fn info(&self) -> &DriverInfo {
        &self.shared.info
    }

    /// Uploads geometry and textures, except those that another scene of this renderer still uses: two panes of one scene, or a
    /// scene before and after an edit, share equal data (the same `Arc`s).
    pub fn upload(&mut self, scene: &Scene) -> Result<GpuScene, GlError> {
        let _group = DebugGroup::new(&self.shared.gl, "upload");
        let before = self.cache.count_made();
        let uploaded = GpuScene::upload(&self.shared.gl, scene, &self.shared.info, &mut self.cache)?;
        // Fetching errors waits for the GPU on the web, so only if something was uploaded.
        if self.cache.count_made() != before {
            self.shared.check_error("uploading the scene")?;
        }
        Ok(uploaded)
    }

    /// Draws the picture, or a debug view, and waits for it.
    pub fn render(
        &mut self,
        scene: &GpuScene,
        frame: &Frame,
        view: Option<ViewSpec>,
    ) -> Result<RenderedFrame, GlError> {
        self.render_at(scene, frame, view, ColorPrecision::Full)
    }

    pub(crate) fn render_at(
        &mut self,
        scene: &GpuScene,
        frame: &Frame,
        view: Option<ViewSpec>,
        precision: ColorPrecision,
    ) -> Result<RenderedFrame, GlError> {
        let shared = self.shared.clone();
        let gl = &shared.gl;
        let mut notes = Vec::new();
        let target = self.target_for(scene, frame, frame.height as i32, precision, 1, &mut notes)?;
        // Before counting: the counters are those of the picture.
        let shadows = self.shadow_maps(scene, frame, &mut notes)?;
        let queries = StatisticsQueries::begin(gl, &shared.info)?;
        let draw_calls = {
            let _group = DebugGroup::new(gl, "scene");
            self.draw_scene(scene, frame, view, shadows.as_deref(), &target, 0)?
        };
        let statistics = queries.end(gl, draw_calls);
        target.resolve(gl);
        gl.finish();
        shared.check_error("drawing the scene")?;
        let look = DisplaySettings::new(view, frame);
        Ok(RenderedFrame { shared, target, look, statistics: statistics.read(), notes })
    }

    /// An error if the driver cannot draw a picture of this size.
    fn check_size(&self, size: [u32; 2]) -> Result<(), GlError> {
        let most = self.shared.info.max_size;
        if size.iter().all(|side| *side <= most) {
            return Ok(());
        }
        Err(GlError::new(format!(
            "a picture of {} x {} pixels is too large for this driver, which draws at most {most} pixels along a side",
            size[0], size[1]
        ))
        .with_remedy(Remedy::SmallerPicture))
    }

    /// Targets for `rows` rows of the frame, one of `panes` that are drawn in turn.
    fn target_for(
        &mut self,
        scene: &GpuScene,
        frame: &Frame,
        rows: i32,
        precision: ColorPrecision,
        panes: usize,
        notes: &mut Vec<String>,
    ) -> Result<Rc<Target>, GlError> {
        if frame.surroundings.is_some() {
            notes.extend(scene.notes.iter().cloned());
        }
        self.check_size([frame.width, frame.height])?;
        let info = &self.shared.info;
        let samples = frame.samples.min(info.max_samples).max(1);
        if samples < frame.samples {
            notes.push(format!("{samples} samples per pixel instead of {}: the driver has no more", frame.samples));
        }
        let sampling = shared::choose_sampling(info, scene.triangle_count, frame, samples as i32);
        let size = [frame.width as i32, rows];
        if let Some(target) = self.targets.find(size, sampling, precision) {
            return Ok(target);
        }
        self.targets.make_room(panes);
        let shared = &self.shared;
        let make = |sampling| Target::new(&shared.gl, shared.info.dialect, size, sampling, precision);
        let target = Rc::new(match make(sampling) {
            // WebGL does not report the number of samples of each format.
            Err(_) if shared.info.dialect == Dialect::Es300 && sampling != Sampling::Multi(1) => {
                shared.forget_errors();
                let target = make(Sampling::Multi(1))?;
                notes.push(format!("1 sample per pixel instead of {samples}: the driver has no more"));
                target
            }
            made => made?,
        });
        shared.check_error("making the picture's memory")?;
        self.targets.keep(target.clone());
        Ok(target)
    }

    /// Fills the light table, and binds it.
    fn fill_light_table(&mut self, frame: &Frame, shadows: Option<&ShadowMaps>) {
        let gl = &self.shared.gl;
        gl.active_texture(glow::TEXTURE0 + texture_unit("light_table"));
        self.light_table.fill(gl, &frame.lights, shadows.map(|shadows| &shadows.plan));
    }

    /// A pass over the objects with the lights of the table, which draws linear colours.
    fn pass<'a>(
        &'a self,
        scene: &'a GpuScene,
        frame: &'a Frame,
        view: Option<ViewSpec>,
        shadows: bool,
    ) -> Result<Pass<'a>, GlError> {
        Ok(Pass {
            shared: &self.shared,
            scene,
            frame,
            view,
            white: self.white.handle(),
            lights: &self.light_table,
            around: BoundEnvironment::bound(&self.shared, scene, frame)?,
            shadows,
            display: None,
            top_row_first: false,
            prepared: HashMap::new(),
        })
    }

    /// Draws the rows from `first_row` (from the picture's bottom) that `target` has room for, with [`Self::shadow_maps`] of the
    /// frame.
    fn draw_scene(
        &mut self,
        scene: &GpuScene,
        frame: &Frame,
        view: Option<ViewSpec>,
        shadows: Option<&ShadowMaps>,
        target: &Target,
        first_row: i32,
    ) -> Result<u32, GlError> {
        let shared = self.shared.clone();
        let gl = &shared.gl;
        if let Some(shadows) = shadows {
            shadows.bind(gl);
        }
        self.fill_light_table(frame, shadows);
        target.begin(gl, first_row, frame.height as i32);
        gl.enable(glow::DEPTH_TEST);
        gl.depth_func(glow::LESS);
        gl.disable(glow::BLEND);
        let mut pass = self.pass(scene, frame, view, shadows.is_some())?;
        let opaque = opaque_draws(scene);
        let transparent = sorted_transparent(scene, frame);
        for draw in opaque.iter().chain(&transparent) {
            pass.prepare(draw)?;
        }
        let mut draw_calls = 0;
        for draw in &opaque {
            pass.draw(draw)?;
            draw_calls += 1;
        }
        // The sky is drawn before transparent triangles, which are blended over it, and after opaque ones, so that hidden
        // pixels are not looked up.
        if let Some(around) = pass.around.as_ref().filter(|around| around.is_visible() && !pass.is_view()) {
            around.draw_sky(&shared, frame, target)?;
            draw_calls += 1;
        }
        if !transparent.is_empty() {
            let _group = DebugGroup::new(gl, "transparent, back to front");
            // A debug view shows the nearest surface as if it were opaque.
            if !pass.is_view() {
                gl.enable(glow::BLEND);
                gl.blend_func(glow::ONE, glow::ONE_MINUS_SRC_ALPHA);
                gl.depth_mask(false);
            }
            for draw in &transparent {
                pass.draw(draw)?;
                draw_calls += 1;
            }
            gl.disable(glow::BLEND);
            gl.depth_mask(true);
        }
        gl.disable(glow::CULL_FACE);
        gl.front_face(glow::CCW);
        gl.bind_vertex_array(None);
        Ok(draw_calls)
    }
}

/// Opaque triangles of all objects.
fn opaque_draws(scene: &GpuScene) -> Vec<Draw<'_>> {
    let of_object = |object| move |run: &Run| Draw { object, run: run.clone() };
    scene.objects.iter().flat_map(|object| object.opaque.iter().map(of_object(object))).collect()
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
