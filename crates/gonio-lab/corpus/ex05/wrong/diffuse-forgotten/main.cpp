#include <string>

const std::string sourceV =
    "#version 300 es\n"
    "in vec3 position;\n"
    "in vec3 normal;\n"
    "uniform mat4 M;\n"
    "uniform mat4 V;\n"
    "uniform mat4 P;\n"
    "uniform mat4 itM;\n"
    "uniform vec3 u_light_pos;\n"
    "uniform vec3 u_view_pos;\n"
    "uniform float shininess;\n"
    "out float v_diffuse;\n"
    "out float v_specular;\n"
    "// TODO clean\n"
    "void main() {\n"
    "    vec4 w = M * vec4(position, 1.0);\n"
    "    vec3 n = normalize(mat3(itM) * normal);\n"
    "    vec3 l = normalize(u_light_pos - w.xyz);\n"
    "    vec3 v = normalize(u_view_pos - w.xyz);\n"
    "    v_diffuse = max(dot(n, l), 0.0);\n"
    "    v_specular = pow(max(dot(reflect(-l, n), v), 0.0), shininess);\n"
    "    gl_Position = P * V * w;\n"
    "}\n";

const std::string sourceF =
    "#version 300 es\n"
    "precision mediump float;\n"
    "in float v_diffuse;\n"
    "in float v_specular;\n"
    "uniform vec3 materialColour;\n"
    "out vec4 outColor;\n"
    "// TODO clean\n"
    "void main() { outColor = vec4(materialColour * v_specular , 1.0); }\n";

int main(int argc, char* argv[]) {
    Shader shader(sourceV, sourceF);
    return 0;
}
