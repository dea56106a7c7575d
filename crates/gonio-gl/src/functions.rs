//! The functions of a context as safe calls: the plain ones of the table, and those that touch memory, which are checked first.
#![allow(unsafe_code)]

use crate::bounds::CheckedDraw;
use crate::call_table::call_table;
use glow::{HasContext, PixelPackData, PixelUnpackData};
use std::cell::Cell;
use std::sync::Arc;

/// The query target for vertex shader invocations, of ARB_pipeline_statistics_query.
pub const VERTEX_SHADER_INVOCATIONS: u32 = 0x82F0;
/// The query target for fragment shader invocations.
pub const FRAGMENT_SHADER_INVOCATIONS: u32 = 0x82F4;

/// The functions of a context that is current on this thread.
pub struct Functions {
    pub(super) context: Arc<glow::Context>,
    /// The error of a call that was not passed on to OpenGL; `GL_NO_ERROR` if there is none.
    pending: Cell<u32>,
}

impl Functions {
    /// The functions of a current context.
    pub fn new(context: Arc<glow::Context>) -> Self {
        Functions { context, pending: Cell::new(glow::NO_ERROR) }
    }

    /// Whether the context is one of OpenGL ES.
    pub fn is_embedded(&self) -> bool {
        self.context.version().is_embedded
    }

    /// The context's version: major, minor.
    pub fn version(&self) -> (u32, u32) {
        let version = self.context.version();
        (version.major, version.minor)
    }

    /// Whether the context has labels and debug groups.
    #[inline]
    pub fn supports_debug(&self) -> bool {
        self.context.supports_debug()
    }

    /// Whether the context has an extension.
    pub fn supports(&self, extension: &str) -> bool {
        self.context.supported_extensions().contains(extension)
    }

    /// Raises an error as OpenGL does: the first one stays until it is fetched. Used for calls that would touch memory outside
    /// of their arguments, as in WebGL.
    #[cold]
    pub fn raise(&self, error: u32) {
        if self.pending.get() == glow::NO_ERROR {
            self.pending.set(error);
        }
    }

    /// Fetches and clears an error, that of a call that was not passed on first.
    #[inline]
    pub fn get_error(&self) -> u32 {
        match self.pending.replace(glow::NO_ERROR) {
            glow::NO_ERROR => self.get_own_error(),
            error => error,
        }
    }
}

macro_rules! define_functions {
    (
        tabled { $(fn $tabled:ident($($t:ident: $T:ty),* $(,)?) $(-> $TR:ty)? $(=> |$state:ident| $note:expr)?;)* }
        written_out { $(fn $written:ident($($w:ident: $W:ty),* $(,)?) $(-> $WR:ty)?;)* }
    ) => {
        define_functions! { $(fn $tabled($($t: $T),*) $(-> $TR)?;)* $(fn $written($($w: $W),*) $(-> $WR)?;)* }
    };
    ($(fn $name:ident($($argument:ident: $Type:ty),*) $(-> $Result:ty)?;)*) => {
        /// The plain calls.
        #[allow(clippy::too_many_arguments)] // OpenGL's own
        impl Functions {
            $(
                #[inline]
                pub fn $name(&self, $($argument: $Type),*) $(-> $Result)? {
                    // SAFETY: wrong arguments raise an error, and no memory except that of strings, slices and results is
                    // accessed; `call_table.rs` explains why.
                    unsafe { self.context.$name($($argument),*) }
                }
            )*
        }
    };
}

call_table!(define_functions);

/// Texels for a texture: row by row without gaps, the row at t = 0 first.
#[derive(Clone, Copy, Debug)]
pub struct Texels<'a> {
    format: u32,
    kind: u32,
    bytes: Option<&'a [u8]>,
}

impl<'a> Texels<'a> {
    /// Channels (`format`: `GL_RGBA`, `GL_RG`, ...) of 8 bits, 0 to 255.
    pub fn u8(format: u32, channels: &'a [u8]) -> Self {
        Texels { format, kind: glow::UNSIGNED_BYTE, bytes: Some(channels) }
    }

    /// Channels that are the bits of half floats.
    pub fn f16(format: u32, channels: &'a [u16]) -> Self {
        Texels { format, kind: glow::HALF_FLOAT, bytes: Some(bytemuck::cast_slice(channels)) }
    }

    /// Channels that are floats.
    pub fn f32(format: u32, channels: &'a [f32]) -> Self {
        Texels { format, kind: glow::FLOAT, bytes: Some(bytemuck::cast_slice(channels)) }
    }

    /// Memory only, whose texels are undefined: `kind` is `GL_FLOAT` or `GL_UNSIGNED_BYTE`.
    pub fn none(format: u32, kind: u32) -> Self {
        Texels { format, kind, bytes: None }
    }

    /// Whether there are enough for a size.
    fn suffice(&self, size: [i32; 3]) -> bool {
        let Some(bytes) = self.bytes else { return true };
        bytes_of_texels(size, self.format, self.kind).is_some_and(|needed| needed <= bytes.len())
    }
}

/// Bytes of a block of texels without gaps; 0 for negative sizes, which OpenGL refuses; `None` for unsupported formats.
fn bytes_of_texels(size: [i32; 3], format: u32, kind: u32) -> Option<usize> {
    let channels = match format {
        glow::RED => 1,
        glow::RG => 2,
        glow::RGB => 3,
        glow::RGBA => 4,
        _ => return None,
    };
    let each = match kind {
        glow::UNSIGNED_BYTE => 1,
        glow::HALF_FLOAT => 2,
        glow::FLOAT => 4,
        _ => return None,
    };
    size.into_iter().try_fold(channels * each, |bytes: usize, side| bytes.checked_mul(side.max(0) as usize))
}

/// The layout of texels in memory for uploads: without gaps.
const UNPACKING: [(u32, i32); 6] = [
    (glow::UNPACK_ALIGNMENT, 1),
    (glow::UNPACK_ROW_LENGTH, 0),
    (glow::UNPACK_IMAGE_HEIGHT, 0),
    (glow::UNPACK_SKIP_ROWS, 0),
    (glow::UNPACK_SKIP_PIXELS, 0),
    (glow::UNPACK_SKIP_IMAGES, 0),
];
/// The layout of pixels in memory for reading back: without gaps.
const PACKING: [(u32, i32); 4] =
    [(glow::PACK_ALIGNMENT, 1), (glow::PACK_ROW_LENGTH, 0), (glow::PACK_SKIP_ROWS, 0), (glow::PACK_SKIP_PIXELS, 0)];

/// Numbers of the context, each a single one.
const INTEGERS: &[u32] = &[
    glow::ACTIVE_TEXTURE,
    glow::BLEND_DST_ALPHA,
    glow::BLEND_DST_RGB,
    glow::BLEND_SRC_ALPHA,
    glow::BLEND_SRC_RGB,
    glow::CULL_FACE_MODE,
    glow::CURRENT_PROGRAM,
    glow::DEPTH_FUNC,
    glow::DRAW_FRAMEBUFFER_BINDING,
    glow::FRONT_FACE,
    glow::MAX_COLOR_TEXTURE_SAMPLES,
    glow::MAX_COMBINED_TEXTURE_IMAGE_UNITS,
    glow::MAX_CUBE_MAP_TEXTURE_SIZE,
    glow::MAX_RENDERBUFFER_SIZE,
    glow::MAX_SAMPLES,
    glow::MAX_TEXTURE_SIZE,
    glow::READ_FRAMEBUFFER_BINDING,
    glow::SAMPLER_BINDING,
    glow::VERTEX_ARRAY_BINDING,
];
/// Parameters of textures, each a single number.
const TEXTURE_PARAMETERS: &[u32] = &[
    glow::TEXTURE_BASE_LEVEL,
    glow::TEXTURE_MAG_FILTER,
    glow::TEXTURE_MAX_LEVEL,
    glow::TEXTURE_MIN_FILTER,
    glow::TEXTURE_WRAP_R,
    glow::TEXTURE_WRAP_S,
    glow::TEXTURE_WRAP_T,
];
/// Most numbers of a uniform that is not an array: those of a `mat4`.
const MOST_NUMBERS: usize = 16;

impl Functions {
    /// OpenGL's own error flag.
    #[inline]
    pub fn get_own_error(&self) -> u32 {
        // SAFETY: reads and clears a flag.
        unsafe { self.context.get_error() }
    }

    /// Fills an image of the bound texture. Too few texels are refused; extra ones are ignored.
    pub fn tex_image_2d(&self, target: u32, level: i32, format: i32, size: [i32; 2], texels: Texels<'_>) {
        let [width, height] = size;
        if !texels.suffice([width, height, 1]) {
            return self.raise(glow::INVALID_OPERATION);
        }
        self.unpack_without_gaps();
        let data = PixelUnpackData::Slice(texels.bytes);
        // SAFETY: OpenGL reads width * height texels of this format without gaps, and the slice has as many.
        unsafe {
            self.context.tex_image_2d(target, level, format, width, height, 0, texels.format, texels.kind, data);
        }
    }

    /// Replaces a rectangle of an image of the bound texture. Too few texels are refused.
    pub fn tex_sub_image_2d(&self, target: u32, level: i32, at: [i32; 2], size: [i32; 2], texels: Texels<'_>) {
        let ([x, y], [width, height]) = (at, size);
        let Some(bytes) = texels.bytes.filter(|_| texels.suffice([width, height, 1])) else {
            return self.raise(glow::INVALID_OPERATION);
        };
        self.unpack_without_gaps();
        let data = PixelUnpackData::Slice(Some(bytes));
        // SAFETY: as in `tex_image_2d`.
        unsafe {
            self.context.tex_sub_image_2d(target, level, x, y, width, height, texels.format, texels.kind, data);
        }
    }

    /// Fills an image of the bound texture of three dimensions, or of layers. Too few texels are refused.
    pub fn tex_image_3d(&self, target: u32, level: i32, format: i32, size: [i32; 3], texels: Texels<'_>) {
        if !texels.suffice(size) {
            return self.raise(glow::INVALID_OPERATION);
        }
        self.unpack_without_gaps();
        let [width, height, depth] = size;
        let data = PixelUnpackData::Slice(texels.bytes);
        // SAFETY: as in `tex_image_2d`, for depth layers.
        unsafe {
            let (transfer, kind) = (texels.format, texels.kind);
            self.context.tex_image_3d(target, level, format, width, height, depth, 0, transfer, kind, data);
        }
    }

    fn unpack_without_gaps(&self) {
        UNPACKING.into_iter().for_each(|(parameter, value)| self.pixel_store_i32(parameter, value));
        self.bind_buffer(glow::PIXEL_UNPACK_BUFFER, None);
    }

    /// Reads a rectangle (x, y, width, height) of the bound framebuffer as RGBA of 8 bits. Too little room is refused.
    pub fn read_rgba8(&self, rectangle: [i32; 4], into: &mut [u8]) {
        self.read_pixels(rectangle, glow::UNSIGNED_BYTE, into);
    }

    /// Reads a rectangle (x, y, width, height) of the bound framebuffer as RGBA of floats. Too little room is refused.
    pub fn read_rgba_f32(&self, rectangle: [i32; 4], into: &mut [f32]) {
        self.read_pixels(rectangle, glow::FLOAT, bytemuck::cast_slice_mut(into));
    }

    fn read_pixels(&self, [x, y, width, height]: [i32; 4], kind: u32, into: &mut [u8]) {
        let room = bytes_of_texels([width, height, 1], glow::RGBA, kind);
        if room.is_none_or(|room| room > into.len()) {
            return self.raise(glow::INVALID_OPERATION);
        }
        PACKING.into_iter().for_each(|(parameter, value)| self.pixel_store_i32(parameter, value));
        self.bind_buffer(glow::PIXEL_PACK_BUFFER, None);
        let data = PixelPackData::Slice(Some(into));
        // SAFETY: OpenGL writes width * height texels of four channels of this kind, without gaps and into the slice, which
        // has room for as many.
        unsafe { self.context.read_pixels(x, y, width, height, glow::RGBA, kind, data) };
    }

    /// Describes an attribute of the bound vertex array, which reads `buffer`. The buffer becomes the array buffer. An offset
    /// without a buffer, which old versions of OpenGL treated as an address, is refused.
    pub fn vertex_attrib_pointer_f32(&self, index: u32, buffer: Option<glow::Buffer>, layout: AttributeLayout) -> bool {
        let AttributeLayout { components, component_type, normalized, stride, offset } = layout;
        if offset < 0 || (buffer.is_none() && offset != 0) {
            self.raise(glow::INVALID_OPERATION);
            return false;
        }
        self.bind_buffer(glow::ARRAY_BUFFER, buffer);
        // SAFETY: with a buffer the offset is within it, and `bounds.rs` refuses draws that would read beyond it. Without one
        // it is the null pointer, and draws that would read it are refused as well.
        unsafe {
            self.context.vertex_attrib_pointer_f32(index, components, component_type, normalized, stride, offset);
        }
        true
    }

    /// Draws.
    #[inline]
    pub fn draw(&self, draw: &CheckedDraw) {
        let (call, array) = draw.parts();
        // Other code that uses the context may have bound another one. (A browser checks draws itself.)
        if !cfg!(target_arch = "wasm32") {
            self.bind_vertex_array(array);
        }
        // SAFETY: the draw was checked with the vertex array that is bound: all that it reads is within the buffers. Only
        // `bounds.rs` makes such a draw.
        unsafe {
            match (call.index_type, call.instances) {
                (None, 1) => self.context.draw_arrays(call.mode, call.first, call.count),
                (None, instances) => self.context.draw_arrays_instanced(call.mode, call.first, call.count, instances),
                (Some(kind), 1) => self.context.draw_elements(call.mode, call.count, kind, call.first),
                (Some(kind), instances) => {
                    self.context.draw_elements_instanced(call.mode, call.count, kind, call.first, instances);
                }
            }
        }
    }

    /// A number of the context, one of [`INTEGERS`]; 0 and an error for others, of which OpenGL may write several.
    pub fn get_parameter_i32(&self, parameter: u32) -> i32 {
        if !INTEGERS.contains(&parameter) {
            self.raise(glow::INVALID_ENUM);
            return 0;
        }
        // SAFETY: the parameter is a single number, and there is room for one.
        unsafe { self.context.get_parameter_i32(parameter) }
    }

    /// `GL_VIEWPORT` or `GL_SCISSOR_BOX`: x, y, width, height.
    pub fn get_rectangle(&self, parameter: u32) -> [i32; 4] {
        let mut numbers = [0; 4];
        if !matches!(parameter, glow::VIEWPORT | glow::SCISSOR_BOX) {
            self.raise(glow::INVALID_ENUM);
            return numbers;
        }
        // SAFETY: the parameter is four numbers, and there is room for four.
        unsafe { self.context.get_parameter_i32_slice(parameter, &mut numbers) };
        numbers
    }

    /// The framebuffer that is bound to `GL_DRAW_FRAMEBUFFER` or `GL_READ_FRAMEBUFFER`.
    pub fn get_framebuffer(&self, target: u32) -> Option<glow::Framebuffer> {
        let binding = match target {
            glow::READ_FRAMEBUFFER => glow::READ_FRAMEBUFFER_BINDING,
            _ => glow::DRAW_FRAMEBUFFER_BINDING,
        };
        // SAFETY: the parameter is a single name.
        unsafe { self.context.get_parameter_framebuffer(binding) }
    }

    /// The colour that `glClear` clears to.
    pub fn get_clear_color(&self) -> [f32; 4] {
        let mut color = [0.0; 4];
        // SAFETY: the parameter is four numbers, and there is room for four.
        unsafe { self.context.get_parameter_f32_slice(glow::COLOR_CLEAR_VALUE, &mut color) };
        color
    }

    /// The depth that `glClear` clears to.
    pub fn get_clear_depth(&self) -> f32 {
        // SAFETY: the parameter is a single number.
        unsafe { self.context.get_parameter_f32(glow::DEPTH_CLEAR_VALUE) }
    }

    /// Whether depth is written.
    pub fn get_depth_mask(&self) -> bool {
        // SAFETY: the parameter is a single truth value.
        unsafe { self.context.get_parameter_bool(glow::DEPTH_WRITEMASK) }
    }

    /// Whether red, green, blue and alpha are written.
    pub fn get_color_mask(&self) -> [bool; 4] {
        // SAFETY: the parameter is four truth values.
        unsafe { self.context.get_parameter_bool_array(glow::COLOR_WRITEMASK) }
    }

    /// A number of the bound texture, one of [`TEXTURE_PARAMETERS`]; 0 and an error for others.
    pub fn get_tex_parameter_i32(&self, target: u32, parameter: u32) -> i32 {
        if !TEXTURE_PARAMETERS.contains(&parameter) {
            self.raise(glow::INVALID_ENUM);
            return 0;
        }
        // SAFETY: the parameter is a single number, and there is room for one.
        unsafe { self.context.get_tex_parameter_i32(target, parameter) }
    }

    /// The value of an attribute that has no array.
    pub fn get_constant_attribute(&self, index: u32) -> [f32; 4] {
        let mut value = [0.0, 0.0, 0.0, 1.0];
        // SAFETY: the parameter is four numbers, and there is room for four.
        unsafe {
            self.context.get_vertex_attrib_parameter_f32_slice(index, glow::CURRENT_VERTEX_ATTRIB, &mut value);
        }
        value
    }

    /// The most samples that a renderbuffer of a format can have. Not on the web, where glow needs a slice of exactly as many
    /// elements as there are answers.
    #[cfg(not(target_arch = "wasm32"))]
    pub fn get_most_samples(&self, format: u32) -> i32 {
        let mut most = [1];
        // SAFETY: the length of the slice is passed to OpenGL.
        unsafe { self.context.get_internal_format_i32_slice(glow::RENDERBUFFER, format, glow::SAMPLES, &mut most) };
        most[0]
    }

    /// The numbers of a uniform of floats, one element; `numbers` is as long as its type.
    pub fn get_uniform_f32(&self, program: glow::Program, location: &glow::UniformLocation, numbers: &mut [f32]) {
        let mut room = [0.0; MOST_NUMBERS];
        let Some(room) = room_for(&mut room, numbers.len()) else { return self.raise(glow::INVALID_VALUE) };
        // SAFETY: OpenGL writes as many numbers as the uniform has, at most sixteen, and there is room for as many. (In a
        // browser glow writes as many as the slice has, and checks.)
        unsafe { self.context.get_uniform_f32(program, location, room) };
        numbers.copy_from_slice(&room[..numbers.len()]);
    }

    /// The numbers of a uniform of integers, of truth values, or of a sampler.
    pub fn get_uniform_i32(&self, program: glow::Program, location: &glow::UniformLocation, numbers: &mut [i32]) {
        let mut room = [0; MOST_NUMBERS];
        let Some(room) = room_for(&mut room, numbers.len()) else { return self.raise(glow::INVALID_VALUE) };
        // SAFETY: as in `get_uniform_f32`.
        unsafe { self.context.get_uniform_i32(program, location, room) };
        numbers.copy_from_slice(&room[..numbers.len()]);
    }

    /// The numbers of a uniform of unsigned integers.
    pub fn get_uniform_u32(&self, program: glow::Program, location: &glow::UniformLocation, numbers: &mut [u32]) {
        let mut room = [0; MOST_NUMBERS];
        let Some(room) = room_for(&mut room, numbers.len()) else { return self.raise(glow::INVALID_VALUE) };
        // SAFETY: as in `get_uniform_f32`.
        unsafe { self.context.get_uniform_u32(program, location, room) };
        numbers.copy_from_slice(&room[..numbers.len()]);
    }
}

/// Room for the numbers of any uniform; in a browser exactly `count`, because glow panics otherwise.
fn room_for<T>(room: &mut [T; MOST_NUMBERS], count: usize) -> Option<&mut [T]> {
    if cfg!(target_arch = "wasm32") { room.get_mut(..count) } else { (count <= MOST_NUMBERS).then_some(&mut room[..]) }
}

/// The layout of an attribute in its buffer.
#[derive(Clone, Copy, Debug)]
pub struct AttributeLayout {
    /// Numbers for each vertex, 1 to 4.
    pub components: i32,
    /// `GL_FLOAT`, ...
    pub component_type: u32,
    /// Whether integers are mapped to -1 to 1 or 0 to 1.
    pub normalized: bool,
    /// Bytes from one vertex to the next; 0 means tightly packed.
    pub stride: i32,
    /// The first vertex's first byte.
    pub offset: i32,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texels_are_counted_by_format_and_type() {
        let rgba = [0.0_f32; 4 * 6];
        assert!(Texels::f32(glow::RGBA, &rgba).suffice([3, 2, 1]));
        assert!(!Texels::f32(glow::RGBA, &rgba).suffice([3, 3, 1]));
        assert!(Texels::f32(glow::RG, &rgba).suffice([3, 2, 2]));
        assert!(!Texels::u8(glow::RGB, &[0; 11]).suffice([2, 2, 1]));
        assert!(!Texels::f16(0x1234, &[0; 64]).suffice([1, 1, 1]), "an unknown format");
        assert!(!Texels::u8(glow::RGBA, &[0; 64]).suffice([i32::MAX, i32::MAX, i32::MAX]), "no overflow");
        assert!(Texels::u8(glow::RGBA, &[]).suffice([-1, 5, 1]), "OpenGL refuses negative sizes");
    }
}
