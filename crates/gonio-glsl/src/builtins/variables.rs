//! The built-in variables (GLSL 4.60 and GLSL ES 3.20, chapter 7; GLSL 1.20 for those removed from the core profile).

use std::sync::LazyLock;

use crate::{Stage, Type, Version};

/// A built-in variable.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Builtin {
    /// `None` for the structs of old OpenGL, whose members are not known here.
    pub ty: Option<Type>,
    pub is_writable: bool,
}

/// Returns the variable of this name in this stage and version; `Err` if only other versions have it.
pub(crate) fn variable(name: &str, stage: Stage, version: Version) -> Option<Result<Builtin, ()>> {
    if name.starts_with("gl_Max") || name.starts_with("gl_Min") {
        return Some(Ok(Builtin { ty: Some(Type::INT), is_writable: false }));
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
            return Some(Ok(Builtin { ty: row.ty.clone(), is_writable: row.is_writable }));
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
        let ty = match ty.strip_suffix("[]") {
            Some(of) => Type::named(of).map(|t| Type::Array(Box::new(t), None)),
            None => Type::named(ty),
        };
        Some(Row { name, stages, is_writable: access == "w", desktop: range(desktop), es: range(es), ty })
    };
    TABLE.lines().filter_map(row).collect()
});

/// Returns the names in this stage, for suggestions.
pub(crate) fn variable_names(stage: Stage) -> impl Iterator<Item = &'static str> {
    let letter = if stage == Stage::Vertex { 'v' } else { 'f' };
    // The first ones are those of current versions.
    ROWS.iter().take(20).filter(move |row| row.stages.contains(letter)).map(|row| row.name)
}

/// Name, stages, whether it is writable, desktop versions, ES versions (0: none), type (`?`: an old struct).
const TABLE: &str = "
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
gl_DepthRange vf r 110 100 ?
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
gl_LightSource vf r 110-139 0 ?
gl_LightModel vf r 110-139 0 ?
gl_FrontMaterial vf r 110-139 0 ?
gl_BackMaterial vf r 110-139 0 ?
gl_FrontLightModelProduct vf r 110-139 0 ?
gl_BackLightModelProduct vf r 110-139 0 ?
gl_FrontLightProduct vf r 110-139 0 ?
gl_BackLightProduct vf r 110-139 0 ?
gl_Point vf r 110-139 0 ?
gl_Fog vf r 110-139 0 ?
gl_TextureEnvColor vf r 110-139 0 ?
gl_ClipPlane vf r 110-139 0 ?
";
