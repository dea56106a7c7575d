// The material at a fragment: its numbers times its textures.

uniform vec4 k_ambient;    // a: 1 if k_a follows k_d
uniform vec3 k_diffuse;
uniform vec3 k_specular;
uniform vec3 k_emitted;
#if !VERTEX_LIT || ENVIRONMENT_LIGHT
uniform float shininess;
#endif
uniform float opacity;

// Each texture on its own unit, with the transform from texture coordinates to its picture.
#if DIFFUSE_MAP
uniform sampler2D diffuse_map;
uniform mat3x2 diffuse_map_transform;
#endif
#if OTHER_MAPS
uniform sampler2D specular_map;
uniform mat3x2 specular_map_transform;
uniform sampler2D emitted_map;
uniform mat3x2 emitted_map_transform;
uniform float roughness;   // not negative: shininess_map holds factors of it
uniform sampler2D shininess_map;
uniform mat3x2 shininess_map_transform;
uniform sampler2D opacity_map;
uniform mat3x2 opacity_map_transform;
#endif
#if NORMAL_MAP
uniform sampler2D normal_map;
uniform mat3x2 normal_map_transform;
#endif

struct Surface {
    vec3 ambient;
    vec3 diffuse;
    vec3 specular;
    vec3 emitted;
    float shininess;
    float opacity;
};

// Textures of data are stored as 2 t - 1 in half floats.
float data_texel(vec4 stored) {
    return 0.5 * stored.r + 0.5;
}

vec4 map_texel(sampler2D map, mat3x2 transform, vec2 uv) {
    return texture(map, transform * vec3(uv, 1.0));
}

Surface surface_at(vec2 uv, vec3 vertex_color) {
    Surface s;
    s.diffuse = k_diffuse * vertex_color;
#if DIFFUSE_MAP
    s.diffuse *= map_texel(diffuse_map, diffuse_map_transform, uv).rgb;
#endif
    s.ambient = mix(k_ambient.rgb, s.diffuse, k_ambient.a);
    s.specular = k_specular;
    s.emitted = k_emitted;
#if VERTEX_LIT && !ENVIRONMENT_LIGHT
    s.shininess = 1.0;   // was used at the vertices
#else
    s.shininess = shininess;
#endif
    s.opacity = opacity;
#if OTHER_MAPS
    s.specular *= map_texel(specular_map, specular_map_transform, uv).rgb;
    s.emitted *= map_texel(emitted_map, emitted_map_transform, uv).rgb;
#if !VERTEX_LIT || ENVIRONMENT_LIGHT
    float factor = data_texel(map_texel(shininess_map, shininess_map_transform, uv));
    s.shininess = roughness < 0.0 ? max(s.shininess * factor, 1.0) : shininess_of_roughness(roughness * factor);
#endif
    s.opacity *= data_texel(map_texel(opacity_map, opacity_map_transform, uv));
#endif
    return s;
}
