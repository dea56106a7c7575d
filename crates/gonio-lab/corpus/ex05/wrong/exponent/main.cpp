#include <string>

const std::string sourceV =
    "#version 150\n"
    "in vec3 a_Position;\n"
    "in vec3 a_Normal;\n"
    "uniform mat4 M;\n"
    "uniform mat4 V;\n"
    "uniform mat4 P;\n"
    "uniform mat4 itM;\n"
    "uniform vec3 lightPos;\n"
    "uniform vec3 camPos;\n"
    "uniform vec3 materialColour;\n"
    "out vec3 v_col;\n"
    "// TODO clean\n"
    "void main()\n"
    "{\n"
    "	vec3 w = vec3(M * vec4(a_Position, 1.0));\n"
    "	vec3 n = normalize(mat3(itM) * a_Normal);\n"
    "	vec3 l = normalize(lightPos - w);\n"
    "	vec3 view = normalize(w - camPos);\n"
    "	float spec = pow(max(dot(reflect(l, n), view), 0.0), 10.0);\n"
    "	v_col = (max(dot(n, l), 0.0) + spec) * materialColour;\n"
    "	gl_Position = P * V * vec4(w, 1.0);\n"
    "}\n";

const std::string sourceF =
    "#version 150\n"
    "in vec3 v_col;\n"
    "out vec4 color_out;\n"
    "// TODO clean\n"
    "void main()\n"
    "{\n"
    "	color_out = vec4(v_col, 1.0);\n"
    "}\n";

int main(int argc, char* argv[]) {
    Shader shader(sourceV, sourceF);
    return 0;
}
