#version 330 core
in vec3 position;
in vec2 tex_coords;
in vec3 normal;
out float v_diffuse;
out float v_specular;
uniform mat4 M;
uniform mat4 itM;
uniform mat4 V;
uniform mat4 P;
uniform vec3 u_light_pos;
uniform vec3 u_view_pos;

float specularCalculation(vec3 N, vec3 L, vec3 V){
    vec3 R = reflect(-L, N);
    float cosTheta = dot(R, V);
    return pow(max(cosTheta, 0.0), 32.0);
}

void main(){
    vec4 frag_coord = M*vec4(position, 1.0);
    gl_Position = P*V*frag_coord;
    vec3 norm = normalize(vec3(itM * vec4(normal, 1.0)));
    vec3 L = normalize(u_light_pos - frag_coord.xyz);
    vec3 E = normalize(u_view_pos - frag_coord.xyz);
    v_diffuse = max(0.0, dot(N, L));
    v_specular = specularCalculation(norm, L, E);
}
