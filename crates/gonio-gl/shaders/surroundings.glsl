// The environment at a fragment: looked up along the directions that its mirror or glass asks for.

uniform highp samplerCube environment_map;
uniform mat3 environment_from_world;
uniform float environment_intensity;
uniform float reflectivity;
uniform float transmission;
uniform int fresnel_kind;
uniform vec3 indices;               // of red, green and blue
#if GLASS
uniform int index_count;            // 1 where all three are the same
uniform vec3 tint;
#endif
#if MIPMAPPED
uniform float environment_half_size; // half the texels along an edge: about 1 / the angle of one
#endif

// The level whose texels are as far apart as directions of neighbouring pixels. Takes derivatives: call it where all
// fragments do.
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

// What the point shows: twin of gonio-light's `sight`.
Sight sight(vec3 n, vec3 v) {
    Boundary at = boundary(n, v, indices.g, fresnel_kind);
    Sight seen;
    seen.reflection = at.reflected;
    seen.reflected = environment(at.reflected, level_of(at.reflected));
    seen.transmitted = vec3(0.0);
    seen.fresnel = vec3(at.reflectance);
#if GLASS
    // One level for all channels. Where reflection is total its direction stands in, so that derivatives mean something,
    // and weighs nothing.
    float level = level_of(at.transmits ? at.transmitted : at.reflected);
    for (int i = 0; i < index_count; ++i) {
        if (index_count > 1) at = boundary(n, v, indices[i], fresnel_kind);
        vec3 t = at.transmits ? at.transmitted : at.reflected;
        vec3 through = ((1.0 - at.reflectance) * tint) * environment(t, level);
        if (index_count > 1) {
            seen.transmitted[i] = through[i];
            seen.fresnel[i] = at.reflectance;
        } else {
            seen.transmitted = through;
        }
    }
#endif
    return seen;
}
