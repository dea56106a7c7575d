#version 460 core
in vec3 position;
in vec3 normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform float now;
out Sky { vec3 direction; vec3 normal; } sky;
void main()
{
    sky.direction = position;
    sky.normal = normal;
    mat3 turn = mat3(V);
    vec4 clip = P * mat4(turn) * vec4(position, 1);
    gl_Position = vec4(clip.x, clip.y, clip.w, clip.w);
}
