#include <glad/glad.h>
#include <GLFW/glfw3.h>
#include <iostream>

const char* vertexShaderSource = R"glsl(#version 330 core
in vec3 position;
in vec2 tex_coords;
in vec3 normal;
out vec3 v_normal;
out vec3 v_frag_coord;
uniform mat4 M;
uniform mat4 itM;
uniform mat4 V;
uniform mat4 P;
void main(){
    gl_Position = P*V*M*vec4(position, 1);
    v_normal = normalize(vec3(itM*vec4(normal, 0)));
    v_frag_coord = vec3(M*vec4(position, 1));
}
)glsl";

const char* fragmentShaderSource = R"glsl(#version 330 core
precision mediump float;
out vec4 FragColor;
in vec3 v_normal;
in vec3 v_frag_coord;
uniform vec3 u_light_pos;
uniform vec3 u_view_pos;
uniform vec3 materialColour;
uniform float shininess;
float specularCalculation(vec3 N, vec3 L, vec3 V){
    vec3 R = reflect(-L, N);
    float cosTheta = max(dot(R, V), 0.0);
    return pow(cosTheta, shininess);
}
void main(){
    vec3 N = normalize(v_normal);
    vec3 L = normalize(u_light_pos - v_frag_coord);
    vec3 V = normalize(u_view_pos - v_frag_coord);
    float diffuse = max(dot(N, L), 0.0);
    float specular = specularCalculation(N, L, V);
    FragColor = vec4(materialColour*(diffuse + specular), 1.0);
}
)glsl";

int main() {
    glfwInit();
    // ...
    return 0;
}
