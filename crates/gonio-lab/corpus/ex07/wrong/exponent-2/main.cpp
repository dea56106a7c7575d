#include <glad/glad.h>
#include <GLFW/glfw3.h>
#include <iostream>

const char* vertexShaderSource = R"glsl(#version 400 core
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
)glsl";

const char* fragmentShaderSource = R"glsl(#version 400 core
in Vertex { vec3 position; vec3 normal; } i;
uniform vec3 cameraPos;
uniform vec3 materialColour;
uniform struct Light {
    vec3 light_pos;
    float ambient_strength;
    float diffuse_strength;
    float specular_strength;
    float constant;
    float linear;
    float quadratic;
} light;
out vec4 fragmentColour;

void phong(in vec3 n, in vec3 l, in vec3 v, out float kd, out float ks)
{
    kd = max(dot(n, l), 0.0);
    ks = pow(max(dot(reflect(-l, n), v), 0.0), 2.0);
}
void attenuate(inout float x, float d) { x /= light.constant + d * light.linear + d * d * light.quadratic; }

void main()
{
    float kd, ks;
    vec3 l = light.light_pos - i.position;
    phong(normalize(i.normal), normalize(l), normalize(cameraPos - i.position), kd, ks);
    float sum = light.diffuse_strength * kd + light.specular_strength * ks;
    attenuate(sum, length(l));
    sum += light.ambient_strength;
    fragmentColour = vec4(mix(vec3(0), materialColour, sum), 1);
}
)glsl";

int main() {
    glfwInit();
    // ...
    return 0;
}
