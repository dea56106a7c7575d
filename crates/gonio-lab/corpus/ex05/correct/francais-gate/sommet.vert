#version 330 core
in vec3 position;
in vec3 normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
uniform vec3 u_light_pos;
uniform vec3 u_view_pos;
uniform vec3 materialColour;
uniform float shininess;
out vec3 couleurSommet;
void main(){
    vec3 pos = vec3(M*vec4(position,1.0));
    vec3 n = normalize(vec3(itM*vec4(normal,0.0)));
    vec3 l = normalize(u_light_pos - pos);   // vers la lumière
    vec3 v = normalize(u_view_pos - pos);    // vers la caméra
    float nl = dot(n,l);
    float diffus = max(nl,0.0);
    float speculaire = 0.0;
    if(nl > 0.0){
        vec3 r = reflect(-l,n);
        speculaire = pow(max(dot(r,v),0.0),shininess);
    }
    couleurSommet = materialColour*(diffus + speculaire);
    gl_Position = P*V*vec4(pos,1.0);
}
