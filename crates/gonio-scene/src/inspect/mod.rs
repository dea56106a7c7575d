//! The content of a model file, and its interpretation.

mod differences;
mod materials;

pub use differences::ReaderDifference;
pub use materials::{MaterialReport, ValueReport};

use crate::asset_cache::{NormalChoice, with_normals};
use crate::files::{self, Budgeted, FileBytes, FileSource};
use crate::material_binding::{MaterialBinder, MaterialSource, used_materials};
use crate::material_brdf::BrdfLibrary;
use crate::model_file::{self, ModelFile};
use crate::readers::PictureReader;
use crate::scene_file::MaterialOverride;
use crate::texture_library::TextureUse;
use gonio_mesh::topology::{self, TopologyReport};
use gonio_mesh::{
    Diagnostic, Format, Limits, Mesh, ModelCamera, ModelLight, NormalSource, ReadError, SidecarUse, explain, exporter,
};
use serde::Serialize;
use std::path::{Path, PathBuf};

/// The content of a model file, and its interpretation.
#[derive(Debug, Serialize)]
pub struct Inspection {
    /// The file, as the user knows it.
    pub file: String,
    /// The format.
    pub format: Format,
    /// The program that wrote it, as far as it says so.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub exporter: Option<String>,
    /// Its size.
    pub bytes: u64,
    /// The unpacked size, if it is compressed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unpacked_bytes: Option<u64>,
    /// The elements of the file, counted under the format's own names.
    pub contents: Vec<NamedCount>,
    /// The resulting triangles.
    pub geometry: GeometryReport,
    /// The connectivity of the triangles.
    pub surface: TopologyReport,
    /// The source of the normals in a picture.
    pub normals: NormalReport,
    /// Each material, value by value.
    pub materials: Vec<MaterialReport>,
    /// The files that it names (textures apart), and the paths that were searched.
    pub files: Vec<SidecarUse>,
    /// The textures that its materials name, and the paths that were searched.
    pub textures: Vec<TextureUse>,
    /// Pictures inside it.
    pub images: Vec<ImageReport>,
    /// Its lights.
    pub lights: Vec<ModelLight>,
    /// Its cameras.
    pub cameras: Vec<ModelCamera>,
    /// Known differences to other programs.
    pub differences: Vec<ReaderDifference>,
    /// Warnings and notes, with line and column if they have a place.
    pub diagnostics: Vec<Diagnostic>,
}

/// A count with its name.
#[derive(Debug, Serialize)]
pub struct NamedCount {
    /// The format's own name.
    pub what: String,
    /// The count.
    pub count: u64,
}

/// The mesh in numbers.
#[derive(Debug, Serialize)]
pub struct GeometryReport {
    /// After polygons were cut.
    pub triangles: usize,
    /// After equal corners were merged.
    pub vertices: usize,
    /// Runs of triangles with one name and material.
    pub parts: Vec<PartReport>,
    /// Smallest coordinates.
    pub min: [f32; 3],
    /// Largest coordinates.
    pub max: [f32; 3],
    /// Smallest and largest texture coordinates, where there are any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tex_coords: Option<[[f32; 2]; 2]>,
    /// Whether vertices have colours.
    pub colors: bool,
    /// The number of smoothing groups without 0 ("off"); `None` where the file has none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub smoothing_groups: Option<usize>,
    /// Bytes of each array in memory, as a GPU gets it.
    pub memory: Vec<NamedCount>,
}

/// A run of triangles.
#[derive(Debug, Serialize)]
pub struct PartReport {
    /// The name of the object or group.
    pub name: String,
    /// The material's name.
    pub material: String,
    /// The count.
    pub triangles: usize,
}

/// The source of normals.
#[derive(Debug, Serialize)]
pub struct NormalReport {
    /// The source of the normals in the mesh.
    pub source: NormalSource,
    /// The number of generated normals.
    pub notes: Vec<String>,
}

/// A picture inside the file.
#[derive(Debug, Serialize)]
pub struct ImageReport {
    /// Its name in the file.
    pub name: String,
    /// Its size in the file.
    pub bytes: usize,
}

/// Reads the model called `input` (a path, `builtin:NAME`) and reports its content.
pub fn inspect(input: &str, files: &dyn FileSource, limits: &Limits) -> Result<Inspection, ReadError> {
    let source = files;
    let files = &Budgeted::new(source, limits.max_bytes);
    let mut file = model_file::read_within(&files::resolve(Path::new(""), input), input, files, limits)?;
    let mut binder = MaterialBinder::new(files, files.budget(), PictureReader::ALL, BrdfLibrary::default());
    let (folders, used) = (file.texture_folders(), used_materials(&file.model));
    binder.add(0, &MaterialOverride::default(), &MaterialSource::of_file(&file, &folders, &used));
    let bound = binder.finish();
    let geometry = geometry(&file);
    let surface = topology::report(&file.model.mesh);
    let materials = materials::reports(&file);
    let differences = differences::find(&file, &bound.uses);
    let mut diagnostics = std::mem::take(&mut file.model.diagnostics);
    diagnostics.extend(bound.diagnostics);
    let model = file.model;
    let images = model.images.iter().map(|i| ImageReport { name: i.name.clone(), bytes: i.bytes.len() }).collect();
    // The bytes of a read model are gone; reading them again costs little, because large files are mapped.
    let text = FileText::read(input, source, limits);
    let exporter = text.ok().and_then(|text| exporter(text.content(), file.format));
    Ok(Inspection {
        file: file.name,
        format: file.format,
        exporter,
        bytes: file.size,
        unpacked_bytes: file.unpacked_size,
        contents: model.contents.into_iter().map(|(what, count)| NamedCount { what, count }).collect(),
        geometry,
        surface,
        materials,
        files: model.sidecars,
        textures: bound.uses,
        images,
        lights: model.lights,
        cameras: model.cameras,
        differences,
        diagnostics,
        normals: normals(model.mesh),
    })
}

/// Explains line `line` (from 1) of the OBJ or MTL file `input`.
pub fn explain_line(
    input: &str,
    line: u64,
    files: &dyn FileSource,
    limits: &Limits,
) -> Result<explain::LineExplanation, ReadError> {
    let in_file = |error: ReadError| error.in_file(input);
    let text = FileText::read(input, files, limits).map_err(in_file)?;
    match text.explain(line).map_err(in_file)? {
        Ok(explanation) => Ok(explanation),
        Err(format) => {
            let message = format!("only lines of OBJ and MTL files can be explained, and this is {}", format.name());
            Err(in_file(ReadError::new(message)))
        }
    }
}

/// Lines of a file that a scene or a model names.
#[derive(Clone, Debug, Serialize)]
pub struct FileLines {
    /// The lines.
    pub excerpt: explain::Excerpt,
    /// An explanation of the requested one, in OBJ and MTL files.
    pub explanation: Option<explain::LineExplanation>,
}

/// Line `line` (from 1) of the text file `input` with at most `around` lines before and after it.
///
/// # Errors
/// The file cannot be read, is no text, or has no such line.
pub fn lines_around(
    input: &str,
    line: u64,
    around: u64,
    files: &dyn FileSource,
    limits: &Limits,
) -> Result<FileLines, ReadError> {
    let in_file = |error: ReadError| error.in_file(input);
    let text = FileText::read(input, files, limits).map_err(in_file)?;
    let excerpt = explain::excerpt(text.content(), line, around).map_err(in_file)?;
    // A text of an unknown format, such as a scene file, has lines as well.
    let explanation = text.explain(line).ok().and_then(Result::ok);
    Ok(FileLines { excerpt, explanation })
}

/// A file with lines, unpacked.
struct FileText {
    path: PathBuf,
    bytes: FileBytes,
    unpacked: Option<Vec<u8>>,
}

impl FileText {
    fn read(input: &str, files: &dyn FileSource, limits: &Limits) -> Result<Self, ReadError> {
        let path = files::resolve(Path::new(""), input);
        let files = &Budgeted::new(files, limits.max_bytes);
        let bytes = files::read(files, &path).map_err(|error| files::failed(&error))?;
        let unpacked = model_file::unpack(&bytes, limits, files.budget())?;
        Ok(FileText { path, bytes, unpacked })
    }

    fn content(&self) -> &[u8] {
        self.unpacked.as_deref().unwrap_or(&self.bytes)
    }

    /// Explains a line; the format whose lines cannot be explained is the inner error.
    fn explain(&self, line: u64) -> Result<Result<explain::LineExplanation, Format>, ReadError> {
        if self.path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("mtl")) {
            return explain::mtl_line(self.content(), line).map(Ok);
        }
        let format = crate::input_kind::format_of(self.content(), &self.path.to_string_lossy());
        match format.map_err(ReadError::new)? {
            Format::Obj => explain::line(self.content(), line).map(Ok),
            other => Ok(Err(other)),
        }
    }
}

fn geometry(file: &ModelFile) -> GeometryReport {
    let mesh = &file.model.mesh;
    let bounds = mesh.bounds();
    let part = |part: &gonio_mesh::Part| PartReport {
        name: part.name.clone(),
        material: file.model.materials.get(part.material).map(|m| m.name.clone()).unwrap_or_default(),
        triangles: part.triangle_count,
    };
    let mut groups = mesh.smoothing_groups.clone();
    groups.retain(|group| *group != 0);
    groups.sort_unstable();
    groups.dedup();
    GeometryReport {
        triangles: mesh.triangle_count(),
        vertices: mesh.positions.len(),
        parts: mesh.parts.iter().map(part).collect(),
        min: bounds.map_or([0.0; 3], |b| b.min.to_array()),
        max: bounds.map_or([0.0; 3], |b| b.max.to_array()),
        tex_coords: range(&mesh.tex_coords),
        colors: !mesh.colors.is_empty(),
        smoothing_groups: (!mesh.smoothing_groups.is_empty()).then_some(groups.len()),
        memory: memory(mesh),
    }
}

fn range(values: &[[f32; 2]]) -> Option<[[f32; 2]; 2]> {
    values.iter().fold(None, |range, &[u, v]| {
        let [[u0, v0], [u1, v1]] = range.unwrap_or([[u, v]; 2]);
        Some([[u0.min(u), v0.min(v)], [u1.max(u), v1.max(v)]])
    })
}

fn memory(mesh: &Mesh) -> Vec<NamedCount> {
    let arrays = [
        ("positions", size_of_val(mesh.positions.as_slice())),
        ("normals", size_of_val(mesh.normals.as_slice())),
        ("texture coordinates", size_of_val(mesh.tex_coords.as_slice())),
        ("tangents", size_of_val(mesh.tangents.as_slice())),
        ("colors", size_of_val(mesh.colors.as_slice())),
        ("indices", size_of_val(mesh.indices.as_slice())),
    ];
    let there = arrays.into_iter().filter(|(_, bytes)| *bytes > 0);
    there.map(|(what, bytes)| NamedCount { what: what.to_owned(), count: bytes as u64 }).collect()
}

/// The normals that [`crate::load`] makes by default.
fn normals(mesh: Mesh) -> NormalReport {
    let (mesh, diagnostics) = with_normals(mesh, NormalChoice::default());
    NormalReport { source: mesh.normal_source, notes: diagnostics.into_iter().map(|d| d.message).collect() }
}
