#version 450 core
layout(location = 0) in vec3 aPos;
layout(location = 1) in vec3 aNormal;
layout(location = 2) in vec2 aTexCoords;
out VS_OUT {
    vec3 FragPos;
    vec3 Normal;
    flat int id;
    vec2 TexCoords;
} vs_out;
layout(std140, binding = 0) uniform Matrices { mat4 projection; mat4 view; };
layout(location = 4) uniform mat4 model;
void main()
{
    vs_out.FragPos = vec3(model * vec4(aPos, 1.0));
    vs_out.Normal = transpose(inverse(mat3(model))) * aNormal;
    (vs_out).TexCoords = aTexCoords;
    vs_out.id = gl_VertexID;
    gl_Position = projection * view * vec4(vs_out.FragPos, 1.0);
}
