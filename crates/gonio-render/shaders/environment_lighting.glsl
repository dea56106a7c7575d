// A surface in the environment's light.

uniform vec3 harmonics[9];                  // the polynomial of the irradiance
uniform highp samplerCube glossy_map;       // levels of increasing roughness
uniform float glossy_last_level;
uniform highp sampler2D environment_brdf;   // (scale, bias) over the cosine's root and the roughness
uniform float environment_brdf_size;        // texels along an edge
uniform float environment_diffuse_switch;   // 0 or 1
uniform float environment_specular_switch;

struct EnvironmentLight {
    vec3 diffuse;
    vec3 specular;
};

// Reflected light of the environment: k_d times irradiance over pi, and the split sum of glossy reflection. A surface
// without specular colour is purely matte.
EnvironmentLight environment_light(vec3 n, vec3 v, vec3 k_d, vec3 k_s, float shininess) {
    EnvironmentLight light;
    vec3 matte = irradiance(harmonics, environment_from_world * n);
    light.diffuse = (environment_diffuse_switch * environment_intensity / PI) * k_d * matte;
    float roughness = roughness_of_shininess(effective_shininess(shininess));
    vec2 at = vec2(sqrt(clamp(dot(n, v), 0.0, 1.0)), roughness);
    vec2 factors = textureLod(environment_brdf, (0.5 + at * (environment_brdf_size - 1.0)) / environment_brdf_size, 0.0).rg;
    vec3 middle = environment_from_world * dominant_direction(n, v, roughness);
    vec3 glossy = textureLod(glossy_map, middle, roughness * glossy_last_level).rgb;
    glossy *= environment_specular_switch * environment_intensity;
    light.specular = k_s == vec3(0.0) ? vec3(0.0) : (k_s * factors.x + factors.y) * glossy;
    return light;
}
