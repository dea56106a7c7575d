#version 460 core
in vec3 a_Position;
in vec3 a_Normal;
in vec2 tex_coord;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
out vec3 vPos;
out vec3 vNormal;
void main() {
    vPos = vec3(M * vec4(a_Position, 1.0));
    vNormal = normalize(mat3(V * M) * a_Normal);
    gl_Position = P * V * M * vec4(a_Position, 1.0);
}
