//! Hard shadows: whether a triangle is between a point and a light.

use crate::fragment::interpolate;
use crate::geometry::{Triangle, WorldGeometry};
use crate::intersect::Crossing;
use crate::ray::Ray;
use glam::{DMat2, DVec2, DVec3};
use gonio_light::LightTerms;
use gonio_scene::scene::{SHADOW_OPACITY, ShadowCaster};
use gonio_scene::{Scene, TextureFilter};

/// Triangles nearer to the point than this share of the diagonal of the box around all objects block nothing: they are the
/// surface itself.
const NEAREST_BLOCKER: f64 = 1e-6;

/// The triangles of a scene that block light.
pub(crate) struct Shadows<'a> {
    scene: &'a Scene,
    geometry: &'a WorldGeometry,
    /// The part of each material that blocks light.
    casters: Vec<ShadowCaster>,
    /// World units.
    nearest: f64,
}

impl<'a> Shadows<'a> {
    /// The shadows of all objects. `in_environment`: an environment is seen through clear materials.
    pub fn new(scene: &'a Scene, geometry: &'a WorldGeometry, in_environment: bool) -> Self {
        let casters = scene.materials.iter().map(|material| material.shadow_caster(in_environment)).collect();
        let nearest = geometry.tree.as_ref().map_or(0.0, |tree| NEAREST_BLOCKER / tree.scale);
        Shadows { scene, geometry, casters, nearest }
    }

    /// `v`: 1 if the segment from the point to the light meets no triangle that blocks light, from either side; else 0.
    /// Directional lights are infinitely far away.
    pub fn visibility(&self, position: DVec3, light: &LightTerms) -> f64 {
        let farthest = light.distance - self.nearest;
        let mut blocked = false;
        Ray::new(position, light.l).trace(self.geometry, |_, triangle, crossing| {
            let between = crossing.depth > self.nearest && crossing.depth < farthest;
            if between && self.blocks(triangle, &crossing) {
                blocked = true;
            }
            // Any triangle is enough.
            if blocked { f64::NEG_INFINITY } else { farthest }
        });
        if blocked { 0.0 } else { 1.0 }
    }

    fn blocks(&self, triangle: &Triangle, crossing: &Crossing) -> bool {
        match self.casters.get(triangle.material as usize) {
            Some(ShadowCaster::Everything) => true,
            Some(ShadowCaster::WhereOpaque) => self.opacity(triangle, crossing) >= SHADOW_OPACITY,
            Some(ShadowCaster::Nothing) | None => false,
        }
    }

    /// The opacity where a ray to a light crosses a triangle; the texture in its full size, filtered linearly.
    fn opacity(&self, triangle: &Triangle, crossing: &Crossing) -> f64 {
        let material = &self.scene.materials[triangle.material as usize];
        let opacity = f64::from(material.material.opacity);
        let Some(map) = &material.maps.opacity else { return opacity };
        let Some(texture) = self.scene.textures.get(map.texture) else { return opacity };
        let Some(mesh) = self.scene.objects.get(triangle.object as usize).and_then(|o| self.scene.meshes.get(o.mesh))
        else {
            return opacity;
        };
        let vector = |v: [f32; 2]| DVec2::new(v[0].into(), v[1].into());
        let corners = mesh.triangle(triangle.in_mesh as usize);
        let uvs = corners.map(|v| mesh.tex_coords.get(v).map_or(DVec2::ZERO, |&uv| vector(uv)));
        let uv = interpolate(crossing.barycentrics, uvs);
        let [u_axis, v_axis, offset] = map.uv_matrix().map(vector);
        let uv = DMat2::from_cols(u_axis, v_axis) * uv + offset;
        opacity * texture.sample(uv, DVec2::ZERO, DVec2::ZERO, TextureFilter::Linear, map.wrap).x
    }
}
