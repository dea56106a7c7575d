#include <string>

const std::string sourceV =
    "#version 330 core\n"
    "in vec3 position;\n"
    "in vec3 normal;\n"
    "out vec3 v_frag_coord;\n"
    "out vec3 v_normal;\n"
    "uniform mat4 M;\n"
    "uniform mat4 itM;\n"
    "uniform mat4 V;\n"
    "uniform mat4 P;\n"
    "void main(){\n"
    "v_frag_coord = vec3(M*vec4(position, 1.0));\n"
    "v_normal = vec3(itM * vec4(normal, 0.0));\n"
    "v_normal = normalize(v_normal);\n"
    "gl_Position = P*V*M*vec4(position, 1.0);\n"
    "}\n";

const std::string sourceF =
    "#version 330 core\n"
    "out vec4 FragColor;\n"
    "in vec3 v_frag_coord;\n"
    "in vec3 v_normal;\n"
    "uniform vec3 u_view_pos;\n"
    "uniform float refractionIndice;\n"
    "uniform samplerCube cubemapSampler;\n"
    "void main() {\n"
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
