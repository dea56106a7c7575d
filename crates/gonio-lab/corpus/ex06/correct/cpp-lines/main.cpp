#include <string>

const std::string sourceV =
    "#version 330 core\n"
    "in vec3 position;\n"
    "in vec3 normal;\n"
    "out vec3 v_normal;\n"
    "out vec3 v_pos;\n"
    "uniform mat4 M;\n"
    "uniform mat4 itM;\n"
    "uniform mat4 V;\n"
    "uniform mat4 P;\n"
    "void main(){\n"
    "vec4 world = M*vec4(position, 1.0);\n"
    "v_pos = world.xyz;\n"
    "v_normal = normalize(vec3(itM * vec4(normal, 1.0)));\n"
    "gl_Position = P*V*world;\n"
    "}\n";

const std::string sourceF =
    "#version 330 core\n"
    "out vec4 FragColor;\n"
    "precision mediump float;\n"
    "in vec3 v_normal;\n"
    "in vec3 v_pos;\n"
    "uniform vec3 u_light_pos;\n"
    "uniform vec3 u_view_pos;\n"
    "uniform vec3 materialColour;\n"
    "void main() {\n"
    "vec3 n = normalize(v_normal);\n"
    "vec3 toLight = normalize(u_light_pos - v_pos);\n"
    "vec3 toEye = normalize(u_view_pos - v_pos);\n"
    "float kd = max(dot(n, toLight), 0.0);\n"
    "float ks = kd > 0.0 ? pow(max(dot(toEye, reflect(-toLight, n)), 0.0), 32.0) : 0.0;\n"
    "FragColor = vec4((kd + ks)*materialColour, 1.0);\n"
    "}\n";

int main(int argc, char* argv[]) {
    Shader shader(sourceV, sourceF);
    return 0;
}
