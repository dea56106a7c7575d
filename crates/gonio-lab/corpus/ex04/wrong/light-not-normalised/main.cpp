#include <string>

const std::string sourceV =
    "#version 330 core\n"
    "in vec3 position;\n"
    "in vec2 tex_coords;\n"
    "in vec3 normal;\n"
    "out vec3 Normal;\n"
    "out vec3 FragPos;\n"
    "uniform mat4 M;\n"
    "uniform mat4 itM;\n"
    "uniform mat4 V;\n"
    "uniform mat4 P;\n"
    "// ------------\n"
    "void main(){\n"
    "vec4 frag_coord = M*vec4(position, 1.0);\n"
    "gl_Position = P*V*frag_coord;\n"
    "Normal = normalize(vec3(itM * vec4(normal, 1.0)));\n"
    "FragPos = frag_coord.xyz;\n"
    "}\n";

const std::string sourceF =
    "#version 400 core\n"
    "out vec4 FragColor;\n"
    "precision mediump float;\n"
    "in vec3 Normal;\n"
    "in vec3 FragPos;\n"
    "uniform vec3 lightPos;\n"
    "uniform vec3 materialColour;\n"
    "// ------------\n"
    "void main() {\n"
    "vec3 n = normalize(Normal);\n"
    "vec3 l = lightPos - FragPos;\n"
    "float cosTheta = max(dot(n, l), 0.0);\n"
    "FragColor = vec4(cosTheta * materialColour, 1.0);\n"
    "}\n";

int main(int argc, char* argv[]) {
    Shader shader(sourceV, sourceF);
    return 0;
}
