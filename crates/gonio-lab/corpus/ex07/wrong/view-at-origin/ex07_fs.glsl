#version 410 core
in vec3 p;
in vec3 n;
out vec4 frag_color;
uniform vec3 camPos;
struct Light {
  float ambient_strength;
  float diffuse_strength;
  float specular_strength;
  float constant;
  float linear;
  float quadratic;
};
uniform Light light;


const vec3 LAMP = vec3(1.0, 2.0, 1.5);

// TODO clean
void main() {
  vec3 colour = vec3(0.5, 0.6, 0.8);
  vec3 nn = normalize(n);
  vec3 ll = normalize(LAMP - p);
  vec3 vv = normalize(-p);
  vec3 rr = reflect(-ll, nn);
  float dist = length(LAMP - p);
  float k = 1.0 / (light.constant + light.linear*dist + light.quadratic*dist*dist);
  float dd = max(dot(nn, ll), 0.0) * light.diffuse_strength;
  float ss = pow(max(dot(rr, vv), 0.0), 32.0) * light.specular_strength;
  frag_color = vec4(colour * (light.ambient_strength + k * (dd + ss)), 1.0);
}
