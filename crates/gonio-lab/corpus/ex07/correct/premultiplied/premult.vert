#version 330 core
in vec3 position;
in vec3 normal;
uniform mat4 MVP;
uniform mat4 M;
uniform mat4 itM;
out vec3 v_frag_coord;
out vec3 v_normal;
void main() {
    v_frag_coord = (M*vec4(position,1)).xyz;
    v_normal = normalize((itM*vec4(normal,0)).xyz);
    gl_Position = MVP*vec4(position,1);
}
