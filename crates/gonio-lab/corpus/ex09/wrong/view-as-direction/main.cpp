#include <glad/glad.h>
#include <GLFW/glfw3.h>
#include <iostream>

const char* vertexShaderSource = R"glsl(#version 330 core
in vec3 a_Position;
in vec2 tex_coords;
in vec3 a_Normal;
out vec3 vPos;
out vec3 vNormal;
uniform mat4 M;
uniform mat4 itM;
uniform mat4 V;
uniform mat4 P;

void main()
{
    vec4 frag_coord = M*vec4(a_Position, 1.0);
    gl_Position = P*V*frag_coord;
    vNormal = normalize(vec3(itM * vec4(a_Normal, 1.0)));
    vPos = frag_coord.xyz;
}
)glsl";

const char* fragmentShaderSource = R"glsl(#version 400 core
uniform samplerCube cubemapSampler;
out vec4 color_out;
precision mediump float;
uniform vec3 u_view_pos;
in vec3 vPos;
in vec3 vNormal;

void main()
{
    vec3 N = normalize(vNormal);
    vec3 V = normalize(u_view_pos);
    vec3 R = reflect(-V,N);
    color_out = texture(cubemapSampler,R);
}
)glsl";

int main() {
    glfwInit();
    // ...
    return 0;
}
