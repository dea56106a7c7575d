//! Measurements of the panes, as plain numbers.

use gonio_scene::difference::{DifferenceStatistics, Spread};
use gonio_scene::scene_file::Shading;

/// Measurements of one pane.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PaneFacts {
    /// Triangles of all objects.
    pub triangles: usize,
    /// Vertex shader runs, counted by the GPU, or else an upper bound from the index buffers.
    pub vertices: Option<u64>,
    /// Fragment shader runs, counted by the GPU; `None` if the driver cannot count.
    pub fragments: Option<u64>,
    /// Whether the vertices were counted by the GPU.
    pub counted: bool,
    /// Milliseconds of the last finished frame.
    pub ms: f64,
    /// Whether its meshes are being simplified.
    pub preparing: bool,
}

/// Difference between the displayed pictures of a pair of panes.
#[derive(Clone, Debug, PartialEq)]
pub struct DifferenceFacts {
    /// Size of the map, pixels.
    pub size: [u32; 2],
    /// Statistics of the differences, 8-bit steps.
    pub spread: Spread,
    /// Pixels with a colour that differs by more than one step.
    pub differing: u64,
    /// Peak signal-to-noise ratio, decibels; `None` if nothing differs.
    pub psnr_db: Option<f64>,
    /// Column and row of the pixel that differs most, if any does.
    pub worst: Option<[u32; 2]>,
}

impl DifferenceFacts {
    /// Summarises a tally over a picture.
    pub fn new(tally: &DifferenceStatistics, size: [u32; 2]) -> Self {
        let width = size[0].max(1) as usize;
        let place = |index: usize| [(index % width) as u32, (index / width) as u32];
        DifferenceFacts {
            size,
            spread: tally.spread(),
            differing: tally.differing(),
            psnr_db: tally.psnr_db(),
            worst: tally.worst().map(place),
        }
    }

    /// The share of pixels that differ, percent.
    pub fn percent(&self) -> f64 {
        100.0 * self.differing as f64 / (f64::from(self.size[0]) * f64::from(self.size[1])).max(1.0)
    }
}

/// One picture of the error curve.
#[derive(Clone, Debug, PartialEq)]
pub struct CurvePoint {
    /// The shading.
    pub shading: Shading,
    /// Triangles of all objects.
    pub triangles: usize,
    /// Root of the mean square of the difference from the finest, 8-bit steps.
    pub rms: f64,
    /// Vertices, as counted by the GPU.
    pub vertices: Option<u64>,
    /// Fragments, as counted by the GPU.
    pub fragments: Option<u64>,
}

/// The error against the finest mesh as a function of the number of triangles.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Curve {
    /// Whether it is being drawn.
    pub running: bool,
    /// Number of pictures drawn so far, and of all pictures.
    pub progress: [usize; 2],
    /// The points so far, by shading, then from coarse to fine.
    pub points: Vec<CurvePoint>,
    /// Description of the picture that all are compared with.
    pub against: String,
}

/// All measurements.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PaneComparison {
    /// Each pane.
    pub panes: Vec<PaneFacts>,
    /// The difference of the pair, if shown.
    pub difference: Option<DifferenceFacts>,
    /// Error against the number of triangles.
    pub curve: Curve,
}
