#version 330 core
layout (location = 0) in vec3 aPos;
layout (location = 1) in vec3 aNormal;
uniform mat4 model;
uniform mat4 view;
uniform mat4 projection;
uniform vec3 lightPos;
out float v_diffuse;
// TODO clean
void main()
{
    vec3 worldPos = vec3(model * vec4(aPos, 1.0));
    vec3 norm = normalize(mat3(transpose(inverse(model))) * aNormal);
    vec3 lightDir = normalize(lightPos - norm);
    v_diffuse = max(dot(norm, lightDir), 0.0);
    gl_Position = projection * view * vec4(worldPos, 1.0);
}
