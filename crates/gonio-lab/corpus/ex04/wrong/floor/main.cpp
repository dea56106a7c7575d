#include <string>

const std::string sourceV =
    "#version 330 core\n"
    "in vec3 position;\n"
    "in vec2 tex_coords;\n"
    "in vec3 normal;\n"
    "out vec3 v_normal;\n"
    "out vec3 fragCoord;\n"
    "uniform mat4 M;\n"
    "uniform mat4 itM;\n"
    "uniform mat4 V;\n"
    "uniform mat4 P;\n"
    "\n"
    "void main(){\n"
    "vec4 frag_coord = M*vec4(position, 1.0);\n"
    "gl_Position = P*V*frag_coord;\n"
    "v_normal = normalize(vec3(itM * vec4(normal, 1.0)));\n"
    "fragCoord = frag_coord.xyz;\n"
    "}\n";

const std::string sourceF =
    "#version 400 core\n"
    "out vec4 frag_color;\n"
    "precision mediump float;\n"
    "in vec3 v_normal;\n"
    "in vec3 fragCoord;\n"
    "uniform vec3 u_light_pos;\n"
    "uniform vec3 materialColour;\n"
    "\n"
    "void main() {\n"
    "vec3 n = normalize(v_normal);\n"
    "vec3 l = normalize(u_light_pos - fragCoord);\n"
    "float cosTheta = max(dot(n, l), 0.3) ;\n"
    "frag_color = vec4(cosTheta * materialColour, 1.0);\n"
    "}\n";

int main(int argc, char* argv[]) {
    Shader shader(sourceV, sourceF);
    return 0;
}
