#version 330
in vec3 posMonde;
in vec3 normaleMonde;
out vec4 couleurFinale;
uniform vec3 u_light_pos;
uniform vec3 u_view_pos;
uniform vec3 materialColour;
uniform float shininess;

void main()
{
    vec3 normale = normaleMonde;
    vec3 versLumiere = normalize(u_light_pos - posMonde);
    vec3 versOeil = normalize(u_view_pos - posMonde);
    float cosinus = dot(normale, versLumiere);

    float diffus = 0.5 * max(cosinus, 0.0);
    float speculaire = 0.0;
    if (cosinus > 0.0)
{
        vec3 reflet = reflect(-versLumiere, normale);
        speculaire = 0.8 * pow(max(dot(reflet, versOeil), 0.0), shininess);
    }
    couleurFinale = vec4((diffus + speculaire) * materialColour, 1.0);
}
