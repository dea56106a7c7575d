#include <string>

const std::string sourceV =
    "#version 330\n"
    "in vec3 aPos;\n"
    "in vec3 aNormal;\n"
    "in vec2 tex_coord;\n"
    "uniform mat4 model;\n"
    "uniform mat4 view;\n"
    "uniform mat4 projection;\n"
    "uniform mat4 itM;\n"
    "out vec3 v_frag_coord;\n"
    "out vec3 v_normal;\n"
    "\n"
    "\n"
    "void main()\n"
    "{\n"
    "    v_frag_coord = vec3(model * vec4(aPos, 1.0));\n"
    "    v_normal = normalize(mat3(itM) * aNormal);\n"
    "    gl_Position = projection * view * model * vec4(aPos, 1.0);\n"
    "}\n";

const std::string sourceF =
    "#version 330\n"
    "in vec3 v_frag_coord;\n"
    "in vec3 v_normal;\n"
    "uniform vec3 u_light_pos;\n"
    "uniform vec3 u_view_pos;\n"
    "uniform vec3 materialColour;\n"
    "uniform float shininess;\n"
    "out vec4 FragColor;\n"
    "\n"
    "\n"
    "\n"
    "void main()\n"
    "{\n"
    "    vec3 N = normalize(v_normal);\n"
    "    vec3 L = normalize(u_light_pos - v_frag_coord);\n"
    "    vec3 view = normalize(u_view_pos - v_frag_coord);\n"
    "    vec3 R = reflect(-L, N);\n"
    "\n"
    "    // diffuse and specular\n"
    "    float diffuse = max(dot(N, L), 0.0);\n"
    "    float specular = pow(max(dot(R, view), 0.0), shininess);\n"
    "\n"
    "    FragColor = vec4(materialColour * (specular) , 1.0);\n"
    "}\n";

int main(int argc, char* argv[]) {
    Shader shader(sourceV, sourceF);
    return 0;
}
