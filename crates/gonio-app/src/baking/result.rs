//! A baked atlas with what its views need.

use super::places::{self, AtlasPlace, TexelTriangles};
use crate::document::BakedLook;
use glam::{DMat3, DVec2, DVec3};
use gonio_atlas::layout;
use gonio_bake::model::{AtlasSet, MapFile, baked_materials};
use gonio_bake::{BakeJob, BakedAtlas, MapKind};
use gonio_image::EncodedPicture;
use gonio_mesh::{AmbientRule, Material, Mesh, Wrap, tangents};
use gonio_reference::Probe;
use gonio_scene::{BoundTexture, ColorSpace, Object, Scene, SceneMaterial, Texture};
use std::sync::{Arc, OnceLock};

/// The picture below the outlines of the charts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum AtlasBackground {
    /// Each chart in a colour of its own, with its triangles.
    #[default]
    Charts,
    /// Squares that show stretch on the model.
    Checker,
    /// A map of the result, by its index.
    Map(usize),
}

/// A baked atlas, and the scene with its textures.
pub struct BakedResult {
    /// The scene as it was baked.
    pub scene: Arc<Scene>,
    /// The settings.
    pub job: BakeJob,
    /// The atlas.
    pub atlas: BakedAtlas,
    /// When it was baked, and how long that took.
    pub facts: ResultFacts,
    /// The border of each chart: a triangle, and the corner at which its edge begins.
    pub outlines: Vec<Vec<(usize, usize)>>,
    triangles: TexelTriangles,
    /// For each object its parts: the first triangle in the mesh, their number, and the first triangle on the surface.
    parts: Vec<Vec<[usize; 3]>>,
    /// The objects' meshes with the new texture coordinates.
    meshes: Vec<Arc<Mesh>>,
    materials: Vec<SceneMaterial>,
    /// The textures of `materials`.
    textures: Vec<Arc<Texture>>,
    checker: OnceLock<EncodedPicture<u8>>,
    /// The last picture that was shown on the model.
    alone: OnceLock<(AtlasBackground, Arc<Texture>)>,
}

/// When and how a result came about.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ResultFacts {
    /// Counts the results.
    pub serial: u64,
    /// The scene's geometry and materials at the time.
    pub generation: u64,
    /// Seconds from the request to the result.
    pub seconds: f64,
}

/// Texels along a side of the checker, and squares.
const CHECKER: (u32, u32) = (512, 32);

impl BakedResult {
    /// Prepares the views of an atlas of `scene`.
    pub fn new(scene: Arc<Scene>, job: BakeJob, atlas: BakedAtlas, facts: ResultFacts) -> Self {
        let mut outlines = vec![Vec::new(); atlas.uv.chart_count];
        for (triangle, corner) in layout::border_edges(&atlas.uv) {
            let chart = atlas.uv.chart_of_triangle[triangle].and_then(|chart| outlines.get_mut(chart as usize));
            if let Some(outline) = chart {
                outline.push((triangle, corner));
            }
        }
        let parts = parts_on_surface(&scene);
        let has_normals = atlas.pictures.iter().any(|picture| picture.kind == MapKind::Normal);
        let has_colors = atlas.pictures.iter().any(|picture| picture.kind == MapKind::Diffuse);
        let meshes = scene.objects.iter().zip(&parts).map(|(object, parts)| {
            let Some(mesh) = scene.meshes.get(object.mesh) else { return Arc::default() };
            let mut mesh = mesh.with_corner_tex_coords(&corner_coordinates(object, mesh, parts, &atlas));
            if has_colors {
                mesh.colors = Vec::new();
            }
            let with_tangents = has_normals.then(|| tangents::with_tangents(&mesh)).flatten();
            Arc::new(with_tangents.unwrap_or(mesh))
        });
        let meshes = meshes.collect();
        let (materials, textures) = scene_materials(&scene, &atlas);
        let triangles = TexelTriangles::new(&atlas);
        let (checker, alone) = (OnceLock::new(), OnceLock::new());
        BakedResult {
            scene,
            job,
            atlas,
            facts,
            outlines,
            triangles,
            parts,
            meshes,
            materials,
            textures,
            checker,
            alone,
        }
    }

    /// The background to show first: the first map.
    pub fn first_background(&self) -> AtlasBackground {
        if self.atlas.pictures.is_empty() { AtlasBackground::Charts } else { AtlasBackground::Map(0) }
    }

    /// A picture of the atlas, first row at the top.
    pub fn picture(&self, background: AtlasBackground) -> &EncodedPicture<u8> {
        match background {
            AtlasBackground::Charts => &self.atlas.layout,
            AtlasBackground::Checker => self.checker.get_or_init(|| layout::draw_checker(CHECKER.0, CHECKER.1)),
            AtlasBackground::Map(index) => {
                self.atlas.pictures.get(index).map_or(&self.atlas.layout, |map| &map.picture)
            }
        }
    }

    /// The place at texture coordinates; `None` between the charts.
    pub fn place_at(&self, uv: DVec2) -> Option<AtlasPlace> {
        self.triangles.place(&self.atlas, uv)
    }

    /// The place that a probe of the scene shows; `None` if that scene has other geometry.
    pub fn place_of_probe(&self, loaded: &Scene, probe: &Probe) -> Option<AtlasPlace> {
        let object = self.scene.objects.get(probe.object)?;
        let seen = loaded.meshes.get(loaded.objects.get(probe.object)?.mesh)?;
        let own = [self.scene.meshes.get(object.mesh)?, self.meshes.get(probe.object)?];
        if !own.iter().any(|own| Arc::ptr_eq(own, seen)) {
            return None;
        }
        let is_in = |[first, count, _]: &&[usize; 3]| (*first..first + count).contains(&probe.triangle);
        let [first, _, on_surface] = *self.parts.get(probe.object)?.iter().find(is_in)?;
        let DVec3 { x, y, z } = probe.barycentrics;
        let weights = if is_mirrored(object) { DVec3::new(x, z, y) } else { probe.barycentrics };
        places::place(&self.atlas, on_surface + probe.triangle - first, weights)
    }

    /// The name of the object of a triangle of the surface; of its part, if it has several.
    pub fn name_of(&self, triangle: usize) -> Option<&str> {
        let is_in = |[_, count, first]: &[usize; 3]| (*first..first + count).contains(&triangle);
        let of_object = |(index, parts): (usize, &Vec<[usize; 3]>)| Some((index, parts.iter().position(is_in)?));
        let (object, part) = self.parts.iter().enumerate().find_map(of_object)?;
        let object = self.scene.objects.get(object)?;
        Some(if object.parts.len() > 1 { &object.parts.get(part)?.name } else { &object.name })
    }

    /// `base` with the baked textures; `None` if its geometry is not the one that was baked. `background` is the picture of
    /// [`BakedLook::Picture`].
    pub fn scene(&self, base: &Scene, look: BakedLook, background: AtlasBackground) -> Option<Scene> {
        let is_same = |(now, then): (&Object, &Object)| {
            let mesh = |scene: &Scene, object: &Object| scene.meshes.get(object.mesh).map(Arc::as_ptr);
            mesh(base, now) == mesh(&self.scene, then)
        };
        let objects = || base.objects.iter().zip(&self.scene.objects);
        if base.objects.len() != self.scene.objects.len() || !objects().all(is_same) {
            return None;
        }
        let mut scene = base.clone();
        scene.meshes.clone_from(&self.meshes);
        scene.objects.iter_mut().enumerate().for_each(|(index, object)| object.mesh = index);
        (scene.materials, scene.textures) = match look {
            BakedLook::Materials => (self.materials.clone(), self.textures.clone()),
            BakedLook::Picture => {
                let black = Material {
                    diffuse: [0.0; 3],
                    specular: [0.0; 3],
                    ambient: AmbientRule::Value([0.0; 3]),
                    emitted: [1.0; 3],
                    ..Material::default()
                };
                let mut material = SceneMaterial::from(black);
                material.maps.emitted = Some(bound(0));
                for mesh in scene.meshes.iter_mut().filter(|mesh| !mesh.colors.is_empty()) {
                    *mesh = Arc::new(Mesh { colors: Vec::new(), ..(**mesh).clone() });
                }
                (vec![material; self.materials.len()], vec![self.texture(background)])
            }
        };
        Some(scene)
    }

    fn texture(&self, background: AtlasBackground) -> Arc<Texture> {
        let make = || {
            let EncodedPicture { width, height, rgba } = self.picture(background).clone();
            Arc::new(Texture::new("baked", width, height, rgba, ColorSpace::Srgb))
        };
        match self.alone.get_or_init(|| (background, make())) {
            (kept, texture) if *kept == background => texture.clone(),
            _ => make(),
        }
    }
}

/// Whether the surface has the triangles of an object the other way round.
fn is_mirrored(object: &Object) -> bool {
    DMat3::from_mat4(object.world_from_model).determinant() < 0.0
}

/// See [`BakedResult::parts`]: [`gonio_bake::SceneSurface`] has the triangles of all parts one after the other.
fn parts_on_surface(scene: &Scene) -> Vec<Vec<[usize; 3]>> {
    let mut next = 0;
    let of_object = |object: &Object| {
        let Some(mesh) = scene.meshes.get(object.mesh) else { return Vec::new() };
        let parts = object.parts.iter().map(|part| {
            let all = mesh.triangle_count();
            let first = part.first_triangle.min(all);
            let count = part.triangle_count.min(all - first);
            next += count;
            [first, count, next - count]
        });
        parts.collect()
    };
    scene.objects.iter().map(of_object).collect()
}

/// The texture coordinates of each corner of an object's mesh.
fn corner_coordinates(object: &Object, mesh: &Mesh, parts: &[[usize; 3]], atlas: &BakedAtlas) -> Vec<[f32; 2]> {
    let mut coordinates = vec![[0.0; 2]; mesh.indices.len()];
    let order = if is_mirrored(object) { [0, 2, 1] } else { [0, 1, 2] };
    for &[first, count, on_surface] in parts {
        for triangle in 0..count {
            for (k, from) in order.into_iter().enumerate() {
                let of_surface = atlas.uv.tex_coords.get(3 * (on_surface + triangle) + from);
                if let (Some(coordinate), Some(baked)) = (coordinates.get_mut(3 * (first + triangle) + k), of_surface) {
                    *coordinate = *baked;
                }
            }
        }
    }
    coordinates
}

fn bound(texture: usize) -> BoundTexture {
    BoundTexture { wrap: [Wrap::Clamp; 2], ..BoundTexture::plain(texture) }
}

/// The materials with the baked textures, and those textures.
fn scene_materials(scene: &Scene, atlas: &BakedAtlas) -> (Vec<SceneMaterial>, Vec<Arc<Texture>>) {
    let kinds = [MapKind::Diffuse, MapKind::Specular, MapKind::Emitted, MapKind::Normal];
    let used: Vec<_> = atlas.pictures.iter().filter(|map| kinds.contains(&map.kind)).collect();
    let textures = used.iter().map(|map| {
        let space = if map.kind == MapKind::Normal { ColorSpace::Data } else { ColorSpace::Srgb };
        let EncodedPicture { width, height, rgba } = map.picture.clone();
        Arc::new(Texture::new(map.file.clone(), width, height, rgba, space))
    });
    let textures = textures.collect();
    let files: Vec<MapFile> = used.iter().map(|map| map.map_file()).collect();
    let texture_of = |kind| used.iter().position(|map| map.kind == kind).map(bound);
    let materials = baked_materials(scene, &files, AtlasSet::Only).materials;
    let materials = materials.into_iter().zip(&scene.materials).map(|(material, own)| {
        let mut baked = SceneMaterial { optics: own.optics, ..SceneMaterial::from(material) };
        baked.maps.diffuse = texture_of(MapKind::Diffuse);
        baked.maps.specular = texture_of(MapKind::Specular);
        baked.maps.emitted = texture_of(MapKind::Emitted);
        baked.maps.normal = texture_of(MapKind::Normal);
        baked
    });
    (materials.collect(), textures)
}
