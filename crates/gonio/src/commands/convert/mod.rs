//! `gonio convert`: a model in another format.

mod textures;

use crate::cli::{GeneralOptions, LimitOptions};
use crate::output::path::check_stdout;
use crate::output::{Content, FileSet, OutputPath};
use crate::report::{CliError, Outcome, Reporter};
use crate::values;
use clap::Args;
use gonio_mesh::write::{self, ImageFile};
use gonio_mesh::{Diagnostic, Model};
use gonio_scene::model_file::ModelFile;
use std::path::{Path, PathBuf};
use textures::Textures;

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
    #[arg(long, help_heading = "Output options", value_parser = values::named(Format::ALL, Format::name))]
    pub format: Option<Format>,
    /// Write PLY as text.
    #[arg(long, help_heading = "Output options")]
    pub ascii: bool,
    #[command(flatten)]
    pub limits: LimitOptions,
    #[command(flatten)]
    pub general: GeneralOptions,
}

/// The formats that can be written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    Obj,
    Ply,
    Glb,
}

impl Format {
    const ALL: &'static [Self] = &[Self::Obj, Self::Ply, Self::Glb];

    /// The extension.
    fn name(self) -> &'static str {
        match self {
            Self::Obj => "obj",
            Self::Ply => "ply",
            Self::Glb => "glb",
        }
    }
}

pub fn run(args: &ConvertArgs, reporter: &Reporter) -> Result<Outcome, CliError> {
    let format = format_of(args)?;
    if args.ascii && format != Format::Ply {
        return Err(CliError::new("--ascii applies to .ply only; .obj is always text, and .glb never"));
    }
    check_stdout([(&args.output, Content::Binary)], reporter)?;
    args.output.check_writable()?;
    let files = args.limits.files([args.input.as_str()], reporter);
    let mut file = {
        let _busy = reporter.busy("reading the model");
        ModelFile::open(&args.input, &files, &args.limits.limits())?
    };
    let mut diagnostics = std::mem::take(&mut file.model.diagnostics);
    let textures = Textures::find(&file, &files, &mut diagnostics);
    let mut model = std::mem::take(&mut file.model);
    let written = {
        let _busy = reporter.busy("writing the model");
        match format {
            Format::Obj => obj_files(&mut model, textures, &args.output),
            Format::Ply => ply_files(&mut model, textures, args),
            Format::Glb => glb_file(&model, &textures, &args.output)?,
        }
    };
    diagnostics.extend(written.diagnostics);
    reporter.diagnostics(&diagnostics);
    let beside = written.beside.iter().map(|(path, _)| path.display().to_string());
    let outputs: Vec<String> = std::iter::once(args.output.to_string()).chain(beside).collect();
    write_files(&args.output, written.main, &written.beside)?;
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

fn format_of(args: &ConvertArgs) -> Result<Format, CliError> {
    let Some(path) = args.output.file() else {
        return args.format.ok_or_else(|| CliError::new("stdout has no extension; add --format obj, ply or glb"));
    };
    let extension = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase()).unwrap_or_default();
    let by_name = Format::ALL.iter().copied().find(|format| format.name() == extension);
    args.format.or(by_name).ok_or_else(|| {
        CliError::new(format!("`{}` cannot be written: expected an extension .obj, .ply or .glb", path.display()))
    })
}

/// A converted model.
struct Converted {
    /// The bytes of the file that OUT names.
    main: Vec<u8>,
    /// The files beside it that it refers to.
    beside: Vec<(PathBuf, Vec<u8>)>,
    diagnostics: Vec<Diagnostic>,
}

/// The path that files beside the output are named after; those of stdout are in the current folder.
fn path_of(output: &OutputPath) -> &Path {
    output.file().unwrap_or(Path::new("stdout"))
}

fn obj_files(model: &mut Model, textures: Textures, output: &OutputPath) -> Converted {
    let path = path_of(output);
    textures.name_for(model, path);
    let files = write::obj::write(model, &format!("{}.mtl", stem_of(path)));
    let mut beside = Vec::new();
    if !files.mtl.is_empty() {
        beside.push((path.with_file_name(&files.mtl_name), files.mtl));
    }
    beside.extend(image_files(model, &files.images, path));
    Converted { main: files.obj, beside, diagnostics: files.diagnostics }
}

fn ply_files(model: &mut Model, textures: Textures, args: &ConvertArgs) -> Converted {
    let path = path_of(&args.output);
    let encoding = if args.ascii { write::ply::Encoding::Ascii } else { write::ply::Encoding::Binary };
    textures.name_for(model, path);
    let files = write::ply::write(model, &stem_of(path), encoding);
    let beside = image_files(model, &files.images, path).collect();
    Converted { main: files.ply, beside, diagnostics: files.diagnostics }
}

fn glb_file(model: &Model, textures: &Textures, output: &OutputPath) -> Result<Converted, CliError> {
    let glb = write::glb::write(model, &mut |map| textures.bytes(&map.path))
        .map_err(|error| CliError::new(format!("`{output}` cannot be written: {error}")))?;
    Ok(Converted { main: glb.bytes, beside: Vec::new(), diagnostics: glb.diagnostics })
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
    let mut files = FileSet::new();
    for (path, bytes) in beside.iter().rev() {
        files.add(path, bytes)?;
    }
    files.add_output(output, main)?;
    files.commit()
}

/// The pictures inside the model, as files beside it.
fn image_files<'m>(
    model: &'m Model,
    images: &'m [ImageFile],
    output: &'m Path,
) -> impl Iterator<Item = (PathBuf, Vec<u8>)> + 'm {
    images.iter().filter_map(move |file| {
        let image = model.images.get(file.image)?;
        Some((output.with_file_name(&file.name), image.bytes.clone()))
    })
}

fn stem_of(output: &Path) -> String {
    output.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}
