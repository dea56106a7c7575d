#version 460 core
in vec3 position;
in vec2 tex_coords;
in vec3 normal;

out vec3 v_frag_coord;
out vec3 v_normal;
out vec4 v_col;
out vec2 v_t;

uniform mat4 M;
uniform mat4 itM;
uniform mat4 V;
uniform mat4 P;
uniform float now;

// ------------
void main(){
    vec4 frag_coord = M * vec4(position, 1.0);
    gl_Position = P * V * frag_coord;
    // v_normal = normalize(vec3(M * vec4(normal, 1.0)));
    v_normal = normalize(vec3(itM * vec4(normal, 1.0)));
    v_frag_coord = frag_coord.xyz;
    v_col = vec4(normal * 0.5 + 0.5, 1.0);
    v_t = tex_coords;
}
