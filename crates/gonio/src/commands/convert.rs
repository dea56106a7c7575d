//! `gonio convert`: a model in another format.

use crate::commands::scene::seen_from;
use crate::error::{CliError, CommandOutcome};
use crate::options::{GeneralOptions, LimitOptions, values};
use crate::output::{OutputFiles, OutputKind, OutputPath, check_stdout};
use crate::report::Reporter;
use clap::Args;
use gonio_mesh::Model;
use gonio_mesh::write::ply::PlyEncoding;
use gonio_scene::convert::{ConvertedModel, ModelFormat, ModelTextures, TexturePlacement};
use gonio_scene::model_file::ModelFile;
use std::path::{Path, PathBuf};

/// Convert a model to OBJ with MTL, PLY or GLB.
#[derive(Args, Debug)]
#[command(after_long_help = "\
Examples:
  gonio convert model.glb model.obj
      Writes model.obj, model.mtl, and each picture inside model.glb as model_NAME.png.
  gonio convert scan.ply.zst scan.glb
  gonio convert model.obj model.ply --ascii
  curl https://example.com/model.stl | gonio convert - model.obj
  gonio convert model.obj - --format glb > model.glb

The extension of OUT determines the format: .obj, .ply or .glb. Textures in files stay where they are, and OUT refers to them by \
paths relative to its folder; a .glb contains them. Warnings report what the format cannot represent.")]
pub struct ConvertArgs {
    /// Model (.obj .gltf .glb .dae .ply .stl .mesh .meshb, also .gz and .zst), - for stdin, or builtin:NAME.
    #[arg(value_name = "IN")]
    pub input: String,
    /// File to write: .obj, .ply or .glb; - is stdout.
    #[arg(value_name = "OUT")]
    pub output: OutputPath,
    /// Format, if no extension determines it (stdout).
    #[arg(long, help_heading = "Output options", value_parser = values::named(ModelFormat::ALL, ModelFormat::name))]
    pub format: Option<ModelFormat>,
    /// Write PLY as text.
    #[arg(long, help_heading = "Output options")]
    pub ascii: bool,
    #[command(flatten)]
    pub limits: LimitOptions,
    #[command(flatten)]
    pub general: GeneralOptions,
}

pub fn run(args: &ConvertArgs, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    let format = format_of(args)?;
    if args.ascii && format != ModelFormat::Ply {
        return Err(CliError::new("--ascii applies to .ply only; .obj is always text, and .glb never"));
    }
    check_stdout([(&args.output, OutputKind::Binary)], reporter)?;
    args.output.check_writable()?;
    let files = args.limits.files([args.input.as_str()], reporter);
    let mut file = {
        let _busy = reporter.busy("reading the model");
        ModelFile::open(&args.input, &files, &args.limits.limits())?
    };
    let mut diagnostics = std::mem::take(&mut file.model.diagnostics);
    let textures = ModelTextures::find(&file, &files, &mut diagnostics);
    let mut model = std::mem::take(&mut file.model);
    let written = {
        let _busy = reporter.busy("writing the model");
        let encoding = if args.ascii { PlyEncoding::Ascii } else { PlyEncoding::Binary };
        convert_for(&args.output, &mut model, &textures, format, encoding)?
    };
    diagnostics.extend(written.diagnostics);
    reporter.diagnostics(&diagnostics);
    let beside: Vec<(PathBuf, Vec<u8>)> =
        written.beside.into_iter().map(|(name, bytes)| (path_beside(&args.output, &name), bytes)).collect();
    let paths = beside.iter().map(|(path, _)| path.display().to_string());
    let outputs: Vec<String> = std::iter::once(args.output.to_string()).chain(paths).collect();
    write_files(&args.output, written.main, &beside)?;
    if reporter.json() {
        reporter.report(&serde_json::json!({
            "command": "convert",
            "input": args.input,
            "format": file.format,
            "vertices": model.mesh.positions.len(),
            "triangles": model.mesh.triangle_count(),
            "outputs": outputs,
            "warnings": diagnostics,
        }))?;
    }
    Ok(CommandOutcome::Done)
}

fn format_of(args: &ConvertArgs) -> Result<ModelFormat, CliError> {
    let Some(path) = args.output.file() else {
        return args.format.ok_or_else(|| CliError::new("stdout has no extension; add --format obj, ply or glb"));
    };
    args.format.map_or_else(|| format_of_path(path), Ok)
}

/// The format of a file by its extension.
pub fn format_of_path(path: &Path) -> Result<ModelFormat, CliError> {
    ModelFormat::of_path(path).ok_or_else(|| {
        CliError::new(format!("`{}` cannot be written: expected an extension .obj, .ply or .glb", path.display()))
    })
}

/// Writes a model for `output`, naming its textures relative to that file's folder.
pub fn convert_for(
    output: &OutputPath,
    model: &mut Model,
    textures: &ModelTextures,
    format: ModelFormat,
    encoding: PlyEncoding,
) -> Result<ConvertedModel, CliError> {
    let path = path_of(output);
    let folder = path.parent().unwrap_or(Path::new(""));
    let name = |texture: &Path| seen_from(folder, &texture.to_string_lossy());
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    ConvertedModel::new(model, textures, TexturePlacement::Stay(&name), &stem, format, encoding)
        .map_err(|error| CliError::new(format!("`{output}` cannot be written: {error}")))
}

/// The path of a file beside the output.
pub fn path_beside(output: &OutputPath, name: &str) -> PathBuf {
    path_of(output).with_file_name(name)
}

/// The path that files beside the output are named after; those of stdout are in the current folder.
fn path_of(output: &OutputPath) -> &Path {
    output.file().unwrap_or(Path::new("stdout"))
}

/// Writes the model, after the files that it refers to.
fn write_files(output: &OutputPath, main: Vec<u8>, beside: &[(PathBuf, Vec<u8>)]) -> Result<(), CliError> {
    if output.is_stdout() && !beside.is_empty() {
        return Err(CliError::new(format!(
            "this model takes {} files, and stdout takes one: name a file, or add --format glb",
            beside.len() + 1
        )));
    }
    if beside.is_empty() {
        return output.write(&main);
    }
    let mut files = OutputFiles::new();
    for (path, bytes) in beside.iter().rev() {
        files.add(path, bytes)?;
    }
    files.add_output(output, main)?;
    files.commit()
}
