//! A scene at one moment, and what the settings make of it.

use crate::color::{ColorMode, Tint};
use crate::environment::Environment;
use crate::eye::Eye;
use crate::geometry::{Geometry, Triangle};
use crate::lamps::LightRules;
use crate::lights::{LightOrigin, LightUnits, Lights, PlacedLight};
use crate::material::{AmbientTerm, Constants, Materials, MeanEmission, bare_emitted, mean_emission, normalised_lobe};
use crate::path::{Technique, World};
use crate::render::TraceSettings;
use crate::rules::{Rules, SpecularCosine};
use crate::spectra::{Spectra, SpectrumTable};
use crate::{Simplification, sampling};
use glam::{DVec3, Vec3};
use gonio_light::equation::Convention;
use gonio_light::{Attenuation, Equation, Light, LightKind, light};
use gonio_scene::{Frame, LightShape, Scene, TextureFilter};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// What is the same at all moments of a frame.
pub(crate) struct Timeless {
    pub environment: Option<Arc<Environment>>,
    pub constants: Vec<Constants>,
    pub has_holes: bool,
    pub spectra: Spectra,
    /// Of each light with a spectrum: its table, and that table's luminance.
    pub light_spectra: Vec<Option<(u32, f64)>>,
    pub units: LightUnits,
}

/// A scene at one moment.
pub(crate) struct Posed {
    pub scene: Scene,
    lights: Vec<PlacedLight>,
    /// Colour of all ambient lights.
    ambient: DVec3,
    pub geometry: Geometry,
    pub sources: Lights,
    timeless: Arc<Timeless>,
    /// For [`Simplification::Sum`], by the number of points.
    points: Mutex<Option<(u32, Arc<Lights>)>>,
    means: OnceLock<MeanEmission>,
}

/// The irradiance of a light of colour 1: a diffuse surface is then as bright as in the light equation.
fn light_strength(equation: &Equation) -> f64 {
    match (equation.convention, equation.brdf) {
        (Convention::Lab, None) => std::f64::consts::PI,
        _ => 1.0,
    }
}

fn filter_of(frame: &Frame) -> TextureFilter {
    match frame.texture_filter {
        TextureFilter::Nearest => TextureFilter::Nearest,
        _ => TextureFilter::Linear,
    }
}

impl Timeless {
    pub fn new(scene: &Scene, frame: &Frame) -> Self {
        let environment = match (&scene.environment, frame.surroundings) {
            (Some(loaded), Some(surroundings)) => Some(Arc::new(Environment::new(loaded.clone(), surroundings))),
            _ => None,
        };
        let size = frame.bounds_max - frame.bounds_min;
        let units = LightUnits {
            strength: light_strength(&frame.equation),
            reference: 0.5 * (frame.bounds_min + frame.bounds_max),
            least_distance: (0.5 * size.min_element()).max(0.05 * size.length()).max(1e-9),
        };
        let mut spectra = Spectra::default();
        let reflectances = scene.materials.iter().map(|material| {
            let spectrum = material.diffuse_spectrum.as_ref()?;
            Some(spectra.add(SpectrumTable::new(|lambda| spectrum.reflectance_at(lambda))))
        });
        let constants = Constants::of_scene(scene, normalised_lobe(&frame.equation), &reflectances.collect::<Vec<_>>());
        let light_spectra: Vec<Option<(u32, f64)>> = (scene.settings.lights.iter())
            .map(|light| {
                let spectrum = light.spectrum.as_ref()?;
                let table = SpectrumTable::new(|lambda| spectrum.power_at(lambda));
                let luminance = table.luminance;
                Some((spectra.add(table), luminance))
            })
            .collect();
        let weights: Vec<(u32, f64)> = (frame.lights.iter().zip(&light_spectra))
            .filter_map(|(light, spectrum)| {
                let (table, luminance) = (*spectrum)?;
                Some((table, light.color.max_element() / luminance))
            })
            .filter(|(_, weight)| weight.is_finite())
            .collect();
        Timeless {
            environment,
            constants,
            has_holes: scene.materials.iter().any(|m| m.material.opacity < 1.0 || m.maps.opacity.is_some()),
            spectra: spectra.finish(&weights),
            light_spectra,
            units,
        }
    }
}

impl Posed {
    /// `lights` and `shapes`: of the frame at this moment.
    pub fn new(scene: Scene, lights: &[Light], shapes: &[LightShape], timeless: Arc<Timeless>) -> Self {
        let mut geometry = Geometry::new(&scene);
        let placed: Vec<PlacedLight> = lights
            .iter()
            .enumerate()
            .map(|(index, &light)| PlacedLight {
                light,
                shape: shapes.get(index).copied().unwrap_or_default(),
                origin: LightOrigin::Light(index),
                spectrum: timeless.light_spectra.get(index).copied().flatten(),
            })
            .collect();
        let (mut sources, mut powers) = Lights::new(&placed, &timeless.units, &geometry);
        let emitted = |t: &Triangle| bare_emitted(&scene, t.material);
        sources.add_triangles(&mut powers, &mut geometry, emitted);
        sources.add_environment(&mut powers, timeless.environment.clone());
        Posed {
            ambient: light::ambient_color(lights),
            lights: placed,
            sources: sources.finish(&powers, &geometry),
            geometry,
            timeless,
            points: Mutex::new(None),
            means: OnceLock::new(),
            scene,
        }
    }

    /// Points in place of lamps and objects that emit light, and all other lights.
    pub fn point_lights(&self, frame: &Frame, points: u32) -> Vec<PlacedLight> {
        let points = points.max(1);
        let mut all = Vec::new();
        for placed in &self.lights {
            let mut one = PlacedLight { shape: LightShape::Point, ..*placed };
            one.light.color = placed.light.color / f64::from(points);
            match placed.shape {
                LightShape::Point => all.push(*placed),
                LightShape::Sphere { radius } => all.extend((0..points).map(|i| {
                    let at = if points == 1 { DVec3::ZERO } else { radius * point_of_ball(i, points) };
                    PlacedLight { light: moved(&one.light, at), ..one }
                })),
                LightShape::Rectangle { half_right, half_up } => all.extend((0..points).map(|i| {
                    let u =
                        if points == 1 { DVec3::ZERO } else { (2.0 * sampling::r2(i) - 1.0).extend(0.0).as_dvec3() };
                    PlacedLight { light: moved(&one.light, u.x * half_right + u.y * half_up), ..one }
                })),
            }
        }
        for (object, triangles) in self.emissive_objects() {
            all.extend(self.points_of_object(frame, object, &triangles, points));
        }
        all
    }

    /// The triangles of each object that emits light.
    fn emissive_objects(&self) -> Vec<(u32, Vec<u32>)> {
        let mut objects: Vec<(u32, Vec<u32>)> = Vec::new();
        // Triangles are in the order of their objects.
        for (index, triangle) in self.geometry.triangles.iter().enumerate().filter(|(_, t)| t.light.is_some()) {
            match objects.last_mut() {
                Some((object, triangles)) if *object == triangle.object => triangles.push(index as u32),
                _ => objects.push((triangle.object, vec![index as u32])),
            }
        }
        objects
    }

    /// Points that shine as brightly as an object does in the mean over all directions.
    fn points_of_object(&self, frame: &Frame, object: u32, triangles: &[u32], points: u32) -> Vec<PlacedLight> {
        let space = self.geometry.space;
        let means = self.means(frame);
        let (mut whole, mut center, mut sums) = (DVec3::ZERO, DVec3::ZERO, Vec::new());
        let mut weight = 0.0;
        for &index in triangles {
            let triangle = &self.geometry.triangles[index as usize];
            let area = f64::from(self.geometry.area(index)) / (space.scale * space.scale);
            let radiance = means
                .get(&(triangle.object, triangle.material))
                .map_or_else(|| bare_emitted(&self.scene, triangle.material), |mean| mean.rgb().as_dvec3());
            let opacity = f64::from(self.scene.materials[triangle.material as usize].material.opacity);
            let power = radiance * (area * opacity.clamp(0.0, 1.0));
            whole += power;
            weight += power.element_sum();
            center += self.geometry.point(index, Vec3::splat(1.0 / 3.0)).0.as_dvec3() * power.element_sum();
            sums.push(power.element_sum());
        }
        if !(weight > 0.0 && whole.is_finite()) {
            return Vec::new();
        }
        // A body is seen with a quarter of its surface in the mean, a sheet that shines on both sides with half.
        let seen = if self.scene.objects[object as usize].closed { 0.25 } else { 0.5 };
        let color = whole * (seen / self.timeless.units.strength / f64::from(points));
        let light = |at: DVec3| PlacedLight {
            light: Light {
                kind: LightKind::Point { position: at / space.scale + space.center },
                color,
                attenuation: Attenuation::INVERSE_SQUARE,
            },
            shape: LightShape::Point,
            spectrum: None,
            origin: LightOrigin::Object(object as usize),
        };
        if points == 1 {
            return vec![light(center / weight)];
        }
        let choice = sampling::Discrete::new(sums);
        (0..points)
            .filter_map(|i| {
                let (triangle, _, _) = choice.sample((i as f32 + 0.5) / points as f32)?;
                Some(light(self.geometry.point(triangles[triangle], sampling::triangle(sampling::r2(i))).0.as_dvec3()))
            })
            .collect()
    }

    /// The light of all ambient lights together, or of each where one has a spectrum.
    fn ambient_tints(&self) -> Vec<Tint> {
        let lights = || self.lights.iter().filter(|placed| placed.light.kind == LightKind::Ambient);
        if lights().all(|placed| placed.spectrum.is_none()) {
            return vec![Tint::of_light(self.ambient.as_vec3())];
        }
        let colors = lights().map(|placed| (placed, placed.light.color.max(DVec3::ZERO)));
        colors.filter(|(_, color)| color.is_finite()).map(|(placed, color)| placed.tint(color)).collect()
    }

    fn means(&self, frame: &Frame) -> &MeanEmission {
        self.means.get_or_init(|| {
            let means = mean_emission(&self.scene, &self.geometry, filter_of(frame));
            means.into_iter().map(|(key, rgb)| (key, Tint::of_light(rgb))).collect()
        })
    }

    /// The sources where points replace all others; `None` where they do not.
    pub fn summed(&self, frame: &Frame, settings: &TraceSettings) -> Option<Arc<Lights>> {
        if !settings.simplified.contains(Simplification::Sum) {
            return None;
        }
        let count = settings.points_per_light.max(1);
        let mut known = self.points.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, lights)) = known.as_ref().filter(|(known, _)| *known == count) {
            return Some(lights.clone());
        }
        let (mut lights, powers) = Lights::new(&self.point_lights(frame, count), &self.timeless.units, &self.geometry);
        // It is seen, but lights nothing.
        lights.environment = self.timeless.environment.clone();
        let lights = Arc::new(lights.finish(&powers, &self.geometry));
        *known = Some((count, lights.clone()));
        Some(lights)
    }

    /// What paths read; `summed`: of [`Self::summed`].
    pub fn world<'s>(&'s self, frame: &Frame, settings: &TraceSettings, summed: Option<&'s Lights>) -> World<'s> {
        let simplified = settings.simplified;
        let has = |one| simplified.contains(one);
        let mut equation = frame.equation;
        // Without this simplification the cosine stays.
        equation.cosine_weighted |= !has(Simplification::Cosine);
        let loses_cosine = has(Simplification::Cosine) && !equation.cosine_weighted && equation.brdf.is_none();
        let rules = Rules {
            equation: has(Simplification::Brdf).then(|| (equation, (1.0 / light_strength(&frame.equation)) as f32)),
            specular: match (loses_cosine, equation.gated) {
                (false, _) => SpecularCosine::Weighted,
                (true, true) => SpecularCosine::Gated,
                (true, false) => SpecularCosine::Free,
            },
            blocked_behind: !has(Simplification::Shadows),
            two_sided: frame.two_sided,
        };
        let terms = frame.equation.terms;
        let light_rules = LightRules {
            attenuation: has(Simplification::Attenuation),
            attenuates: terms.attenuation,
            has_cones: terms.spot || !has(Simplification::Attenuation),
            scale: self.geometry.space.scale,
        };
        let materials = Materials {
            scene: &self.scene,
            mode: ColorMode::of(simplified),
            brdf: normalised_lobe(&frame.equation),
            filter: filter_of(frame),
            has_holes: self.timeless.has_holes,
            constants: &self.timeless.constants,
            spectra: &self.timeless.spectra,
            equation: has(Simplification::Brdf).then_some(equation),
            mean_emission: has(Simplification::Emission).then(|| self.means(frame)),
            emits: terms.emitted || !has(Simplification::Emission),
            ambient: (has(Simplification::Ambient) && self.ambient != DVec3::ZERO).then(|| AmbientTerm {
                equation: frame.equation,
                color: self.ambient,
                lights: self.ambient_tints(),
            }),
        };
        let finds_one = has(Simplification::Sum) || has(Simplification::Shadows);
        World {
            eye: Eye::new(frame, &self.geometry.space),
            geometry: &self.geometry,
            materials,
            lights: summed.unwrap_or(&self.sources),
            technique: if finds_one { Technique::Lights } else { settings.technique },
            simplified,
            rules,
            light_rules,
            finds_environment: has(Simplification::Shadows)
                && !has(Simplification::Sum)
                && settings.technique != Technique::Lights,
            most_depth: settings.most_depth.max(1),
        }
    }
}

fn moved(light: &Light, by: DVec3) -> Light {
    let mut moved = *light;
    match &mut moved.kind {
        LightKind::Point { position } | LightKind::Spot { position, .. } => *position += by,
        LightKind::Ambient | LightKind::Directional { .. } => {}
    }
    moved
}

/// Point `i` of `count` in the unit ball, so dense that the ball looks evenly bright from everywhere, as a sphere of uniform
/// radiance does: the density is proportional to `1 / sqrt(1 - r^2)`.
fn point_of_ball(i: u32, count: u32) -> DVec3 {
    let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    let y = (2.0 * f64::from(i) + 1.0) / f64::from(count) - 1.0;
    let (sin, cos) = (golden * f64::from(i)).sin_cos();
    let across = (1.0 - y * y).max(0.0).sqrt();
    // With r = sin a the share within r is (a - sin a cos a) / (pi / 2).
    let share = f64::from(sampling::r2(i).x) * std::f64::consts::FRAC_PI_2;
    let (mut low, mut high) = (0.0, std::f64::consts::FRAC_PI_2);
    for _ in 0..40 {
        let a: f64 = 0.5 * (low + high);
        if a - a.sin() * a.cos() < share { low = a } else { high = a }
    }
    DVec3::new(across * cos, y, across * sin) * high.sin()
}
