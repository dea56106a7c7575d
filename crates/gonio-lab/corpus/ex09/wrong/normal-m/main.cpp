#include <glad/glad.h>
#include <GLFW/glfw3.h>
#include <iostream>

const char* vertexShaderSource = R"glsl(#version 330 core
in vec3 aPos;
in vec2 tex_coords;
in vec3 aNormal;
out vec3 v_frag_coord;
out vec3 v_normal;
uniform mat4 model;
uniform mat4 itM;
uniform mat4 view;
uniform mat4 projection;


void main(){
  vec4 frag_coord = model*vec4(aPos, 1.0);
  gl_Position = projection*view*frag_coord;
  v_normal = normalize(vec3(model * vec4(aNormal, 0.0)));
  v_frag_coord = frag_coord.xyz;
}
)glsl";

const char* fragmentShaderSource = R"glsl(#version 400 core
uniform samplerCube cubemapSampler;
out vec4 FragColor;
precision mediump float;
uniform vec3 u_view_pos;
in vec3 v_frag_coord;
in vec3 v_normal;


void main() {
  vec3 N = normalize(v_normal);
  vec3 view = normalize(u_view_pos - v_frag_coord);
  vec3 R = reflect(-view,N);
  FragColor = texture(cubemapSampler,R);
}
)glsl";

int main() {
    glfwInit();
    // ...
    return 0;
}
