#version 330 core
// Exercice 6 : Phong spéculaire
in vec3 position;
in vec3 normal;
uniform mat4 M, V, P, itM;
out vec3 posMonde;
out vec3 normaleMonde;

void main()
{
    // on passe tout dans le repère du monde
    posMonde = vec3(M * vec4(position, 1.0));
    normaleMonde = normalize(vec3(itM * vec4(normal, 0.0)));
    gl_Position = P * V * vec4(posMonde, 1.0);
}
