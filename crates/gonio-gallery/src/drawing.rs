//! Drawing exhibits, by OpenGL or by the CPU reference.

use crate::GalleryError;
use crate::exhibit::Exhibit;
use crate::rgb_image::RgbImage;
use gonio_gl::GlError;
use gonio_image::EncodedPicture;
use gonio_image::encode::png::ColorTag;
use gonio_light::color::ColorEncoding;
use gonio_reference::ReferenceScene;
use gonio_render::{GpuScene, Renderer};
use gonio_scene::environment::LoadedEnvironment;
use gonio_scene::files::FileSource;
use gonio_scene::{DisplayMap, Frame, Scene, SceneFile, ViewSpec, load};
use serde::Serialize;
use std::path::Path;
use std::sync::Arc;

/// Size of a picture drawn by OpenGL, as a multiple of its size on the sheet.
pub const OPEN_GL_SCALE: f64 = 1.75;
/// The same for the CPU, which takes longer.
pub const CPU_SCALE: f64 = 1.0;
/// Width in pixels of the pictures that are compared.
const COMPARED_WIDTH: u32 = 160;

/// A picture of the gallery, with the numbers that belong to it.
pub struct DrawnExhibit<'a> {
    /// Index of its section.
    pub section: usize,
    /// The exhibit.
    pub exhibit: &'a Exhibit,
    /// Width of the full picture in pixels.
    pub width: u32,
    /// Height of the full picture in pixels.
    pub height: u32,
    /// The picture at its size on the sheet.
    pub small: RgbImage,
    /// Vertices, fragments and draw calls.
    pub counts: DrawCounts,
    /// Milliseconds from the first draw call to the picture in memory, or for the conversion of an environment, or for a
    /// station.
    pub ms: f64,
    /// Difference between GPU and CPU; `None` if the CPU drew the picture, or if nothing was drawn.
    pub difference: Option<BackendDifference>,
    /// The command that makes the picture again.
    pub command: String,
}

impl DrawnExhibit<'_> {
    /// Returns the small line below the caption.
    pub fn remark(&self) -> String {
        if !self.exhibit.counts_as_remark {
            return self.exhibit.remark.clone();
        }
        let vertices = self.counts.vertices.map_or_else(|| "?".to_owned(), grouped);
        let fragments = self.counts.fragments.map_or_else(|| "?".to_owned(), |n| grouped((n + 500) / 1000) + " k");
        format!("{vertices} vertices, {fragments} fragments")
    }
}

/// Formats a number in groups of three digits: `12 345 678`.
pub fn grouped(n: u64) -> String {
    let digits = n.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(' ');
        }
        text.push(digit);
    }
    text
}

/// Counters of one picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct DrawCounts {
    /// Vertices lit or transformed.
    pub vertices: Option<u64>,
    /// Fragments lit.
    pub fragments: Option<u64>,
    /// Draw calls of OpenGL.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub draw_calls: Option<u32>,
}

/// The difference of two pictures of 8 bits; a pixel counts with its most different channel.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct BackendDifference {
    /// Largest difference, in steps of 1/255.
    pub max: u8,
    /// Mean over all channels, in steps of 1/255.
    pub mean: f64,
    /// Share of the pixels that differ by at most one step.
    pub within_one: f64,
}

impl BackendDifference {
    /// Compares two pictures of the same size; alpha is ignored.
    pub fn between(a: &EncodedPicture<u8>, b: &EncodedPicture<u8>) -> Self {
        let (mut max, mut sum, mut within) = (0, 0u64, 0usize);
        let pixels = || a.rgba.chunks_exact(4).zip(b.rgba.chunks_exact(4));
        for (a, b) in pixels() {
            let steps = [0, 1, 2].map(|i| a[i].abs_diff(b[i]));
            let worst = steps.into_iter().max().unwrap_or(0);
            sum += steps.iter().map(|&s| u64::from(s)).sum::<u64>();
            max = max.max(worst);
            within += usize::from(worst <= 1);
        }
        let count = pixels().count().max(1) as f64;
        BackendDifference { max, mean: sum as f64 / (3.0 * count), within_one: within as f64 / count }
    }
}

/// The environments loaded so far. Preparing one for glossy surfaces takes a second, so all pictures share it.
#[derive(Default)]
pub struct EnvironmentCache(Vec<Arc<LoadedEnvironment>>);

impl EnvironmentCache {
    /// Loads a scene of built-in files, which `files` has, and shares its environment with earlier scenes that have the same.
    ///
    /// # Errors
    ///
    /// A scene that names other files, or that is not valid.
    pub fn load(&mut self, scene: SceneFile, files: &dyn FileSource) -> Result<Scene, GalleryError> {
        let mut loaded = load::load(scene, Path::new(""), files)?;
        if let Some(own) = &mut loaded.environment {
            let same = |e: &&Arc<LoadedEnvironment>| {
                e.name == own.name && e.mips.full() == own.mips.full() && e.background == own.background
            };
            match self.0.iter().find(same) {
                Some(known) => *own = known.clone(),
                None => self.0.push(own.clone()),
            }
        }
        Ok(loaded)
    }
}

/// A finished picture.
pub struct DrawnPicture {
    /// The picture as displayed.
    pub picture: EncodedPicture<u8>,
    /// Vertices, fragments and draw calls.
    pub counts: DrawCounts,
    /// Notes about requests that the driver could not meet, for example fewer samples.
    pub notes: Vec<String>,
}

/// A scene ready to be drawn.
pub enum PreparedScene<'a> {
    /// Drawn by OpenGL.
    OpenGl {
        /// The renderer that the scene was uploaded with.
        renderer: &'a mut Renderer,
        /// The scene on the GPU.
        scene: Box<GpuScene>,
    },
    /// Drawn by the CPU reference.
    Cpu(Box<ReferenceScene>),
}

impl<'a> PreparedScene<'a> {
    /// Uploads a scene to the GPU.
    ///
    /// # Errors
    ///
    /// An error of OpenGL.
    pub fn on_gpu(renderer: &'a mut Renderer, scene: &Scene) -> Result<Self, GlError> {
        let scene = Box::new(renderer.upload(scene)?);
        Ok(PreparedScene::OpenGl { renderer, scene })
    }

    /// Builds the acceleration structure of the CPU reference.
    pub fn on_cpu(scene: &Scene) -> Self {
        PreparedScene::Cpu(Box::new(ReferenceScene::new(scene)))
    }

    /// Draws the picture, or a debug view, in 8 bits a channel.
    ///
    /// # Errors
    ///
    /// An error of OpenGL.
    pub fn draw(&mut self, frame: &Frame, view: Option<ViewSpec>) -> Result<DrawnPicture, GlError> {
        match self {
            PreparedScene::OpenGl { renderer, scene } => {
                let drawn = renderer.render8(scene, frame, view)?;
                let statistics = &drawn.statistics;
                let counts = DrawCounts {
                    vertices: statistics.vertices,
                    fragments: statistics.fragments,
                    draw_calls: Some(statistics.draw_calls),
                };
                Ok(DrawnPicture { picture: drawn.picture, counts, notes: drawn.notes })
            }
            PreparedScene::Cpu(scene) => {
                let drawn = scene.render(frame, view, &|_| ());
                let counts =
                    DrawCounts { vertices: Some(drawn.vertices), fragments: Some(drawn.fragments), draw_calls: None };
                let picture = drawn.picture.encode8(&DisplayMap::for_view(view, frame));
                Ok(DrawnPicture { picture, counts, notes: Vec::new() })
            }
        }
    }

    /// Compares the GPU with the CPU: both draw `loaded` small, with one sample. Outlines that fall on other sides of a
    /// pixel's centre are part of the difference. `None` if the CPU draws.
    ///
    /// # Errors
    ///
    /// An error of OpenGL.
    pub fn compare(
        &mut self,
        loaded: &Scene,
        frame: &Frame,
        view: Option<ViewSpec>,
    ) -> Result<Option<BackendDifference>, GlError> {
        if let PreparedScene::Cpu(_) = self {
            return Ok(None);
        }
        let width = COMPARED_WIDTH.min(frame.width);
        let height = (frame.height * width / frame.width.max(1)).max(1);
        let frame = Frame { width, height, samples: 1, ..frame.clone() };
        let by_gpu = self.draw(&frame, view)?.picture;
        let by_cpu = PreparedScene::on_cpu(loaded).draw(&frame, view)?.picture;
        Ok(Some(BackendDifference::between(&by_gpu, &by_cpu)))
    }
}

/// Returns the colour tag of a view's PNG.
pub fn color_tag(view: Option<ViewSpec>, frame: &Frame) -> ColorTag {
    match DisplayMap::for_view(view, frame) {
        DisplayMap::Light(transform) if transform.encoding == ColorEncoding::Srgb => ColorTag::Srgb,
        _ => ColorTag::Untagged,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::BaseScene;
    use gonio_scene::files::BuiltinOnly;
    use gonio_scene::scene_file::EnvironmentSpec;

    #[test]
    fn differences_are_counted_in_steps() {
        let picture = |rgba: [u8; 8]| EncodedPicture { width: 2, height: 1, rgba: rgba.to_vec() };
        let a = picture([10, 20, 30, 255, 0, 0, 0, 255]);
        let b = picture([10, 21, 30, 0, 0, 0, 5, 255]);
        let d = BackendDifference::between(&a, &b);
        assert_eq!((d.max, d.mean, d.within_one), (5, 1.0, 0.5));
        assert_eq!(BackendDifference::between(&a, &a), BackendDifference { max: 0, mean: 0.0, within_one: 1.0 });
    }

    #[test]
    fn the_same_environment_is_kept_once() {
        let mut environments = EnvironmentCache::default();
        let mut load = |image: &str, size| {
            let environment = EnvironmentSpec { image: image.into(), size: Some(size), ..EnvironmentSpec::default() };
            let scene = BaseScene::RoomSphere.with(|s| s.environment = Some(environment));
            let loaded = scene.and_then(|s| environments.load(s, &BuiltinOnly)).unwrap_or_else(|e| panic!("{e:?}"));
            loaded.environment.unwrap_or_else(|| panic!("{image} was lost"))
        };
        let first = load("room", 16);
        assert!(Arc::ptr_eq(&first, &load("room", 16)));
        // The same name at another size, and another name.
        assert!(!Arc::ptr_eq(&first, &load("room", 8)) && !Arc::ptr_eq(&first, &load("sky", 16)));
    }

    #[test]
    fn large_numbers_are_grouped() {
        assert_eq!([0, 999, 1000, 1234567].map(grouped), ["0", "999", "1 000", "1 234 567"]);
    }
}
