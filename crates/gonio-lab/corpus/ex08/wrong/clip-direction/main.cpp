#include <glad/glad.h>
#include <GLFW/glfw3.h>
#include <iostream>

const char* vertexShaderSource = R"glsl(#version 150
in vec3 position;
in vec2 tex_coords;
in vec3 normal;
uniform mat4 V;
uniform mat4 P;
out vec3 v_t;
void main(){
  mat4 view = V;
  view[3][0] = 0.0;
  view[3][1] = 0.0;
  view[3][2] = 0.0;
  vec4 p = P * view * vec4(position, 1.0);
  v_t = p.xyz;
  gl_Position = p.xyww;
}
)glsl";

const char* fragmentShaderSource = R"glsl(#version 150
in vec3 v_t;
uniform samplerCube cubemapSampler;
out vec4 FragColor;
void main(){
  FragColor = texture(cubemapSampler, v_t);
}
)glsl";

int main() {
    glfwInit();
    // ...
    return 0;
}
