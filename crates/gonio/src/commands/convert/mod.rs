//! `gonio convert`: a model in another format.

mod textures;

use crate::cli::{LimitOptions, WordOptions};
use crate::output::{FileSet, atomic};
use crate::report::{CliError, Outcome, Reporter};
use clap::Args;
use gonio_mesh::write::{self, ImageFile};
use gonio_mesh::{Diagnostic, Model};
use gonio_scene::model_file::ModelFile;
use std::path::{Path, PathBuf};
use textures::Textures;

/// Write a model as OBJ with MTL, as PLY or as GLB.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  gonio convert model.glb model.obj
      model.obj, model.mtl, and each picture inside model.glb as model_NAME.png.
  gonio convert scan.ply.zst scan.glb
  gonio convert model.obj model.ply --ascii
  curl https://example.com/model.stl | gonio convert - model.obj

The ending of OUT decides: .obj, .ply or .glb. Textures that are files stay where they are: OUT names them as they are
seen from its folder; a .glb has them inside. What a format cannot hold is said.")]
pub struct ConvertArgs {
    /// A model (.obj .gltf .glb .dae .ply .stl .mesh .meshb, also .gz and .zst), - for stdin, or builtin:NAME.
    #[arg(value_name = "IN")]
    pub input: String,
    /// The file to write: .obj, .ply or .glb.
    #[arg(value_name = "OUT")]
    pub output: PathBuf,
    /// Write PLY as text.
    #[arg(long, help_heading = "Output")]
    pub ascii: bool,
    /// What a file may make us allocate.
    #[command(flatten)]
    pub limits: LimitOptions,
    /// What is said.
    #[command(flatten)]
    pub words: WordOptions,
}

/// What can be written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Obj,
    Ply,
    Glb,
}

/// Converts.
pub fn run(args: &ConvertArgs, reporter: &Reporter) -> Result<Outcome, CliError> {
    let format = format_of(&args.output)?;
    if args.ascii && format != Format::Ply {
        return Err(CliError::new("--ascii is for .ply only; .obj is text always, and .glb never"));
    }
    atomic::check_writable(&args.output)?;
    let files = args.limits.files([args.input.as_str()]);
    let mut file = {
        let _busy = reporter.busy("reading the model");
        ModelFile::open(&args.input, &files, &args.limits.limits())?
    };
    let mut diagnostics = std::mem::take(&mut file.model.diagnostics);
    let textures = Textures::find(&file, &files, &mut diagnostics);
    let mut model = std::mem::take(&mut file.model);
    let outputs = {
        let _busy = reporter.busy("writing the model");
        match format {
            Format::Obj => write_obj(&mut model, textures, &args.output, &mut diagnostics)?,
            Format::Ply => write_ply(&mut model, textures, args, &mut diagnostics)?,
            Format::Glb => write_glb(&model, &textures, &args.output, &mut diagnostics)?,
        }
    };
    reporter.diagnostics(&diagnostics);
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
    Ok(Outcome::Done)
}

fn format_of(output: &Path) -> Result<Format, CliError> {
    let extension = output.extension().map(|e| e.to_string_lossy().to_ascii_lowercase()).unwrap_or_default();
    match extension.as_str() {
        "obj" => Ok(Format::Obj),
        "ply" => Ok(Format::Ply),
        "glb" => Ok(Format::Glb),
        _ => {
            let message = format!("`{}` cannot be written: its ending is none of .obj, .ply, .glb", output.display());
            Err(CliError::new(message))
        }
    }
}

fn write_obj(
    model: &mut Model,
    textures: Textures,
    output: &Path,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<Vec<PathBuf>, CliError> {
    textures.name_for(model, output);
    let files = write::obj::write(model, &format!("{}.mtl", stem_of(output)));
    diagnostics.extend(files.diagnostics);
    // What the model names is there before it is.
    let mut set = FileSet::new();
    let mut outputs = add_images(&mut set, model, &files.images, output)?;
    if !files.mtl.is_empty() {
        let path = output.with_file_name(&files.mtl_name);
        set.add(&path, &files.mtl)?;
        outputs.push(path);
    }
    set.add(output, &files.obj)?;
    set.commit()?;
    outputs.push(output.to_owned());
    outputs.reverse();
    Ok(outputs)
}

fn write_ply(
    model: &mut Model,
    textures: Textures,
    args: &ConvertArgs,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<Vec<PathBuf>, CliError> {
    let encoding = if args.ascii { write::ply::Encoding::Ascii } else { write::ply::Encoding::Binary };
    textures.name_for(model, &args.output);
    let files = write::ply::write(model, &stem_of(&args.output), encoding);
    diagnostics.extend(files.diagnostics);
    let mut set = FileSet::new();
    let mut outputs = add_images(&mut set, model, &files.images, &args.output)?;
    set.add(&args.output, &files.ply)?;
    set.commit()?;
    outputs.insert(0, args.output.clone());
    Ok(outputs)
}

fn write_glb(
    model: &Model,
    textures: &Textures,
    output: &Path,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<Vec<PathBuf>, CliError> {
    let glb = write::glb::write(model, &mut |map| textures.bytes(&map.path))
        .map_err(|error| CliError::new(format!("`{}` cannot be written: {error}", output.display())))?;
    diagnostics.extend(glb.diagnostics);
    atomic::write(output, &glb.bytes)?;
    Ok(vec![output.to_owned()])
}

/// Adds the pictures that were inside the model, beside it. Their files.
fn add_images(set: &mut FileSet, model: &Model, images: &[ImageFile], output: &Path) -> Result<Vec<PathBuf>, CliError> {
    let mut written = Vec::new();
    for file in images {
        if let Some(image) = model.images.get(file.image) {
            let path = output.with_file_name(&file.name);
            set.add(&path, &image.bytes)?;
            written.push(path);
        }
    }
    Ok(written)
}

fn stem_of(output: &Path) -> String {
    output.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}
