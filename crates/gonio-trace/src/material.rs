//! The material at a place: textures read, colours carried to the lanes of a path.

use crate::color::{ColorMode, Tint};
use crate::geometry::{Geometry, Place, Triangle};
use crate::sampling;
use crate::spectra::Spectra;
use crate::tree::Hit;
use crate::wavelengths::Wavelengths;
use glam::{DVec2, DVec3, DVec4, Mat2, Vec2, Vec3, Vec4};
use gonio_light::brdf::{BrdfKind, BrdfSettings};
use gonio_light::microfacet::shininess_of_roughness;
use gonio_light::optics::reflectance;
use gonio_light::{Equation, Specular, Surface, microfacet, vector};
use gonio_mesh::AmbientRule;
use gonio_scene::{BoundTexture, MaterialBrdf, Scene, SceneMaterial, TextureFilter};
use std::collections::HashMap;

/// The glossy part's shape.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Lobe {
    /// A normalised lobe of Appendix 6 with its exponent.
    Brdf(BrdfSettings, f64),
    /// Microfacets with `alpha`; the reflectance at normal incidence is the glossy colour.
    Ggx(f64),
}

/// What a place is made of, in the lanes of a path.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Parts {
    pub diffuse: Vec4,
    pub glossy: Vec4,
    pub lobe: Lobe,
    /// Share of light that a mirror reflects, at this angle.
    pub mirror: f32,
    /// Share of light that meets a clear boundary instead of the surface.
    pub clear: f32,
    /// Reflectance of the clear boundary, at this angle; 1 where reflection is total.
    pub clear_reflectance: f32,
    /// The refracted direction; none where reflection is total.
    pub refracted: Option<Vec3>,
    /// What refraction multiplies light by besides: tint, and the squared ratio of the indices.
    pub refraction_weight: Vec4,
    pub opacity: f32,
}

/// How a scene's materials are read.
pub(crate) struct Materials<'s> {
    pub scene: &'s Scene,
    pub mode: ColorMode,
    /// The glossy lobe of materials without roughness.
    pub brdf: BrdfSettings,
    /// Finest or blended texels: rays are points, so there is nothing to filter.
    pub filter: TextureFilter,
    /// Some material is not opaque everywhere.
    pub has_holes: bool,
    /// What is constant of each material.
    pub constants: &'s [Constants],
    pub spectra: &'s Spectra,
    /// The light equation in place of the BRDF.
    pub equation: Option<Equation>,
    /// Mean emission of objects and materials, where it replaces textures.
    pub mean_emission: Option<&'s MeanEmission>,
    /// Emission is seen: not switched off.
    pub emits: bool,
    /// The colour of the ambient lights, where they count.
    pub ambient: Option<AmbientTerm>,
}

/// The ambient term of the light equation.
#[derive(Clone, Debug)]
pub(crate) struct AmbientTerm {
    pub equation: Equation,
    /// Of all ambient lights together.
    pub color: DVec3,
    /// Of each.
    pub lights: Vec<Tint>,
}

/// The mean radiance of each material with an emission texture on each object, by both indices.
pub(crate) type MeanEmission = HashMap<(u32, u32), Tint>;

/// The mean radiance that each object emits from each material with a texture of it, linear RGB.
pub(crate) fn mean_emission(scene: &Scene, geometry: &Geometry, filter: TextureFilter) -> HashMap<(u32, u32), Vec3> {
    /// Places on an object at which its texture is looked up.
    const PLACES: f64 = 4096.0;
    let mut groups: HashMap<(u32, u32), Vec<u32>> = HashMap::new();
    for (index, triangle) in geometry.triangles.iter().enumerate() {
        let material = &scene.materials[triangle.material as usize];
        if material.maps.emitted.is_some() && material.material.emitted != [0.0; 3] {
            groups.entry((triangle.object, triangle.material)).or_default().push(index as u32);
        }
    }
    let mean = |(key, triangles): ((u32, u32), Vec<u32>)| {
        let material = &scene.materials[key.1 as usize];
        let areas: Vec<f64> = triangles.iter().map(|&t| geometry.area(t).into()).collect();
        let whole: f64 = areas.iter().sum();
        let mut sum = DVec3::ZERO;
        for (&triangle, area) in triangles.iter().zip(areas) {
            let count = (PLACES * area / whole.max(f64::MIN_POSITIVE)).ceil().clamp(1.0, PLACES) as u32;
            let mut of_triangle = DVec3::ZERO;
            for i in 0..count {
                let u = sampling::r2(i);
                let hit = Hit { distance: 0.0, triangle, barycentrics: sampling::triangle(u) };
                let uv = geometry.place(scene, &hit).uv;
                of_triangle += texel(scene, filter, &material.maps.emitted, uv).map_or(DVec3::ONE, |t| t.truncate());
            }
            sum += of_triangle * (area / f64::from(count));
        }
        let texture = if whole > 0.0 { sum / whole } else { DVec3::ONE };
        (key, Vec3::from(material.material.emitted).max(Vec3::ZERO) * texture.as_vec3())
    };
    groups.into_iter().map(mean).collect()
}

fn texel(scene: &Scene, filter: TextureFilter, bound: &Option<BoundTexture>, uv: Vec2) -> Option<DVec4> {
    let bound = bound.as_ref()?;
    let texture = scene.textures.get(bound.texture)?;
    let [u_axis, v_axis, offset] = bound.uv_matrix().map(Vec2::from);
    let uv: DVec2 = (Mat2::from_cols(u_axis, v_axis) * uv + offset).as_dvec2();
    Some(texture.sample(uv, DVec2::ZERO, DVec2::ZERO, filter, bound.wrap))
}

/// What is constant of a material.
pub(crate) struct Constants {
    /// Diffuse and glossy colour; none where a texture gives one of them, or the lobe.
    colors: Option<(Tint, Tint, Lobe)>,
    /// The radiance that it emits; none where a texture gives it.
    emitted: Option<Tint>,
    clear_tint: Tint,
    /// The diffuse colour of a surface that does nothing else, where no mesh colours it.
    only_diffuse: Option<Tint>,
    /// The table of the diffuse reflectance; the largest channel of its colour.
    diffuse_table: Option<(u32, f32)>,
}

/// The normalised lobe of an equation.
pub(crate) fn normalised_lobe(equation: &Equation) -> BrdfSettings {
    let kind = match equation.specular {
        Specular::None => BrdfKind::Lambert,
        Specular::Phong => BrdfKind::Phong,
        Specular::BlinnPhong => BrdfKind::Blinn,
    };
    BrdfSettings { normalised: true, ..equation.brdf.unwrap_or(BrdfSettings::new(kind)) }
}

impl Constants {
    /// Those of all materials of a scene.
    /// `tables`: of diffuse reflectances, by material.
    pub fn of_scene(scene: &Scene, brdf: BrdfSettings, tables: &[Option<u32>]) -> Vec<Constants> {
        let one = |(material, table): (&SceneMaterial, &Option<u32>)| {
            let maps = &material.maps;
            let has_texture = maps.diffuse.is_some() || maps.specular.is_some() || maps.shininess.is_some();
            let (diffuse, glossy) = (Vec3::from(material.material.diffuse), material.material.specular.into());
            let diffuse_table = table.map(|table| (table, diffuse.max_element()));
            let colors = (!has_texture).then(|| {
                let lobe = lobe_of(material, brdf, None);
                let (diffuse, glossy) = conserving(diffuse, glossy, lobe);
                (diffuse_tint(diffuse, diffuse_table), Tint::of_reflectance(glossy), lobe)
            });
            let is_plain = maps.normal.is_none()
                && maps.opacity.is_none()
                && material.brdf.is_none()
                && material.material.opacity >= 1.0
                && material.optics.is_plain();
            Constants {
                diffuse_table,
                only_diffuse: colors
                    .filter(|(_, glossy, _)| is_plain && glossy.rgb() == Vec3::ZERO)
                    .map(|(diffuse, ..)| diffuse),
                colors,
                emitted: maps
                    .emitted
                    .is_none()
                    .then(|| Tint::of_light(Vec3::from(material.material.emitted).max(Vec3::ZERO))),
                clear_tint: Tint::of_reflectance(material.optics.tint.as_vec3()),
            }
        };
        scene.materials.iter().zip(tables).map(one).collect()
    }
}

/// A diffuse colour; with its table, scaled as the colour was.
fn diffuse_tint(color: Vec3, table: Option<(u32, f32)>) -> Tint {
    let tint = Tint::of_reflectance(color);
    match table {
        Some((table, largest)) if largest > 0.0 => tint.with_reflectance(table, color.max_element() / largest),
        _ => tint,
    }
}

/// Diffuse and glossy colour, darkened where together they would reflect more than they receive.
fn conserving(diffuse: Vec3, glossy: Vec3, lobe: Lobe) -> (Vec3, Vec3) {
    let (diffuse, mut glossy) = (diffuse.max(Vec3::ZERO), glossy.max(Vec3::ZERO));
    if matches!(lobe, Lobe::Brdf(BrdfSettings { kind: BrdfKind::Lambert, .. }, _)) {
        glossy = Vec3::ZERO;
    }
    let gain = match lobe {
        // The glossy part takes its share from the diffuse one.
        Lobe::Ggx(_) => diffuse.max_element().max(glossy.max_element()),
        Lobe::Brdf(..) => (diffuse + glossy).max_element(),
    };
    if gain > 1.0 { (diffuse / gain, glossy / gain) } else { (diffuse, glossy) }
}

/// The glossy lobe of a material; `texel`: of its texture of shininess or roughness.
fn lobe_of(material: &SceneMaterial, brdf: BrdfSettings, texel: Option<f64>) -> Lobe {
    let SceneMaterial { material, maps, .. } = material;
    if let Some(physical) = &material.metallic_roughness {
        let roughness = match (texel, maps.roughness) {
            (Some(texel), Some(roughness)) => f64::from(roughness) * texel,
            _ => physical.roughness.into(),
        };
        return Lobe::Ggx(microfacet::alpha(roughness).max(microfacet::ALPHA_MIN));
    }
    let shininess = match (texel, maps.roughness) {
        (Some(texel), Some(roughness)) => shininess_of_roughness(f64::from(roughness) * texel),
        (texel, _) => f64::from(material.shininess) * texel.unwrap_or(1.0),
    };
    Lobe::Brdf(brdf, shininess)
}

impl Materials<'_> {
    fn material(&self, index: u32) -> &SceneMaterial {
        &self.scene.materials[index as usize]
    }

    /// The material's own BRDF, if it has one.
    #[inline]
    pub fn own_brdf(&self, index: u32) -> Option<&MaterialBrdf> {
        self.material(index).brdf.as_deref()
    }

    fn texel(&self, bound: &Option<BoundTexture>, uv: Vec2) -> Option<DVec4> {
        texel(self.scene, self.filter, bound, uv)
    }

    fn color(&self, bound: &Option<BoundTexture>, uv: Vec2) -> Vec3 {
        self.texel(bound, uv).map_or(Vec3::ONE, |t| t.truncate().as_vec3())
    }

    /// The radiance that a triangle emits.
    pub fn emitted(&self, triangle: &Triangle, uv: Vec2) -> Tint {
        let index = triangle.material;
        if let Some(constant) = self.constants[index as usize].emitted {
            return constant;
        }
        if let Some(mean) = self.mean_emission.and_then(|means| means.get(&(triangle.object, index))) {
            return *mean;
        }
        let SceneMaterial { material, maps, .. } = self.material(index);
        Tint::of_light(Vec3::from(material.emitted).max(Vec3::ZERO) * self.color(&maps.emitted, uv))
    }

    /// Whether the radiance of a material is the same everywhere, and it is opaque.
    pub fn emits_evenly(&self, index: u32) -> bool {
        !self.has_holes && self.constants[index as usize].emitted.is_some()
    }

    /// From 0, a hole, to 1.
    pub fn opacity(&self, index: u32, uv: Vec2) -> f32 {
        let SceneMaterial { material, maps, .. } = self.material(index);
        let map = self.texel(&maps.opacity, uv).map_or(1.0, |t| t.x as f32);
        (material.opacity * map).clamp(0.0, 1.0)
    }

    /// The absorption of the material's inside in the lanes of a path, per world unit.
    pub fn absorption(&self, index: u32, wavelengths: &Wavelengths) -> Vec4 {
        self.mode.coefficient(self.material(index).optics.absorption.as_vec3().max(Vec3::ZERO), wavelengths)
    }

    /// Whether light goes through the material.
    pub fn is_clear(&self, index: u32) -> bool {
        self.equation.is_none() && self.material(index).optics.transmission > 0.0
    }

    /// The normal of the material's normal map about the interpolated normal.
    pub fn normal(&self, index: u32, place: &Place) -> Vec3 {
        let maps = &self.material(index).maps;
        // The light equation takes the normal as it is, and has no normal map on flat triangles.
        let n = if place.normal_turned && self.equation.is_some() { -place.normal } else { place.normal };
        if place.flat && self.equation.is_some() {
            return n;
        }
        let (Some((along, sign)), Some(texel)) = (place.tangent, self.texel(&maps.normal, place.uv)) else { return n };
        let Some(t) = (along - n * n.dot(along)).try_normalize() else { return n };
        let b = sign * n.cross(t);
        let m = 2.0 * texel.truncate().as_vec3() - Vec3::ONE;
        (t * m.x + b * m.y + n * m.z).normalize_or(n)
    }

    /// The colour, in the lanes of a path, of a place that only scatters diffusely, if it is one.
    #[inline]
    pub fn only_diffuse(&self, index: u32, place: &Place, wavelengths: &Wavelengths) -> Option<Vec4> {
        let tint = self.constants[index as usize].only_diffuse.as_ref()?;
        (place.color == Vec3::ONE).then(|| self.mode.reflectance(tint, wavelengths))
    }

    /// What the place is made of, seen along `view` (unit, away from it). A path that is split by dispersion keeps its
    /// first wavelength only.
    pub fn parts(&self, index: u32, place: &Place, normal: Vec3, view: Vec3, wavelengths: &mut Wavelengths) -> Parts {
        if let Some(equation) = &self.equation {
            return self.parts_of_equation(equation, index, place, wavelengths);
        }
        let SceneMaterial { material, maps, optics, .. } = self.material(index);
        let (uv, mode) = (place.uv, self.mode);
        let constants = &self.constants[index as usize];
        let (diffuse, glossy, lobe) = match constants.colors {
            Some(constant) if place.color == Vec3::ONE => constant,
            _ => {
                let diffuse = Vec3::from(material.diffuse) * place.color * self.color(&maps.diffuse, uv);
                let glossy = Vec3::from(material.specular) * self.color(&maps.specular, uv);
                let texel = self.texel(&maps.shininess, uv).map(|t| t.x);
                let lobe = lobe_of(self.material(index), self.brdf, texel);
                let (diffuse, glossy) = conserving(diffuse, glossy, lobe);
                (diffuse_tint(diffuse, constants.diffuse_table), Tint::of_reflectance(glossy), lobe)
            }
        };
        let mut parts = Parts {
            diffuse: mode.reflectance(&diffuse, wavelengths),
            glossy: mode.reflectance(&glossy, wavelengths),
            lobe,
            mirror: 0.0,
            clear: 0.0,
            clear_reflectance: 0.0,
            refracted: None,
            refraction_weight: Vec4::ONE,
            opacity: self.opacity(index, uv),
        };
        if optics.is_plain() {
            return parts;
        }
        let clear = optics.transmission.clamp(0.0, 1.0);
        if clear > 0.0 && optics.dispersion != 0.0 && mode == ColorMode::Spectral {
            wavelengths.keep_first();
        }
        let refraction_index = match mode {
            ColorMode::Spectral => {
                index_at(material.refraction_index.into(), optics.dispersion, wavelengths.lambda.x.into())
            }
            ColorMode::Rgb => material.refraction_index.into(),
        };
        let outside = place.geometric_normal.dot(view) >= 0.0;
        // A place inside of a lit body without transmission reflects as from outside.
        let eta = if outside || clear == 0.0 { 1.0 / refraction_index } else { refraction_index };
        let side = if outside { 1.0 } else { -1.0 };
        let mut n = (normal * side).as_dvec3();
        let v = view.as_dvec3();
        if n.dot(v) <= 0.0 {
            n = (place.geometric_normal * side).as_dvec3();
        }
        let f = reflectance(optics.fresnel, n.dot(v), eta);
        parts.mirror = optics.mirror_share(f).clamp(0.0, 1.0) as f32;
        parts.clear = clear as f32;
        parts.clear_reflectance = f as f32;
        parts.refracted = vector::refraction(n, v, eta).map(|t| t.as_vec3().normalize());
        // Radiance is per solid angle, which refraction narrows or widens.
        parts.refraction_weight = Vec4::splat((eta * eta) as f32);
        if outside {
            parts.refraction_weight *= mode.reflectance(&constants.clear_tint, wavelengths);
        }
        parts
    }
}

impl Materials<'_> {
    fn surface(&self, index: u32, place: &Place) -> Surface {
        self.material(index).surface(place.color.as_dvec3(), |_, bound| self.texel(bound, place.uv))
    }

    /// The diffuse and the specular term of the light equation: no mirror, no glass.
    fn parts_of_equation(&self, equation: &Equation, index: u32, place: &Place, wavelengths: &Wavelengths) -> Parts {
        let surface = self.surface(index, place);
        let color = |color: DVec3, counts: bool, table: Option<(u32, f32)>| {
            let color = if counts { color.as_vec3().max(Vec3::ZERO) } else { Vec3::ZERO };
            self.mode.reflectance(&diffuse_tint(color, table), wavelengths)
        };
        let table = self.constants[index as usize].diffuse_table;
        let has_lobe = self.brdf.kind != BrdfKind::Lambert;
        Parts {
            diffuse: color(surface.diffuse, equation.terms.diffuse, table),
            glossy: color(surface.specular, equation.terms.specular && has_lobe, None),
            lobe: Lobe::Brdf(self.brdf, surface.shininess),
            mirror: 0.0,
            clear: 0.0,
            clear_reflectance: 0.0,
            refracted: None,
            refraction_weight: Vec4::ONE,
            opacity: self.opacity(index, place.uv),
        }
    }

    /// The ambient term at a place, in the lanes of a path.
    pub fn ambient(&self, term: &AmbientTerm, index: u32, place: &Place, wavelengths: &Wavelengths) -> Vec4 {
        let surface = self.surface(index, place);
        if term.equation.ambient(&surface, term.color) == DVec3::ZERO {
            return Vec4::ZERO;
        }
        // As the diffuse colour, it is that of the material's spectrum.
        let table = match self.material(index).material.ambient {
            AmbientRule::FollowsDiffuse => self.constants[index as usize].diffuse_table,
            AmbientRule::Value(_) => None,
        };
        let reflectance = diffuse_tint(surface.ambient.as_vec3().max(Vec3::ZERO), table);
        let light: Vec4 = term.lights.iter().map(|light| self.mode.light(light, wavelengths)).sum();
        self.mode.reflectance(&reflectance, wavelengths) * light
    }
}

/// The index of refraction at a wavelength, nm: Cauchy's `A + B / lambda^2` with `index` at 550 nm and `dispersion` between
/// 486 and 656 nm.
fn index_at(index: f64, dispersion: f64, lambda: f64) -> f64 {
    let inverse_square = |nm: f64| 1.0 / (nm * nm);
    let b = dispersion / (inverse_square(486.1) - inverse_square(656.3));
    (index + b * (inverse_square(lambda) - inverse_square(550.0))).max(gonio_light::optics::SMALLEST_INDEX)
}

/// The radiance of a material without its texture, for choosing lights.
pub(crate) fn bare_emitted(scene: &Scene, material: u32) -> DVec3 {
    scene.materials.get(material as usize).map_or(DVec3::ZERO, |m| DVec3::from(m.material.emitted.map(f64::from)))
}
