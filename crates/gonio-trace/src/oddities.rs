//! What is odd about a scene, and what its picture makes of it.

use crate::lights::LightOrigin;
use crate::render::TraceScene;
use glam::{DVec3, Vec3};
use gonio_light::LightKind;
use gonio_light::color::luminance;
use std::fmt::{Display, Formatter};

/// Something that a trace survives. Displayed, it is one sentence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TraceOddity {
    /// No surface can be seen.
    Empty,
    /// There is no light but ambient light, which does not exist.
    Unlit,
    /// A material, by its number, with values that are not finite: light that meets it counts as black.
    Material(usize),
    /// A light, by its number, whose colour is not finite; it is left out.
    Light(usize),
    /// Texels of the environment that are not finite; not a number counts as black.
    Environment(usize),
    /// Triangles without area, which cannot be hit, in materials that emit light.
    LampsWithoutArea(usize),
    /// Triangles that emit light, and triangles in the same place as they: their number. Rounding decides which is seen.
    OverlappingLights(usize),
    /// Two lights, by their numbers, that are lamps in the same place: the first is seen.
    OverlappingLamps(usize, usize),
    /// Triangles that are left out because corners are not finite or do not exist.
    BrokenTriangles(usize),
}

impl Display for TraceOddity {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        match self {
            TraceOddity::Empty => f.write_str("the scene has no triangles; the picture shows the background"),
            TraceOddity::Unlit => f.write_str(
                "nothing lights the scene, so its objects are black; add a light, an environment or a material that emits \
                 light (ambient light does not exist)",
            ),
            TraceOddity::Material(index) => {
                write!(f, "material {index} has a value that is not a finite number; light that meets it counts as black")
            }
            TraceOddity::Light(index) => write!(f, "the colour of light {index} is not finite; the light is left out"),
            TraceOddity::Environment(count) => {
                write!(f, "{count} pixels of the environment are not finite; they count as black where they light objects")
            }
            TraceOddity::LampsWithoutArea(count) => {
                write!(f, "{count} triangles that emit light have no area; they give no light")
            }
            TraceOddity::OverlappingLights(count) => write!(
                f,
                "{count} triangles overlap in one plane, and some of them emit light: rounding decides which is seen; move \
                 them apart"
            ),
            TraceOddity::OverlappingLamps(first, second) => {
                write!(f, "lights {first} and {second} are lamps in the same place; where they overlap only light {first} shines")
            }
            TraceOddity::BrokenTriangles(count) => {
                write!(f, "{count} triangles have corners that are missing or not finite; they are left out")
            }
        }
    }
}

impl TraceScene {
    /// What is odd about the scene, and survived.
    pub fn oddities(&self) -> Vec<TraceOddity> {
        let TraceScene { frame, posed, .. } = self;
        let (scene, geometry, lights) = (&posed.scene, &posed.geometry, &posed.sources);
        let mut found = Vec::new();
        let mesh_of = |object: &gonio_scene::Object| scene.meshes.get(object.mesh);
        let all: usize = scene
            .objects
            .iter()
            .filter_map(|object| mesh_of(object).map(|mesh| (object, mesh.triangle_count())))
            .flat_map(|(object, most)| object.parts.iter().map(move |part| part.triangle_count.min(most)))
            .sum();
        if geometry.triangles.is_empty() {
            found.push(TraceOddity::Empty);
        }
        if all > geometry.triangles.len() {
            found.push(TraceOddity::BrokenTriangles(all - geometry.triangles.len()));
        }
        if lights.sources.is_empty() && !geometry.triangles.is_empty() {
            found.push(TraceOddity::Unlit);
        }
        for (index, material) in scene.materials.iter().enumerate() {
            let m = &material.material;
            let optics = &material.optics;
            let colors = [m.diffuse, m.specular, m.emitted].iter().all(|&c| Vec3::from(c).is_finite());
            let finite = colors
                && m.shininess.is_finite()
                && m.opacity.is_finite()
                && m.refraction_index.is_finite()
                && optics.tint.is_finite()
                && optics.absorption.is_finite();
            if !finite {
                found.push(TraceOddity::Material(index));
            }
        }
        for (index, light) in frame.lights.iter().enumerate() {
            if !matches!(light.kind, LightKind::Ambient) && !luminance(light.color).is_finite() {
                found.push(TraceOddity::Light(index));
            }
        }
        if let Some(environment) = scene.environment.as_ref().filter(|_| frame.surroundings.is_some()) {
            let is_odd = |p: &&[f32; 4]| !DVec3::new(p[0].into(), p[1].into(), p[2].into()).is_finite();
            let count = environment.mips.full().pixels().iter().filter(is_odd).count();
            if count > 0 {
                found.push(TraceOddity::Environment(count));
            }
        }
        let emits = |(index, t): &(usize, &crate::geometry::Triangle)| {
            let radiance = crate::material::bare_emitted(scene, t.material);
            radiance.max_element() > 0.0 && radiance.is_finite() && geometry.area(*index as u32) <= 0.0
        };
        let flat = geometry.triangles.iter().enumerate().filter(emits).count();
        if flat > 0 {
            found.push(TraceOddity::LampsWithoutArea(flat));
        }
        if !lights.overlapping.is_empty() {
            found.push(TraceOddity::OverlappingLights(lights.overlapping.len()));
        }
        for (first, second) in lights.overlapping_lamps() {
            if let (LightOrigin::Light(first), LightOrigin::Light(second)) =
                (lights.origins[first], lights.origins[second])
            {
                found.push(TraceOddity::OverlappingLamps(first, second));
            }
        }
        found
    }
}
