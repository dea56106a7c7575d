//! All numbers of a staircase, and one sentence for each step about what to look at.
//!
//! A sentence says what was measured, where, and, if nothing changed, which property of the scene explains it.

use crate::comparison::{AmbientFit, LargestDifference, PictureComparison};
use crate::formula::{changes, formula, plain, result, struck};
use crate::staircase::{EquationPicture, SimplifiedPicture, Staircase, StaircaseSettings};
use glam::DVec3;
use gonio_light::color::luminance;
use gonio_light::{DVec4, LightKind, Specular};
use gonio_reference::ReferenceScene;
use gonio_scene::{DisplayMap, Frame, LightShape, Scene, SceneMaterial};
use gonio_trace::{Simplification, Simplifications};
use serde::Serialize;

/// A staircase in numbers. Lengths are world units, times seconds, shares 1 for the whole.
#[derive(Clone, Debug, Serialize)]
pub struct StaircaseReport {
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// The share of the pixels that no number but FLIP counts, because a lamp brighter than white is seen in them.
    pub left_out: f64,
    /// The rendering equation.
    pub truth: PictureReport,
    /// Its formula as markup.
    #[serde(skip)]
    pub truth_formula: String,
    /// The steps in order.
    pub steps: Vec<StepReport>,
    /// Each simplification by itself.
    pub alone: Vec<StepReport>,
    /// The light equation's picture against the last step's.
    pub light_equation: Option<EquationReport>,
    /// The fitted ambient light.
    pub ambient: Option<AmbientFit>,
    /// The light equation with a cubemap against the truth.
    pub cubemap: Option<CubemapReport>,
}

/// A traced picture in numbers.
#[derive(Clone, Debug, Serialize)]
pub struct PictureReport {
    /// Mean luminance, linear, of the pixels that count.
    pub mean: f64,
    /// Error of a pixel's luminance relative to the mean of the truth.
    pub error: Option<f64>,
    /// The bound that the error stays below with a probability of 95 %; none with too few paths.
    pub error_bound: Option<f64>,
    /// Whether the error that was asked for is not reached with the most paths of a pixel.
    pub missed: bool,
    /// Paths of a pixel.
    pub paths: u32,
    /// Computing time of this picture.
    pub seconds: f64,
    /// Computing time until the error is 1 %; none with too few paths.
    pub seconds_at_one_percent: Option<f64>,
}

/// A step in numbers.
#[derive(Clone, Debug, Serialize)]
pub struct StepReport {
    /// The simplification.
    pub name: &'static str,
    /// Its number in the lecture's order: `1`, ..., `5a`, `5b`, ...
    pub number: &'static str,
    /// Its title.
    pub title: &'static str,
    /// The formula before with what is removed struck out, as markup.
    #[serde(skip)]
    pub struck: String,
    /// The formula after with what is added stressed, as markup.
    #[serde(skip)]
    pub result: String,
    /// The formula after, as plain text.
    pub formula: String,
    /// One sentence about this scene.
    pub look: String,
    /// The picture.
    pub picture: PictureReport,
    /// Against the step before; for a simplification by itself, against the truth.
    pub to_before: PictureComparison,
    /// Against the truth.
    pub to_truth: PictureComparison,
}

/// A picture by the light equation in numbers.
#[derive(Clone, Debug, Serialize)]
pub struct EquationReport {
    /// Computing time.
    pub seconds: f64,
    /// RMS of linear light to the picture that it is compared with, relative to the truth's mean luminance.
    pub rms: f64,
    /// Mean FLIP.
    pub flip: f64,
}

/// The picture with a cubemap.
#[derive(Clone, Debug, Serialize)]
pub struct CubemapReport {
    /// Against the truth.
    #[serde(flatten)]
    pub picture: EquationReport,
    /// Objects that mirror or refract, with what was measured on them.
    pub objects: Vec<CubemapObject>,
}

/// An object that mirrors or refracts.
#[derive(Clone, Debug, Serialize)]
pub struct CubemapObject {
    /// Its name.
    pub name: String,
    /// Mean FLIP on it.
    pub flip: f64,
    /// Mean luminance with the cubemap relative to the truth, less 1; none where the truth is black.
    pub brighter: Option<f64>,
    /// Why it differs.
    pub reason: String,
}

/// The number and the title of a step, and what the lecture says there.
pub fn heading(step: Simplification) -> (&'static str, &'static str, &'static str) {
    let lecture = match step {
        Simplification::Time => "Nothing moves while the picture is taken, so t goes.",
        Simplification::Wavelengths => "Red, green and blue are three numbers, not a spectrum, so λ goes.",
        Simplification::Emission => "The light that an object emits is one colour for the object: L_e = E.",
        Simplification::Brdf => "Any BRDF becomes a diffuse and a specular term; mirrors and glass go.",
        Simplification::Interreflection => {
            "Light that other objects reflect is considered negligible: L_i comes from lamps only, where they are visible (V)."
        }
        Simplification::Shadows => "Nothing stands in the way of light: V = 1.",
        Simplification::Cosine => {
            "REMARK: this is a wrong model. The specular term loses its factor (ω_i·n), unless the scene keeps it."
        }
        Simplification::Attenuation => "att_i = 1 / (k_c + k_l d + k_q d^2) in place of the inverse square law.",
        Simplification::Sum => "There is only a finite number of lights, and they are points: ∫ → Σ_N.",
        Simplification::Ambient => "Too many simplifications: add a constant A for the light of other objects.",
    };
    let (number, title) = step.heading();
    (number, title, lecture)
}

impl StaircaseReport {
    /// The pictures that have another error than was asked for, in one sentence; none if all have it.
    pub fn missed(&self) -> Option<String> {
        let alone = self.alone.iter().skip(1);
        let named = self.steps.iter().chain(alone).map(|step| (step.name, &step.picture));
        let all: Vec<_> = std::iter::once(("truth", &self.truth)).chain(named).collect();
        let missed: Vec<_> = all.iter().filter(|(_, picture)| picture.missed).collect();
        let bound = |picture: &PictureReport| picture.error_bound.unwrap_or(f64::INFINITY);
        let (name, worst) = missed.iter().max_by(|a, b| bound(a.1).total_cmp(&bound(b.1)))?;
        Some(format!(
            "{} of {} pictures have a larger error than requested: tracing ended at {} paths per pixel; the largest error is {} \
             ({name})",
            missed.len(),
            all.len(),
            worst.paths,
            percent(bound(worst)),
        ))
    }
}

/// A share as a percentage with two significant digits.
pub fn percent(share: f64) -> String {
    let value = 100.0 * share;
    let decimals = if value.abs() >= 9.95 || value == 0.0 {
        0
    } else {
        (1.0 - value.abs().log10().floor()).clamp(0.0, 6.0) as usize
    };
    format!("{value:.decimals$} %")
}

/// Collects the numbers.
pub fn report(scene: &Scene, frame: &Frame, settings: &StaircaseSettings, staircase: &Staircase) -> StaircaseReport {
    let reference = ReferenceScene::new(scene);
    let observer = Observer { scene, frame, reference: &reference, shutter: settings.trace.shutter };
    let keeps_cosine = observer.keeps_cosine();
    let step = |now: &SimplifiedPicture, before: Simplifications| {
        let all = changes(&formula(before, keeps_cosine), &formula(now.traced.simplified, keeps_cosine));
        let (number, title, _) = heading(now.step);
        StepReport {
            name: now.step.name(),
            number,
            title,
            struck: struck(&all),
            result: result(&all),
            formula: plain(&formula(now.traced.simplified, keeps_cosine)),
            look: observer.look(now),
            picture: picture_report(&now.traced),
            to_before: now.to_before.clone(),
            to_truth: now.to_truth.clone(),
        }
    };
    let before = |now: &SimplifiedPicture| now.traced.simplified.without(now.step);
    let equation =
        |drawn: &EquationPicture| EquationReport { seconds: drawn.seconds, rms: drawn.rms, flip: drawn.flip };
    StaircaseReport {
        width: frame.width,
        height: frame.height,
        left_out: staircase.left_out,
        truth: picture_report(&staircase.truth),
        truth_formula: plain(&formula(Simplifications::NONE, keeps_cosine)),
        steps: staircase.steps.iter().map(|now| step(now, before(now))).collect(),
        alone: staircase.alone.iter().map(|now| step(now, Simplifications::NONE)).collect(),
        light_equation: staircase.light_equation.as_ref().map(equation),
        ambient: staircase.ambient.clone(),
        cubemap: staircase.cubemap.as_ref().map(|drawn| CubemapReport {
            picture: equation(drawn),
            objects: observer.objects_with_cubemap(drawn, &staircase.truth.picture),
        }),
    }
}

fn picture_report(traced: &crate::TracedPicture) -> PictureReport {
    let finite = |value: f64| value.is_finite().then_some(value);
    PictureReport {
        mean: traced.mean,
        error: finite(traced.error),
        error_bound: finite(traced.error_bound()),
        missed: traced.missed,
        paths: traced.paths(),
        seconds: traced.seconds,
        seconds_at_one_percent: finite(traced.seconds_at(0.01)),
    }
}

/// What the sentences are made of.
struct Observer<'a> {
    scene: &'a Scene,
    frame: &'a Frame,
    reference: &'a ReferenceScene,
    shutter: f64,
}

impl Observer<'_> {
    fn keeps_cosine(&self) -> bool {
        let equation = &self.frame.equation;
        equation.cosine_weighted || equation.brdf.is_some()
    }

    /// Why a step cannot change this scene; none if it can.
    fn reason(&self, step: Simplification) -> Option<String> {
        let scene = self.scene;
        let all = |test: &dyn Fn(&SceneMaterial) -> bool| scene.materials.iter().all(test);
        let reason = match step {
            Simplification::Time if self.shutter <= 0.0 => {
                "the shutter is open for a moment only (--shutter opens it longer)"
            }
            Simplification::Time if !self.moves() => "nothing moves here",
            Simplification::Emission if all(&|m| m.maps.emitted.is_none()) => "no part emits light with a texture",
            Simplification::Cosine if self.keeps_cosine() => "the scene's equation keeps the cosine",
            Simplification::Cosine if self.frame.equation.specular == Specular::None => "there is no specular term",
            Simplification::Cosine if all(&|m| m.material.specular == [0.0; 3]) => {
                "no material reflects specular light"
            }
            Simplification::Attenuation if !self.has_points() => "no light has a position",
            Simplification::Attenuation if self.obeys_inverse_square() => {
                "the lights fall with the square of the distance already"
            }
            Simplification::Ambient if crate::staircase::own_ambient(self.frame) == DVec3::ZERO => {
                "the scene has no ambient light"
            }
            Simplification::Ambient if self.frame.equation.brdf.is_some() => "the scene's BRDF has no ambient term",
            _ => return None,
        };
        Some(reason.to_owned())
    }

    /// Whether anything moves during the exposure.
    fn moves(&self) -> bool {
        // A period may end with the exposure.
        self.scene.has_moving_objects()
            || [0.5, 1.0]
                .iter()
                .any(|part| self.scene.frame(self.frame.time + part * self.shutter).lights != self.frame.lights)
    }

    fn obeys_inverse_square(&self) -> bool {
        let placed = self
            .frame
            .lights
            .iter()
            .filter(|light| matches!(light.kind, LightKind::Point { .. } | LightKind::Spot { .. }));
        self.frame.equation.terms.attenuation
            && placed.map(|light| light.attenuation).all(|att| att.constant == 0.0 && att.linear == 0.0)
    }

    fn has_points(&self) -> bool {
        let is_point = |kind: &LightKind| matches!(kind, LightKind::Point { .. } | LightKind::Spot { .. });
        self.frame.lights.iter().any(|light| is_point(&light.kind) && light.color != DVec3::ZERO)
    }

    /// What is seen at a pixel.
    fn seen_at(&self, x: u32, y: u32) -> String {
        let seen = self.reference.probe(self.frame, x, y);
        let eye = self.frame.camera.position;
        match (self.lamp_at(x, y, seen.as_ref().map(|probe| probe.position.distance(eye))), seen) {
            (Some(lamp), _) => format!("the lamp of {}", crate::staircase::light_name(self.scene, lamp)),
            (None, Some(probe)) => format!("`{}`", probe.object_name),
            (None, None) => "the background".to_owned(),
        }
    }

    /// The light whose lamp is seen at a pixel, nearer than `nearest`; its number, from 0.
    fn lamp_at(&self, x: u32, y: u32, nearest: Option<f64>) -> Option<usize> {
        let Frame { camera, width, height, lights, light_shapes, .. } = self.frame;
        let d = camera.ray_direction(f64::from(x) + 0.5, f64::from(y) + 0.5, *width, *height);
        let seen = lights.iter().zip(light_shapes).enumerate().filter_map(|(index, (light, shape))| {
            let (LightKind::Point { position } | LightKind::Spot { position, .. }) = light.kind else { return None };
            let to_center = position - camera.position;
            let distance = match *shape {
                LightShape::Point => return None,
                LightShape::Sphere { radius } => {
                    let along = to_center.dot(d);
                    let inside = radius * radius - (to_center - along * d).length_squared();
                    (inside > 0.0).then(|| along - inside.sqrt())?
                }
                LightShape::Rectangle { half_right, half_up } => {
                    let normal = half_right.cross(half_up);
                    let distance = to_center.dot(normal) / d.dot(normal);
                    let at = distance * d - to_center;
                    let is_in = |half: DVec3| at.dot(half).abs() <= half.length_squared();
                    (is_in(half_right) && is_in(half_up)).then_some(distance)?
                }
            };
            (distance > 0.0 && nearest.is_none_or(|nearest| distance < nearest)).then_some((index, distance))
        });
        seen.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(index, _)| index)
    }

    fn look(&self, now: &SimplifiedPicture) -> String {
        let to_before = &now.to_before;
        let reason = self.reason(now.step);
        if to_before.identical {
            return match reason {
                Some(reason) => format!("Nothing changes: {reason}."),
                None => "Nothing changes: both pictures are the same, bit for bit.".to_owned(),
            };
        }
        let noise = percent(to_before.noise);
        let (Some(most), false) = (&to_before.most, to_before.below_noise) else {
            let because = reason.map(|reason| format!(": {reason}")).unwrap_or_default();
            return format!("The difference is below the noise ({noise} of the mean light){because}.");
        };
        let mut text =
            format!("Look at {} around ({}, {}): {}.", self.seen_at(most.x, most.y), most.x, most.y, self.change(most));
        if let Some(source) = &now.source {
            text += &format!(" Most of the change there is light from {source}.");
        }
        if let Some(brighter) = to_before.brighter {
            let (amount, direction) = (percent(brighter.abs()), if brighter < 0.0 { "less" } else { "more" });
            if brighter.abs() >= 5e-4 {
                text += &format!(" The whole picture has {amount} {direction} light{}.", meaning(now.step, brighter));
            } else {
                text += " The whole picture has as much light as before.";
            }
        }
        if now.step == Simplification::Brdf {
            let names = self.special_objects();
            if !names.is_empty() {
                text += &format!(" Mirrors and glass are surfaces like others now: {}.", names.join(", "));
            }
        }
        text
    }

    /// What happens to a square of the picture.
    fn change(&self, most: &LargestDifference) -> String {
        let (before, after) = (luminance(most.before), luminance(most.after));
        let ratio = after / before;
        let hex = |light: DVec3| {
            let [r, g, b, _] = DisplayMap::Light(self.frame.output).apply(light.extend(1.0).as_vec4().to_array());
            let [r, g, b] = [r, g, b].map(|v| (255.0 * v + 0.5) as u8);
            format!("#{r:02x}{g:02x}{b:02x}")
        };
        let colors = format!("from {} to {}", hex(most.before), hex(most.after));
        if hex(most.before) == hex(most.after) {
            return format!("the change is too small to see, {colors}");
        }
        if !ratio.is_finite() || before <= 0.0 {
            format!("light appears where there was none ({colors})")
        } else if ratio >= 1.02 {
            let amount = if ratio >= 3.0 {
                format!("{ratio:.1} times as bright")
            } else {
                format!("{} brighter", percent(ratio - 1.0))
            };
            format!("it becomes {amount} ({colors})")
        } else if ratio < 0.005 {
            format!("it turns black ({colors})")
        } else if ratio <= 0.98 {
            format!("it becomes {} darker ({colors})", percent(1.0 - ratio))
        } else {
            format!("its colour changes {colors}, its brightness hardly")
        }
    }

    /// Objects with a material that mirrors or refracts.
    fn special_objects(&self) -> Vec<String> {
        let is_special = |object: &&gonio_scene::Object| {
            object.parts.iter().any(|p| self.scene.materials.get(p.material).is_some_and(|m| !m.optics.is_plain()))
        };
        self.scene.objects.iter().filter(is_special).map(|object| format!("`{}`", object.name)).collect()
    }

    /// Mirrors and glass, measured at the pixels of a grid.
    fn objects_with_cubemap(&self, drawn: &EquationPicture, truth: &gonio_scene::Picture) -> Vec<CubemapObject> {
        let Frame { width, height, .. } = *self.frame;
        let step = (f64::from(width) * f64::from(height) / 1500.0).sqrt().ceil().max(1.0) as usize;
        // Sums of FLIP, of both luminances, and the number of pixels.
        let mut sums = vec![DVec4::ZERO; self.scene.objects.len()];
        let mut material = vec![None; self.scene.objects.len()];
        let along = |length: u32| (0..length).skip(step / 2).step_by(step);
        let pixels = along(height).flat_map(|y| along(width).map(move |x| (x, y)));
        for probe in self.reference.probe_all(self.frame, pixels).into_iter().flatten() {
            if probe.optics.is_plain() || probe.object >= sums.len() {
                continue;
            }
            let i = (probe.y * width + probe.x) as usize;
            let light = |p: &gonio_scene::Picture| luminance(crate::comparison::light(p.pixels[i]));
            sums[probe.object] += DVec4::new(drawn.map[i].into(), light(truth), light(&drawn.picture), 1.0);
            material[probe.object] = Some(probe.material);
        }
        let seen = sums.iter().zip(&material).zip(&self.scene.objects);
        seen.filter(|((sum, _), _)| sum.w > 0.0)
            .map(|((sum, material), object)| CubemapObject {
                name: object.name.clone(),
                flip: sum.x / sum.w,
                brighter: (sum.y > 0.0).then(|| sum.z / sum.y - 1.0),
                reason: material.and_then(|m: usize| self.scene.materials.get(m)).map_or_else(String::new, reason_of),
            })
            .collect()
    }
}

/// Where light that a step adds or removes goes, if that is known from what the step is.
fn meaning(step: Simplification, brighter: f64) -> &'static str {
    match step {
        Simplification::Interreflection if brighter < 0.0 => ": that was light from other surfaces",
        Simplification::Shadows if brighter > 0.0 => ": light that surfaces blocked",
        Simplification::Ambient if brighter > 0.0 => ": the constant A",
        _ => "",
    }
}

/// What a cubemap cannot show in a material.
fn reason_of(material: &SceneMaterial) -> String {
    let optics = &material.optics;
    let mut reasons = vec!["it reflects the cubemap only, never another object or itself"];
    if optics.transmission > 0.0 {
        reasons.push("what is seen through it is the cubemap, without the objects behind it");
        reasons.push(match optics.surfaces {
            gonio_light::Surfaces::One => "light is bent once, where it enters, and not where it leaves",
            gonio_light::Surfaces::Two => "light is bent where it enters and where it leaves, as in the truth",
        });
        if optics.dispersion > 0.0 {
            reasons.push("three channels are bent differently, not every wavelength");
        }
    }
    reasons.join("; ")
}
