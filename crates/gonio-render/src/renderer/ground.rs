//! The ground as an aid: a grid below the objects, and the contact shadow that they have on it, drawn onto a texture of its own
//! that a window shows over the picture. Neither is light of the equation.

use super::output::{Band, DisplaySettings};
use super::shared::Shared;
use super::special::clip_from_world;
use super::{PANES, Renderer};
use crate::display::DisplayTexture;
use crate::glsl::{Display, SpecialProgram};
use crate::scene_on_gpu::GpuScene;
use crate::shadows_on_gpu::ContactShadow;
use glam::{DMat4, DVec2, DVec3, DVec4};
use gonio_gl::objects::DebugGroup;
use gonio_gl::target::{ColorPrecision, DepthTarget, OutputTarget};
use gonio_gl::{GlError, SavedState};
use gonio_scene::{Frame, GroundPlane};
use std::rc::Rc;

/// Texels along a side of the contact shadow.
const CONTACT_TEXELS: i32 = 160;
/// Half the side of the square that the contact shadow covers, and the reach of its samples, in extents of the objects.
const CONTACT_HALF: f64 = 1.9;
const CONTACT_REACH: f64 = 0.9;
/// The share of the light that the shadow takes where nothing of the sky is seen.
const CONTACT_STRENGTH: f32 = 0.62;
/// The distance at which the grid has faded, in extents of the objects.
const GRID_REACH: f64 = 4.5;

/// The look of the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GroundLook {
    /// The colour of lines: display-encoded, not premultiplied.
    pub line_color: [f32; 4],
    /// The colours of the lines through the world's origin along x, y and z.
    pub axis_colors: [[f32; 3]; 3],
    /// Whether there is a contact shadow.
    pub contact_shadow: bool,
}

impl Renderer {
    /// Draws the ground below the objects onto `layer`, which takes the frame's size: premultiplied colours, transparent where the
    /// ground is hidden or bare. Does not wait, and leaves the window's state as [`Renderer::paint`] does. The contact shadow is
    /// computed once for each [`GpuScene`].
    pub fn paint_ground(
        &mut self,
        scene: &GpuScene,
        frame: &Frame,
        plane: &GroundPlane,
        look: &GroundLook,
        layer: &mut DisplayTexture,
    ) -> Result<(), GlError> {
        let shared = self.shared.clone();
        let gl = &shared.gl;
        let _state = SavedState::save(gl);
        let _group = DebugGroup::new(gl, "ground");
        let contact = if look.contact_shadow { Some(shared.contact_shadow(scene, frame, plane)?) } else { None };
        let height = frame.height as i32;
        let target = self.target_for(scene, frame, height, ColorPrecision::Half, PANES, &mut Vec::new())?;
        layer.fit([frame.width, frame.height])?;
        shared.output_program_for(&target, Display::Linear)?;
        target.begin(gl, 0, height);
        gl.enable(glow::DEPTH_TEST);
        gl.depth_func(glow::LESS);
        gl.disable(glow::BLEND);
        gl.color_mask(false, false, false, false);
        let clip_from_world = clip_from_world(frame);
        let hidden = shared.draw_plainly(SpecialProgram::ShadowMap, scene, frame, &clip_from_world);
        gl.color_mask(true, true, true, true);
        hidden?;
        shared.draw_ground(plane, look, contact.as_deref(), &clip_from_world)?;
        target.resolve(gl);
        let whole = Band { picture_height: height, first_row: 0, rows: height };
        shared.output_into(layer.output(), &target, whole, &DisplaySettings::of_numbers(), Display::Linear)
    }
}

impl Shared {
    fn draw_ground(
        &self,
        plane: &GroundPlane,
        look: &GroundLook,
        contact: Option<&ContactShadow>,
        clip_from_world: &DMat4,
    ) -> Result<(), GlError> {
        let gl = &self.gl;
        let program = self.special_program(SpecialProgram::Ground)?;
        program.bind();
        let middle = plane.axes[0] * plane.center.x + plane.axes[1] * plane.center.y + plane.up * plane.height;
        let world_from_ground = DMat4::from_cols(
            plane.axes[0].extend(0.0),
            plane.axes[1].extend(0.0),
            plane.up.extend(0.0),
            middle.extend(1.0),
        );
        let reach = GRID_REACH * plane.extent();
        let [step, strong] = plane.steps();
        // Small numbers, however far the objects are from the world's origin.
        let origin = (plane.center / strong).round() * strong - plane.center;
        program.set_mat4("clip_from_ground", &(*clip_from_world * world_from_ground).as_mat4());
        program.set_f32("reach", reach as f32);
        program.set_vec2("origin", origin.as_vec2());
        program.set_vec2(
            "world_axes",
            (-plane.center).clamp(DVec2::splat(-1e3 * reach), DVec2::splat(1e3 * reach)).as_vec2(),
        );
        program.set_f32("line_step", step as f32);
        program.set_f32("strong_step", strong as f32);
        program.set_vec4("line_color", look.line_color);
        program.set_vec3_array(
            "axis_colors",
            &plane
                .axes
                .map(|axis| look.axis_colors[DVec3::AXES.into_iter().position(|known| known == axis).unwrap_or(0)]),
        );
        program.set_i32("contact_map", 0);
        program.set_f32("contact_half", (CONTACT_HALF * plane.extent()) as f32);
        program.set_f32("contact_strength", if contact.is_some() { CONTACT_STRENGTH } else { 0.0 });
        gl.active_texture(glow::TEXTURE0);
        gl.bind_texture(glow::TEXTURE_2D, contact.map(|contact| contact.map.texture()));
        gl.disable(glow::CULL_FACE);
        // Flat undersides are in the plane.
        gl.enable(glow::POLYGON_OFFSET_FILL);
        gl.polygon_offset(1.0, 4.0);
        gl.bind_vertex_array(Some(self.no_attributes.handle()));
        gl.draw_arrays(glow::TRIANGLE_STRIP, 0, 4);
        gl.bind_vertex_array(None);
        gl.disable(glow::POLYGON_OFFSET_FILL);
        gl.polygon_offset(0.0, 0.0);
        Ok(())
    }

    /// The contact shadow of a scene on a plane; drawn if there is none yet.
    fn contact_shadow(
        &self,
        scene: &GpuScene,
        frame: &Frame,
        plane: &GroundPlane,
    ) -> Result<Rc<ContactShadow>, GlError> {
        if let Some(known) = scene.contact.borrow().as_ref().filter(|known| known.plane == *plane) {
            return Ok(known.clone());
        }
        let gl = &self.gl;
        let _group = DebugGroup::new(gl, "contact shadow");
        let size = [CONTACT_TEXELS; 2];
        gl.active_texture(glow::TEXTURE0);
        let heights = DepthTarget::new(gl, size, "heights above the ground")?;
        heights.begin(gl);
        gl.viewport(0, 0, size[0], size[1]);
        gl.enable(glow::DEPTH_TEST);
        gl.depth_func(glow::LESS);
        gl.disable(glow::BLEND);
        let half = CONTACT_HALF * plane.extent();
        // Surfaces in the plane itself are not cut off.
        let rise = 1.001 * plane.rise.max(1e-6 * plane.extent());
        let row = |axis: DVec3, at: f64, scale: f64| (axis * scale).extend(-at * scale);
        let depth = row(plane.up, plane.height, 2.0 / rise) - DVec4::W * 0.999;
        let rows = [
            row(plane.axes[0], plane.center.x, 1.0 / half),
            row(plane.axes[1], plane.center.y, 1.0 / half),
            depth,
            DVec4::W,
        ];
        let clip_from_world = DMat4::from_cols(rows[0], rows[1], rows[2], rows[3]).transpose();
        self.draw_plainly(SpecialProgram::ShadowMap, scene, frame, &clip_from_world)?;
        let map = OutputTarget::new(gl, size, false)?;
        gl.bind_texture(glow::TEXTURE_2D, Some(map.texture()));
        for parameter in [glow::TEXTURE_MIN_FILTER, glow::TEXTURE_MAG_FILTER] {
            gl.tex_parameter_i32(glow::TEXTURE_2D, parameter, glow::LINEAR as i32);
        }
        let program = self.special_program(SpecialProgram::Contact)?;
        program.bind();
        program.set_i32("heights", 0);
        program.set_f32("rise", rise as f32);
        program.set_f32("side", (2.0 * half) as f32);
        program.set_f32("reach", (CONTACT_REACH * plane.extent()) as f32);
        map.bind(gl);
        gl.disable(glow::DEPTH_TEST);
        gl.disable(glow::CULL_FACE);
        gl.bind_texture(glow::TEXTURE_2D, Some(heights.texture()));
        gl.bind_vertex_array(Some(self.no_attributes.handle()));
        gl.draw_arrays(glow::TRIANGLES, 0, 3);
        gl.bind_vertex_array(None);
        let contact = Rc::new(ContactShadow { plane: *plane, map });
        scene.contact.replace(Some(contact.clone()));
        Ok(contact)
    }
}
