// The lights of a scene: the table of light_table.rs.

// One light is LIGHT_TEXELS vec4: in uniforms if there are few lights, otherwise in a float texture,
// LIGHTS_PER_ROW lights per row, so that any number fits one pass.
#if LIGHTS_IN_TEXTURE
uniform highp sampler2D light_table;
#else
uniform vec4 light_values[LIGHTS_IN_UNIFORMS * LIGHT_TEXELS];
#endif

vec4 light_texel(int light, int texel) {
#if !LIGHTS_IN_TEXTURE
    return light_values[light * LIGHT_TEXELS + texel];
#else
    return texelFetch(light_table, ivec2((light % LIGHTS_PER_ROW) * LIGHT_TEXELS + texel, light / LIGHTS_PER_ROW), 0);
#endif
}
