#version 330 core
in vec3 position;
in vec3 normal;
out vec3 v_frag_coord;
out vec3 v_normal;
uniform mat4 M; uniform mat4 V; uniform mat4 P; uniform mat4 itM;
void main(){
vec4 pos = M * vec4(position, 1.0f);
v_frag_coord = vec3(pos);
v_normal = vec3(itM * vec4(normal, 0.0f));
v_normal = normalize(v_normal);
gl_Position = P * V * pos;
}
