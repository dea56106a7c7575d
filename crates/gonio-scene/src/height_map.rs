//! Bump maps: heights become normals, and normal maps are distinguished from height maps.

use crate::image_file::Decoded;

/// A picture counts as heights if no texel's channels differ by more than this (of 255): room for
/// what JPEG does to greys. A tangent-space normal map is bluish everywhere: (128, 128, 255).
const GREY_TOLERANCE: u8 = 24;

/// Whether the picture is grey, or nearly so: heights, not normals.
pub(crate) fn is_heights(picture: &Decoded) -> bool {
    let spread = |t: &[u8; 4]| t[0].max(t[1]).max(t[2]) - t[0].min(t[1]).min(t[2]);
    let texels = picture.rgba.as_chunks::<4>().0;
    let colored = texels.iter().filter(|t| spread(t) > GREY_TOLERANCE).count();
    colored * 100 <= texels.len()
}

/// Heights (red channel) in `[0, 1]` to a tangent-space normal map, green up.
///
/// The slope along u is `strength * (h[x+1] - h[x-1]) / 2` per texel (central differences, the
/// picture repeats), and so along v; the normal is `(-slope_u, -slope_v, 1)` at unit length, mapped
/// from [-1, 1] to bytes. `strength` is the material's `-bm`.
pub(crate) fn normals_of_heights(picture: &mut Decoded, strength: f64) {
    let (width, height) = (picture.width as usize, picture.height as usize);
    let heights: Vec<f64> = picture.rgba.as_chunks::<4>().0.iter().map(|t| f64::from(t[0]) / 255.0).collect();
    let at = |x: usize, y: usize| heights[y * width + x];
    for (i, texel) in picture.rgba.as_chunks_mut::<4>().0.iter_mut().enumerate() {
        let (x, y) = (i % width, i / width);
        let slope_u = 0.5 * strength * (at((x + 1) % width, y) - at((x + width - 1) % width, y));
        // Rows run down, v runs up.
        let slope_v = 0.5 * strength * (at(x, (y + height - 1) % height) - at(x, (y + 1) % height));
        *texel = to_bytes([-slope_u, -slope_v, 1.0]);
    }
}

/// A normal map with its slopes multiplied by `strength`.
pub(crate) fn strengthen(picture: &mut Decoded, strength: f64) {
    for texel in picture.rgba.as_chunks_mut::<4>().0 {
        let [x, y, z] = [0, 1, 2].map(|c| f64::from(texel[c]) / 127.5 - 1.0);
        *texel = to_bytes([x * strength, y * strength, z]);
    }
}

fn to_bytes(normal: [f64; 3]) -> [u8; 4] {
    let length = normal.iter().map(|c| c * c).sum::<f64>().sqrt().max(1e-12);
    let [x, y, z] = normal.map(|c| (127.5 * (c / length + 1.0) + 0.5) as u8);
    [x, y, z, 255]
}
