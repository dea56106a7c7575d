//! Completeness of textures.

use super::data::{SamplingRecord, TextureRecord};

/// Returns the first and the last level that are read.
pub fn levels_read(texture: &TextureRecord, sampling: Option<&SamplingRecord>) -> [u32; 2] {
    // A multisampled texture has one.
    let Some(sampling) = sampling else { return [0, 0] };
    let base = sampling.base_level;
    if !sampling.min_filter.contains("mipmap") {
        return [base, base];
    }
    let largest = texture.levels.iter().find(|level| level.level == base);
    let side = largest.map_or(1, |level| level.width.max(level.height)).max(1);
    [base, sampling.max_level.min(base + side.ilog2())]
}

/// Explains why a texture is incomplete, in which case it reads as black (OpenGL 3.3, section 3.8.14). That OpenGL ES need not
/// filter float formats is not considered.
pub fn why_incomplete(texture: &TextureRecord, sampling: Option<&SamplingRecord>) -> Option<String> {
    let [first, last] = levels_read(texture, sampling);
    let faces = if texture.kind == "cube" { 6 } else { 1 };
    let find = |number: u32| texture.levels.iter().find(|level| level.level == number);
    let Some(base) = find(first) else { return Some(format!("it has no level {first}")) };
    for number in first..=last {
        let Some(level) = find(number) else {
            let has = texture.levels.len();
            let plural = if has == 1 { "" } else { "s" };
            return Some(format!("it has {has} level{plural} of {}", last - first + 1));
        };
        if level.faces < faces {
            return Some(format!("it has {} of 6 faces", level.faces));
        }
        let [width, height] = [base.width, base.height].map(|side| (side >> (number - first)).max(1));
        if [level.width, level.height] != [width, height] || base.width == 0 || base.height == 0 {
            return Some(format!("level {number} is {} x {} and not {width} x {height}", level.width, level.height));
        }
    }
    None
}
