//! Pictures of everything around the eye: a panorama, and the faces of a cube.

use crate::ReferenceScene;
use crate::geometry::WorldGeometry;
use crate::intersect::RaySpace;
use crate::ray::Ray;
use crate::render::FrameContext;
use crate::sample_positions;
use crate::samples::sample_width;
use crate::shade::CornerCache;
use crate::visibility::NOTHING;
use glam::{DVec2, DVec3, DVec4};
use gonio_environment::{Face, Layout, panorama as equirectangular};
use gonio_scene::{Frame, Picture};
use rayon::prelude::*;
use std::f64::consts::PI;

pub(crate) fn panorama(reference: &ReferenceScene, frame: &Frame, width: u32, height: u32) -> Picture {
    let (width, height) = (width.max(1), height.max(1));
    let direction = |x: f64, y: f64| equirectangular::direction(x / f64::from(width), y / f64::from(height));
    draw(reference, frame, [width, height], PI / f64::from(height), direction)
}

pub(crate) fn cube_face(reference: &ReferenceScene, frame: &Frame, face: Face, layout: Layout, size: u32) -> Picture {
    let size = size.max(1);
    let on_face = |v: f64| 2.0 * v / f64::from(size) - 1.0;
    let direction = |x: f64, y: f64| face.direction(on_face(x), on_face(y), layout).normalize();
    draw(reference, frame, [size, size], 2.0 / f64::from(size), direction)
}

/// The data that a thread reuses for each pixel.
#[derive(Default)]
struct Workspace {
    corners: CornerCache,
    /// Distances and triangles of perhaps transparent surfaces.
    layers: Vec<(f64, u32)>,
}

/// The space of one ray of a panorama.
struct PanoramaRay<'a> {
    ray: &'a Ray,
    geometry: &'a WorldGeometry,
    /// Directions a sample's width farther to the right, and farther down.
    beside: [DVec3; 2],
}

impl RaySpace for PanoramaRay<'_> {
    fn corners(&self, vertices: [u32; 3]) -> [DVec3; 3] {
        self.ray.corners(self.geometry, vertices)
    }

    fn steps(&self) -> [DVec2; 2] {
        self.beside.map(|direction| {
            let there = self.ray.of_world(direction);
            // A picture of a few pixels has neighbours that are behind.
            if there.z > 0.0 { there.truncate() / there.z } else { DVec2::ZERO }
        })
    }
}

/// A picture that maps each place (pixels, from the top left) to a unit direction in the world.
fn draw(
    reference: &ReferenceScene,
    frame: &Frame,
    [width, height]: [u32; 2],
    pixel_angle_rad: f64,
    direction: impl Fn(f64, f64) -> DVec3 + Sync,
) -> Picture {
    let context = FrameContext::new(reference, frame, pixel_angle_rad);
    let positions = sample_positions(frame.samples);
    let step = sample_width(frame.samples);
    let mut picture = Picture::new(width, height, [0.0; 4]);
    let rows = picture.pixels.par_chunks_mut(width as usize).enumerate();
    rows.for_each_init(Workspace::default, |workspace, (row, pixels)| {
        for (column, pixel) in pixels.iter_mut().enumerate() {
            let along = |position: &[f64; 2]| {
                let (x, y) = (column as f64 + position[0], row as f64 + position[1]);
                let ray = Ray::new(frame.camera.position, direction(x, y));
                let beside = [direction(x + step, y), direction(x, y + step)];
                radiance(&context, &ray, beside, workspace)
            };
            let sum: DVec4 = positions.iter().map(along).sum();
            *pixel = (sum / positions.len() as f64).to_array().map(|v| v as f32);
        }
    });
    picture
}

/// Premultiplied RGBA along a ray; `beside` are the directions a sample's width to the right and below.
fn radiance(context: &FrameContext, ray: &Ray, beside: [DVec3; 2], workspace: &mut Workspace) -> DVec4 {
    let geometry = context.shader.geometry;
    let Workspace { corners, layers } = workspace;
    layers.clear();
    let mut opaque = (f64::INFINITY, NOTHING);
    ray.trace(geometry, |id, triangle, crossing| {
        let front = crossing.counter_clockwise != triangle.mirrored;
        let found = (crossing.depth, id);
        if triangle.closed && !front {
            // Never seen.
        } else if triangle.transparent {
            layers.push(found);
        } else if found < opaque {
            opaque = found;
        }
        opaque.0
    });
    layers.retain(|layer| *layer < opaque);
    layers.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let ids = layers.iter().map(|layer| layer.1).chain((opaque.1 != NOTHING).then_some(opaque.1));

    let space = PanoramaRay { ray, geometry, beside };
    let surfaces = context.surfaces_of(ids, DVec2::ZERO, &space);
    let behind = || context.behind(|| ray.direction, equirectangular::place(ray.direction).1);
    context.radiance(surfaces, behind, corners).0
}
