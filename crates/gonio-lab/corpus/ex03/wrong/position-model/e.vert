#version 300 es
in vec3 aPos;
in vec3 aNormal;
uniform mat4 model;
uniform mat4 view;
uniform mat4 projection;
uniform mat4 itM;
uniform vec3 u_light_pos;
uniform vec3 materialColour;
out vec3 v_col;
void main() {
    vec4 w = model * vec4(aPos, 1.0);
    vec3 n = normalize(mat3(itM) * aNormal);
    vec3 l = normalize(u_light_pos - aPos);
    v_col = materialColour * max(dot(n, l), 0.0);
    gl_Position = projection * view * w;
}
