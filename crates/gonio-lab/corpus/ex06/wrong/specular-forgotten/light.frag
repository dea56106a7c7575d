#version 400 core
out vec4 frag_color;
precision mediump float;
in vec3 fragCoord;
in vec3 n;
uniform vec3 u_light_pos;
uniform vec3 camPos;
uniform vec3 materialColour;
// ------------
void main()
{
    vec3 N = normalize(n);
    vec3 L = normalize(u_light_pos - fragCoord);
    vec3 V = normalize(camPos - fragCoord);
    vec3 R = reflect(-L, N);
    float diffuse = max(dot(N, L), 0.0);
    float cosTheta = dot(R, V);
    float specular = pow(max(cosTheta, 0.0), 32.0);
    frag_color = vec4(materialColour * diffuse, 1.0);
}
