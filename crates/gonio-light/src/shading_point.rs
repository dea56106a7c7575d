//! One point of a surface: its geometry and its material.

use crate::vector;
use glam::DVec3;

/// The material at one point: all colours linear RGB, each >= 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    /// `k_a`
    pub ambient: DVec3,
    /// `k_d`; the `a` of the BRDFs.
    pub diffuse: DVec3,
    /// `k_s`; the `b` of the BRDFs.
    pub specular: DVec3,
    /// `E`
    pub emitted: DVec3,
    /// `gamma`, held in `[1, SHININESS_MAX]` ([`crate::brdf::effective_shininess`]): 0^0 never happens.
    pub shininess: f64,
    /// Index of refraction of the material, > 0; the outside has 1.
    pub refraction_index: f64,
}

impl Default for Surface {
    fn default() -> Self {
        Surface {
            ambient: DVec3::splat(0.8),
            diffuse: DVec3::splat(0.8),
            specular: DVec3::ZERO,
            emitted: DVec3::ZERO,
            shininess: 32.0,
            refraction_index: 1.5,
        }
    }
}

/// The geometry of the point at which the equation is evaluated. World space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShadingPoint {
    /// World space, world units.
    pub position: DVec3,
    /// `N`: unit shading normal.
    pub normal: DVec3,
    /// `V`: unit vector to the eye.
    pub view: DVec3,
    /// Unit tangent, for BRDFs with a direction; any vector perpendicular to `normal` will do for the
    /// others.
    pub tangent: DVec3,
}

impl ShadingPoint {
    /// The point with the normal made usable: `normal` at unit length; where it is degenerate
    /// (shorter than 1e-12) `geometric_normal`, and failing that the view direction.
    pub fn new(position: DVec3, normal: DVec3, geometric_normal: DVec3, eye: DVec3) -> Self {
        let view = vector::unit(eye - position).unwrap_or(DVec3::Y);
        let normal = vector::unit(normal).or_else(|| vector::unit(geometric_normal)).unwrap_or(view);
        ShadingPoint { position, normal, view, tangent: vector::any_orthonormal_vector(normal) }
    }
}
