// Model to clip space, for views that are not quantities of the equation.

in vec3 position;
in vec3 normal;
in vec2 tex_coord;

uniform mat4 clip_from_model;
uniform mat4 world_from_model;
uniform mat3 normal_world_from_model;   // inverse transpose, of any length

out vec3 v_position_in_world;
out vec3 v_normal_in_world;
out vec2 v_tex_coord;

void main() {
    gl_Position = clip_from_model * vec4(position, 1.0);
    v_position_in_world = (world_from_model * vec4(position, 1.0)).xyz;
    v_normal_in_world = normal_world_from_model * normal;
    v_tex_coord = tex_coord;
}
