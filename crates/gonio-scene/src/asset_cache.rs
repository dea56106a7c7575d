//! The assets of a scene, kept with it so that most edits need no file.

use crate::environment::LoadedEnvironment;
use crate::files;
use crate::load::NormalChoice;
use crate::material_binding::MaterialBinder;
use crate::model_file::ModelFile;
use crate::scene_file::{MaterialOverride, ObjectSpec};
use crate::settings::EnvironmentSettings;
use crate::texture_library::TextureCache;
use gonio_mesh::{EmbeddedImage, Format, Material, Mesh, Model};
use std::path::PathBuf;
use std::sync::Arc;

/// The assets of a scene: materials before the scene changed them, meshes by their normals, textures by their pictures,
/// and the environment. Geometry and texels are shared with the scene, not copied.
#[derive(Clone, Debug, Default)]
pub struct AssetCache {
    /// The folder that the scene's paths are relative to.
    pub(crate) base: PathBuf,
    pub(crate) models: Vec<CachedModel>,
    pub(crate) meshes: Vec<CachedMesh>,
    pub(crate) textures: TextureCache,
    /// The environment that was read, also while the scene is without it.
    pub(crate) environment: Option<(EnvironmentSettings, Arc<LoadedEnvironment>)>,
}

/// A model file's materials, as they stand in the file.
#[derive(Clone, Debug)]
pub(crate) struct CachedModel {
    /// The name that the user knows.
    pub name: String,
    pub path: PathBuf,
    pub format: Format,
    /// The folders in which its textures are searched for.
    pub folders: Vec<PathBuf>,
    pub materials: Vec<Material>,
    /// Whether any triangle has the material, for each material.
    pub used: Vec<bool>,
}

/// A model's mesh with one choice of normals.
#[derive(Clone, Debug)]
pub(crate) struct CachedMesh {
    /// Index into [`AssetCache::models`].
    pub model: usize,
    pub normals: NormalChoice,
    /// Its surface is closed, and faces outwards.
    pub closed: bool,
    /// At least one of the two is there.
    pub plain: Option<Arc<Mesh>>,
    pub with_tangents: Option<Arc<Mesh>>,
}

/// The source of materials: a model file that was just read, or its cached form.
pub(crate) struct MaterialSource<'a> {
    pub name: &'a str,
    pub format: Format,
    pub folders: &'a [PathBuf],
    pub materials: &'a [Material],
    pub used: &'a [bool],
    pub images: &'a [EmbeddedImage],
}

impl<'a> MaterialSource<'a> {
    /// Takes the materials of a file, with [`ModelFile::texture_folders`] and [`used_materials`].
    pub fn of_file(file: &'a ModelFile, folders: &'a [PathBuf], used: &'a [bool]) -> Self {
        let model = &file.model;
        let (name, format) = (file.name.as_str(), file.format);
        MaterialSource { name, format, folders, materials: &model.materials, used, images: &model.images }
    }
}

/// Returns for each material of a model whether any triangle has it.
pub(crate) fn used_materials(model: &Model) -> Vec<bool> {
    let mut used = vec![false; model.materials.len()];
    for part in model.mesh.parts.iter().filter(|part| part.triangle_count > 0) {
        if let Some(used) = used.get_mut(part.material) {
            *used = true;
        }
    }
    used
}

impl CachedModel {
    /// Takes what is kept of a file whose materials and pictures are bound already.
    pub fn of_file(file: &mut ModelFile, used: Vec<bool>) -> Self {
        CachedModel {
            name: file.name.clone(),
            path: file.path.clone(),
            format: file.format,
            folders: file.texture_folders(),
            materials: std::mem::take(&mut file.model.materials),
            used,
        }
    }

    /// The name of an object that the scene does not name.
    pub fn object_name(&self) -> String {
        self.path.file_stem().map_or_else(|| "object".into(), |stem| stem.to_string_lossy().into_owned())
    }

    /// Binds its materials, of which it is model number `index`; gives the index of the first.
    pub fn bind(&self, index: usize, with: &MaterialOverride, binder: &mut MaterialBinder<'_>) -> usize {
        let source = MaterialSource {
            name: &self.name,
            format: self.format,
            folders: &self.folders,
            materials: &self.materials,
            used: &self.used,
            images: &[],
        };
        binder.add(index, with, &source)
    }
}

impl AssetCache {
    /// The model and the mesh of an object, where they are known.
    pub fn find(&self, object: &ObjectSpec) -> Option<(usize, usize)> {
        let path = files::resolve(&self.base, &object.model);
        let model = self.models.iter().position(|m| m.path == path)?;
        let normals = NormalChoice::for_object(object);
        let mesh = self.meshes.iter().position(|m| m.model == model && m.normals == normals)?;
        Some((model, mesh))
    }

    /// The environment of some settings, where it is known: what is read does not depend on how it is turned.
    pub fn environment(&self, spec: &EnvironmentSettings) -> Option<Arc<LoadedEnvironment>> {
        let (known, environment) = self.environment.as_ref()?;
        let same = known.image == spec.image
            && known.background == spec.background
            && (known.layout, known.size) == (spec.layout, spec.size);
        same.then(|| environment.clone())
    }
}
