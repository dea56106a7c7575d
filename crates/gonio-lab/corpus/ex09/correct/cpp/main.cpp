#include <glad/glad.h>
#include <GLFW/glfw3.h>
#include <iostream>

const char* vertexShaderSource = R"glsl(#version 330 core
in vec3 position;
in vec2 tex_coords;
in vec3 normal;
out vec3 v_frag_coord;
out vec3 v_normal;
uniform mat4 M;
uniform mat4 itM;
uniform mat4 V;
uniform mat4 P;
void main(){
    vec4 frag_coord = M*vec4(position, 1.0);
    gl_Position = P*V*frag_coord;
    v_normal = normalize(vec3(itM * vec4(normal, 1.0)));
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
    vec3 V = normalize(u_view_pos - v_frag_coord);
    vec3 R = reflect(-V,N);
    FragColor = texture(cubemapSampler,R);
}
)glsl";

int main() {
    glfwInit();
    // ...
    return 0;
}
