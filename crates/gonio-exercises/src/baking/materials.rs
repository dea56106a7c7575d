//! The materials of an answer: which picture they show, and by which path.

use super::answer::{AnswerMaterial, PathState, TextureReference};
use super::findings::{BakeFinding, BakeFindings, Candidate, Examination};
use gonio_language::tr;

impl Examination<'_> {
    /// Paths and materials, given the baked picture and the one that most of the surface shows.
    pub fn material_findings(&self, chosen: &Candidate, used: Option<usize>, findings: &mut BakeFindings) {
        let answer = self.answer;
        if let Some((name, line)) = &answer.lost_library {
            let place = Some((answer.name.clone(), *line, format!("mtllib {name}")));
            findings.mistakes.push(BakeFinding {
                detail: name.clone(),
                place,
                ..BakeFinding::new("material-library-missing")
            });
            return;
        }
        if !answer.has_materials {
            findings.mistakes.push(BakeFinding::new("material-library-missing"));
            return;
        }
        let mut is_used = vec![false; answer.materials.len()];
        for material in answer.material_of_triangles() {
            if let Some(used) = is_used.get_mut(material) {
                *used = true;
            }
        }
        let materials: Vec<_> =
            answer.materials.iter().zip(is_used).filter(|(_, used)| *used).map(|(m, _)| m).collect();
        let shows = |material: &AnswerMaterial| matches!(material.texture, TextureReference::Found(picture, _) if picture == chosen.picture);
        let others: Vec<_> = materials.iter().filter(|m| !shows(m)).collect();
        if let Some(first) = others.first() {
            let is_old = matches!(first.texture, TextureReference::Nothing | TextureReference::Given)
                || matches!(first.texture, TextureReference::Found(p, _) if answer.pictures[p].is_given);
            let names: Vec<&str> = others.iter().map(|m| m.name.as_str()).collect();
            let is_wrong_image = used.is_some_and(|used| used != chosen.picture) && !is_old;
            let (id, detail) = match (&first.texture, others.len() == materials.len()) {
                (TextureReference::Missing(PathState::Absolute), true) => ("texture-path-absolute", first.path.clone()),
                (TextureReference::Missing(_), true) => ("texture-path-broken", first.path.clone()),
                _ if is_wrong_image => {
                    ("wrong-image", tr!("check-baking-instead-of", path = first.path, chosen = self.name(chosen)))
                }
                (_, true) => ("old-textures-kept", String::new()),
                (_, false) => ("materials-left", names.join(", ")),
            };
            findings.mistakes.push(BakeFinding { detail, place: quoted(first), ..BakeFinding::new(id) });
        }
        let paths = materials.iter().filter(|m| shows(m));
        let states = paths.filter_map(|m| match m.texture {
            TextureReference::Found(_, state) => Some((*m, state)),
            _ => None,
        });
        if let Some((material, state)) = states.max_by_key(|(_, state)| *state as u8) {
            let id = match state {
                PathState::Right => None,
                PathState::OtherCase => {
                    let warning = tr!("check-baking-and-the-file-s-name-differ", path = material.path);
                    findings.warnings.push(warning);
                    None
                }
                PathState::Absolute => Some("texture-path-absolute"),
                PathState::Elsewhere => Some("texture-path-broken"),
            };
            let found =
                |id| BakeFinding { detail: material.path.clone(), place: quoted(material), ..BakeFinding::new(id) };
            findings.mistakes.extend(id.map(found));
        }
        if let Some(material) = materials.iter().find(|m| shows(m) && m.factor.iter().any(|f| (f - 1.0).abs() > 0.01)) {
            let [r, g, b] = material.factor;
            if r.max(g).max(b) - r.min(g).min(b) > 0.02 {
                let detail = format!("{}: {r:.2} {g:.2} {b:.2}", material.name);
                findings
                    .mistakes
                    .push(BakeFinding { place: quoted(material), ..BakeFinding::of("color-factor-left", detail) });
            } else {
                findings.warnings.push(tr!(
                    "check-baking-material-has-a-factor-of-beside",
                    name = material.name,
                    factor = format!("{r:.2}")
                ));
            }
        }
    }

    fn name(&self, candidate: &Candidate) -> &str {
        &self.answer.pictures[candidate.picture].name
    }
}

/// The line that names a material's texture.
pub fn quoted(material: &AnswerMaterial) -> Option<(String, u32, String)> {
    let (file, line) = material.place.clone()?;
    Some((file, line, format!("map_Kd {}", material.path)))
}
