#version 410 core
layout (location = 0) in vec3 aPos;
layout (location = 1) in vec3 aColor;

uniform mat4 model;
uniform mat4 projection;
uniform vec3 Position;
uniform vec3 Front;
uniform vec3 WorldUp;

out vec3 ourColor;

mat4 GetViewMatrix()
{
    vec3 zaxis = normalize(-Front);
    vec3 xaxis = normalize(cross(normalize(WorldUp), zaxis));
    vec3 yaxis = cross(zaxis, xaxis);

    mat4 translation = mat4(1.0);
    translation[3] = vec4(-Position, 1.0);
    mat4 rotation = mat4(1.0);
    rotation[0][0] = xaxis.x;
    rotation[1][0] = xaxis.y;
    rotation[2][0] = xaxis.z;
    rotation[0][1] = yaxis.x;
    rotation[1][1] = yaxis.y;
    rotation[2][1] = yaxis.z;
    rotation[0][2] = zaxis.x;
    rotation[1][2] = zaxis.y;
    rotation[2][2] = zaxis.z;
    return rotation * translation;
}

void main()
{
    gl_Position = projection * GetViewMatrix() * model * vec4(aPos, 1.0);
    ourColor = aColor;
}
