//! `gonio unwrap`: new texture coordinates for a model. The work is `gonio-atlas`'s; this module has the options and files.

use crate::commands::convert::{ConvertedModel, ModelFormat, Textures};
use crate::error::{CliError, CommandOutcome};
use crate::loading;
use crate::options::{GeneralOptions, LimitOptions, SceneOptions, values};
use crate::output::{OutputFiles, OutputPath, color_tag};
use crate::report::{Reporter, Times};
use crate::terminal::TerminalPage;
use clap::{ArgAction, Args};
use gonio_atlas::{AtlasUv, UnwrapSettings, UvReport, UvSource, layout, unwrap, uv_report};
use gonio_image::encode::png::{ColorTag, encode8};
use gonio_mesh::write::ply::PlyEncoding;
use gonio_mesh::{Diagnostic, Material, Mesh, Part};
use gonio_reference::ReferenceScene;
use gonio_scene::model_file::ModelFile;
use gonio_scene::{BoundTexture, ColorSpace, DisplayMap, SceneMaterial, Texture};
use std::path::PathBuf;
use std::sync::Arc;

/// Give a model new texture coordinates: charts without overlaps, packed into one square.
#[derive(Args, Debug)]
#[command(after_long_help = "\
Examples:
  gonio unwrap model.obj -o unwrapped.obj --layout layout.png
      New texture coordinates for all objects of the model in one atlas, and a picture of it.
  gonio unwrap model.obj --checker checker.png
      A picture of the model with a checker, whose squares show how the new coordinates stretch it.
  gonio unwrap model.obj --keep-uvs --layout layout.png
      A report on the model's own coordinates: overlaps, stretch, coverage. Nothing else is written.
  gonio unwrap model.obj -o packed.glb --repack --margin-texels 8 --size 2048
      The model's own charts, packed again with equal texel density.
  gonio unwrap model.obj -o unwrapped.obj --density head=2
      Twice as many texels per unit of length in the part or material `head` as elsewhere.
  gonio unwrap model.obj -o lightmapped.glb --second-uv
      The model's own coordinates and textures stay; the new coordinates are a second set (TEXCOORD_1).

The new coordinates do not fit the model's textures, so OUT has its materials without them, unless --keep-uvs or --second-uv is \
given. Only .glb has a second set: OBJ and PLY have one. MODEL itself never changes.

Charts hold triangles whose normals are within --angle-limit of the chart's axis, as in Blender's smart projection. They are laid flat \
by least-squares conformal maps (Lévy et al., 2002) and then as rigidly as possible (Liu et al., 2008).

Exit codes: 0 success, 2 error.")]
pub struct UnwrapArgs {
    /// Model (.obj .gltf .glb .dae .ply .stl .mesh .meshb, also .gz and .zst), - for stdin, or builtin:NAME.
    #[arg(value_name = "MODEL")]
    pub input: String,
    /// Model to write: .obj, .ply or .glb.
    #[arg(long, short, help_heading = "Output options", value_name = "OUT")]
    pub output: Option<PathBuf>,
    #[command(flatten)]
    pub atlas: AtlasOptions,
    /// Picture of the atlas to write, --size pixels along a side.
    #[arg(long, help_heading = "Output options", value_name = "FILE.png")]
    pub layout: Option<PathBuf>,
    /// Picture of the model to write, with a checker in the new coordinates.
    #[arg(long, help_heading = "Output options", value_name = "FILE.png")]
    pub checker: Option<PathBuf>,
    #[command(flatten)]
    pub limits: LimitOptions,
    #[command(flatten)]
    pub general: GeneralOptions,
}

/// Options of a texture atlas.
#[derive(Args, Debug, Clone)]
#[command(next_help_heading = "Atlas options")]
pub struct AtlasOptions {
    /// Texels along a side of the texture.
    #[arg(long, value_name = "N", default_value = "1024", value_parser = values::texture_size)]
    pub size: u32,
    /// Distance between charts as a share of the side; half of it stays free along the sides.
    #[arg(long, value_name = "SHARE", default_value = "0.01", value_parser = values::margin, allow_negative_numbers = true)]
    pub margin: f64,
    /// Distance between charts in texels, in place of --margin.
    #[arg(long, value_name = "N", conflicts_with = "margin")]
    pub margin_texels: Option<u16>,
    /// Largest angle between a triangle and the axis of its chart, in degrees.
    #[arg(long, value_name = "DEGREES", default_value = "66", value_parser = values::chart_angle, allow_negative_numbers = true)]
    pub angle_limit: f64,
    /// Keep the model's own texture coordinates.
    #[arg(long, conflicts_with = "repack")]
    pub keep_uvs: bool,
    /// Keep the charts of the model's own texture coordinates, but pack them again.
    #[arg(long)]
    pub repack: bool,
    /// Texels per unit of length in the parts or the material NAME, relative to all others; repeat it for several.
    #[arg(long, value_name = "NAME=FACTOR", action = ArgAction::Append, value_parser = values::density,
          conflicts_with = "keep_uvs")]
    pub density: Vec<values::Density>,
    /// Keep the model's own texture coordinates as the first set, with its textures; the atlas is the second set of the .glb file.
    #[arg(long, conflicts_with = "keep_uvs")]
    pub second_uv: bool,
}

impl AtlasOptions {
    pub fn settings(&self) -> Result<UnwrapSettings, CliError> {
        let margin = match self.margin_texels {
            Some(texels) if 4 * u32::from(texels) > self.size => {
                return Err(CliError::new(format!(
                    "a margin of {texels} texels is too large for --size {}: expected at most {}",
                    self.size,
                    self.size / 4
                )));
            }
            Some(texels) => f64::from(texels) / f64::from(self.size),
            None => self.margin,
        };
        let source = match (self.keep_uvs, self.repack) {
            (true, _) => UvSource::Kept,
            (_, true) => UvSource::Repacked,
            _ => UvSource::New,
        };
        let angle_limit_rad = self.angle_limit.to_radians();
        Ok(UnwrapSettings { angle_limit_rad, margin, source, density_of_part: Vec::new() })
    }

    /// The density of each part; a later option replaces an earlier one.
    fn densities(&self, mesh: &Mesh, material_names: &[&str]) -> Result<Vec<f64>, CliError> {
        let mut densities = vec![1.0; if self.density.is_empty() { 0 } else { mesh.parts.len() }];
        for values::Density { name, factor } in &self.density {
            let is_named =
                |part: &Part| part.name == *name || material_names.get(part.material) == Some(&name.as_str());
            let mut found = false;
            for (density, _) in densities.iter_mut().zip(&mesh.parts).filter(|(_, part)| is_named(part)) {
                (*density, found) = (*factor, true);
            }
            if !found {
                let parts = mesh
                    .parts
                    .iter()
                    .flat_map(|part| [Some(&part.name[..]), material_names.get(part.material).copied()]);
                let mut known: Vec<&str> = parts.flatten().filter(|name| !name.is_empty()).collect();
                known.sort_unstable();
                known.dedup();
                let known =
                    if known.is_empty() { "it has no names".into() } else { format!("it has {}", known.join(", ")) };
                return Err(CliError::new(format!("the model has no part and no material named `{name}`: {known}")));
            }
        }
        Ok(densities)
    }

    /// Unwraps a mesh with a progress bar. Warns if the margin had to be reduced.
    pub fn unwrap(
        &self,
        mesh: &Mesh,
        material_names: &[&str],
        name: &str,
        reporter: &Reporter,
    ) -> Result<AtlasUv, CliError> {
        if self.second_uv && mesh.tex_coords.is_empty() {
            return Err(CliError::new(format!(
                "{name}: the model has no texture coordinates that could be the first set; leave --second-uv out"
            )));
        }
        let settings = UnwrapSettings { density_of_part: self.densities(mesh, material_names)?, ..self.settings()? };
        let progress = reporter.progress("unwrapping");
        let atlas = unwrap(mesh, &settings, &|share| {
            progress.set(share);
            true
        })
        .map_err(|error| CliError::new(format!("{name}: {error}")))?;
        drop(progress);
        if settings.source != UvSource::Kept && atlas.margin < 0.999 * settings.margin {
            let texels = atlas.margin * f64::from(self.size);
            reporter.warning(format_args!(
                "{} charts leave no room for the margin: it is {texels:.2} texels instead of {:.2}",
                atlas.chart_count,
                settings.margin * f64::from(self.size)
            ));
        }
        Ok(atlas)
    }
}

pub fn run(args: &UnwrapArgs, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    let times = Times::default();
    let output = args.output.clone().map(OutputPath::File);
    let format = args.output.as_deref().map(ModelFormat::of_path).transpose()?;
    args.atlas.settings()?;
    if args.atlas.second_uv && format.is_some_and(|format| format != ModelFormat::Glb) {
        return Err(CliError::new("--second-uv needs a .glb file: OBJ and PLY have one set of texture coordinates"));
    }
    for path in output.iter().filter_map(OutputPath::file).chain(args.layout.as_deref()).chain(args.checker.as_deref())
    {
        crate::output::atomic::check_writable(path)?;
    }
    let files = args.limits.files([args.input.as_str()], reporter);
    let mut file = {
        let _busy = reporter.busy("reading the model");
        times.measure("read", || ModelFile::open(&args.input, &files, &args.limits.limits()))?
    };
    let mut diagnostics = std::mem::take(&mut file.model.diagnostics);
    let mut model = std::mem::take(&mut file.model);
    let names: Vec<&str> = model.materials.iter().map(|material| material.name.as_str()).collect();
    let atlas = times.measure("unwrap", || args.atlas.unwrap(&model.mesh, &names, &args.input, reporter))?;
    let report = times.measure("measure", || uv_report(&model.mesh, &atlas, args.atlas.size));
    let mut written = OutputFiles::new();
    if let (Some(output), Some(format)) = (&output, format) {
        let _busy = reporter.busy("writing the model");
        model.mesh = if args.atlas.second_uv {
            model.mesh.with_second_corner_tex_coords(&atlas.tex_coords)
        } else {
            model.mesh.with_corner_tex_coords(&atlas.tex_coords)
        };
        file.model = model;
        if !args.atlas.keep_uvs && !args.atlas.second_uv {
            drop_textures(&mut file, &mut diagnostics);
        }
        let textures = Textures::find(&file, &files, &mut diagnostics);
        let converted = ConvertedModel::new(&mut file.model, textures, output, format, PlyEncoding::Binary)?;
        diagnostics.extend(converted.diagnostics);
        for (path, bytes) in converted.beside.iter().rev() {
            written.add(path, bytes)?;
        }
        written.add_output(output, converted.main)?;
    }
    if let Some(path) = &args.layout {
        let picture = times.measure("layout", || layout::draw_layout(&atlas, args.atlas.size));
        written.add(path, &encode8(&picture, ColorTag::Srgb)?)?;
    }
    if let Some(path) = &args.checker {
        let _busy = reporter.busy("drawing the checker");
        written.add(path, &times.measure("checker", || checker_picture(args, &atlas, reporter))?)?;
    }
    reporter.diagnostics(&diagnostics);
    written.commit()?;
    reporter.verbose_times(&times);
    print_report(args, &report, &diagnostics, &times, reporter)?;
    Ok(CommandOutcome::Done)
}

fn print_report(
    args: &UnwrapArgs,
    report: &UvReport,
    diagnostics: &[Diagnostic],
    times: &Times,
    reporter: &Reporter,
) -> Result<(), CliError> {
    if reporter.json() {
        return reporter.report(&serde_json::json!({
            "command": "unwrap",
            "input": args.input,
            "output": args.output,
            "layout": args.layout,
            "checker": args.checker,
            "uv": report,
            "warnings": diagnostics,
            "times_ms": times.to_json(),
        }));
    }
    if args.general.quiet { Ok(()) } else { reporter.text(&text(report)) }
}

/// Squares along a side of the checker, and texels along a side.
const CHECKER: (u32, u32) = (32, 1024);

/// Draws the model with a checker in the atlas, as PNG.
fn checker_picture(args: &UnwrapArgs, atlas: &AtlasUv, reporter: &Reporter) -> Result<Vec<u8>, CliError> {
    let options = SceneOptions { limits: args.limits.clone(), size: Some((1024, 768)), ..SceneOptions::default() };
    let mut scene = loading::load_scene(std::slice::from_ref(&args.input), &options, reporter)?;
    let (squares, size) = CHECKER;
    let rgba = layout::draw_checker(size, squares).rgba;
    scene.textures = vec![Arc::new(Texture::new("checker", size, size, rgba, ColorSpace::Srgb))];
    for mesh in &mut scene.meshes {
        *mesh = Arc::new(mesh.with_corner_tex_coords(&atlas.tex_coords));
    }
    let material = Material { diffuse: [1.0; 3], specular: [0.0; 3], ..Material::default() };
    let mut material = SceneMaterial::from(material);
    material.maps.diffuse = Some(BoundTexture::plain(0));
    scene.materials = vec![material; scene.materials.len()];
    let frame = scene.frame(0.0);
    let rendered = ReferenceScene::new(&scene).render(&frame, None, &|_| ());
    let map = DisplayMap::for_view(None, &frame);
    Ok(encode8(&rendered.picture.encode8(&map), color_tag(&map))?)
}

/// The textures belong to the old coordinates.
fn drop_textures(file: &mut ModelFile, diagnostics: &mut Vec<Diagnostic>) {
    if file.model.materials.iter().all(|material| material.textures().next().is_none()) {
        return;
    }
    for material in &mut file.model.materials {
        material.drop_textures();
    }
    diagnostics.push(Diagnostic::note("the model's textures do not fit its new coordinates and are left out"));
}

/// The figures of a report, one per line.
pub fn text(report: &UvReport) -> TerminalPage {
    let mut page = TerminalPage::new();
    let mut line = |name: &str, value: String| page.line(format_args!("{name:20}{value}"));
    line("charts", report.charts.to_string());
    line("triangles", report.triangles.to_string());
    for (name, count) in [
        ("degenerate", report.degenerate_triangles),
        ("collapsed", report.collapsed_triangles),
        ("mirrored", report.mirrored_triangles),
    ] {
        if count > 0 {
            line(&format!("  {name}"), count.to_string());
        }
    }
    line("coverage", format!("{:.1} %", 100.0 * report.coverage));
    line("overlaps", format!("{} of {} texels", report.overlapping_texels, u64::from(report.size).pow(2)));
    line("angle stretch", format!("{:.3} (1 keeps angles)", report.angle_stretch));
    line("area stretch", format!("{:.3} (1 keeps areas)", report.area_stretch));
    line("density", format!("{:.4} texels per unit of length", report.texels_per_unit));
    if report.margin_texels > 0.0 {
        line("margin", format!("{:.1} texels", report.margin_texels));
    }
    page
}
