// Depth alone: a shadow map. Where a texture makes holes, light goes through.

#if MASKED
in vec2 v_tex_coord;
uniform sampler2D opacity_map;
uniform mat3x2 opacity_map_transform;
uniform float opacity;
#endif

void main() {
#if MASKED
    // Textures of data are stored as 2 t - 1.
    float stored = textureLod(opacity_map, opacity_map_transform * vec3(v_tex_coord, 1.0), 0.0).r;
    if (opacity * (0.5 * stored + 0.5) < SHADOW_OPACITY) discard;
#endif
}
