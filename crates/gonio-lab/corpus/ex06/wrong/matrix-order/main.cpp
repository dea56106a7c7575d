#include <string>

const std::string sourceV =
    "#version 150\n"
    "in vec3 position;\n"
    "in vec3 normal;\n"
    "uniform mat4 M;\n"
    "uniform mat4 V;\n"
    "uniform mat4 P;\n"
    "uniform mat4 itM;\n"
    "out vec3 pos;\n"
    "out vec3 n;\n"
    "\n"
    "void main()\n"
    "{\n"
    "    pos = (M * vec4(position, 1.0)).xyz;\n"
    "    n = normalize((itM * vec4(normal, 1.0)).xyz);\n"
    "    gl_Position = P * M * V * vec4(position, 1.0);\n"
    "}\n";

const std::string sourceF =
    "#version 150\n"
    "in vec3 pos;\n"
    "in vec3 n;\n"
    "uniform vec3 lightPos;\n"
    "uniform vec3 viewPos;\n"
    "uniform float shininess;\n"
    "out vec4 FragColor;\n"
    "\n"
    "void main()\n"
    "{\n"
    "    vec3 nn = normalize(n);\n"
    "    vec3 light = normalize(lightPos - pos);\n"
    "    vec3 eye = normalize(viewPos - pos);\n"
    "    vec3 refl = reflect(-light, nn);\n"
    "    float I = max(dot(nn, light), 0.0) + pow(max(dot(refl, eye), 0.0), shininess);\n"
    "    FragColor = vec4(I, I, I, 1.0);\n"
    "}\n";

int main(int argc, char* argv[]) {
    Shader shader(sourceV, sourceF);
    return 0;
}
