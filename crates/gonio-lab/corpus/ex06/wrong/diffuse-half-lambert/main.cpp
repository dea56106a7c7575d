#include <glad/glad.h>
#include <GLFW/glfw3.h>
#include <iostream>

const char* vertexShaderSource = R"glsl(#version 150
in vec3 position;
in vec3 normal;
uniform mat4 M, V, P, itM;
out vec3 pw, nw;


void main() { pw = (M*vec4(position,1.0)).xyz; nw = normalize(mat3(itM)*normal); gl_Position = P*V*vec4(pw,1.0); }
)glsl";

const char* fragmentShaderSource = R"glsl(#version 150
in vec3 pw, nw;
uniform mat4 V;
uniform vec3 lightPos, materialColour;
out vec4 FragColor;


void main() {
  vec3 cam = -transpose(mat3(V)) * V[3].xyz;   // camera position from the view matrix
  vec3 n = normalize(nw), l = normalize(lightPos - pw), e = normalize(cam - pw);
  float rv = max(dot(reflect(-l, n), e), 0.0);
  float h = dot(n, l)*0.5 + 0.5;
  FragColor = vec4((h*h + pow(rv, 32.0)) * materialColour, 1.0);
}
)glsl";

int main() {
    glfwInit();
    // ...
    return 0;
}
