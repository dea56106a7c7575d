#version 330 core
struct Light { vec3 light_pos; float ambient_strength; float diffuse_strength; };
in vec3 WvertPos;
in vec3 WvertNormal;
uniform Light light;
uniform vec3 materialColour;
out vec4 FragColor;
float diffuse(Light l, vec3 n) { return l.diffuse_strength * max(dot(n, normalize(l.light_pos - WvertPos)), 0.); }
void main() { FragColor = vec4(diffuse(light, normalize(WvertNormal)) * materialColour, 1.); }
