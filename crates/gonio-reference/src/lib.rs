//! Pictures of a scene on the CPU, in f64, straight from `gonio-light`: the reference for the GPU, and the fallback where
//! there is no OpenGL.
//!
//! A ray goes from the eye through each sample of each pixel to the nearest triangle; there the light equation is
//! evaluated at the points that the object's shading chooses. Nothing is random and no value depends on the number of threads: the same
//! scene gives the same bytes.
//!
//! | module | content |
//! |---|---|
//! | `geometry` | triangles in world space, the tree of boxes over them; shared by scenes of the same geometry |
//! | `intersect` | a ray against a triangle, without leaks |
//! | `visibility` | which triangles the rays of a block of pixels see |
//! | `fragment` | place, texture coordinates and material where a ray meets a triangle |
//! | `shade` | the equation there: flat, Gouraud, Phong |
//! | `shadow` | whether a triangle is between a point and a light |
//! | `environment` | the environment that is seen there, and behind the objects |
//! | `ray`, `body` | rays from anywhere, and through the inside of an object |
//! | `render` | samples, transparency, threads |
//! | `panorama` | the whole sphere at once, and the six faces of a cube |
//! | [`probe`] | every number of one pixel |
//!
//! As on the GPU, which may surprise:
//! - a hit nearer than the near plane or beyond the far plane is none, as if clipped;
//! - of equally near triangles the first drawn wins; an edge that a ray meets exactly belongs to one triangle, by the
//!   top-left rule;
//! - surfaces that are not opaque are composited from front to back ("over", Porter and Duff 1984), at most
//!   [`MAX_LAYERS`] of them; below an opacity of [`HOLE`] there is a hole;
//! - a debug view shows the nearest surface that is not a hole, as if it were opaque;
//! - shadows are those of the triangles, not of the smooth surface that their normals suggest: near the boundary of light
//!   and dark they follow the facets.

mod body;
mod environment;
mod fragment;
mod geometry;
mod intersect;
mod panorama;
pub mod probe;
mod ray;
mod render;
mod samples;
mod shade;
mod shadow;
mod visibility;

pub use geometry::ReferenceGeometry;
pub use probe::Probe;
pub use render::{HOLE, MAX_LAYERS};
pub use samples::sample_positions;

use geometry::WorldGeometry;
use gonio_environment::{Face, Layout};
use gonio_light::Quantity;
use gonio_scene::{Frame, Picture, Scene, ViewSpec};
use std::sync::Arc;

/// A scene with its acceleration structure built. It holds what it needs of the scene it was made from (meshes and
/// textures are shared), so it may go to another thread and outlive it.
pub struct ReferenceScene {
    scene: Scene,
    geometry: Arc<ReferenceGeometry>,
}

/// A picture, with statistics.
#[derive(Clone, Debug, PartialEq)]
pub struct Rendered {
    /// Linear, premultiplied, nothing clamped.
    pub picture: Picture,
    /// The number of vertices of all objects.
    pub vertices: u64,
    /// The number of shaded fragments: one for each sample and visible surface.
    pub fragments: u64,
}

impl ReferenceScene {
    /// Carries the geometry to world space and builds the acceleration structure.
    ///
    /// Triangles with corners that are not finite, or with indices beyond the mesh, are left out.
    pub fn new(scene: &Scene) -> Self {
        ReferenceScene { scene: scene.clone(), geometry: Arc::new(ReferenceGeometry::new(scene)) }
    }

    /// [`Self::new`] with a structure that was built for this scene, or for one that differs only in what
    /// [`ReferenceGeometry::fits`] allows; `None` where it does not fit.
    pub fn with_geometry(scene: &Scene, geometry: Arc<ReferenceGeometry>) -> Option<Self> {
        geometry.fits(scene).then(|| ReferenceScene { scene: scene.clone(), geometry })
    }

    /// The structure, for another scene of the same geometry.
    pub fn geometry(&self) -> Arc<ReferenceGeometry> {
        self.geometry.clone()
    }

    /// The scene that is drawn.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The geometry in world space.
    pub(crate) fn world(&self) -> &WorldGeometry {
        self.geometry.world()
    }

    /// The picture, or a debug view of it: linear values, nothing clamped. `progress` is called with
    /// the share done, from any thread.
    ///
    /// Debug views: alpha 1 where there is a surface; elsewhere zeros with alpha 0, but opaque black for views that are
    /// colours of light. The view `total` is the picture itself, background included.
    pub fn render(&self, frame: &Frame, view: Option<ViewSpec>, progress: &(dyn Fn(f64) + Sync)) -> Rendered {
        let view = view.unwrap_or(ViewSpec { quantity: Quantity::Total, light: None });
        let mut rendered = self.views(frame, &[view], progress);
        rendered.pop().unwrap_or_else(|| Rendered {
            picture: Picture::new(frame.width, frame.height, [0.0; 4]),
            vertices: 0,
            fragments: 0,
        })
    }

    /// Several views at once, in order: the rays are traced once for all. The view `total` is the picture.
    pub fn views(&self, frame: &Frame, views: &[ViewSpec], progress: &(dyn Fn(f64) + Sync)) -> Vec<Rendered> {
        render::render(self, frame, views, progress)
    }

    /// The whole sphere around the frame's camera as an equirectangular picture: linear, premultiplied, nothing
    /// clamped.
    ///
    /// The centre column is the world's -Z, the right half turns towards +X, the top row is +Y, wherever the camera
    /// looks; only its position counts. There are no near and far planes: nothing in front of the eye is cut off. A
    /// background without environment goes from its top colour at +Y to its bottom colour at -Y by the angle. Sizes of
    /// 0 count as 1.
    pub fn panorama(&self, frame: &Frame, width: u32, height: u32) -> Picture {
        panorama::panorama(self, frame, width, height)
    }

    /// The view from the frame's camera through one face of a cube whose edges are along the world's axes, as a
    /// picture of that face in a layout; else as [`Self::panorama`]. A size of 0 counts as 1.
    pub fn cube_face(&self, frame: &Frame, face: Face, layout: Layout, size: u32) -> Picture {
        panorama::cube_face(self, frame, face, layout, size)
    }

    /// The radiance behind all objects in the pixel in column `x` of row `y` (from the top left), at its centre: the
    /// environment where it is seen, else the background. Premultiplied RGBA.
    pub fn behind(&self, frame: &Frame, x: u32, y: u32) -> [f64; 4] {
        probe::behind(self, frame, x, y).to_array()
    }

    /// Every number of the pixel in column `x` of row `y` (from the top left), seen through its centre: the value is
    /// that of the picture with one sample per pixel. `None` where no surface is seen, or outside of the picture.
    pub fn probe(&self, frame: &Frame, x: u32, y: u32) -> Option<Probe> {
        self.probe_all(frame, [(x, y)]).pop().flatten()
    }

    /// [`Self::probe`] of several pixels (column, row), in order: what they share is computed once.
    pub fn probe_all(&self, frame: &Frame, pixels: impl IntoIterator<Item = (u32, u32)>) -> Vec<Option<Probe>> {
        probe::probe_all(self, frame, pixels)
    }
}
