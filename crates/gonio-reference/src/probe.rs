//! Every number of one pixel: the surface that is seen there, and the equation term by term.

use crate::ReferenceScene;
use crate::intersect::EyeSpace;
use crate::render::FrameContext;
use crate::shade::{CornerCache, Shader};
use crate::visibility::{Block, Visible};
use glam::{DVec2, DVec4};
use gonio_light::optics::EnvironmentTerms;
use gonio_light::quantity::Geometry;
use gonio_light::{DVec3, Fresnel, LightSums, LightTerms, Optics, ShadingPoint, Sight, Surface, Surfaces, Terms};
use gonio_scene::Frame;
use gonio_scene::scene_file::Shading;
use serde::{Serialize, Serializer};

/// The values at the centre of one pixel.
///
/// Numbers that are not finite (the distance of a directional light) are `null` in JSON.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Probe {
    /// Column, from the left.
    pub x: u32,
    /// Row, from the top.
    pub y: u32,
    /// Index into the scene's objects.
    pub object: usize,
    /// The object's name.
    pub object_name: String,
    /// The part's name in the file.
    pub part_name: String,
    /// Index into the scene's materials.
    pub material: usize,
    /// The material's name.
    pub material_name: String,
    /// Index of the triangle in its mesh.
    pub triangle: usize,
    /// Indices of its corners in the mesh.
    pub vertices: [usize; 3],
    /// Weights of the corners, their sum is 1.
    pub barycentrics: DVec3,
    /// Distance from the eye along the viewing direction, world units.
    pub depth: f64,
    /// World space.
    pub position: DVec3,
    /// Geometric normal (towards the triangle's front), the mesh's tangent (zero where it has none), texture
    /// coordinates.
    #[serde(with = "GeometryReport")]
    pub geometry: Geometry,
    /// The triangle's front is seen.
    pub front_facing: bool,
    /// The normals were turned to the viewer, as the frame is two-sided and the back is seen.
    pub normal_turned: bool,
    /// The points at which the equation is evaluated.
    pub shading: Shading,
    /// The material at the pixel, textures and vertex colours included.
    #[serde(with = "SurfaceReport")]
    pub surface: Surface,
    /// 1 opaque.
    pub opacity: f64,
    /// The textures that were read.
    pub texels: Vec<TexelReport>,
    /// The equation at the pixel itself. Flat and Phong shading draw its total; Gouraud and flat per face do not, so
    /// it serves as a comparison. Every shading uses its environment (`terms.environment`).
    #[serde(with = "TermsReport")]
    pub terms: Terms,
    /// The equation where the shading evaluates it, if that is not at the pixel: at the three corners (Gouraud) or at
    /// the centroid (flat per face), with the material's bare numbers and without environment. Else empty.
    #[serde(serialize_with = "terms")]
    pub at_vertices: Vec<Terms>,
    /// The light of `at_vertices` interpolated, which is then multiplied by `surface`.
    #[serde(serialize_with = "sums")]
    pub interpolated: Option<LightSums>,
    /// The light equation's value as the shading has it, without the environment.
    pub lit: DVec3,
    /// Reflection and refraction of the environment; plain where the frame has none.
    #[serde(with = "OpticsReport")]
    pub optics: Optics,
    /// The radiance from the surface to the eye: `lit` and the environment's light, as `optics` let them be seen.
    pub radiance: DVec3,
    /// The number of surfaces that are visible behind it.
    pub surfaces_behind: usize,
    /// The pixel: linear RGBA, premultiplied, background included.
    pub total: DVec4,
}

/// One texture's part.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TexelReport {
    /// The map: `diffuse`, `specular`, `emitted`, `shininess`, `opacity` or `normal`.
    pub map: &'static str,
    /// The texture's file.
    pub texture: String,
    /// The coordinates at which it was read, scale and offset applied, v up.
    pub uv: DVec2,
    /// RGBA as filtered, colours linear.
    pub value: DVec4,
}

/// The radiance behind all objects at the centre of a pixel.
pub(crate) fn behind(reference: &ReferenceScene, frame: &Frame, x: u32, y: u32) -> DVec4 {
    let frame = &Frame { samples: 1, ..frame.clone() };
    let centre = [f64::from(x) + 0.5, f64::from(y) + 0.5];
    let direction = || frame.camera.ray_direction(centre[0], centre[1], frame.width, frame.height);
    FrameContext::of_camera(reference, frame).behind(direction, centre[1] / f64::from(frame.height))
}

/// Probes pixels (column, row). What the pixels share is computed once.
pub(crate) fn probe_all(
    reference: &ReferenceScene,
    frame: &Frame,
    pixels: impl IntoIterator<Item = (u32, u32)>,
) -> Vec<Option<Probe>> {
    let frame = &Frame { samples: 1, ..frame.clone() };
    let context = FrameContext::of_camera(reference, frame);
    let eye = EyeSpace::new(reference.world(), frame);
    let mut visible = Visible::default();
    pixels.into_iter().map(|(x, y)| probe(&context, &eye, &mut visible, x, y)).collect()
}

fn probe(context: &FrameContext<'_>, eye: &EyeSpace, visible: &mut Visible, x: u32, y: u32) -> Option<Probe> {
    let (reference, frame) = (context.reference, context.frame);
    if x >= frame.width || y >= frame.height {
        return None;
    }
    visible.trace(reference.world(), eye, &[[0.5, 0.5]], Block { x0: x, y0: y, x1: x + 1, y1: y + 1 });
    let visible = &*visible;

    let mut cache = CornerCache::default();
    let sky = || context.behind(|| eye.direction(visible.rays[0]), (f64::from(y) + 0.5) / f64::from(frame.height));
    let surfaces = || context.surfaces(eye, visible, 0, &visible.layers);
    let (total, shaded) = context.radiance(surfaces(), sky, &mut cache);
    let nearest = surfaces().next()?;

    let fragment = &nearest.fragment;
    let scene = &reference.scene;
    let (triangle, shader) = (fragment.triangle, &context.shader);
    let object = &scene.objects[triangle.object as usize];
    let shading = Shader::shading(fragment);
    let point = shader.fragment_point(fragment);
    let surface = fragment.surface();
    let (at_vertices, interpolated) = shader.corner_terms(fragment, nearest.id).unzip();
    let texel = |t: crate::fragment::Texel| TexelReport {
        map: t.map,
        texture: scene.textures[t.texture].name.clone(),
        uv: t.uv,
        value: t.value,
    };
    let with_normal_map = shading == Shading::Phong && !fragment.mesh.tangents.is_empty();
    Some(Probe {
        x,
        y,
        object: triangle.object as usize,
        object_name: object.name.clone(),
        part_name: object.parts[triangle.part as usize].name.clone(),
        material: triangle.material as usize,
        material_name: fragment.material().material.name.clone(),
        triangle: triangle.in_mesh as usize,
        vertices: fragment.mesh_corners(),
        barycentrics: fragment.crossing.barycentrics,
        depth: fragment.crossing.depth,
        position: fragment.position,
        geometry: shader.geometry_of(fragment, &point),
        front_facing: fragment.front_facing,
        normal_turned: fragment.turn < 0.0,
        shading,
        surface,
        optics: context.shader.environment.as_ref().map_or_else(Optics::default, |_| fragment.material().optics),
        opacity: nearest.opacity,
        texels: fragment.texels(with_normal_map).into_iter().map(texel).collect(),
        terms: shader.terms(fragment, &point, &surface, &frame.lights),
        at_vertices: at_vertices.unwrap_or_default(),
        interpolated,
        lit: shader.lit(fragment, nearest.id, &surface, &mut cache),
        radiance: shader.radiance(fragment, nearest.id, &surface, &mut cache),
        surfaces_behind: shaded.saturating_sub(1) as usize,
        total,
    })
}

// Serialization of the types of `gonio-light`.

#[derive(Serialize)]
#[serde(remote = "ShadingPoint")]
struct PointReport {
    position: DVec3,
    normal: DVec3,
    view: DVec3,
    tangent: DVec3,
}

#[derive(Serialize)]
#[serde(remote = "Surface")]
struct SurfaceReport {
    ambient: DVec3,
    diffuse: DVec3,
    specular: DVec3,
    emitted: DVec3,
    shininess: f64,
    refraction_index: f64,
}

#[derive(Serialize)]
#[serde(remote = "Optics")]
struct OpticsReport {
    reflectivity: f64,
    transmission: f64,
    fresnel: Fresnel,
    tint: DVec3,
    absorption: DVec3,
    dispersion: f64,
    surfaces: Surfaces,
}

#[derive(Serialize)]
#[serde(remote = "Sight")]
struct SightReport {
    reflection: DVec3,
    reflected: DVec3,
    transmitted: DVec3,
    fresnel: DVec3,
}

#[derive(Serialize)]
#[serde(remote = "EnvironmentTerms")]
struct EnvironmentReport {
    diffuse: DVec3,
    specular: DVec3,
    #[serde(with = "SightReport")]
    sight: Sight,
}

#[derive(Serialize)]
#[serde(remote = "Geometry")]
struct GeometryReport {
    geometric_normal: DVec3,
    tangent: DVec3,
    uv: DVec2,
    depth: f64,
}

#[derive(Serialize)]
#[serde(remote = "LightSums")]
struct SumsReport {
    diffuse: DVec3,
    specular: DVec3,
}

#[derive(Serialize)]
#[serde(remote = "LightTerms")]
struct LightReport {
    light: usize,
    l: DVec3,
    distance: f64,
    attenuation: f64,
    spot: f64,
    cos_theta: f64,
    r: DVec3,
    h: DVec3,
    r_dot_v: f64,
    n_dot_h: f64,
    diff: f64,
    spec: f64,
    visibility: f64,
    incident: DVec3,
    diffuse_light: DVec3,
    specular_light: DVec3,
    diffuse: DVec3,
    specular: DVec3,
}

#[derive(Serialize)]
#[serde(remote = "Terms")]
struct TermsReport {
    #[serde(with = "PointReport")]
    point: ShadingPoint,
    #[serde(with = "SurfaceReport")]
    surface: Surface,
    ambient: DVec3,
    emitted: DVec3,
    diffuse: DVec3,
    specular: DVec3,
    #[serde(with = "EnvironmentReport")]
    environment: EnvironmentTerms,
    total: DVec3,
    #[serde(serialize_with = "lights")]
    lights: Vec<LightTerms>,
}

fn lights<S: Serializer>(lights: &[LightTerms], serializer: S) -> Result<S::Ok, S::Error> {
    #[derive(Serialize)]
    struct One<'a>(#[serde(with = "LightReport")] &'a LightTerms);
    serializer.collect_seq(lights.iter().map(One))
}

/// A list of terms.
fn terms<S: Serializer>(terms: &[Terms], serializer: S) -> Result<S::Ok, S::Error> {
    #[derive(Serialize)]
    struct One<'a>(#[serde(with = "TermsReport")] &'a Terms);
    serializer.collect_seq(terms.iter().map(One))
}

/// Sums that may be missing.
fn sums<S: Serializer>(sums: &Option<LightSums>, serializer: S) -> Result<S::Ok, S::Error> {
    match sums {
        Some(sums) => SumsReport::serialize(sums, serializer),
        None => serializer.serialize_none(),
    }
}
