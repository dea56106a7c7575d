#include <string>

const std::string sourceV =
    "#version 330 core\n"
    "in vec3 aPos;\n"
    "in vec3 aNormal;\n"
    "out vec3 v_frag_coord;\n"
    "out vec3 v_normal;\n"
    "uniform mat4 model;\n"
    "uniform mat4 itM;\n"
    "uniform mat4 view;\n"
    "uniform mat4 projection;\n"
    "// TODO clean\n"
    "void main()\n"
    "{\n"
    "v_frag_coord = vec3(model*vec4(aPos, 1.0));\n"
    "v_normal = vec3(model * vec4(aNormal, 0.0)) ;\n"
    "v_normal = normalize(v_normal);\n"
    "gl_Position = projection*view*model*vec4(aPos, 1.0);\n"
    "}\n";

const std::string sourceF =
    "#version 330 core\n"
    "out vec4 FragColor;\n"
    "in vec3 v_frag_coord;\n"
    "in vec3 v_normal;\n"
    "uniform vec3 u_view_pos;\n"
    "uniform float refractionIndice;\n"
    "uniform samplerCube cubemapSampler;\n"
    "// TODO clean\n"
    "void main()\n"
    "{\n"
    "vec3 incident = normalize(v_frag_coord - u_view_pos);\n"
    "vec3 n = normalize(v_normal);\n"
    "float eta = 1.0/refractionIndice;\n"
    "float c = -dot(n, incident);\n"
    "float k = 1.0 - eta*eta*(1.0 - c*c);\n"
    "vec3 t = k < 0.0 ? vec3(0.0) : eta*incident + (eta*c - sqrt(k))*n;\n"
    "FragColor = texture(cubemapSampler, t);\n"
    "}\n";

int main(int argc, char* argv[]) {
    Shader shader(sourceV, sourceF);
    return 0;
}
