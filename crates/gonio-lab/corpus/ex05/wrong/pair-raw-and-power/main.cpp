#include <glad/glad.h>
#include <GLFW/glfw3.h>
#include <iostream>

const char* vertexShaderSource = R"glsl(#version 330 core
in vec3 position;
in vec2 tex_coords;
in vec3 normal;
out float v_diffuse;
out float v_specular;
uniform mat4 M;
uniform mat4 itM;
uniform mat4 V;
uniform mat4 P;
uniform vec3 u_light_pos;
uniform vec3 u_view_pos;

float specularCalculation(vec3 N, vec3 L, vec3 V){
    vec3 R = reflect(-L, N);
    float cosTheta = dot(R, V);
    return max(cosTheta, 0.0);
}

// TODO clean
void main(){
    vec4 frag_coord = M*vec4(position, 1.0);
    gl_Position = P*V*frag_coord;
    vec3 norm = normalize(normal);
    vec3 L = normalize(u_light_pos - frag_coord.xyz);
    vec3 E = normalize(u_view_pos - frag_coord.xyz);
    v_diffuse = max(0.0, dot(norm, L));
    v_specular = specularCalculation(norm, L, E);
}
)glsl";

const char* fragmentShaderSource = R"glsl(#version 400 core
out vec4 FragColor;
precision mediump float;
in float v_diffuse;
in float v_specular;
uniform vec3 materialColour;
// TODO clean
void main() {
    FragColor = vec4(materialColour * (v_diffuse + v_specular), 1.0);
}
)glsl";

int main() {
    glfwInit();
    // ...
    return 0;
}
