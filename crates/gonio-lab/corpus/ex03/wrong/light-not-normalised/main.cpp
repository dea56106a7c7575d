#include <glad/glad.h>
#include <GLFW/glfw3.h>
#include <iostream>

const char* vertexShaderSource = R"glsl(#version 130
in vec3 position;
in vec2 tex_coords;
in vec3 normal;
out vec3 v_col;
uniform mat4 M;
uniform mat4 itM;
uniform mat4 V;
uniform mat4 P;
uniform vec3 u_light_pos;
uniform vec3 materialColour;
void main(){
    vec4 world = M*vec4(position, 1.0);
    gl_Position = P*V*world;
    vec3 n = normalize(vec3(itM * vec4(normal, 1.0)));
    vec3 l = u_light_pos - world.xyz;
    v_col = max(dot(n, l), 0.0) * materialColour;
}
)glsl";

const char* fragmentShaderSource = R"glsl(#version 130
precision mediump float;
in vec3 v_col;
out vec4 outColor;
void main() {
    outColor = vec4(v_col, 1.0);
}
)glsl";

int main() {
    glfwInit();
    // ...
    return 0;
}
