//! The camera: Position, Front, Up, Right, and the two matrices they make.

use glam::{DMat4, DVec3, DVec4};

/// A perspective camera in a right-handed world; it looks along `front`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// The eye, world space.
    pub position: DVec3,
    /// Unit viewing direction, world space.
    pub front: DVec3,
    /// Unit, perpendicular to `front`: the picture's up.
    pub up: DVec3,
    /// Unit, `front x up`: the picture's right.
    pub right: DVec3,
    /// Full vertical field of view, radians, in (0, pi).
    pub fov_y_rad: f64,
    /// Distance of the near plane, > 0, world units.
    pub near: f64,
    /// Distance of the far plane, > near, world units.
    pub far: f64,
}

impl Camera {
    /// Looks from `position` along `direction`; `world_up` need not be perpendicular to it. Where the
    /// two are parallel another up is chosen; a zero direction means -Z.
    pub fn looking_along(
        position: DVec3,
        direction: DVec3,
        world_up: DVec3,
        fov_y_rad: f64,
        near: f64,
        far: f64,
    ) -> Self {
        let front = gonio_light::vector::unit(direction).unwrap_or(DVec3::NEG_Z);
        let right = gonio_light::vector::unit(front.cross(world_up))
            .or_else(|| gonio_light::vector::unit(front.cross(DVec3::NEG_Z)))
            .unwrap_or(DVec3::X);
        Camera { position, front, up: right.cross(front), right, fov_y_rad, near, far }
    }

    /// The lab's convention: yaw -90 and pitch 0 look along -Z; degrees.
    pub fn direction_of(yaw_deg: f64, pitch_deg: f64) -> DVec3 {
        let (yaw, pitch) = (yaw_deg.to_radians(), pitch_deg.to_radians());
        DVec3::new(yaw.cos() * pitch.cos(), pitch.sin(), yaw.sin() * pitch.cos())
    }

    /// Yaw and pitch in degrees of the viewing direction.
    pub fn yaw_pitch_deg(&self) -> (f64, f64) {
        (self.front.z.atan2(self.front.x).to_degrees(), self.front.y.clamp(-1.0, 1.0).asin().to_degrees())
    }

    /// `V`: rows Right, Up, -Front.
    pub fn view_from_world(&self) -> DMat4 {
        let (r, u, b, p) = (self.right, self.up, -self.front, self.position);
        DMat4::from_cols(
            DVec4::new(r.x, u.x, b.x, 0.0),
            DVec4::new(r.y, u.y, b.y, 0.0),
            DVec4::new(r.z, u.z, b.z, 0.0),
            DVec4::new(-r.dot(p), -u.dot(p), -b.dot(p), 1.0),
        )
    }

    /// `P`: OpenGL's clip space, z in [-1, 1]. `aspect` is width over height.
    pub fn clip_from_view(&self, aspect: f64) -> DMat4 {
        let f = 1.0 / (0.5 * self.fov_y_rad).tan();
        let (n, z) = (self.near, self.far);
        DMat4::from_cols(
            DVec4::new(f / aspect, 0.0, 0.0, 0.0),
            DVec4::new(0.0, f, 0.0, 0.0),
            DVec4::new(0.0, 0.0, (z + n) / (n - z), -1.0),
            DVec4::new(0.0, 0.0, 2.0 * z * n / (n - z), 0.0),
        )
    }

    /// The unit direction from the eye through the point (`x`, `y`) of a picture of `width` x `height`
    /// pixels, world space. x to the right, y **down**, pixel centres at half integers.
    pub fn ray_direction(&self, x: f64, y: f64, width: u32, height: u32) -> DVec3 {
        let tan = (0.5 * self.fov_y_rad).tan();
        let aspect = f64::from(width) / f64::from(height);
        let sx = (2.0 * x / f64::from(width) - 1.0) * tan * aspect;
        let sy = (1.0 - 2.0 * y / f64::from(height)) * tan;
        (self.front + sx * self.right + sy * self.up).normalize()
    }

    /// Distance of `point` along the viewing direction, world units: the quantity `depth`.
    pub fn depth_of(&self, point: DVec3) -> f64 {
        (point - self.position).dot(self.front)
    }
}
