//! `gonio bake`: textures for new texture coordinates. The work is `gonio-bake`'s; this module has the options and files.

use crate::backend;
use crate::commands::atlas::{AtlasOptions, AtlasReport, checker_picture};
use crate::error::{CliError, CommandOutcome};
use crate::loading;
use crate::options::{GeneralOptions, LimitOptions, SceneOptions, values};
use crate::output::{OutputFiles, check_folder};
use crate::report::{Reporter, Times};
use clap::{ArgAction, Args};
use glam::DVec3;
use gonio_atlas::{AtlasUv, layout, uv_report};
use gonio_bake::model::{AtlasSet, MapFile, baked_model};
use gonio_bake::{BakeSettings, BakedMap, Baker, LitPoint, MapKind, MaterialDetail, SceneSurface};
use gonio_image::encode::png::{ColorTag, encode8};
use gonio_mesh::{Diagnostic, write};
use gonio_scene::scene_file::LightSpec;
use gonio_scene::{Frame, Scene};
use gonio_trace::{Simplification, Simplifications, SurfacePoint, TraceScene, TraceSettings};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

/// Bake materials, normals or light into textures for new texture coordinates.
#[derive(Args, Debug)]
#[command(after_long_help = "\
Examples:
  gonio bake still_life.obj -o baked
      All diffuse colours and textures of the model in one picture: baked/still_life.obj, .mtl, .glb and still_life_diffuse.png.
  gonio bake coarse.obj -o baked --from fine.obj --what normal
      A normal map (MikkTSpace, green up) from a finer model.
  gonio bake scene.toml -o baked --what diffuse,light,ambient-occlusion --size 2048
      Several maps of all objects of a scene; light is linear OpenEXR.
  gonio bake scene.toml -o baked --what light --traced --paths 1024
      A lightmap by the path tracer: with soft shadows and with light between surfaces.
  gonio bake model.glb -o baked --what diffuse --second-uv
      The .glb keeps its own coordinates; the baked texture is on the second set. An .obj has one set: the new one.
  gonio bake model.obj -o baked --keep-uvs --what ambient-occlusion
      For the model's own texture coordinates, which must not overlap.
  gonio bake model.obj -o baked --checker checker.png
      Also a picture of the model with a checker, whose squares show how the new coordinates stretch it.

MODEL itself never changes. The textures that --what names are used by the materials of the baked model; ambient-occlusion, \
light, position and id are pictures beside it. Texels beside a chart continue it as far as the next chart, so that no filter \
reads a background.

Maps: diffuse, specular, normal, ambient-occlusion, light, position, emitted, id.

The map light is the irradiance divided by pi, in linear RGB: a diffuse surface is as bright as k_d times the map. It has no other colour of the surface itself. With --traced, materials that emit light are light sources, and ambient light does not exist, as in `gonio trace`; the standard error of each texel is a file beside the map.

Exit codes: 0 success, 2 error.")]
pub struct BakeArgs {
    /// Models or scenes (.toml); several become one atlas. builtin:NAME is a built-in model or scene.
    #[arg(required = true, value_name = "MODEL")]
    pub inputs: Vec<String>,
    /// Folder to write to, created or updated.
    #[arg(long, short, required = true, value_name = "DIR", help_heading = "Output options")]
    pub output: PathBuf,
    /// Maps to bake.
    #[arg(long, value_name = "MAP,...", help_heading = "Output options", value_delimiter = ',', default_value = "diffuse",
          value_parser = values::named(MapKind::ALL, MapKind::name))]
    pub what: Vec<MapKind>,
    /// Take the values from this finer model in the same place.
    #[arg(long, value_name = "MODEL", help_heading = "Input options")]
    pub from: Option<String>,
    /// Distance to either side within which --from is searched, in world units; by default a twentieth of the model's diagonal.
    #[arg(long, value_name = "DISTANCE", help_heading = "Input options", requires = "from", value_parser = values::distance,
          allow_negative_numbers = true)]
    pub cage: Option<f64>,
    #[command(flatten)]
    pub atlas: AtlasOptions,
    /// Samples of each texel: a square number.
    ///
    /// One is enough for textures, which are filtered; more smooth the borders of materials and shadows.
    #[arg(long, value_name = "N", help_heading = "Picture options", default_value = "1", value_parser = values::texel_samples)]
    pub samples: u32,
    /// Rays of each texel for ambient occlusion.
    #[arg(long, value_name = "N", help_heading = "Light options", default_value = "64", value_parser = values::rays)]
    pub occlusion_rays: u32,
    /// Length of these rays in world units; without it they have no end.
    #[arg(long, value_name = "DISTANCE", help_heading = "Light options", value_parser = values::distance,
          allow_negative_numbers = true)]
    pub occlusion_distance: Option<f64>,
    /// A light that replaces the scene's lights, for the map `light`; repeat it for several. Keys as for `gonio render`.
    #[arg(long, value_name = "KIND KEY=VALUE ...", help_heading = "Light options", action = ArgAction::Append,
          value_parser = LightSpec::from_option_text)]
    pub light: Vec<LightSpec>,
    /// Objects cast shadows in the map `light`; =false switches that off.
    #[arg(long, value_name = "BOOL", help_heading = "Light options", num_args = 0..=1, require_equals = true,
          default_missing_value = "true")]
    pub shadows: Option<bool>,
    #[command(flatten)]
    pub trace: LightTraceOptions,
    #[command(flatten)]
    pub limits: LimitOptions,
    #[command(flatten)]
    pub general: GeneralOptions,
}

/// How the light of lightmaps is traced.
#[derive(Args, Debug, Clone)]
#[command(next_help_heading = "Trace options")]
pub struct LightTraceOptions {
    /// Trace the paths of the map `light`: shadows of lamps and light between surfaces, instead of the light equation.
    #[arg(long, conflicts_with = "shadows")]
    pub traced: bool,
    /// Paths of each texel.
    #[arg(long, value_name = "N", default_value = "256", requires = "traced", value_parser = values::paths,
          allow_negative_numbers = true)]
    pub paths: u32,
    /// Surfaces that a path meets at most, the baked one included; 2 means direct light only.
    #[arg(long, value_name = "N", default_value = "64", requires = "traced", value_parser = values::depth,
          allow_negative_numbers = true)]
    pub max_depth: u32,
    /// Seed of the random numbers: another one gives other noise.
    #[arg(long, value_name = "N", default_value = "0", requires = "traced", value_parser = values::seed,
          allow_negative_numbers = true)]
    pub seed: u64,
    /// Trace red, green and blue instead of wavelengths: faster, less exact.
    #[arg(long, requires = "traced")]
    pub rgb: bool,
    /// Threads, for all maps; all cores by default.
    #[arg(long, value_name = "N", value_parser = values::threads, allow_negative_numbers = true)]
    pub threads: Option<u16>,
}

impl LightTraceOptions {
    fn settings(&self) -> TraceSettings {
        let simplified =
            if self.rgb { Simplifications::NONE.with(Simplification::Wavelengths) } else { Simplifications::NONE };
        TraceSettings { simplified, most_depth: self.max_depth, seed: self.seed, ..TraceSettings::default() }
    }
}

/// A scene that lights a map by paths.
struct TracedLight {
    scene: TraceScene,
    settings: TraceSettings,
    /// Of each sample of a texel.
    paths: u32,
    lost: AtomicU64,
}

impl TracedLight {
    fn new(args: &BakeArgs, scene: &Scene, frame: &Frame, reporter: &Reporter) -> Self {
        let _busy = reporter.busy("preparing the scene");
        let ready = TraceScene::new(scene, frame);
        ready.oddities().iter().for_each(|oddity| reporter.warning(oddity));
        let paths = args.trace.paths.div_ceil(args.samples);
        TracedLight { scene: ready, settings: args.trace.settings(), paths, lost: AtomicU64::new(0) }
    }

    fn at(&self, point: &LitPoint) -> (DVec3, f64) {
        let LitPoint { position, geometric_normal, normal, number } = *point;
        let point = SurfacePoint { position, geometric_normal, normal };
        let light = self.scene.light_at(&self.settings, &point, number, self.paths);
        self.lost.fetch_add(light.lost.into(), Ordering::Relaxed);
        (light.radiance, light.variance)
    }

    fn warn_of_lost(&self, reporter: &Reporter) {
        let lost = self.lost.load(Ordering::Relaxed);
        if lost > 0 {
            reporter.warning(format_args!(
                "{lost} paths were not finite and count as black; the materials or lights are too bright for 32-bit floats"
            ));
        }
    }
}

impl BakeArgs {
    /// Refuses maps for which there is no memory before anything is read.
    fn check_memory(&self) -> Result<(), CliError> {
        let has_exr = self.what.iter().any(|kind| kind.extension() == "exr");
        let bytes = u64::from(self.atlas.size).pow(2) * if has_exr { BYTES_WITH_EXR } else { BYTES_PER_TEXEL };
        let most = self.limits.limits().max_bytes;
        if bytes <= most {
            return Ok(());
        }
        let gib = |bytes: u64| bytes as f64 / f64::from(1 << 30);
        Err(CliError::new(format!(
            "--size {} needs about {:.1} GiB of memory, but --max-memory is {:.1} GiB: choose a smaller size or a larger limit",
            self.atlas.size,
            gib(bytes),
            gib(most)
        )))
    }

    fn load(&self, inputs: &[String], reporter: &Reporter) -> Result<Scene, CliError> {
        let options = SceneOptions {
            light: self.light.clone(),
            shadows: self.shadows,
            limits: self.limits.clone(),
            ..SceneOptions::default()
        };
        loading::load_scene(inputs, &options, reporter)
    }

    fn settings(&self, surface: &SceneSurface) -> BakeSettings {
        let diagonal = surface.mesh.bounds().map_or(0.0, |bounds| f64::from(bounds.size().length()));
        BakeSettings {
            size: self.atlas.size,
            grid: self.samples.isqrt(),
            occlusion_rays: self.occlusion_rays,
            occlusion_distance: self.occlusion_distance.unwrap_or(f64::INFINITY),
            cage_distance: self.cage.unwrap_or(0.05 * diagonal),
        }
    }
}

/// Memory for each texel of a map while it is baked and encoded: its value, its distance, its bytes in the file. Maps are baked one
/// after another, and only their files are kept.
const BYTES_PER_TEXEL: u64 = 28;
const BYTES_WITH_EXR: u64 = 48;

/// Makes the folder.
pub fn run(args: &BakeArgs, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    let times = Times::default();
    check_folder(&args.output, "`gonio bake`")?;
    if args.output.exists() && !args.output.is_dir() {
        return Err(CliError::new(format!("`{}` is a file; name a folder with -o", args.output.display())));
    }
    args.atlas.settings()?;
    args.atlas.checker.as_deref().map_or(Ok(()), crate::output::atomic::check_writable)?;
    if args.trace.traced && !args.what.contains(&MapKind::Light) {
        return Err(CliError::new("--traced is about the map `light`; add it to --what"));
    }
    args.check_memory()?;
    backend::limit_threads(args.trace.threads);
    let scene = {
        let _busy = reporter.busy("reading the model");
        times.measure("load", || args.load(&args.inputs, reporter))?
    };
    let finer = args.from.as_ref().map(|from| args.load(std::slice::from_ref(from), reporter)).transpose()?;
    let mut diagnostics = scene.diagnostics.clone();
    let surface = SceneSurface::new(&scene);
    let stem = stem(&args.inputs);
    let names: Vec<&str> = scene.materials.iter().map(|material| material.material.name.as_str()).collect();
    // A finer model has materials of its own.
    let detail = if finer.is_none() { MaterialDetail::new(&scene, &surface, &args.what) } else { None };
    let plain_parts = detail.as_ref().filter(|_| args.atlas.density.is_empty() && !args.atlas.keep_uvs);
    let plain_parts = plain_parts.map_or(0, MaterialDetail::plain_parts);
    let name = args.inputs.join(", ");
    let atlas =
        times.measure("unwrap", || args.atlas.unwrap(&surface.mesh, &names, detail.as_ref(), &name, reporter))?;
    let uv = times.measure("measure", || uv_report(&surface.mesh, &atlas, args.atlas.size));
    if uv.overlapping_texels > 0 {
        diagnostics.push(Diagnostic::warning(format!(
            "charts overlap in {} texels, which can hold the colours of one of them only",
            uv.overlapping_texels
        )));
    }
    let inputs = Inputs { args, scene: &scene, surface: &surface, atlas: &atlas, stem: &stem };
    let maps = bake_maps(&inputs, finer.as_ref(), &times, reporter)?;
    let outputs = {
        let _busy = reporter.busy("writing the files");
        times.measure("write", || inputs.write(&maps, &mut diagnostics))?
    };
    reporter.diagnostics(&diagnostics);
    reporter.verbose_times(&times);
    let report = AtlasReport {
        command: "bake",
        inputs: &args.inputs,
        outputs: &outputs,
        uv: &uv,
        plain_parts,
        maps: &maps.iter().map(|map| map.file.kind.name()).collect::<Vec<_>>(),
        light_error: maps.iter().find_map(|map| map.relative_error),
    };
    report.print(args.general.quiet, &diagnostics, &times, reporter)?;
    Ok(CommandOutcome::Done)
}

/// A baked map as it is written.
struct EncodedMap {
    file: MapFile,
    bytes: Vec<u8>,
    /// The standard error of each texel, as a file.
    error_bytes: Option<Vec<u8>>,
    /// [`BakedMap::relative_error`].
    relative_error: Option<f64>,
}

impl EncodedMap {
    fn new(map: &BakedMap, stem: &str) -> Result<Self, CliError> {
        let name = map.kind.file_name(stem);
        Ok(EncodedMap {
            file: MapFile { kind: map.kind, name, factor: map.factor() },
            bytes: map.encode()?,
            error_bytes: map.encode_standard_error().transpose()?,
            relative_error: map.relative_error(),
        })
    }
}

fn bake_maps(
    inputs: &Inputs,
    finer: Option<&Scene>,
    times: &Times,
    reporter: &Reporter,
) -> Result<Vec<EncodedMap>, CliError> {
    let Inputs { args, scene, surface, atlas, stem } = *inputs;
    let frame = scene.frame(0.0);
    let finer = finer.map(|finer| (finer, SceneSurface::new(finer)));
    let lit_scene = finer.as_ref().map_or(scene, |(finer, _)| *finer);
    let traced = args.trace.traced.then(|| TracedLight::new(args, lit_scene, &frame, reporter));
    let light_at = traced.as_ref().map(|traced| move |point: &LitPoint| traced.at(point));
    let mut baker = Baker::new(scene, &frame, surface, atlas, args.settings(surface));
    if let Some((scene, surface)) = &finer {
        baker = baker.from_finer(scene, surface);
    }
    if let Some(light_at) = &light_at {
        baker = baker.with_light(light_at);
    }
    let mut maps: Vec<EncodedMap> = Vec::new();
    for &kind in &args.what {
        if maps.iter().any(|map| map.file.kind == kind) {
            continue;
        }
        let progress = reporter.progress(kind.name());
        let baked = times.measure("bake", || {
            baker.bake(kind, &|share| {
                progress.set(share);
                true
            })
        });
        let baked = baked.ok_or_else(|| CliError::new("baking was stopped"))?;
        maps.push(times.measure("encode", || EncodedMap::new(&baked, stem))?);
    }
    if let Some(traced) = &traced {
        traced.warn_of_lost(reporter);
    }
    Ok(maps)
}

/// The name of the first input without folders and extension.
fn stem(inputs: &[String]) -> String {
    let first = inputs.first().map_or("", |input| input.strip_prefix("builtin:").unwrap_or(input));
    let name = Path::new(first).file_name().unwrap_or_default().to_string_lossy().into_owned();
    let name = name.split('.').next().unwrap_or_default().to_owned();
    if name.is_empty() || name == "-" { "model".to_owned() } else { name }
}

/// What is baked.
struct Inputs<'a> {
    args: &'a BakeArgs,
    scene: &'a Scene,
    surface: &'a SceneSurface,
    atlas: &'a AtlasUv,
    /// The names of the files begin with it.
    stem: &'a str,
}

impl Inputs<'_> {
    /// Writes all files or none; returns their paths.
    fn write(&self, maps: &[EncodedMap], diagnostics: &mut Vec<Diagnostic>) -> Result<Vec<String>, CliError> {
        let named: Vec<MapFile> = maps.iter().map(|map| map.file.clone()).collect();
        let model = |set| baked_model(self.scene, self.surface, self.atlas, &named, set);
        let baked = model(AtlasSet::Only);
        let second = self.args.atlas.second_uv.then(|| model(AtlasSet::Second));
        if !baked.lost.is_empty() {
            diagnostics.push(Diagnostic::warning(format!(
                "textures were not baked and are left out{}, as they belong to the old coordinates: {}",
                if second.is_some() { " of the .obj file" } else { "" },
                baked.lost.join(", ")
            )));
        }
        if let Some(second) = second.as_ref().filter(|second| !second.lost.is_empty()) {
            let lost = second.lost.join(", ");
            diagnostics.push(Diagnostic::warning(format!("textures that glTF cannot store are left out: {lost}")));
        }
        let obj = write::obj::write(&baked.model, &format!("{}.mtl", self.stem));
        let bytes_of = |file: &str| maps.iter().find(|map| map.file.name == file).map(|map| map.bytes.clone());
        let in_glb = second.as_ref().map_or(&baked.model, |second| &second.model);
        let glb = write::glb::write(in_glb, &mut |map| bytes_of(&map.path))
            .map_err(|error| CliError::new(format!("`{}.glb` cannot be written: {error}", self.stem)))?;
        diagnostics.extend(obj.diagnostics);
        diagnostics.extend(glb.diagnostics);
        let layout = layout::draw_layout(self.atlas, self.args.atlas.size);
        let layout = encode8(&layout, ColorTag::Srgb)?;
        let mut files: Vec<(String, &[u8])> = maps.iter().map(|map| (map.file.name.clone(), &*map.bytes)).collect();
        for map in maps {
            let name = format!("{}_{}-error.exr", self.stem, map.file.kind.name());
            files.extend(map.error_bytes.as_deref().map(|bytes| (name, bytes)));
        }
        files.push((format!("{}_layout.png", self.stem), &layout));
        files.push((obj.mtl_name, &obj.mtl));
        files.push((format!("{}.glb", self.stem), &glb.bytes));
        files.push((format!("{}.obj", self.stem), &obj.obj));
        self.commit(&files)
    }

    fn commit(&self, files: &[(String, &[u8])]) -> Result<Vec<String>, CliError> {
        let drawn = self.args.atlas.checker.as_ref().map(|path| Ok::<_, CliError>((path, self.checker()?)));
        let checker = drawn.transpose()?;
        let mut written = OutputFiles::new();
        written.make_folder(&self.args.output)?;
        let mut paths = Vec::new();
        for (name, bytes) in files {
            let path = self.args.output.join(name);
            self.check_not_input(&path)?;
            written.add(&path, bytes)?;
            paths.push(path.display().to_string());
        }
        if let Some((path, bytes)) = checker {
            self.check_not_input(path)?;
            written.add(path, &bytes)?;
            paths.push(path.display().to_string());
        }
        written.commit()?;
        Ok(paths)
    }

    /// The surface with a checker, as the scene's camera sees it.
    fn checker(&self) -> Result<Vec<u8>, CliError> {
        checker_picture(self.scene.clone(), self.surface.mesh.with_corner_tex_coords(&self.atlas.tex_coords))
    }

    /// The original must stay as it is.
    fn check_not_input(&self, path: &Path) -> Result<(), CliError> {
        let Ok(target) = path.canonicalize() else { return Ok(()) };
        let is_read = |input: &String| Path::new(input).canonicalize().is_ok_and(|input| input == target);
        if self.args.inputs.iter().chain(&self.args.from).any(is_read) {
            return Err(CliError::new(format!(
                "`{}` would replace the model that is baked; name another folder with -o",
                path.display()
            )));
        }
        Ok(())
    }
}
