#include <string>

const std::string sourceV =
    "#version 150\n"
    "in vec3 position;\n"
    "in vec3 normal;\n"
    "uniform mat4 M;\n"
    "uniform mat4 V;\n"
    "uniform mat4 P;\n"
    "uniform mat4 itM;\n"
    "uniform vec3 u_light_pos;\n"
    "uniform vec3 u_view_pos;\n"
    "uniform vec3 materialColour;\n"
    "uniform float shininess;\n"
    "out vec4 v_col;\n"
    "void main()\n"
    "{\n"
    "	vec3 p = (M * vec4(position, 1.0)).xyz;\n"
    "	vec3 n = normalize(mat3(itM) * normal);\n"
    "	vec3 l = normalize(u_light_pos - p);\n"
    "	vec3 v = normalize(u_view_pos - p);\n"
    "	vec3 r = 2.0 * dot(n, l) * n - l;\n"
    "	float diff = max(dot(n, l), 0.3) ;\n"
    "	float spec = pow(max(dot(r, v), 0.0), shininess);\n"
    "	v_col = vec4(diff * materialColour , 1.0);\n"
    "	gl_Position = P * V * vec4(p, 1.0);\n"
    "}\n";

const std::string sourceF =
    "#version 150\n"
    "in vec4 v_col;\n"
    "out vec4 FragColor;\n"
    "void main()\n"
    "{\n"
    "	FragColor = v_col;\n"
    "}\n";

int main(int argc, char* argv[]) {
    Shader shader(sourceV, sourceF);
    return 0;
}
