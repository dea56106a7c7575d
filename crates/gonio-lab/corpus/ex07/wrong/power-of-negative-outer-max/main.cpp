#include <glad/glad.h>
#include <GLFW/glfw3.h>
#include <iostream>

const char* vertexShaderSource = R"glsl(#version 130
in vec3 a_Position;
in vec2 tex_coords;
in vec3 a_Normal;
out vec3 vPos;
out vec3 vNormal;
uniform mat4 M;
uniform mat4 itM;
uniform mat4 V;
uniform mat4 P;

void main(){
    vec4 frag_coord = M*vec4(a_Position, 1.0);
    gl_Position = P*V*frag_coord;
    vNormal = normalize(vec3(itM * vec4(a_Normal, 1.0)));
    vPos = frag_coord.xyz;
}
)glsl";

const char* fragmentShaderSource = R"glsl(#version 130
out vec4 color_out;
precision mediump float;
in vec3 vPos;
in vec3 vNormal;
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
    vec3 N = normalize(vNormal);
    vec3 L = normalize(light.light_pos - vPos);
    vec3 V = normalize(u_view_pos - vPos);
    vec3 R = reflect(-L, N);
    float specular = light.specular_strength * max(pow(dot(R, V), shininess), 0.0);
    float diffuse = light.diffuse_strength * max(dot(N, L), 0.0);
    float d = distance(light.light_pos, vPos);
    float attenuation = 1 / (light.constant + light.linear * d + light.quadratic * d * d);
    color_out = vec4(materialColour * (light.ambient_strength + attenuation * (diffuse + specular)), 1.0);
}
)glsl";

int main() {
    glfwInit();
    // ...
    return 0;
}
