//! All textures of a scene: each file is sought, read and decoded once for each use.

use crate::files::{self, FileSource};
use crate::height_map;
use crate::image_file::{self, Decoded};
use crate::texture::{ColorSpace, Texture};
use gonio_mesh::{Diagnostic, TextureMap};
use rayon::prelude::*;
use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::Arc;

/// What a texture is for, which decides what is done to its numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Purpose {
    /// sRGB.
    Color,
    /// As it is.
    Data,
    /// Alpha is moved to red where the file has one.
    Opacity,
    /// A normal map with its strength (as bits, so that it can be compared).
    Normal(u32),
    /// Heights, or a normal map after all; with its strength.
    Bump(u32),
}

/// Who asks for a texture: for messages, and where to look.
pub(crate) struct Asker<'a> {
    /// The file whose line names the texture.
    pub file: &'a str,
    pub material: &'a str,
    /// Where textures are sought, in order.
    pub folders: &'a [PathBuf],
}

struct Job {
    path: PathBuf,
    bytes: Arc<Vec<u8>>,
    purpose: Purpose,
    first_asked_by: Diagnostic,
}

/// A file's path and bytes; `None` where it is not to be found.
type Found = Option<(PathBuf, Arc<Vec<u8>>)>;

/// The textures that were asked for.
pub(crate) struct TextureLibrary<'a> {
    files: &'a dyn FileSource,
    jobs: Vec<Job>,
    by_use: HashMap<(PathBuf, Purpose), usize>,
    /// By name and folders: what was sought once is not sought again.
    found: HashMap<(String, Vec<PathBuf>), Found>,
    pub diagnostics: Vec<Diagnostic>,
}

impl<'a> TextureLibrary<'a> {
    pub fn new(files: &'a dyn FileSource) -> Self {
        TextureLibrary {
            files,
            jobs: Vec::new(),
            by_use: HashMap::new(),
            found: HashMap::new(),
            diagnostics: Vec::new(),
        }
    }

    /// The job's number for a map, or `None` with a warning where the file is not to be found.
    pub fn request(&mut self, map: &TextureMap, purpose: Purpose, key: &str, asker: &Asker<'_>) -> Option<usize> {
        let say = |message: String| Diagnostic {
            line: map.line,
            ..Diagnostic::warning(format!("{key} of material `{}`: {message}", asker.material)).in_file(asker.file)
        };
        let sought = (map.path.clone(), asker.folders.to_vec());
        let found = match self.found.get(&sought) {
            Some(found) => found.clone(),
            None => match files::find(self.files, &map.path, asker.folders) {
                Ok((path, bytes)) => {
                    let found = Some((path, Arc::new(bytes)));
                    self.found.insert(sought, found.clone());
                    found
                }
                Err(tried) => {
                    let message = format!(
                        "the texture `{}` is not to be found; looked at {} (letters in any case). The material \
                         goes without it",
                        map.path,
                        tried.join(", ")
                    );
                    self.diagnostics.push(say(message));
                    self.found.insert(sought, None);
                    None
                }
            },
        };
        let (path, bytes) = found?;
        let jobs = &mut self.jobs;
        let index = *self.by_use.entry((path.clone(), purpose)).or_insert_with(|| {
            jobs.push(Job { path, bytes, purpose, first_asked_by: say(String::new()) });
            jobs.len() - 1
        });
        Some(index)
    }

    /// Decodes everything, in parallel: the textures, and for each job which one it became.
    pub fn decode(mut self) -> (Vec<Texture>, Vec<Option<usize>>, Vec<Diagnostic>) {
        let results: Vec<_> = self.jobs.par_iter().map(decode_job).collect();
        let mut textures = Vec::new();
        let mut index_of_job = Vec::new();
        for (job, result) in self.jobs.iter().zip(results) {
            let about = |d: Diagnostic, message: String| Diagnostic {
                message: format!("{}{message}", job.first_asked_by.message),
                file: job.first_asked_by.file.clone(),
                line: job.first_asked_by.line,
                ..d
            };
            match result {
                Ok((texture, note)) => {
                    if let Some(note) = note {
                        self.diagnostics.push(about(Diagnostic::note(""), note));
                    }
                    index_of_job.push(Some(textures.len()));
                    textures.push(texture);
                }
                Err(why) => {
                    let message = format!("{}: {why}; the material goes without it", job.path.display());
                    self.diagnostics.push(about(Diagnostic::warning(""), message));
                    index_of_job.push(None);
                }
            }
        }
        (textures, index_of_job, self.diagnostics)
    }
}

fn decode_job(job: &Job) -> Result<(Texture, Option<String>), String> {
    let name = job.path.display().to_string();
    let mut picture = image_file::decode(&job.bytes, &name)?;
    let mut note = None;
    let color_space = if job.purpose == Purpose::Color { ColorSpace::Srgb } else { ColorSpace::Data };
    match job.purpose {
        Purpose::Color | Purpose::Data => {}
        Purpose::Opacity => {
            if picture.has_alpha {
                alpha_to_red(&mut picture);
            }
        }
        Purpose::Normal(bits) => strengthen(&mut picture, bits),
        Purpose::Bump(bits) if height_map::is_heights(&picture) => {
            height_map::normals_of_heights(&mut picture, f32::from_bits(bits).into());
            note = Some(format!("{name} is grey, so it holds heights; normals were made of them"));
        }
        Purpose::Bump(bits) => {
            strengthen(&mut picture, bits);
            note = Some(format!("{name} is coloured, so it is taken as a tangent-space normal map"));
        }
    }
    Ok((Texture::new(name, picture.width, picture.height, picture.rgba, color_space), note))
}

fn strengthen(picture: &mut Decoded, bits: u32) {
    let strength = f64::from(f32::from_bits(bits));
    if strength != 1.0 {
        height_map::strengthen(picture, strength);
    }
}

fn alpha_to_red(picture: &mut Decoded) {
    for texel in picture.rgba.as_chunks_mut::<4>().0 {
        texel[0] = texel[3];
    }
}
