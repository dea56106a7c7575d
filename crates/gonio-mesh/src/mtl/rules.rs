//! Converts statements to a material: decides on the values of statements that are absent or contradict others, and
//! records the source of each value.

use super::draft::Draft;
use super::physical::Physical;
use super::values::{Located, source};
use crate::diagnostic::Reports;
use crate::text::quote;
use crate::{AmbientRule, Material, PropertySource, Severity, TextureMap};

/// `Kd` if neither it nor `map_Kd` is written: that of a new material in Blender.
const DIFFUSE: f32 = 0.8;
/// `Ns` if it is not written: the default of the lab.
const SHININESS: f32 = 32.0;
/// `Ns` if only `map_Ns` is written: the largest value that Blender writes.
const SHININESS_OF_MAP: f32 = 1000.0;
/// `Ni` if it is not written: glass, plastics.
const REFRACTION_INDEX: f32 = 1.5;

/// The state while the values of a material are determined.
pub(super) struct Rules<'a> {
    /// The material's name for messages.
    pub(super) name: String,
    pub(super) reports: &'a mut Reports,
    /// Sources of the values determined so far.
    pub(super) sources: Vec<PropertySource>,
    /// Statements that are not used.
    pub(super) unused: Vec<PropertySource>,
    /// Whether the precedence of `Pr` and `Pm` has been reported.
    pub(super) has_reported_physical: &'a mut bool,
}

/// A value and its source.
pub(super) type Sourced<T> = (T, PropertySource);

impl Rules<'_> {
    /// The material.
    pub(super) fn material(&mut self, mut draft: Draft) -> Material {
        let (diffuse, diffuse_source) = self.color(
            "diffuse",
            "Kd",
            &draft.diffuse,
            &draft.diffuse_map,
            (DIFFUSE, "0.8, a new material of Blender's"),
        );
        let ambient = self.ambient(&mut draft);
        let (specular, specular_source) =
            self.color("specular", "Ks", &draft.specular, &draft.specular_map, (0.0, "0"));
        let (emitted, emitted_source) = self.color("emitted", "Ke", &draft.emitted, &draft.emitted_map, (0.0, "0"));
        let physical = Physical::from_draft(&mut draft, diffuse, self);
        let is_matte = self.illumination_model(&draft, &physical, specular);

        let mut surface = Surface {
            diffuse: (diffuse, diffuse_source),
            specular: (specular, specular_source),
            shininess: (1.0, source::<f32>("shininess", None, "")),
        };
        let mut metallic_roughness = None;
        match physical {
            Some(physical) => metallic_roughness = physical.apply(&mut draft, &mut surface, is_matte, self),
            None => {
                if let Some(rule) = &is_matte {
                    surface.specular.0 = [0.0; 3];
                    surface.specular.1.rule.clone_from(rule);
                    self.discard("specular_map", draft.specular_map.take(), rule);
                }
                surface.shininess = self.shininess(&draft, surface.specular.0 != [0.0; 3]);
            }
        }
        let refraction_index = self.refraction_index(&draft);
        let (opacity, opacity_source) = self.opacity(&mut draft);

        let sources = vec![surface.diffuse.1, surface.specular.1, emitted_source, surface.shininess.1];
        let physical_sources = std::mem::take(&mut self.sources);
        self.sources.push(ambient.1);
        self.sources.extend(sources);
        self.sources.extend([refraction_index.1, opacity_source]);
        if let Some(located) = &draft.illumination_model {
            self.sources.push(located.source("illumination_model", illumination_rule(located.value)));
        }
        let mut material = Material {
            ambient: ambient.0,
            diffuse: surface.diffuse.0,
            specular: surface.specular.0,
            emitted,
            shininess: surface.shininess.0,
            refraction_index: refraction_index.0,
            opacity,
            illumination_model: draft.illumination_model.map(|located| located.value),
            diffuse_map: self.map("diffuse_map", draft.diffuse_map, ""),
            specular_map: self.map("specular_map", draft.specular_map, ""),
            emitted_map: self.map("emitted_map", draft.emitted_map, ""),
            shininess_map: self.map(
                "shininess_map",
                draft.shininess_map,
                "times shininess (Blender writes its roughness map here, which is inverted)",
            ),
            opacity_map: self.opacity_map(draft.opacity_map, draft.transparency_map),
            normal_map: self.map("normal_map", draft.normal_map, ""),
            bump_map: self.map("bump_map", draft.bump_map, "heights or normals: its colors decide"),
            metallic_roughness,
            ..Material { name: draft.name, ..Material::default() }
        };
        self.sources.extend(physical_sources);
        material.sources = std::mem::take(&mut self.sources);
        material.unused = draft.unused;
        material.unused.append(&mut self.unused);
        material.unused.sort_by_key(|source| source.line);
        material
    }

    fn map(&mut self, property: &'static str, located: Option<Located<TextureMap>>, rule: &str) -> Option<TextureMap> {
        let located = located?;
        self.sources.push(located.source(property, rule));
        Some(located.value)
    }

    /// Reports, once per library, that `Pr` and `Pm` have precedence.
    pub(super) fn report_physical(&mut self, line: u64) {
        if !std::mem::replace(self.has_reported_physical, true) {
            self.reports.note(line, "where Pr or Pm is written, Ks and Ns are not used");
        }
    }

    /// Records a statement that a rule discards.
    pub(super) fn discard<T>(&mut self, property: &'static str, located: Option<Located<T>>, rule: &str) {
        self.unused.extend(located.map(|located| located.source(property, rule)));
    }

    /// Returns the color that is multiplied by a map. Black would hide the map, which no one can have meant.
    fn color(
        &mut self,
        property: &'static str,
        keyword: &str,
        located: &Option<Located<[f32; 3]>>,
        map: &Option<Located<TextureMap>>,
        (absent, absent_text): (f32, &str),
    ) -> Sourced<[f32; 3]> {
        match (located, map) {
            (Some(located), Some(_)) if located.value == [0.0; 3] => {
                let (line, column, name) = (located.place.line, Some(located.place.column), &self.name);
                self.reports.add("colors that are black beside their maps", Severity::Note, line, column, || {
                    format!("{keyword} of {name} is black beside map_{keyword}: treated as 1 1 1")
                });
                ([1.0; 3], located.source(property, format!("black beside map_{keyword}: treated as 1 1 1")))
            }
            (Some(located), _) => {
                let is_xyz = located.place.written.to_ascii_lowercase().contains(" xyz ");
                (located.value, located.source(property, if is_xyz { "from CIE XYZ to linear sRGB" } else { "" }))
            }
            (None, Some(_)) => {
                let rule = format!("not written beside map_{keyword}: 1 1 1");
                ([1.0; 3], source::<()>(property, None, rule))
            }
            (None, None) => ([absent; 3], source::<()>(property, None, format!("not written: {absent_text}"))),
        }
    }

    /// Returns `k_a`: the written value, or "follows the diffuse color".
    fn ambient(&mut self, draft: &mut Draft) -> Sourced<AmbientRule> {
        const FOLLOWS: AmbientRule = AmbientRule::FollowsDiffuse;
        if let Some(map) = draft.ambient_map.take() {
            if draft.diffuse_map.as_ref().is_some_and(|diffuse| diffuse.value.path == map.value.path) {
                return (FOLLOWS, map.source("ambient", "the same image as map_Kd: follows the diffuse color"));
            }
            let (line, column, name) = (map.place.line, Some(map.place.column), &self.name);
            self.reports.add("maps of the ambient color", Severity::Note, line, column, || {
                format!("map_Ka of {name} is a different image from map_Kd: it is not used")
            });
            self.discard("map_Ka", Some(map), "the ambient color has no texture of its own");
        }
        match &draft.ambient {
            None => (FOLLOWS, source::<()>("ambient", None, "not written: follows the diffuse color")),
            Some(located) if located.value == [1.0; 3] => {
                (FOLLOWS, located.source("ambient", "1 1 1, as Blender always writes: follows the diffuse color"))
            }
            Some(located) => (AmbientRule::Value(located.value), located.source("ambient", "")),
        }
    }

    /// Reports features of the model that are not supported. Returns the rule by which it switches the highlight off,
    /// if it does.
    fn illumination_model(&mut self, draft: &Draft, physical: &Option<Physical>, specular: [f32; 3]) -> Option<String> {
        let located = draft.illumination_model.as_ref()?;
        let (model, line, column) = (located.value, located.place.line, Some(located.place.column));
        let name = &self.name;
        if let Some(features) = unsupported_features(model) {
            self.reports.add("unsupported illumination models", Severity::Note, line, column, || {
                format!("illum {model} of {name} asks for {features}")
            });
        }
        // Metal always has a highlight: Blender writes illum 1 for `Ks 0`, which does not apply to metal.
        if model > 1 || physical.as_ref().is_some_and(Physical::is_metal) {
            return None;
        }
        if physical.is_some() || specular != [0.0; 3] || draft.specular_map.is_some() {
            let what = if physical.is_some() { "highlight" } else { "Ks" };
            self.reports.add("highlights switched off", Severity::Note, line, column, || {
                format!("the material {name} has illum {model}, which switches its {what} off")
            });
        }
        Some(format!("illum {model} switches the highlight off"))
    }

    fn shininess(&mut self, draft: &Draft, is_seen: bool) -> Sourced<f32> {
        let Some(located) = &draft.shininess else {
            return match draft.shininess_map {
                Some(_) => (
                    SHININESS_OF_MAP,
                    source::<()>("shininess", None, "not written beside map_Ns: 1000, Blender's largest"),
                ),
                None => (SHININESS, source::<()>("shininess", None, "not written: 32")),
            };
        };
        let (line, column, name) = (located.place.line, Some(located.place.column), &self.name);
        match (located.value, &draft.shininess_map) {
            (0.0, Some(_)) => {
                self.reports.add("exponents of 0 beside their maps", Severity::Note, line, column, || {
                    format!("Ns of {name} is 0 beside map_Ns: treated as 1000")
                });
                (SHININESS_OF_MAP, located.source("shininess", "0 beside map_Ns: treated as 1000"))
            }
            (value, _) if value < 1.0 => {
                if is_seen {
                    self.reports.add("exponents below 1", Severity::Note, line, column, || {
                        format!("the material {name} has Ns {value}: using 1, the minimum")
                    });
                }
                (1.0, located.source("shininess", "at least 1"))
            }
            (value, _) => (value, located.source("shininess", "")),
        }
    }

    fn refraction_index(&mut self, draft: &Draft) -> Sourced<f32> {
        match &draft.refraction_index {
            Some(located) if located.value > 0.0 => (located.value, located.source("refraction_index", "")),
            Some(located) => {
                (REFRACTION_INDEX, located.source("refraction_index", "0 is not a refraction index: using 1.5"))
            }
            None => (REFRACTION_INDEX, source::<()>("refraction_index", None, "not written: 1.5")),
        }
    }

    /// Returns `d`, or 1 - `Tr`, from 0 to 1. With a map, 0 would hide it.
    fn opacity(&mut self, draft: &mut Draft) -> Sourced<f32> {
        const PROPERTY: &str = "opacity";
        if draft.opacity_map.is_none()
            && draft.opacity.is_none()
            && let (Some(map), Some(located)) = (&mut draft.transparency_map, &draft.transparency)
        {
            // map_Tr is multiplied by Tr, and the product is the transparency.
            let gain = if located.value == 0.0 { 1.0 } else { located.value.min(1.0) };
            (map.value.texel.base, map.value.texel.gain) = (map.value.texel.base * gain, map.value.texel.gain * gain);
            let rule = if located.value == 0.0 { "0 beside map_Tr: treated as 1" } else { "1 - Tr * map_Tr" };
            return (1.0, located.source(PROPERTY, rule));
        }
        let (value, from) = match (&draft.opacity, &draft.transparency) {
            (Some(d), Some(tr)) if (d.value - (1.0 - tr.value)).abs() > 1e-4 => {
                let (line, column, name) = (tr.place.line, Some(tr.place.column), &self.name);
                let (opacity, transparency) = (d.value, tr.value);
                self.reports.add("contradictions of d and Tr", Severity::Note, line, column, || {
                    format!("d ({opacity}) and Tr ({transparency}) of {name} contradict each other: using d")
                });
                (d.value, d.source(PROPERTY, format!("Tr (line {line}) contradicts it: using d")))
            }
            (Some(d), _) => (d.value, d.source(PROPERTY, if d.value > 1.0 { "at most 1" } else { "" })),
            (None, Some(tr)) => (1.0 - tr.value, tr.source(PROPERTY, "1 - Tr")),
            (None, None) => (1.0, source::<()>(PROPERTY, None, "not written: 1")),
        };
        let (line, name) = (from.line.unwrap_or(draft.line), &self.name);
        let has_map = draft.opacity_map.is_some() || draft.transparency_map.is_some();
        if value <= 0.0 && has_map {
            self.reports.add("opacities of 0 beside their maps", Severity::Note, line, None, || {
                format!("the opacity of {name} is 0 beside its map: treated as 1")
            });
            return (1.0, PropertySource { rule: "0 beside its map: treated as 1".to_owned(), ..from });
        }
        if value <= 0.0 {
            self.reports.add("invisible materials", Severity::Note, line, None, || {
                format!("the material {name} is invisible (d 0 or Tr 1)")
            });
        }
        (value.clamp(0.0, 1.0), from)
    }

    /// Returns `map_d`, or `map_Tr` inverted.
    fn opacity_map(
        &mut self,
        opacity: Option<Located<TextureMap>>,
        transparency: Option<Located<TextureMap>>,
    ) -> Option<TextureMap> {
        let Some(mut map) = transparency else { return self.map("opacity_map", opacity, "") };
        if opacity.is_some() {
            let (line, column, name) = (map.place.line, Some(map.place.column), &self.name);
            self.reports.add("map_Tr beside map_d", Severity::Note, line, column, || {
                format!("{name} has map_d and map_Tr: using map_d")
            });
            self.discard("map_Tr", Some(map), "map_d is used instead");
            return self.map("opacity_map", opacity, "");
        }
        let texel = &mut map.value.texel;
        (texel.base, texel.gain) = (1.0 - texel.base, -texel.gain);
        self.map("opacity_map", Some(map), "inverted: white is transparent")
    }
}

/// The three values that the physically based extension replaces.
pub(super) struct Surface {
    pub(super) diffuse: Sourced<[f32; 3]>,
    pub(super) specular: Sourced<[f32; 3]>,
    pub(super) shininess: Sourced<f32>,
}

/// Describes what an illumination model asks for beyond the light equation, and what is done instead.
fn unsupported_features(model: u8) -> Option<&'static str> {
    Some(match model {
        0 => "a constant color without lights: it is lit as with illum 1",
        3 => "reflections by ray tracing, which need surroundings: it is lit as with illum 2",
        4 => "glass and reflections by ray tracing, which need surroundings: it is lit as with illum 2",
        5 => "reflections by Fresnel's law, which need surroundings: it is lit as with illum 2",
        6 => "refraction and reflections by ray tracing, which need surroundings: it is lit as with illum 2",
        7 => "refraction and reflections by Fresnel's law, which need surroundings: it is lit as with illum 2",
        8 => "reflections of a map, which need surroundings: it is lit as with illum 2",
        9 => "glass and reflections of a map, which need surroundings: it is lit as with illum 2",
        10 => "shadows cast on invisible surfaces, which are not supported: it is lit as with illum 2",
        _ => return None,
    })
}

/// Describes what an illumination model switches on and off.
fn illumination_rule(model: u8) -> &'static str {
    match model {
        0 => "constant color: highlight off; lights are not switched off",
        1 => "diffuse on, highlight off",
        2 => "diffuse and highlight on",
        3 => "highlight on; reflections are not supported",
        4 | 9 => "highlight on; glass and reflections are not supported",
        5 | 8 => "highlight on; reflections are not supported",
        6 | 7 => "highlight on; refraction and reflections are not supported",
        _ => "highlight on; shadows on invisible surfaces are not supported",
    }
}

pub(super) fn quoted_name(draft: &Draft) -> String {
    quote(draft.name.as_bytes())
}
