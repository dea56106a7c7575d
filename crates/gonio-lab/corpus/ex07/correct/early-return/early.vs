#version 330 core
layout (location = 0) in vec3 position;
layout (location = 1) in vec2 texcoord;
layout (location = 2) in vec3 normal;

uniform mat4 model;
uniform mat4 view;
uniform mat4 projection;
uniform mat4 itM;

out vec3 fragPos;
out vec3 fragNormal;

void main()
{
    fragPos = vec3(model * vec4(position, 1.0f));
    fragNormal = normalize(mat3(itM) * normal);
    gl_Position = projection * view * vec4(fragPos, 1.0f);
}
