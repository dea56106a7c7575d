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
    v_frag_coord = frag_coord;
}
)glsl";

const char* fragmentShaderSource = R"glsl(#version 330 core
out vec4 FragColor;
precision mediump float;
in vec3 v_frag_coord;
in vec3 v_normal;
uniform vec3 u_view_pos;
struct Light{
    vec3 light_pos;
    float ambient_strength;
    float diffuse_strength;
    float specular_strength;
    float constant;
    float linear;
    float quadratic;
};
uniform Light light;
uniform float shininess;
uniform vec3 materialColour;
void main() {
    vec3 N = normalize(v_normal);
    vec3 L = normalize(light.light_pos - v_frag_coord);
    vec3 V = normalize(u_view_pos - v_frag_coord);
    vec3 R = reflect(-L, N);
    float specular = light.specular_strength * pow(max(dot(R, V), 0.0), shininess);
    float diffuse = light.diffuse_strength * max(dot(N, L), 0.0);
    float d = distance(light.light_pos, v_frag_coord);
    float attenuation = 1 / (light.constant + light.linear * d + light.quadratic * d * d);
    FragColor = vec4(materialColour * (light.ambient_strength + attenuation * (diffuse + specular)), 1.0);
}
)glsl";

int main() {
    glfwInit();
    // ...
    return 0;
}
