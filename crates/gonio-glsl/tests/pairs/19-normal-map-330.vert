#version 330 core
layout (location = 0) in vec3 aPos;
layout (location = 1) in vec3 aNormal;
layout (location = 2) in vec2 aTexCoords;
layout (location = 3) in vec3 aTangent;
out vec2 TexCoords;
out mat3 TBN;
out vec3 FragPos;
uniform mat4 model, view, projection;
void main() {
    vec3 T = normalize(mat3(model) * aTangent);
    vec3 N = normalize(mat3(model) * aNormal);
    T = normalize(T - dot(T, N) * N);
    TBN = mat3(T, cross(N, T), N);
    TexCoords = aTexCoords;
    FragPos = vec3(model * vec4(aPos, 1));
    gl_Position = projection * view * model * vec4(aPos, 1.0);
}
