#include <string>

const std::string sourceV =
    "#version 400 core\n"
    "in vec3 position;\n"
    "in vec2 tex_coords;\n"
    "in vec3 normal;\n"
    "out vec4 v_col;\n"
    "uniform mat4 M;\n"
    "uniform mat4 itM;\n"
    "uniform mat4 V;\n"
    "uniform mat4 P;\n"
    "uniform vec3 u_light_pos;\n"
    "uniform vec3 u_view_pos;\n"
    "uniform vec3 materialColour;\n"
    "void main(){\n"
    "vec4 frag_coord = M*vec4(position, 1.0);\n"
    "gl_Position = P*V*frag_coord;\n"
    "vec3 norm = normalize(vec3(itM * vec4(normal, 1.0)));\n"
    "vec3 L = normalize(u_light_pos - frag_coord.xyz);\n"
    "vec3 E = normalize(u_view_pos - position) ;\n"
    "float diffuse = max(dot(norm, L), 0.0);\n"
    "float specular = pow(max(dot(reflect(-L, norm), E), 0.0), 32.0);\n"
    "v_col = vec4(materialColour*(diffuse + specular), 1.0);\n"
    "}\n";

const std::string sourceF =
    "#version 400 core\n"
    "out vec4 FragColor;\n"
    "precision mediump float;\n"
    "in vec4 v_col;\n"
    "void main() {\n"
    "FragColor = v_col;\n"
    "}\n";

int main(int argc, char* argv[]) {
    Shader shader(sourceV, sourceF);
    return 0;
}
