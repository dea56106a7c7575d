#include <glad/glad.h>
#include <GLFW/glfw3.h>
#include <iostream>

const char* vertexShaderSource = R"glsl(#version 130
in vec3 position;
in vec3 normal;
in vec2 texcoord;
uniform mat4 M;
   uniform mat4 V;
uniform mat4 P;
	  uniform mat4 itM;
out vec3 v_normal;
out vec3 v_frag_coord;
void main()
{
  vec4 w=M*vec4(position,1.0);
	  v_frag_coord=w.xyz;
   v_normal=normalize((itM*vec4(normal,1.0)).xyz);
	gl_Position=P*V*w;
}
)glsl";

const char* fragmentShaderSource = R"glsl(#version 130
in vec3 v_normal;
in vec3 v_frag_coord;
uniform vec3 u_view_pos;
uniform float refractionIndice;
uniform float shininess;
uniform samplerCube cubemapSampler;
out vec4 outColor;
void main()
{
   vec3 N=normalize(v_normal);
	  vec3 V=normalize(u_view_pos-v_frag_coord);
   vec3 R=reflect(-V,N);
   //vec3 R=refract(-V,N,1.0/refractionIndice);
  outColor=vec4(texture(cubemapSampler,R).rgb,1.0);
}
)glsl";

int main() {
    glfwInit();
    // ...
    return 0;
}
