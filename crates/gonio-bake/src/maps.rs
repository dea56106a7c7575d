//! The quantities that can be baked.

use crate::surface::{SceneSurface, tangent_frame};
use crate::texels::{BakedTexels, Border, TexelSample, bake_texels};
use glam::{DVec3, DVec4};
use gonio_atlas::AtlasUv;
use gonio_image::encode::exr::{ExrPrecision, encode as encode_exr};
use gonio_image::encode::png::{ColorTag, encode8};
use gonio_image::{EncodedPicture, Image, ImageError, srgb};
use gonio_light::{ShadingPoint, Surface, color, light};
use gonio_mesh::{Mesh, tangents};
use gonio_rays::RayMesh;
use gonio_scene::scene::ShadowCaster;
use gonio_scene::{Frame, Scene};
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// A quantity of a surface that can be baked.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum MapKind {
    /// `k_d` with its texture and vertex colours: sRGB.
    #[default]
    Diffuse,
    /// `k_s` with its texture: sRGB.
    Specular,
    /// The normal in the tangent space of the new texture coordinates (MikkTSpace), green up: data.
    Normal,
    /// The share of the hemisphere, weighted by the cosine, from which no surface is met: data.
    AmbientOcclusion,
    /// The light that `k_d` is multiplied by, which is the irradiance by pi: the ambient colour and the diffuse terms of all
    /// lights, or what [`Baker::with_light`] says. Linear.
    Light,
    /// The position in world space. Linear.
    Position,
    /// `E` with its texture: sRGB.
    Emitted,
    /// A colour for each part of each object: sRGB.
    Id,
}

impl MapKind {
    /// All quantities.
    pub const ALL: &'static [MapKind] = &[
        MapKind::Diffuse,
        MapKind::Specular,
        MapKind::Normal,
        MapKind::AmbientOcclusion,
        MapKind::Light,
        MapKind::Position,
        MapKind::Emitted,
        MapKind::Id,
    ];

    /// The name, as in file names.
    pub fn name(self) -> &'static str {
        match self {
            MapKind::Diffuse => "diffuse",
            MapKind::Specular => "specular",
            MapKind::Normal => "normal",
            MapKind::AmbientOcclusion => "ambient-occlusion",
            MapKind::Light => "light",
            MapKind::Position => "position",
            MapKind::Emitted => "emitted",
            MapKind::Id => "id",
        }
    }

    /// The extension of its file.
    pub fn extension(self) -> &'static str {
        if matches!(self, MapKind::Light | MapKind::Position) { "exr" } else { "png" }
    }

    /// The name of its file for a model.
    pub fn file_name(self, model: &str) -> String {
        format!("{model}_{}.{}", self.name(), self.extension())
    }
}

/// How maps are baked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BakeSettings {
    /// Texels along a side, 1 to 16384.
    pub size: u32,
    /// Samples along a side of a texel, at least 1. Textures are filtered over the distance between samples, so that one is
    /// enough for them; more smooth the borders of materials and shadows, and soften magnified textures.
    pub grid: u32,
    /// Rays of each texel for ambient occlusion.
    pub occlusion_rays: u32,
    /// The distance at which a ray of ambient occlusion ends, in world units; infinite by default.
    pub occlusion_distance: f64,
    /// The distance from the surface within which a finer model is searched, to either side, in world units.
    pub cage_distance: f64,
}

impl Default for BakeSettings {
    fn default() -> Self {
        BakeSettings { size: 1024, grid: 1, occlusion_rays: 64, occlusion_distance: f64::INFINITY, cage_distance: 0.0 }
    }
}

/// A point of a surface whose light is wanted, world space.
#[derive(Clone, Copy, Debug)]
pub struct LitPoint {
    /// The position.
    pub position: DVec3,
    /// Unit normal of the triangle, on either side.
    pub geometric_normal: DVec3,
    /// Unit normal, with the material's normal map, on the side whose light counts.
    pub normal: DVec3,
    /// A number of its own for each point of the atlas, for random numbers.
    pub number: u32,
}

/// Returns the light that `k_d` is multiplied by at a point, linear RGB, and the variance of its luminance.
pub type LightAt<'a> = dyn Fn(&LitPoint) -> (DVec3, f64) + Sync + 'a;

/// Bakes the maps of one surface.
pub struct Baker<'a> {
    scene: &'a Scene,
    frame: &'a Frame,
    surface: &'a SceneSurface,
    atlas: &'a AtlasUv,
    settings: BakeSettings,
    finer: Option<FinerModel<'a>>,
    light_at: Option<&'a LightAt<'a>>,
    /// The mesh with the atlas's coordinates and their tangents.
    tangent_mesh: Option<Mesh>,
    /// For rays to lights and into the hemisphere.
    blockers: Option<Blockers>,
}

/// A finer model around the same surface.
struct FinerModel<'a> {
    scene: &'a Scene,
    surface: &'a SceneSurface,
    rays: RayMesh,
}

struct Blockers {
    rays: RayMesh,
}

/// Where a sample's values come from.
struct Origin<'a> {
    scene: &'a Scene,
    surface: &'a SceneSurface,
    sample: TexelSample,
}

impl<'a> Baker<'a> {
    /// Prepares the baking of `surface`, which is that of `scene`, for the texture coordinates of `atlas`.
    pub fn new(
        scene: &'a Scene,
        frame: &'a Frame,
        surface: &'a SceneSurface,
        atlas: &'a AtlasUv,
        settings: BakeSettings,
    ) -> Self {
        Baker {
            scene,
            frame,
            surface,
            atlas,
            settings,
            finer: None,
            light_at: None,
            tangent_mesh: None,
            blockers: None,
        }
    }

    /// Takes all values from a finer model, where one is within the cage distance along the normal.
    #[must_use]
    pub fn from_finer(mut self, scene: &'a Scene, surface: &'a SceneSurface) -> Self {
        self.finer = RayMesh::new(&surface.mesh).map(|rays| FinerModel { scene, surface, rays });
        self
    }

    /// Takes the map [`MapKind::Light`] from a function instead of the light equation.
    #[must_use]
    pub fn with_light(mut self, light_at: &'a LightAt<'a>) -> Self {
        self.light_at = Some(light_at);
        self
    }

    /// Bakes a map; the background is filled. `None` if `go_on`, which gets the share done, returned false.
    pub fn bake(&mut self, kind: MapKind, go_on: &(dyn Fn(f64) -> bool + Sync)) -> Option<BakedMap> {
        if kind == MapKind::Normal && self.tangent_mesh.is_none() {
            let unwrapped = self.surface.mesh.with_corner_tex_coords(&self.atlas.tex_coords);
            self.tangent_mesh = tangents::with_tangents(&unwrapped);
        }
        let needs_rays = kind == MapKind::AmbientOcclusion
            || (kind == MapKind::Light && self.light_at.is_none() && self.frame.shadows);
        if needs_rays && self.blockers.is_none() {
            self.blockers = self.blocking_mesh().and_then(|mesh| RayMesh::new(&mesh)).map(|rays| Blockers { rays });
        }
        let this = &*self;
        let evaluate = |sample: &TexelSample| this.value(kind, sample);
        let is_used = |t: usize| this.atlas.chart_of_triangle[t].is_some();
        let Self { settings: BakeSettings { size, grid, .. }, .. } = *this;
        let evaluate: &(dyn Fn(&TexelSample) -> DVec4 + Sync) = &evaluate;
        // Only a texture is known beyond the surface.
        let is_material = matches!(kind, MapKind::Diffuse | MapKind::Specular | MapKind::Emitted);
        let border = if is_material && this.finer.is_none() { Border::Continued } else { Border::Nearest };
        let mut texels = bake_texels(&this.atlas.tex_coords, is_used, size, grid, border, evaluate, go_on)?;
        texels.fill_background();
        Some(BakedMap { kind, texels, is_noisy: kind == MapKind::Light && this.light_at.is_some() })
    }

    /// The triangles that block light: of the finer model if there is one.
    fn blocking_mesh(&self) -> Option<Mesh> {
        let (scene, surface) = match &self.finer {
            Some(finer) => (finer.scene, finer.surface),
            None => (self.scene, self.surface),
        };
        let blocks = |t: usize| {
            surface.material(scene, t).is_some_and(|material| material.shadow_caster(false) != ShadowCaster::Nothing)
        };
        let triangles = (0..surface.mesh.triangle_count()).filter(|&t| blocks(t));
        let indices = triangles.flat_map(|t| surface.mesh.triangle(t).map(|i| i as u32)).collect();
        Some(Mesh { positions: surface.mesh.positions.clone(), indices, ..Mesh::default() })
    }

    /// The sample itself, or the place on the finer model that is seen against the normal from the cage.
    fn origin(&self, sample: &TexelSample) -> Origin<'_> {
        let own = Origin { scene: self.scene, surface: self.surface, sample: *sample };
        let Some(finer) = &self.finer else { return own };
        let normal = self.surface.smooth_normal(sample.weights, sample.triangle);
        let cage = self.settings.cage_distance;
        let ray =
            |weights: DVec3, normal: DVec3| (self.surface.position(weights, sample.triangle) + cage * normal, -normal);
        let (start, direction) = ray(sample.weights, normal);
        let Some(hit) = finer.rays.first_hit(start, direction, 2.0 * cage) else { return own };
        // Where the rays of the neighbouring samples meet the plane of that triangle (H. Igehy, "Tracing ray differentials", 1999).
        let in_plane = |(start, direction)| finer.surface.weights_in_plane(hit.triangle, start, direction);
        let here = in_plane((start, direction));
        let steps = sample.steps.map(|step| {
            let weights = sample.weights + step;
            let there = in_plane(ray(weights, self.surface.smooth_normal(weights, sample.triangle)));
            here.zip(there).map_or(DVec3::ZERO, |(here, there)| there - here)
        });
        let sample = TexelSample { triangle: hit.triangle, weights: hit.weights, steps, ..*sample };
        Origin { scene: finer.scene, surface: finer.surface, sample }
    }

    /// The value, and the variance of its luminance.
    fn value(&self, kind: MapKind, sample: &TexelSample) -> DVec4 {
        let Origin { scene, surface, sample: at } = self.origin(sample);
        let exact = match kind {
            MapKind::Diffuse => surface.surface(scene, &at).diffuse,
            MapKind::Specular => surface.surface(scene, &at).specular,
            MapKind::Emitted => surface.surface(scene, &at).emitted,
            MapKind::Position => surface.position(at.weights, at.triangle),
            MapKind::Id => part_color(surface.part(at.triangle)),
            MapKind::Normal => self.tangent_normal(sample, surface.normal(scene, &at)),
            MapKind::AmbientOcclusion => DVec3::splat(self.openness(surface, &at)),
            MapKind::Light => match self.light_at {
                Some(light_at) => {
                    let (light, variance) = light_at(&lit_point(surface, scene, &at));
                    return light.extend(variance);
                }
                None => self.light(surface, scene, &at),
            },
        };
        exact.extend(0.0)
    }

    /// A normal in the tangent space of the atlas; straight up where that has no direction.
    fn tangent_normal(&self, sample: &TexelSample, normal: DVec3) -> DVec3 {
        let smooth = self.surface.smooth_normal(sample.weights, sample.triangle);
        let frame = self.tangent_mesh.as_ref().and_then(|mesh| tangent_frame(mesh, sample, smooth));
        frame.map_or(DVec3::Z, |frame| frame.transpose() * normal)
    }

    /// The share of cosine-weighted directions that are not blocked. Directions below the triangle are left out.
    fn openness(&self, surface: &SceneSurface, at: &TexelSample) -> f64 {
        let Some(blockers) = &self.blockers else { return 1.0 };
        let (normal, position) =
            (surface.smooth_normal(at.weights, at.triangle), surface.position(at.weights, at.triangle));
        let facet = surface.geometric_normal(at.triangle);
        let facet = if facet.dot(normal) < 0.0 { -facet } else { facet };
        let right = normal.any_orthonormal_vector();
        let up = normal.cross(right);
        let count = self.settings.occlusion_rays.div_ceil(self.settings.grid * self.settings.grid).max(1);
        let (mut open, mut all) = (0_u32, 0_u32);
        for i in 0..count {
            let direction = cosine_direction(i, count, at.seed);
            let direction = direction.x * right + direction.y * up + direction.z * normal;
            if direction.dot(facet) > 0.0 {
                all += 1;
                let is_blocked = blockers.rays.is_blocked(position, facet, direction, self.settings.occlusion_distance);
                open += u32::from(!is_blocked);
            }
        }
        if all == 0 { 0.0 } else { f64::from(open) / f64::from(all) }
    }

    /// `L_ambient + sum diff L_i att_i spot_i v_i <N.L_i>`; shadows if the frame has them.
    fn light(&self, surface: &SceneSurface, scene: &Scene, at: &TexelSample) -> DVec3 {
        let LitPoint { position, normal, geometric_normal: facet, .. } = lit_point(surface, scene, at);
        let point = ShadingPoint::new(position, normal, facet, position + normal);
        let white = Surface { ambient: DVec3::ONE, diffuse: DVec3::ONE, ..Surface::default() };
        let equation = &self.frame.equation;
        let sums = equation.light_sums_where(&point, &white, &self.frame.lights, None, |terms| {
            let Some(blockers) = self.blockers.as_ref().filter(|_| self.frame.shadows) else { return 1.0 };
            let facet = if facet.dot(terms.l) < 0.0 { -facet } else { facet };
            if blockers.rays.is_blocked(position, facet, terms.l, terms.distance) { 0.0 } else { 1.0 }
        });
        equation.ambient(&white, light::ambient_color(&self.frame.lights)) + sums.diffuse
    }
}

fn lit_point(surface: &SceneSurface, scene: &Scene, at: &TexelSample) -> LitPoint {
    LitPoint {
        position: surface.position(at.weights, at.triangle),
        geometric_normal: surface.geometric_normal(at.triangle),
        normal: surface.normal(scene, at),
        number: at.seed,
    }
}

/// The i-th of `count` directions with a density of cos / pi about +z: Hammersley's points, turned and shifted for each
/// texel (M. Pharr, W. Jakob, G. Humphreys, "Physically Based Rendering", 3rd edition, section 7.4.1).
fn cosine_direction(i: u32, count: u32, seed: u32) -> DVec3 {
    let mixed = (u64::from(seed) + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    let mixed = (mixed ^ (mixed >> 31)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let share = |bits: u64| (bits >> 40) as f64 / (1_u64 << 24) as f64;
    let u = ((f64::from(i) + 0.5) / f64::from(count) + share(mixed)).fract();
    let v = (f64::from(i.reverse_bits()) / 4_294_967_296.0 + share(mixed << 24)).fract();
    let (radius, angle) = (u.sqrt(), TAU * v);
    DVec3::new(radius * angle.cos(), radius * angle.sin(), (1.0 - u).max(0.0).sqrt())
}

/// A colour, linear RGB, for a part: hues turned by the golden angle.
fn part_color(part: usize) -> DVec3 {
    let hue = (part as f64 * 0.381_966_011_250_105).fract() * 6.0;
    let channel = |shift: f64| {
        let h = (hue + shift) % 6.0;
        0.05 + 0.85 * (h.min(4.0 - h)).clamp(0.0, 1.0)
    };
    let value = [1.0, 0.55, 0.3][(part / 8) % 3];
    value * DVec3::new(channel(2.0), channel(0.0), channel(4.0))
}

/// A baked map, its background filled.
#[derive(Clone, Debug)]
pub struct BakedMap {
    /// The quantity.
    pub kind: MapKind,
    /// Linear values; the fourth number is the variance of the luminance.
    pub texels: BakedTexels,
    /// Whether the values are estimates with noise.
    pub is_noisy: bool,
}

impl BakedMap {
    fn is_color(&self) -> bool {
        matches!(self.kind, MapKind::Diffuse | MapKind::Specular | MapKind::Emitted | MapKind::Id)
    }

    /// The number that the colours in the file are multiplied by: 1, or the largest value of a channel if that is more, as a
    /// PNG ends at 1. A material has it as the colour that multiplies its texture.
    pub fn factor(&self) -> f32 {
        let values = self.texels.values.iter().filter(|_| self.is_color()).flat_map(|v| &v[..3]);
        values.copied().filter(|v| v.is_finite()).fold(1.0, f32::max)
    }

    /// The file: PNG of 8 bits a channel, colours divided by [`Self::factor`], or OpenEXR of 32 bits for light and positions.
    ///
    /// # Errors
    ///
    /// A map without texels.
    pub fn encode(&self) -> Result<Vec<u8>, ImageError> {
        if self.kind.extension() == "exr" {
            return self.exr(self.texels.rows_from_top().map(|[r, g, b, _]| [r, g, b]));
        }
        let tag = if self.is_color() { ColorTag::Srgb } else { ColorTag::Untagged };
        encode8(&self.picture8(), tag)
    }

    /// The picture of 8 bits a channel in [`Self::encode`]'s PNG, first row at the top. Light and positions, whose file is not
    /// a PNG, are clamped to 0..1.
    pub fn picture8(&self) -> EncodedPicture<u8> {
        let factor = self.factor();
        let data = |v: f32| (v.clamp(0.0, 1.0) * 255.0 + 0.5) as u8;
        let encoded = |[r, g, b, _]: [f32; 4]| match self.kind {
            MapKind::Normal => unit([r, g, b]).map(|v| data(0.5 * v + 0.5)),
            MapKind::AmbientOcclusion => [r, g, b].map(data),
            _ => [r, g, b].map(|v| srgb::ENCODER.encode((v / factor).clamp(0.0, 1.0))),
        };
        let rgba = self.texels.rows_from_top().flat_map(|texel| {
            let [r, g, b] = encoded(texel);
            [r, g, b, 255]
        });
        EncodedPicture { width: self.texels.size, height: self.texels.size, rgba: rgba.collect() }
    }

    /// The standard error of each texel's luminance as an OpenEXR file; `None` without noise.
    ///
    /// # Errors
    ///
    /// A map without texels.
    pub fn encode_standard_error(&self) -> Option<Result<Vec<u8>, ImageError>> {
        let rows = self.texels.rows_from_top();
        self.is_noisy.then(|| self.exr(rows.map(|[.., variance]| [variance.max(0.0).sqrt(); 3])))
    }

    fn exr(&self, rows: impl Iterator<Item = [f32; 3]>) -> Result<Vec<u8>, ImageError> {
        let (width, height) = (self.texels.size, self.texels.size);
        let image = Image { width, height, pixels: rows.map(|[r, g, b]| [r, g, b, 1.0]).collect() };
        Ok(encode_exr(&image, ExrPrecision::Float)?.bytes)
    }

    /// The root of the mean variance of the texels that charts cover, relative to their mean luminance; 0 for a black map, `None`
    /// without noise.
    pub fn relative_error(&self) -> Option<f64> {
        let texels = self.texels.values.iter().zip(&self.texels.covered).filter(|(_, covered)| **covered);
        let (mut light, mut variance, mut count) = (0.0, 0.0, 0.0);
        for (&[r, g, b, v], _) in texels {
            light += color::luminance(DVec3::new(r.into(), g.into(), b.into()));
            variance += f64::from(v);
            count += 1.0;
        }
        let relative = if light > 0.0 { (variance * count).sqrt() / light } else { 0.0 };
        self.is_noisy.then_some(relative)
    }
}

/// The mean of several normals is shorter than 1.
fn unit(v: [f32; 3]) -> [f32; 3] {
    glam::Vec3::from(v).normalize_or(glam::Vec3::Z).to_array()
}
