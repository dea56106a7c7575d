//! From rays to pictures: blocks of pixels on all threads, samples averaged in linear premultiplied values.

use crate::environment::Environment;
use crate::fragment::{Fragment, Hit};
use crate::intersect::{EyeSpace, RaySpace, cross};
use crate::sample_positions;
use crate::samples::sample_width;
use crate::shade::{CornerCache, Shader};
use crate::shadow::Shadows;
use crate::visibility::{Block, Layer, NOTHING, Visible};
use crate::{ReferenceScene, Rendered};
use glam::{DVec2, DVec3, DVec4};
use gonio_light::Quantity;
use gonio_light::quantity::Encoding;
use gonio_scene::{Frame, Picture, ViewSpec};
use rayon::prelude::*;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};

/// The most transparent surfaces that are composited: surfaces behind this many are ignored.
pub const MAX_LAYERS: usize = 64;

/// A surface with less opacity than this is a hole: nothing is drawn there, in debug views neither.
pub const HOLE: f64 = gonio_scene::scene::HOLE_OPACITY;

/// Edge length of the blocks of pixels whose rays are traced together.
const BLOCK: u32 = 8;

/// The data that all pixels of a frame share.
pub(crate) struct FrameContext<'a> {
    pub reference: &'a ReferenceScene,
    pub frame: &'a Frame,
    pub shader: Shader<'a>,
}

/// A surface that a ray meets.
pub(crate) struct Surfaced<'a> {
    /// Index into the triangles.
    pub id: u32,
    pub fragment: Fragment<'a>,
    /// The opacity, in `[HOLE, 1]`.
    pub opacity: f64,
}

/// The data that a thread reuses for each block.
#[derive(Default)]
struct Workspace {
    visible: Visible,
    corners: CornerCache,
}

impl<'a> FrameContext<'a> {
    /// `pixel_angle_rad` is the angle that a pixel in the middle of the picture covers.
    pub fn new(reference: &'a ReferenceScene, frame: &'a Frame, pixel_angle_rad: f64) -> Self {
        let sample_angle_rad = pixel_angle_rad * sample_width(frame.samples);
        let environment = Environment::new(&reference.scene, frame, sample_angle_rad);
        let geometry = reference.world();
        let shadows = frame.shadows.then(|| Shadows::new(&reference.scene, geometry, environment.is_some()));
        FrameContext { reference, frame, shader: Shader { geometry, frame, environment, shadows } }
    }

    /// The context of a picture by the frame's camera.
    pub fn of_camera(reference: &'a ReferenceScene, frame: &'a Frame) -> Self {
        let pixel_angle_rad = 2.0 * (0.5 * frame.camera.fov_y_rad).tan() / f64::from(frame.height);
        FrameContext::new(reference, frame, pixel_angle_rad)
    }

    /// The surfaces that a ray of the camera meets, from front to back, holes left out, down to the first opaque one.
    pub fn surfaces<'v>(
        &'v self,
        eye: &'v EyeSpace,
        visible: &'v Visible,
        ray: usize,
        layers: &'v [Layer],
    ) -> impl Iterator<Item = Surfaced<'v>> + 'v {
        let opaque = visible.opaque[ray];
        let ids = layers.iter().map(|l| l.triangle).chain((opaque != NOTHING).then_some(opaque));
        self.surfaces_of(ids, visible.rays[ray], eye)
    }

    /// Surfaces along a ray, holes left out: those of triangles that it meets.
    pub fn surfaces_of<'v>(
        &'v self,
        ids: impl Iterator<Item = u32> + 'v,
        ray: DVec2,
        space: &'v dyn RaySpace,
    ) -> impl Iterator<Item = Surfaced<'v>> + 'v {
        ids.filter_map(move |id| {
            let geometry = self.reference.world();
            let triangle = &geometry.triangles[id as usize];
            let crossing = cross(&space.corners(triangle.vertices), ray)?;
            let fragment = Fragment::new(
                &self.reference.scene,
                geometry,
                self.frame.two_sided,
                self.frame.texture_filter,
                Hit { triangle, crossing, ray, space },
            );
            let opacity = if triangle.transparent { fragment.opacity().min(1.0) } else { 1.0 };
            // Written so that an opacity that is not a number is a hole.
            (opacity >= HOLE).then_some(Surfaced { id, fragment, opacity })
        })
        .take(MAX_LAYERS)
    }

    /// The radiance behind all objects, premultiplied RGBA: the environment in a unit direction in the world, or the
    /// background at a height in the picture, 0 at its top and 1 at its bottom.
    pub fn behind(&self, direction: impl FnOnce() -> DVec3, height: f64) -> DVec4 {
        let seen = self.shader.environment.as_ref().and_then(|e| e.background(direction));
        seen.map_or_else(|| DVec4::from(self.frame.background.at(height)), |radiance| radiance.extend(1.0))
    }

    /// The picture's premultiplied linear RGBA along one ray, and the number of fragments that were shaded for it.
    /// `behind` is called only where it is visible.
    pub fn radiance<'v>(
        &'v self,
        surfaces: impl Iterator<Item = Surfaced<'v>>,
        behind: impl FnOnce() -> DVec4,
        corners: &mut CornerCache,
    ) -> (DVec4, u64) {
        let mut sum = DVec4::ZERO;
        let mut shaded = 0;
        for Surfaced { id, fragment, opacity } in surfaces {
            let light = self.shader.radiance(&fragment, id, &fragment.surface(), corners);
            sum += (1.0 - sum.w) * (opacity * light).extend(opacity);
            shaded += 1;
            if opacity >= 1.0 {
                break;
            }
        }
        let rest = 1.0 - sum.w;
        (if rest > 0.0 { sum + rest * behind() } else { sum }, shaded)
    }

    /// The values of some views along one ray.
    fn values<'v>(
        &'v self,
        surfaces: impl Iterator<Item = Surfaced<'v>> + 'v,
        views: &[ViewSpec],
        behind: impl FnOnce() -> DVec4,
        corners: &mut CornerCache,
        sums: &mut [DVec4],
    ) -> u64 {
        let mut surfaces = surfaces.peekable();
        let mut shaded = u64::from(surfaces.peek().is_some());
        // The nearest surface; the picture itself comes last, as it goes on to the surfaces behind.
        if views.iter().any(|v| v.quantity != Quantity::Total) {
            let nearest = surfaces.peek().map(|s| (s, s.fragment.surface()));
            for (sum, &view) in sums.iter_mut().zip(views) {
                *sum += match (&nearest, view.quantity.encoding()) {
                    (_, Encoding::Color) if view.quantity == Quantity::Total => DVec4::ZERO,
                    (Some((s, surface)), _) => {
                        self.shader.quantity(&s.fragment, s.id, surface, view, corners).extend(1.0)
                    }
                    (None, Encoding::Color) => DVec3::ZERO.extend(1.0),
                    (None, _) => DVec4::ZERO,
                };
            }
        }
        if views.iter().any(|v| v.quantity == Quantity::Total) {
            let (color, count) = self.radiance(surfaces, behind, corners);
            shaded = count;
            for (sum, _) in sums.iter_mut().zip(views).filter(|(_, v)| v.quantity == Quantity::Total) {
                *sum += color;
            }
        }
        shaded
    }
}

/// The layers of one ray: a range of the sorted list, which starts at `start`.
pub(crate) fn layers_of(layers: &[Layer], ray: usize, start: &mut usize) -> std::ops::Range<usize> {
    let first = *start;
    while layers.get(*start).is_some_and(|l| l.ray as usize == ray) {
        *start += 1;
    }
    first..*start
}

/// Draws several views at once: one picture each, in order.
pub(crate) fn render(
    reference: &ReferenceScene,
    frame: &Frame,
    views: &[ViewSpec],
    progress: &(dyn Fn(f64) + Sync),
) -> Vec<Rendered> {
    let context = FrameContext::of_camera(reference, frame);
    let eye = EyeSpace::new(reference.world(), frame);
    let positions = sample_positions(frame.samples);
    let mut pictures: Vec<Picture> = views.iter().map(|_| Picture::new(frame.width, frame.height, [0.0; 4])).collect();
    let fragments = AtomicU64::new(0);

    // Bands of one block's height: each thread writes rows of its own.
    let band_length = frame.width as usize * BLOCK as usize;
    let mut bands: Vec<Vec<&mut [[f32; 4]]>> = Vec::new();
    bands.resize_with(frame.height.div_ceil(BLOCK) as usize, Vec::new);
    for picture in &mut pictures {
        for (band, rows) in bands.iter_mut().zip(picture.pixels.chunks_mut(band_length.max(1))) {
            band.push(rows);
        }
    }
    let (count, done) = (bands.len(), AtomicUsize::new(0));
    bands.into_par_iter().enumerate().for_each_init(Workspace::default, |workspace, (index, mut rows)| {
        let y0 = index as u32 * BLOCK;
        let y1 = (y0 + BLOCK).min(frame.height);
        for x0 in (0..frame.width).step_by(BLOCK as usize) {
            let block = Block { x0, y0, x1: (x0 + BLOCK).min(frame.width), y1 };
            let shaded = draw_block(&context, &eye, views, &positions, block, workspace, &mut rows);
            fragments.fetch_add(shaded, Ordering::Relaxed);
        }
        progress((done.fetch_add(1, Ordering::Relaxed) + 1) as f64 / count as f64);
    });

    let vertices = reference.world().positions.len() as u64;
    let fragments = fragments.into_inner();
    pictures.into_iter().map(|picture| Rendered { picture, vertices, fragments }).collect()
}

/// Draws one block into the rows of its band, of each view; how many fragments were shaded.
fn draw_block(
    context: &FrameContext,
    eye: &EyeSpace,
    views: &[ViewSpec],
    positions: &[[f64; 2]],
    block: Block,
    workspace: &mut Workspace,
    rows: &mut [&mut [[f32; 4]]],
) -> u64 {
    let frame = context.frame;
    let Workspace { visible, corners } = workspace;
    corners.clear();
    visible.trace(context.reference.world(), eye, positions, block);
    let mut sums = vec![DVec4::ZERO; views.len()];
    let (mut ray, mut next_layer, mut shaded) = (0, 0, 0);
    for y in block.y0..block.y1 {
        for x in block.x0..block.x1 {
            sums.fill(DVec4::ZERO);
            for position in positions {
                let layers = &visible.layers[layers_of(&visible.layers, ray, &mut next_layer)];
                let height = (f64::from(y) + position[1]) / f64::from(frame.height);
                let behind = || context.behind(|| eye.direction(visible.rays[ray]), height);
                let surfaces = context.surfaces(eye, visible, ray, layers);
                shaded += context.values(surfaces, views, behind, corners, &mut sums);
                ray += 1;
            }
            let pixel = ((y - block.y0) * frame.width + x) as usize;
            for (rows, sum) in rows.iter_mut().zip(&sums) {
                let mean = *sum / positions.len() as f64;
                rows[pixel] = mean.to_array().map(|v| v as f32);
            }
        }
    }
    shaded
}
