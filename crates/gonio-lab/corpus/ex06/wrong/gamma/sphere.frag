#version 330 core
struct Angles { float nl; float rv; };
in vec3 wp;
in vec3 wn;
uniform vec3 lightPos;
uniform vec3 viewPos;
uniform vec3 materialColour;
out vec4 FragColor;
Angles angles() {
    vec3 n = normalize(wn), l = normalize(lightPos - wp), v = normalize(viewPos - wp);
    return Angles(dot(n, l), dot(reflect(-l, n), v));
}

void main() {
    Angles a = angles();
    vec3 diff = max(a.nl, 0.0) * materialColour;
    vec3 spec = pow(max(a.rv, 0.0), 32.0) * materialColour;
    FragColor = vec4(pow(diff + spec, vec3(0.4545)), 1.0);
}
