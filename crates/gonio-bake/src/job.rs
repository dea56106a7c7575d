//! Unwrapping, baking and files in one piece of work, for programs that show its progress.

use crate::detail::MaterialDetail;
use crate::maps::{BakeSettings, BakedMap, Baker, MapKind};
use crate::model::{AtlasSet, MapFile, baked_model};
use crate::surface::SceneSurface;
use gonio_atlas::{AtlasUv, UnwrapError, UnwrapSettings, UvReport, UvSource, layout, unwrap, uv_report};
use gonio_image::encode::png::{ColorTag, encode8};
use gonio_image::{EncodedPicture, ImageError, srgb};
use gonio_mesh::write;
use gonio_scene::Scene;
use serde::{Deserialize, Serialize};
use std::fmt;

/// What is baked, and how.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct BakeJob {
    /// The maps; repeated ones are baked once.
    pub maps: Vec<MapKind>,
    /// Texels along a side, 1 to 16384.
    pub size: u32,
    /// The distance between charts as a share of the side, 0 to 0.25.
    pub margin: f64,
    /// Samples along a side of a texel, at least 1.
    pub grid: u32,
    /// Rays of each texel for ambient occlusion.
    pub occlusion_rays: u32,
    /// The texture coordinates to start from.
    pub uv_source: UvSource,
}

impl Default for BakeJob {
    fn default() -> Self {
        let BakeSettings { size, grid, occlusion_rays, .. } = BakeSettings::default();
        let UnwrapSettings { margin, source, .. } = UnwrapSettings::default();
        BakeJob { maps: vec![MapKind::Diffuse], size, margin, grid, occlusion_rays, uv_source: source }
    }
}

/// The result of a [`BakeJob`].
#[derive(Clone, Debug)]
pub struct BakedAtlas {
    /// The texture coordinates, for the triangles of a [`SceneSurface`].
    pub uv: AtlasUv,
    /// Figures about them.
    pub report: UvReport,
    /// The corners of all triangles in world space, three for each.
    pub corners: Vec<[f32; 3]>,
    /// The charts.
    pub layout: EncodedPicture<u8>,
    /// The maps, in the order of [`MapKind::ALL`].
    pub pictures: Vec<MapPicture>,
    /// The files by their names: the model as OBJ, MTL and GLB, the maps, and a picture of the layout.
    pub files: Vec<(String, Vec<u8>)>,
    /// Oddities that were survived, one sentence each.
    pub warnings: Vec<String>,
}

/// A baked map to look at.
#[derive(Clone, Debug, PartialEq)]
pub struct MapPicture {
    /// The quantity.
    pub kind: MapKind,
    /// The name of its file.
    pub file: String,
    /// [`BakedMap::factor`].
    pub factor: f32,
    /// The file's picture. Light is scaled so that its brightest hundredth is white, and positions so that the box around them
    /// has all colours.
    pub picture: EncodedPicture<u8>,
}

/// Describes why a job failed.
#[derive(Debug)]
pub enum BakeJobError {
    /// There are no texture coordinates.
    Unwrap(UnwrapError),
    /// A picture cannot be encoded.
    Image(ImageError),
    /// The model cannot be written, in one sentence.
    Model(String),
    /// No map was asked for.
    NoMap,
    /// The progress function returned false.
    Stopped,
}

impl fmt::Display for BakeJobError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            BakeJobError::Unwrap(error) => error.fmt(f),
            BakeJobError::Image(error) => error.fmt(f),
            BakeJobError::Model(error) => write!(f, "the baked model cannot be written as GLB: {error}"),
            BakeJobError::NoMap => f.write_str("no map is chosen: choose at least one to bake"),
            BakeJobError::Stopped => f.write_str("baking was stopped"),
        }
    }
}

impl std::error::Error for BakeJobError {}

impl From<UnwrapError> for BakeJobError {
    fn from(error: UnwrapError) -> Self {
        if error == UnwrapError::Stopped { BakeJobError::Stopped } else { BakeJobError::Unwrap(error) }
    }
}

impl From<ImageError> for BakeJobError {
    fn from(error: ImageError) -> Self {
        BakeJobError::Image(error)
    }
}

/// Receives the step at work and the share of the whole job that is done, 0 to 1, from any thread; returns whether to go on.
pub type BakeProgress<'a> = &'a (dyn Fn(&str, f64) -> bool + Sync);

impl BakeJob {
    /// Unwraps all objects of a scene, bakes the maps at `time` in seconds, and makes the files, whose names begin with `stem`.
    ///
    /// # Errors
    ///
    /// See [`BakeJobError`].
    pub fn run(
        &self,
        scene: &Scene,
        time: f64,
        stem: &str,
        progress: BakeProgress<'_>,
    ) -> Result<BakedAtlas, BakeJobError> {
        let kinds: Vec<MapKind> = MapKind::ALL.iter().copied().filter(|kind| self.maps.contains(kind)).collect();
        if kinds.is_empty() {
            return Err(BakeJobError::NoMap);
        }
        let share_of = Shares::new(&kinds);
        let scene = &scene.at(time);
        let surface = SceneSurface::new(scene);
        let settings = UnwrapSettings { margin: self.margin, source: self.uv_source, ..UnwrapSettings::default() };
        let settings = match MaterialDetail::new(scene, &surface, &kinds) {
            Some(detail) => detail.applied_to(settings),
            None => settings,
        };
        let uv = unwrap(&surface.mesh, &settings, &|share| progress("unwrapping", share_of.step(0, share)))?;
        let report = uv_report(&surface.mesh, &uv, self.size);
        let mut warnings = self.warnings(&report);
        let frame = scene.frame(time);
        let settings = BakeSettings {
            size: self.size,
            grid: self.grid,
            occlusion_rays: self.occlusion_rays,
            ..BakeSettings::default()
        };
        let mut baker = Baker::new(scene, &frame, &surface, &uv, settings);
        let mut pictures = Vec::with_capacity(kinds.len());
        let mut files = Vec::new();
        for (index, &kind) in kinds.iter().enumerate() {
            let step = format!("baking {}", kind.name().replace('-', " "));
            let go_on = |share| progress(&step, share_of.step(1 + index, share));
            let map = baker.bake(kind, &go_on).ok_or(BakeJobError::Stopped)?;
            let file = kind.file_name(stem);
            files.push((file.clone(), map.encode()?));
            pictures.push(MapPicture { kind, file, factor: map.factor(), picture: display_picture(&map) });
        }
        if !progress("writing the files", share_of.step(1 + kinds.len(), 0.0)) {
            return Err(BakeJobError::Stopped);
        }
        let maps: Vec<MapFile> = pictures.iter().map(MapPicture::map_file).collect();
        let baked = baked_model(scene, &surface, &uv, &maps, AtlasSet::Only);
        if !baked.lost.is_empty() {
            warnings.push(format!(
                "textures were not baked and are left out, as they belong to the old coordinates: {}",
                baked.lost.join(", ")
            ));
        }
        let obj = write::obj::write(&baked.model, &format!("{stem}.mtl"));
        let bytes_of = |file: &str| files.iter().find(|(name, _)| name == file).map(|(_, bytes)| bytes.clone());
        let glb = write::glb::write(&baked.model, &mut |map| bytes_of(&map.path))
            .map_err(|error| BakeJobError::Model(error.to_string()))?;
        warnings.extend(obj.diagnostics.iter().chain(&glb.diagnostics).map(ToString::to_string));
        let layout = layout::draw_layout(&uv, self.size);
        files.extend([
            (format!("{stem}_layout.png"), encode8(&layout, ColorTag::Srgb)?),
            (obj.mtl_name, obj.mtl),
            (format!("{stem}.glb"), glb.bytes),
            (format!("{stem}.obj"), obj.obj),
        ]);
        let corners = surface.mesh.indices.iter().map(|&i| surface.mesh.positions[i as usize]).collect();
        Ok(BakedAtlas { uv, report, corners, layout, pictures, files, warnings })
    }

    fn warnings(&self, report: &UvReport) -> Vec<String> {
        let mut warnings = Vec::new();
        if report.overlapping_texels > 0 {
            warnings.push(format!(
                "charts overlap in {} texels, which can hold the colours of one of them only",
                report.overlapping_texels
            ));
        }
        let wanted = self.margin * f64::from(self.size);
        if self.uv_source != UvSource::Kept && report.margin_texels < 0.999 * wanted {
            warnings.push(format!(
                "{} charts leave no room for the margin: it is {:.2} texels instead of {wanted:.2}",
                report.charts, report.margin_texels
            ));
        }
        warnings
    }
}

impl MapPicture {
    /// The map's file, as a baked model refers to it.
    pub fn map_file(&self) -> MapFile {
        MapFile { kind: self.kind, name: self.file.clone(), factor: self.factor }
    }
}

/// The shares of a job's steps: unwrapping, the maps, the files.
struct Shares {
    /// Where each step begins, and 1.
    starts: Vec<f64>,
}

impl Shares {
    fn new(kinds: &[MapKind]) -> Self {
        // Rays take longer than lookups.
        let of_map =
            |kind: &MapKind| if matches!(kind, MapKind::AmbientOcclusion | MapKind::Light) { 6.0 } else { 1.0 };
        let steps = [1.0].into_iter().chain(kinds.iter().map(of_map)).chain([1.0 + 0.5 * kinds.len() as f64]);
        let mut starts = vec![0.0];
        starts.extend(steps.scan(0.0, |sum, step| {
            *sum += step;
            Some(*sum)
        }));
        let all = starts.last().copied().unwrap_or(1.0);
        starts.iter_mut().for_each(|start| *start /= all);
        Shares { starts }
    }

    /// The share of the job when `share` of a step is done.
    fn step(&self, step: usize, share: f64) -> f64 {
        let (start, end) = (self.starts[step], self.starts[step + 1]);
        start + share.clamp(0.0, 1.0) * (end - start)
    }
}

/// See [`MapPicture::picture`].
fn display_picture(map: &BakedMap) -> EncodedPicture<u8> {
    let texels = &map.texels;
    let encode: Box<dyn Fn([f32; 3]) -> [u8; 3]> = match map.kind {
        MapKind::Position => {
            let bound = |axis: usize, pick: fn(f32, f32) -> f32, start: f32| {
                texels.values.iter().map(|v| v[axis]).filter(|v| v.is_finite()).fold(start, pick)
            };
            let range = [0, 1, 2].map(|axis| (bound(axis, f32::min, f32::MAX), bound(axis, f32::max, f32::MIN)));
            Box::new(move |v| {
                [0, 1, 2].map(|axis| {
                    let (low, high) = range[axis];
                    (255.0 * (v[axis] - low) / (high - low).max(f32::MIN_POSITIVE)).clamp(0.0, 255.0) as u8
                })
            })
        }
        kind if kind.extension() == "exr" => {
            let mut brightest: Vec<f32> = texels.values.iter().map(|[r, g, b, _]| r.max(*g).max(*b)).collect();
            brightest.retain(|value| value.is_finite());
            brightest.sort_unstable_by(f32::total_cmp);
            let white = brightest.get(brightest.len() * 99 / 100).copied().filter(|white| *white > 0.0).unwrap_or(1.0);
            Box::new(move |v| v.map(|v| srgb::ENCODER.encode((v / white).clamp(0.0, 1.0))))
        }
        _ => return map.picture8(),
    };
    let rgba = texels.rows_from_top().flat_map(|[r, g, b, _]| {
        let [r, g, b] = encode([r, g, b]);
        [r, g, b, 255]
    });
    EncodedPicture { width: texels.size, height: texels.size, rgba: rgba.collect() }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use gonio_scene::files::BuiltinOnly;
    use gonio_scene::load;
    use std::path::Path;
    use std::sync::Mutex;

    fn cube() -> Scene {
        load::load(load::describe(&["builtin:cube"], &BuiltinOnly).unwrap(), Path::new(""), &BuiltinOnly).unwrap()
    }

    #[test]
    fn a_job_makes_all_files_and_its_progress_rises_to_the_end() {
        let maps = vec![MapKind::Position, MapKind::Diffuse, MapKind::AmbientOcclusion];
        let job = BakeJob { maps, size: 32, ..BakeJob::default() };
        let shares = Mutex::new(Vec::new());
        let progress = |_: &str, share: f64| {
            shares.lock().unwrap().push(share);
            true
        };
        let baked = job.run(&cube(), 0.0, "cube_baked", &progress).unwrap();
        let names: Vec<&str> = baked.files.iter().map(|(name, _)| name.as_str()).collect();
        let maps = ["cube_baked_diffuse.png", "cube_baked_ambient-occlusion.png", "cube_baked_position.exr"];
        let model = ["cube_baked_layout.png", "cube_baked.mtl", "cube_baked.glb", "cube_baked.obj"];
        assert_eq!(names, [&maps[..], &model[..]].concat());
        assert_eq!((baked.corners.len(), baked.uv.tex_coords.len()), (36, 36));
        assert!(baked.pictures.iter().all(|map| map.picture.rgba.len() == 4 * 32 * 32));
        let shares = shares.into_inner().unwrap();
        assert!(shares.iter().all(|share| (0.0..=1.0).contains(share)), "{shares:?}");
        // Bands are baked in any order, steps one after the other.
        assert!(shares.last() > shares.iter().find(|share| **share > 0.3), "{shares:?}");
    }

    #[test]
    fn a_job_can_be_stopped_at_any_time() {
        let job = BakeJob { size: 32, ..BakeJob::default() };
        for most in [0.0, 0.2, 0.5] {
            let stopped = job.run(&cube(), 0.0, "cube", &|_, share| share < most);
            assert!(matches!(stopped, Err(BakeJobError::Stopped)), "{most}");
        }
        let none = BakeJob { maps: Vec::new(), ..job };
        assert!(matches!(none.run(&cube(), 0.0, "cube", &|_, _| true), Err(BakeJobError::NoMap)));
    }
}
