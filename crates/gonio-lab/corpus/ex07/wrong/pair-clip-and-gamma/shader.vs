#version 330 core
in vec3 position;
in vec3 normal;
uniform mat4 MVP;
uniform mat4 M;
uniform mat4 itM;
out vec3 FragPos;
out vec3 Normal;
void main() {
    Normal = normalize((itM*vec4(normal,0)).xyz);
    gl_Position = MVP*vec4(position,1);
    FragPos = gl_Position.xyz;
}
