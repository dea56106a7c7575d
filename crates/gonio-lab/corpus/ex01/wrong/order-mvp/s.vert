#version 330 core
in vec3 position;
in vec3 color;

uniform mat4 M;
uniform mat4 V;
uniform mat4 P;

out vec3 v_col;

void main(){
    v_col = color;
    gl_Position = M*V*P*vec4(position, 1.0);
}
