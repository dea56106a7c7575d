#version 330 core
in vec3 MvertPos;
in vec3 MvertNormal;
uniform mat4 M, V, P;
out vec3 WvertPos;
out vec3 WvertNormal;
void main() {
    WvertPos = (M * vec4(MvertPos, 1.0)).xyz;
    WvertNormal = normalize(transpose(inverse(mat3(M))) * MvertNormal);
    gl_Position = P * V * vec4(WvertPos, 1.0);
}
