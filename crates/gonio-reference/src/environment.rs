//! The environment of a frame: what is seen of it in a direction, and what it adds to a surface.

use crate::body::ObjectBody;
use crate::fragment::Fragment;
use crate::shade::Shader;
use glam::DVec3;
use gonio_environment::prefilter::dominant_direction;
use gonio_environment::{BrdfTable, GlossyMips, SeparatedLights, harmonics};
use gonio_light::brdf::effective_shininess;
use gonio_light::function_light::lookup_level;
use gonio_light::microfacet::roughness_of_shininess;
use gonio_light::optics::{self, Body, EnvironmentTerms, Sight, boundary};
use gonio_light::{Optics, ShadingPoint, Surface, Surfaces};
use gonio_scene::scene_file::Shading;
use gonio_scene::{Frame, LoadedEnvironment, MaterialBrdf, Scene, Surroundings, TextureFilter};
use std::f64::consts::FRAC_1_PI;

/// The environment of a frame.
pub(crate) struct Environment<'a> {
    loaded: &'a LoadedEnvironment,
    surroundings: Surroundings,
    /// The frame's filter chooses among smaller copies.
    has_levels: bool,
    /// The level of the background.
    background_level: f64,
    /// The blurred background, where it is blurred.
    blurred: Option<&'a GlossyMips>,
    /// Diffuse light by the normal, where it counts.
    diffuse: Option<[DVec3; 9]>,
    /// The environment for materials with BRDFs of their own, if there are any that it lights, with the directions in the world
    /// and the irradiances of its small lights.
    separated: Option<(&'a SeparatedLights, Vec<(DVec3, DVec3)>)>,
    /// The environment in rough mirrors, if there are any. Both are computed before the threads start: computing them
    /// uses all threads, which would deadlock.
    glossy: Option<(&'a GlossyMips, &'static BrdfTable)>,
}

impl<'a> Environment<'a> {
    /// `None` where the frame has none. `sample_angle_rad` is the angle that a sample in the middle of the picture
    /// represents.
    ///
    /// Call it once per frame: it computes whatever the environment makes on demand.
    pub fn new(scene: &'a Scene, frame: &Frame, sample_angle_rad: f64) -> Option<Self> {
        let loaded: &LoadedEnvironment = scene.environment.as_ref()?;
        let surroundings = frame.surroundings?;
        let has_levels = matches!(frame.texture_filter, TextureFilter::Mipmap | TextureFilter::Anisotropic);
        let terms = &frame.equation.terms;
        let any_function = || scene.materials.iter().any(|m| m.brdf.is_some());
        let any_gloss = || scene.materials.iter().any(|m| m.brdf.is_none() && m.material.specular != [0.0; 3]);
        Some(Environment {
            loaded,
            surroundings,
            has_levels,
            background_level: if has_levels { level(loaded.seen().full().size(), sample_angle_rad) } else { 0.0 },
            blurred: (surroundings.visible && surroundings.blur > 0.0).then(|| loaded.seen_glossy()),
            diffuse: (surroundings.lights && terms.diffuse).then(|| loaded.harmonics().polynomial()),
            separated: (surroundings.lights && terms.specular && any_function()).then(|| {
                let world_from_environment = surroundings.environment_from_world.transpose();
                let separated = loaded.separated();
                let lights = separated.lights.iter().map(|l| (world_from_environment * l.direction, l.irradiance));
                (separated, lights.collect())
            }),
            glossy: (surroundings.lights && terms.specular && any_gloss()).then(|| (loaded.glossy(), BrdfTable::get())),
        })
    }

    /// `E(D)`: linear radiance from a unit direction in the world.
    fn radiance(&self, direction: DVec3, level: f64) -> DVec3 {
        self.surroundings.intensity
            * self.loaded.mips.sample(self.surroundings.environment_from_world * direction, level)
    }

    /// The radiance behind the objects from a unit direction in the world; `None` where the background colours are
    /// seen.
    pub fn background(&self, direction: impl FnOnce() -> DVec3) -> Option<DVec3> {
        self.surroundings.visible.then(|| {
            let direction = self.surroundings.environment_from_world * direction();
            let radiance = match self.blurred {
                Some(blurred) => blurred.sample(direction, self.surroundings.blur),
                None => self.loaded.seen().sample(direction, self.background_level),
            };
            self.surroundings.intensity * radiance
        })
    }

    /// Whether a surface with these optics looks other than without the environment.
    pub fn touches(&self, optics: &Optics) -> bool {
        self.surroundings.lights || !optics.is_plain()
    }

    /// The environment's terms at a fragment. `point` is that of Phong and flat shading: the fragment itself.
    pub fn terms(
        &self,
        shader: &Shader,
        fragment: &Fragment,
        point: &ShadingPoint,
        surface: &Surface,
    ) -> EnvironmentTerms {
        let optics = &fragment.material().optics;
        let (diffuse, specular) = match &fragment.material().brdf {
            None => (self.diffuse_light(point, surface), self.glossy_light(point, surface)),
            Some(brdf) => (DVec3::ZERO, self.function_light(point, brdf)),
        };
        EnvironmentTerms {
            diffuse,
            specular,
            sight: if optics.is_plain() {
                Sight::default()
            } else {
                self.sight(shader, fragment, point, surface, optics)
            },
        }
    }

    /// `k_d` times the irradiance over pi; zero where the environment does not light.
    fn diffuse_light(&self, point: &ShadingPoint, surface: &Surface) -> DVec3 {
        self.diffuse.as_ref().map_or(DVec3::ZERO, |polynomial| {
            let irradiance = harmonics::irradiance(polynomial, self.surroundings.environment_from_world * point.normal);
            surface.diffuse * irradiance * (self.surroundings.intensity * FRAC_1_PI)
        })
    }

    /// `k_s scale + bias` times the blurred environment about the middle of the mirror's lobe, by the split sum
    /// ([`gonio_environment::prefilter`]); zero for a black `k_s`, as such surfaces are matte, and where the
    /// environment does not light.
    fn glossy_light(&self, point: &ShadingPoint, surface: &Surface) -> DVec3 {
        let Some((glossy, table)) = self.glossy.filter(|_| surface.specular != DVec3::ZERO) else { return DVec3::ZERO };
        let roughness = roughness_of_shininess(effective_shininess(surface.shininess));
        let (scale, bias) = table.lookup(point.normal.dot(point.view), roughness);
        let middle = self.surroundings.environment_from_world * dominant_direction(point.normal, point.view, roughness);
        (surface.specular * scale + bias) * glossy.sample(middle, roughness) * self.surroundings.intensity
    }

    /// The light on a material with a BRDF of its own, all of which counts as specular: a sum over a few directions, as
    /// prefiltered light has none ([`gonio_light::function_light`]).
    fn function_light(&self, point: &ShadingPoint, brdf: &MaterialBrdf) -> DVec3 {
        let Some((separated, lights)) = &self.separated else { return DVec3::ZERO };
        let (mips, lights) =
            if brdf.lobe().is_wide() { (&separated.rest, lights.as_slice()) } else { (&self.loaded.mips, &[][..]) };
        let size = f64::from(mips.full().size());
        let radiance = |l: DVec3, w: f64| {
            let direction = self.surroundings.environment_from_world * l;
            mips.sample(direction, lookup_level(size, direction, w))
        };
        self.surroundings.intensity * brdf.environment_light(point, radiance, lights)
    }

    fn sight(
        &self,
        shader: &Shader,
        fragment: &Fragment,
        point: &ShadingPoint,
        surface: &Surface,
        optics: &Optics,
    ) -> Sight {
        let index = surface.refraction_index;
        let reflection = boundary(point.normal, point.view, index, optics.fresnel).reflected;
        let [reflected_level, transmitted_level] = self.levels(shader, fragment, point, index, optics);
        let radiance = |d: DVec3| self.radiance(d, if d == reflection { reflected_level } else { transmitted_level });
        let body = ObjectBody {
            geometry: shader.geometry,
            object: fragment.triangle.object,
            flat: matches!(Shader::shading(fragment), Shading::Flat | Shading::FlatPerFace),
        };
        let body = (optics.surfaces == Surfaces::Two).then_some(&body as &dyn Body);
        optics::sight(point, index, optics, &radiance, body)
    }

    /// The levels of the environment for `R` and for `T`, by the angle between neighbouring samples. Light from a body
    /// is looked up at the level of the `T` that enters it, and all channels at that of the middle one.
    fn levels(
        &self,
        shader: &Shader,
        fragment: &Fragment,
        point: &ShadingPoint,
        index: f64,
        optics: &Optics,
    ) -> [f64; 2] {
        if !self.has_levels {
            return [0.0; 2];
        }
        let here = boundary(point.normal, point.view, index, optics.fresnel);
        let mut largest = [0.0_f64; 2];
        for beside in [0, 1].into_iter().filter_map(|axis| fragment.beside(axis, shader.geometry)) {
            let beside = shader.fragment_point(&beside);
            let there = boundary(beside.normal, beside.view, index, optics.fresnel);
            largest[0] = largest[0].max(there.reflected.distance(here.reflected));
            if let (Some(there), Some(here)) = (there.transmitted, here.transmitted) {
                largest[1] = largest[1].max(there.distance(here));
            }
        }
        largest.map(|step| level(self.loaded.mips.full().size(), step))
    }
}

/// The level whose texels cover `step_rad`, not negative. A texel in the middle of a face covers 2 / size.
fn level(size: u32, step_rad: f64) -> f64 {
    (0.5 * f64::from(size) * step_rad).log2().max(0.0)
}
