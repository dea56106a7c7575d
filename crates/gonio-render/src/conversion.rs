//! Panoramas and cubemaps converted into one another by the GPU: the same pictures as gonio-environment makes on the CPU,
//! to f32's rounding.

use crate::shader_text::shader_text;
use gonio_environment::convert::{self, Conversion, EnvironmentRef, Filter, TexelLayers};
use gonio_environment::{Cubemap, Face, Layout, Panorama, panorama};
use gonio_gl::Dialect;
use gonio_gl::objects::{TextureObject, VertexArray};
use gonio_gl::program::Program;
use gonio_gl::target::OutputTarget;
use gonio_gl::{DriverInfo, Gl, GlError, Texels};
use gonio_image::Image;
use std::fmt::Write;

/// A converted environment.
#[derive(Clone, Debug, PartialEq)]
pub struct Converted<T> {
    /// The environment.
    pub environment: T,
    /// Limits of the driver that changed the result.
    pub notes: Vec<String>,
}

/// Converts environments on a context's GPU.
pub struct Converter {
    gl: Gl,
    pub(crate) info: DriverInfo,
    no_attributes: VertexArray,
}

/// The layout of the result.
#[derive(Clone, Copy, PartialEq, Eq)]
enum OutputLayout {
    Cubemap,
    Panorama,
}

impl Converter {
    /// Creates a converter for a context.
    pub fn new(gl: Gl) -> Result<Self, GlError> {
        let info = DriverInfo::new(&gl);
        let no_attributes = VertexArray::bound(&gl, "no attributes")?;
        Ok(Converter { gl, info, no_attributes })
    }

    /// The driver.
    pub fn driver(&self) -> &DriverInfo {
        &self.info
    }

    /// A cubemap of `size` texels along an edge: as [`Conversion::cubemap`].
    ///
    /// # Errors
    ///
    /// The size exceeds the driver's limit, or there is not enough memory.
    pub fn cubemap(
        &self,
        conversion: &Conversion,
        from: EnvironmentRef<'_>,
        size: u32,
    ) -> Result<Converted<Cubemap>, GlError> {
        let mut map = Cubemap::new(size, [0.0; 4]);
        let size = map.size();
        let filter = conversion.filter_for(&from, 2.0 / f64::from(size));
        let (source, notes) = self.uploaded(from, filter)?;
        let program = self.program(conversion, &source, OutputLayout::Cubemap, filter, [size, size])?;
        for face in Face::ALL {
            let middle = face.direction(0.0, 0.0, Layout::OpenGl);
            program.set_dvec3("face_middle", middle);
            program.set_dvec3("face_along_s", face.direction(1.0, 0.0, Layout::OpenGl) - middle);
            program.set_dvec3("face_along_t", face.direction(0.0, 1.0, Layout::OpenGl) - middle);
            let pixels = self.drawn([size, size])?;
            map.face_mut(face).copy_from_slice(bytemuck::cast_slice(&pixels));
        }
        Ok(Converted { environment: map, notes })
    }

    /// A panorama of this size: as [`Conversion::panorama`].
    ///
    /// # Errors
    ///
    /// The size exceeds the driver's limit, or there is not enough memory.
    pub fn panorama(
        &self,
        conversion: &Conversion,
        from: EnvironmentRef<'_>,
        width: u32,
        height: u32,
    ) -> Result<Converted<Panorama>, GlError> {
        let mut image = Image::new(width.max(1), height.max(1), [0.0; 4]);
        let size = [image.width, image.height];
        let filter = conversion.filter_for(&from, std::f64::consts::PI / f64::from(image.height));
        let (source, notes) = self.uploaded(from, filter)?;
        self.program(conversion, &source, OutputLayout::Panorama, filter, size)?;
        let pixels = self.drawn(size)?;
        image.pixels.copy_from_slice(bytemuck::cast_slice(&pixels));
        Ok(Converted { environment: Panorama { image }, notes })
    }

    /// The source as a texture, reduced if it exceeds the driver's limit.
    fn uploaded(&self, from: EnvironmentRef<'_>, filter: Filter) -> Result<(SourceTexture, Vec<String>), GlError> {
        let most = self.info.max_size;
        let sheets = from.texel_layers(filter);
        if sheets.width.max(sheets.height) <= most {
            return Ok((SourceTexture::upload(&self.gl, &from, &sheets)?, Vec::new()));
        }
        let reduce = Conversion { filter: Some(Filter::Area), ..Conversion::default() };
        let note = |was: String, is: String| {
            vec![format!(
                "{was} exceed the driver's limit of {most} along a side; the source was first reduced to {is}"
            )]
        };
        match from {
            EnvironmentRef::Panorama(panorama) => {
                let (width, height) = (panorama.image.width, panorama.image.height);
                let scale = f64::from(most) / f64::from(width.max(height));
                let side = |v: u32| ((f64::from(v) * scale) as u32).max(1);
                let smaller = reduce.panorama(from, side(width), side(height));
                let notes = note(format!("{width} x {height} pixels"), format!("{} x {}", side(width), side(height)));
                let from = EnvironmentRef::Panorama(&smaller);
                Ok((SourceTexture::upload(&self.gl, &from, &from.texel_layers(filter))?, notes))
            }
            EnvironmentRef::Cubemap(map) => {
                let size = (most - 2 * sheets.border).max(1);
                let smaller = reduce.cubemap(from, size);
                let notes = note(format!("faces of {0} x {0} texels", map.size()), format!("{size} x {size}"));
                let from = EnvironmentRef::Cubemap(&smaller);
                Ok((SourceTexture::upload(&self.gl, &from, &from.texel_layers(filter))?, notes))
            }
        }
    }

    /// The program, bound, with everything set but the target's face.
    fn program(
        &self,
        conversion: &Conversion,
        source: &SourceTexture,
        target: OutputLayout,
        filter: Filter,
        size: [u32; 2],
    ) -> Result<Program, GlError> {
        let most = self.info.max_size;
        if size[0].max(size[1]) > most {
            return Err(GlError::new(format!(
                "{} x {} texels exceed the driver's limit of {most} along a side; choose a smaller size, or convert on the CPU",
                size[0], size[1]
            )));
        }
        let [vertex, fragment] = sources(self.info.dialect, source.from_cubemap, target, filter);
        let program = Program::new(&self.gl, "conversion", &vertex, &fragment, &[])?;
        program.bind();
        program.set_i32("source", 0);
        let turn = conversion.source_from_target.as_mat3();
        program.set_mat3("source_from_target", &turn);
        program.set_ivec2("source_size", source.size.map(|v| v as i32));
        program.set_ivec2("target_size", size.map(|v| v as i32));
        self.gl.active_texture(glow::TEXTURE0);
        self.gl.bind_texture(glow::TEXTURE_2D_ARRAY, Some(source.texture.handle()));
        Ok(program)
    }

    /// Draws one picture with the current program, and reads it.
    fn drawn(&self, size: [u32; 2]) -> Result<Vec<f32>, GlError> {
        let gl = &self.gl;
        let output = OutputTarget::new(gl, size.map(|v| v as i32), true)?;
        output.bind(gl);
        gl.disable(glow::DEPTH_TEST);
        gl.disable(glow::BLEND);
        gl.disable(glow::CULL_FACE);
        gl.bind_vertex_array(Some(self.no_attributes.handle()));
        gl.draw_arrays(glow::TRIANGLES, 0, 3);
        gl.bind_vertex_array(None);
        let values = output.read_f32(gl);
        match gl.get_error() {
            glow::NO_ERROR => Ok(values),
            error => Err(GlError::new(format!("OpenGL could not convert the environment (error {error:#06x})"))),
        }
    }
}

/// A source on the GPU; freed when dropped.
struct SourceTexture {
    texture: TextureObject,
    from_cubemap: bool,
    /// Without borders.
    size: [u32; 2],
}

impl SourceTexture {
    fn upload(gl: &Gl, from: &EnvironmentRef<'_>, sheets: &TexelLayers<'_>) -> Result<Self, GlError> {
        let texture = TextureObject::array(gl, "conversion's source")?;
        gl.tex_image_3d(
            glow::TEXTURE_2D_ARRAY,
            0,
            glow::RGBA32F,
            [sheets.width as i32, sheets.height as i32, sheets.layers as i32],
            Texels::f32(glow::RGBA, bytemuck::cast_slice(&sheets.texels)),
        );
        // Drivers need not filter floats, and the texels are only fetched: with these parameters the texture is complete.
        for parameter in [glow::TEXTURE_MIN_FILTER, glow::TEXTURE_MAG_FILTER] {
            gl.tex_parameter_i32(glow::TEXTURE_2D_ARRAY, parameter, glow::NEAREST as i32);
        }
        gl.tex_parameter_i32(glow::TEXTURE_2D_ARRAY, glow::TEXTURE_MAX_LEVEL, 0);
        if gl.get_error() != glow::NO_ERROR {
            return Err(GlError::new(format!(
                "the driver has no memory for {} pictures of {} x {} floats; convert on the CPU",
                sheets.layers, sheets.width, sheets.height
            )));
        }
        let border = 2 * sheets.border;
        let size = [sheets.width - border, sheets.height - border];
        Ok(SourceTexture { texture, from_cubemap: matches!(from, EnvironmentRef::Cubemap(_)), size })
    }
}

/// Vertex and fragment shader.
fn sources(dialect: Dialect, from_cubemap: bool, target: OutputLayout, filter: Filter) -> [String; 2] {
    let mut text = dialect.header().to_owned();
    if dialect == Dialect::Es300 {
        text.push_str("precision highp sampler2DArray;\n");
    }
    let mut define = |name: &str, value: &str| {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "#define {name} {value}");
    };
    for (number, kind) in Filter::ALL.iter().enumerate() {
        define(&format!("FILTER_{}", kind.name().to_ascii_uppercase()), &number.to_string());
    }
    define("FILTER", &format!("FILTER_{}", filter.name().to_ascii_uppercase()));
    define("FROM_CUBEMAP", if from_cubemap { "1" } else { "0" });
    define("TO_CUBEMAP", if target == OutputLayout::Cubemap { "1" } else { "0" });
    define("SOURCE_BORDER", &convert::BORDER.to_string());
    define("MOST_ALONG", &convert::MOST_ALONG.to_string());
    define("CROWDED", &format!("{:e}", panorama::CROWDED));
    define("PI", &format!("{:e}", std::f64::consts::PI));
    // Horner's scheme, innermost the highest power.
    let polynomial = convert::ARC_TANGENT.iter().rev().fold(String::new(), |inner, factor| {
        if inner.is_empty() { format!("{factor:e}") } else { format!("({inner} * square + {factor:e})") }
    });
    define("ARC_TANGENT_POLYNOMIAL", &polynomial);
    let fragment = [text.as_str(), shader_text!("../shaders/conversion.frag")].concat();
    let vertex = [dialect.header(), shader_text!("../shaders/output.vert")].concat();
    [vertex, fragment]
}
