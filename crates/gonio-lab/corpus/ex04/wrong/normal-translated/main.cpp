#include <string>

const std::string sourceV =
    "#version 150\n"
    "in vec3 position;\n"
    "in vec3 normal;\n"
    "uniform mat4 M;\n"
    "uniform mat4 V;\n"
    "uniform mat4 P;\n"
    "uniform mat4 itM;\n"
    "out vec3 v_normal;\n"
    "out vec3 v_pos;\n"
    "// ------------\n"
    "void main() {\n"
    "    v_normal = normalize(vec3(M * vec4(normal, 1.0)));\n"
    "    v_pos = vec3(M * vec4(position, 1.0));\n"
    "    gl_Position = P * V * M * vec4(position, 1.0);\n"
    "}\n";

const std::string sourceF =
    "#version 150\n"
    "in vec3 v_normal;\n"
    "in vec3 v_pos;\n"
    "uniform vec3 u_light_pos;\n"
    "uniform vec3 materialColour;\n"
    "out vec4 outColor;\n"
    "// ------------\n"
    "void main() {\n"
    "    vec3 n = normalize(v_normal);\n"
    "    vec3 l = normalize(u_light_pos - v_pos);\n"
    "    float diffuse = max(dot(n, l), 0.0);\n"
    "    outColor = vec4(materialColour * diffuse, 1.0);\n"
    "}\n";

int main(int argc, char* argv[]) {
    Shader shader(sourceV, sourceF);
    return 0;
}
