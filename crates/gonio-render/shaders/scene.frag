// The light equation at a fragment, or interpolated from the vertices. Writes linear radiance with
// premultiplied alpha; a debug view writes its raw value.

in vec3 v_position_in_world;
FLAT_IF_PER_TRIANGLE in vec3 v_normal_in_world;
in vec2 v_tex_coord;
#if VERTEX_COLORS
in vec4 v_color;
#endif
#if TANGENTS
in vec4 v_tangent_in_world;
#endif
#if VERTEX_LIT
FLAT_IF_LIT_PER_FACE in vec3 v_diffuse_light;
FLAT_IF_LIT_PER_FACE in vec3 v_specular_light;
#if TWO_SIDED
FLAT_IF_LIT_PER_FACE in vec3 v_back_diffuse_light;
FLAT_IF_LIT_PER_FACE in vec3 v_back_specular_light;
#endif
#if VIEW
FLAT_IF_LIT_PER_FACE in vec3 v_quantity;
#if TWO_SIDED
FLAT_IF_LIT_PER_FACE in vec3 v_back_quantity;
#endif
#endif
#endif

uniform vec3 ambient_light;      // the scene's, 0 where A is switched off
uniform float emitted_switch;
#if VIEW
uniform vec4 depth_plane;        // dot(depth_plane, (p, 1)) is the distance along the viewing direction
#endif

#if DISPLAYED
uniform float exposure;          // stops
#endif

out vec4 frag_color;

// +1 on front faces; -1 if the normal is turned to the viewer.
float facing() {
#if TWO_SIDED
    return gl_FrontFacing ? 1.0 : -1.0;
#else
    return 1.0;
#endif
}

// The normal of the triangle, towards its front, with the precision of f32 differences between pixels.
vec3 normal_by_derivatives(vec3 fallback) {
    vec3 across = cross(dFdx(v_position_in_world), dFdy(v_position_in_world));
    return unit_or(gl_FrontFacing ? across : -across, fallback);
}

#if !VERTEX_LIT || SURROUNDINGS
vec3 shading_normal(vec3 v) {
    vec3 n = unit_or(v_normal_in_world, normal_by_derivatives(v * facing())) * facing();
#if NORMAL_MAP
    vec3 texel = map_texel(normal_map, normal_map_transform, v_tex_coord).xyz;   // stored in [-1, 1]
    vec3 t = v_tangent_in_world.xyz - dot(v_tangent_in_world.xyz, n) * n;
    float t_length = length(t);
    if (has_direction(t_length)) {
        t /= t_length;
        // The sign stays the same for all fragments of a triangle; interpolation blurs its magnitude.
        vec3 b = (v_tangent_in_world.w < 0.0 ? -1.0 : 1.0) * cross(n, t);
        n = unit_or(texel.x * t + texel.y * b + texel.z * n, n);
    }
#endif
    return n;
}
#endif

void main() {
#if VERTEX_COLORS
    Surface s = surface_at(v_tex_coord, v_color.rgb);
#else
    Surface s = surface_at(v_tex_coord, vec3(1.0));
#endif
    vec3 v = unit_or(eye_in_world - v_position_in_world, vec3(0.0, 1.0, 0.0));
#if VERTEX_LIT
    LightSums sums = LightSums(v_diffuse_light, v_specular_light);
#if TWO_SIDED
    if (!gl_FrontFacing) sums = LightSums(v_back_diffuse_light, v_back_specular_light);
#endif
#if SURROUNDINGS
    vec3 n = shading_normal(v);   // light was computed at the vertices, surroundings are computed here
#endif
#else
    vec3 n = shading_normal(v);
#if REFLECTANCE == REFLECTANCE_MATERIAL
    material_tangent = v_tangent_in_world.xyz;
#endif
#if SHADOWS
#if SHADING == SHADING_FLAT
    receiver_normal = unit_or(v_normal_in_world, v);
#else
    receiver_normal = normal_by_derivatives(n);
#endif
#endif
#if VIEW
    LightSums sums = light_sums_of_view(v_position_in_world, n, v, s.shininess);
#else
    LightSums sums = light_sums(v_position_in_world, n, v, s.shininess);
#endif
#endif
    vec3 ambient = s.ambient * ambient_light;
    vec3 emitted = s.emitted * emitted_switch;
    vec3 diffuse = s.diffuse * sums.diffuse;
    vec3 specular = s.specular * sums.specular;
    vec3 value = ambient + emitted + diffuse + specular;
#if ENVIRONMENT_LIGHT
#if REFLECTANCE == REFLECTANCE_MATERIAL
    EnvironmentLight around = function_light(n, v, v_tangent_in_world.xyz);
#else
    EnvironmentLight around = environment_light(n, v, s.diffuse, s.specular, s.shininess);
#endif
    value += around.diffuse + around.specular;
#endif
#if SIGHT
    Sight seen = sight(v_position_in_world, n, v);
    value = compose(value, seen, fresnel_kind, reflectivity, transmission);
#endif
#if VIEW
    if (view_quantity == QUANTITY_AMBIENT) value = ambient;
    else if (view_quantity == QUANTITY_EMITTED) value = emitted;
    else if (view_quantity == QUANTITY_DIFFUSE) value = diffuse;
    else if (view_quantity == QUANTITY_SPECULAR) value = specular;
    else if (view_quantity == QUANTITY_ALBEDO) value = s.diffuse;
#if ENVIRONMENT_LIGHT
    else if (view_quantity == QUANTITY_ENVIRONMENT_DIFFUSE) value = around.diffuse;
    else if (view_quantity == QUANTITY_ENVIRONMENT_SPECULAR) value = around.specular;
#endif
#if SIGHT
    else if (view_quantity == QUANTITY_FRESNEL) value = seen.fresnel;
    else if (view_quantity == QUANTITY_REFLECTED) value = seen.reflected;
    else if (view_quantity == QUANTITY_TRANSMITTED) value = seen.transmitted;
#endif
    else if (view_quantity == QUANTITY_UV) value = vec3(v_tex_coord, 0.0);
    else if (view_quantity == QUANTITY_POSITION) value = v_position_in_world;
    else if (view_quantity == QUANTITY_DEPTH) value = vec3(dot(depth_plane, vec4(v_position_in_world, 1.0)));
    // Not turned to the viewer. Flat meshes have it as their normal; otherwise it is computed from derivatives.
    else if (view_quantity == QUANTITY_GEOMETRIC_NORMAL) {
#if SHADING == SHADING_FLAT || SHADING == SHADING_FLAT_PER_FACE
        value = unit_or(v_normal_in_world, v);
#else
        value = normal_by_derivatives(v);
#endif
    }
    else if (view_quantity == QUANTITY_TANGENT) {
        // Perpendicular to the normal, turned or not; 0 if the mesh has no tangents.
        vec3 along = unit_or(v_normal_in_world, v);
        vec3 t = v_tangent_in_world.xyz;
        value = unit_or(t - dot(t, along) * along, vec3(0.0));
    } else if (view_quantity != QUANTITY_TOTAL) {
#if VERTEX_LIT
        value = v_quantity;
#if TWO_SIDED
        if (!gl_FrontFacing) value = v_back_quantity;
#endif
#else
        value = quantity_of_point(v_position_in_world, n, v, s.shininess);
#endif
    }
#endif
#if VIEW
    // The nearest surface that is not a hole, as if it were opaque.
    if (s.opacity < HOLE_OPACITY) discard;
    frag_color = vec4(value, 1.0);
#elif DISPLAYED
    frag_color = vec4(display_light(value, exposure), 1.0);   // opaque
#else
    frag_color = vec4(value * s.opacity, s.opacity);
#endif
}
