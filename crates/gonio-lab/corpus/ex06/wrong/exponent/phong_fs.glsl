#version 440 core
in vec3 v_pos;
in vec3 v_normal;
in vec2 v_tex;
out vec4 FragColor;
uniform vec3 u_view_pos;
// ------------
void main()
{
   vec3 lightPos = vec3(1.0, 2.0, 1.5);
   vec3 colour = vec3(0.5, 0.6, 0.8);
   vec3 N = normalize(v_normal);
   vec3 L = normalize(lightPos - v_pos);
   vec3 V = normalize(u_view_pos - v_pos);
   vec3 R = reflect(-L, N);
   float amb = 0.1;
   float dif = 0.6 * max(dot(N,L),0.0);
   float spe = 0.8 * pow(max(dot(R,V),0.0), 3);
   FragColor = vec4(colour * (amb + dif + spe), 1.0);
}
