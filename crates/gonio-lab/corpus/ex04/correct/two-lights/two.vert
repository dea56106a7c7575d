#version 330 core
in vec3 position;
in vec3 normal;
uniform mat4 M, V, P, itM;
out vec3 wp;
out vec3 wn;
void main()
{
    wp = vec3(M * vec4(position, 1.0));
    wn = normalize(mat3(itM) * normal);
    gl_Position = P * V * vec4(wp, 1.0);
}
