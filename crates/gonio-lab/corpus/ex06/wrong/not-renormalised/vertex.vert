#version 330
// Exercice 6 : Phong spéculaire
in vec3 a_Position;
in vec3 a_Normal;
uniform mat4 M, V, P, itM;
out vec3 posMonde;
out vec3 normaleMonde;

void main()
{
    // on passe tout dans le repère du monde
    posMonde = vec3(M * vec4(a_Position, 1.0));
    normaleMonde = normalize(vec3(itM * vec4(a_Normal, 0.0)));
    gl_Position = P * V * vec4(posMonde, 1.0);
}
