//! The equation at a fragment, evaluated at the points that the object's shading chooses.

use crate::environment::Environment;
use crate::fragment::{Fragment, corner, interpolate};
use crate::geometry::WorldGeometry;
use crate::shadow::Shadows;
use glam::DVec3;
use gonio_light::quantity::Geometry;
use gonio_light::{
    Light, LightSums, LightTerms, MaterialFunction, Quantity, ShadingPoint, Surface, Terms, light, vector,
};
use gonio_scene::scene_file::Shading;
use gonio_scene::{Frame, SceneMaterial, ViewSpec};

/// Light at a triangle's corners (Gouraud) or at its centroid (flat per face; all three are then the same).
#[derive(Clone, Debug)]
pub(crate) struct CornerLight {
    triangle: u32,
    turned: bool,
    pub sums: [LightSums; 3],
    /// All terms, if a view needs them.
    pub terms: Option<[Terms; 3]>,
}

/// The last corners' light, by triangle: neighbouring samples share it. Only saves time, never changes a value.
pub(crate) struct CornerCache {
    entries: Vec<Option<CornerLight>>,
}

impl Default for CornerCache {
    fn default() -> Self {
        CornerCache { entries: vec![None; 64] }
    }
}

impl CornerCache {
    /// Forgets everything: for another frame.
    pub fn clear(&mut self) {
        self.entries.fill(None);
    }
}

/// Evaluates the equation for one frame.
pub(crate) struct Shader<'a> {
    pub geometry: &'a WorldGeometry,
    pub frame: &'a Frame,
    /// `None` where the frame has none.
    pub environment: Option<Environment<'a>>,
    /// `None` where the frame has none.
    pub shadows: Option<Shadows<'a>>,
}

impl Shader<'_> {
    /// The shading of the fragment's object.
    pub fn shading(fragment: &Fragment) -> Shading {
        fragment.scene.objects[fragment.triangle.object as usize].shading
    }

    fn point(
        &self,
        material: &SceneMaterial,
        position: DVec3,
        normal: DVec3,
        fallback: DVec3,
        tangent: Option<DVec3>,
    ) -> ShadingPoint {
        let mut point = ShadingPoint::new(position, normal, fallback, self.frame.camera.position);
        if let Some(tangent) = tangent.and_then(|t| vector::unit(t - point.normal * point.normal.dot(t))) {
            point.tangent = tangent;
        } else if material.brdf.is_some() {
            point.tangent = vector::horizontal_tangent(point.normal);
        }
        point
    }

    /// The corners' tangents in world space (not normalised) with their handedness, where the mesh has them.
    fn tangents(&self, fragment: &Fragment) -> Option<[(DVec3, f64); 3]> {
        if fragment.mesh.tangents.is_empty() {
            return None;
        }
        let placement = &self.geometry.placements[fragment.triangle.object as usize];
        Some(fragment.mesh_corners().map(|v| {
            let [x, y, z, w] = corner(&fragment.mesh.tangents, v).unwrap_or_default().map(f64::from);
            (placement.world_from_model * DVec3::new(x, y, z), w * placement.handedness)
        }))
    }

    /// The point at which flat and Phong shading evaluate. For Gouraud shading the same as for Phong (without normal
    /// map): what a view of the tangent, or a report that compares, shows.
    pub fn fragment_point(&self, fragment: &Fragment) -> ShadingPoint {
        let weights = fragment.crossing.barycentrics;
        let geometric = fragment.geometric_normal * fragment.turn;
        let tangents = self.tangents(fragment);
        let tangent = tangents.map(|t| interpolate(weights, t.map(|(t, _)| t)));
        let shading = Self::shading(fragment);
        if matches!(shading, Shading::Flat | Shading::FlatPerFace) {
            return self.point(fragment.material(), fragment.position, geometric, geometric, tangent);
        }
        let corner_normals = fragment.triangle.vertices.map(|v| self.geometry.normals[v as usize]);
        let normal = interpolate(weights, corner_normals) * fragment.turn;
        let point = self.point(fragment.material(), fragment.position, normal, geometric, tangent);
        if shading != Shading::Phong {
            return point;
        }
        let (Some(tangent), Some(tangents)) = (tangent, tangents) else { return point };
        let Some(texel) = fragment.texel("normal", &fragment.material().maps.normal) else { return point };
        // The normal map's frame about the interpolated normal; without a direction along u there is none.
        let n = point.normal;
        let Some(t) = vector::unit(tangent - n * n.dot(tangent)) else { return point };
        let handedness = if interpolate(weights, tangents.map(|(_, w)| w)) < 0.0 { -1.0 } else { 1.0 };
        let b = handedness * n.cross(t);
        let m = 2.0 * texel.value.truncate() - DVec3::ONE;
        self.point(fragment.material(), fragment.position, t * m.x + b * m.y + n * m.z, n, Some(tangent))
    }

    /// The points at which Gouraud shading (the corners) and flat shading per face (the centroid, three times)
    /// evaluate.
    fn corner_points(&self, fragment: &Fragment) -> [ShadingPoint; 3] {
        let geometric = fragment.geometric_normal * fragment.turn;
        let positions = self.geometry.corners(fragment.triangle);
        let tangents = self.tangents(fragment).map(|t| t.map(|(t, _)| t));
        if Self::shading(fragment) == Shading::FlatPerFace {
            let third = DVec3::splat(1.0 / 3.0);
            let tangent = tangents.map(|t| interpolate(third, t));
            [self.point(fragment.material(), interpolate(third, positions), geometric, geometric, tangent); 3]
        } else {
            std::array::from_fn(|i| {
                let normal = self.geometry.normals[fragment.triangle.vertices[i] as usize] * fragment.turn;
                self.point(fragment.material(), positions[i], normal, geometric, tangents.map(|t| t[i]))
            })
        }
    }

    /// The share of a light that reaches a point.
    fn visibility(&self, point: &ShadingPoint, light: &LightTerms) -> f64 {
        self.shadows.as_ref().map_or(1.0, |shadows| shadows.visibility(point.position, light))
    }

    /// The sums over the lights, shadows included.
    fn light_sums(&self, material: &SceneMaterial, point: &ShadingPoint, surface: &Surface) -> LightSums {
        let Frame { equation, lights, .. } = self.frame;
        with_function(material, |brdf| {
            equation.light_sums_where(point, surface, lights, brdf, |light| self.visibility(point, light))
        })
    }

    /// Every term at a point, shadows included.
    fn evaluate(&self, material: &SceneMaterial, point: &ShadingPoint, surface: &Surface, lights: &[Light]) -> Terms {
        let equation = &self.frame.equation;
        with_function(material, |brdf| {
            equation.evaluate_where(point, surface, lights, brdf, |light| self.visibility(point, light))
        })
    }

    /// Light at the corners or at the centroid, remembered from the last sample on the same triangle.
    fn corner_light<'c>(
        &self,
        fragment: &Fragment,
        id: u32,
        with_terms: bool,
        cache: &'c mut CornerCache,
    ) -> &'c CornerLight {
        let turned = fragment.turn < 0.0;
        let slot = id as usize % cache.entries.len();
        let entry = &mut cache.entries[slot];
        let known = entry
            .as_ref()
            .is_some_and(|e| e.triangle == id && e.turned == turned && (e.terms.is_some() || !with_terms));
        if !known {
            *entry = None;
        }
        entry.get_or_insert_with(|| {
            let points = self.corner_points(fragment);
            let material = fragment.material();
            let surface = material.base_surface();
            let once = Self::shading(fragment) == Shading::FlatPerFace;
            let sums = thrice(once, |i| self.light_sums(material, &points[i], &surface));
            let terms =
                with_terms.then(|| thrice(once, |i| self.evaluate(material, &points[i], &surface, &self.frame.lights)));
            CornerLight { triangle: id, turned, sums, terms }
        })
    }

    /// Every term at the corners (Gouraud) or at the centroid (flat per face), and the light that reaches the
    /// fragment; `None` for shadings that evaluate at the fragment.
    pub fn corner_terms(&self, fragment: &Fragment, id: u32) -> Option<(Vec<Terms>, LightSums)> {
        let shading = Self::shading(fragment);
        let count = match shading {
            Shading::Flat | Shading::Phong => return None,
            Shading::FlatPerFace => 1,
            Shading::Gouraud => 3,
        };
        let mut cache = CornerCache::default();
        let light = self.corner_light(fragment, id, true, &mut cache);
        let terms = light.terms.iter().flatten().take(count).cloned().collect();
        Some((terms, interpolated_sums(fragment, light)))
    }

    /// The radiance from the fragment to the eye: `L_o`, and the environment as the material's optics show it.
    pub fn radiance(&self, fragment: &Fragment, id: u32, surface: &Surface, cache: &mut CornerCache) -> DVec3 {
        let lit = self.lit(fragment, id, surface, cache);
        let optics = &fragment.material().optics;
        match self.environment.as_ref().filter(|e| e.touches(optics)) {
            None => lit,
            Some(environment) => {
                let seen = environment.terms(self, fragment, &self.fragment_point(fragment), surface);
                optics.compose(lit + seen.diffuse + seen.specular, &seen.sight)
            }
        }
    }

    /// Every term at the fragment itself, whatever the shading.
    pub fn terms(&self, fragment: &Fragment, point: &ShadingPoint, surface: &Surface, lights: &[Light]) -> Terms {
        let terms = self.evaluate(fragment.material(), point, surface, lights);
        let optics = &fragment.material().optics;
        match &self.environment {
            None => terms,
            Some(environment) => terms.with_environment(environment.terms(self, fragment, point, surface), optics),
        }
    }

    /// `L_o` at the fragment, without what it shows of its surroundings.
    pub fn lit(&self, fragment: &Fragment, id: u32, surface: &Surface, cache: &mut CornerCache) -> DVec3 {
        let Frame { equation, lights, .. } = self.frame;
        match Self::shading(fragment) {
            Shading::Flat | Shading::Phong => {
                let sums = self.light_sums(fragment.material(), &self.fragment_point(fragment), surface);
                equation.radiance_from_sums(surface, light::ambient_color(lights), &sums)
            }
            Shading::Gouraud | Shading::FlatPerFace => {
                let sums = interpolated_sums(fragment, self.corner_light(fragment, id, false, cache));
                equation.radiance_from_sums(surface, light::ambient_color(lights), &sums)
            }
        }
    }

    /// The fragment's geometry besides the equation's terms. The tangent is the mesh's, made perpendicular to the
    /// shading normal, unit; zero where the mesh has none.
    pub fn geometry_of(&self, fragment: &Fragment, point: &ShadingPoint) -> Geometry {
        Geometry {
            geometric_normal: fragment.geometric_normal,
            tangent: if fragment.mesh.tangents.is_empty() { DVec3::ZERO } else { point.tangent },
            uv: fragment.uv,
            depth: fragment.crossing.depth,
        }
    }

    /// A debug view's value at the fragment: what [`Terms::quantity`] gives where the shading evaluates.
    ///
    /// Flat and Phong: at the fragment. Gouraud and flat per face: place and triangle (position, depth, uv, geometric
    /// normal, tangent) and all that is seen of the environment at the fragment; `k_d`, A, E and the two sums with the
    /// fragment's material and the interpolated light; everything else at the corners (the centroid) with the
    /// material's bare numbers, interpolated.
    pub fn quantity(
        &self,
        fragment: &Fragment,
        id: u32,
        surface: &Surface,
        view: ViewSpec,
        cache: &mut CornerCache,
    ) -> DVec3 {
        let Frame { equation, lights, .. } = self.frame;
        let point = self.fragment_point(fragment);
        let geometry = self.geometry_of(fragment, &point);
        if matches!(Self::shading(fragment), Shading::Flat | Shading::Phong) {
            let lights = if needs_lights(view.quantity) { lights.as_slice() } else { &[] };
            let terms = if needs_environment(view.quantity) {
                self.terms(fragment, &point, surface, lights)
            } else {
                self.evaluate(fragment.material(), &point, surface, lights)
            };
            return terms.quantity(view.quantity, view.light, &geometry);
        }
        let weights = fragment.crossing.barycentrics;
        match view.quantity {
            Quantity::Position => fragment.position,
            Quantity::GeometricNormal => geometry.geometric_normal,
            Quantity::Tangent => geometry.tangent,
            Quantity::Uv => geometry.uv.extend(0.0),
            Quantity::Depth => DVec3::splat(geometry.depth),
            Quantity::Albedo => surface.diffuse,
            Quantity::Ambient => equation.ambient(surface, light::ambient_color(lights)),
            Quantity::Emitted => equation.emitted(surface),
            Quantity::Total => self.radiance(fragment, id, surface, cache),
            Quantity::Fresnel
            | Quantity::EnvironmentDiffuse
            | Quantity::EnvironmentSpecular
            | Quantity::Reflected
            | Quantity::Transmitted => {
                self.terms(fragment, &point, surface, &[]).quantity(view.quantity, None, &geometry)
            }
            Quantity::Diffuse | Quantity::Specular => {
                let diffuse = view.quantity == Quantity::Diffuse;
                let albedo = if diffuse { surface.diffuse } else { surface.specular };
                let corners = self.corner_light(fragment, id, view.light.is_some(), cache);
                let light = match (&corners.terms, view.light) {
                    (Some(terms), Some(index)) => {
                        let one = |t: &Terms| {
                            let chosen = t.lights.iter().find(|l| l.light == index);
                            chosen.map_or(DVec3::ZERO, |l| if diffuse { l.diffuse_light } else { l.specular_light })
                        };
                        interpolate(weights, [one(&terms[0]), one(&terms[1]), one(&terms[2])])
                    }
                    _ => {
                        let sums = interpolated_sums(fragment, corners);
                        if diffuse { sums.diffuse } else { sums.specular }
                    }
                };
                albedo * light
            }
            quantity => match &self.corner_light(fragment, id, true, cache).terms {
                Some(terms) => {
                    let value = |t: &Terms| t.quantity(quantity, view.light, &geometry);
                    interpolate(weights, [value(&terms[0]), value(&terms[1]), value(&terms[2])])
                }
                None => DVec3::ZERO,
            },
        }
    }
}

/// Calls `f` with the material's own BRDF, if it has one.
fn with_function<T>(material: &SceneMaterial, f: impl FnOnce(Option<MaterialFunction<'_>>) -> T) -> T {
    match &material.brdf {
        Some(brdf) => f(Some(&|point, l| brdf.evaluate(point, l))),
        None => f(None),
    }
}

/// `f` at 0, 1, 2, or its value at 0 three times.
fn thrice<T: Clone>(once: bool, f: impl Fn(usize) -> T) -> [T; 3] {
    if once {
        let value = f(0);
        [value.clone(), value.clone(), value]
    } else {
        [f(0), f(1), f(2)]
    }
}

fn interpolated_sums(fragment: &Fragment, light: &CornerLight) -> LightSums {
    let weights = fragment.crossing.barycentrics;
    LightSums {
        diffuse: interpolate(weights, light.sums.map(|s| s.diffuse)),
        specular: interpolate(weights, light.sums.map(|s| s.specular)),
    }
}

/// Whether a quantity at a fragment is other without lights.
fn needs_lights(quantity: Quantity) -> bool {
    use Quantity::*;
    !matches!(
        quantity,
        Normal
            | GeometricNormal
            | Tangent
            | Position
            | Depth
            | Uv
            | View
            | Refraction
            | ViewReflection
            | Albedo
            | Emitted
            | Fresnel
            | EnvironmentDiffuse
            | EnvironmentSpecular
            | Reflected
            | Transmitted
    )
}

/// Whether a quantity at a fragment is other without an environment.
fn needs_environment(quantity: Quantity) -> bool {
    use Quantity::*;
    matches!(quantity, Fresnel | EnvironmentDiffuse | EnvironmentSpecular | Reflected | Transmitted | Total)
}
