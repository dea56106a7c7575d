#version 460 core
layout (location = 0) in vec3 aPos;
layout (location = 1) in vec3 aNormal;

uniform mat4 model;
uniform mat4 view;
uniform mat4 projection;

out vec3 vNormal;
out vec3 vWorldPos;
out vec3 vToLight;
out vec3 vToEye;

struct Light {
    vec3 light_pos;
    float ambient_strength;
    float diffuse_strength;
    float specular_strength;
    float constant;
    float linear;
    float quadratic;
};
uniform Light light;
uniform vec3 viewPos;

void main()
{
    mat3 normalMat = transpose(inverse(mat3(model)));
    vNormal = normalMat * aNormal;
    vWorldPos = (model * vec4(aPos, 1.0)).xyz;
    // not normalized here: interpolated, then normalized per fragment
    vToLight = light.light_pos - vWorldPos;
    vToEye = viewPos - vWorldPos;
    gl_Position = projection * view * model * vec4(aPos, 1.0);
}
