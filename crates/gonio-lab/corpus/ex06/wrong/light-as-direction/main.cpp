#include <glad/glad.h>
#include <GLFW/glfw3.h>
#include <iostream>

const char* vertexShaderSource = R"glsl(#version 130
in vec3 position;
in vec2 tex_coords;
in vec3 normal;
out vec3 v_n;
out vec3 v_world;
uniform mat4 M;
uniform mat4 itM;
uniform mat4 V;
uniform mat4 P;
// TODO clean
void main(){
	gl_Position = P*V*M*vec4(position, 1);
	v_n = normalize(vec3(itM*vec4(normal, 0)));
	v_world = vec3(M*vec4(position, 1));
}
)glsl";

const char* fragmentShaderSource = R"glsl(#version 130
precision mediump float;
out vec4 FragColor;
in vec3 v_n;
in vec3 v_world;
uniform vec3 u_light_pos;
uniform vec3 u_view_pos;
uniform vec3 materialColour;
uniform float shininess;
float specularCalculation(vec3 N, vec3 L, vec3 V){
	vec3 R = reflect(-L, N);
	float cosTheta = max(dot(R, V), 0.0);
	return pow(cosTheta, shininess);
}
// TODO clean
void main(){
	vec3 N = normalize(v_n);
	vec3 L = normalize(u_light_pos);
	vec3 V = normalize(u_view_pos - v_world);
	float diffuse = max(dot(N, L), 0.0);
	float specular = specularCalculation(N, L, V);
	FragColor = vec4(materialColour*(diffuse + specular), 1.0);
}
)glsl";

int main() {
    glfwInit();
    // ...
    return 0;
}
