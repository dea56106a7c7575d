//! Everything that is found in an answer.

use super::answer::{Answer, TextureReference};
use super::colors::{ColorFinding, PartColors};
use super::expected::Expected;
use super::layout::UvLayout;
use super::light::{self, OtherContent};
use super::matching::{Counterpart, Matching};
use super::materials::quoted;
use super::original::Original;
use super::picture::{SquarePicture, Tone, Turn};
use super::seams::Seams;
use gonio_language::tr;
use std::collections::BTreeMap;

/// The share of covered texels from which an overlap, or a chart outside, is a mistake rather than rounding.
const OVERLAP: f64 = 0.002;
/// The share of a part's area from which it is missing.
const MISSING: f64 = 0.02;
/// The share of a lookup at a border that may be background, or another chart.
const SEAM: f64 = 0.05;
/// The share of the surface whose colour may be lost between texels.
const BLURRED: f64 = 0.12;
/// The area of all triangles in the texture from which they overlap beyond doubt.
const LARGEST_AREA: f64 = 2.5;
/// Pictures of at least this size are large enough for every exercise.
const LARGE_ENOUGH: u32 = 512;

/// A mistake with its evidence.
#[derive(Clone, Debug, PartialEq)]
pub struct BakeFinding {
    /// The mistake's id in the catalogue.
    pub id: &'static str,
    /// The share of the difference that it explains.
    pub share: f64,
    /// What in this answer shows it; may be empty.
    pub detail: String,
    /// The file, its line and the text there.
    pub place: Option<(String, u32, String)>,
}

impl BakeFinding {
    /// A mistake without details.
    pub fn new(id: &'static str) -> Self {
        BakeFinding { id, share: 1.0, detail: String::new(), place: None }
    }

    /// A mistake with a detail.
    pub fn of(id: &'static str, detail: impl Into<String>) -> Self {
        BakeFinding { detail: detail.into(), ..BakeFinding::new(id) }
    }
}

/// The findings about one answer.
#[derive(Default)]
pub struct BakeFindings {
    /// The mistakes, the most significant first.
    pub mistakes: Vec<BakeFinding>,
    /// Oddities that are right.
    pub warnings: Vec<String>,
    /// The parts of the original: name, colours.
    pub parts: Vec<(String, PartColors)>,
    /// Why the answer cannot be judged.
    pub unjudged: Option<String>,
    /// Whether colours are wrong that no mistake explains.
    pub is_unexplained: bool,
}

/// Examines an answer.
pub fn examine(answer: &Answer, original: &Original) -> BakeFindings {
    let mut findings = BakeFindings::default();
    let Some(matching) = Matching::new(&original.surface.mesh, &answer.mesh) else {
        let triangles = answer.mesh.triangle_count();
        findings.mistakes.push(BakeFinding::of(
            "wrong-model",
            tr!("check-baking-has-triangles", name = answer.name, triangles = triangles),
        ));
        return findings;
    };
    findings.model(answer, &matching, original);
    let layout = UvLayout::new(answer, &matching, original);
    let Some(layout) = layout.filter(|layout| layout.collapsed_share(answer) < 0.5) else {
        findings.mistakes.push(BakeFinding::new("no-tex-coords"));
        return findings;
    };
    let examination = Examination { answer, matching: &matching, original, layout: &layout };
    examination.run(&mut findings);
    findings
}

impl BakeFindings {
    /// Geometry and normals.
    fn model(&mut self, answer: &Answer, matching: &Matching, original: &Original) {
        let mesh = &original.surface.mesh;
        let area = |t: usize| {
            let [a, b, c] = mesh.triangle_positions(t).map(|p| p.as_dvec3());
            (b - a).cross(c - a).length()
        };
        let mut lost = vec![0.0; mesh.parts.len()];
        matching.missing.iter().for_each(|&t| lost[original.surface.part(t)] += area(t));
        let whole = |part: usize| {
            let part = &mesh.parts[part];
            (part.first_triangle..part.first_triangle + part.triangle_count).map(area).sum::<f64>()
        };
        let missing = (0..mesh.parts.len()).filter(|&part| lost[part] > MISSING * whole(part));
        let names: Vec<&str> = missing.map(|part| original.part_name(part)).collect();
        if !names.is_empty() {
            self.mistakes.push(BakeFinding::of("parts-missing", names.join(", ")));
        }
        let extra = matching.counterparts.iter().filter(|found| **found == Counterpart::Nothing).count();
        if 100 * extra > answer.mesh.triangle_count() {
            self.warnings.push(tr!("check-baking-triangles-of-are-not-in-the", extra = extra, name = answer.name));
        }
        let placement = &matching.placement;
        if placement.is_mirrored() {
            self.mistakes.push(BakeFinding::new("model-mirrored"));
        } else if !placement.has_same_axes() {
            self.mistakes.push(BakeFinding::new("axes-turned"));
        }
        if (placement.scale - 1.0).abs() > 1e-3 {
            self.warnings
                .push(tr!("check-baking-the-model-is-times-as-large", scale = format!("{:.4}", 1.0 / placement.scale)));
        }
        if placement.offset.length() > 1e-2 * matching.diagonal {
            self.warnings.push(tr!("check-baking-the-model-is-in-another-place").to_owned());
        }
        if answer.mesh.normals.is_empty() {
            self.mistakes.push(BakeFinding::new("normals-missing"));
        }
    }
}

/// An answer with everything that is known about its places.
pub struct Examination<'a> {
    pub answer: &'a Answer,
    pub matching: &'a Matching,
    pub original: &'a Original,
    pub layout: &'a UvLayout,
}

/// A picture with what is known about its colours.
pub struct Candidate {
    /// Its index.
    pub picture: usize,
    /// The side at which it is compared.
    pub side: u32,
    /// Its colours.
    pub colors: ColorFinding,
}

impl Examination<'_> {
    fn run(&self, findings: &mut BakeFindings) {
        let kept = self.layout.kept_parts(self.answer, self.matching, self.original);
        let parts = self.original.surface.mesh.parts.len();
        let pictures: Vec<usize> =
            (0..self.answer.pictures.len()).filter(|&p| !self.answer.pictures[p].is_given).collect();
        let is_all_kept = 10 * kept.len() >= 9 * parts;
        if pictures.is_empty() {
            self.without_picture(is_all_kept, findings);
            return;
        }
        let area = self.layout.area();
        if area > LARGEST_AREA {
            // Baking all of them would take long, and most of the texels could not be judged.
            findings.mistakes.push(match kept.is_empty() {
                true => BakeFinding::of(
                    "charts-overlap",
                    tr!("check-baking-their-area-is-times-that-of", area = format!("{area:.1}")),
                ),
                false => self.kept_coordinates(&kept, is_all_kept),
            });
            return;
        }
        let used = self.used_picture();
        let missing = || self.answer.materials.iter().any(|m| matches!(m.texture, TextureReference::Missing(_)));
        let mut expected: BTreeMap<u32, Expected> = BTreeMap::new();
        let mut candidates = Vec::new();
        let used_first = pictures.iter().copied().filter(|p| Some(*p) == used);
        let order = used_first.chain(pictures.iter().copied().filter(|p| Some(*p) != used));
        for picture in order {
            let candidate = self.candidate(picture, &mut expected);
            let is_right = candidate.colors.is_right();
            candidates.push(candidate);
            if is_right {
                break;
            }
        }
        let mistakes =
            |c: &Candidate| usize::from(c.colors.turn != Turn::default()) + usize::from(c.colors.tone != Tone::Plain);
        let unbaked = |c: &Candidate| c.colors.parts.iter().filter(|part| part.is_unbaked()).count();
        let explained = candidates.iter().enumerate().filter(|(_, c)| c.colors.is_explained);
        let best = explained.min_by_key(|(order, c)| (mistakes(c), unbaked(c), *order)).map(|(order, _)| order);
        // Without an explanation the picture that the model shows counts.
        let Some(chosen) = candidates.get(best.unwrap_or(0)) else { return };
        let Some(right) = expected.get(&chosen.side) else { return };
        self.layout_findings(right, &kept, is_all_kept, findings);
        let is_judged = right.judged.len() * 20 >= right.covered && !right.judged.is_empty();
        let mut of_colors = BakeFindings::default();
        if is_judged {
            self.color_findings(chosen, right, &mut of_colors);
        }
        if used.is_none() && of_colors.is_unexplained && missing() {
            // Nothing shows that this picture is the baked one.
            self.without_picture(is_all_kept, findings);
            return;
        }
        self.material_findings(chosen, used, findings);
        findings.parts = (chosen.colors.parts.iter().enumerate())
            .map(|(part, colors)| (self.original.part_name(part).to_owned(), *colors))
            .collect();
        findings.mistakes.append(&mut of_colors.mistakes);
        findings.warnings.append(&mut of_colors.warnings);
        findings.is_unexplained = of_colors.is_unexplained;
    }

    /// The picture that most of the surface shows.
    fn used_picture(&self) -> Option<usize> {
        let mut areas: BTreeMap<usize, usize> = BTreeMap::new();
        for material in self.answer.material_of_triangles() {
            if let Some(TextureReference::Found(picture, _)) = self.answer.materials.get(material).map(|m| &m.texture) {
                *areas.entry(*picture).or_default() += 1;
            }
        }
        let is_own = |picture: usize| !self.answer.pictures[picture].is_given;
        areas.into_iter().max_by_key(|(picture, count)| (is_own(*picture), *count)).map(|(picture, _)| picture)
    }

    fn candidate(&self, picture: usize, expected: &mut BTreeMap<u32, Expected>) -> Candidate {
        let own = &self.answer.pictures[picture];
        let side = SquarePicture::side_for(&own.texture);
        let right = expected
            .entry(side)
            .or_insert_with(|| Expected::new(self.answer, self.layout, self.matching, self.original, side));
        let square = SquarePicture::new(&own.texture, side, own.is_lossy);
        let colors = ColorFinding::find(right, &square, self.original.surface.mesh.parts.len());
        Candidate { picture, side, colors }
    }

    /// Findings about an answer without a picture of its own.
    fn without_picture(&self, is_all_kept: bool, findings: &mut BakeFindings) {
        if let Some(reason) = self.answer.unreadable.first() {
            findings.unjudged = Some(reason.clone());
            return;
        }
        let missing = self.answer.materials.iter().find(|m| matches!(m.texture, TextureReference::Missing(_)));
        findings.mistakes.push(match missing {
            Some(material) => BakeFinding {
                detail: material.path.clone(),
                place: quoted(material),
                ..BakeFinding::new("picture-missing")
            },
            None if is_all_kept => BakeFinding::new("nothing-baked"),
            None => BakeFinding::new("picture-missing"),
        });
    }

    fn layout_findings(&self, right: &Expected, kept: &[u16], is_all_kept: bool, findings: &mut BakeFindings) {
        let covered = right.covered.max(1) as f64;
        let conflicts = right.conflicts as f64 / covered;
        let is_conflict = conflicts > OVERLAP;
        if !kept.is_empty() && is_conflict {
            findings.mistakes.push(self.kept_coordinates(kept, is_all_kept));
        } else if is_conflict {
            let both = right.conflicting.map(|pair| pair.map(|t| self.layout.part[t as usize]));
            let both: Vec<u16> = both.into_iter().flatten().flatten().collect();
            let detail = tr!(
                "check-baking-of-the-texels",
                conflicts = format!("{:.1}", 100.0 * conflicts),
                both = self.names(&both)
            );
            findings.mistakes.push(BakeFinding::of("charts-overlap", detail));
        } else if right.overlaps as f64 / covered > OVERLAP {
            findings.warnings.push(tr!("check-baking-charts-overlap-but-only-where-they").to_owned());
        }
        let outside = self.share_outside();
        if outside > OVERLAP {
            findings.mistakes.push(BakeFinding::of(
                "charts-outside",
                tr!("check-baking-of-them", outside = format!("{:.1}", 100.0 * outside)),
            ));
        }
    }

    /// The names of parts of the original.
    fn names(&self, parts: &[u16]) -> String {
        let names: Vec<&str> = parts.iter().map(|&part| self.original.part_name(part.into())).collect();
        names.join(", ")
    }

    fn kept_coordinates(&self, kept: &[u16], is_all_kept: bool) -> BakeFinding {
        let detail = if is_all_kept { String::new() } else { self.names(kept) };
        BakeFinding::of("old-tex-coords-kept", detail)
    }

    /// The share of the charts' area that is outside of the unit square and was not moved into it.
    fn share_outside(&self) -> f64 {
        let (mut outside, mut whole) = (0.0, 0.0);
        for (t, is_outside) in self.layout.is_outside.iter().enumerate() {
            let corners = self.layout.corners(t).map(|uv| glam::DVec2::from(uv.map(f64::from)));
            let area = (corners[1] - corners[0]).perp_dot(corners[2] - corners[0]).abs();
            whole += area;
            if *is_outside {
                // By samples: a triangle may be partly inside.
                let points = [[0.6, 0.2, 0.2], [0.2, 0.6, 0.2], [0.2, 0.2, 0.6], [0.34, 0.33, 0.33]];
                let is_beyond = |w: &&[f64; 3]| {
                    let p = corners[0] * w[0] + corners[1] * w[1] + corners[2] * w[2];
                    p.min_element() < 0.0 || p.max_element() > 1.0
                };
                outside += area * points.iter().filter(is_beyond).count() as f64 / 4.0;
            }
        }
        if whole > 0.0 { outside / whole } else { 0.0 }
    }

    fn color_findings(&self, chosen: &Candidate, right: &Expected, findings: &mut BakeFindings) {
        let colors = &chosen.colors;
        let own = &self.answer.pictures[chosen.picture];
        let square = || SquarePicture::new(&own.texture, chosen.side, own.is_lossy);
        let mut turn = colors.turn;
        if !colors.is_explained {
            let emitted = || {
                let quantity = |sample: &gonio_bake::texels::TexelSample| self.original.emitted(sample);
                Expected::of_quantity(self.answer, self.layout, self.matching, self.original, chosen.side, &quantity)
            };
            match light::find(right, &square(), &emitted) {
                Some((content, turned)) => {
                    turn = turned;
                    findings.mistakes.extend(turn_id(turned).map(BakeFinding::new));
                    findings.mistakes.push(BakeFinding::of(content_id(content), own.name.clone()));
                }
                None => findings.is_unexplained = true,
            }
        } else {
            findings.mistakes.extend(turn_id(turn).map(BakeFinding::new));
            findings.mistakes.extend(match colors.tone {
                Tone::Plain => None,
                Tone::Decoded => Some(BakeFinding::new("srgb-applied-twice")),
                Tone::Encoded => Some(BakeFinding::new("srgb-not-applied")),
            });
            let unbaked = colors.parts.iter().enumerate().filter(|(_, part)| part.is_unbaked());
            let names: Vec<&str> = unbaked.map(|(part, _)| self.original.part_name(part)).collect();
            if !names.is_empty() {
                findings.mistakes.push(BakeFinding::of("parts-not-baked", names.join(", ")));
            }
            let is_left = |part: &PartColors| !part.is_right() && !part.is_unbaked();
            let reaches_out = self.share_outside() > OVERLAP;
            if colors.parts.iter().any(is_left) && !reaches_out {
                match self.wrong_outside(colors, right, &square()) {
                    true => findings.mistakes.push(BakeFinding::new("charts-outside")),
                    false => findings.is_unexplained = true,
                }
            }
            if self.layout.is_outside.contains(&true)
                && !reaches_out
                && !findings.mistakes.iter().any(|m| m.id == "charts-outside")
            {
                findings.warnings.push(tr!("check-baking-some-texture-coordinates-are-outside-of").to_owned());
            }
        }
        let is_empty = findings.mistakes.iter().any(|m| m.id == "picture-empty");
        let is_conflicting = right.conflicts as f64 > OVERLAP * right.covered as f64;
        // Where colours are unknown, a shadow cannot be told from the background.
        if !is_empty && colors.is_explained && !is_conflicting {
            self.seam_findings(chosen, right, turn, findings);
            self.size_findings(own, right, findings);
        }
        self.alpha_warning(own, right, findings);
    }

    /// Whether the wrong texels are those of charts outside of the unit square.
    fn wrong_outside(&self, colors: &ColorFinding, right: &Expected, square: &SquarePicture) -> bool {
        let undone = super::colors::Undone { picture: square, turn: colors.turn, tone: colors.tone };
        let texels = |outside: bool| {
            let is = |texel: &&super::expected::JudgedTexel| {
                self.layout.is_outside[right.triangle[texel.index as usize] as usize] == outside
            };
            let some: Vec<_> = right.judged.iter().filter(is).copied().collect();
            let parts = undone.parts(right, &some, colors.parts.len(), [0.0; 3]);
            let (all, good) = parts.iter().fold((0, 0), |(a, g), part| (a + part.texels, g + part.right));
            (all, if all == 0 { 1.0 } else { good as f64 / all as f64 })
        };
        let ((outside, share), (_, inside)) = (texels(true), texels(false));
        outside > 0 && share < 0.85 && inside > 0.95
    }

    fn seam_findings(&self, chosen: &Candidate, right: &Expected, turn: Turn, findings: &mut BakeFindings) {
        let texture = &self.answer.pictures[chosen.picture].texture;
        let unbaked: Vec<bool> = chosen.colors.parts.iter().map(PartColors::is_unbaked).collect();
        let is_judged = |t: u32| {
            let part = self.layout.part[t as usize];
            part.is_some_and(|part| !unbaked[usize::from(part)]) && !self.layout.is_outside[t as usize]
        };
        let seams = Seams::measure(self.answer, self.layout, right, texture, turn, &is_judged);
        let percent = |share: f64| tr!("check-baking-of-a-lookup-at-a-border", share = format!("{:.0}", 100.0 * share));
        if seams.other_chart > SEAM {
            findings.mistakes.push(BakeFinding::of("charts-too-close", percent(seams.other_chart)));
        }
        if seams.background > SEAM {
            findings.mistakes.push(BakeFinding::of("margin-missing", percent(seams.background)));
        } else if seams.background_of_quarter > SEAM {
            findings.mistakes.push(BakeFinding::of("margin-too-small", percent(seams.background_of_quarter)));
        }
    }

    /// The colours that a picture of this size cannot hold.
    fn size_findings(&self, own: &super::answer::AnswerPicture, right: &Expected, findings: &mut BakeFindings) {
        let (width, height) = (own.texture.width, own.texture.height);
        if width.min(height) >= LARGE_ENOUGH {
            return;
        }
        let fine = Expected::new(self.answer, self.layout, self.matching, self.original, 1024);
        let coarse = SquarePicture { side: right.side, colors: right.filled.clone(), is_lossy: false };
        let step = fine.judged.len().div_ceil(20_000).max(1);
        let (mut lost, mut all) = (0_usize, 0_usize);
        for texel in fine.judged.iter().step_by(step) {
            let index = texel.index as usize;
            let (x, y) = (index % 1024, index / 1024);
            let nearest = coarse.nearest(x as f64 / 1024.0, y as f64 / 1024.0, width.min(height));
            all += 1;
            lost += usize::from(super::expected::difference(nearest, fine.filled[index]) > 0.1);
        }
        let share = lost as f64 / all.max(1) as f64;
        if share > BLURRED {
            let detail = tr!(
                "check-baking-x-texels-of-the-surface-has",
                width = width,
                height = height,
                share = format!("{:.0}", 100.0 * share)
            );
            findings.mistakes.push(BakeFinding::of("picture-too-small", detail));
        } else {
            findings.warnings.push(tr!("check-baking-x-texels-are-few-details-are", width = width, height = height));
        }
    }

    fn alpha_warning(&self, own: &super::answer::AnswerPicture, right: &Expected, findings: &mut BakeFindings) {
        let texture = &own.texture;
        let is_clear = |texel: &super::expected::JudgedTexel| {
            let (side, index) = (right.side, texel.index);
            let x = u64::from(index % side) * u64::from(texture.width) / u64::from(side);
            let y = u64::from(index / side) * u64::from(texture.height) / u64::from(side);
            let row = u64::from(texture.height) - 1 - y;
            texture.rgba.get(4 * (row * u64::from(texture.width) + x) as usize + 3).is_some_and(|a| *a < 128)
        };
        let clear = right.judged.iter().filter(|texel| is_clear(texel)).count();
        if clear * 50 > right.judged.len() {
            findings.warnings.push(tr!("check-baking-is-transparent-on-the-surface-programs", name = own.name));
        }
    }
}

fn turn_id(turn: Turn) -> Option<&'static str> {
    match (turn.transposed, turn.flip_u, turn.flip_v) {
        (false, false, false) => None,
        (false, false, true) => Some("v-flipped"),
        (false, true, false) => Some("u-flipped"),
        _ => Some("picture-turned"),
    }
}

fn content_id(content: OtherContent) -> &'static str {
    match content {
        OtherContent::Lit => "light-baked",
        OtherContent::Highlights => "highlights-baked",
        OtherContent::Curve => "tone-curve-applied",
        OtherContent::OneColor => "picture-empty",
        OtherContent::Grey | OtherContent::Normals | OtherContent::Emission => "other-map-baked",
    }
}
