#include <glad/glad.h>
#include <GLFW/glfw3.h>
#include <iostream>

const char* vertexShaderSource = R"glsl(#version 330 core
in vec3 position;
in vec2 tex_coords;
in vec3 normal;
out vec3 FragPos;
out vec3 Normal;
uniform mat4 M;
uniform mat4 itM;
uniform mat4 V;
uniform mat4 P;

void main(){
    vec4 frag_coord = M*vec4(position, 1.0);
    gl_Position = P*V*frag_coord;
    Normal = normalize(vec3(itM * vec4(normal, 1.0)));
    FragPos = frag_coord.xyz;
}
)glsl";

const char* fragmentShaderSource = R"glsl(#version 400 core
uniform samplerCube cubemapSampler;
uniform float refractionIndice;
out vec4 FragColor;
precision mediump float;
uniform vec3 viewPos;
in vec3 FragPos;
in vec3 Normal;

void main() {
    float ratio = 1.00 / refractionIndice;
    vec3 N = normalize(Normal);
    vec3 V = normalize(viewPos);
    vec3 R = refract(-V,N,ratio);
    FragColor = vec4(texture(cubemapSampler,R).rgb, 1.0);
}
)glsl";

int main() {
    glfwInit();
    // ...
    return 0;
}
