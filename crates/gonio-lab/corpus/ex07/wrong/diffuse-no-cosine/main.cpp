#include <glad/glad.h>
#include <GLFW/glfw3.h>
#include <iostream>

const char* vertexShaderSource = R"glsl(#version 440 core
in vec3 a_Position;
in vec3 a_Normal;
uniform mat4 M, V, P, itM;
out vec3 x;
out vec3 n;

void main() { x = (M * vec4(a_Position, 1.)).xyz; n = normalize(mat3(itM) * a_Normal); gl_Position = P * V * vec4(x, 1.); }
)glsl";

const char* fragmentShaderSource = R"glsl(#version 440 core
// Lo(x) = A + (diff + spec) . Li . att . cos(theta)
in vec3 x;
in vec3 n;
out vec4 Lo;
struct Light { vec3 light_pos; float ambient_strength; float diffuse_strength; float specular_strength; float constant; float linear; float quadratic; };
uniform Light light;
uniform vec3 u_view_pos, materialColour;
uniform float shininess;

void main() {
    vec3 N = normalize(n), wi = normalize(light.light_pos - x), wo = normalize(u_view_pos - x);
    float d = distance(x, light.light_pos);
    float att = 1. / (light.constant + light.linear*d + light.quadratic*d*d);
    float cosTheta = max(dot(wi, N), 0.);
    float diff = light.diffuse_strength;
    float spec = light.specular_strength * pow(max(dot(reflect(-wi, N), wo), 0.), shininess);
    Lo = vec4(materialColour * (light.ambient_strength + (diff + spec) * att), 1.);
}
)glsl";

int main() {
    glfwInit();
    // ...
    return 0;
}
