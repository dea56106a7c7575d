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
    "vec4 frag_coord = M*vec4(position, 1.0);\n"
    "gl_Position = P*V*frag_coord;\n"
    "v_normal = vec3(itM * vec4(normal, 0.0));\n"
    "v_normal = normalize(v_normal);\n"
    "v_frag_coord = frag_coord.xyz;\n"
    "}\n";

const std::string sourceF =
    "#version 330 core\n"
    "out vec4 FragColor;\n"
    "precision mediump float;\n"
    "in vec3 v_frag_coord;\n"
    "in vec3 v_normal;\n"
    "uniform vec3 u_view_pos;\n"
    "struct Light{\n"
    "vec3 light_pos;\n"
    "float ambient_strength;\n"
    "float diffuse_strength;\n"
    "float specular_strength;\n"
    "float constant;\n"
    "float linear;\n"
    "float quadratic;\n"
    "};\n"
    "uniform Light light;\n"
    "uniform float shininess;\n"
    "uniform vec3 materialColour;\n"
    "void main() {\n"
    "vec3 N = normalize(v_normal);\n"
    "vec3 L = normalize(light.light_pos - v_frag_coord) ;\n"
    "vec3 V = normalize(u_view_pos - v_frag_coord);\n"
    "vec3 R = normalize(2.0*dot(N,L)*N - L);\n"
    "float spec = pow(max(dot(R,V),0.0), shininess);\n"
    "float diff = max(dot(N,L), 0.0);\n"
    "float dist = length(light.light_pos - v_frag_coord);\n"
    "float att = 1.0/(light.constant + light.linear*dist + light.quadratic*dist*dist);\n"
    "vec3 amb = vec3(light.ambient_strength)*materialColour;\n"
    "vec3 dif = vec3(light.diffuse_strength)*diff*materialColour;\n"
    "vec3 spe = vec3(light.specular_strength)*spec*materialColour;\n"
    "FragColor = vec4(amb + att*dif + att*spe, 1.0);\n"
    "}\n";

int main(int argc, char* argv[]) {
    Shader shader(sourceV, sourceF);
    return 0;
}
