#include <glad/glad.h>
#include <GLFW/glfw3.h>
#include <iostream>

const char* vertexShaderSource = R"glsl(#version 330
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
    normal_v = normalize(vec3(M * vec4(normal, 1.0)));
    frag_pos = frag_coord.xyz;
}
)glsl";

const char* fragmentShaderSource = R"glsl(#version 330
out vec4 fragColor;
precision mediump float;
in vec3 frag_pos;
in vec3 normal_v;
uniform vec3 viewPos;
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
    vec3 N = normalize(normal_v);
    vec3 L = normalize(light.light_pos - frag_pos);
    vec3 V = normalize(viewPos - frag_pos);
    vec3 R = reflect(-L, N);
    float specular = light.specular_strength * pow(max(dot(R, V), 0.0), shininess);
    float diffuse = light.diffuse_strength * max(dot(N, L), 0.0);
    float d = distance(light.light_pos, frag_pos);
    float attenuation = 1 / (light.constant + light.linear * d + light.quadratic * d * d);
    fragColor = vec4(materialColour * (light.ambient_strength + attenuation * (diffuse + specular)), 1.0);
}
)glsl";

int main() {
    glfwInit();
    // ...
    return 0;
}
