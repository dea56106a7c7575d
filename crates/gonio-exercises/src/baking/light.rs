//! A picture that no simple mistake explains: the right one times light, or after a curve, or another quantity.

use super::expected::{Encoded, Expected, JudgedTexel, difference};
use super::picture::{SquarePicture, Turn};
use glam::DVec3;
use gonio_light::color::srgb_decode;

/// The share of texels that an explanation has to explain.
const EXPLAINED: f64 = 0.9;
/// Texels are coloured if their channels differ by this share of the largest.
const COLORED: f64 = 0.25;
/// A colour is that of the surface up to brightness if it differs by less than this share.
const SAME_HUE: f64 = 0.12;
/// Light varies by at least this share of its mean; a constant factor is a curve.
const VARIES: f64 = 0.1;
/// Most texels that are looked at.
const TRIED: usize = 20_000;

/// What such a picture shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OtherContent {
    /// The diffuse colour times light.
    Lit,
    /// The same with highlights.
    Highlights,
    /// The diffuse colour after a curve, or after a view transform, which mixes the channels too.
    Curve,
    /// One colour everywhere.
    OneColor,
    /// No colour: shadows, occlusion, roughness.
    Grey,
    /// Directions: a normal map.
    Normals,
    /// Light that surfaces emit.
    Emission,
}

/// A texel of the picture and the right colour, linear.
struct Pair {
    seen: DVec3,
    right: DVec3,
    stored: Encoded,
}

/// Finds what the picture shows; `None` if nothing explains it. `emitted` is the right picture of the emitted light.
pub fn find(
    expected: &Expected,
    picture: &SquarePicture,
    emitted: &dyn Fn() -> Expected,
) -> Option<(OtherContent, Turn)> {
    let step = expected.judged.len().div_ceil(TRIED).max(1);
    let some: Vec<JudgedTexel> = expected.judged.iter().step_by(step).copied().collect();
    let content = uniform(&some, picture);
    // Little of a scene glows, so its emitted light is almost one colour.
    let emitted = matches!(content, None | Some(OtherContent::OneColor)).then(emitted);
    let glows = |turn: &Turn| emitted.as_ref().is_some_and(|emitted| is_emission(emitted, &some, picture, *turn));
    if let Some(turn) = Turn::all().find(glows) {
        return Some((OtherContent::Emission, turn));
    }
    if let Some(content) = content {
        return Some((content, Turn::default()));
    }
    for turn in Turn::all() {
        let pairs: Vec<Pair> = some.iter().map(|texel| pair(expected, picture, turn, *texel)).collect();
        if is_curve(&pairs) || is_view_transform(&pairs) {
            return Some((OtherContent::Curve, turn));
        }
        if let Some(content) = light(&pairs) {
            return Some((content, turn));
        }
    }
    None
}

fn pair(expected: &Expected, picture: &SquarePicture, turn: Turn, texel: JudgedTexel) -> Pair {
    let index = texel.index as usize;
    let stored = picture.colors[turn.source(index, picture.side as usize)];
    let linear = |color: Encoded| DVec3::from(color.map(|c| srgb_decode(f64::from(c))));
    Pair { seen: linear(stored), right: linear(expected.filled[index]), stored }
}

fn share(count: usize, all: usize) -> f64 {
    if all == 0 { 0.0 } else { count as f64 / all as f64 }
}

/// A picture that looks the same however it is turned.
fn uniform(some: &[JudgedTexel], picture: &SquarePicture) -> Option<OtherContent> {
    let colors = || some.iter().map(|texel| picture.colors[texel.index as usize]);
    let count = |test: &dyn Fn(Encoded) -> bool| share(colors().filter(|color| test(*color)).count(), some.len());
    let frequent = super::colors::most_frequent(colors())?;
    let is_normal = |[r, g, b]: Encoded| {
        let [x, y, z] = [r, g, b].map(|c| 2.0 * c - 1.0);
        ((x * x + y * y + z * z).sqrt() - 1.0).abs() < 0.06
    };
    if count(&is_normal) >= 0.95 {
        return Some(OtherContent::Normals);
    }
    if count(&|color| difference(color, frequent) < 0.04) >= 0.98 {
        return Some(OtherContent::OneColor);
    }
    let is_grey = |[r, g, b]: Encoded| r.max(g).max(b) - r.min(g).min(b) < 0.03;
    (count(&is_grey) >= 0.98).then_some(OtherContent::Grey)
}

fn is_emission(emitted: &Expected, some: &[JudgedTexel], picture: &SquarePicture, turn: Turn) -> bool {
    let right = |texel: &JudgedTexel| {
        let index = texel.index as usize;
        let stored = picture.colors[turn.source(index, picture.side as usize)];
        difference(stored, emitted.filled[index]) < 0.04
    };
    let glows = |texel: &&JudgedTexel| difference(emitted.filled[texel.index as usize], [0.0; 3]) > 0.1;
    let glowing: Vec<&JudgedTexel> = some.iter().filter(glows).collect();
    let shown = glowing.iter().filter(|texel| right(texel)).count();
    share(some.iter().filter(|texel| right(texel)).count(), some.len()) >= 0.95
        && share(shown, glowing.len()) >= EXPLAINED
}

/// Whether one curve for all channels takes the right colours to these: channels with the same right value have the same value
/// in the picture.
fn is_curve(pairs: &[Pair]) -> bool {
    const BINS: usize = 48;
    let bin = |value: f64| ((value.clamp(0.0, 1.0).sqrt() * BINS as f64) as usize).min(BINS - 1);
    let mut bins: Vec<Vec<(f64, f64)>> = vec![Vec::new(); BINS];
    for Pair { seen, right, .. } in pairs {
        for k in 0..3 {
            bins[bin(right[k])].push((right[k], seen[k].sqrt()));
        }
    }
    let filled: Vec<&Vec<(f64, f64)>> = bins.iter().filter(|bin| bin.len() > 20).collect();
    // A curve through few values explains anything.
    if filled.len() < 8 {
        return false;
    }
    let (mut near, mut all) = (0, 0);
    let mut medians = Vec::new();
    for bin in filled {
        let mut values: Vec<f64> = bin.iter().map(|(_, seen)| *seen).collect();
        values.sort_unstable_by(f64::total_cmp);
        let median = values[values.len() / 2];
        near += values.iter().filter(|value| (**value - median).abs() < 0.05).count();
        all += values.len();
        medians.push(median);
    }
    let rises = medians.windows(2).all(|pair| pair[1] > pair[0] - 0.03);
    let spread = medians.iter().copied().fold(f64::MIN, f64::max) - medians.iter().copied().fold(f64::MAX, f64::min);
    share(near, all) >= EXPLAINED && rises && spread > 0.2
}

/// Whether the picture's colours are a function of the right ones that keeps their order of brightness, as after Filmic or AgX: light
/// would differ between places of one colour.
fn is_view_transform(pairs: &[Pair]) -> bool {
    const STEPS: f64 = 24.0;
    let mut groups: std::collections::BTreeMap<[i32; 3], Vec<&Pair>> = std::collections::BTreeMap::new();
    for pair in pairs {
        let key = pair.right.to_array().map(|c| (c.max(0.0).sqrt() * STEPS).round() as i32);
        groups.entry(key).or_default().push(pair);
    }
    let groups: Vec<Vec<&Pair>> = groups.into_values().filter(|group| group.len() > 20).collect();
    let (mut near, mut all, mut middles) = (0, 0, Vec::new());
    for group in &groups {
        let median = |value: &dyn Fn(&Pair) -> f64| {
            let mut values: Vec<f64> = group.iter().map(|pair| value(pair)).collect();
            values.sort_unstable_by(f64::total_cmp);
            values[values.len() / 2]
        };
        let middle = [0, 1, 2].map(|k| median(&|pair| f64::from(pair.stored[k])) as f32);
        let same = group.iter().filter(|pair| difference(pair.stored, middle) < 0.05).count();
        // The shading of a large object of one colour.
        if 50 * group.len() > pairs.len() && share(same, group.len()) < EXPLAINED {
            return false;
        }
        (near, all) = (near + same, all + group.len());
        middles.push((median(&|pair| pair.right.element_sum()), median(&|pair| pair.seen.element_sum())));
    }
    let distinct = |a: &(f64, f64), b: &(f64, f64)| (a.0 - b.0).abs() > 0.1;
    let ordered = |a: &(f64, f64), b: &(f64, f64)| (a.0 - b.0) * (a.1 - b.1) > 0.0;
    let (mut kept, mut compared) = (0, 0);
    for (i, a) in middles.iter().enumerate() {
        for b in middles[..i].iter().filter(|b| distinct(a, b)) {
            compared += 1;
            kept += usize::from(ordered(a, b));
        }
    }
    groups.len() >= 8
        && share(near, all) >= 0.95
        && share(all, pairs.len()) >= 0.5
        && share(kept, compared) >= EXPLAINED
}

/// Whether each colour is the right one times a brightness, or that plus white.
fn light(pairs: &[Pair]) -> Option<OtherContent> {
    let chroma = |color: DVec3| (color.max_element() - color.min_element()) / color.max_element().max(1e-6);
    let is_clipped = |pair: &Pair| pair.stored.iter().any(|c| *c > 0.995);
    // In the dark no colour can be told.
    let is_seen = |pair: &&Pair| pair.seen.max_element() > 0.01 && !is_clipped(pair);
    let colored: Vec<&Pair> = pairs.iter().filter(|pair| chroma(pair.right) > COLORED).collect();
    let seen: Vec<&Pair> = colored.iter().copied().filter(is_seen).collect();
    if seen.len() < 200 || share(seen.len(), colored.len()) < 0.1 || hues(&seen) < 3 {
        return None;
    }
    // Highlights are bright and white.
    let brightness = |pair: &Pair| pair.seen.element_sum() / pair.right.element_sum().max(1e-6);
    let mut from_dark = seen.clone();
    from_dark.sort_by(|a, b| brightness(a).total_cmp(&brightness(b)));
    from_dark.truncate(seen.len() / 2);
    let tint = tint(&from_dark);
    let mut factors = Vec::with_capacity(seen.len());
    let (mut lit, mut highlit) = (0, 0);
    for Pair { seen, right, .. } in seen.iter().copied() {
        let seen = *seen / tint;
        let factor = seen.dot(*right) / right.length_squared();
        let is_lit = (seen - factor * *right).length() < SAME_HUE * seen.length();
        lit += usize::from(is_lit);
        highlit += usize::from(is_lit || fits_with_white(seen, *right));
        factors.push(factor);
    }
    let mean = factors.iter().sum::<f64>() / factors.len() as f64;
    let deviation = (factors.iter().map(|f| (f - mean).powi(2)).sum::<f64>() / factors.len() as f64).sqrt();
    if deviation < VARIES * mean {
        return None;
    }
    if share(lit, seen.len()) >= EXPLAINED {
        return Some(OtherContent::Lit);
    }
    (share(highlit, seen.len()) >= EXPLAINED && share(lit, seen.len()) >= 0.2).then_some(OtherContent::Highlights)
}

/// The number of different hues.
fn hues(pairs: &[&Pair]) -> usize {
    let hue = |color: DVec3| (color / color.max_element().max(1e-6) * 4.0).round().as_ivec3().to_array();
    let mut hues: Vec<[i32; 3]> = pairs.iter().map(|pair| hue(pair.right)).collect();
    hues.sort_unstable();
    hues.chunk_by(|a, b| a == b).filter(|same| 100 * same.len() > pairs.len()).count()
}

/// The colour of the light, as far as it is the same everywhere: the median ratio of each channel.
fn tint(pairs: &[&Pair]) -> DVec3 {
    let ratio = |k: usize| {
        let brightness = |pair: &Pair| pair.seen.element_sum() / pair.right.element_sum().max(1e-6);
        let known = pairs.iter().filter(|pair| pair.right[k] > 0.02);
        let mut ratios: Vec<f64> =
            known.map(|pair| pair.seen[k] / pair.right[k] / brightness(pair).max(1e-9)).collect();
        ratios.sort_unstable_by(f64::total_cmp);
        ratios.get(ratios.len() / 2).copied().unwrap_or(1.0)
    };
    DVec3::new(ratio(0), ratio(1), ratio(2)).clamp(DVec3::splat(0.25), DVec3::splat(4.0))
}

/// Whether a colour is a mixture of the right one and white, neither of them negative.
fn fits_with_white(seen: DVec3, right: DVec3) -> bool {
    let white = DVec3::ONE;
    let (a, b, c) = (right.length_squared(), right.dot(white), white.length_squared());
    let determinant = a * c - b * b;
    if determinant < 1e-9 {
        return false;
    }
    let factor = (seen.dot(right) * c - seen.dot(white) * b) / determinant;
    let highlight = (seen.dot(white) * a - seen.dot(right) * b) / determinant;
    factor > -0.02 && highlight > -0.02 && (seen - factor * right - highlight * white).length() < 0.06 * seen.length()
}
