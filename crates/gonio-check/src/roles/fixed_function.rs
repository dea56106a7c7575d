//! The state of OpenGL's old pipeline (`gl_ModelViewMatrix`, `gl_LightSource[0].position`), whose meanings the
//! specification fixes (GLSL 1.20, section 7.5).

use super::file::Meaning;
use super::role::Role;

/// Prefixes: the name in the source, and that of the uniform or attribute which replaces it in the translated text.
const PREFIXES: [&str; 2] = ["gl_", "gonio_"];

/// A light with this cutoff shines in all directions.
const NO_SPOT: f32 = 180.0;

/// The length of `gl_TextureMatrix`: the least `gl_MaxTextureCoords` that drivers have.
const TEXTURE_MATRICES: usize = 8;

/// Far behind all test scenes, in world units.
const END_OF_FOG: f32 = 1e6;

/// Returns the meaning of a variable of the old pipeline; `None` if it is none, or has no value in the test scenes.
///
/// Ambient light that belongs to no light (`gl_LightModel`) is dark, no light is a spot, and there is no fog: a program
/// that adds these draws the right picture without them.
pub(super) fn meaning(name: &str) -> Option<Meaning> {
    let name = PREFIXES.iter().find_map(|prefix| name.strip_prefix(prefix))?;
    let role = |role: Role| Some(Meaning::Role(role));
    let value = |numbers: &[f32]| Some(Meaning::Value(numbers.to_vec()));
    let (variable, member) = match name.split_once('.') {
        Some((variable, member)) => (variable, Some(member)),
        None => (name, None),
    };
    let (variable, light) = match variable.split_once('[') {
        Some((variable, index)) => (variable, index.trim_end_matches(']').parse().unwrap_or(0)),
        None => (variable, 0),
    };
    match (variable, member) {
        ("Vertex", None) => role(Role::Position),
        ("Normal", None) => role(Role::Normal),
        ("Color" | "VertexColor", None) => role(Role::Color),
        (name, None) if name.starts_with("MultiTexCoord") => role(Role::TexCoord),
        ("TextureMatrix", None) => {
            let identity = [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0];
            value(&identity.repeat(TEXTURE_MATRICES))
        }
        ("ModelViewMatrix", None) => role(Role::ModelView),
        ("ProjectionMatrix", None) => role(Role::Projection),
        ("ModelViewProjectionMatrix", None) => role(Role::ModelViewProjection),
        ("NormalMatrix", None) => role(Role::NormalMatrixOfModelView),
        ("NormalScale", None) => value(&[1.0]),
        ("LightSource", Some(member)) => of_light(member, light),
        ("FrontLightProduct" | "BackLightProduct", Some(member)) => of_light(member, light),
        ("FrontMaterial" | "BackMaterial", Some("emission")) => role(Role::Emitted),
        ("FrontMaterial" | "BackMaterial", Some("ambient")) => role(Role::MaterialAmbient),
        ("FrontMaterial" | "BackMaterial", Some("diffuse")) => role(Role::MaterialDiffuse),
        ("FrontMaterial" | "BackMaterial", Some("specular")) => role(Role::MaterialSpecular),
        ("FrontMaterial" | "BackMaterial", Some("shininess")) => role(Role::Shininess),
        ("LightModel", Some("ambient")) => value(&[0.0, 0.0, 0.0, 1.0]),
        ("FrontLightModelProduct" | "BackLightModelProduct", Some("sceneColor")) => value(&[0.0, 0.0, 0.0, 1.0]),
        ("Fog", Some("end")) => value(&[END_OF_FOG]),
        ("Fog", Some("scale")) => value(&[1.0 / END_OF_FOG]),
        ("Fog", Some("density" | "start")) => value(&[0.0]),
        ("Fog", Some("color")) => value(&[0.0; 4]),
        _ => None,
    }
}

fn of_light(member: &str, light: u32) -> Option<Meaning> {
    Some(Meaning::Role(match member {
        "ambient" => Role::AmbientColor(light),
        "diffuse" => Role::DiffuseColor(light),
        "specular" => Role::SpecularColor(light),
        "position" => Role::LightPosInView(light),
        "halfVector" => Role::LightHalfVector(light),
        "constantAttenuation" => Role::AttenuationConstant(light),
        "linearAttenuation" => Role::AttenuationLinear(light),
        "quadraticAttenuation" => Role::AttenuationQuadratic(light),
        "spotDirection" => return Some(Meaning::Value(vec![0.0, 0.0, -1.0])),
        "spotExponent" => return Some(Meaning::Value(vec![0.0])),
        "spotCutoff" => return Some(Meaning::Value(vec![NO_SPOT])),
        "spotCosCutoff" => return Some(Meaning::Value(vec![-1.0])),
        _ => return None,
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_old_pipeline_has_fixed_meanings() {
        for (name, role) in [
            ("gl_Vertex", Role::Position),
            ("gonio_VertexColor", Role::Color),
            ("gl_NormalMatrix", Role::NormalMatrixOfModelView),
            ("gl_LightSource[2].position", Role::LightPosInView(2)),
            ("gonio_LightSource[0].linearAttenuation", Role::AttenuationLinear(0)),
            ("gl_FrontLightProduct[1].specular", Role::SpecularColor(1)),
            ("gl_BackMaterial.shininess", Role::Shininess),
        ] {
            assert_eq!(meaning(name), Some(Meaning::Role(role)), "{name}");
        }
        assert_eq!(meaning("gl_LightSource[0].spotCosCutoff"), Some(Meaning::Value(vec![-1.0])));
        for name in ["gl_VertexID", "gl_LightSource[0]", "gl_FrontMaterial.gloss", "Vertex", "glNormal"] {
            assert_eq!(meaning(name), None, "{name}");
        }
    }
}
