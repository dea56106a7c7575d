//! Materials and their textures.

use crate::asset_cache::CachedModel;
use crate::color_value::Color;
use crate::files::{Budget, FileSource};
use crate::material_brdf::{BrdfLibrary, MaterialBrdf};
use crate::model_file::ModelFile;
use crate::part_material::PartName;
use crate::readers::PictureReader;
use crate::scene::{BoundTexture, Maps, SceneMaterial};
use crate::scene_file::{MaterialOverride, ObjectSpec};
use crate::texture::Texture;
use crate::texture_library::{DecodedLibrary, Requester, TextureCache, TextureLibrary, TextureUse};
use crate::texture_recipe::{Metal, Purpose, Rule};
use glam::DVec3;
use gonio_light::{Fresnel, Optics, Spectrum};
use gonio_mesh::mesh::Part;
use gonio_mesh::{AmbientRule, Diagnostic, EmbeddedImage, Format, Material, Model, TextureMap};
use std::path::PathBuf;
use std::sync::Arc;

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

    /// Takes the materials of a cached model, whose textures are in the cache.
    pub fn of_cached(model: &'a CachedModel) -> Self {
        MaterialSource {
            name: &model.name,
            format: model.format,
            folders: &model.folders,
            materials: &model.materials,
            used: &model.used,
            images: &[],
        }
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

/// A requested texture: the job, and the map with its placement.
type Request = Option<(usize, TextureMap)>;

struct PendingMaterial {
    material: Material,
    diffuse_spectrum: Option<Arc<Spectrum>>,
    optics: Optics,
    brdf: Option<Arc<MaterialBrdf>>,
    diffuse: Request,
    specular: Request,
    emitted: Request,
    shininess: Request,
    roughness: Option<f32>,
    opacity: Request,
    normal: Request,
}

/// Textures and materials, ready to draw.
#[derive(Default)]
pub(crate) struct Bound {
    pub textures: Vec<Arc<Texture>>,
    pub materials: Vec<SceneMaterial>,
    pub uses: Vec<TextureUse>,
    pub diagnostics: Vec<Diagnostic>,
    pub cache: TextureCache,
}

/// Collects materials and textures of all objects, then decodes the textures at once.
pub(crate) struct MaterialBinder<'a> {
    library: TextureLibrary<'a>,
    brdfs: BrdfLibrary,
    pending: Vec<PendingMaterial>,
    /// Model and override, with the first of their materials.
    known: Vec<(usize, MaterialOverride, usize)>,
    /// Model, its material and override of a part, with their material.
    known_parts: Vec<(usize, usize, MaterialOverride, usize)>,
}

impl MaterialBinder<'static> {
    /// Binds textures of the cache only.
    pub fn from_cache(cache: &TextureCache, brdfs: BrdfLibrary) -> Self {
        MaterialBinder {
            library: TextureLibrary::from_cache(cache),
            brdfs,
            pending: Vec::new(),
            known: Vec::new(),
            known_parts: Vec::new(),
        }
    }

    /// [`Self::finish`] without files: `None` where the cache lacks a texture.
    pub fn recall(self, cache: &TextureCache) -> Option<Bound> {
        Some(bound(&self.pending, self.library.recall(cache)?))
    }
}

impl<'a> MaterialBinder<'a> {
    /// Textures are read from `files`, and decoded ones are paid for from `budget`. BRDFs were read before.
    pub fn new(files: &'a dyn FileSource, budget: &'a Budget, pictures: PictureReader, brdfs: BrdfLibrary) -> Self {
        let library = TextureLibrary::new(files, budget, pictures);
        MaterialBinder { library, brdfs, pending: Vec::new(), known: Vec::new(), known_parts: Vec::new() }
    }

    /// The materials of an object whose model is `from`, numbered `index`; returns the material of each of its `parts`. `own` finds the
    /// values for one part.
    pub fn add_object(
        &mut self,
        index: usize,
        object: &ObjectSpec,
        parts: &[Part],
        from: &MaterialSource<'_>,
        own: fn(PartName<'_>, &ObjectSpec) -> Option<MaterialOverride>,
    ) -> Vec<usize> {
        let first = self.add(index, &object.material, from);
        let of_part = |part: &Part| {
            let own = own(PartName::of(part, from.materials), object);
            own.map_or(first + part.material, |with| self.add_one(index, part.material, &with, from))
        };
        parts.iter().map(of_part).collect()
    }

    /// One material of a model, with an override of its own; returns its index.
    fn add_one(&mut self, index: usize, material: usize, with: &MaterialOverride, from: &MaterialSource<'_>) -> usize {
        let is_it =
            |known: &&(usize, usize, MaterialOverride, usize)| (known.0, known.1, &known.2) == (index, material, with);
        if let Some((.., known)) = self.known_parts.iter().find(is_it) {
            return *known;
        }
        let Some(own) = from.materials.get(material) else { return 0 };
        let number = self.pending.len();
        self.known_parts.push((index, material, with.clone(), number));
        let used = from.used.get(material).copied().unwrap_or(false);
        self.request(own, used, with, from);
        number
    }

    /// All materials of the model `from`, numbered `index`, with the override; returns the index of the first.
    pub fn add(&mut self, index: usize, with: &MaterialOverride, from: &MaterialSource<'_>) -> usize {
        if let Some((.., first)) = self.known.iter().find(|(m, w, _)| *m == index && w == with) {
            return *first;
        }
        let first = self.pending.len();
        self.known.push((index, with.clone(), first));
        for (material, &used) in from.materials.iter().zip(from.used) {
            self.request(material, used, with, from);
        }
        first
    }

    /// Adds a material with an override, and requests its textures if it is used.
    fn request(&mut self, material: &Material, used: bool, with: &MaterialOverride, from: &MaterialSource<'_>) {
        let requester = Requester {
            model: from.name,
            file: material.file.as_deref().unwrap_or(from.name),
            material: &material.name,
            folders: from.folders,
            images: from.images,
        };
        let mut material = with.applied_to(material.clone());
        let brdf = self.brdfs.find(with).cloned();
        if let Some(brdf) = &brdf {
            brdf.replace(&mut material);
        }
        let mut pending = if used {
            Requests { library: &mut self.library, requester, format: from.format }.for_material(material, with)
        } else {
            PendingMaterial::without_textures(material)
        };
        if brdf.is_none() {
            pending.optics = optics_of(with);
            let spectrum = with.diffuse_spectrum.clone();
            pending.diffuse_spectrum = spectrum.map(|samples| Arc::new(Spectrum::new(samples)));
        }
        pending.brdf = brdf;
        self.pending.push(pending);
    }

    /// Decodes the textures; returns them with the materials and the diagnostics.
    pub fn finish(self) -> Bound {
        bound(&self.pending, self.library.decode())
    }
}

fn bound(pending: &[PendingMaterial], library: DecodedLibrary) -> Bound {
    let bind = |request: &Request| -> Option<BoundTexture> {
        let (job, map) = request.as_ref()?;
        let texture = (*library.texture_of_job.get(*job)?)?;
        Some(BoundTexture { texture, scale: map.scale, rotation: map.rotation, offset: map.offset, wrap: map.wrap })
    };
    let materials = pending
        .iter()
        .map(|p| SceneMaterial {
            material: p.material.clone(),
            diffuse_spectrum: p.diffuse_spectrum.clone(),
            optics: p.optics,
            brdf: p.brdf.clone(),
            maps: Maps {
                diffuse: bind(&p.diffuse),
                specular: bind(&p.specular),
                emitted: bind(&p.emitted),
                shininess: bind(&p.shininess),
                roughness: p.roughness,
                opacity: bind(&p.opacity),
                normal: bind(&p.normal),
            },
        })
        .collect();
    Bound {
        textures: library.textures,
        materials,
        uses: library.uses,
        diagnostics: library.diagnostics,
        cache: library.cache,
    }
}

impl PendingMaterial {
    fn without_textures(material: Material) -> Self {
        PendingMaterial {
            material,
            diffuse_spectrum: None,
            optics: Optics::default(),
            brdf: None,
            diffuse: None,
            specular: None,
            emitted: None,
            shininess: None,
            roughness: None,
            opacity: None,
            normal: None,
        }
    }
}

/// The textures of one material.
struct Requests<'r, 'a> {
    library: &'r mut TextureLibrary<'a>,
    requester: Requester<'r>,
    format: Format,
}

impl Requests<'_, '_> {
    fn for_material(mut self, material: Material, with: &MaterialOverride) -> PendingMaterial {
        let color = |m: &TextureMap| Purpose::Color(Rule::new(m.texel));
        let data = |m: &TextureMap| Purpose::Data(Rule::new(m.texel));
        let opacity = |m: &TextureMap| Purpose::Opacity(Rule::new(m.texel));
        let normal = |m: &TextureMap| Purpose::Normal(m.bump_multiplier.to_bits());
        let bump = |m: &TextureMap| Purpose::Bump(m.bump_multiplier.to_bits());
        let mut pending = PendingMaterial {
            diffuse_spectrum: None,
            diffuse: self.one(&material.diffuse_map, color, "map_Kd", "diffuse texture"),
            specular: self.one(&material.specular_map, color, "map_Ks", "specular texture"),
            emitted: self.one(&material.emitted_map, color, "map_Ke", "emission texture"),
            shininess: self.one(&material.shininess_map, data, "map_Ns", "shininess texture"),
            roughness: None,
            opacity: self.one(&material.opacity_map, opacity, "map_d", "opacity texture"),
            normal: self
                .one(&material.normal_map, normal, "norm", "normal map")
                .or_else(|| self.one(&material.bump_map, bump, "map_Bump", "bump map")),
            optics: Optics::default(),
            brdf: None,
            material,
        };
        self.metal(&mut pending, with);
        self.roughness(&mut pending, with);
        pending
    }

    fn one(
        &mut self,
        map: &Option<TextureMap>,
        purpose: impl Fn(&TextureMap) -> Purpose,
        statement: &str,
        name: &str,
    ) -> Request {
        let map = map.as_ref()?;
        let key = self.key(statement, name);
        Some((self.library.request(map, purpose(map), key, &self.requester)?, map.clone()))
    }

    /// The name of the texture's key in the user's file.
    fn key<'k>(&self, statement: &'k str, name: &'k str) -> &'k str {
        if self.format == Format::Obj { statement } else { name }
    }

    /// A texture of metalness turns the base colour into a diffuse and a specular colour. A number between 0 and 1 does
    /// so for the specular colour only.
    fn metal(&mut self, pending: &mut PendingMaterial, with: &MaterialOverride) {
        let Some(from) = pending.material.metallic_roughness.clone() else { return };
        let base = pending.material.diffuse_map.clone();
        let is_mixed = from.metallic > 0.0 && from.metallic < 1.0;
        let (first, other) = match (&from.metallic_map, &base) {
            (Some(metalness), base) => (metalness, base.as_ref()),
            (None, Some(base)) if is_mixed && pending.specular.is_none() => (base, None),
            _ => return,
        };
        // Both are placed like the base colour.
        let placement = base.as_ref().unwrap_or(first).clone();
        let key = self.key("map_Pm", "metalness texture");
        let metal = Metal::new(&from);
        let mut made = |purpose| {
            let job = self.library.request_of_two(first, other, purpose, key, &self.requester)?;
            Some((job, placement.clone()))
        };
        if with.diffuse.is_none()
            && with.diffuse_spectrum.is_none()
            && from.metallic_map.is_some()
            && let Some(request) = made(Purpose::MetalDiffuse(metal))
        {
            pending.diffuse = Some(request);
            pending.material.diffuse = from.base_color;
        }
        if with.specular.is_none()
            && let Some(request) = made(Purpose::MetalSpecular(metal))
        {
            pending.specular = Some(request);
            pending.material.specular = [1.0; 3];
        }
    }

    /// A texture of roughness takes the place of one of exponents.
    fn roughness(&mut self, pending: &mut PendingMaterial, with: &MaterialOverride) {
        let Some(from) = &pending.material.metallic_roughness else { return };
        if with.shininess.is_some() || pending.shininess.is_some() {
            return;
        }
        let data = |m: &TextureMap| Purpose::Data(Rule::new(m.texel));
        pending.shininess = self.one(&from.roughness_map, data, "map_Pr", "roughness texture");
        pending.roughness = pending.shininess.is_some().then_some(from.roughness);
    }
}

impl MaterialOverride {
    /// A model's material with the values that the scene replaces.
    pub fn applied_to(&self, mut material: Material) -> Material {
        let with = self;
        let rgb = |c: Color| c.0.map(|v| v as f32);
        if with.textures == Some(false) {
            material.diffuse_map = None;
            material.specular_map = None;
            material.emitted_map = None;
            material.shininess_map = None;
            material.opacity_map = None;
            material.normal_map = None;
            material.bump_map = None;
            material.metallic_roughness = None;
        }
        if let Some(c) = with.ambient {
            material.ambient = AmbientRule::Value(rgb(c));
        }
        if let Some(c) = with.diffuse {
            (material.diffuse, material.diffuse_map) = (rgb(c), None);
        }
        if let Some(samples) = &with.diffuse_spectrum {
            let color = Spectrum::new(samples.clone()).color_of_surface();
            (material.diffuse, material.diffuse_map) = (color.as_vec3().to_array(), None);
        }
        if let Some(c) = with.specular {
            (material.specular, material.specular_map) = (rgb(c), None);
        }
        if let Some(c) = with.emitted {
            (material.emitted, material.emitted_map) = (rgb(c), None);
        }
        if let Some(v) = with.shininess {
            (material.shininess, material.shininess_map) = (v as f32, None);
        }
        if let Some(medium) = with.medium {
            material.refraction_index = medium.refraction_index() as f32;
        }
        if let Some(v) = with.refraction_index {
            material.refraction_index = v as f32;
        }
        if let Some(v) = with.opacity {
            (material.opacity, material.opacity_map) = (v as f32, None);
        }
        material
    }
}

/// Reflection and refraction of an object. Only the scene file has them: model files have no keys for them.
fn optics_of(with: &MaterialOverride) -> Optics {
    let usual = Optics::default();
    let clear = with.medium.is_some();
    Optics {
        reflectivity: with.reflectivity.unwrap_or(usual.reflectivity),
        transmission: with.transmission.unwrap_or(if clear { 1.0 } else { usual.transmission }),
        fresnel: with.fresnel.unwrap_or(if clear { Fresnel::Exact } else { usual.fresnel }),
        tint: with.tint.map_or(usual.tint, DVec3::from),
        absorption: with.absorption.map_or(usual.absorption, DVec3::from),
        dispersion: with.dispersion.unwrap_or(usual.dispersion),
        surfaces: with.surfaces.unwrap_or(usual.surfaces),
    }
}
