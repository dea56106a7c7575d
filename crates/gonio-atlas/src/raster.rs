//! The texels whose centres a triangle covers, exactly: each centre within a chart belongs to one of its triangles.

/// Bits after the point of texel coordinates. A coordinate of 2^14 texels then fits products of 62 bits.
const FRACTION_BITS: u32 = 16;

/// The largest side of a texture.
pub const MOST_TEXELS: u32 = 16384;

/// Calls `visit` with (column, row) of each texel, row 0 at the **bottom** (v = 0), whose centre is inside a triangle with
/// these texture coordinates, in a texture of `size` x `size` texels, at most [`MOST_TEXELS`]. Either orientation.
///
/// Corners are rounded to 1/65536 of a texel. A centre on an edge belongs to the triangle on one side of it (the top-left
/// rule, OpenGL 4.6 core, section 14.6.1), so that neighbours share no centre. Texels outside of the texture, and
/// triangles with coordinates that are not finite, are left out.
pub fn for_each_texel(tex_coords: [[f32; 2]; 3], size: u32, mut visit: impl FnMut(u32, u32)) {
    let Some(mut corners) = fixed(tex_coords, size) else { return };
    let area = cross(corners[0], corners[1], corners[2]);
    if area == 0 {
        return;
    }
    if area < 0 {
        corners.swap(1, 2);
    }
    let one = 1_i64 << FRACTION_BITS;
    let range = |axis: usize| {
        let values = corners.map(|c| c[axis]);
        let low = (values.iter().min().copied().unwrap_or(0) / one).max(0);
        let high = (values.iter().max().copied().unwrap_or(0) / one).min(i64::from(size) - 1);
        low..=high
    };
    for y in range(1) {
        for x in range(0) {
            let center = [x * one + one / 2, y * one + one / 2];
            let is_inside = (0..3).all(|k| {
                let (a, b) = (corners[k], corners[(k + 1) % 3]);
                let side = cross(a, b, center);
                // Edges that go down, or go left along the top, own their points.
                let owns = b[1] < a[1] || (b[1] == a[1] && b[0] < a[0]);
                side > 0 || (side == 0 && owns)
            });
            if is_inside {
                visit(x as u32, y as u32);
            }
        }
    }
}

fn fixed(tex_coords: [[f32; 2]; 3], size: u32) -> Option<[[i64; 2]; 3]> {
    let scale = f64::from(size.min(MOST_TEXELS)) * f64::from(1 << FRACTION_BITS);
    // Coordinates far outside would overflow; such triangles are no part of an atlas.
    let is_near = tex_coords.iter().flatten().all(|c| c.is_finite() && c.abs() <= 2.0);
    is_near.then(|| tex_coords.map(|uv| uv.map(|c| (f64::from(c) * scale).round() as i64)))
}

fn cross(a: [i64; 2], b: [i64; 2], c: [i64; 2]) -> i64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}
