#include <string>

const std::string sourceV =
    "#version 400\n"
    "in vec3 position;\n"
    "in vec3 normal;\n"
    "uniform mat4 M, V, P, itM;\n"
    "uniform vec3 u_light_pos, viewPos, materialColour;\n"
    "uniform float shininess;\n"
    "out vec3 v_diffuse;\n"
    "out vec3 v_specular;\n"
    "void main() {\n"
    "  vec4 w = M * vec4(position, 1.0);\n"
    "  vec3 N = normalize((itM * vec4(normal, 0.0)).xyz);\n"
    "  vec3 L = normalize(u_light_pos - w.xyz);\n"
    "  vec3 E = normalize(-w.xyz) ;\n"
    "  v_diffuse = materialColour * max(dot(N, L), 0.0);\n"
    "  v_specular = vec3(pow(max(dot(reflect(-L, N), E), 0.0), shininess));\n"
    "  gl_Position = P * V * w;\n"
    "}\n";

const std::string sourceF =
    "#version 400\n"
    "in vec3 v_diffuse;\n"
    "in vec3 v_specular;\n"
    "out vec4 fragColor;\n"
    "void main() {\n"
    "  fragColor = vec4(v_diffuse + v_specular, 1.0);\n"
    "}\n";

int main(int argc, char* argv[]) {
    Shader shader(sourceV, sourceF);
    return 0;
}
