#include <string>

const std::string sourceV =
    "#version 150\n"
    "in vec3 position;\n"
    "in vec3 normal;\n"
    "out vec3 Normal;\n"
    "out vec3 v_pos;\n"
    "uniform mat4 M;\n"
    "uniform mat4 itM;\n"
    "uniform mat4 V;\n"
    "uniform mat4 P;\n"
    "// TODO clean\n"
    "void main()\n"
    "{\n"
    "vec4 world = M*vec4(position, 1.0);\n"
    "Normal = normalize(vec3(itM * vec4(normal, 1.0)));\n"
    "gl_Position = P*V*world;\n"
    "v_pos = gl_Position.xyz;\n"
    "}\n";

const std::string sourceF =
    "#version 150\n"
    "out vec4 FragColor;\n"
    "precision mediump float;\n"
    "in vec3 Normal;\n"
    "in vec3 v_pos;\n"
    "uniform vec3 lightPos;\n"
    "uniform vec3 viewPos;\n"
    "uniform vec3 materialColour;\n"
    "// TODO clean\n"
    "void main()\n"
    "{\n"
    "vec3 n = normalize(Normal);\n"
    "vec3 toLight = normalize(lightPos - v_pos);\n"
    "vec3 toEye = normalize(viewPos - v_pos);\n"
    "float kd = max(dot(n, toLight), 0.0);\n"
    "float ks = kd > 0.0 ? pow(max(dot(toEye, reflect(-toLight, n)), 0.0), 32.0) : 0.0;\n"
    "FragColor = vec4((kd + ks)*materialColour, 1.0);\n"
    "}\n";

int main(int argc, char* argv[]) {
    Shader shader(sourceV, sourceF);
    return 0;
}
