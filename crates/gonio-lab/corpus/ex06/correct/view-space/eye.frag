#version 410 core
in vec3 eye_pos;
in vec3 eye_normal;
uniform mat4 V;
uniform vec3 u_light_pos;
uniform vec3 materialColour;
uniform float shininess;
out vec4 FragColor;
void main()
{
    vec3 N = normalize(eye_normal);
    vec3 light_eye = (V * vec4(u_light_pos, 1.0)).xyz;
    vec3 L = normalize(light_eye - eye_pos);
    vec3 E = normalize(-eye_pos);
    vec3 R = reflect(-L, N);
    float kd = max(dot(N, L), 0.0);
    float ks = pow(max(dot(R, E), 0.0), shininess);
    FragColor = vec4(materialColour * kd + materialColour * ks, 1.0);
}
