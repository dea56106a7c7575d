#version 330 core
layout (location = 0) in vec3 position;
layout (location = 1) in vec2 tex_coords;
layout (location = 2) in vec3 normal;
uniform mat4 projection, view, model, itM;
out vec3 FragPos;
out vec3 Normal;
void main() {
    FragPos = (model * vec4(position, 1.0)).xyz;
    Normal = normalize(mat3(itM) * normal);
    gl_Position = projection * view * model * vec4(position, 1.0);
}
