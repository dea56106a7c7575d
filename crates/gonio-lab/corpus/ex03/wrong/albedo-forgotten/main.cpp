#include <glad/glad.h>
#include <GLFW/glfw3.h>
#include <iostream>

const char* vertexShaderSource = R"glsl(#version 330 core
in vec3 position;
in vec2 tex_coords;
in vec3 normal;
out vec4 v_col;
uniform mat4 M;
uniform mat4 itM;
uniform mat4 V;
uniform mat4 P;
uniform vec3 u_light_pos;
uniform vec3 materialColour;
void main()
{
    vec4 frag_coord = M*vec4(position, 1.0);
    gl_Position = P*V*frag_coord;
    vec4 norm = itM * vec4(normal, 1.0);
    vec3 N = normalize(norm.xyz);
    vec3 L = normalize(u_light_pos - frag_coord.xyz);
    float diffuse = max(0.0, dot(N, L));
    v_col = vec4(vec3(diffuse), 1.0);
}
)glsl";

const char* fragmentShaderSource = R"glsl(#version 400 core
out vec4 FragColor;
precision mediump float;
in vec4 v_col;
void main()
{
    FragColor = v_col;
}
)glsl";

int main() {
    glfwInit();
    // ...
    return 0;
}
