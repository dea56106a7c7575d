//! The light equation: its switches, its terms by name, and their sum.

use crate::brdf::{self, BrdfKind, BrdfSettings};
use crate::color::capped;
use crate::light::{self, Light};
use crate::optics::{EnvironmentTerms, Optics};
use crate::shading_point::{ShadingPoint, Surface};
use crate::vector;
use glam::DVec3;
use std::f64::consts::{FRAC_1_PI, PI};

named_enum! {
    /// The convention for `diff`, and so for the unit of `L_i`.
    pub enum Convention {
        /// `diff = 1`, as in the lab; `L_i` is a colour.
        Lab = "lab",
        /// `diff = 1/pi`; `L_i` is a radiometric quantity (point: intensity in W/sr).
        Physical = "physical",
    }
    default Lab;
    what "convention";
}

named_enum! {
    /// The specular term of the lab's equation.
    pub enum Specular {
        /// No specular term.
        None = "none",
        /// `<R.V>^shininess`
        Phong = "phong",
        /// `<N.H>^shininess`
        BlinnPhong = "blinn-phong",
    }
    default BlinnPhong;
    what "specular model";
}

/// Switches of the terms of the sum. A term that is off counts as 0; a factor that is off counts as 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TermSwitches {
    /// `A`
    pub ambient: bool,
    /// `E`
    pub emitted: bool,
    /// `diff k_d <N.L>`
    pub diffuse: bool,
    /// `k_s spec`
    pub specular: bool,
    /// `att_i` (a factor)
    pub attenuation: bool,
    /// `spot_i` (a factor)
    pub spot: bool,
}

impl Default for TermSwitches {
    fn default() -> Self {
        TermSwitches { ambient: true, emitted: true, diffuse: true, specular: true, attenuation: true, spot: true }
    }
}

/// The form of the equation: everything that is the same for all points of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Equation {
    /// Lab or physical.
    pub convention: Convention,
    /// The specular term, where no BRDF replaces it.
    pub specular: Specular,
    /// A BRDF of Appendix 6 in place of `diff` and `spec`: `L_o = E + sum f L_i att_i spot_i <N.L_i>`.
    /// There is no ambient term in that form, and `convention` has no part in it.
    pub brdf: Option<BrdfSettings>,
    /// The specular term is 0 where `N.L <= 0`. On by default; off in the lab's own solutions.
    pub gated: bool,
    /// The specular term is weighted by `<N.L>`: the factor that the lab's equation has lost.
    pub cosine_weighted: bool,
    /// The terms that take part.
    pub terms: TermSwitches,
}

impl Default for Equation {
    fn default() -> Self {
        Equation {
            convention: Convention::Lab,
            specular: Specular::BlinnPhong,
            brdf: None,
            gated: true,
            cosine_weighted: false,
            terms: TermSwitches::default(),
        }
    }
}

/// One light's share of the equation at one point, factor by factor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightTerms {
    /// Index into the slice of lights that was given.
    pub light: usize,
    /// `L`: unit vector to the light.
    pub l: DVec3,
    /// `d` in world units; infinite for directional lights.
    pub distance: f64,
    /// `att_i` (1 where switched off).
    pub attenuation: f64,
    /// `spot_i` (1 where switched off).
    pub spot: f64,
    /// `N.L`, signed.
    pub cos_theta: f64,
    /// `R = 2 (N.L) N - L`
    pub r: DVec3,
    /// `H`
    pub h: DVec3,
    /// `R.V`, signed.
    pub r_dot_v: f64,
    /// `N.H`, signed.
    pub n_dot_h: f64,
    /// `diff`: 1 in the lab's convention, `1/pi` in the physical one and in the BRDFs.
    pub diff: f64,
    /// `spec` as it enters the sum: gated and cosine-weighted if the equation is. For a BRDF, its
    /// specular lobe for `b = 1`, times `<N.L>`.
    pub spec: f64,
    /// `v_i`: the share of the light that reaches the point, 0 in a shadow; 1 where shadows are not computed.
    pub visibility: f64,
    /// `L_i att_i spot_i v_i`
    pub incident: DVec3,
    /// `diff <N.L>` times `incident`: what `k_d` is multiplied with.
    pub diffuse_light: DVec3,
    /// `spec` times `incident`: what `k_s` is multiplied with.
    pub specular_light: DVec3,
    /// `k_d` times `diffuse_light`
    pub diffuse: DVec3,
    /// `k_s` times `specular_light`
    pub specular: DVec3,
}

/// `f` in 1/sr, per channel, of a material with a BRDF of its own: at a point, for light from a unit vector in world space.
pub type MaterialFunction<'a> = &'a dyn Fn(&ShadingPoint, DVec3) -> DVec3;

impl LightTerms {
    /// The same light at a surface whose BRDF has the value `f`, in 1/sr per channel, for it.
    ///
    /// All of `f` counts as the specular term, `pi diff f <N.L>` for `k_s = 1`, and the diffuse term is 0. With
    /// `f = k_d / pi` it is the diffuse term of the same equation, whatever its convention: `L_i` keeps its unit.
    pub fn with_brdf(self, f: DVec3, equation: &Equation, surface: &Surface) -> LightTerms {
        let factor = PI * self.diff * self.cos_theta.max(0.0);
        // 0 times an infinite value is not a number.
        let spec = if factor > 0.0 { f * factor } else { DVec3::ZERO };
        let light = if equation.terms.specular { capped(spec * self.incident) } else { DVec3::ZERO };
        LightTerms {
            spec: spec.max_element(),
            diffuse_light: DVec3::ZERO,
            specular_light: light,
            diffuse: DVec3::ZERO,
            specular: capped(surface.specular * light),
            ..self
        }
    }

    /// The same light of which only a share reaches the point: `visibility` is in [0, 1], 0 in a shadow.
    pub fn seen(self, visibility: f64) -> LightTerms {
        LightTerms {
            visibility,
            incident: visibility * self.incident,
            diffuse_light: visibility * self.diffuse_light,
            specular_light: visibility * self.specular_light,
            diffuse: visibility * self.diffuse,
            specular: visibility * self.specular,
            ..self
        }
    }

    /// Whether the light adds nothing at the point, shadows aside.
    pub fn is_dark(&self) -> bool {
        self.diffuse_light == DVec3::ZERO && self.specular_light == DVec3::ZERO
    }
}

/// The sum over the lights without the material's colours: what Gouraud shading interpolates.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LightSums {
    /// Sum of [`LightTerms::diffuse_light`].
    pub diffuse: DVec3,
    /// Sum of [`LightTerms::specular_light`].
    pub specular: DVec3,
}

/// Every term of the equation at one point.
#[derive(Clone, Debug, PartialEq)]
pub struct Terms {
    /// The point.
    pub point: ShadingPoint,
    /// The material there.
    pub surface: Surface,
    /// `A = k_a` times the scene's ambient colour (0 where switched off).
    pub ambient: DVec3,
    /// `E` (0 where switched off).
    pub emitted: DVec3,
    /// The sum over the lights of their diffuse terms.
    pub diffuse: DVec3,
    /// The sum over the lights of their specular terms.
    pub specular: DVec3,
    /// The environment's terms; zero without one.
    pub environment: EnvironmentTerms,
    /// `L_o`, as the surface's optics let it be seen.
    pub total: DVec3,
    /// Light by light; ambient lights are not among them.
    pub lights: Vec<LightTerms>,
}

impl Terms {
    /// The same in an environment: its light is added to the surface's, and the surface shown as its optics let it be.
    pub fn with_environment(mut self, environment: EnvironmentTerms, optics: &Optics) -> Terms {
        self.environment = environment;
        self.total = optics.compose(self.total + environment.diffuse + environment.specular, &environment.sight);
        self
    }
}

impl Equation {
    /// `A` for a surface under the scene's ambient colour.
    pub fn ambient(&self, surface: &Surface, ambient_color: DVec3) -> DVec3 {
        if self.terms.ambient && self.brdf.is_none() { capped(surface.ambient * ambient_color) } else { DVec3::ZERO }
    }

    /// `E` of a surface.
    pub fn emitted(&self, surface: &Surface) -> DVec3 {
        if self.terms.emitted { capped(surface.emitted) } else { DVec3::ZERO }
    }

    /// `diff`, and `spec` as it enters the sum (gated and cosine-weighted if the equation is), for light from the unit
    /// vector `l`, world space. For a BRDF: `1/pi`, and its specular lobe for `b = 1` times `<N.L>`.
    pub fn factors(&self, point: &ShadingPoint, surface: &Surface, l: DVec3) -> (f64, f64) {
        let (n, v) = (point.normal, point.view);
        let cos_theta = n.dot(l);
        let lambert = cos_theta.max(0.0);
        match &self.brdf {
            Some(brdf) => (FRAC_1_PI, brdf.lobe(point, surface, l) * lambert),
            None => {
                let diff = match self.convention {
                    Convention::Lab => 1.0,
                    Convention::Physical => FRAC_1_PI,
                };
                let spec = match self.specular {
                    Specular::None => 0.0,
                    Specular::Phong => brdf::cosine_power(vector::reflection(n, l).dot(v), surface.shininess),
                    Specular::BlinnPhong => brdf::cosine_power(n.dot(vector::half_vector(l, v, n)), surface.shininess),
                };
                let gate = if self.gated && cos_theta <= 0.0 { 0.0 } else { 1.0 };
                let weight = if self.cosine_weighted { lambert } else { 1.0 };
                (diff, spec * gate * weight)
            }
        }
    }

    /// One light's terms at one point, or `None` for an ambient light.
    pub fn light_terms(
        &self,
        index: usize,
        light: &Light,
        point: &ShadingPoint,
        surface: &Surface,
    ) -> Option<LightTerms> {
        let incident = light.incident(point.position, point.normal)?;
        let (n, v, l) = (point.normal, point.view, incident.direction);
        let attenuation = if self.terms.attenuation { incident.attenuation } else { 1.0 };
        let spot = if self.terms.spot { incident.spot } else { 1.0 };
        let cos_theta = n.dot(l);
        let lambert = cos_theta.max(0.0);
        let r = vector::reflection(n, l);
        let h = vector::half_vector(l, v, n);
        let (r_dot_v, n_dot_h) = (r.dot(v), n.dot(h));

        let (diff, spec) = self.factors(point, surface, l);
        let incident_light = capped(capped(light.color) * attenuation * spot);
        let diffuse_light = if self.terms.diffuse { diff * lambert * incident_light } else { DVec3::ZERO };
        let specular_light = if self.terms.specular { capped(spec * incident_light) } else { DVec3::ZERO };
        Some(LightTerms {
            light: index,
            l,
            distance: incident.distance,
            attenuation,
            spot,
            cos_theta,
            r,
            h,
            r_dot_v,
            n_dot_h,
            diff,
            spec,
            visibility: 1.0,
            incident: incident_light,
            diffuse_light,
            specular_light,
            diffuse: capped(surface.diffuse * diffuse_light),
            specular: capped(surface.specular * specular_light),
        })
    }

    /// [`Self::light_terms`] of a material, which may have a BRDF of its own.
    fn material_terms(
        &self,
        index: usize,
        light: &Light,
        point: &ShadingPoint,
        surface: &Surface,
        brdf: Option<MaterialFunction<'_>>,
    ) -> Option<LightTerms> {
        let terms = self.light_terms(index, light, point, surface)?;
        let Some(brdf) = brdf else { return Some(terms) };
        let f = if terms.cos_theta > 0.0 { brdf(point, terms.l) } else { DVec3::ZERO };
        Some(terms.with_brdf(f, self, surface))
    }

    /// The sums over the lights, without the material's colours.
    pub fn light_sums(&self, point: &ShadingPoint, surface: &Surface, lights: &[Light]) -> LightSums {
        self.light_sums_where(point, surface, lights, None, |_| 1.0)
    }

    /// [`Self::light_sums`] of the light that reaches the point: `visibility` says which share of each light's terms does.
    /// It is not asked about lights that add nothing. `brdf` is the material's own, if it has one.
    pub fn light_sums_where(
        &self,
        point: &ShadingPoint,
        surface: &Surface,
        lights: &[Light],
        brdf: Option<MaterialFunction<'_>>,
        visibility: impl Fn(&LightTerms) -> f64,
    ) -> LightSums {
        let mut sums = LightSums::default();
        for (index, light) in lights.iter().enumerate() {
            let terms = self.material_terms(index, light, point, surface, brdf);
            if let Some(terms) = terms.filter(|terms| !terms.is_dark()) {
                let share = visibility(&terms);
                sums.diffuse += share * terms.diffuse_light;
                sums.specular += share * terms.specular_light;
            }
        }
        sums
    }

    /// `L_o` from the sums: what a fragment does with light that was summed at the vertices.
    pub fn radiance_from_sums(&self, surface: &Surface, ambient_color: DVec3, sums: &LightSums) -> DVec3 {
        self.ambient(surface, ambient_color)
            + self.emitted(surface)
            + capped(surface.diffuse * sums.diffuse)
            + capped(surface.specular * sums.specular)
    }

    /// `L_o` at one point.
    pub fn radiance(&self, point: &ShadingPoint, surface: &Surface, lights: &[Light]) -> DVec3 {
        self.radiance_from_sums(surface, light::ambient_color(lights), &self.light_sums(point, surface, lights))
    }

    /// Every term at one point.
    pub fn evaluate(&self, point: &ShadingPoint, surface: &Surface, lights: &[Light]) -> Terms {
        self.evaluate_where(point, surface, lights, None, |_| 1.0)
    }

    /// [`Self::evaluate`] with the share of each light that reaches the point. `brdf` is the material's own, if it has one.
    pub fn evaluate_where(
        &self,
        point: &ShadingPoint,
        surface: &Surface,
        lights: &[Light],
        brdf: Option<MaterialFunction<'_>>,
        visibility: impl Fn(&LightTerms) -> f64,
    ) -> Terms {
        let lights_terms: Vec<LightTerms> = lights
            .iter()
            .enumerate()
            .filter_map(|(index, light)| self.material_terms(index, light, point, surface, brdf))
            .map(|terms| {
                let share = visibility(&terms);
                terms.seen(share)
            })
            .collect();
        let ambient = self.ambient(surface, light::ambient_color(lights));
        let emitted = self.emitted(surface);
        let diffuse = lights_terms.iter().map(|t| t.diffuse).sum();
        let specular = lights_terms.iter().map(|t| t.specular).sum();
        Terms {
            point: *point,
            surface: *surface,
            ambient,
            emitted,
            diffuse,
            specular,
            environment: EnvironmentTerms::default(),
            total: ambient + emitted + diffuse + specular,
            lights: lights_terms,
        }
    }

    /// The BRDF in use, if any.
    pub fn brdf_kind(&self) -> Option<BrdfKind> {
        self.brdf.map(|b| b.kind)
    }
}
