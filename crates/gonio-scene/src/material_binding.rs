//! Materials and their textures.

use crate::description::MaterialOverride;
use crate::files::FileSource;
use crate::load::overridden;
use crate::loaded::{BoundTexture, Maps, SceneMaterial};
use crate::texture::Texture;
use crate::texture_library::{Asker, Purpose, TextureLibrary};
use gonio_mesh::{Diagnostic, Material, Mesh, TextureMap};
use std::path::{Path, PathBuf};

/// A model whose materials are wanted.
pub(crate) struct BoundModel<'a> {
    pub name: &'a str,
    pub path: &'a Path,
    pub libraries: &'a [PathBuf],
    pub materials: &'a [Material],
    pub mesh: &'a Mesh,
}

/// A texture that was asked for: the job, and the map that asks.
type Request = Option<(usize, TextureMap)>;

struct PendingMaterial {
    material: Material,
    diffuse: Request,
    specular: Request,
    emitted: Request,
    shininess: Request,
    opacity: Request,
    normal: Request,
}

/// Collects materials and textures of all objects, then decodes the textures at once.
pub(crate) struct MaterialBinder<'a> {
    library: TextureLibrary<'a>,
    pending: Vec<PendingMaterial>,
    /// Model and override, with the first of their materials.
    known: Vec<(usize, MaterialOverride, usize)>,
}

impl<'a> MaterialBinder<'a> {
    pub fn new(files: &'a dyn FileSource) -> Self {
        MaterialBinder { library: TextureLibrary::new(files), pending: Vec::new(), known: Vec::new() }
    }

    /// All materials of the model numbered `index`, with the override; gives the index of the first.
    pub fn add(&mut self, index: usize, with: &MaterialOverride, model: &BoundModel<'_>) -> usize {
        if let Some((.., first)) = self.known.iter().find(|(m, w, _)| *m == index && w == with) {
            return *first;
        }
        let first = self.pending.len();
        self.known.push((index, with.clone(), first));
        let mut folders: Vec<PathBuf> = Vec::new();
        for file in [model.path].into_iter().chain(model.libraries.iter().map(PathBuf::as_path)) {
            let folder = file.parent().map(Path::to_owned).unwrap_or_default();
            if !folders.contains(&folder) {
                folders.push(folder);
            }
        }
        let library_name = match model.libraries {
            [one] => one.display().to_string(),
            _ => model.name.to_owned(),
        };
        for (i, material) in model.materials.iter().enumerate() {
            let used = model.mesh.parts.iter().any(|p| p.material == i && p.triangle_count > 0);
            let material = overridden(material.clone(), with);
            let asker = Asker { file: &library_name, material: &material.name, folders: &folders };
            let mut request = |map: &Option<TextureMap>, purpose: fn(&TextureMap) -> Purpose, key: &str| -> Request {
                let map = map.as_ref().filter(|_| used)?;
                Some((self.library.request(map, purpose(map), key, &asker)?, map.clone()))
            };
            let normal_of = |m: &TextureMap| Purpose::Normal(m.bump_multiplier.to_bits());
            let bump_of = |m: &TextureMap| Purpose::Bump(m.bump_multiplier.to_bits());
            let pending = PendingMaterial {
                diffuse: request(&material.diffuse_map, |_| Purpose::Color, "map_Kd"),
                specular: request(&material.specular_map, |_| Purpose::Color, "map_Ks"),
                emitted: request(&material.emitted_map, |_| Purpose::Color, "map_Ke"),
                shininess: request(&material.shininess_map, |_| Purpose::Data, "map_Ns"),
                opacity: request(&material.opacity_map, |_| Purpose::Opacity, "map_d"),
                normal: request(&material.normal_map, normal_of, "norm")
                    .or_else(|| request(&material.bump_map, bump_of, "map_Bump")),
                material,
            };
            self.pending.push(pending);
        }
        first
    }

    /// Decodes the textures: these, the materials, and what is to be said.
    pub fn finish(self) -> (Vec<Texture>, Vec<SceneMaterial>, Vec<Diagnostic>) {
        let (textures, texture_of_job, diagnostics) = self.library.decode();
        let bind = |request: &Request| -> Option<BoundTexture> {
            let (job, map) = request.as_ref()?;
            let texture = (*texture_of_job.get(*job)?)?;
            Some(BoundTexture { texture, scale: map.scale, offset: map.offset, clamp: map.clamp })
        };
        let materials = self
            .pending
            .iter()
            .map(|p| SceneMaterial {
                material: p.material.clone(),
                maps: Maps {
                    diffuse: bind(&p.diffuse),
                    specular: bind(&p.specular),
                    emitted: bind(&p.emitted),
                    shininess: bind(&p.shininess),
                    opacity: bind(&p.opacity),
                    normal: bind(&p.normal),
                },
            })
            .collect();
        (textures, materials, diagnostics)
    }
}
