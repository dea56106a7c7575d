#version 330 core
in vec3 sommet;
in vec3 couleur;
uniform mat4 M;
uniform mat4 P;
uniform vec3 positionCamera;
uniform vec3 devant;   // direction du regard
uniform vec3 haut;     // a peu pres
out vec3 couleurSommet;

void main() {
    vec3 d = normalize(devant);
    // Gram-Schmidt
    vec3 h = normalize(haut - dot(haut, d) * d);
    vec3 droite = cross(d, h);
    vec3 p = (M * vec4(sommet, 1.0)).xyz - positionCamera;
    vec4 vue = vec4(dot(droite, p), dot(h, p), -dot(d, p), 1.0);
    couleurSommet = couleur;
    gl_Position = P * vue;
}
