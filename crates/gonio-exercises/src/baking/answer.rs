//! What a student hands in: a model, its materials, and pictures.

use super::original::Original;
use gonio_check::submission::SourceFile;
use gonio_language::tr;
use gonio_mesh::{Limits, Material, Mesh, TextureMap, Wrap};
use gonio_scene::Texture;
use gonio_scene::files::{FileBytes, FileSource, within};
use gonio_scene::model_file::ModelFile;
use std::io::{Error, ErrorKind};
use std::path::{Path, PathBuf};

/// Extensions of models.
const MODELS: [&str; 3] = ["obj", "glb", "gltf"];
/// Extensions of the other files of a model.
const PARTS: [&str; 9] = ["mtl", "png", "jpg", "jpeg", "bmp", "tga", "gif", "bin", "blend"];
/// Most texels along a side of a picture.
const MOST_TEXELS: u32 = 8192;
/// Most texels of all pictures together.
const MOST_TEXELS_OF_ALL: u64 = 96_000_000;
/// Most pictures that are read.
const MOST_PICTURES: usize = 24;
/// Most triangles that are read.
const MOST_TRIANGLES: u64 = 1_000_000;

fn extension(name: &str) -> String {
    name.rsplit_once('.').map_or(String::new(), |(_, ending)| ending.to_ascii_lowercase())
}

/// Whether a file is a model that can be handed in, by its name.
pub fn is_model(name: &str) -> bool {
    MODELS.contains(&extension(name).as_str())
}

/// Whether a file may belong to the answer, by its name: a model, its materials, a picture.
pub fn is_part(name: &str) -> bool {
    is_model(name) || PARTS.contains(&extension(name).as_str())
}

/// Whether two files have the same purpose, by their names: both are models, or both are materials.
pub fn same_part(a: &str, b: &str) -> bool {
    is_model(a) && is_model(b) || extension(a) == "mtl" && extension(b) == "mtl"
}

/// A picture among the files.
pub struct AnswerPicture {
    /// The file's name.
    pub name: String,
    /// Its texels.
    pub texture: Texture,
    /// Whether it is a JPEG, whose texels differ a little from what was saved.
    pub is_lossy: bool,
    /// Whether it is one of the exercise's own textures.
    pub is_given: bool,
}

/// How a path finds its file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PathState {
    /// Relative to the model, as it should be.
    Right,
    /// The same up to upper and lower case.
    OtherCase,
    /// It begins with a drive or at the root of a disk.
    Absolute,
    /// The file is in another folder.
    Elsewhere,
}

/// The texture of a material's diffuse colour.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TextureReference {
    /// None: a colour alone.
    Nothing,
    /// This picture.
    Found(usize, PathState),
    /// The exercise's own texture, which need not be handed in again.
    Given,
    /// A file that is not there.
    Missing(PathState),
}

/// A material as far as baking is concerned.
pub struct AnswerMaterial {
    /// The name.
    pub name: String,
    /// Its texture.
    pub texture: TextureReference,
    /// The path as written; empty without a texture.
    pub path: String,
    /// The file and the line of that path.
    pub place: Option<(String, u32)>,
    /// The colour that multiplies the texture.
    pub factor: [f32; 3],
    /// How the texture's coordinates are changed, and continued outside of it.
    map: Option<TextureMap>,
}

impl AnswerMaterial {
    /// Texture coordinates as the texture is sampled.
    pub fn sampled_at(&self, [u, v]: [f32; 2]) -> [f32; 2] {
        let Some(map) = &self.map else { return [u, v] };
        let [x, y] = [map.scale[0] * u, map.scale[1] * v];
        let (sin, cos) = map.rotation.sin_cos();
        [cos * x - sin * y + map.offset[0], sin * x + cos * y + map.offset[1]]
    }

    /// Whether the texture repeats outside of the unit square.
    pub fn repeats(&self) -> bool {
        self.map.as_ref().is_none_or(|map| map.wrap == [Wrap::Repeat; 2])
    }
}

/// A model with its pictures.
pub struct Answer {
    /// The name of the model's file.
    pub name: String,
    /// Its triangles.
    pub mesh: Mesh,
    /// The material of each part of the mesh, an index into `materials`.
    pub materials: Vec<AnswerMaterial>,
    /// All pictures among the files and in the model.
    pub pictures: Vec<AnswerPicture>,
    /// The material library that was not found, as written, with its line.
    pub lost_library: Option<(String, u32)>,
    /// Whether the model names a material library or contains its materials.
    pub has_materials: bool,
    /// Pictures that could not be read, one sentence each.
    pub unreadable: Vec<String>,
}

impl Answer {
    /// Reads the model `name` among these files.
    ///
    /// # Errors
    /// The model cannot be read; one sentence.
    pub fn read(name: &str, files: &[SourceFile], original: &Original) -> Result<Answer, String> {
        let limits = Limits { max_triangles: MOST_TRIANGLES, max_bytes: 512 << 20, ..Limits::default() };
        let mut file =
            ModelFile::open(name, &Submitted(files), &limits).map_err(|error| one_sentence(&error.to_string()))?;
        let is_text = extension(name) == "obj";
        let library = file.model.sidecars.iter().find(|library| is_text && library.found.is_none());
        let lost_library = library.map(|library| (library.name.clone(), line(library.line)));
        let has_materials = !is_text || !file.model.sidecars.is_empty();
        let mut answer = Answer {
            name: name.to_owned(),
            mesh: std::mem::take(&mut file.model.mesh),
            materials: Vec::new(),
            pictures: Vec::new(),
            lost_library,
            has_materials,
            unreadable: Vec::new(),
        };
        let of_model: Vec<Option<usize>> = (file.model.images.iter())
            .map(|image| answer.add_picture(&format!("{name}: {}", image.name), &image.bytes, original))
            .collect();
        let mut index_of: Vec<(&str, Option<usize>)> = Vec::new();
        let is_picture = |file: &&SourceFile| is_part(&file.name) && is_picture(&file.name);
        for file in files.iter().filter(is_picture).take(MOST_PICTURES) {
            index_of.push((file.name.as_str(), answer.add_picture(&file.name, &file.bytes, original)));
        }
        let library = file.libraries.first().map_or(name.to_owned(), |path| path.to_string_lossy().into_owned());
        let materials = file.model.materials.iter();
        answer.materials =
            materials.map(|material| read_material(material, &library, name, &of_model, &index_of, original)).collect();
        Ok(answer)
    }

    fn add_picture(&mut self, name: &str, bytes: &[u8], original: &Original) -> Option<usize> {
        let texels = |picture: &AnswerPicture| u64::from(picture.texture.width) * u64::from(picture.texture.height);
        let left = MOST_TEXELS_OF_ALL.saturating_sub(self.pictures.iter().map(texels).sum());
        match decode(name, bytes, left) {
            Ok(texture) => {
                let is_lossy = bytes.starts_with(&[0xff, 0xd8]);
                let is_given = original.is_given(bytes);
                self.pictures.push(AnswerPicture { name: name.to_owned(), texture, is_lossy, is_given });
                Some(self.pictures.len() - 1)
            }
            Err(reason) => {
                self.unreadable.push(format!("{name}: {}", one_sentence(&reason)));
                None
            }
        }
    }

    /// The material of each triangle.
    pub fn material_of_triangles(&self) -> Vec<usize> {
        let mut materials = vec![0; self.mesh.triangle_count()];
        for part in &self.mesh.parts {
            let triangles = materials.iter_mut().skip(part.first_triangle).take(part.triangle_count);
            triangles.for_each(|material| *material = part.material);
        }
        materials
    }
}

fn is_picture(name: &str) -> bool {
    ["png", "jpg", "jpeg", "bmp", "tga", "gif"].contains(&extension(name).as_str())
}

fn line(line: Option<u64>) -> u32 {
    line.and_then(|line| u32::try_from(line).ok()).unwrap_or(1)
}

/// The first line of a message.
fn one_sentence(message: &str) -> String {
    message.lines().next().unwrap_or_default().to_owned()
}

fn decode(name: &str, bytes: &[u8], left: u64) -> Result<Texture, String> {
    if let Some([width, height]) = gonio_scene::picture_size(bytes, name)
        && width.max(height) > MOST_TEXELS
    {
        return Err(tr!(
            "check-baking-the-picture-has-x-texels-at",
            width = width,
            height = height,
            most = MOST_TEXELS
        ));
    }
    if gonio_scene::picture_size(bytes, name).is_some_and(|[width, height]| u64::from(width) * u64::from(height) > left)
    {
        return Err(tr!("check-baking-the-pictures-of-this-folder-are").to_owned());
    }
    Texture::decode(name, bytes)
}

fn read_material(
    material: &Material,
    library: &str,
    model: &str,
    of_model: &[Option<usize>],
    of_files: &[(&str, Option<usize>)],
    original: &Original,
) -> AnswerMaterial {
    let map = material.diffuse_map.clone();
    let texture = match &map {
        None => TextureReference::Nothing,
        Some(TextureMap { embedded: Some(image), .. }) => match of_model.get(*image).copied().flatten() {
            Some(picture) => TextureReference::Found(picture, PathState::Right),
            None => TextureReference::Missing(PathState::Right),
        },
        Some(map) => find_picture(&map.path, &[library, model], of_files, original),
    };
    let file = material.file.clone().unwrap_or_else(|| library.to_owned());
    AnswerMaterial {
        name: material.name.clone(),
        texture,
        path: map.as_ref().map_or(String::new(), |map| map.path.clone()),
        place: map.as_ref().and_then(|map| Some((file, line(Some(map.line?))))),
        factor: material.diffuse,
        map,
    }
}

fn find_picture(
    path: &str,
    beside: &[&str],
    pictures: &[(&str, Option<usize>)],
    original: &Original,
) -> TextureReference {
    let written = path.trim().replace('\\', "/");
    let is_drive = written.as_bytes().get(1) == Some(&b':');
    let is_absolute = is_drive || written.starts_with('/') || written.starts_with("file:");
    let base = |path: &str| path.rsplit('/').next().unwrap_or(path).to_ascii_lowercase();
    let at = |test: &dyn Fn(&str) -> bool| pictures.iter().find(|(name, _)| test(name)).map(|(_, picture)| *picture);
    let whole: Vec<String> = beside.iter().map(|file| joined(file, &written)).collect();
    let exact = at(&|name| whole.iter().any(|path| path == &joined("", name)));
    let in_any_case = || at(&|name| whole.iter().any(|path| path.eq_ignore_ascii_case(&joined("", name))));
    let elsewhere = || at(&|name| base(&name.replace('\\', "/")) == base(&written));
    let (found, state) = match (is_absolute, exact) {
        (true, _) => (elsewhere(), PathState::Absolute),
        (false, Some(found)) => (Some(found), PathState::Right),
        (false, None) => match in_any_case() {
            Some(found) => (Some(found), PathState::OtherCase),
            None => (elsewhere(), PathState::Elsewhere),
        },
    };
    match found.flatten() {
        Some(picture) => TextureReference::Found(picture, state),
        None if original.is_given_picture(&written) => TextureReference::Given,
        None => TextureReference::Missing(state),
    }
}

/// A path relative to the folder of a file, without `.` and `..`.
fn joined(file: &str, path: &str) -> String {
    let file = file.replace('\\', "/");
    let folder = file.rsplit_once('/').map_or("", |(folder, _)| folder);
    let mut parts: Vec<&str> = Vec::new();
    for part in folder.split('/').chain(path.split('/')) {
        match part {
            "" | "." => {}
            ".." if parts.last().is_some_and(|last| *last != "..") => drop(parts.pop()),
            part => parts.push(part),
        }
    }
    parts.join("/")
}

/// The files of a submission, by their names.
struct Submitted<'a>(&'a [SourceFile]);

impl FileSource for Submitted<'_> {
    fn read_within(&self, path: &Path, most: u64) -> Result<FileBytes, Error> {
        let path = joined("", &path.to_string_lossy().replace('\\', "/"));
        let file = self.0.iter().find(|file| joined("", &file.name.replace('\\', "/")) == path);
        let file = file.ok_or_else(|| Error::from(ErrorKind::NotFound))?;
        within(FileBytes::from(file.bytes.clone()), most)
    }

    fn list(&self, folder: &Path) -> Vec<PathBuf> {
        let folder = joined("", &folder.to_string_lossy().replace('\\', "/"));
        let inside = |name: &str| {
            let name = joined("", &name.replace('\\', "/"));
            let rest = if folder.is_empty() { name.as_str() } else { name.strip_prefix(&folder)?.strip_prefix('/')? };
            rest.split('/').next().map(PathBuf::from)
        };
        self.0.iter().filter_map(|file| inside(&file.name)).collect()
    }

    fn builtin(&self, _: &str) -> Option<FileBytes> {
        None
    }
}
