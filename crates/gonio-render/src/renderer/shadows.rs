//! Shadow maps: drawn when the lights, the objects or the part of them that is seen change.

use super::Renderer;
use super::shared::{PANES, Shared};
use crate::glsl::{SpecialProgram, texture_unit};
use crate::scene_on_gpu::{GpuObject, GpuScene, Run};
use crate::shadow_map::{MOST_SHADOWED_LIGHTS, SHADOW_ROWS, SHADOW_TEXELS, ShadowMap, ShadowPlan};
use crate::shadows_on_gpu::ShadowMaps;
use crate::textures;
use gonio_gl::objects::{DebugGroup, TextureObject};
use gonio_gl::target::DepthTarget;
use gonio_gl::{Gl, GlError, Texels};
use gonio_scene::scene::ShadowCaster;
use gonio_scene::{BoundTexture, Frame, TextureFilter};
use std::rc::Rc;

impl Renderer {
    /// The shadow maps of a frame, drawn if what they depend on has changed; `None` if nothing casts shadows.
    pub(super) fn shadow_maps(
        &mut self,
        scene: &GpuScene,
        frame: &Frame,
        notes: &mut Vec<String>,
    ) -> Result<Option<Rc<ShadowMaps>>, GlError> {
        if !frame.shadows {
            return Ok(None);
        }
        let plan = ShadowPlan::new(frame, self.shared.info.max_size, scene.is_lit_at_vertices());
        if plan.unshadowed > 0 {
            notes.push(format!(
                "{} of the lights cast no shadows: shadows are drawn of the first {MOST_SHADOWED_LIGHTS} only",
                plan.unshadowed
            ));
        }
        if plan.is_empty() {
            return Ok(None);
        }
        if let Some(known) = scene.shadows.borrow().as_ref().filter(|known| known.plan == plan) {
            return Ok(Some(known.clone()));
        }
        scene.shadows.replace(None);
        let maps = Rc::new(self.draw_shadow_maps(scene, frame, plan)?);
        scene.shadows.replace(Some(maps.clone()));
        Ok(Some(maps))
    }

    fn draw_shadow_maps(&mut self, scene: &GpuScene, frame: &Frame, plan: ShadowPlan) -> Result<ShadowMaps, GlError> {
        let shared = self.shared.clone();
        let gl = &shared.gl;
        let _group = DebugGroup::new(gl, "shadow maps");
        let size = plan.size().map(|side| side as i32);
        let spare = self.shadow_atlases.iter().find(|atlas| atlas.size() == size && Rc::strong_count(atlas) == 1);
        let atlas = match spare {
            Some(atlas) => atlas.clone(),
            None => {
                // Those of scenes that are gone, and of other sizes.
                self.shadow_atlases.retain(|atlas| Rc::strong_count(atlas) > 1);
                self.shadow_atlases.truncate(PANES);
                gl.active_texture(glow::TEXTURE0 + texture_unit("shadow_atlas"));
                let atlas = Rc::new(DepthTarget::new(gl, size, "shadow maps")?);
                self.shadow_atlases.push(atlas.clone());
                atlas
            }
        };
        atlas.begin(gl);
        gl.enable(glow::DEPTH_TEST);
        gl.depth_func(glow::LESS);
        gl.disable(glow::BLEND);
        gl.disable(glow::CULL_FACE);
        let side = plan.side as i32;
        for (_, map, [x, y]) in plan.drawn() {
            gl.viewport(x as i32, y as i32, side, side);
            shared.draw_shadow_map(scene, frame, &map)?;
        }
        gl.bind_vertex_array(None);
        Ok(ShadowMaps { table: table(gl, &plan)?, plan, atlas })
    }
}

/// The table that shadow.glsl reads.
fn table(gl: &Gl, plan: &ShadowPlan) -> Result<TextureObject, GlError> {
    gl.active_texture(glow::TEXTURE0 + texture_unit("shadow_table"));
    let table = TextureObject::bound(gl, "table of shadow maps")?;
    gl.tex_image_2d(
        glow::TEXTURE_2D,
        0,
        glow::RGBA32F,
        [SHADOW_TEXELS as i32, SHADOW_ROWS as i32],
        Texels::f32(glow::RGBA, bytemuck::cast_slice(&plan.table())),
    );
    for parameter in [glow::TEXTURE_MIN_FILTER, glow::TEXTURE_MAG_FILTER] {
        gl.tex_parameter_i32(glow::TEXTURE_2D, parameter, glow::NEAREST as i32);
    }
    for parameter in [glow::TEXTURE_WRAP_S, glow::TEXTURE_WRAP_T] {
        gl.tex_parameter_i32(glow::TEXTURE_2D, parameter, glow::CLAMP_TO_EDGE as i32);
    }
    Ok(table)
}

impl Shared {
    /// Draws the depths of all that blocks light, fronts and backs: the nearest counts, so a closed object's shadow begins
    /// at the surface that is lit, and touches the object where it stands.
    fn draw_shadow_map(&self, scene: &GpuScene, frame: &Frame, map: &ShadowMap) -> Result<(), GlError> {
        let gl = &self.gl;
        let clip_from_world = map.clip_from_world();
        let in_environment = scene.environment.is_some() && frame.surroundings.is_some();
        for object in &scene.objects {
            let geometry = scene.geometry_of(object)?;
            for run in runs(object) {
                let material = &scene.materials[run.material];
                let which = match material.shadow_caster(in_environment) {
                    ShadowCaster::Nothing => continue,
                    ShadowCaster::Everything => SpecialProgram::ShadowMap,
                    ShadowCaster::WhereOpaque => SpecialProgram::MaskedShadowMap,
                };
                let program = self.special_program(which)?;
                program.bind();
                geometry.bind(gl);
                program.set_mat4("clip_from_model", &(clip_from_world * object.world_from_model).as_mat4());
                program.set_mat4("world_from_model", &object.world_from_model.as_mat4());
                program.set_mat3("normal_world_from_model", &object.normal_world_from_model);
                if let Some(map) = material.maps.opacity.as_ref().filter(|_| which == SpecialProgram::MaskedShadowMap) {
                    let map: &BoundTexture = map;
                    let unit = texture_unit("opacity_map");
                    gl.active_texture(glow::TEXTURE0 + unit);
                    gl.bind_texture(glow::TEXTURE_2D, scene.textures.get(map.texture).map(|t| t.handle()));
                    textures::set_sampling(gl, TextureFilter::Linear, map.wrap, self.info.anisotropy);
                    program.set_i32("opacity_map", unit as i32);
                    program.set_mat3x2("opacity_map_transform", &map.uv_matrix());
                    program.set_f32("opacity", material.material.opacity);
                }
                let first = run.first_triangle * 3 * size_of::<u32>();
                gl.draw_elements(glow::TRIANGLES, run.triangle_count as i32 * 3, glow::UNSIGNED_INT, first as i32);
            }
        }
        Ok(())
    }
}

/// The triangles of an object: opaque ones as they are drawn, and the parts that are not opaque everywhere.
fn runs(object: &GpuObject) -> impl Iterator<Item = Run> + '_ {
    let is_opaque = |first: usize| {
        object.opaque.iter().any(|run| (run.first_triangle..run.first_triangle + run.triangle_count).contains(&first))
    };
    let others =
        object.object.parts.iter().filter(move |part| part.triangle_count > 0 && !is_opaque(part.first_triangle));
    let others = others.map(|part| Run {
        name: part.name.clone(),
        first_triangle: part.first_triangle,
        triangle_count: part.triangle_count,
        material: part.material,
    });
    object.opaque.iter().cloned().chain(others)
}
