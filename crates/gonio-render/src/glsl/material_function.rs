//! The BRDFs of materials as parts of scene programs.

use crate::shader_text::shader_text;
use gonio_bsdf::merl;
use gonio_scene::MaterialBrdf;
use std::sync::Arc;

/// Texels in a row of a MERL table: a divisor of its cells, so that it has 900 rows.
pub const MERL_WIDTH: usize = merl::CELLS / 900;

const MERL: &str = shader_text!("../../shaders/merl.glsl");

/// A smooth boundary: 0 but for single directions.
const NOTHING: &str = "vec3 gonioBrdfBRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y) { return vec3(0.0); }\n";

/// The number of a function that a renderer knows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct FunctionId(usize);

impl FunctionId {
    /// No function.
    pub const NONE: FunctionId = FunctionId(usize::MAX);
}

/// The text of a function `vec3 gonioBrdfBRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y)`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MaterialFunction(Arc<str>);

impl MaterialFunction {
    /// The function of a BRDF.
    ///
    /// # Errors
    ///
    /// The reason why it cannot be a part of a shader.
    pub fn new(brdf: &MaterialBrdf) -> Result<Self, String> {
        match (&brdf.table, &brdf.shader) {
            (Some(_), _) => Ok(MaterialFunction(MERL.into())),
            (None, Some(Ok(text))) => Ok(MaterialFunction(Arc::from(format!("{text}\n")))),
            (None, None) => Ok(MaterialFunction(NOTHING.into())),
            (None, Some(Err(error))) => Err(format!(
                "the BRDF `{}` cannot be drawn by OpenGL, but by the CPU reference and the path tracer: {error}",
                brdf.name
            )),
        }
    }

    /// The text.
    pub fn text(&self) -> &str {
        &self.0
    }
}

/// The functions that a renderer has drawn with.
#[derive(Debug, Default)]
pub struct MaterialFunctions(Vec<MaterialFunction>);

impl MaterialFunctions {
    /// The number of a function.
    pub fn id_of(&mut self, function: MaterialFunction) -> FunctionId {
        let known = self.0.iter().position(|known| *known == function);
        FunctionId(known.unwrap_or_else(|| {
            self.0.push(function);
            self.0.len() - 1
        }))
    }

    /// The text of a function; empty for [`FunctionId::NONE`].
    pub fn text(&self, id: FunctionId) -> &str {
        self.0.get(id.0).map_or("", MaterialFunction::text)
    }
}
