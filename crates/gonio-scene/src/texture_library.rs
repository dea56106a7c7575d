//! All textures of a scene: each file is searched for, read and decoded once, and made into a texture once for each
//! use.

use crate::files::{self, Budget, FileBytes, FileSource};
use crate::image_file::Decoded;
use crate::readers::PictureReader;
use crate::texture::{ColorSpace, Texture};
use crate::texture_recipe::{self, Purpose};
use gonio_mesh::{Diagnostic, EmbeddedImage, FilePlace, MissingSidecar, TextureMap};
use gonio_threads::prelude::*;
use serde::Serialize;
use std::collections::{HashMap, HashSet};
use std::path::PathBuf;
use std::sync::Arc;

/// The material that needs a texture: for messages, and for the folders to search.
pub(crate) struct Requester<'a> {
    /// The model, as the user knows it.
    pub model: &'a str,
    /// The file whose line names the texture.
    pub file: &'a str,
    pub material: &'a str,
    /// The folders to search, in order.
    pub folders: &'a [PathBuf],
    /// Pictures inside the model's file.
    pub images: &'a [EmbeddedImage],
}

/// A texture that a material names, and the outcome.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct TextureUse {
    /// The material that names it.
    pub material: String,
    /// The key: `map_Kd`.
    pub key: String,
    /// The name as written.
    pub name: String,
    /// The line that names it, from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub line: Option<u64>,
    /// Its path; for embedded pictures the model's file and the picture's name.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub found: Option<String>,
    /// The paths where it was not found.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub tried: Vec<String>,
    /// The reason why a file that exists was not read.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub refused: Option<String>,
    /// Width and height in texels, where it could be decoded.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub size: Option<[u32; 2]>,
}

/// A picture file, found.
struct Picture {
    path: PathBuf,
    bytes: FileBytes,
}

/// A texture to make from pictures, and its first request.
struct Job {
    pictures: Vec<usize>,
    purpose: Purpose,
    first_request: Diagnostic,
}

/// The picture of a name, or the paths where it was not found.
type Found = Result<usize, MissingSidecar>;

/// A search: a name and folders.
type Sought = (String, Vec<PathBuf>);

/// The pictures found and textures made, kept so that other materials of the same models can be bound without the
/// files. It has the pictures' paths and not their bytes: a file that is mapped may be overwritten by an editor.
#[derive(Clone, Debug, Default)]
pub(crate) struct TextureCache {
    paths: Vec<PathBuf>,
    found: HashMap<Sought, Found>,
    /// `None` if it could not be made, which was reported then.
    made: HashMap<(Vec<usize>, Purpose), Option<Arc<Texture>>>,
}

/// The requested textures.
pub(crate) struct TextureLibrary<'a> {
    /// The source of files and the budget; `None` where only the cache may be used.
    files: Option<(&'a dyn FileSource, &'a Budget)>,
    reader: PictureReader,
    /// Whether the cache lacks a requested texture.
    lacks: bool,
    pictures: Vec<Picture>,
    jobs: Vec<Job>,
    by_use: HashMap<(Vec<usize>, Purpose), usize>,
    /// Results by name and folders, so that no search is repeated.
    found: HashMap<Sought, Found>,
    uses: Vec<(TextureUse, Option<usize>)>,
    /// Model, material, key, name and line of each of `uses`.
    reported: HashSet<([String; 4], Option<u64>)>,
    diagnostics: Vec<Diagnostic>,
}

/// The result of [`TextureLibrary::decode`].
pub(crate) struct DecodedLibrary {
    pub textures: Vec<Arc<Texture>>,
    /// The texture of each job.
    pub texture_of_job: Vec<Option<usize>>,
    pub uses: Vec<TextureUse>,
    pub diagnostics: Vec<Diagnostic>,
    pub cache: TextureCache,
}

impl TextureLibrary<'static> {
    /// Takes textures from the cache only, without files.
    pub fn from_cache(cache: &TextureCache) -> Self {
        let nothing = || FileBytes::from_static(&[]);
        let pictures = cache.paths.iter().map(|path| Picture { path: path.clone(), bytes: nothing() }).collect();
        TextureLibrary { pictures, found: cache.found.clone(), ..TextureLibrary::from_files(None, PictureReader::ALL) }
    }

    /// The requested textures; `None` if the cache lacks one. Diagnostics about them were reported when they were
    /// made.
    pub fn recall(self, cache: &TextureCache) -> Option<DecodedLibrary> {
        let mut textures = Vec::new();
        let mut texture_of_job = Vec::new();
        for job in &self.jobs {
            let made = cache.made.get(&(job.pictures.clone(), job.purpose))?;
            texture_of_job.push(made.as_ref().map(|texture| {
                textures.push(texture.clone());
                textures.len() - 1
            }));
        }
        let (uses, diagnostics) = (Vec::new(), Vec::new());
        let cache = cache.clone();
        (!self.lacks).then_some(DecodedLibrary { textures, texture_of_job, uses, diagnostics, cache })
    }
}

impl<'a> TextureLibrary<'a> {
    /// Pictures are read from `files`, and decoded ones are paid for from `budget`.
    pub fn new(files: &'a dyn FileSource, budget: &'a Budget, reader: PictureReader) -> Self {
        Self::from_files(Some((files, budget)), reader)
    }

    fn from_files(files: Option<(&'a dyn FileSource, &'a Budget)>, reader: PictureReader) -> Self {
        TextureLibrary {
            files,
            reader,
            lacks: false,
            pictures: Vec::new(),
            jobs: Vec::new(),
            by_use: HashMap::new(),
            found: HashMap::new(),
            uses: Vec::new(),
            reported: HashSet::new(),
            diagnostics: Vec::new(),
        }
    }

    /// The job's number for a map, or `None` with a warning if the file is not found.
    pub fn request(
        &mut self,
        map: &TextureMap,
        purpose: Purpose,
        key: &str,
        requester: &Requester<'_>,
    ) -> Option<usize> {
        let picture = self.find(map, key, requester)?;
        Some(self.job(vec![picture], purpose, about(map, key, requester)))
    }

    /// The job's number for a texture made of two pictures, where both are found; the second may be left out, and
    /// then counts as white.
    pub fn request_of_two(
        &mut self,
        map: &TextureMap,
        other: Option<&TextureMap>,
        purpose: Purpose,
        key: &str,
        requester: &Requester<'_>,
    ) -> Option<usize> {
        let mut pictures = vec![self.find(map, key, requester)?];
        if let Some(other) = other {
            pictures.push(self.find(other, key, requester)?);
        }
        Some(self.job(pictures, purpose, about(map, key, requester)))
    }

    fn job(&mut self, pictures: Vec<usize>, purpose: Purpose, first_request: Diagnostic) -> usize {
        let jobs = &mut self.jobs;
        *self.by_use.entry((pictures.clone(), purpose)).or_insert_with(|| {
            jobs.push(Job { pictures, purpose, first_request });
            jobs.len() - 1
        })
    }

    /// The picture of a map.
    fn find(&mut self, map: &TextureMap, key: &str, requester: &Requester<'_>) -> Option<usize> {
        let found = match map.embedded {
            Some(index) => self.find_embedded(index, requester),
            None => self.find_file(&map.path, requester.folders),
        };
        let (missing, path) = match &found {
            Ok(picture) => (MissingSidecar::default(), Some(self.pictures[*picture].path.display().to_string())),
            Err(missing) => (missing.clone(), None),
        };
        let MissingSidecar { tried, refused } = missing;
        // One material of one model may be requested several times: with overrides, for a derived texture.
        let request = [requester.model, requester.material, key, &map.path].map(str::to_owned);
        if self.reported.insert((request, map.line)) {
            if path.is_none() {
                let reason = match &refused {
                    Some(refused) => format!("was not read: {refused}"),
                    None => format!("was not found; looked for {} (upper or lower case)", tried.join(", ")),
                };
                let message = format!("the texture `{}` {reason}. The material is used without it", map.path);
                let mut diagnostic = about(map, key, requester);
                diagnostic.message.push_str(&message);
                self.diagnostics.push(diagnostic);
            }
            let texture_use = TextureUse {
                material: requester.material.to_owned(),
                key: key.to_owned(),
                name: map.path.clone(),
                line: map.line,
                found: path,
                tried,
                refused,
                size: None,
            };
            self.uses.push((texture_use, found.as_ref().ok().copied()));
        }
        found.ok()
    }

    fn find_file(&mut self, name: &str, folders: &[PathBuf]) -> Found {
        let sought = (name.to_owned(), folders.to_vec());
        if let Some(found) = self.found.get(&sought) {
            return found.clone();
        }
        let Some((files, _)) = self.files else {
            self.lacks = true;
            return Err(MissingSidecar::default());
        };
        let found = files::find(files, name, folders).map_err(|e| e.missing);
        let found = found.map(|(path, bytes)| self.picture(path, bytes));
        self.found.insert(sought, found.clone());
        found
    }

    fn find_embedded(&mut self, index: usize, requester: &Requester<'_>) -> Found {
        let path = format!("{}#{index}", requester.model);
        let sought = (path, Vec::new());
        if let Some(found) = self.found.get(&sought) {
            return found.clone();
        }
        if self.files.is_none() {
            self.lacks = true;
            return Err(MissingSidecar::default());
        }
        let image = requester.images.get(index);
        let found = image.map_or_else(
            || Err(MissingSidecar { tried: vec![sought.0.clone()], refused: None }),
            |image| Ok(self.picture(format!("{}#{}", requester.model, image.name).into(), image.bytes.clone().into())),
        );
        self.found.insert(sought, found.clone());
        found
    }

    fn picture(&mut self, path: PathBuf, bytes: FileBytes) -> usize {
        // The same file may have been found by two names.
        self.pictures.iter().position(|p| p.path == path && *p.bytes == *bytes).unwrap_or_else(|| {
            self.pictures.push(Picture { path, bytes });
            self.pictures.len() - 1
        })
    }

    /// Decodes everything, in parallel.
    pub fn decode(mut self) -> DecodedLibrary {
        let pictures = self.decode_pictures();
        let results: Vec<_> = self.jobs.par_iter().map(|job| self.make(job, &pictures)).collect();
        let mut textures = Vec::new();
        let mut texture_of_job = Vec::new();
        for (job, result) in self.jobs.iter().zip(results) {
            let about = |d: Diagnostic, message: String| Diagnostic {
                message: format!("{}{message}", job.first_request.message),
                place: job.first_request.place.clone(),
                ..d
            };
            match result {
                Ok((texture, note)) => {
                    if let Some(note) = note {
                        self.diagnostics.push(about(Diagnostic::note(""), note));
                    }
                    texture_of_job.push(Some(textures.len()));
                    textures.push(Arc::new(texture));
                }
                Err(error) => {
                    let message = format!("{error}; the material is used without it");
                    self.diagnostics.push(about(Diagnostic::warning(""), message));
                    texture_of_job.push(None);
                }
            }
        }
        let made = self.jobs.iter().zip(&texture_of_job).map(|(job, texture): (&Job, &Option<usize>)| {
            let texture = texture.and_then(|index| textures.get(index).cloned());
            ((job.pictures.clone(), job.purpose), texture)
        });
        let cache = TextureCache {
            made: made.collect(),
            paths: self.pictures.iter().map(|p| p.path.clone()).collect(),
            found: self.found,
        };
        let size_of = |picture: usize| pictures[picture].as_ref().ok().map(|p| [p.width, p.height]);
        let uses = self
            .uses
            .into_iter()
            .map(|(texture_use, picture)| TextureUse { size: picture.and_then(size_of), ..texture_use })
            .collect();
        DecodedLibrary { textures, texture_of_job, uses, diagnostics: self.diagnostics, cache }
    }

    /// Each picture, in parallel; those that would exceed what is left are refused by their sizes, before
    /// anything is decoded.
    fn decode_pictures(&self) -> Vec<Result<Decoded, String>> {
        let paid: Vec<Result<(), String>> = self.pictures.iter().map(|picture| self.pay_for(picture)).collect();
        self.pictures
            .par_iter()
            .zip(paid)
            .map(|(picture, paid)| {
                let name = picture.path.display().to_string();
                paid.and_then(|()| (self.reader.decode)(&picture.bytes, &name))
                    .map_err(|error| format!("{name}: {error}"))
            })
            .collect()
    }

    /// Pays for decoding a picture. One whose header cannot be read costs nothing: decoding it fails as well.
    fn pay_for(&self, picture: &Picture) -> Result<(), String> {
        let Some((_, budget)) = self.files else { return Ok(()) };
        let needed = (self.reader.memory)(&picture.bytes, &picture.path.to_string_lossy()).unwrap_or(0);
        budget
            .spend(needed)
            .map_err(|over| format!("the textures together would take more than allowed: this one {over}"))
    }

    fn make(&self, job: &Job, pictures: &[Result<Decoded, String>]) -> Result<(Texture, Option<String>), String> {
        let name = self.pictures[job.pictures[0]].path.display().to_string();
        let sources: Vec<&Decoded> = job
            .pictures
            .iter()
            .map(|&picture| pictures[picture].as_ref().map_err(Clone::clone))
            .collect::<Result<_, _>>()?;
        let (picture, note) = texture_recipe::cook(job.purpose, &sources);
        let color_space = if job.purpose.is_color() { ColorSpace::Srgb } else { ColorSpace::Data };
        let note = note.map(|note| format!("{name} {note}"));
        Ok((Texture::new(name, picture.width, picture.height, picture.rgba, color_space), note))
    }
}

/// A warning that begins with the key and the material, to be completed.
fn about(map: &TextureMap, key: &str, requester: &Requester<'_>) -> Diagnostic {
    let message = format!("{key} of material `{}`: ", requester.material);
    Diagnostic { place: FilePlace::on_line(map.line), ..Diagnostic::warning(message) }.in_file(requester.file)
}
