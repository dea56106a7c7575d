#include <glad/glad.h>
#include <GLFW/glfw3.h>
#include <iostream>

const char* vertexShaderSource = R"glsl(#version 400 core
in vec3 position;
in vec2 tex_coords;
in vec3 normal;
out vec3 normal_v;
out vec3 frag_pos;
uniform mat4 M;
uniform mat4 itM;
uniform mat4 V;
uniform mat4 P;
void main(){
    gl_Position = P*V*M*vec4(position, 1);
    normal_v = normalize(vec3(itM*vec4(normal, 0)));
    frag_pos = vec3(M*vec4(position, 1));
}
)glsl";

const char* fragmentShaderSource = R"glsl(#version 400 core
precision mediump float;
out vec4 fragColor;
in vec3 normal_v;
in vec3 frag_pos;
uniform vec3 u_light_pos;
uniform vec3 viewPos;
uniform vec3 materialColour;
uniform float shininess;
float specularCalculation(vec3 N, vec3 L, vec3 V){
    vec3 R = reflect(-L, N);
    float cosTheta = max(dot(N, V), 0.0);
    return pow(cosTheta, shininess);
}
void main(){
    vec3 N = normalize(normal_v);
    vec3 L = normalize(u_light_pos - frag_pos);
    vec3 V = normalize(viewPos - frag_pos);
    float diffuse = max(dot(N, L), 0.0);
    float specular = specularCalculation(N, L, V);
    fragColor = vec4(materialColour*(diffuse + specular), 1.0);
}
)glsl";

int main() {
    glfwInit();
    // ...
    return 0;
}
