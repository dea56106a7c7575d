// Model to clip space; for Gouraud and flat-per-face shading the light is summed here.

in vec3 position;
in vec3 normal;
in vec2 tex_coord;
in vec4 tangent;
#if VERTEX_COLORS
in vec4 color;
#endif
#if SHADING == SHADING_FLAT_PER_FACE
in vec3 face_center;
#endif

uniform mat4 clip_from_model;
uniform mat4 world_from_model;
uniform mat3 normal_world_from_model;   // inverse transpose, of any length
#if TANGENTS
uniform float handedness;               // -1 if world_from_model mirrors
#endif

out vec3 v_position_in_world;
FLAT_IF_PER_TRIANGLE out vec3 v_normal_in_world;
out vec2 v_tex_coord;
#if VERTEX_COLORS
out vec4 v_color;
#endif
#if TANGENTS
out vec4 v_tangent_in_world;
#endif

#if VERTEX_LIT
uniform float shininess;
FLAT_IF_LIT_PER_FACE out vec3 v_diffuse_light;
FLAT_IF_LIT_PER_FACE out vec3 v_specular_light;
#if TWO_SIDED
// As in OpenGL's former two-sided lighting, both sides are lit, and the fragment chooses the one that is visible.
FLAT_IF_LIT_PER_FACE out vec3 v_back_diffuse_light;
FLAT_IF_LIT_PER_FACE out vec3 v_back_specular_light;
#endif
#if VIEW
FLAT_IF_LIT_PER_FACE out vec3 v_quantity;
#if TWO_SIDED
FLAT_IF_LIT_PER_FACE out vec3 v_back_quantity;
#endif
#endif

LightSums sums_of(vec3 lit_position, vec3 n, vec3 v) {
#if VIEW
    return light_sums_of_view(lit_position, n, v, shininess);
#else
    return light_sums(lit_position, n, v, shininess);
#endif
}
#endif

void main() {
    gl_Position = clip_from_model * vec4(position, 1.0);
    v_position_in_world = (world_from_model * vec4(position, 1.0)).xyz;
    vec3 n = unit_or(normal_world_from_model * normal, vec3(0.0));
    v_normal_in_world = n;
    v_tex_coord = tex_coord;
#if VERTEX_COLORS
    v_color = color;
#endif
#if TANGENTS
    // A mirroring transform reverses the bitangent.
    v_tangent_in_world = vec4(mat3(world_from_model) * tangent.xyz, handedness * tangent.w);
#endif
#if VERTEX_LIT
#if SHADING == SHADING_FLAT_PER_FACE
    vec3 lit_position = (world_from_model * vec4(face_center, 1.0)).xyz;
#else
    vec3 lit_position = v_position_in_world;
#endif
    vec3 v = unit_or(eye_in_world - lit_position, vec3(0.0, 1.0, 0.0));
    n = unit_or(n, v);
#if REFLECTANCE == REFLECTANCE_MATERIAL
    material_tangent = v_tangent_in_world.xyz;
#endif
#if SHADOWS
    receiver_normal = n;   // of the vertex: the triangles are not known here
#endif
    LightSums front = sums_of(lit_position, n, v);
    v_diffuse_light = front.diffuse;
    v_specular_light = front.specular;
#if VIEW
    v_quantity = quantity_of_point(lit_position, n, v, shininess);
#endif
#if TWO_SIDED
    LightSums back = sums_of(lit_position, -n, v);
    v_back_diffuse_light = back.diffuse;
    v_back_specular_light = back.specular;
#if VIEW
    v_back_quantity = quantity_of_point(lit_position, -n, v, shininess);
#endif
#endif
#endif
}
