//! The state that all parts of the renderer share: the context, the driver's limits, the linked programs, and the
//! targets that are kept between frames.

use crate::glsl::{ATTRIBUTES, MaterialFunctions, OutputKey, Reflectance, SceneKey, SpecialProgram};
use gonio_gl::objects::VertexArray;
use gonio_gl::program::Program;
use gonio_gl::target::{ColorPrecision, Sampling, Target};
use gonio_gl::{DriverInfo, Gl, GlError};
use gonio_scene::Frame;
use std::cell::RefCell;
use std::collections::HashMap;
use std::rc::Rc;

/// The context, the driver's limits and the linked programs: shared with every finished frame.
pub struct Shared {
    pub gl: Gl,
    pub info: DriverInfo,
    pub scene_programs: RefCell<HashMap<SceneKey, Rc<Program>>>,
    /// The BRDFs of materials that are a part of programs.
    pub functions: RefCell<MaterialFunctions>,
    pub output_programs: RefCell<HashMap<OutputKey, Rc<Program>>>,
    pub special_programs: RefCell<HashMap<SpecialProgram, Rc<Program>>>,
    pub sky: RefCell<Option<Rc<Program>>>,
    pub difference: RefCell<Option<Rc<Program>>>,
    /// Core profiles draw nothing without a vertex array, even where no attribute is read.
    pub no_attributes: VertexArray,
}

/// Most programs of materials' own BRDFs that are kept.
const MOST_OWN_PROGRAMS: usize = 64;

impl Shared {
    pub fn scene_program(&self, key: SceneKey) -> Result<Rc<Program>, GlError> {
        if let Some(program) = self.scene_programs.borrow().get(&key) {
            return Ok(program.clone());
        }
        let functions = self.functions.borrow();
        let function = if let Reflectance::Material(id) = key.reflectance { functions.text(id) } else { "" };
        let [vertex, fragment] = key.sources_with(self.info.dialect, function);
        let program = Rc::new(Program::new(&self.gl, &key.name(), &vertex, &fragment, &ATTRIBUTES)?);
        let mut known = self.scene_programs.borrow_mut();
        // Each value of a parameter makes another program: those of values that were tried before are not kept for ever.
        if key.has_own_brdf() && known.keys().filter(|key| key.has_own_brdf()).count() >= MOST_OWN_PROGRAMS {
            known.retain(|key, _| !key.has_own_brdf());
        }
        known.insert(key, program.clone());
        Ok(program)
    }

    pub fn output_program(&self, key: OutputKey) -> Result<Rc<Program>, GlError> {
        if let Some(program) = self.output_programs.borrow().get(&key) {
            return Ok(program.clone());
        }
        let [vertex, fragment] = key.sources(self.info.dialect);
        let program = Rc::new(Program::new(&self.gl, &format!("output {key:?}"), &vertex, &fragment, &[])?);
        self.output_programs.borrow_mut().insert(key, program.clone());
        Ok(program)
    }

    /// Clears all error flags of OpenGL.
    pub fn forget_errors(&self) {
        (0..8).take_while(|_| self.gl.get_error() != glow::NO_ERROR).for_each(drop);
    }

    /// Turns OpenGL's error flag into an error; `doing` completes "... while".
    pub fn check_error(&self, doing: &str) -> Result<(), GlError> {
        match self.gl.get_error() {
            glow::NO_ERROR => Ok(()),
            glow::OUT_OF_MEMORY => Err(GlError::new(format!(
                "the driver ran out of memory while {doing}; a smaller picture or model may work"
            ))),
            code => Err(GlError::new(format!("OpenGL reported error {code:#06x} while {doing}"))),
        }
    }
}

/// Most panes of a window that are drawn in turn.
pub(super) const PANES: usize = 4;

/// Targets, the one that was used last in front, each with the number of its last use.
#[derive(Default)]
pub(crate) struct Targets {
    kept: Vec<(Rc<Target>, u64)>,
    uses: u64,
}

impl Targets {
    /// Finds one that fits and that no finished frame uses: those must not be overwritten.
    pub fn find(&mut self, size: [i32; 2], sampling: Sampling, precision: ColorPrecision) -> Option<Rc<Target>> {
        let fits = |target: &Rc<Target>| {
            target.size == size
                && target.sampling == sampling
                && target.precision == precision
                && Rc::strong_count(target) == 1
        };
        let index = self.kept.iter().position(|(target, _)| fits(target))?;
        let (target, _) = self.kept.remove(index);
        self.keep(target.clone());
        Some(target)
    }

    /// Makes room for another: each of `most` panes that are drawn in turn has used its target recently; a target that was not
    /// used for longer has a size that no pane has any more.
    pub fn make_room(&mut self, most: usize) {
        let uses = self.uses;
        self.kept.retain(|(_, last)| last + most as u64 > uses + 1);
    }

    /// Keeps one that was made.
    pub fn keep(&mut self, target: Rc<Target>) {
        self.uses += 1;
        self.kept.insert(0, (target, self.uses));
    }

    /// The target that was used last.
    #[cfg(any(test, feature = "bench"))]
    pub fn last(&self) -> Option<&Rc<Target>> {
        self.kept.first().map(|(target, _)| target)
    }

    /// The number of targets.
    #[cfg(test)]
    pub fn count(&self) -> usize {
        self.kept.len()
    }
}

/// Most pixels of a picture per triangle for which triangles count as fine: up to here a grid of samples was faster on llvmpipe
/// than multisampling.
const PIXELS_PER_TRIANGLE: usize = 3;

/// Chooses how the samples of a frame are drawn.
///
/// If triangles are not much larger than pixels, nearly every sample is shaded anyway, and multisampling costs software drivers
/// more than shading: an averaged finer picture is the same in less time.
pub(super) fn choose_sampling(info: &DriverInfo, triangles: usize, frame: &Frame, samples: i32) -> Sampling {
    let pixels = frame.width as usize * frame.height as usize;
    let is_fine = triangles.saturating_mul(PIXELS_PER_TRIANGLE) >= pixels;
    let fits = |side: i32| u64::from(frame.width.max(frame.height)) * side as u64 <= u64::from(info.max_size);
    match (2..=4).find(|side| side * side == samples) {
        Some(side) if is_fine && info.is_software() && fits(side) => Sampling::Grid(side),
        _ => Sampling::Multi(samples),
    }
}

#[cfg(test)]
mod tests {
    use crate::Renderer;
    use gonio_scene::files::Disk;
    use gonio_scene::{Picture, Scene};
    use std::path::Path;

    /// Suzanne's 968 triangles on 40 x 30 pixels: fine ones; `finer` times as wide and high. `more` ends the scene file.
    fn scene(samples: u32, finer: u32, more: &str) -> Scene {
        let text = format!(
            "[picture]\nwidth = {}\nheight = {}\nsamples = {samples}\n[[object]]\nmodel = \"builtin:suzanne\"\n{more}",
            40 * finer,
            30 * finer
        );
        let scene = gonio_scene::toml_file::read(&text).unwrap_or_else(|error| panic!("{error}"));
        gonio_scene::load::load(scene, Path::new(""), &Disk).unwrap_or_else(|error| panic!("{error}"))
    }

    fn linear(renderer: &mut Renderer, scene: &Scene) -> Picture {
        let uploaded = renderer.upload(scene).unwrap_or_else(|error| panic!("{error}"));
        let drawn = renderer.render(&uploaded, &scene.frame(0.0), None);
        drawn.and_then(|drawn| drawn.linear()).unwrap_or_else(|error| panic!("{error}"))
    }

    /// Four samples of fine triangles are the four pixels of a picture twice as large, in OpenGL and in OpenGL ES.
    #[test]
    fn fine_triangles_are_a_finer_picture_averaged() {
        for es in [false, true] {
            let (differs, covered) = difference_from_finer(es, "");
            // The background is a gradient with a step per row, so they may differ by half a step.
            assert!(differs < 2e-3, "{differs}");
            assert!(covered > 200, "only {covered} pixels cover an edge");
        }
    }

    /// The same for a sky whose texels are smaller than pixels: the level of a whole pixel would blur it twice.
    #[test]
    fn a_sky_behind_fine_triangles_is_a_finer_sky_averaged() {
        let (differs, covered) = difference_from_finer(false, "[environment]\nimage = \"debug\"\nlight = false\n");
        // The tolerance of the picture above; with the level of a whole pixel edges differ by much more.
        assert!(differs < 2e-3, "{differs}");
        assert!(covered > 200, "only {covered} pixels cover an edge");
    }

    /// The largest difference of a picture of four samples from the mean of four pixels of a finer one, and the number
    /// of pixels whose four differ.
    fn difference_from_finer(es: bool, more: &str) -> (f32, usize) {
        let context = crate::tests::context(es);
        let mut renderer = Renderer::new(context.gl().clone()).unwrap_or_else(|error| panic!("{error}"));
        assert!(renderer.info().is_software(), "{}", renderer.info().renderer);
        let finer = linear(&mut renderer, &scene(1, 2, more));
        let picture = linear(&mut renderer, &scene(4, 1, more));
        assert_eq!((picture.width, picture.height), (40, 30));
        let (mut differs, mut covered) = (0.0_f32, 0);
        for (i, pixel) in picture.pixels.iter().enumerate() {
            let (x, y) = (2 * (i % 40), 2 * (i / 40));
            let four = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(dx, dy)| finer.pixels[(y + dy) * 80 + x + dx]);
            for channel in 0..3 {
                let mean = four.iter().map(|texel| texel[channel]).sum::<f32>() / 4.0;
                differs = differs.max((mean - pixel[channel]).abs());
            }
            covered += usize::from(four.iter().any(|texel| *texel != four[0]));
        }
        (differs, covered)
    }
}
