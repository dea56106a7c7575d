#version 330 core
in vec3 position;
in vec3 normal;
uniform mat4 MVP;
uniform mat4 M;
uniform mat4 itM;
uniform vec3 u_view_pos;
out float v_light;
const vec3 lamp = vec3(1.0, 2.0, 1.5);
void main()
{
   vec3 w = (M * vec4(position, 1.0)).xyz;
   vec3 n = normalize((itM * vec4(normal, 0.0)).xyz);
   vec3 l = normalize(lamp - w);
   vec3 v = normalize(u_view_pos - w);
   float amb = 0.1;
   float dif = 0.5 * max(dot(n, l), 0.0);
   float spe = 0.8 * pow(max(dot(reflect(-l, n), v), 0.0), 32);
   v_light = amb + dif + spe;
   gl_Position = MVP * vec4(position, 1.0);
}
