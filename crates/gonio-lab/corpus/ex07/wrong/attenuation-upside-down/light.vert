#version 440
in vec3 position;
in vec3 normal;
uniform mat4 M; uniform mat4 V; uniform mat4 P; uniform mat4 itM;
out vec3 world; out vec3 n;
void main()
{
    world = vec3(M * vec4(position, 1));
    n = normalize(mat3(itM) * normal);
    gl_Position = P * V * vec4(world, 1);
}
