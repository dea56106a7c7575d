#version 440 core
layout(location = 0) in vec3 aPos;
layout(location = 1) in vec3 aNormal;
uniform mat4 M; uniform mat4 V; uniform mat4 P; uniform mat4 itM;
uniform vec3 lightPos; uniform vec3 viewPos; uniform vec3 materialColour; uniform float shininess;
out vec3 v_col;

void main() {
    vec3 p = (M * vec4(aPos, 1.0)).xyz;
    vec3 n = normalize((itM * vec4(aNormal, 0.0)).xyz);
    vec3 l = normalize(lightPos - p);
    vec3 h = normalize(l + normalize(viewPos - p));
    v_col = materialColour * (abs(dot(n, l)) + pow(max(dot(n, h), 0.0), shininess));
    gl_Position = P * V * M * vec4(aPos, 1.0);
}
