#include <string>

const std::string sourceV =
    "#version 330\n"
    "in vec3 position;\n"
    "in vec2 tex_coords;\n"
    "in vec3 normal;\n"
    "out vec4 v_col;\n"
    "uniform mat4 M;\n"
    "uniform mat4 itM;\n"
    "uniform mat4 V;\n"
    "uniform mat4 P;\n"
    "uniform vec3 lightPos;\n"
    "uniform vec3 viewPos;\n"
    "uniform vec3 materialColour;\n"
    "void main()\n"
    "{\n"
    "vec4 frag_coord = M*vec4(position, 1.0);\n"
    "gl_Position = P*V*frag_coord;\n"
    "vec3 norm = normalize(vec3(M * vec4(normal, 0.0)) );\n"
    "vec3 L = normalize(lightPos - frag_coord.xyz);\n"
    "vec3 E = normalize(viewPos) ;\n"
    "float diffuse = max(dot(norm, L), 0.0);\n"
    "float specular = pow(max(dot(reflect(-L, norm), E), 0.0), 32.0);\n"
    "v_col = vec4(materialColour*(diffuse + specular), 1.0);\n"
    "}\n";

const std::string sourceF =
    "#version 330\n"
    "out vec4 FragColor;\n"
    "precision mediump float;\n"
    "in vec4 v_col;\n"
    "void main()\n"
    "{\n"
    "FragColor = v_col;\n"
    "}\n";

int main(int argc, char* argv[]) {
    Shader shader(sourceV, sourceF);
    return 0;
}
