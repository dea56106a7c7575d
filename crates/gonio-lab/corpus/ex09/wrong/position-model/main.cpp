#include <string>

const std::string sourceV =
    "#version 330\n"
    "in vec3 position;\n"
    "in vec3 normal;\n"
    "out vec3 FragPos;\n"
    "out vec3 Normal;\n"
    "uniform mat4 M;\n"
    "uniform mat4 itM;\n"
    "uniform mat4 V;\n"
    "uniform mat4 P;\n"
    "\n"
    "void main(){\n"
    "FragPos = position;\n"
    "Normal = vec3(itM * vec4(normal, 0.0));\n"
    "Normal = normalize(Normal);\n"
    "gl_Position = P*V*M*vec4(position, 1.0);\n"
    "}\n";

const std::string sourceF =
    "#version 330\n"
    "out vec4 FragColor;\n"
    "in vec3 FragPos;\n"
    "in vec3 Normal;\n"
    "uniform vec3 viewPos;\n"
    "uniform samplerCube cubemapSampler;\n"
    "\n"
    "void main() {\n"
    "vec3 incident = normalize(FragPos - viewPos);\n"
    "vec3 n = normalize(Normal);\n"
    "vec3 r = incident - 2.0*dot(n, incident)*n;\n"
    "FragColor = texture(cubemapSampler, r);\n"
    "}\n";

int main(int argc, char* argv[]) {
    Shader shader(sourceV, sourceF);
    return 0;
}
