#version 460 core
in vec3 v_n;
in vec3 v_pos;
in vec2 v_t;
uniform sampler2D ourTexture;
uniform vec3 u_light_pos;
uniform vec3 materialColour;
out vec4 FragColor;
void main()
{
    vec4 colour = vec4(materialColour, 1.0);
    vec3 l = normalize(u_light_pos - v_pos);
    vec3 n = normalize(v_n);
    FragColor = vec4(n * 0.5 + 0.5, 1.0);
}
