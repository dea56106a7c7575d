//! Samplers, units and textures.

use super::super::data::{DrawRecord, FrameRecord, SamplerRecord, TextureRecord};
use super::super::snapshot::levels_read;
use super::{Issue, Rule};

/// Checks every sampler of a draw.
pub fn check(record: &FrameRecord, draw: &DrawRecord, issues: &mut Vec<Issue>) {
    for sampler in &draw.samplers {
        let sampler_use = SamplerUse { record, draw, sampler };
        // In this order: what comes later often follows from what comes before.
        let rules = [
            SamplerUse::texture_name,
            SamplerUse::never_set,
            SamplerUse::two_types,
            SamplerUse::feedback,
            SamplerUse::stale,
            SamplerUse::nothing_to_read,
            SamplerUse::incomplete,
        ];
        match rules.iter().find_map(|rule| rule(&sampler_use)) {
            Some(Outcome::Found(finding)) => issues.push(finding),
            Some(Outcome::FoundElsewhere) | None => {}
        }
    }
}

enum Outcome {
    Found(Issue),
    /// The finding of another sampler reports it.
    FoundElsewhere,
}

/// A sampler at a draw.
struct SamplerUse<'a> {
    record: &'a FrameRecord,
    draw: &'a DrawRecord,
    sampler: &'a SamplerRecord,
}

impl SamplerUse<'_> {
    fn declared(&self) -> String {
        format!("`{}` ({})", self.sampler.name, self.sampler.glsl_type)
    }

    fn named(&self, id: u32) -> String {
        match self.record.texture(id) {
            Some(texture) if !texture.name.is_empty() => format!("texture {id}, `{}`", texture.name),
            _ => format!("texture {id}"),
        }
    }

    /// Whether textures of this kind are what the sampler reads.
    fn reads(&self, texture: &TextureRecord) -> bool {
        kind_of(&self.sampler.glsl_type) == texture.kind
    }

    /// Textures of the sampler's kind, with their units, that no sampler of this draw reads.
    fn unread(&self) -> impl Iterator<Item = (u32, u32)> {
        let kind = kind_of(&self.sampler.glsl_type);
        let bound = self.draw.units.iter().filter(move |bound| bound.kind == kind);
        bound.filter_map(|bound| Some((bound.unit, bound.texture?))).filter(|(unit, texture)| {
            !self.draw.samplers.iter().any(|s| s.unit == *unit && s.texture == Some(*texture))
        })
    }

    fn texture_name(&self) -> Option<Outcome> {
        let units = self.record.texture_units;
        let rule = Rule::TextureNameAsUnit;
        let refused = self.sampler.sent.filter(|sent| u32::try_from(*sent).map_or(true, |sent| sent >= units));
        let value = match refused {
            Some(value) => i64::from(value),
            None if self.sampler.was_set && self.sampler.texture.is_none() => i64::from(self.sampler.unit),
            None => return None,
        };
        let texture = u32::try_from(value).ok().filter(|id| *id > 0).and_then(|id| self.record.texture(id));
        let texture = texture.filter(|texture| refused.is_some() || self.reads(texture));
        let read = |id| self.draw.samplers.iter().any(|sampler| sampler.texture == Some(id));
        let Some(texture) = texture.filter(|texture| !read(texture.id)) else {
            return refused.map(|_| {
                Outcome::Found(Issue::error(
                    rule,
                    format!("the sampler {} was set to {value}, but units go from 0 to {}", self.declared(), units - 1),
                    "set it to the unit that its texture is bound to",
                ))
            });
        };
        let home = self.draw.units.iter().find(|bound| bound.texture == Some(texture.id)).map(|bound| bound.unit);
        let what = match refused {
            Some(_) => format!("units go from 0 to {}", units - 1),
            None => format!("nothing is bound to unit {value}"),
        };
        Some(Outcome::Found(Issue::error(
            rule,
            format!(
                "the sampler {} was set to {value}, which is the name of {} and not a unit: {what}",
                self.declared(),
                self.named(texture.id)
            ),
            match home {
                Some(unit) => format!("set it to {unit}, the unit to which that texture is bound"),
                None => {
                    "bind the texture to a unit (glActiveTexture, glBindTexture) and set the sampler to that unit's \
                         number"
                        .to_owned()
                }
            },
        )))
    }

    fn never_set(&self) -> Option<Outcome> {
        // If it is not 0, the shader itself sets the unit.
        if self.sampler.was_set || self.sampler.unit != 0 {
            return None;
        }
        let declared = self.declared();
        let meant = self.unread().find(|(unit, _)| *unit != 0);
        let others = self.draw.samplers.iter().any(|s| s.name != self.sampler.name && s.unit == 0);
        Some(Outcome::Found(match (self.sampler.texture, meant) {
            (_, Some((unit, texture))) => Issue::error(
                Rule::SamplerNeverSet,
                format!(
                    "the sampler {declared} was never set and reads unit 0, while {} is bound to unit {unit}, which no \
                     sampler reads",
                    self.named(texture)
                ),
                format!("set it to {unit} (glUniform1i) after linking"),
            ),
            (None, None) => Issue::error(
                Rule::SamplerNeverSet,
                format!("the sampler {declared} was never set and reads unit 0, where no texture of its kind is bound"),
                "set it to the unit of its texture (glUniform1i) after linking",
            ),
            (Some(texture), None) if others => Issue::error(
                Rule::SamplerNeverSet,
                format!(
                    "the sampler {declared} was never set and reads unit 0, where another sampler reads {} too",
                    self.named(texture)
                ),
                "set it to the unit of its own texture (glUniform1i) after linking",
            ),
            (Some(texture), None) => Issue::warning(
                Rule::SamplerNeverSet,
                format!(
                    "the sampler {declared} was never set and reads unit 0 by default, where {} happens to be bound",
                    self.named(texture)
                ),
                "set it to 0 (glUniform1i) rather than rely on the default",
            ),
        }))
    }

    fn two_types(&self) -> Option<Outcome> {
        let me = self.sampler;
        let others = self.draw.samplers.iter();
        let other = others.filter(|s| s.was_set).find(|s| s.unit == me.unit && s.glsl_type != me.glsl_type)?;
        if other.name > me.name {
            return Some(Outcome::FoundElsewhere);
        }
        Some(Outcome::Found(Issue::error(
            Rule::TwoSamplerTypes,
            format!(
                "{} and `{}` ({}) both read unit {}: OpenGL does not draw if samplers of different types read the same unit",
                self.declared(),
                other.name,
                other.glsl_type,
                me.unit
            ),
            "give each its own unit",
        )))
    }

    fn feedback(&self) -> Option<Outcome> {
        let id = self.sampler.texture?;
        let pass = self.record.passes.get(self.draw.pass)?;
        let [first, last] = levels_read(self.record.texture(id)?, self.sampler.sampling.as_ref());
        let attached =
            pass.target.attachments.iter().find(|a| a.texture == Some(id) && (first..=last).contains(&a.level))?;
        Some(Outcome::Found(Issue::error(
            Rule::FeedbackLoop,
            format!(
                "{} reads {} in unit {} while the draw writes to it: it is attached as {} to `{}`",
                self.declared(),
                self.named(id),
                self.sampler.unit,
                attached.point,
                pass.target.name
            ),
            "draw into a different texture, and read this one in the next pass",
        )))
    }

    fn stale(&self) -> Option<Outcome> {
        let me = self.sampler;
        let id = me.texture?;
        if let Some(owner) = &me.bound_for {
            let subject = self.draw.subject.as_ref();
            // Two draws of one material share its textures.
            if subject.is_some_and(|subject| subject.material == owner.material) {
                return None;
            }
            return Some(Outcome::Found(Issue::error(
                Rule::StaleTexture,
                format!(
                    "{} reads unit {}, where {} is left over from `{owner}`: nothing was bound there for this draw",
                    self.declared(),
                    me.unit,
                    self.named(id)
                ),
                "bind the texture of this draw, or a white one, before drawing",
            )));
        }
        // Without names of what is drawn, only a texture that was bound and is not read shows the mistake.
        if self.draw.subject.is_some() || self.draw.bound.iter().any(|bound| bound.unit == me.unit) {
            return None;
        }
        let earlier = self.record.draws.get(..self.draw.index)?;
        let reads_it = |draw: &&DrawRecord| draw.samplers.iter().any(|s| s.unit == me.unit && s.texture == Some(id));
        let before = earlier.iter().rev().find(reads_it)?;
        let just_bound = |unit: u32, texture: u32| {
            self.draw.bound.iter().any(|bound| bound.unit == unit && bound.texture == Some(texture))
        };
        let (unit, texture) = self.unread().find(|(unit, texture)| just_bound(*unit, *texture))?;
        Some(Outcome::Found(Issue::error(
            Rule::StaleTexture,
            format!(
                "{} reads unit {}, where {} is left over from draw {}, while {} was bound to unit {unit}, which no \
                 sampler reads",
                self.declared(),
                me.unit,
                self.named(id),
                before.index,
                self.named(texture)
            ),
            format!("bind it to unit {} (glActiveTexture before glBindTexture), or set the sampler to {unit}", me.unit),
        )))
    }

    fn nothing_to_read(&self) -> Option<Outcome> {
        let me = self.sampler;
        if me.texture.is_some() {
            return None;
        }
        Some(Outcome::Found(match me.others.first() {
            Some(&other) => Issue::error(
                Rule::WrongTextureKind,
                format!(
                    "{} reads unit {}, where {} is bound, a texture of kind {}",
                    self.declared(),
                    me.unit,
                    self.named(other),
                    self.record.texture(other).map_or("another", |texture| texture.kind.as_str())
                ),
                "bind a texture of the sampler's kind, or declare a sampler of the texture's kind",
            ),
            None => Issue::error(
                Rule::UnboundUnit,
                format!("{} reads unit {}, where no texture is bound: it reads black", self.declared(), me.unit),
                "bind a texture to that unit (glActiveTexture, glBindTexture) before drawing",
            ),
        }))
    }

    fn incomplete(&self) -> Option<Outcome> {
        let why = self.sampler.incomplete.as_ref()?;
        let filter = self.sampler.sampling.as_ref().map_or("", |sampling| &sampling.min_filter);
        Some(Outcome::Found(Issue::error(
            Rule::IncompleteTexture,
            format!(
                "{} reads {} in unit {}, which is not complete for the filter `{filter}` ({why}): it reads black",
                self.declared(),
                self.named(self.sampler.texture?),
                self.sampler.unit
            ),
            "generate its mipmaps (glGenerateMipmap), or set a GL_TEXTURE_MIN_FILTER without mipmaps",
        )))
    }
}

/// The kind of texture that a sampler of a type reads, as [`TextureRecord::kind`] names it.
fn kind_of(glsl_type: &str) -> &'static str {
    let bare = glsl_type.trim_start_matches(['i', 'u']).trim_end_matches("Shadow");
    match bare {
        "samplerCube" => "cube",
        "sampler2DArray" => "2D array",
        "sampler3D" => "3D",
        "sampler2DMS" => "2D multisample",
        _ => "2D",
    }
}
