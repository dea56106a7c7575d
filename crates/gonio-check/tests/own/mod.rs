//! gonio's own shaders, and numbers for their uniforms.

use gonio_gl::Dialect;
use gonio_render::glsl::{SceneKey, sky_sources};

/// Uniforms of gonio's own shaders: a turned and stretched object before the camera; a sun, a lamp and a spot.
pub const UNIFORMS: &[(&str, &[f32])] = &[
    ("world_from_model", &[0.9, 0.0, -0.3, 0.0, 0.0, 1.1, 0.0, 0.0, 0.2, 0.0, 0.8, 0.0, 0.1, -0.1, 0.0, 1.0]),
    // The same, 5 units away, with a focal length of 1.8, planes at 1 and 11.
    ("clip_from_model", &[1.62, 0.0, 0.36, 0.3, 0.0, 1.98, 0.0, 0.0, 0.36, 0.0, -0.96, -0.8, 0.18, -0.18, 3.8, 5.0]),
    ("normal_world_from_model", &[0.9, 0.0, -0.3, 0.0, 1.1, 0.0, 0.2, 0.0, 0.8]),
    ("eye_in_world", &[0.0, 0.0, 5.0]),
    (
        "light_values",
        &[
            -0.48, -0.6, -0.64, 0.0, 0.5, 0.6, 0.4, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 2.0, 1.5, 3.0, 0.0,
            0.9, 0.5, 0.7, 1.0, 0.0, 0.0, 0.0, 0.0, 0.5, 0.1, 0.05, 0.0, -1.5, 1.0, 3.0, 0.0, 0.3, 0.8, 0.9, 1.0, 0.45,
            -0.3, -0.84, 0.7, 1.0, 0.0, 0.02, 0.9,
        ],
    ),
    ("directional_end", &[1.0]),
    ("point_end", &[2.0]),
    ("spot_end", &[3.0]),
    ("diff_factor", &[1.0]),
    ("diffuse_switch", &[1.0]),
    ("specular_switch", &[1.0]),
    ("attenuation_switch", &[1.0]),
    ("spot_switch", &[1.0]),
    ("gated", &[1.0]),
    ("brdf_normalised", &[1.0]),
    ("lafortune_diagonal", &[-0.9, -0.8, 0.9]),
    ("ambient_light", &[0.1, 0.15, 0.1]),
    ("emitted_switch", &[1.0]),
    ("k_ambient", &[0.4, 0.3, 0.2, 0.0]),
    ("k_diffuse", &[0.7, 0.5, 0.3]),
    ("k_specular", &[0.4, 0.4, 0.5]),
    ("k_emitted", &[0.02, 0.0, 0.05]),
    ("shininess", &[12.0]),
    ("opacity", &[0.9]),
    ("environment_from_world", &[0.8, 0.0, -0.6, 0.0, 1.0, 0.0, 0.6, 0.0, 0.8]),
    ("environment_from_clip", &[0.9, 0.1, 0.0, -0.1, 0.7, 0.2, 0.3, -0.2, -1.0]),
    ("environment_intensity", &[0.8]),
    ("reflectivity", &[0.7]),
    ("transmission", &[0.6]),
    ("fresnel_kind", &[1.0]),
    ("indices", &[1.5, 1.52, 1.54]),
    ("index_count", &[3.0]),
    ("tint", &[0.9, 1.0, 0.8]),
    (
        "harmonics",
        &[
            0.5, 0.4, 0.3, 0.1, 0.2, 0.1, 0.05, 0.1, 0.2, -0.1, 0.0, 0.1, 0.05, 0.05, 0.0, 0.0, 0.1, 0.0, 0.05, 0.0,
            0.1, 0.1, 0.0, 0.0, 0.0, 0.05, 0.05,
        ],
    ),
    ("glossy_last_level", &[0.0]),
    ("environment_brdf_size", &[32.0]),
    ("environment_diffuse_switch", &[1.0]),
    ("environment_specular_switch", &[1.0]),
];

/// Words in the names of programs that are left out: textures and what needs the side of a triangle or derivatives.
const LEFT_OUT: [&str; 9] =
    ["-map", "-maps", "two-sided", "vertex-colors", " view", "shadows", "many-lights", "mipmapped", " body"];

/// Every shading and reflectance, with few lights; mirrors, glass and light of the environment; the sky. Vertex and fragment
/// shader by name.
pub fn sources() -> Vec<(String, [String; 2])> {
    let keys = SceneKey::all().into_iter().filter(|key| !LEFT_OUT.iter().any(|word| key.name().contains(word)));
    let mut sources: Vec<_> = keys.map(|key| (key.name(), key.sources(Dialect::Core330))).collect();
    sources.push(("sky".into(), sky_sources(Dialect::Core330)));
    sources
}
