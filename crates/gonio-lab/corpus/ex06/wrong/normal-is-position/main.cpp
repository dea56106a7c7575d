#include <glad/glad.h>
#include <GLFW/glfw3.h>
#include <iostream>

const char* vertexShaderSource = R"glsl(#version 130
in vec3 position, normal;
uniform mat4 MVP, M;
out vec3 P3, N3;
// TODO clean
void main() { gl_Position = MVP * vec4(position, 1.0); P3 = (M * vec4(position, 1.0)).xyz; N3 = normalize((M * vec4(position, 0.0)).xyz); }
)glsl";

const char* fragmentShaderSource = R"glsl(#version 130
in vec3 P3, N3;
uniform vec3 u_light_pos, u_view_pos, materialColour;
out vec4 c;
// TODO clean
void main() {
	vec3 n = normalize(N3), l = normalize(u_light_pos - P3), v = normalize(u_view_pos - P3);
	float s = max(0.0, dot(2.0 * dot(l, n) * n - l, v));
	s *= s; s *= s; s *= s; s *= s; s *= s; // ^32
	c = vec4((max(0.0, dot(n, l)) + s) * materialColour, 1.0);
}
)glsl";

int main() {
    glfwInit();
    // ...
    return 0;
}
