//! Figures about texture coordinates: coverage, stretch, density, overlaps.

use crate::raster::for_each_texel;
use crate::unwrap::AtlasUv;
use glam::{DVec2, DVec3};
use gonio_mesh::Mesh;
use serde::{Deserialize, Deserializer, Serialize};

/// Figures about the texture coordinates of a mesh, for a texture of `size` x `size` texels.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct UvReport {
    /// Triangles of the mesh.
    pub triangles: usize,
    /// Triangles without an area in space.
    pub degenerate_triangles: usize,
    /// Connected pieces of the atlas.
    pub charts: usize,
    /// Side of the texture in texels.
    pub size: u32,
    /// The share of the texture that triangles cover, 0 to 1: the sum of their areas, so overlaps count twice.
    #[serde(deserialize_with = "nan_from_null")]
    pub coverage: f64,
    /// Mean over the surface of the ratio of the larger to the smaller stretch of a triangle, at least 1: 1 keeps all
    /// angles.
    #[serde(deserialize_with = "nan_from_null")]
    pub angle_stretch: f64,
    /// Mean over the surface of max(r, 1 / r), at least 1, where r is the share of a triangle in the area of all triangles
    /// in the texture, divided by its share in space: 1 keeps all areas.
    #[serde(deserialize_with = "nan_from_null")]
    pub area_stretch: f64,
    /// Triangles without an area in the texture; they are left out of both means.
    pub collapsed_triangles: usize,
    /// Triangles that are mirrored in the texture.
    pub mirrored_triangles: usize,
    /// Texels whose centres two or more triangles cover.
    pub overlapping_texels: usize,
    /// Texels per unit of length in space: the root of all texels by the whole area.
    #[serde(deserialize_with = "nan_from_null")]
    pub texels_per_unit: f64,
    /// The distance between charts that was kept, in texels.
    pub margin_texels: f64,
}

/// JSON has no NaN, which a mesh without an area leads to: it is written as null.
fn nan_from_null<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(from)?.unwrap_or(f64::NAN))
}

/// Returns the figures about texture coordinates of a mesh.
pub fn uv_report(mesh: &Mesh, atlas: &AtlasUv, size: u32) -> UvReport {
    let triangles: Vec<Stretch> = (0..mesh.triangle_count()).map(|t| Stretch::new(mesh, atlas, t)).collect();
    let in_space: f64 = triangles.iter().map(|t| t.area_in_space).sum();
    let in_texture: f64 = triangles.iter().map(|t| t.area_in_texture.abs()).sum();
    let (mut angle, mut area, mut weight) = (0.0, 0.0, 0.0);
    let is_real = |t: &&Stretch| t.area_in_space > 0.0 && t.is_real;
    for t in triangles.iter().filter(is_real).filter(|t| t.angle.is_finite() && t.area_in_texture != 0.0) {
        let ratio = (t.area_in_texture.abs() / in_texture) / (t.area_in_space / in_space);
        angle += t.area_in_space * t.angle;
        area += t.area_in_space * ratio.max(1.0 / ratio);
        weight += t.area_in_space;
    }
    UvReport {
        triangles: triangles.len(),
        degenerate_triangles: triangles.iter().filter(|t| !t.is_real).count(),
        charts: atlas.chart_count,
        size,
        coverage: in_texture,
        angle_stretch: angle / weight,
        area_stretch: area / weight,
        collapsed_triangles: triangles.iter().filter(|t| t.is_real && t.area_in_texture == 0.0).count(),
        mirrored_triangles: triangles.iter().filter(|t| t.is_real && t.area_in_texture < 0.0).count(),
        overlapping_texels: overlapping_texels(atlas, size),
        texels_per_unit: f64::from(size) * (in_texture / in_space).sqrt(),
        margin_texels: atlas.margin * f64::from(size),
    }
}

/// How a triangle is carried from space to the texture.
struct Stretch {
    area_in_space: f64,
    /// Negative if it is mirrored.
    area_in_texture: f64,
    /// The ratio of the singular values of the map.
    angle: f64,
    is_real: bool,
}

impl Stretch {
    fn new(mesh: &Mesh, atlas: &AtlasUv, triangle: usize) -> Self {
        let [a, b, c] = mesh.triangle(triangle).map(|i| DVec3::from(mesh.positions[i].map(f64::from)));
        let uv = |k: usize| DVec2::from(atlas.tex_coords[3 * triangle + k].map(f64::from));
        let (u, v) = (uv(1) - uv(0), uv(2) - uv(0));
        let right = (b - a).normalize_or(DVec3::X);
        let (length, x) = ((b - a).length(), (c - a).dot(right));
        let y = ((c - a) - x * right).length();
        // The columns of the map from the triangle's plane to the texture.
        let (first, second) = (u / length, (v - u * (x / length)) / y);
        let (sum, difference) = (first.length_squared() + second.length_squared(), {
            let (d, e) = (first.length_squared() - second.length_squared(), 2.0 * first.dot(second));
            d.hypot(e)
        });
        let angle = ((sum + difference) / (sum - difference).max(0.0)).sqrt();
        Stretch {
            area_in_space: 0.5 * length * y,
            area_in_texture: 0.5 * u.perp_dot(v),
            angle,
            is_real: atlas.chart_of_triangle[triangle].is_some(),
        }
    }
}

/// The number of texels whose centres two or more triangles cover.
fn overlapping_texels(atlas: &AtlasUv, size: u32) -> usize {
    let mut counts = vec![0_u8; size as usize * size as usize];
    for corners in atlas.tex_coords.as_chunks::<3>().0 {
        for_each_texel(*corners, size, |x, y| {
            let count = &mut counts[y as usize * size as usize + x as usize];
            *count = count.saturating_add(1);
        });
    }
    counts.iter().filter(|count| **count > 1).count()
}
