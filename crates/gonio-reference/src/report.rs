//! Serialization of the types of `gonio-light` in reports.

use glam::{DVec2, DVec3};
use gonio_light::optics::EnvironmentTerms;
use gonio_light::quantity::Geometry;
use gonio_light::{Fresnel, LightSums, LightTerms, Optics, ShadingPoint, Sight, Surface, Surfaces, Terms};
use serde::{Serialize, Serializer};

#[derive(Serialize)]
#[serde(remote = "ShadingPoint")]
pub(crate) struct PointReport {
    position: DVec3,
    normal: DVec3,
    view: DVec3,
    tangent: DVec3,
}

#[derive(Serialize)]
#[serde(remote = "Surface")]
pub(crate) struct SurfaceReport {
    ambient: DVec3,
    diffuse: DVec3,
    specular: DVec3,
    emitted: DVec3,
    shininess: f64,
    refraction_index: f64,
}

#[derive(Serialize)]
#[serde(remote = "Optics")]
pub(crate) struct OpticsReport {
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
pub(crate) struct GeometryReport {
    geometric_normal: DVec3,
    tangent: DVec3,
    uv: DVec2,
    depth: f64,
}

#[derive(Serialize)]
#[serde(remote = "LightSums")]
pub(crate) struct SumsReport {
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
    incident: DVec3,
    diffuse_light: DVec3,
    specular_light: DVec3,
    diffuse: DVec3,
    specular: DVec3,
}

#[derive(Serialize)]
#[serde(remote = "Terms")]
pub(crate) struct TermsReport {
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
pub(crate) fn terms<S: Serializer>(terms: &[Terms], serializer: S) -> Result<S::Ok, S::Error> {
    #[derive(Serialize)]
    struct One<'a>(#[serde(with = "TermsReport")] &'a Terms);
    serializer.collect_seq(terms.iter().map(One))
}

/// Sums that may be missing.
pub(crate) fn sums<S: Serializer>(sums: &Option<LightSums>, serializer: S) -> Result<S::Ok, S::Error> {
    match sums {
        Some(sums) => SumsReport::serialize(sums, serializer),
        None => serializer.serialize_none(),
    }
}
