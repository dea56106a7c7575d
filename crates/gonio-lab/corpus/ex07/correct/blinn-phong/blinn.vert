#version 330 core
layout(location = 0) in vec3 aPos;
layout(location = 1) in vec3 aNormal;
uniform mat4 M; uniform mat4 V; uniform mat4 P; uniform mat4 itM;
out vec3 FragPos;
out vec3 Normal;
void main() {
    FragPos = (M * vec4(aPos, 1.0)).xyz;
    Normal = normalize((itM * vec4(aNormal, 0.0)).xyz);
    gl_Position = P * V * vec4(FragPos, 1.0);
}
