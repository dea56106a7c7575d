// A surface whose material has a BRDF of its own, in the environment's light: the twin of MaterialBrdf::environment_light.
// From Rust: MOST_SMALL_LIGHTS.

uniform highp samplerCube function_map;  // the environment; without its small lights, if there are any here
uniform vec4 function_lobe;              // see function_light.glsl
uniform int function_lobe_count;         // directions that follow the lobe,
uniform int function_cosine_count;       // the cosine,
uniform int small_light_count;           // and those of small lights
uniform vec3 small_light_directions[MOST_SMALL_LIGHTS];    // in the world
uniform vec3 small_light_irradiances[MOST_SMALL_LIGHTS];
uniform float environment_specular_switch;

struct EnvironmentLight {
    vec3 diffuse;
    vec3 specular;
};

// All of it counts as specular. `tangent` has any length.
EnvironmentLight function_light(vec3 n, vec3 v, vec3 tangent) {
    vec3 t = unit_or(tangent - dot(n, tangent) * n, horizontal_tangent(n));
    vec3 b = cross(n, t);
    vec3 wo = raised_view(vec3(dot(t, v), dot(b, v), dot(n, v)));
    vec3 view = wo.x * t + wo.y * b + wo.z * n;
    float size = float(textureSize(function_map, 0).x);
    int extended = function_lobe_count + function_cosine_count;
    vec3 sum = vec3(0.0);
    // One loop for all, so that compilers write the function's code once.
    for (int i = 0; i < extended + small_light_count; ++i) {
        vec3 l;
        vec3 light;
        if (i < extended) {
            int j = i - function_lobe_count;
            vec3 wi = j < 0 ? lobe_direction(function_lobe, wo, spiral_point(i, function_lobe_count))
                : cosine_direction(spiral_point(j, function_cosine_count));
            float by_lobe = float(function_lobe_count) * lobe_density(function_lobe, wo, wi);
            float w = 1.0 / (by_lobe + float(function_cosine_count) * max(wi.z, 0.0) / PI);
            l = wi.x * t + wi.y * b + wi.z * n;
            vec3 d = environment_from_world * l;
            light = w * textureLod(function_map, d, lookup_level(size, d, w)).rgb;
        } else {
            l = small_light_directions[i - extended];
            light = small_light_irradiances[i - extended];
        }
        float cosine = dot(n, l);
        if (cosine > 0.0) sum += material_brdf(l, view, n, t) * cosine * light;
    }
    return EnvironmentLight(vec3(0.0), environment_specular_switch * environment_intensity * sum);
}
