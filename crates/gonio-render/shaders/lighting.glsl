// The light equation over all lights of a scene: the twin of gonio-light's equation.rs.
// Used by the vertex shader (Gouraud, flat per face) or by the fragment shader (Phong, flat).

// Lights are sorted by kind, so that each loop has one kind. Very few lights are summed one by one (LIGHT_0 is the kind of
// the first): half the cost on software drivers, some of which do not unroll loops and compile the body of a loop that
// never runs.
#if LIGHTS_UNROLLED
const int directional_end = DIRECTIONAL_END;
const int point_end = POINT_END;
const int spot_end = SPOT_END;
#else
uniform int directional_end;
uniform int point_end;
uniform int spot_end;
#endif
uniform vec3 eye_in_world;
uniform float diff_factor;          // 1 in the lab's convention, 1/pi in the physical one and for BRDFs
uniform float diffuse_switch;       // 0 or 1, like all switches
uniform float specular_switch;
uniform float attenuation_switch;
uniform float spot_switch;
uniform bool gated;
uniform bool cosine_weighted;
uniform bool brdf_normalised;
uniform vec3 lafortune_diagonal;

struct LightTerms {
    vec3 l;
    float distance;
    float attenuation;
    float spot;
    float visibility;
    float cos_theta;
    vec3 r;
    vec3 h;
    float spec;
    vec3 diffuse_light;
    vec3 specular_light;
};

struct LightSums {
    vec3 diffuse;
    vec3 specular;
};

#if REFLECTANCE == REFLECTANCE_MATERIAL
// Along u where the mesh has texture coordinates, in world space, of any length; set before lights are summed.
vec3 material_tangent;

// pi diff f <N.L> of the material's own BRDF: the twin of gonio-light's LightTerms::with_brdf.
vec3 material_factor(vec3 n, vec3 v, vec3 l, float cos_theta) {
    if (cos_theta <= 0.0 || dot(n, v) <= 0.0) return vec3(0.0);
    vec3 t = unit_or(material_tangent - dot(n, material_tangent) * n, horizontal_tangent(n));
    return material_brdf(l, v, n, t) * (PI * diff_factor * cos_theta);
}
#endif

// `spec` of the lab's equation, or a BRDF's specular lobe times <N.L>, for k_s = 1.
float specular_factor(vec3 n, vec3 v, vec3 l, vec3 r, vec3 h, float cos_theta, float shininess) {
#if REFLECTANCE == REFLECTANCE_NONE || REFLECTANCE == REFLECTANCE_LAMBERT || REFLECTANCE == REFLECTANCE_MATERIAL
    return 0.0;
#elif REFLECTANCE == REFLECTANCE_PHONG || REFLECTANCE == REFLECTANCE_BLINN_PHONG
#if REFLECTANCE == REFLECTANCE_PHONG
    float cosine = dot(r, v);
#else
    float cosine = dot(n, h);
#endif
    float spec = cosine_power(cosine, shininess);
    if (gated && cos_theta <= 0.0) spec = 0.0;
    if (cosine_weighted) spec *= max(cos_theta, 0.0);
    return spec;
#else
    vec3 tangent = any_orthonormal_vector(n);
    return BRDF_LOBE(n, v, l, tangent, shininess, lafortune_diagonal, brdf_normalised) * max(cos_theta, 0.0);
#endif
}

// `kind` is a constant in all loops, so that compilers remove the code of other kinds: a software driver executes both
// sides of a branch.
LightTerms light_terms(int kind, int light, vec3 position, vec3 n, vec3 v, float shininess) {
    vec3 place = light_texel(light, 0).xyz;
    vec3 color = light_texel(light, 1).rgb;
    LightTerms t;
    if (kind == LIGHT_DIRECTIONAL) {
        // Of length 1, or zero.
        t.l = dot(place, place) > 0.5 ? -place : n;
        t.distance = 0.0;
        t.attenuation = 1.0;
        t.spot = 1.0;
    } else {
        vec3 to_light = place - position;
        t.distance = length(to_light);
        t.l = has_direction(t.distance) ? to_light / t.distance : n;
        vec4 attenuation_and_inner = light_texel(light, 3);
        t.attenuation = attenuation_at(attenuation_and_inner.xyz, t.distance);
        t.spot = 1.0;
        if (kind == LIGHT_SPOT) {
            vec4 axis_and_outer = light_texel(light, 2);
            t.spot = smoothstep_or_step(axis_and_outer.w, attenuation_and_inner.w, -dot(t.l, axis_and_outer.xyz));
        }
    }
    t.attenuation = mix(1.0, t.attenuation, attenuation_switch);
    t.spot = mix(1.0, t.spot, spot_switch);
    t.visibility = 1.0;
#if SHADOWS
    t.visibility = light_visibility(light, position, t.l);
#endif
    t.cos_theta = dot(n, t.l);
    // Some software drivers compute what nothing reads.
#if VIEW || REFLECTANCE == REFLECTANCE_PHONG
    t.r = reflection(n, t.l);
#else
    t.r = vec3(0.0);
#endif
#if VIEW || REFLECTANCE == REFLECTANCE_BLINN_PHONG
    t.h = half_vector(t.l, v, n);
#else
    t.h = vec3(0.0);
#endif
    t.spec = specular_factor(n, v, t.l, t.r, t.h, t.cos_theta, shininess);
    vec3 incident = color * (t.attenuation * t.spot * t.visibility);
#if REFLECTANCE == REFLECTANCE_MATERIAL
    vec3 factor = material_factor(n, v, t.l, t.cos_theta);
    t.spec = max(factor.r, max(factor.g, factor.b));
    t.diffuse_light = vec3(0.0);
    t.specular_light = (specular_switch * factor) * incident;
#else
    t.diffuse_light = (diffuse_switch * diff_factor * max(t.cos_theta, 0.0)) * incident;
    t.specular_light = (specular_switch * t.spec) * incident;
#endif
    return t;
}

int kind_of_light(int light) {
    return light < directional_end ? LIGHT_DIRECTIONAL : light < point_end ? LIGHT_POINT : LIGHT_SPOT;
}

void add_light(inout LightSums sums, int kind, int light, vec3 position, vec3 n, vec3 v, float shininess) {
    LightTerms t = light_terms(kind, light, position, n, v, shininess);
    sums.diffuse += t.diffuse_light;
    sums.specular += t.specular_light;
}

LightSums light_sums(vec3 position, vec3 n, vec3 v, float shininess) {
    LightSums sums = LightSums(vec3(0.0), vec3(0.0));
#if LIGHTS_UNROLLED
#ifdef LIGHT_0
    add_light(sums, LIGHT_0, 0, position, n, v, shininess);
#endif
#ifdef LIGHT_1
    add_light(sums, LIGHT_1, 1, position, n, v, shininess);
#endif
#ifdef LIGHT_2
    add_light(sums, LIGHT_2, 2, position, n, v, shininess);
#endif
#ifdef LIGHT_3
    add_light(sums, LIGHT_3, 3, position, n, v, shininess);
#endif
#else
    int i = 0;
    for (; i < directional_end; ++i) add_light(sums, LIGHT_DIRECTIONAL, i, position, n, v, shininess);
    for (; i < point_end; ++i) add_light(sums, LIGHT_POINT, i, position, n, v, shininess);
    for (; i < spot_end; ++i) add_light(sums, LIGHT_SPOT, i, position, n, v, shininess);
#endif
    return sums;
}
