#version 410 core
layout(location = 0) in vec3 position;
layout(location = 2) in vec3 normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform vec3 u_light_pos;
uniform vec3 materialColour;
uniform float shininess;
out vec3 shade;
void main()
{
    mat4 MV = V * M;
    vec3 e = (MV * vec4(position, 1.0)).xyz;
    vec3 n = normalize(transpose(inverse(mat3(MV))) * normal);
    vec3 l = normalize((V * vec4(u_light_pos, 1.0)).xyz - e);
    vec3 v = normalize(-e);
    float nl = max(dot(n, l), 0.0);
    float rv = max(dot(reflect(-l, n), v), 0.0);
    shade = materialColour * (nl + pow(rv, shininess));
    gl_Position = P * vec4(e, 1.0);
}
