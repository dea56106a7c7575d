#version 460 core
in vec3 aPos;
in vec3 normal;
uniform mat4 model;
uniform mat4 view;
uniform mat4 projection;
uniform float now;
out Sky { vec3 direction; vec3 normal; } sky;
// ------------
void main()
{
    sky.direction = aPos * vec3(1, -1, 1);
    sky.normal = normal;
    mat3 turn = mat3(view);
    vec4 clip = projection * mat4(turn) * vec4(aPos, 1);
    gl_Position = vec4(clip.x, clip.y, clip.w, clip.w);
}
