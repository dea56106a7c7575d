//! The lights of a frame, as uniforms or as a float texture: any number in one pass.

use crate::glsl::{LIGHT_DIRECTIONAL, LIGHT_POINT, LIGHT_SPOT, LIGHT_TEXELS, LIGHTS_IN_UNIFORMS, LIGHTS_PER_ROW};
use crate::shadow_map::ShadowPlan;
use glam::DVec3;
use gonio_gl::objects::TextureObject;
use gonio_gl::{Gl, GlError, Texels};
use gonio_light::{Light, LightKind, vector};

/// One light: `LIGHT_TEXELS` texels of four floats.
type Row = [[f32; 4]; LIGHT_TEXELS];

/// The lights of a frame: few are passed in uniforms, many in a texture.
pub struct LightTable {
    texture: TextureObject,
    /// The ends of the directional lights, the point lights and the spot lights; ambient lights are not in the table.
    pub ends: [usize; 3],
    /// The lights, if they are few.
    few: Vec<Row>,
}

impl LightTable {
    /// Creates an empty table.
    pub fn new(gl: &Gl) -> Result<Self, GlError> {
        let texture = TextureObject::bound(gl, "lights")?;
        for parameter in [glow::TEXTURE_MIN_FILTER, glow::TEXTURE_MAG_FILTER] {
            gl.tex_parameter_i32(glow::TEXTURE_2D, parameter, glow::NEAREST as i32);
        }
        for parameter in [glow::TEXTURE_WRAP_S, glow::TEXTURE_WRAP_T] {
            gl.tex_parameter_i32(glow::TEXTURE_2D, parameter, glow::CLAMP_TO_EDGE as i32);
        }
        Ok(LightTable { texture, ends: [0; 3], few: Vec::new() })
    }

    /// The number of lights.
    pub fn count(&self) -> usize {
        self.ends[2]
    }

    /// Whether there are too many for uniforms, so that they are in the texture.
    pub fn is_in_texture(&self) -> bool {
        self.count() > LIGHTS_IN_UNIFORMS
    }

    /// The values of few lights, as `light_values` in lighting.glsl.
    pub fn uniforms(&self) -> &[[f32; 4]] {
        self.few.as_flattened()
    }

    /// Fills it; the texture stays bound to the active unit.
    pub fn fill(&mut self, gl: &Gl, lights: &[Light], shadows: Option<&ShadowPlan>) {
        let kinds = [LIGHT_DIRECTIONAL, LIGHT_POINT, LIGHT_SPOT];
        let mut rows = Vec::with_capacity(lights.len());
        for (kind, end) in kinds.into_iter().zip(&mut self.ends) {
            let of_kind = lights.iter().enumerate().filter(|(_, l)| kind_of(l) == Some(kind));
            rows.extend(of_kind.map(|(index, light)| {
                let maps = shadows.and_then(|plan| plan.rows.get(index)).copied().unwrap_or_default();
                row_of(light, maps.map(|number| number as f64))
            }));
            *end = rows.len();
        }
        if !self.is_in_texture() {
            self.few = rows;
            return;
        }
        self.few.clear();
        let height = rows.len().div_ceil(LIGHTS_PER_ROW).max(1);
        // A single row may be narrower: WebGL2 has no lower limit.
        let width = if height == 1 { rows.len().max(1) } else { LIGHTS_PER_ROW };
        rows.resize(width * height, Row::default());
        gl.bind_texture(glow::TEXTURE_2D, Some(self.texture.handle()));
        gl.tex_image_2d(
            glow::TEXTURE_2D,
            0,
            glow::RGBA32F,
            [(width * LIGHT_TEXELS) as i32, height as i32],
            Texels::f32(glow::RGBA, bytemuck::cast_slice(&rows)),
        );
    }

    /// The table's row of the scene's light `index`; `None` for ambient lights and beyond the end.
    pub fn row_of_light(lights: &[Light], index: usize) -> Option<usize> {
        let kind = kind_of(lights.get(index)?)?;
        let before = lights
            .iter()
            .enumerate()
            .filter(|(i, light)| kind_of(light).is_some_and(|other| other < kind || (other == kind && *i < index)));
        Some(before.count())
    }
}

/// The number of the kind in GLSL; lights are sorted by it.
fn kind_of(light: &Light) -> Option<i32> {
    match light.kind {
        LightKind::Ambient => None,
        LightKind::Directional { .. } => Some(LIGHT_DIRECTIONAL),
        LightKind::Point { .. } => Some(LIGHT_POINT),
        LightKind::Spot { .. } => Some(LIGHT_SPOT),
    }
}

/// Place or direction, first shadow map; colour, number of shadow maps; axis and cosine of the outer angle; attenuation and cosine of the inner
/// angle. `light_terms` in lighting.glsl reads this.
fn row_of(light: &Light, [first_map, maps]: [f64; 2]) -> Row {
    let texel = |v: DVec3, w: f64| [v.x as f32, v.y as f32, v.z as f32, w as f32];
    let a = light.attenuation;
    let attenuation = DVec3::new(a.constant, a.linear, a.quadratic);
    let (place, axis, cosines) = match light.kind {
        LightKind::Ambient => (DVec3::ZERO, DVec3::ZERO, [0.0; 2]),
        LightKind::Directional { direction } => (direction_of(direction), DVec3::ZERO, [0.0; 2]),
        LightKind::Point { position } => (position, DVec3::ZERO, [0.0; 2]),
        LightKind::Spot { position, axis, inner_rad, outer_rad } => {
            (position, direction_of(axis), [outer_rad.cos(), inner_rad.cos()])
        }
    };
    [texel(place, first_map), texel(light.color, maps), texel(axis, cosines[0]), texel(attenuation, cosines[1])]
}

/// The unit direction, as in the reference; zero if there is none.
fn direction_of(v: DVec3) -> DVec3 {
    vector::unit_or(v, DVec3::ZERO)
}
