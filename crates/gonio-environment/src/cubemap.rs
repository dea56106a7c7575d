//! Cubemaps: six square pictures, looked up without seams.

use crate::EnvironmentError;
use crate::face::SolidAngles;
pub use crate::face::solid_angle;
use crate::face::{Face, Layout};
use crate::panorama::color;
use glam::DVec3;
use gonio_image::{Image, Pixel};

/// Six square faces in OpenGL's layout, linear light.
#[derive(Clone, Debug, PartialEq)]
pub struct Cubemap {
    /// Texels along an edge, at least 1.
    size: u32,
    /// Face after face in the order of [`Face::ALL`], rows from the top.
    pixels: Vec<Pixel>,
}

impl Cubemap {
    /// Creates a cubemap of one colour. A size of 0 counts as 1.
    pub fn new(size: u32, pixel: Pixel) -> Self {
        let size = size.max(1);
        Cubemap { size, pixels: vec![pixel; 6 * size as usize * size as usize] }
    }

    /// Creates a cubemap from six pictures in the order of [`Face::ALL`] and in a layout.
    ///
    /// # Errors
    ///
    /// A picture that is not square, or not of the size of the others; the message names the face.
    pub fn from_faces(faces: [Image; 6], layout: Layout) -> Result<Self, EnvironmentError> {
        let size = check_sizes(&faces)?;
        let mut map = Cubemap::new(size, [0.0; 4]);
        for (face, image) in Face::ALL.into_iter().zip(&faces) {
            map.lay(face, layout, &image.pixels);
        }
        Ok(map)
    }

    /// Returns the six faces as pictures, in the order of [`Face::ALL`] and in a layout.
    pub fn faces(&self, layout: Layout) -> [Image; 6] {
        Face::ALL.map(|face| {
            let mut image = Image { width: self.size, height: self.size, pixels: Vec::new() };
            let (from, flips_columns, flips_rows) = face.in_open_gl(layout);
            let rows = self.face(from).chunks_exact(self.size as usize);
            let rows: Box<dyn Iterator<Item = &[Pixel]>> =
                if flips_rows { Box::new(rows.rev()) } else { Box::new(rows) };
            image.pixels.reserve_exact(self.face(from).len());
            for row in rows {
                if flips_columns {
                    image.pixels.extend(row.iter().rev());
                } else {
                    image.pixels.extend_from_slice(row);
                }
            }
            image
        })
    }

    /// Copies a picture of this cubemap's size onto the face of a layout.
    pub(crate) fn lay(&mut self, face: Face, layout: Layout, pixels: &[Pixel]) {
        let size = self.size as usize;
        let (to, flips_columns, flips_rows) = face.in_open_gl(layout);
        let there = self.face_mut(to);
        for (y, row) in pixels.chunks_exact(size).enumerate() {
            let y = if flips_rows { size - 1 - y } else { y };
            let to = &mut there[y * size..][..size];
            to.copy_from_slice(row);
            if flips_columns {
                to.reverse();
            }
        }
    }

    /// Creates a cubemap from a function of the unit direction, evaluated at the middle of each texel.
    pub fn from_function(size: u32, radiance: impl Fn(DVec3) -> DVec3) -> Self {
        let mut map = Cubemap::new(size, [0.0; 4]);
        let size = map.size;
        for face in Face::ALL {
            for y in 0..size {
                for x in 0..size {
                    let [r, g, b] = radiance(texel_direction(face, x, y, size).normalize()).to_array();
                    *map.at_mut(face, x, y) = [r as f32, g as f32, b as f32, 1.0];
                }
            }
        }
        map
    }

    /// Returns the number of texels along an edge.
    pub fn size(&self) -> u32 {
        self.size
    }

    /// Returns all faces one after the other, in the order of [`Face::ALL`], rows from the top, OpenGL's layout.
    pub fn pixels(&self) -> &[Pixel] {
        &self.pixels
    }

    /// Returns all faces for modification.
    pub fn pixels_mut(&mut self) -> &mut [Pixel] {
        &mut self.pixels
    }

    /// Returns a face in OpenGL's layout, rows from the top.
    pub fn face(&self, face: Face) -> &[Pixel] {
        let area = self.size as usize * self.size as usize;
        &self.pixels[face as usize * area..][..area]
    }

    /// The same, to be changed.
    pub fn face_mut(&mut self, face: Face) -> &mut [Pixel] {
        let area = self.size as usize * self.size as usize;
        &mut self.pixels[face as usize * area..][..area]
    }

    /// The texel in column `x` of row `y`.
    pub fn at(&self, face: Face, x: u32, y: u32) -> Pixel {
        self.face(face)[y as usize * self.size as usize + x as usize]
    }

    fn at_mut(&mut self, face: Face, x: u32, y: u32) -> &mut Pixel {
        let index = y as usize * self.size as usize + x as usize;
        &mut self.face_mut(face)[index]
    }

    /// Linear radiance from a direction of any length, bilinear and without seams: as OpenGL with
    /// `TEXTURE_CUBE_MAP_SEAMLESS`, and as OpenGL ES 3, WebGL 2 and Vulkan always do. Zero for a direction of no length.
    pub fn sample(&self, direction: DVec3) -> DVec3 {
        let Some((face, s, t)) = Face::from_direction(direction, Layout::OpenGl) else { return DVec3::ZERO };
        let size = f64::from(self.size);
        let (x, y) = (0.5 * (s + 1.0) * size - 0.5, 0.5 * (t + 1.0) * size - 0.5);
        let (left, top) = (x.floor(), y.floor());
        let (right_share, lower_share) = (x - left, y - top);
        let texel = |dx: i64, dy: i64| self.texel(face, left as i64 + dx, top as i64 + dy);
        let upper = texel(0, 0).lerp(texel(1, 0), right_share);
        let lower = texel(0, 1).lerp(texel(1, 1), right_share);
        upper.lerp(lower, lower_share)
    }

    /// Linear radiance of the nearest texel.
    pub fn sample_nearest(&self, direction: DVec3) -> DVec3 {
        let Some((face, s, t)) = Face::from_direction(direction, Layout::OpenGl) else { return DVec3::ZERO };
        let index = |v: f64| ((0.5 * (v + 1.0) * f64::from(self.size)) as u32).min(self.size - 1);
        color(self.at(face, index(s), index(t)))
    }

    /// The texel in column `x` of row `y` of a face, where both may go beyond the face's edges by up to a face: there it
    /// is the neighbour's texel that lies as far from the edge. Beyond a corner, where three faces meet, it is the mean
    /// of the three texels at the corner.
    pub fn texel(&self, face: Face, x: i64, y: i64) -> DVec3 {
        let size = i64::from(self.size);
        let inside = |v: i64| (0..size).contains(&v);
        match (inside(x), inside(y)) {
            (true, true) => color(self.at(face, x as u32, y as u32)),
            (false, false) => {
                let end = |v: i64| if v < 0 { 0 } else { size - 1 };
                let (corner_x, corner_y) = (end(x), end(y));
                let beyond = |v: i64| if v < 0 { -1 } else { size };
                let own = color(self.at(face, corner_x as u32, corner_y as u32));
                (own + self.texel(face, beyond(x), corner_y) + self.texel(face, corner_x, beyond(y))) / 3.0
            }
            _ => {
                let (neighbour, x, y) = self.over_the_edge(face, x, y);
                color(self.at(neighbour, x, y))
            }
        }
    }

    /// The neighbour's texel beyond one edge of a face.
    fn over_the_edge(&self, face: Face, x: i64, y: i64) -> (Face, u32, u32) {
        let size = i64::from(self.size);
        // The step beyond the edge is folded down around it: a point of the neighbour, as far from the edge.
        let centre = |v: i64| (2 * v + 1 - size) as f64 / size as f64;
        let (s, t) = (centre(x), centre(y));
        let (held_s, held_t) = (s.clamp(-1.0, 1.0), t.clamp(-1.0, 1.0));
        let depth = (s - held_s).abs().max((t - held_t).abs()).min(2.0);
        let on_edge = face.direction(held_s, held_t, Layout::OpenGl);
        let folded = on_edge - depth * face.direction(0.0, 0.0, Layout::OpenGl);
        // The edge's own axis is now the largest; its middle face is the neighbour's.
        let outwards = on_edge - face.direction(0.0, 0.0, Layout::OpenGl);
        let outwards =
            if x < 0 || x >= size { outwards - face.along_t() * held_t } else { outwards - face.along_s() * held_s };
        let neighbour = Face::ALL.into_iter().find(|f| f.direction(0.0, 0.0, Layout::OpenGl).dot(outwards) > 0.5);
        let neighbour = neighbour.unwrap_or(face);
        let index = |v: f64| ((0.5 * (v + 1.0) * size as f64) as i64).clamp(0, size - 1) as u32;
        (neighbour, index(folded.dot(neighbour.along_s())), index(folded.dot(neighbour.along_t())))
    }

    /// The mean radiance over the sphere: texels count by the solid angle that they cover.
    pub fn mean_radiance(&self) -> DVec3 {
        let size = self.size as usize;
        let angles = SolidAngles::new(self.size);
        let rows = self.pixels.chunks_exact(size).enumerate();
        let sum: DVec3 =
            rows.flat_map(|(y, row)| row.iter().zip(angles.row(y % size))).map(|(p, w)| w * color(*p)).sum();
        sum / (4.0 * std::f64::consts::PI)
    }
}

/// The size of six faces, in the order of [`Face::ALL`], that are square and of one size; an error names one that is not.
pub(crate) fn check_sizes(faces: &[Image; 6]) -> Result<u32, EnvironmentError> {
    let size = faces[0].width;
    for (face, image) in Face::ALL.into_iter().zip(faces) {
        let (width, height) = (image.width, image.height);
        if width != height || width == 0 {
            let message = format!("the face `{}` is {width} x {height}; faces must be square", face.name());
            return Err(EnvironmentError::new(message));
        }
        if width != size {
            return Err(EnvironmentError::new(format!(
                "the face `{}` is {width} x {width}, but `posx` is {size} x {size}; make all six the same size",
                face.name()
            )));
        }
    }
    Ok(size)
}

/// The direction of a texel's middle, OpenGL's layout; its largest component is 1.
pub fn texel_direction(face: Face, x: u32, y: u32, size: u32) -> DVec3 {
    let centre = |v: u32| (2.0 * f64::from(v) + 1.0) / f64::from(size) - 1.0;
    face.direction(centre(x), centre(y), Layout::OpenGl)
}

/// The mean of pixels.
pub(crate) fn mean(pixels: &[Pixel]) -> DVec3 {
    pixels.iter().map(|p| color(*p)).sum::<DVec3>() / pixels.len().max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A smooth function that differs in every direction.
    fn truth(d: DVec3) -> DVec3 {
        DVec3::new(1.5 + d.x, 1.5 + d.y * d.z, 1.5 + d.z)
    }

    #[test]
    fn lookups_have_no_seam() {
        let map = Cubemap::from_function(32, truth);
        let mut worst: f64 = 0.0;
        for i in 0..2000 {
            // Along edges and through corners, a little to either side.
            let a = f64::from(i % 41) / 20.0 - 1.0;
            let off = (f64::from(i % 7) - 3.0) * 0.01;
            for d in [DVec3::new(1.0, 1.0 + off, a), DVec3::new(a, -1.0, 1.0 + off), DVec3::new(-1.0 + off, a, -1.0)] {
                let d = d.normalize();
                worst = worst.max((map.sample(d) - truth(d)).abs().max_element());
            }
        }
        // 0.02 is a third of a texel's step: a lookup in a wrong neighbour errs by far more. The corners' mean of
        // three stands for a texel that does not exist.
        assert!(worst < 0.02, "{worst}");
    }

    #[test]
    fn beyond_every_edge_is_the_texel_that_touches_it() {
        let size = 5;
        let map = Cubemap::from_function(size, |d| d);
        for face in Face::ALL {
            for i in 0..i64::from(size) {
                for (x, y, x_in, y_in) in [(-1, i, 0, i), (5, i, 4, i), (i, -1, i, 0), (i, 5, i, 4)] {
                    let beyond = map.texel(face, x, y);
                    let own = map.texel(face, x_in, y_in);
                    // Neighbours across an edge lie symmetrically about it: as near to it from the other side.
                    let step = (beyond - own).length();
                    assert!(step < 0.35 && step > 0.15, "{face:?} {x} {y}: {step}");
                }
            }
        }
    }

    #[test]
    fn faces_come_back_as_they_were_laid() {
        let map = Cubemap::from_function(4, truth);
        for layout in [Layout::OpenGl, Layout::Photographic] {
            let faces = map.faces(layout);
            for (face, image) in Face::ALL.into_iter().zip(&faces) {
                let d = face.direction(-0.25, 0.75, layout).normalize();
                let got = color(image.at(1, 3));
                // Stored as f32.
                assert!(got.abs_diff_eq(truth(d), 1e-6), "{layout} {face:?}: {got}");
            }
            assert_eq!(Cubemap::from_faces(faces, layout).as_ref(), Ok(&map));
        }
    }

    #[test]
    fn faces_that_do_not_fit_are_named() {
        let faces = |change: usize, width, height| {
            let mut faces: [Image; 6] = std::array::from_fn(|_| Image::new(4, 4, [0.0; 4]));
            faces[change] = Image::new(width, height, [0.0; 4]);
            Cubemap::from_faces(faces, Layout::OpenGl).map(|_| ()).map_err(|e| e.to_string())
        };
        assert_eq!(
            faces(3, 8, 8),
            Err("the face `negy` is 8 x 8, but `posx` is 4 x 4; make all six the same size".into())
        );
        assert_eq!(faces(5, 4, 3), Err("the face `negz` is 4 x 3; faces must be square".into()));
        assert_eq!(faces(5, 4, 4), Ok(()));
    }

    #[test]
    fn solid_angles_fill_the_sphere() {
        for size in [1, 2, 7] {
            let face: f64 = (0..size * size).map(|i| solid_angle(i % size, i / size, size)).sum();
            // Rounding of some dozens of additions.
            assert!((6.0 * face - 4.0 * std::f64::consts::PI).abs() < 1e-12, "{size}: {face}");
        }
        // 0.5 on average, over a sphere, of a function that is not constant.
        let map = Cubemap::from_function(64, |d| DVec3::splat(0.5) + 0.5 * d);
        assert!(map.mean_radiance().abs_diff_eq(DVec3::splat(0.5), 1e-6), "{}", map.mean_radiance());
    }
}
