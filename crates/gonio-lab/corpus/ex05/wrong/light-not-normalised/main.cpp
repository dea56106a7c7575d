#include <string>

const std::string sourceV =
    "#version 440 core\n"
    "in vec3 aPos;\n"
    "in vec2 tex_coords;\n"
    "in vec3 aNormal;\n"
    "out vec4 v_col;\n"
    "uniform mat4 model;\n"
    "uniform mat4 itM;\n"
    "uniform mat4 view;\n"
    "uniform mat4 projection;\n"
    "uniform vec3 u_light_pos;\n"
    "uniform vec3 u_view_pos;\n"
    "uniform vec3 materialColour;\n"
    "void main(){\n"
    "vec4 frag_coord = model*vec4(aPos, 1.0);\n"
    "gl_Position = projection*view*frag_coord;\n"
    "vec3 norm = normalize(vec3(itM * vec4(aNormal, 1.0)));\n"
    "vec3 L = u_light_pos - frag_coord.xyz;\n"
    "vec3 E = normalize(u_view_pos - frag_coord.xyz);\n"
    "float diffuse = max(dot(norm, L), 0.0);\n"
    "float specular = pow(max(dot(reflect(-L, norm), E), 0.0), 32.0);\n"
    "v_col = vec4(materialColour*(diffuse + specular), 1.0);\n"
    "}\n";

const std::string sourceF =
    "#version 440 core\n"
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
