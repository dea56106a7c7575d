//! The part of a probe about the paths of light (`--traced`).

use super::text::ProbePage;
use crate::report::{Reporter, Times};
use glam::DVec3;
use gonio_scene::{Frame, Scene};
use gonio_trace::{LightOrigin, PixelContributions, TraceScene, TraceSettings};
use serde::Serialize;

/// Paths without `--samples`.
const DEFAULT_PATHS: u32 = 4096;

/// The light of a pixel by the way it took: means of paths through the whole pixel, linear RGB.
#[derive(Debug, PartialEq, Serialize)]
pub(super) struct TracedPixel {
    paths: u32,
    /// Light that no surface scattered.
    emitted: DVec3,
    /// Light that one surface scattered, by its source.
    direct: Vec<DirectLight>,
    /// Light that two surfaces scattered.
    first_bounce: DVec3,
    /// Light that more surfaces scattered.
    rest: DVec3,
    total: DVec3,
    /// Of the total.
    standard_error: DVec3,
}

#[derive(Debug, PartialEq, Serialize)]
struct DirectLight {
    /// `light`, `object`, `environment` or `ambient`.
    source: &'static str,
    /// Of the light or the object in the scene.
    index: Option<usize>,
    name: String,
    value: DVec3,
}

impl TracedPixel {
    /// Follows paths through a pixel of the frame.
    pub fn new(
        scene: &Scene,
        frame: &Frame,
        (x, y): (u32, u32),
        paths: Option<u32>,
        reporter: &Reporter,
        times: &Times,
    ) -> Self {
        let _busy = reporter.busy("following paths of light");
        times.measure("trace", || {
            let ready = TraceScene::new(scene, frame);
            for oddity in ready.oddities() {
                reporter.warning(oddity);
            }
            let found = ready.contributions(&TraceSettings::default(), x, y, paths.unwrap_or(DEFAULT_PATHS), &|_| true);
            TracedPixel::of(found, scene)
        })
    }

    fn of(found: PixelContributions, scene: &Scene) -> Self {
        let direct = found.direct.into_iter().map(|(origin, value)| {
            let (source, index, name) = match origin {
                LightOrigin::Light(index) => {
                    ("light", Some(index), scene.settings.lights.get(index).map(|light| light.name.clone()))
                }
                LightOrigin::Object(index) => {
                    ("object", Some(index), scene.objects.get(index).map(|object| object.name.clone()))
                }
                LightOrigin::Environment => ("environment", None, None),
                LightOrigin::Ambient => ("ambient", None, None),
            };
            DirectLight { source, index, name: name.unwrap_or_default(), value }
        });
        TracedPixel {
            paths: found.samples,
            emitted: found.emitted,
            direct: direct.collect(),
            first_bounce: found.first_bounce,
            rest: found.rest,
            total: found.total,
            standard_error: found.standard_error,
        }
    }
}

impl ProbePage<'_> {
    /// The light that arrived, by the way it took.
    pub(super) fn traced(&mut self, traced: &TracedPixel) {
        self.heading(&format!("light that arrived, by the way it took: {} paths through the pixel", traced.paths));
        self.vector("emitted", traced.emitted, "no surface scattered it");
        for direct in &traced.direct {
            let name = match (direct.source, direct.index) {
                ("object", Some(index)) if direct.name.is_empty() => format!("object {index}"),
                ("object", _) => format!("object `{}`", direct.name),
                (_, Some(index)) => format!("light {index}"),
                (other, None) => other.to_owned(),
            };
            let remark = match (direct.source, direct.name.as_str()) {
                ("light", name) if !name.is_empty() => format!("`{name}`; one surface scattered it"),
                ("ambient", _) => "k_a * ambient light".to_owned(),
                _ => "one surface scattered it".to_owned(),
            };
            self.vector(&name, direct.value, &remark);
        }
        self.vector("first bounce", traced.first_bounce, "two surfaces scattered it");
        self.vector("rest", traced.rest, "more surfaces scattered it");
        self.vector("total", traced.total, "the pixel of gonio trace");
        self.vector("standard error", traced.standard_error, "of the total");
    }
}
