//! The exercise's own model: the surface that is baked, and its diffuse colour at any point.

use crate::exercise::Exercise;
use glam::{DVec3, DVec4};
use gonio_bake::SceneSurface;
use gonio_bake::texels::TexelSample;
use gonio_language::tr;
use gonio_scene::files::{FileBytes, FileSource};
use gonio_scene::{Scene, load};
use std::collections::BTreeMap;
use std::io::{Error, ErrorKind};
use std::path::{Path, PathBuf};

/// Built-in files by their paths below `assets`, for programs that carry none: a web page fetches them.
#[derive(Clone, Debug, Default)]
pub struct FetchedFiles(pub BTreeMap<String, FileBytes>);

impl FileSource for FetchedFiles {
    fn read_within(&self, _: &Path, _: u64) -> Result<FileBytes, Error> {
        Err(Error::new(ErrorKind::NotFound, tr!("check-baking-only-built-in-files-can-be")))
    }

    fn list(&self, _: &Path) -> Vec<PathBuf> {
        Vec::new()
    }

    fn builtin(&self, name: &str) -> Option<FileBytes> {
        let carried = || gonio_scene::files::builtin(name).map(FileBytes::from_static);
        self.0.get(name).cloned().or_else(carried)
    }
}

/// The model that an exercise hands out for baking.
pub struct Original {
    scene: Scene,
    /// Its triangles.
    pub surface: SceneSurface,
    /// The bytes of each file, by its path as handed out.
    pub given: Vec<(String, FileBytes)>,
}

impl Original {
    /// Loads the model of an exercise.
    ///
    /// # Errors
    /// One sentence: a file of it is missing, which happens only on the web.
    pub fn load(exercise: &Exercise, files: &FetchedFiles) -> Result<Self, String> {
        let mut given = Vec::new();
        for path in &exercise.given {
            let bytes =
                files.builtin(path).ok_or_else(|| tr!("check-baking-the-exercise-s-file-was-not", path = path))?;
            given.push((Exercise::given_name(path).to_owned(), bytes));
        }
        let model = exercise.given.first().ok_or(tr!("check-baking-the-exercise-has-no-model-to"))?;
        let input = format!("{}{model}", gonio_scene::files::BUILTIN);
        let scene = load::describe(&[&input], files).and_then(|scene| load::load(scene, Path::new(""), files));
        let scene = scene.map_err(|error| error.to_string())?;
        let surface = SceneSurface::new(&scene);
        Ok(Original { scene, surface, given })
    }

    /// The diffuse colour at a sample, linear; filtered over its steps.
    pub fn diffuse(&self, sample: &TexelSample) -> DVec3 {
        self.surface.surface(&self.scene, sample).diffuse
    }

    /// The emitted light at a sample, linear and above 1 where it is bright.
    pub fn emitted(&self, sample: &TexelSample) -> DVec3 {
        self.surface.surface(&self.scene, sample).emitted
    }

    /// The name of a part.
    pub fn part_name(&self, part: usize) -> &str {
        self.surface.mesh.parts.get(part).map_or("", |part| part.name.as_str())
    }

    /// Whether a file is one of those that were handed out, unchanged.
    pub fn is_given(&self, bytes: &[u8]) -> bool {
        self.given.iter().any(|(_, known)| **known == *bytes)
    }

    /// Whether a path names a picture that was handed out.
    pub fn is_given_picture(&self, path: &str) -> bool {
        let base = |path: &str| path.rsplit(['/', '\\']).next().unwrap_or(path).to_ascii_lowercase();
        self.given.iter().any(|(name, _)| name.ends_with(".png") && base(name) == base(path))
    }
}

/// Adds a weight of 1, by which [`gonio_bake::texels::bake_texels`] divides.
pub fn weighted(color: DVec3) -> DVec4 {
    color.extend(1.0)
}
