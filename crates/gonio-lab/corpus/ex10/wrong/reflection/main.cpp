#include <glad/glad.h>
#include <GLFW/glfw3.h>
#include <iostream>

const char* vertexShaderSource = R"glsl(#version 330 core
in vec3 position;
in vec2 tex_coords;
in vec3 normal;
out vec3 frag_pos;
out vec3 normal_v;
uniform mat4 M;
uniform mat4 itM;
uniform mat4 V;
uniform mat4 P;
void main(){
    vec4 frag_coord = M*vec4(position, 1.0);
    gl_Position = P*V*frag_coord;
    normal_v = normalize(vec3(itM * vec4(normal, 1.0)));
    frag_pos = frag_coord.xyz;
}
)glsl";

const char* fragmentShaderSource = R"glsl(#version 400 core
uniform samplerCube cubemapSampler;
uniform float refractionIndice;
out vec4 fragColor;
precision mediump float;
uniform vec3 viewPos;
in vec3 frag_pos;
in vec3 normal_v;
void main() {
    float ratio = 1.00 / refractionIndice;
    vec3 N = normalize(normal_v);
    vec3 V = normalize(viewPos - frag_pos);
    vec3 R = reflect(-V,N);
    fragColor = vec4(texture(cubemapSampler,R).rgb, 1.0);
}
)glsl";

int main() {
    glfwInit();
    // ...
    return 0;
}
