#version 400 core
layout(location = 0) in vec3 vPosition;
layout(location = 1) in vec3 aNormal;
uniform mat4 modelMatrix;
uniform mat4 viewMatrix;
uniform mat4 projectionMatrix;
uniform mat4 itM;
out Vertex { vec3 position; vec3 normal; } o;
void main()
{
    vec4 w = modelMatrix * vec4(vPosition, 1);
    o.position = w.xyz;
    o.normal = normalize((itM * vec4(aNormal, 0)).xyz);
    gl_Position = projectionMatrix * viewMatrix * w;
}
