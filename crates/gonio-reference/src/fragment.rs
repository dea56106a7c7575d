//! The point where a ray meets a triangle: position, texture coordinates, material.

use crate::geometry::{Triangle, WorldGeometry};
use crate::intersect::{Crossing, RaySpace, plane_barycentrics};
use glam::{DMat2, DVec2, DVec3, DVec4};
use gonio_light::Surface;
use gonio_mesh::Mesh;
use gonio_scene::{BoundTexture, Scene, SceneMaterial, TextureFilter};

/// The three corners' weights, applied to anything that corners have.
#[inline]
pub(crate) fn interpolate<T: std::ops::Mul<f64, Output = T> + std::ops::Add<Output = T>>(w: DVec3, v: [T; 3]) -> T {
    let [a, b, c] = v;
    a * w.x + b * w.y + c * w.z
}

/// A triangle and where a ray from the eye meets it.
#[derive(Clone, Copy)]
pub(crate) struct Hit<'a> {
    pub triangle: &'a Triangle,
    pub crossing: Crossing,
    pub ray: DVec2,
    pub space: &'a dyn RaySpace,
}

/// A place on a triangle, seen through one point of the picture.
#[derive(Clone)]
pub(crate) struct Fragment<'a> {
    pub scene: &'a Scene,
    pub mesh: &'a Mesh,
    pub triangle: &'a Triangle,
    pub crossing: Crossing,
    ray: DVec2,
    space: &'a dyn RaySpace,
    /// World space.
    pub position: DVec3,
    /// The front is seen.
    pub front_facing: bool,
    /// -1 where the normal is turned to the viewer, else 1.
    pub turn: f64,
    /// Unit, towards the front (not turned); zero for a triangle without area.
    pub geometric_normal: DVec3,
    /// v up; (0, 0) where the mesh has none.
    pub uv: DVec2,
    /// Change of `uv` to the next sample on the right, and to the one below.
    pub uv_steps: [DVec2; 2],
    pub filter: TextureFilter,
}

/// One texture's part in a fragment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Texel {
    /// The map of the material.
    pub map: &'static str,
    /// Index into the scene's textures.
    pub texture: usize,
    /// The coordinates at which it was read.
    pub uv: DVec2,
    /// RGBA, colours linear.
    pub value: DVec4,
}

impl<'a> Fragment<'a> {
    /// The fragment of a hit.
    pub fn new(
        scene: &'a Scene,
        geometry: &WorldGeometry,
        two_sided: bool,
        filter: TextureFilter,
        hit: Hit<'a>,
    ) -> Self {
        let Hit { triangle, crossing, ray, space } = hit;
        let mesh = &scene.meshes[scene.objects[triangle.object as usize].mesh];
        let front_facing = crossing.counter_clockwise != triangle.mirrored;
        let mut fragment = Fragment {
            scene,
            mesh,
            triangle,
            crossing,
            ray,
            space,
            position: interpolate(crossing.barycentrics, geometry.corners(triangle)),
            front_facing,
            turn: if two_sided && !front_facing { -1.0 } else { 1.0 },
            geometric_normal: geometry.geometric_normal(triangle),
            uv: DVec2::ZERO,
            uv_steps: [DVec2::ZERO; 2],
            filter,
        };
        if !mesh.tex_coords.is_empty() {
            let corner_uvs = fragment.corner_uvs();
            let uv = interpolate(crossing.barycentrics, corner_uvs);
            fragment.uv = uv;
            if fragment.has_maps() {
                fragment.uv_steps = std::array::from_fn(|axis| {
                    fragment
                        .weights_beside(axis)
                        .map_or(DVec2::ZERO, |(w, sign)| sign * (interpolate(w, corner_uvs) - uv))
                });
            }
        }
        fragment
    }

    /// Texture coordinates at the corners; only for meshes that have them.
    fn corner_uvs(&self) -> [DVec2; 3] {
        self.mesh_corners().map(|v| corner(&self.mesh.tex_coords, v).map_or(DVec2::ZERO, uv_of))
    }

    /// Weights where the ray of the next sample (`axis` 0: to the right, 1: below) meets the triangle's plane, and 1; or
    /// those of the sample before and -1, where the next one looks past the plane's horizon.
    fn weights_beside(&self, axis: usize) -> Option<(DVec3, f64)> {
        let corners = self.space.corners(self.triangle.vertices);
        let step = self.space.steps()[axis];
        [1.0, -1.0].into_iter().find_map(|sign| {
            plane_barycentrics(&corners, self.ray + sign * step, self.crossing.counter_clockwise).map(|w| (w, sign))
        })
    }

    /// The same triangle's plane as the next sample sees it (`axis` 0: to the right, 1: below), or the sample before where
    /// the next one does not see it; for differences between them.
    pub fn beside(&self, axis: usize, geometry: &WorldGeometry) -> Option<Fragment<'a>> {
        let (weights, _) = self.weights_beside(axis)?;
        let mut beside = self.clone();
        beside.crossing.barycentrics = weights;
        beside.position = interpolate(weights, geometry.corners(self.triangle));
        if !self.mesh.tex_coords.is_empty() {
            beside.uv = interpolate(weights, self.corner_uvs());
        }
        Some(beside)
    }

    /// The corners as the mesh numbers them.
    pub fn mesh_corners(&self) -> [usize; 3] {
        self.mesh.triangle(self.triangle.in_mesh as usize)
    }

    /// The material.
    pub fn material(&self) -> &'a SceneMaterial {
        &self.scene.materials[self.triangle.material as usize]
    }

    fn has_maps(&self) -> bool {
        let maps = &self.material().maps;
        [&maps.diffuse, &maps.specular, &maps.emitted, &maps.shininess, &maps.opacity, &maps.normal]
            .iter()
            .any(|m| m.is_some())
    }

    /// The colour of the mesh at the fragment; white where it has none.
    fn vertex_color(&self) -> DVec3 {
        if self.mesh.colors.is_empty() {
            return DVec3::ONE;
        }
        let colors = self.mesh_corners().map(|v| {
            corner(&self.mesh.colors, v).map_or(DVec3::ONE, |c| DVec3::new(c[0].into(), c[1].into(), c[2].into()))
        });
        interpolate(self.crossing.barycentrics, colors)
    }

    /// A texture of the material at the fragment.
    pub fn texel(&self, map: &'static str, bound: &Option<BoundTexture>) -> Option<Texel> {
        let bound = bound.as_ref()?;
        let texture = self.scene.textures.get(bound.texture)?;
        let [u_axis, v_axis, offset] = bound.uv_matrix().map(uv_of);
        let linear = DMat2::from_cols(u_axis, v_axis);
        let uv = linear * self.uv + offset;
        let [dx, dy] = self.uv_steps.map(|step| linear * step);
        let value = texture.sample(uv, dx, dy, self.filter, bound.wrap);
        Some(Texel { map, texture: bound.texture, uv, value })
    }

    /// `d` times the red of `map_d`.
    pub fn opacity(&self) -> f64 {
        let material = self.material();
        let map = self.texel("opacity", &material.maps.opacity).map_or(1.0, |t| t.value.x);
        f64::from(material.material.opacity) * map
    }

    /// The material at the fragment.
    pub fn surface(&self) -> Surface {
        self.material().surface(self.vertex_color(), |map, bound| self.texel(map, bound).map(|t| t.value))
    }

    /// All textures that the fragment reads; for reports.
    pub fn texels(&self, with_normal_map: bool) -> Vec<Texel> {
        let maps = &self.material().maps;
        let named = [
            ("diffuse", &maps.diffuse),
            ("specular", &maps.specular),
            ("emitted", &maps.emitted),
            ("shininess", &maps.shininess),
            ("opacity", &maps.opacity),
            ("normal", if with_normal_map { &maps.normal } else { &None }),
        ];
        named.iter().filter_map(|(name, bound)| self.texel(name, bound)).collect()
    }
}

/// A vertex attribute, if the mesh has it.
pub(crate) fn corner<T: Copy>(values: &[T], vertex: usize) -> Option<T> {
    values.get(vertex).copied()
}

fn uv_of(v: [f32; 2]) -> DVec2 {
    DVec2::new(v[0].into(), v[1].into())
}
