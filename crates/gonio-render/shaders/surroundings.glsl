// The environment: turned, and looked up.

uniform mat3 environment_from_world;
uniform float environment_intensity;

#if SIGHT
uniform highp samplerCube environment_map;
uniform float reflectivity;
uniform float transmission;
uniform int fresnel_kind;
uniform vec3 indices;               // of red, green and blue
#if GLASS
uniform int index_count;            // 1 if all three are equal
uniform vec3 tint;
#endif
#if MIPMAPPED
uniform float environment_half_size; // half the texels along an edge: about 1 / the angle of one
#endif

// The level whose texels are as far apart as directions of neighbouring pixels. Uses derivatives: all fragments must
// call it.
float level_of(vec3 direction) {
#if MIPMAPPED
    vec2 change = vec2(length(dFdx(direction)), length(dFdy(direction)));
    return log2(max(environment_half_size * max(change.x, change.y), 1.0));
#else
    return 0.0;
#endif
}

// E
vec3 environment(vec3 direction, float level) {
    return environment_intensity * textureLod(environment_map, environment_from_world * direction, level).rgb;
}
#endif
