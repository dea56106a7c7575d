#include <string>

const std::string sourceV =
    "#version 110\n"
    "attribute vec3 a_Position;\n"
    "attribute vec3 a_Normal;\n"
    "\n"
    "uniform mat4 u_Model;\n"
    "uniform mat4 u_View;\n"
    "uniform mat4 u_Projection;\n"
    "uniform mat4 u_Normal; // inverse transpose of u_Model\n"
    "\n"
    "varying vec3 v_Normal;\n"
    "varying vec3 v_Position;\n"
    "\n"
    "void main() {\n"
    "    v_Normal = (u_Normal * vec4(a_Normal, 0.0)).xyz;\n"
    "    vec4 world = u_Model * vec4(a_Position, 1.0);\n"
    "    v_Position = world.xyz;\n"
    "    gl_Position = u_Projection * u_View * world;\n"
    "}\n";

const std::string sourceF =
    "#version 110\n"
    "varying vec3 v_Normal;\n"
    "varying vec3 v_Position;\n"
    "\n"
    "struct Light {\n"
    "    vec3 light_pos;\n"
    "    float ambient_strength;\n"
    "    float diffuse_strength;\n"
    "    float specular_strength;\n"
    "    float constant;\n"
    "    float linear;\n"
    "    float quadratic;\n"
    "};\n"
    "uniform Light light;\n"
    "uniform vec3 u_view_pos;\n"
    "uniform vec3 materialColour;\n"
    "uniform float shininess;\n"
    "\n"
    "void main() {\n"
    "    vec3 N = normalize(v_Normal);\n"
    "    vec3 toLight = light.light_pos - v_Position;\n"
    "    float d = length(toLight);\n"
    "    vec3 L = toLight / d;\n"
    "    vec3 view = normalize(u_view_pos - v_Position);\n"
    "    vec3 R = reflect(-L, N);\n"
    "\n"
    "    float lambert = max(0.15, dot(N, L)) ;\n"
    "    float spec = pow(max(0.0, dot(R, view)), shininess);\n"
    "    float att = 1.0 / (light.constant + d * (light.linear + d * light.quadratic));\n"
    "\n"
    "    gl_FragColor = vec4(materialColour, 1.0) * vec4(vec3(light.ambient_strength + att * (light.diffuse_strength * lambert + light.specular_strength * spec)), 1.0);\n"
    "}\n";

int main(int argc, char* argv[]) {
    Shader shader(sourceV, sourceF);
    return 0;
}
