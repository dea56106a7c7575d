#version 330 core
layout (location = 0) in vec3 aPos;
layout (location = 1) in vec3 aNormal;
out vec3 worldPosition;
out vec3 normal;
uniform mat4 camera;
uniform mat4 transform;

void main() {
    mat3 nTransform = transpose(inverse(mat3(transform)));
    worldPosition = vec3(transform * vec4(aPos, 1.0));
    normal = nTransform * aNormal;
    gl_Position = camera * transform * vec4(aPos, 1.0);
}
