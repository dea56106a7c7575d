#version 330 core
layout (location = 0) in vec3 aPos;
layout (location = 1) in vec3 aNormal;
uniform mat4 model;
uniform mat4 view;
uniform mat4 projection;
uniform mat4 itM;
out vec3 pos;
out vec3 nrm;


void main() {
    pos = (model * vec4(aPos, 1.0f)).xyz;
    nrm = normalize((itM * vec4(aNormal, 0.0f)).xyz);
    gl_Position = projection * view * vec4(pos, 1.0f);
}
