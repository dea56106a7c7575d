#version 330 core
in vec3 v_normal;
out vec4 FragColor;
const vec3 sun = normalize(vec3(-0.3, 0.8, 0.2));

void main() {
    FragColor = vec4(vec3(max(dot(normalize(v_normal), sun), 0.0)), 1.0);
}
