#version 330 core
in vec3 MvertPos;
in vec3 MvertNormal;
uniform mat4 M, V, P, itM;
out vec3 WvertPos;
out vec3 WvertNormal;
void main() {
    WvertPos = (M * vec4(MvertPos, 1.)).xyz;
    WvertNormal = normalize((itM * vec4(MvertNormal, 0.)).xyz);
    gl_Position = P * V * vec4(WvertPos, 1.);
}
