//! The table of plain calls: name, arguments, and what is noted of each for records of frames.
//!
//! One table becomes two things: safe functions on [`crate::functions::Functions`], and methods of [`crate::Gl`] that call
//! them and take the note. A call cannot be made without its note. Calls of the second list have a method of their own in
//! `calls.rs`, because their note is more than a line or their arguments need a check first.
//!
//! # Why every call in the table is sound
//!
//! OpenGL answers wrong arguments with an error flag and no effect (OpenGL 4.6, section 2.3.1): an enum, a number or the
//! name of an object that does not exist cannot make these calls touch memory. None of them reads or writes memory of the
//! process but through `&str` and slices, whose lengths glow passes on, and through results, for which glow asks for the
//! length first. Where the number of results depends on an argument (`glGet...`), or where OpenGL reads as much as other
//! state says (texels, attributes, draws), the call is not in this table but in `functions.rs`, with a check.
//!
//! The remaining condition is a current context. [`crate::Gl`] is not `Send`; its constructors get a context from glow's
//! constructors, which are unsafe, or from `headless`, and both guarantee it.

macro_rules! call_table {
    ($define:ident) => {
        $define! {
            tabled {
                fn active_texture(unit: u32)
                    => |state| state.active_unit = unit.wrapping_sub(glow::TEXTURE0) as usize;
                fn attach_shader(program: glow::Program, shader: glow::Shader)
                    => |state| state.shader_attached(program, shader);
                fn begin_query(target: u32, query: glow::Query);
                fn bind_attrib_location(program: glow::Program, index: u32, name: &str);
                fn bind_framebuffer(target: u32, framebuffer: Option<glow::Framebuffer>)
                    => |state| state.framebuffer_bound(target, framebuffer);
                fn bind_renderbuffer(target: u32, renderbuffer: Option<glow::Renderbuffer>)
                    => |state| state.renderbuffer = renderbuffer;
                fn bind_texture(target: u32, texture: Option<glow::Texture>)
                    => |state| state.texture_bound(target, texture);
                fn bind_vertex_array(array: Option<glow::VertexArray>)
                    => |state| state.vertex_array = array;
                fn blend_equation(mode: u32);
                fn blend_func(source: u32, destination: u32);
                fn blend_func_separate(source: u32, destination: u32, source_alpha: u32, destination_alpha: u32);
                fn check_framebuffer_status(target: u32) -> u32;
                fn clear_color(red: f32, green: f32, blue: f32, alpha: f32);
                fn clear_depth_f32(depth: f32);
                fn color_mask(red: bool, green: bool, blue: bool, alpha: bool);
                fn compile_shader(shader: glow::Shader);
                fn create_query() -> Result<glow::Query, String>;
                fn cull_face(face: u32);
                fn delete_buffer(buffer: glow::Buffer)
                    => |state| state.buffer_deleted(buffer);
                fn delete_framebuffer(framebuffer: glow::Framebuffer)
                    => |state| state.framebuffer_deleted(framebuffer);
                fn delete_program(program: glow::Program)
                    => |state| state.program_deleted(program);
                fn delete_query(query: glow::Query);
                fn delete_renderbuffer(renderbuffer: glow::Renderbuffer)
                    => |state| drop(state.renderbuffers.remove(&renderbuffer));
                fn delete_shader(shader: glow::Shader)
                    => |state| drop(state.shaders.remove(&shader));
                fn delete_texture(texture: glow::Texture)
                    => |state| state.texture_deleted(texture);
                fn delete_vertex_array(array: glow::VertexArray)
                    => |state| state.vertex_array_deleted(array);
                fn depth_func(function: u32);
                fn depth_mask(writes: bool);
                fn detach_shader(program: glow::Program, shader: glow::Shader);
                fn disable(capability: u32);
                fn disable_vertex_attrib_array(index: u32)
                    => |state| state.array().attribute(index).enabled = false;
                fn enable(capability: u32);
                fn enable_vertex_attrib_array(index: u32)
                    => |state| state.array().attribute(index).enabled = true;
                fn end_query(target: u32);
                fn finish();
                fn framebuffer_renderbuffer(
                    target: u32,
                    attachment: u32,
                    renderbuffer_target: u32,
                    renderbuffer: Option<glow::Renderbuffer>,
                ) => |state| state.attached(attachment, renderbuffer.map(Attached::Renderbuffer));
                fn framebuffer_texture_2d(
                    target: u32,
                    attachment: u32,
                    texture_target: u32,
                    texture: Option<glow::Texture>,
                    level: i32,
                ) => |state| {
                    state.attached(attachment, texture.map(|texture| Attached::Texture(texture, level.max(0) as u32)))
                };
                fn front_face(order: u32);
                fn generate_mipmap(target: u32)
                    => |state| state.mipmaps_generated(target);
                fn get_active_attribute(program: glow::Program, index: u32) -> Option<glow::ActiveAttribute>;
                fn get_active_attributes(program: glow::Program) -> u32;
                fn get_active_uniform(program: glow::Program, index: u32) -> Option<glow::ActiveUniform>;
                fn get_active_uniforms(program: glow::Program) -> u32;
                fn get_parameter_string(name: u32) -> String;
                fn get_program_info_log(program: glow::Program) -> String;
                fn get_program_link_status(program: glow::Program) -> bool;
                fn get_query_parameter_u32(query: glow::Query, parameter: u32) -> u32;
                fn get_shader_compile_status(shader: glow::Shader) -> bool;
                fn get_shader_info_log(shader: glow::Shader) -> String;
                fn is_enabled(capability: u32) -> bool;
                fn link_program(program: glow::Program)
                    => |state| state.program_linked(program);
                fn object_label(kind: u32, name: u32, label: Option<&str>);
                fn polygon_offset(factor: f32, units: f32);
                fn pop_debug_group();
                fn push_debug_group(source: u32, id: u32, message: &str);
                fn renderbuffer_storage_multisample(target: u32, samples: i32, format: u32, width: i32, height: i32)
                    => |state| state.renderbuffer_made(samples, format, [width, height]);
                fn scissor(x: i32, y: i32, width: i32, height: i32);
                fn shader_source(shader: glow::Shader, source: &str)
                    => |state| state.shader_source(shader, source);
                fn tex_image_2d_multisample(
                    target: u32,
                    samples: i32,
                    internal_format: i32,
                    width: i32,
                    height: i32,
                    fixed_locations: bool,
                ) => |state| state.image(target, 0, internal_format as u32, [width, height, 1], samples);
                fn tex_parameter_f32(target: u32, parameter: u32, value: f32);
                fn tex_parameter_i32(target: u32, parameter: u32, value: i32);
                fn uniform_1_f32(location: Option<&glow::UniformLocation>, x: f32)
                    => |state| state.uniform_set(location, None);
                fn uniform_1_i32(location: Option<&glow::UniformLocation>, x: i32)
                    => |state| state.uniform_set(location, Some(&[x]));
                fn uniform_1_u32(location: Option<&glow::UniformLocation>, x: u32)
                    => |state| state.uniform_set(location, None);
                fn uniform_2_f32(location: Option<&glow::UniformLocation>, x: f32, y: f32)
                    => |state| state.uniform_set(location, None);
                fn uniform_2_i32(location: Option<&glow::UniformLocation>, x: i32, y: i32)
                    => |state| state.uniform_set(location, Some(&[x, y]));
                fn uniform_3_f32(location: Option<&glow::UniformLocation>, x: f32, y: f32, z: f32)
                    => |state| state.uniform_set(location, None);
                fn uniform_3_f32_slice(location: Option<&glow::UniformLocation>, values: &[f32])
                    => |state| state.uniform_set(location, None);
                fn uniform_3_i32(location: Option<&glow::UniformLocation>, x: i32, y: i32, z: i32)
                    => |state| state.uniform_set(location, Some(&[x, y, z]));
                fn uniform_4_f32(location: Option<&glow::UniformLocation>, x: f32, y: f32, z: f32, w: f32)
                    => |state| state.uniform_set(location, None);
                fn uniform_4_f32_slice(location: Option<&glow::UniformLocation>, values: &[f32])
                    => |state| state.uniform_set(location, None);
                fn uniform_4_i32(location: Option<&glow::UniformLocation>, x: i32, y: i32, z: i32, w: i32)
                    => |state| state.uniform_set(location, Some(&[x, y, z, w]));
                fn uniform_matrix_2_f32_slice(
                    location: Option<&glow::UniformLocation>,
                    transpose: bool,
                    values: &[f32],
                ) => |state| state.uniform_set(location, None);
                fn uniform_matrix_3_f32_slice(
                    location: Option<&glow::UniformLocation>,
                    transpose: bool,
                    values: &[f32],
                ) => |state| state.uniform_set(location, None);
                fn uniform_matrix_3x2_f32_slice(
                    location: Option<&glow::UniformLocation>,
                    transpose: bool,
                    values: &[f32],
                ) => |state| state.uniform_set(location, None);
                fn uniform_matrix_4_f32_slice(
                    location: Option<&glow::UniformLocation>,
                    transpose: bool,
                    values: &[f32],
                ) => |state| state.uniform_set(location, None);
                fn use_program(program: Option<glow::Program>)
                    => |state| state.program = program;
                fn vertex_attrib_4_f32(index: u32, x: f32, y: f32, z: f32, w: f32)
                    => |state| state.constant_set(index);
                fn vertex_attrib_divisor(index: u32, divisor: u32)
                    => |state| state.array().attribute(index).divisor = divisor;
                fn viewport(x: i32, y: i32, width: i32, height: i32);
            }
            written_out {
                fn bind_buffer(target: u32, buffer: Option<glow::Buffer>);
                fn blit_framebuffer(
                    x0: i32,
                    y0: i32,
                    x1: i32,
                    y1: i32,
                    to_x0: i32,
                    to_y0: i32,
                    to_x1: i32,
                    to_y1: i32,
                    mask: u32,
                    filter: u32,
                );
                fn buffer_data_u8_slice(target: u32, data: &[u8], usage: u32);
                fn clear(mask: u32);
                fn create_buffer() -> Result<glow::Buffer, String>;
                fn create_framebuffer() -> Result<glow::Framebuffer, String>;
                fn create_program() -> Result<glow::Program, String>;
                fn create_renderbuffer() -> Result<glow::Renderbuffer, String>;
                fn create_shader(kind: u32) -> Result<glow::Shader, String>;
                fn create_texture() -> Result<glow::Texture, String>;
                fn create_vertex_array() -> Result<glow::VertexArray, String>;
                fn get_attrib_location(program: glow::Program, name: &str) -> Option<u32>;
                fn get_buffer_sub_data(target: u32, offset: i32, bytes: &mut [u8]);
                fn get_uniform_location(program: glow::Program, name: &str) -> Option<glow::UniformLocation>;
                fn pixel_store_i32(parameter: u32, value: i32);
            }
        }
    };
}
pub(crate) use call_table;
