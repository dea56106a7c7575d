#version 150
in vec3 a_Position;
in vec3 a_Normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
out vec3 vNormal;
out vec3 v_pos;

void main() {
    vNormal = normalize(vec3(itM * vec4(a_Normal, 0.0)));
    v_pos = vec3(M * vec4(a_Position, 1.0));
    gl_Position = P * V * M * vec4(a_Position, 1.0);
}
