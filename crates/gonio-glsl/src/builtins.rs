//! The built-in functions and variables, each with the versions that have it (GLSL 4.60 and GLSL ES 3.20, chapter 8; GLSL 1.10 and ES 1.00 for the old texture functions).
//!
//! The columns of a line are: the first desktop version, the first ES version (0: none), the return type, the name, the
//! parameters. The words are those of the specification: `genType` is float, vec2, vec3 or vec4, the same one in the
//! whole line; `gvec4` goes with `gsampler2D`, `ivec4` with `isampler2D`. Parameters after a `|` are optional.

use crate::{Stage, Type, Version};
use std::collections::HashMap;
use std::sync::LazyLock;

/// A signature of a function.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Signature {
    pub params: Vec<Type>,
    /// Whether each parameter is written to.
    pub outs: Vec<bool>,
    pub returns: Type,
}

struct Line {
    params: Vec<&'static str>,
    returns: &'static str,
}

/// A signature, and the first versions (desktop, ES) that have it.
type Known = (u32, u32, Signature);

static FUNCTIONS: LazyLock<HashMap<&'static str, Vec<Known>>> = LazyLock::new(|| {
    let mut found: HashMap<&'static str, Vec<Known>> = HashMap::new();
    for line in FUNCTION_TABLE.lines() {
        let Some((head, rest)) = line.split_once('(') else { continue };
        let head: Vec<&'static str> = head.split_ascii_whitespace().collect();
        let [desktop, es, returns, names] = head[..] else { continue };
        let (desktop, es) = (desktop.parse().unwrap_or(0), es.parse().unwrap_or(0));
        let rest = rest.trim_end_matches(')');
        // Parameters after a `|` are optional.
        let full: Vec<&'static str> = rest.split([',', '|']).map(str::trim).filter(|p| !p.is_empty()).collect();
        let mut ways = vec![Line { params: full.clone(), returns }];
        if rest.contains('|') {
            ways.push(Line { params: full[..full.len() - 1].to_vec(), returns });
        }
        let signatures: Vec<Signature> =
            ways.iter().flat_map(|way| (0..12).filter_map(|variant| signature(way, variant))).collect();
        for name in names.split('/') {
            let list = found.entry(name).or_default();
            for signature in &signatures {
                let known = (desktop, es, signature.clone());
                if !list.contains(&known) {
                    list.push(known);
                }
            }
        }
    }
    found
});

/// Whether any version has a function of this name.
pub(crate) fn is_name(name: &str) -> bool {
    FUNCTIONS.contains_key(name)
}

/// Whether this version has a function of this name.
pub(crate) fn exists(name: &str, version: Version) -> bool {
    FUNCTIONS.get(name).is_some_and(|list| list.iter().any(|l| version.is_at_least(l.0, l.1)))
}

/// Returns all signatures of a function, including those of later versions if `later`.
pub(crate) fn signatures(
    name: &str,
    version: Version,
    later: bool,
) -> impl Iterator<Item = &'static Signature> + use<> {
    let list = FUNCTIONS.get(name).map_or(&[][..], Vec::as_slice);
    list.iter().filter(move |l| later || version.is_at_least(l.0, l.1)).map(|l| &l.2)
}

/// Instantiates the generic words of a line: variant 0..4 is the number of components, 0, 4, 8 the sampler's letter.
fn signature(line: &Line, variant: usize) -> Option<Signature> {
    let mut params = Vec::new();
    let mut outs = Vec::new();
    for param in &line.params {
        let (is_out, word) = match param.strip_prefix("out ").or_else(|| param.strip_prefix("inout ")) {
            Some(word) => (true, word),
            None => (false, *param),
        };
        params.push(particular(word, variant)?);
        outs.push(is_out);
    }
    Some(Signature { params, outs, returns: particular(line.returns, variant)? })
}

fn particular(word: &str, variant: usize) -> Option<Type> {
    use crate::Scalar::{Bool, Float, Int, UInt};
    let count = (variant % 4 + 1) as u8;
    let vector = |scalar| (count > 1).then_some(Type::Vector(scalar, count));
    match word {
        "genType" => Some(Type::scalar_or_vector(Float, count)),
        "genIType" => Some(Type::scalar_or_vector(Int, count)),
        "genUType" => Some(Type::scalar_or_vector(UInt, count)),
        "genBType" => Some(Type::scalar_or_vector(Bool, count)),
        "vec" => vector(Float),
        "ivec" => vector(Int),
        "uvec" => vector(UInt),
        "bvec" => vector(Bool),
        "mat" => (count > 1).then_some(Type::Matrix { scalar: Float, columns: count, rows: count }),
        _ => match word.strip_prefix('g') {
            Some(rest) => Type::named(&format!("{}{rest}", ["", "i", "u"][variant / 4])),
            None => Type::named(word),
        },
    }
}

const FUNCTION_TABLE: &str = "
110 100 genType radians/degrees/sin/cos/tan/asin/acos/exp/log/exp2/log2/sqrt/inversesqrt/abs/sign/floor/ceil/fract(genType)
110 100 genType atan(genType | genType)
130 300 genType sinh/cosh/tanh/asinh/acosh/atanh/trunc/round/roundEven(genType)
110 100 genType pow/mod/min/max(genType, genType)
110 100 genType mod/min/max(genType, float)
130 300 genIType abs/sign(genIType)
130 300 genType modf(genType, out genType)
130 300 genIType min/max(genIType, genIType)
130 300 genIType min/max(genIType, int)
130 300 genUType min/max(genUType, genUType)
130 300 genUType min/max(genUType, uint)
110 100 genType clamp(genType, genType, genType)
110 100 genType clamp(genType, float, float)
130 300 genIType clamp(genIType, genIType, genIType)
130 300 genIType clamp(genIType, int, int)
130 300 genUType clamp(genUType, genUType, genUType)
130 300 genUType clamp(genUType, uint, uint)
110 100 genType mix(genType, genType, genType)
110 100 genType mix(genType, genType, float)
130 300 genType mix(genType, genType, genBType)
450 310 genIType mix(genIType, genIType, genBType)
450 310 genUType mix(genUType, genUType, genBType)
450 310 genBType mix(genBType, genBType, genBType)
110 100 genType step(genType, genType)
110 100 genType step(float, genType)
110 100 genType smoothstep(genType, genType, genType)
110 100 genType smoothstep(float, float, genType)
130 300 genBType isnan/isinf(genType)
330 300 genIType floatBitsToInt(genType)
330 300 genUType floatBitsToUint(genType)
330 300 genType intBitsToFloat(genIType)
330 300 genType uintBitsToFloat(genUType)
400 320 genType fma(genType, genType, genType)
400 310 genType frexp(genType, out genIType)
400 310 genType ldexp(genType, genIType)
420 300 uint packUnorm2x16/packSnorm2x16/packHalf2x16(vec2)
420 300 vec2 unpackUnorm2x16/unpackSnorm2x16/unpackHalf2x16(uint)
400 310 uint packUnorm4x8/packSnorm4x8(vec4)
400 310 vec4 unpackUnorm4x8/unpackSnorm4x8(uint)
110 100 float length(genType)
110 100 float distance/dot(genType, genType)
110 100 vec3 cross(vec3, vec3)
110 100 genType normalize(genType)
110 0 vec4 ftransform()
110 100 genType faceforward(genType, genType, genType)
110 100 genType reflect(genType, genType)
110 100 genType refract(genType, genType, float)
110 100 mat matrixCompMult(mat, mat)
120 300 mat2x3 matrixCompMult(mat2x3, mat2x3)
120 300 mat2x4 matrixCompMult(mat2x4, mat2x4)
120 300 mat3x2 matrixCompMult(mat3x2, mat3x2)
120 300 mat3x4 matrixCompMult(mat3x4, mat3x4)
120 300 mat4x2 matrixCompMult(mat4x2, mat4x2)
120 300 mat4x3 matrixCompMult(mat4x3, mat4x3)
120 300 mat2 outerProduct(vec2, vec2)
120 300 mat3 outerProduct(vec3, vec3)
120 300 mat4 outerProduct(vec4, vec4)
120 300 mat2x3 outerProduct(vec3, vec2)
120 300 mat3x2 outerProduct(vec2, vec3)
120 300 mat2x4 outerProduct(vec4, vec2)
120 300 mat4x2 outerProduct(vec2, vec4)
120 300 mat3x4 outerProduct(vec4, vec3)
120 300 mat4x3 outerProduct(vec3, vec4)
120 300 mat transpose(mat)
120 300 mat2x3 transpose(mat3x2)
120 300 mat3x2 transpose(mat2x3)
120 300 mat2x4 transpose(mat4x2)
120 300 mat4x2 transpose(mat2x4)
120 300 mat3x4 transpose(mat4x3)
120 300 mat4x3 transpose(mat3x4)
150 300 float determinant(mat)
140 300 mat inverse(mat)
110 100 bvec lessThan/lessThanEqual/greaterThan/greaterThanEqual/equal/notEqual(vec, vec)
110 100 bvec lessThan/lessThanEqual/greaterThan/greaterThanEqual/equal/notEqual(ivec, ivec)
130 300 bvec lessThan/lessThanEqual/greaterThan/greaterThanEqual/equal/notEqual(uvec, uvec)
110 100 bvec equal/notEqual(bvec, bvec)
110 100 bool any/all(bvec)
110 100 bvec not(bvec)
400 310 genIType bitfieldExtract(genIType, int, int)
400 310 genUType bitfieldExtract(genUType, int, int)
400 310 genIType bitfieldReverse(genIType)
400 310 genUType bitfieldReverse(genUType)
400 310 genIType bitCount/findLSB/findMSB(genIType)
400 310 genIType bitCount/findLSB/findMSB(genUType)
110 300 genType dFdx/dFdy/fwidth(genType)
450 0 genType dFdxFine/dFdyFine/fwidthFine/dFdxCoarse/dFdyCoarse/fwidthCoarse(genType)
110 0 float noise1(genType)
110 0 vec2 noise2(genType)
110 0 vec3 noise3(genType)
110 0 vec4 noise4(genType)
110 0 vec4 texture1D(sampler1D, float | float)
110 0 vec4 texture1DProj(sampler1D, vec2 | float)
110 0 vec4 texture1DProj(sampler1D, vec4 | float)
110 0 vec4 texture1DLod(sampler1D, float, float)
110 100 vec4 texture2D(sampler2D, vec2 | float)
110 100 vec4 texture2DProj(sampler2D, vec3 | float)
110 100 vec4 texture2DProj(sampler2D, vec4 | float)
110 100 vec4 texture2DLod(sampler2D, vec2, float)
110 100 vec4 texture2DLodEXT(sampler2D, vec2, float)
110 100 vec4 texture2DProjLod(sampler2D, vec3, float)
110 100 vec4 texture2DProjLod(sampler2D, vec4, float)
110 100 vec4 texture2DGradEXT/texture2DGradARB(sampler2D, vec2, vec2, vec2)
110 0 vec4 texture3D(sampler3D, vec3 | float)
110 0 vec4 texture3DProj(sampler3D, vec4 | float)
110 0 vec4 texture3DLod(sampler3D, vec3, float)
110 100 vec4 textureCube(samplerCube, vec3 | float)
110 100 vec4 textureCubeLod/textureCubeLodEXT(samplerCube, vec3, float)
110 100 vec4 textureCubeGradEXT/textureCubeGradARB(samplerCube, vec3, vec3, vec3)
110 0 vec4 shadow1D(sampler1DShadow, vec3 | float)
110 0 vec4 shadow2D(sampler2DShadow, vec3 | float)
110 0 vec4 shadow2DProj(sampler2DShadow, vec4 | float)
130 0 int textureSize(gsampler1D, int)
130 300 ivec2 textureSize(gsampler2D, int)
130 300 ivec3 textureSize(gsampler3D, int)
130 300 ivec2 textureSize(gsamplerCube, int)
130 300 ivec2 textureSize(sampler2DShadow, int)
130 300 ivec2 textureSize(samplerCubeShadow, int)
130 300 ivec3 textureSize(gsampler2DArray, int)
130 300 ivec3 textureSize(sampler2DArrayShadow, int)
130 0 ivec2 textureSize(gsampler1DArray, int)
140 0 ivec2 textureSize(gsampler2DRect)
140 320 int textureSize(gsamplerBuffer)
150 310 ivec2 textureSize(gsampler2DMS)
400 320 ivec3 textureSize(gsamplerCubeArray, int)
400 0 vec2 textureQueryLod(gsampler2D, vec2)
400 0 vec2 textureQueryLod(gsamplerCube, vec3)
430 0 int textureQueryLevels(gsampler2D)
430 0 int textureQueryLevels(gsamplerCube)
130 0 gvec4 texture(gsampler1D, float | float)
130 300 gvec4 texture(gsampler2D, vec2 | float)
130 300 gvec4 texture(gsampler3D, vec3 | float)
130 300 gvec4 texture(gsamplerCube, vec3 | float)
130 0 float texture(sampler1DShadow, vec3 | float)
130 300 float texture(sampler2DShadow, vec3 | float)
130 300 float texture(samplerCubeShadow, vec4 | float)
130 0 gvec4 texture(gsampler1DArray, vec2 | float)
130 300 gvec4 texture(gsampler2DArray, vec3 | float)
130 300 float texture(sampler2DArrayShadow, vec4)
140 0 gvec4 texture(gsampler2DRect, vec2)
400 320 gvec4 texture(gsamplerCubeArray, vec4 | float)
130 0 gvec4 textureProj(gsampler1D, vec2 | float)
130 300 gvec4 textureProj(gsampler2D, vec3 | float)
130 300 gvec4 textureProj(gsampler2D, vec4 | float)
130 300 gvec4 textureProj(gsampler3D, vec4 | float)
130 300 float textureProj(sampler2DShadow, vec4 | float)
130 0 gvec4 textureLod(gsampler1D, float, float)
130 300 gvec4 textureLod(gsampler2D, vec2, float)
130 300 gvec4 textureLod(gsampler3D, vec3, float)
130 300 gvec4 textureLod(gsamplerCube, vec3, float)
130 300 gvec4 textureLod(gsampler2DArray, vec3, float)
130 300 float textureLod(sampler2DShadow, vec3, float)
400 320 gvec4 textureLod(gsamplerCubeArray, vec4, float)
130 300 gvec4 textureProjLod(gsampler2D, vec3, float)
130 300 gvec4 textureProjLod(gsampler2D, vec4, float)
130 300 gvec4 textureProjLod(gsampler3D, vec4, float)
130 300 gvec4 textureOffset(gsampler2D, vec2, ivec2 | float)
130 300 gvec4 textureOffset(gsampler3D, vec3, ivec3 | float)
130 300 float textureOffset(sampler2DShadow, vec3, ivec2 | float)
130 300 gvec4 textureOffset(gsampler2DArray, vec3, ivec2 | float)
130 300 gvec4 textureLodOffset(gsampler2D, vec2, float, ivec2)
130 300 gvec4 textureLodOffset(gsampler3D, vec3, float, ivec3)
130 300 gvec4 textureGrad(gsampler2D, vec2, vec2, vec2)
130 300 gvec4 textureGrad(gsampler3D, vec3, vec3, vec3)
130 300 gvec4 textureGrad(gsamplerCube, vec3, vec3, vec3)
130 300 gvec4 textureGrad(gsampler2DArray, vec3, vec2, vec2)
130 0 gvec4 texelFetch(gsampler1D, int, int)
130 300 gvec4 texelFetch(gsampler2D, ivec2, int)
130 300 gvec4 texelFetch(gsampler3D, ivec3, int)
130 300 gvec4 texelFetch(gsampler2DArray, ivec3, int)
140 0 gvec4 texelFetch(gsampler2DRect, ivec2)
140 320 gvec4 texelFetch(gsamplerBuffer, int)
150 310 gvec4 texelFetch(gsampler2DMS, ivec2, int)
130 300 gvec4 texelFetchOffset(gsampler2D, ivec2, int, ivec2)
400 310 gvec4 textureGather(gsampler2D, vec2 | int)
400 310 gvec4 textureGather(gsamplerCube, vec3 | int)
400 310 gvec4 textureGather(gsampler2DArray, vec3 | int)
400 310 vec4 textureGather(sampler2DShadow, vec2, float)
400 310 gvec4 textureGatherOffset(gsampler2D, vec2, ivec2 | int)
400 320 genType interpolateAtCentroid(genType)
400 320 genType interpolateAtSample(genType, int)
400 320 genType interpolateAtOffset(genType, vec2)
400 310 genUType uaddCarry/usubBorrow(genUType, genUType, out genUType)
";

/// A built-in variable.
#[derive(Debug, Clone, PartialEq)]
pub struct BuiltinVariable {
    /// Its type; an array without a size may have as many elements as the implementation allows.
    pub ty: Option<Type>,
    /// Whether the shader may assign to it.
    pub is_writable: bool,
}

/// Returns the built-in variable of this name in a stage and version.
#[must_use]
pub fn builtin_variable(name: &str, stage: Stage, version: Version) -> Option<BuiltinVariable> {
    variable(name, stage, version)?.ok()
}

/// Returns the variable of this name in this stage and version; `Err` if only other versions have it.
pub(crate) fn variable(name: &str, stage: Stage, version: Version) -> Option<Result<BuiltinVariable, ()>> {
    if name.starts_with("gl_Max") || name.starts_with("gl_Min") {
        return Some(Ok(BuiltinVariable { ty: Some(Type::INT), is_writable: false }));
    }
    // All names have this prefix; most others do not.
    if !name.starts_with("gl_") {
        return None;
    }
    let letter = if stage == Stage::Vertex { 'v' } else { 'f' };
    let mut is_elsewhere = false;
    for row in ROWS.iter().filter(|row| row.name == name) {
        let (from, to) = if version.es { row.es } else { row.desktop };
        let is_in_range = from != 0 && (from..=to).contains(&version.number);
        if row.stages.contains(letter) && (is_in_range || (version.compatibility && !version.es)) {
            return Some(Ok(BuiltinVariable { ty: row.ty.clone(), is_writable: row.is_writable }));
        }
        is_elsewhere = true;
    }
    is_elsewhere.then_some(Err(()))
}

struct Row {
    name: &'static str,
    stages: &'static str,
    is_writable: bool,
    desktop: (u32, u32),
    es: (u32, u32),
    ty: Option<Type>,
}

static ROWS: LazyLock<Vec<Row>> = LazyLock::new(|| {
    let range = |text: &str| {
        let (from, to) = text.split_once('-').unwrap_or((text, "9999"));
        (from.parse().unwrap_or(0), to.parse().unwrap_or(9999))
    };
    let row = |line: &'static str| {
        let words: Vec<&'static str> = line.split_ascii_whitespace().collect();
        let [name, stages, access, desktop, es, ty] = words[..] else { return None };
        let basic = |word: &str| Type::named(word).or_else(|| Some(Type::Struct(word.to_string())));
        let ty = match ty.strip_suffix("[]") {
            Some(of) => basic(of).map(|t| Type::Array(Box::new(t), None)),
            None => basic(ty),
        };
        Some(Row { name, stages, is_writable: access == "w", desktop: range(desktop), es: range(es), ty })
    };
    VARIABLE_TABLE.lines().filter_map(row).collect()
});

/// Returns the names in this stage, for suggestions.
pub(crate) fn variable_names(stage: Stage) -> impl Iterator<Item = &'static str> {
    let letter = if stage == Stage::Vertex { 'v' } else { 'f' };
    // The first ones are those of current versions.
    ROWS.iter().take(20).filter(move |row| row.stages.contains(letter)).map(|row| row.name)
}

/// Name, stages, whether it is writable, desktop versions, ES versions (0: none), type.
const VARIABLE_TABLE: &str = "
gl_Position v w 110 100 vec4
gl_PointSize v w 110 100 float
gl_VertexID v r 130 300 int
gl_InstanceID v r 140 300 int
gl_FragCoord f r 110 100 vec4
gl_FrontFacing f r 110 100 bool
gl_PointCoord f r 120 100 vec2
gl_FragDepth f w 110 300 float
gl_FragColor f w 110-419 100-100 vec4
gl_FragData f w 110-419 100-100 vec4[]
gl_ClipDistance v w 130 0 float[]
gl_ClipDistance f r 130 0 float[]
gl_CullDistance v w 450 0 float[]
gl_CullDistance f r 450 0 float[]
gl_PrimitiveID f r 150 320 int
gl_SampleID f r 400 320 int
gl_SamplePosition f r 400 320 vec2
gl_SampleMaskIn f r 400 320 int[]
gl_SampleMask f w 400 320 int[]
gl_Layer f r 430 320 int
gl_ViewportIndex f r 430 0 int
gl_HelperInvocation f r 450 310 bool
gl_BaseVertex v r 460 0 int
gl_BaseInstance v r 460 0 int
gl_DrawID v r 460 0 int
gl_NumSamples f r 400 320 int
gl_DepthRange vf r 110 100 gl_DepthRangeParameters
gl_Vertex v r 110-139 0 vec4
gl_Normal v r 110-139 0 vec3
gl_Color vf r 110-139 0 vec4
gl_SecondaryColor vf r 110-139 0 vec4
gl_MultiTexCoord0 v r 110-139 0 vec4
gl_MultiTexCoord1 v r 110-139 0 vec4
gl_MultiTexCoord2 v r 110-139 0 vec4
gl_MultiTexCoord3 v r 110-139 0 vec4
gl_MultiTexCoord4 v r 110-139 0 vec4
gl_MultiTexCoord5 v r 110-139 0 vec4
gl_MultiTexCoord6 v r 110-139 0 vec4
gl_MultiTexCoord7 v r 110-139 0 vec4
gl_FogCoord v r 110-139 0 float
gl_ClipVertex v w 110-139 0 vec4
gl_FrontColor v w 110-139 0 vec4
gl_BackColor v w 110-139 0 vec4
gl_FrontSecondaryColor v w 110-139 0 vec4
gl_BackSecondaryColor v w 110-139 0 vec4
gl_TexCoord v w 110-139 0 vec4[]
gl_TexCoord f r 110-139 0 vec4[]
gl_FogFragCoord v w 110-139 0 float
gl_FogFragCoord f r 110-139 0 float
gl_ModelViewMatrix vf r 110-139 0 mat4
gl_ProjectionMatrix vf r 110-139 0 mat4
gl_ModelViewProjectionMatrix vf r 110-139 0 mat4
gl_NormalMatrix vf r 110-139 0 mat3
gl_TextureMatrix vf r 110-139 0 mat4[]
gl_NormalScale vf r 110-139 0 float
gl_ModelViewMatrixInverse vf r 110-139 0 mat4
gl_ModelViewMatrixTranspose vf r 110-139 0 mat4
gl_ModelViewMatrixInverseTranspose vf r 110-139 0 mat4
gl_ProjectionMatrixInverse vf r 110-139 0 mat4
gl_ProjectionMatrixTranspose vf r 110-139 0 mat4
gl_ProjectionMatrixInverseTranspose vf r 110-139 0 mat4
gl_ModelViewProjectionMatrixInverse vf r 110-139 0 mat4
gl_ModelViewProjectionMatrixTranspose vf r 110-139 0 mat4
gl_ModelViewProjectionMatrixInverseTranspose vf r 110-139 0 mat4
gl_LightSource vf r 110-139 0 gl_LightSourceParameters[]
gl_LightModel vf r 110-139 0 gl_LightModelParameters
gl_FrontMaterial vf r 110-139 0 gl_MaterialParameters
gl_BackMaterial vf r 110-139 0 gl_MaterialParameters
gl_FrontLightModelProduct vf r 110-139 0 gl_LightModelProducts
gl_BackLightModelProduct vf r 110-139 0 gl_LightModelProducts
gl_FrontLightProduct vf r 110-139 0 gl_LightProducts[]
gl_BackLightProduct vf r 110-139 0 gl_LightProducts[]
gl_Point vf r 110-139 0 gl_PointParameters
gl_Fog vf r 110-139 0 gl_FogParameters
gl_TextureEnvColor vf r 110-139 0 vec4[]
gl_ClipPlane vf r 110-139 0 vec4[]
";
