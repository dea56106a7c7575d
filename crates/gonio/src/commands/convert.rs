//! `gonio convert`: a model in another format.

use crate::commands::scene::seen_from;
use crate::error::{CliError, CommandOutcome};
use crate::options::{GeneralOptions, LimitOptions, values};
use crate::output::{OutputFiles, OutputKind, OutputPath, check_stdout};
use crate::report::Reporter;
use clap::Args;
use gonio_mesh::write::ply::PlyEncoding;
use gonio_mesh::write::{self, ImageFile};
use gonio_mesh::{Diagnostic, EmbeddedImage, FilePlace, Model};
use gonio_scene::files::FileSource;
use gonio_scene::model_file::{ModelFile, TextureFile};
use std::collections::BTreeMap;
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

/// The formats that can be written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ModelFormat {
    Obj,
    Ply,
    Glb,
}

impl ModelFormat {
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

impl ModelFormat {
    /// The format of a file by its extension.
    pub fn of_path(path: &Path) -> Result<Self, CliError> {
        let extension = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase()).unwrap_or_default();
        Self::ALL.iter().copied().find(|format| format.name() == extension).ok_or_else(|| {
            CliError::new(format!("`{}` cannot be written: expected an extension .obj, .ply or .glb", path.display()))
        })
    }
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
    let textures = Textures::find(&file, &files, &mut diagnostics);
    let mut model = std::mem::take(&mut file.model);
    let written = {
        let _busy = reporter.busy("writing the model");
        let encoding = if args.ascii { PlyEncoding::Ascii } else { PlyEncoding::Binary };
        ConvertedModel::new(&mut model, textures, &args.output, format, encoding)?
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
    Ok(CommandOutcome::Done)
}

fn format_of(args: &ConvertArgs) -> Result<ModelFormat, CliError> {
    let Some(path) = args.output.file() else {
        return args.format.ok_or_else(|| CliError::new("stdout has no extension; add --format obj, ply or glb"));
    };
    args.format.map_or_else(|| ModelFormat::of_path(path), Ok)
}

/// A converted model.
pub struct ConvertedModel {
    /// The bytes of the file that OUT names.
    pub main: Vec<u8>,
    /// The files beside it that it refers to.
    pub beside: Vec<(PathBuf, Vec<u8>)>,
    pub diagnostics: Vec<Diagnostic>,
}

impl ConvertedModel {
    /// Writes a model for `output`, naming its textures relative to that file's folder.
    pub fn new(
        model: &mut Model,
        textures: Textures,
        output: &OutputPath,
        format: ModelFormat,
        encoding: PlyEncoding,
    ) -> Result<ConvertedModel, CliError> {
        Ok(match format {
            ModelFormat::Obj => obj_files(model, textures, output),
            ModelFormat::Ply => ply_files(model, textures, output, encoding),
            ModelFormat::Glb => glb_file(model, &textures, output)?,
        })
    }
}

/// The path that files beside the output are named after; those of stdout are in the current folder.
fn path_of(output: &OutputPath) -> &Path {
    output.file().unwrap_or(Path::new("stdout"))
}

fn obj_files(model: &mut Model, textures: Textures, output: &OutputPath) -> ConvertedModel {
    let path = path_of(output);
    textures.name_for(model, path);
    let files = write::obj::write(model, &format!("{}.mtl", stem_of(path)));
    let mut beside = Vec::new();
    if !files.mtl.is_empty() {
        beside.push((path.with_file_name(&files.mtl_name), files.mtl));
    }
    beside.extend(image_files(model, &files.images, path));
    ConvertedModel { main: files.obj, beside, diagnostics: files.diagnostics }
}

fn ply_files(model: &mut Model, textures: Textures, output: &OutputPath, encoding: PlyEncoding) -> ConvertedModel {
    let path = path_of(output);
    textures.name_for(model, path);
    let files = write::ply::write(model, &stem_of(path), encoding);
    let beside = image_files(model, &files.images, path).collect();
    ConvertedModel { main: files.ply, beside, diagnostics: files.diagnostics }
}

fn glb_file(model: &Model, textures: &Textures, output: &OutputPath) -> Result<ConvertedModel, CliError> {
    let glb = write::glb::write(model, &mut |map| textures.bytes(&map.path))
        .map_err(|error| CliError::new(format!("`{output}` cannot be written: {error}")))?;
    Ok(ConvertedModel { main: glb.bytes, beside: Vec::new(), diagnostics: glb.diagnostics })
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

/// The files of all textures that are not inside the model, by their names in the model.
pub struct Textures {
    files: BTreeMap<String, TextureFile>,
}

impl Textures {
    /// Looks for all of them. A missing one is reported and keeps its name.
    pub fn find(file: &ModelFile, files: &dyn FileSource, diagnostics: &mut Vec<Diagnostic>) -> Self {
        let mut textures = Textures { files: BTreeMap::new() };
        let mut missing: Vec<&str> = Vec::new();
        let maps = file.model.materials.iter().flat_map(|material| {
            material.textures().filter(|map| map.embedded.is_none()).map(move |map| (material, map))
        });
        for (material, map) in maps {
            if textures.files.contains_key(&map.path) || missing.contains(&map.path.as_str()) {
                continue;
            }
            match file.texture(&map.path, files) {
                Ok(found) => drop(textures.files.insert(map.path.clone(), found)),
                Err(not_found) => {
                    missing.push(&map.path);
                    let fault = match not_found.refused {
                        Some(refused) => format!("was not read: {refused}"),
                        None => format!("was not found; tried {}", not_found.tried.join(", ")),
                    };
                    let message = format!("the texture {:?} {fault}", map.path);
                    let diagnostic = Diagnostic { place: FilePlace::on_line(map.line), ..Diagnostic::warning(message) };
                    diagnostics.push(diagnostic.in_file(material.file.as_deref().unwrap_or(&file.name)));
                }
            }
        }
        textures
    }

    /// The bytes of the texture that the model calls `name`.
    pub fn bytes(&self, name: &str) -> Option<Vec<u8>> {
        self.files.get(name).map(|file| file.bytes.to_vec())
    }

    /// Names them relative to the folder of `output`; those that are not files of their own are embedded in the model.
    pub fn name_for(self, model: &mut Model, output: &Path) {
        let folder = output.parent().unwrap_or(Path::new(""));
        let mut image_of: BTreeMap<String, usize> = BTreeMap::new();
        for map in model.materials.iter_mut().flat_map(|material| material.textures_mut()) {
            let Some(file) = self.files.get(&map.path).filter(|_| map.embedded.is_none()) else { continue };
            if let Some(path) = &file.path {
                map.path = seen_from(folder, &path.to_string_lossy());
                continue;
            }
            let images = &mut model.images;
            let image = *image_of.entry(map.path.clone()).or_insert_with(|| {
                images.push(EmbeddedImage { name: map.path.clone(), bytes: file.bytes.to_vec() });
                images.len() - 1
            });
            map.embedded = Some(image);
        }
    }
}
