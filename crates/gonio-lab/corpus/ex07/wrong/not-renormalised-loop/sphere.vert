#version 440
in vec3 a_Position;
in vec3 a_Normal;
uniform mat4 M; uniform mat4 V; uniform mat4 P; uniform mat4 itM;
out vec3 world; out vec3 n;
void main()
{
    world = vec3(M * vec4(a_Position, 1));
    n = normalize(mat3(itM) * a_Normal);
    gl_Position = P * V * vec4(world, 1);
}
