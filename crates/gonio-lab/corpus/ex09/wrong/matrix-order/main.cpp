#include <string>

const std::string sourceV =
    "#version 330 core\n"
    "in vec3 position;\n"
    "in vec3 normal;\n"
    "out vec3 fragCoord;\n"
    "out vec3 v_normal;\n"
    "uniform mat4 M;\n"
    "uniform mat4 itM;\n"
    "uniform mat4 V;\n"
    "uniform mat4 P;\n"
    "\n"
    "void main(){\n"
    "fragCoord = vec3(M*vec4(position, 1.0));\n"
    "v_normal = vec3(itM * vec4(normal, 0.0));\n"
    "v_normal = normalize(v_normal);\n"
    "gl_Position = P*M*V*vec4(position, 1.0);\n"
    "}\n";

const std::string sourceF =
    "#version 330 core\n"
    "out vec4 frag_color;\n"
    "in vec3 fragCoord;\n"
    "in vec3 v_normal;\n"
    "uniform vec3 camPos;\n"
    "uniform samplerCube cubemapSampler;\n"
    "\n"
    "void main() {\n"
    "vec3 incident = normalize(fragCoord - camPos);\n"
    "vec3 n = normalize(v_normal);\n"
    "vec3 r = incident - 2.0*dot(n, incident)*n;\n"
    "frag_color = texture(cubemapSampler, r);\n"
    "}\n";

int main(int argc, char* argv[]) {
    Shader shader(sourceV, sourceF);
    return 0;
}
