#version 150
in vec3 position;
in vec3 normal;
uniform mat4 M; uniform mat4 V; uniform mat4 P;
out vec3 wn;
out vec3 wp;
void main()
{
    mat3 nm = transpose(mat3(inverse(mat4(M))));
    wn = normalize(nm * normal);
    wp = (M * vec4(position, 1)).xyz;
    gl_Position = P * (V * vec4(wp, 1));
}
