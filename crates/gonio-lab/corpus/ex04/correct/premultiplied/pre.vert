#version 460 core
in vec3 position;
in vec3 normal;
in vec2 tex_coord;
uniform mat4 MVP;
uniform mat4 M;
uniform mat4 itM;
out vec3 v_n;
out vec3 v_pos;
out vec2 v_t;
void main()
{
    v_n = (itM * vec4(normal, 1.0)).xyz / length((itM * vec4(normal, 0.0)).xyz);
    v_pos = (M * vec4(position, 1.0)).xyz;
    v_t = vec2(tex_coord.x, 1.0 - tex_coord.y);
    gl_Position = MVP * vec4(position, 1.0);
}
