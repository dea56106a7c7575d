//! A picture of 8 bits drawn band by band.
//!
//! The float samples of a whole picture are many times the picture itself (at 1024 x 768 and 4 samples
//! 38 MB compared with 3), and a process that draws one picture spends as much time on allocating that memory as on drawing.
//! The memory of a band is small, stays in the cache, and is reused for the next band. But vertices are processed once per
//! band, so large models are drawn at once.

use super::Renderer;
use super::output::{Band, DisplaySettings};
use crate::scene_on_gpu::GpuScene;
use gonio_gl::GlError;
use gonio_gl::objects::DebugGroup;
use gonio_gl::objects::{GpuStatistics, StatisticsQueries};
use gonio_gl::target::{ColorPrecision, OutputTarget};
use gonio_scene::picture::EncodedPicture;
use gonio_scene::{Frame, ViewSpec};

/// A band's samples take about as much memory as a core's share of a cache.
const BAND_BYTES: usize = 4 << 20;
/// Software drivers draw in tiles of 64 x 64 pixels.
const TILE: i32 = 64;
/// Models up to this size are cheap to process several times.
const MOST_TRIANGLES: usize = 20_000;

/// A finished picture of 8 bits a channel.
pub struct RenderedPicture {
    /// The displayed picture, encoded by the GPU.
    pub picture: EncodedPicture<u8>,
    /// The counters of the GPU; each vertex counts once, however many bands process it.
    pub statistics: GpuStatistics,
    /// Limits of the driver that changed the picture, for example fewer samples.
    pub notes: Vec<String>,
}

impl Renderer {
    /// Draws the picture, or a debug view, and reads it back: the same as [`Renderer::render`] and
    /// [`super::RenderedFrame::encoded8`], with less memory and time. Edges may differ by the driver's snapping of corners,
    /// about 1/256 of a pixel: corners of a band are rounded at different magnitudes.
    pub fn render8(
        &mut self,
        scene: &GpuScene,
        frame: &Frame,
        view: Option<ViewSpec>,
    ) -> Result<RenderedPicture, GlError> {
        let shared = self.shared.clone();
        let gl = &shared.gl;
        let mut notes = Vec::new();
        let (width, height) = (frame.width as i32, frame.height as i32);
        let band_rows = rows_of_a_band(scene.triangle_count, frame);
        let target = self.target_for(scene, frame, band_rows, ColorPrecision::Half, 1, &mut notes)?;
        let output = OutputTarget::new(gl, [width, height], false)?;
        let look = DisplaySettings::new(view, frame);
        let mut statistics = GpuStatistics::default();
        let shadows = self.shadow_maps(scene, frame, &mut notes)?;
        for first_row in (0..height).step_by(band_rows as usize) {
            let band = Band { picture_height: height, first_row, rows: band_rows.min(height - first_row) };
            let queries = StatisticsQueries::begin(gl, &shared.info)?;
            let draw_calls = {
                let _group = DebugGroup::new(gl, "scene");
                self.draw_scene(scene, frame, view, shadows.as_deref(), &target, first_row)?
            };
            let counted = queries.end(gl, draw_calls).read();
            if first_row == 0 {
                statistics = counted;
            } else if let (Some(sum), Some(more)) = (&mut statistics.fragments, counted.fragments) {
                *sum += more;
            }
            target.resolve(gl);
            shared.output_into(&output, &target, band, &look, look.encoded())?;
        }
        let rgba = output.read8(gl);
        shared.check_error("reading the picture")?;
        let picture = EncodedPicture { width: frame.width, height: frame.height, rgba };
        Ok(RenderedPicture { picture, statistics, notes })
    }
}

/// The rows of a band: at least one, and all if the model is large.
fn rows_of_a_band(triangles: usize, frame: &Frame) -> i32 {
    let height = (frame.height as i32).max(1);
    // Half floats of four channels, and depth.
    let bytes_a_row = frame.width.max(1) as usize * frame.samples.max(1) as usize * (8 + 4);
    let rows = (BAND_BYTES / bytes_a_row) as i32 / TILE * TILE;
    if triangles > MOST_TRIANGLES { height } else { rows.max(TILE).min(height) }
}

#[cfg(test)]
mod tests {
    use crate::Renderer;
    use gonio_gl::target::ColorPrecision;
    use gonio_scene::files::Disk;
    use std::path::Path;

    #[test]
    fn bands_make_the_same_picture_as_the_whole() {
        // Several bands, the last one smaller.
        let text = "[picture]\nwidth = 700\nheight = 621\n[[object]]\nmodel = \"builtin:still-life\"\n";
        let scene = gonio_scene::toml_file::read(text).unwrap_or_else(|error| panic!("{error}"));
        let scene = gonio_scene::load::load(scene, Path::new(""), &Disk).unwrap_or_else(|error| panic!("{error}"));
        let frame = scene.frame(0.0);
        let context = crate::tests::context(false);
        let mut renderer = Renderer::new(context.gl().clone()).unwrap_or_else(|error| panic!("{error}"));
        let uploaded = renderer.upload(&scene).unwrap_or_else(|error| panic!("{error}"));
        let rows = super::rows_of_a_band(uploaded.triangle_count, &frame);
        assert!(rows < 621 && 621 % rows != 0, "bands of {rows} rows would test little");
        let whole =
            renderer.render_at(&uploaded, &frame, None, ColorPrecision::Half).unwrap_or_else(|error| panic!("{error}"));
        let banded = renderer.render8(&uploaded, &frame, None).unwrap_or_else(|error| panic!("{error}"));
        let whole8 = whole.encoded8().unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(whole8.rgba.len(), banded.picture.rgba.len());
        // Set on llvmpipe, where 0.01 % differ, by up to 3 steps: edges only.
        let differing = whole8.rgba.iter().zip(&banded.picture.rgba).filter(|(a, b)| a != b).count();
        let worst = whole8.rgba.iter().zip(&banded.picture.rgba).map(|(a, b)| a.abs_diff(*b)).max();
        assert!(differing * 1000 <= whole8.rgba.len(), "{differing} of {} values differ", whole8.rgba.len());
        assert!(worst <= Some(16), "by up to {worst:?} steps");
        assert_eq!(banded.statistics.vertices, whole.statistics.vertices);
        assert_eq!(banded.statistics.draw_calls, whole.statistics.draw_calls);
    }
}
