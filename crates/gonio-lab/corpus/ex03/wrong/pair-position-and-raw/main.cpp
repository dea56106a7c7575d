#include <glad/glad.h>
#include <GLFW/glfw3.h>
#include <iostream>

const char* vertexShaderSource = R"glsl(#version 410 core
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
// TODO clean
void main(){
	vec4 world = M*vec4(position, 1.0);
	gl_Position = P*V*world;
	vec3 n = normalize(normal);
	vec3 l = normalize(u_light_pos - position);
	v_col = max(dot(n, l), 0.0) * materialColour;
}
)glsl";

const char* fragmentShaderSource = R"glsl(#version 410 core
precision mediump float;
in vec3 v_col;
out vec4 outColor;
// TODO clean
void main() {
	outColor = vec4(v_col, 1.0);
}
)glsl";

int main() {
    glfwInit();
    // ...
    return 0;
}
