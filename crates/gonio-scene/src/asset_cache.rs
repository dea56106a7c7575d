//! The assets of a scene, kept so that most edits need no file.

use crate::environment::LoadedEnvironment;
use crate::files;
use crate::material_brdf::BrdfLibrary;
use crate::model_file::ModelFile;
use crate::scene_file::{Normals, ObjectSpec};
use crate::settings::EnvironmentSettings;
use crate::texture_library::TextureCache;
use gonio_mesh::normals::Averaging;
use gonio_mesh::{Diagnostic, Format, Material, Mesh, normals};
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
    pub(crate) brdfs: BrdfLibrary,
    /// The environment that was read, also while the scene is without it.
    pub(crate) environment: Option<(EnvironmentSettings, Arc<LoadedEnvironment>)>,
}

/// A model file's materials, without overrides.
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
    /// The mesh without tangents; at least one of the two is `Some`.
    pub plain: Option<Arc<Mesh>>,
    pub with_tangents: Option<Arc<Mesh>>,
}

impl CachedModel {
    /// Keeps the materials of a file whose textures are bound already.
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
}

impl CachedMesh {
    /// The mesh with or without tangents, whichever there is.
    pub fn any(&self) -> Option<&Arc<Mesh>> {
        self.plain.as_ref().or(self.with_tangents.as_ref())
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

    /// The cached environment for these settings; its rotation does not matter.
    pub fn environment(&self, spec: &EnvironmentSettings) -> Option<Arc<LoadedEnvironment>> {
        let (known, environment) = self.environment.as_ref()?;
        let same = known.image == spec.image
            && known.background == spec.background
            && (known.layout, known.size) == (spec.layout, spec.size);
        same.then(|| environment.clone())
    }
}

/// The normals of a mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct NormalChoice {
    normals: Normals,
    crease_angle_rad: Option<f64>,
}

impl NormalChoice {
    pub fn for_object(object: &ObjectSpec) -> Self {
        // Flat normals have no creases to speak of.
        let crease_angle = object.crease_angle.filter(|_| object.normals != Normals::Flat);
        NormalChoice { normals: object.normals, crease_angle_rad: crease_angle.map(f64::to_radians) }
    }
}

/// Returns the mesh with normals, from the file or computed, and diagnostics.
pub(crate) fn with_normals(mesh: Mesh, choice: NormalChoice) -> (Mesh, Vec<Diagnostic>) {
    let averaging = Averaging { crease_angle_rad: choice.crease_angle_rad };
    match choice.normals {
        Normals::File => normals::complete_with(mesh, &averaging),
        Normals::Flat => (normals::make_flat(&mesh), Vec::new()),
        Normals::Averaged => normals::make_averaged_with(&mesh, &averaging),
    }
}
