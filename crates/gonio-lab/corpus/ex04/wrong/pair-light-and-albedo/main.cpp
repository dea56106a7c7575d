#include <glad/glad.h>
#include <GLFW/glfw3.h>
#include <iostream>

const char* vertexShaderSource = R"glsl(#version 300 es
in vec3 position;
in vec3 normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
out vec3 v_normal;
out vec3 fragCoord;
void main()
{
    v_normal = normalize((itM * vec4(normal, 0.0)).xyz);
    fragCoord = (M * vec4(position, 1.0)).xyz;
    gl_Position = P * V * vec4(fragCoord, 1.0);
}
)glsl";

const char* fragmentShaderSource = R"glsl(#version 300 es
precision mediump float;
in vec3 v_normal;
in vec3 fragCoord;
uniform vec3 u_light_pos;
uniform vec3 materialColour;
out vec4 frag_color;
void main()
{
    vec3 n = normalize(v_normal);
    vec3 l = u_light_pos - fragCoord;
    frag_color = vec4(vec3(max(dot(n, l), 0.0)), 1.0);
}
)glsl";

int main() {
    glfwInit();
    // ...
    return 0;
}
