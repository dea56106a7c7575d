//! The report of `gonio render --json`.

use super::{RenderArgs, Written};
use crate::backend::{Backend, BackendReport, Counts};
use crate::report::Times;
use gonio_mesh::Diagnostic;
use gonio_scene::Scene;
use gonio_scene::scene_file::Shading;
use serde::Serialize;
use std::collections::BTreeSet;

/// The report. Times are in milliseconds, sizes in pixels.
#[derive(Serialize)]
pub struct Report<'a> {
    command: &'static str,
    inputs: &'a [String],
    outputs: Vec<String>,
    backend: BackendReport,
    width: u32,
    height: u32,
    samples: u32,
    frames: u32,
    shading: Vec<Shading>,
    debug: Option<String>,
    views: Vec<String>,
    scene: SceneCounts,
    drawn: Counts,
    times_ms: serde_json::Value,
    warnings: &'a [Diagnostic],
    notes: &'a [String],
}

/// The size of a scene.
#[derive(Serialize)]
pub struct SceneCounts {
    objects: usize,
    triangles: usize,
    vertices: usize,
    materials: usize,
    textures: usize,
    lights: usize,
}

impl SceneCounts {
    /// Counts a mesh once for each object that shows it.
    pub fn count(scene: &Scene) -> Self {
        let meshes = || scene.objects.iter().filter_map(|o| scene.meshes.get(o.mesh));
        SceneCounts {
            objects: scene.objects.len(),
            triangles: meshes().map(|m| m.triangle_count()).sum(),
            vertices: meshes().map(|m| m.positions.len()).sum(),
            materials: scene.materials.len(),
            textures: scene.textures.len(),
            lights: scene.settings.lights.len(),
        }
    }
}

impl<'a> Report<'a> {
    pub fn new(args: &'a RenderArgs, scene: &'a Scene, backend: &Backend, times: &Times, written: &'a Written) -> Self {
        let picture = &scene.settings.picture;
        let shading: BTreeSet<Shading> = scene.objects.iter().map(|o| o.shading).collect();
        Report {
            command: "render",
            inputs: &args.inputs,
            outputs: written.files.iter().map(|p| p.display().to_string()).collect(),
            backend: backend.report(),
            width: picture.width,
            height: picture.height,
            samples: picture.samples,
            frames: args.frames.unwrap_or(1),
            shading: shading.into_iter().collect(),
            debug: args.debug.map(|v| v.to_string()),
            views: args.views.iter().map(ToString::to_string).collect(),
            scene: SceneCounts::count(scene),
            drawn: written.counts,
            times_ms: times.to_json(),
            warnings: &scene.diagnostics,
            notes: &written.notes,
        }
    }
}
