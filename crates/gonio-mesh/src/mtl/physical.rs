//! The physically based extension (Exocortex, 2015, "Extending Wavefront MTL for physically-based rendering"): `Pr`,
//! `Pm` and their maps.
//!
//! They replace `Ks` and `Ns`: a program that writes them means them, and writes `Ks` and `Ns` for other readers only.
//! Blender's `Ks 0.5`, for example, means a reflectance of 0.04, and says nothing about metals.

use super::draft::Draft;
use super::rules::{Rules, Sourced, Surface};
use super::values::{Located, source};
use crate::{MetallicRoughness, Severity, TextureMap};

/// `Pr` if neither it nor `Ns` is written: that of a new material in Blender.
const ROUGHNESS: f32 = 0.5;

/// The values of the extension's statements for a material.
pub(super) struct Physical {
    base_color: [f32; 3],
    metallic: Sourced<f32>,
    roughness: Sourced<f32>,
    metallic_map: Option<Located<TextureMap>>,
    roughness_map: Option<Located<TextureMap>>,
    /// Whether the roughness is derived from `Ns`.
    is_from_exponent: bool,
}

impl Physical {
    /// Returns `None` if the material has no such statement.
    pub(super) fn from_draft(draft: &mut Draft, base_color: [f32; 3], rules: &mut Rules<'_>) -> Option<Self> {
        let (metallic_map, roughness_map) = (draft.metallic_map.take(), draft.roughness_map.take());
        let (metallic, roughness) = (draft.metallic.take(), draft.roughness.take());
        if metallic_map.is_none() && roughness_map.is_none() && metallic.is_none() && roughness.is_none() {
            return None;
        }
        let is_from_exponent = roughness.is_none() && roughness_map.is_none() && draft.shininess.is_some();
        let metallic = factor(["metallic_roughness.metallic", "Pm"], &metallic, &metallic_map, rules)
            .unwrap_or_else(|| (0.0, source::<()>("metallic_roughness.metallic", None, "not written: 0")));
        let roughness = factor(["metallic_roughness.roughness", "Pr"], &roughness, &roughness_map, rules)
            .unwrap_or_else(|| match &draft.shininess {
                Some(ns) => {
                    let rule = "not written: (2 / (Ns + 2))^(1/4)";
                    (MetallicRoughness::roughness(ns.value), ns.source("metallic_roughness.roughness", rule))
                }
                None => (
                    ROUGHNESS,
                    source::<()>("metallic_roughness.roughness", None, "not written: 0.5, a new material of Blender's"),
                ),
            });
        Some(Physical { base_color, metallic, roughness, metallic_map, roughness_map, is_from_exponent })
    }

    /// Whether any of the surface is metal.
    pub(super) fn is_metal(&self) -> bool {
        self.metallic.0 > 0.0
    }

    /// Replaces `Kd`, `Ks` and `Ns`. `is_matte` is the rule that switches off the highlight of dielectrics, which
    /// leaves only the diffuse color.
    pub(super) fn apply(
        self,
        draft: &mut Draft,
        surface: &mut Surface,
        is_matte: Option<String>,
        rules: &mut Rules<'_>,
    ) -> Option<MetallicRoughness> {
        let (metallic, roughness) = (self.metallic.0, self.roughness.0);
        let statement = if self.metallic.1.line.is_some() { &self.metallic.1 } else { &self.roughness.1 };
        if draft.specular.is_some() || draft.shininess.is_some() && !self.is_from_exponent {
            rules.report_physical(statement.line.unwrap_or(draft.line));
        }
        const RULE: &str = "replaced by Pr or Pm";
        rules.discard("Ks", draft.specular.take(), RULE);
        rules.discard("map_Ks", draft.specular_map.take(), RULE);
        if !self.is_from_exponent {
            rules.discard("Ns", draft.shininess.take(), RULE);
            rules.discard("map_Ns", draft.shininess_map.take(), RULE);
        }

        surface.diffuse.0 = MetallicRoughness::diffuse(self.base_color, metallic);
        if self.is_metal() {
            let rule = &mut surface.diffuse.1.rule;
            if !rule.is_empty() {
                rule.push_str("; ");
            }
            rule.push_str("times 1 - metalness");
        }
        let written = draft.shininess.as_ref().filter(|_| self.is_from_exponent).map(|ns| ns.value.max(1.0));
        let exponent = written.unwrap_or_else(|| MetallicRoughness::shininess(roughness));
        surface.shininess = (exponent, self.roughness.1.clone());
        surface.shininess.1.property = "shininess";
        surface.shininess.1.rule = if self.is_from_exponent {
            String::new()
        } else {
            let of = if self.roughness.1.rule.is_empty() { "Pr".to_owned() } else { format!("{roughness}") };
            format!("2 / r^4 - 2 of r = {of}, from 1 to 10,000")
        };
        surface.specular.1 = statement.clone();
        surface.specular.1.property = "specular";
        if let Some(rule) = is_matte {
            surface.specular.0 = [0.0; 3];
            surface.specular.1.rule.clone_from(&rule);
            rules.discard("map_Pr", self.roughness_map, &rule);
            return None;
        }
        surface.specular.0 = MetallicRoughness::specular(self.base_color, metallic);
        surface.specular.1.rule = "from 0.04 to the base color, by metalness".to_owned();
        rules.sources.extend([self.metallic.1, self.roughness.1]);
        let mut map = |property, located: Option<Located<TextureMap>>| {
            let located = located?;
            rules.sources.push(located.source(property, ""));
            Some(located.value)
        };
        Some(MetallicRoughness {
            base_color: self.base_color,
            metallic,
            roughness,
            metallic_map: map("metallic_roughness.metallic_map", self.metallic_map),
            roughness_map: map("metallic_roughness.roughness_map", self.roughness_map),
        })
    }
}

/// Reads a number from 0 to 1 that is multiplied by a map; 0 would hide the map. `None` if neither is written.
fn factor(
    [property, keyword]: [&'static str; 2],
    located: &Option<Located<f32>>,
    map: &Option<Located<TextureMap>>,
    rules: &mut Rules<'_>,
) -> Option<Sourced<f32>> {
    let Some(located) = located else {
        return map.as_ref().map(|_| (1.0, source::<()>(property, None, "not written beside its map: 1")));
    };
    if located.value == 0.0 && map.is_some() {
        let (line, column, name) = (located.place.line, Some(located.place.column), &rules.name);
        rules.reports.add("numbers that are 0 beside their maps", Severity::Note, line, column, || {
            format!("{keyword} of {name} is 0 beside its map: treated as 1")
        });
        return Some((1.0, located.source(property, "0 beside its map: treated as 1")));
    }
    let rule = if located.value > 1.0 { "at most 1" } else { "" };
    Some((located.value.min(1.0), located.source(property, rule)))
}
