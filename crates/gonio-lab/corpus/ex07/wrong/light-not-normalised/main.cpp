#include <glad/glad.h>
#include <GLFW/glfw3.h>
#include <iostream>

const char* vertexShaderSource = R"glsl(#version 410 core
in vec3 position;
in vec3 normal;
in vec2 tex_coord;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
out vec3 Normal;
out vec3 FragPos;
out vec2 v_tex;

void main()
{
	v_tex = vec2(tex_coord.x, 1.0 - tex_coord.y);
	Normal = normalize(mat3(itM) * normal);
	FragPos = (M * vec4(position, 1.0)).xyz;
	gl_Position = P * V * M * vec4(position, 1.0);
}
)glsl";

const char* fragmentShaderSource = R"glsl(#version 410 core
in vec3 Normal;
in vec3 FragPos;
in vec2 v_tex;
uniform vec3 lightPos;
uniform vec3 viewPos;
uniform vec3 materialColour;
out vec4 FragColor;

const float ambientStrength = 0.1;
const float diffuseStrength = 0.5;
const float specularStrength = 0.8;
const float kc = 1.0, kl = 0.14, kq = 0.07;


void main()
{
	vec3 N = normalize(Normal);
	vec3 L = lightPos - FragPos;
	vec3 V = normalize(viewPos - FragPos);
	vec3 R = reflect(-L, N);
	float d = distance(lightPos, FragPos);
	float att = 1.0 / (kc + kl*d + kq*d*d);
	float ambient = ambientStrength;
	float diffuse = diffuseStrength * max(0.0, dot(N, L));
	float specular = specularStrength * pow(max(0.0, dot(R, V)), 32);
	FragColor = vec4((ambient + att * (diffuse + specular)) * materialColour, 1.0);
}
)glsl";

int main() {
    glfwInit();
    // ...
    return 0;
}
