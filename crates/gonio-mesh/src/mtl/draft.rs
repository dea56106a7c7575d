//! A material while its statements are read, and the rules for what they leave out.

use super::scalar;
use crate::report::Reports;
use crate::text::{Cursor, quote};
use crate::{AmbientRule, Material, Severity, TextureMap};

/// `Kd` where neither it nor `map_Kd` is written: a new material of Blender's.
const DIFFUSE: f32 = 0.8;
/// `Ns` where it is not written: the lab's exponent.
const SHININESS: f32 = 32.0;
/// `Ns` where only `map_Ns` is: the largest that Blender writes.
const SHININESS_OF_MAP: f32 = 1000.0;
/// `Ni` where it is not written: glass, plastics.
const REFRACTION_INDEX: f32 = 1.5;

/// What was written, and nothing else.
pub(super) struct Draft {
    name: String,
    pub(super) line: u64,
    pub(super) ambient: Option<[f32; 3]>,
    pub(super) diffuse: Option<[f32; 3]>,
    pub(super) specular: Option<[f32; 3]>,
    pub(super) emitted: Option<[f32; 3]>,
    pub(super) shininess: Option<f32>,
    pub(super) refraction_index: Option<f32>,
    pub(super) opacity: Option<f32>,
    /// With its line.
    pub(super) transparency: Option<(f32, u64)>,
    pub(super) illumination_model: Option<u8>,
    pub(super) diffuse_map: Option<TextureMap>,
    pub(super) specular_map: Option<TextureMap>,
    pub(super) emitted_map: Option<TextureMap>,
    pub(super) shininess_map: Option<TextureMap>,
    pub(super) opacity_map: Option<TextureMap>,
    pub(super) normal_map: Option<TextureMap>,
    pub(super) bump_map: Option<TextureMap>,
}

impl Draft {
    pub(super) fn new(name: String, line: u64) -> Self {
        Draft {
            name,
            line,
            ambient: None,
            diffuse: None,
            specular: None,
            emitted: None,
            shininess: None,
            refraction_index: None,
            opacity: None,
            transparency: None,
            illumination_model: None,
            diffuse_map: None,
            specular_map: None,
            emitted_map: None,
            shininess_map: None,
            opacity_map: None,
            normal_map: None,
            bump_map: None,
        }
    }

    /// `d 0.5` or `d -halo 0.5`.
    pub(super) fn read_opacity(&mut self, cursor: &mut Cursor<'_>, reports: &mut Reports) {
        let line = cursor.line();
        if cursor.next_word() && cursor.peek() == Some(b'-') && cursor.offending_word() == b"-halo" {
            cursor.word();
            reports.add("halos", Severity::Note, line, None, || {
                "d -halo is read as d: its change with the angle is not done".to_owned()
            });
        }
        self.opacity = scalar(cursor, "d", reports).or(self.opacity);
    }

    /// `illum 2`.
    pub(super) fn read_illumination_model(&mut self, cursor: &mut Cursor<'_>, reports: &mut Reports) {
        let line = cursor.line();
        let Some(value) = scalar(cursor, "illum", reports) else { return };
        if value.fract() == 0.0 && value <= 10.0 {
            self.illumination_model = Some(value as u8);
        } else {
            reports.add("unknown illumination models", Severity::Warning, line, None, || {
                format!("illum {value} is no illumination model (0 to 10): it is ignored")
            });
        }
    }

    pub(super) fn into_material(mut self, reports: &mut Reports) -> Material {
        let opacity = self.opacity_of_both(reports);
        let ambient = match self.ambient {
            None | Some([1.0, 1.0, 1.0]) => AmbientRule::FollowsDiffuse,
            Some(value) => AmbientRule::Value(value),
        };
        let diffuse = self.with_map(self.diffuse, &self.diffuse_map, "Kd", DIFFUSE, reports);
        let mut specular = self.with_map(self.specular, &self.specular_map, "Ks", 0.0, reports);
        let emitted = self.with_map(self.emitted, &self.emitted_map, "Ke", 0.0, reports);
        if let Some(model @ (0 | 1)) = self.illumination_model
            && (specular != [0.0; 3] || self.specular_map.is_some())
        {
            let name = quote(self.name.as_bytes());
            reports.note(self.line, format!("the material {name} has illum {model}, which switches its Ks off"));
            specular = [0.0; 3];
            self.specular_map = None;
        }
        let mut shininess =
            self.shininess.unwrap_or(if self.shininess_map.is_some() { SHININESS_OF_MAP } else { SHININESS });
        if shininess < 1.0 {
            if specular != [0.0; 3] {
                let name = quote(self.name.as_bytes());
                reports.note(self.line, format!("the material {name} has Ns {shininess}: 1 is taken, the smallest"));
            }
            shininess = 1.0;
        }
        Material {
            name: self.name,
            ambient,
            diffuse,
            specular,
            emitted,
            shininess,
            refraction_index: self.refraction_index.filter(|ni| *ni > 0.0).unwrap_or(REFRACTION_INDEX),
            opacity,
            illumination_model: self.illumination_model,
            diffuse_map: self.diffuse_map,
            specular_map: self.specular_map,
            emitted_map: self.emitted_map,
            shininess_map: self.shininess_map,
            opacity_map: self.opacity_map,
            normal_map: self.normal_map,
            bump_map: self.bump_map,
        }
    }

    /// The color that a map is multiplied by: black would hide the map, which no one can have meant.
    fn with_map(
        &self,
        written: Option<[f32; 3]>,
        map: &Option<TextureMap>,
        keyword: &str,
        absent: f32,
        reports: &mut Reports,
    ) -> [f32; 3] {
        match (written, map) {
            (Some([0.0, 0.0, 0.0]), Some(map)) => {
                let line = map.line.unwrap_or(self.line);
                let name = quote(self.name.as_bytes());
                reports.note(line, format!("{keyword} of {name} is black beside map_{keyword}: taken as 1 1 1"));
                [1.0; 3]
            }
            (Some(written), _) => written,
            (None, Some(_)) => [1.0; 3],
            (None, None) => [absent; 3],
        }
    }

    /// `d`, or 1 - `Tr`; at most 1.
    fn opacity_of_both(&self, reports: &mut Reports) -> f32 {
        let from_tr = self.transparency.map(|(tr, _)| 1.0 - tr);
        let opacity = match (self.opacity, from_tr) {
            (Some(d), Some(other)) if (d - other).abs() > 1e-4 => {
                let line = self.transparency.map_or(self.line, |(_, line)| line);
                let name = quote(self.name.as_bytes());
                let message = format!("d ({d}) and Tr ({}) of {name} contradict each other: d is taken", 1.0 - other);
                reports.note(line, message);
                d
            }
            (Some(d), _) => d,
            (None, Some(other)) => other,
            (None, None) => 1.0,
        };
        if opacity <= 0.0 {
            let name = quote(self.name.as_bytes());
            reports.note(self.line, format!("the material {name} is invisible (d 0 or Tr 1)"));
        }
        opacity.clamp(0.0, 1.0)
    }
}
