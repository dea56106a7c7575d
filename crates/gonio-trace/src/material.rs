//! The material at a place: textures read, colours carried to the lanes of a path.

use crate::bsdf::{Lobe, Parts};
use crate::color::{ColorMode, Tint, Wavelengths};
use crate::geometry::Place;
use glam::{DVec2, DVec3, Mat2, Vec2, Vec3, Vec4};
use gonio_light::brdf::{BrdfKind, BrdfSettings};
use gonio_light::microfacet::shininess_of_roughness;
use gonio_light::optics::reflectance;
use gonio_light::{Equation, Specular, microfacet, vector};
use gonio_scene::{BoundTexture, Scene, SceneMaterial, TextureFilter};

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
}

/// What is constant of a material.
pub(crate) struct Constants {
    /// Diffuse and glossy colour; none where a texture gives one of them, or the lobe.
    colors: Option<(Tint, Tint, Lobe)>,
    /// The radiance that it emits; none where a texture gives it.
    emitted: Option<Tint>,
    clear_tint: Tint,
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
    pub fn of_scene(scene: &Scene, brdf: BrdfSettings) -> Vec<Constants> {
        let one = |material: &SceneMaterial| {
            let maps = &material.maps;
            let has_texture = maps.diffuse.is_some() || maps.specular.is_some() || maps.shininess.is_some();
            let (diffuse, glossy) = (material.material.diffuse.into(), material.material.specular.into());
            Constants {
                colors: (!has_texture).then(|| {
                    let lobe = lobe_of(material, brdf, None);
                    let (diffuse, glossy) = conserving(diffuse, glossy, lobe);
                    (Tint::of_reflectance(diffuse), Tint::of_reflectance(glossy), lobe)
                }),
                emitted: maps
                    .emitted
                    .is_none()
                    .then(|| Tint::of_light(Vec3::from(material.material.emitted).max(Vec3::ZERO))),
                clear_tint: Tint::of_reflectance(material.optics.tint.as_vec3()),
            }
        };
        scene.materials.iter().map(one).collect()
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

    fn texel(&self, bound: &Option<BoundTexture>, uv: Vec2) -> Option<glam::DVec4> {
        let bound = bound.as_ref()?;
        let texture = self.scene.textures.get(bound.texture)?;
        let [u_axis, v_axis, offset] = bound.uv_matrix().map(Vec2::from);
        let uv: DVec2 = (Mat2::from_cols(u_axis, v_axis) * uv + offset).as_dvec2();
        Some(texture.sample(uv, DVec2::ZERO, DVec2::ZERO, self.filter, bound.wrap))
    }

    fn color(&self, bound: &Option<BoundTexture>, uv: Vec2) -> Vec3 {
        self.texel(bound, uv).map_or(Vec3::ONE, |t| t.truncate().as_vec3())
    }

    /// The radiance that a material emits.
    pub fn emitted(&self, index: u32, uv: Vec2) -> Tint {
        match self.constants[index as usize].emitted {
            Some(constant) => constant,
            None => {
                let SceneMaterial { material, maps, .. } = self.material(index);
                Tint::of_light(Vec3::from(material.emitted).max(Vec3::ZERO) * self.color(&maps.emitted, uv))
            }
        }
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
        self.material(index).optics.transmission > 0.0
    }

    /// The normal of the material's normal map about the interpolated normal.
    pub fn normal(&self, index: u32, place: &Place) -> Vec3 {
        let maps = &self.material(index).maps;
        let n = place.normal;
        let (Some((along, sign)), Some(texel)) = (place.tangent, self.texel(&maps.normal, place.uv)) else { return n };
        let Some(t) = (along - n * n.dot(along)).try_normalize() else { return n };
        let b = sign * n.cross(t);
        let m = 2.0 * texel.truncate().as_vec3() - Vec3::ONE;
        (t * m.x + b * m.y + n * m.z).normalize_or(n)
    }

    /// What the place is made of, seen along `view` (unit, away from it). A path that is split by dispersion keeps its
    /// first wavelength only.
    pub fn parts(&self, index: u32, place: &Place, normal: Vec3, view: Vec3, wavelengths: &mut Wavelengths) -> Parts {
        let SceneMaterial { material, maps, optics } = self.material(index);
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
                (Tint::of_reflectance(diffuse), Tint::of_reflectance(glossy), lobe)
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
