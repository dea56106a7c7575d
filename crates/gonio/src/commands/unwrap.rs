//! `gonio unwrap`: new texture coordinates for a model. The work is `gonio-atlas`'s; this module has the options and files.

use crate::commands::atlas::{AtlasOptions, AtlasReport, checker_picture};
use crate::commands::convert::{convert_for, format_of_path, path_beside};
use crate::error::{CliError, CommandOutcome};
use crate::loading;
use crate::options::{GeneralOptions, LimitOptions, SceneOptions};
use crate::output::{OutputFiles, OutputPath};
use crate::report::{Reporter, Times};
use clap::Args;
use gonio_atlas::{AtlasUv, layout, uv_report};
use gonio_image::encode::png::{ColorTag, encode8};
use gonio_mesh::Diagnostic;
use gonio_mesh::write::ply::PlyEncoding;
use gonio_scene::convert::{ModelFormat, ModelTextures};
use gonio_scene::model_file::ModelFile;
use std::path::PathBuf;

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
    /// Picture of the atlas to write, --size pixels along a side, at most 4096.
    #[arg(long, help_heading = "Output options", value_name = "FILE.png")]
    pub layout: Option<PathBuf>,
    #[command(flatten)]
    pub limits: LimitOptions,
    #[command(flatten)]
    pub general: GeneralOptions,
}

pub fn run(args: &UnwrapArgs, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    let times = Times::default();
    let output = args.output.clone().map(OutputPath::File);
    let format = args.output.as_deref().map(format_of_path).transpose()?;
    args.atlas.settings()?;
    if args.atlas.second_uv && format.is_some_and(|format| format != ModelFormat::Glb) {
        return Err(CliError::new("--second-uv needs a .glb file: OBJ and PLY have one set of texture coordinates"));
    }
    for path in
        output.iter().filter_map(OutputPath::file).chain(args.layout.as_deref()).chain(args.atlas.checker.as_deref())
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
    let atlas = times.measure("unwrap", || args.atlas.unwrap(&model.mesh, &names, None, &args.input, reporter))?;
    let uv = times.measure("measure", || uv_report(&model.mesh, &atlas, args.atlas.size));
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
        let textures = ModelTextures::find(&file, &files, &mut diagnostics);
        let converted = convert_for(output, &mut file.model, &textures, format, PlyEncoding::Binary)?;
        diagnostics.extend(converted.diagnostics);
        for (name, bytes) in converted.beside.iter().rev() {
            written.add(&path_beside(output, name), bytes)?;
        }
        written.add_output(output, converted.main)?;
    }
    if let Some(path) = &args.layout {
        let picture = times.measure("layout", || layout::draw_layout(&atlas, args.atlas.size));
        written.add(path, &encode8(&picture, ColorTag::Srgb)?)?;
    }
    if let Some(path) = &args.atlas.checker {
        let _busy = reporter.busy("drawing the checker");
        written.add(path, &times.measure("checker", || checker(args, &atlas, reporter))?)?;
    }
    reporter.diagnostics(&diagnostics);
    written.commit()?;
    reporter.verbose_times(&times);
    let paths = [&args.output, &args.layout, &args.atlas.checker].into_iter().flatten();
    let outputs: Vec<String> = paths.map(|path| path.display().to_string()).collect();
    let report = AtlasReport {
        command: "unwrap",
        inputs: std::slice::from_ref(&args.input),
        outputs: &outputs,
        uv: &uv,
        plain_parts: 0,
        maps: &[],
        light_error: None,
    };
    report.print(args.general.quiet, &diagnostics, &times, reporter)?;
    Ok(CommandOutcome::Done)
}

/// The model as it is loaded for pictures, with the checker.
fn checker(args: &UnwrapArgs, uv: &AtlasUv, reporter: &Reporter) -> Result<Vec<u8>, CliError> {
    let options = SceneOptions { limits: args.limits.clone(), ..SceneOptions::default() };
    let scene = loading::load_scene(std::slice::from_ref(&args.input), &options, reporter)?;
    let mesh = scene.meshes.first().map(|mesh| mesh.with_corner_tex_coords(&uv.tex_coords)).unwrap_or_default();
    checker_picture(scene, mesh)
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
