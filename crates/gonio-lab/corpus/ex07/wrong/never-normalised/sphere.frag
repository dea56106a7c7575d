#version 110
varying vec3 v_Normal;
varying vec3 v_Position;

struct Light {
  vec3 light_pos;
  float ambient_strength;
  float diffuse_strength;
  float specular_strength;
  float constant;
  float linear;
  float quadratic;
};
uniform Light light;
uniform vec3 u_view_pos;
uniform vec3 materialColour;
uniform float shininess;

void main() {
  vec3 N = v_Normal;
  vec3 toLight = light.light_pos - v_Position;
  float d = length(toLight);
  vec3 L = toLight / d;
  vec3 V = normalize(u_view_pos - v_Position);
  vec3 R = reflect(-L, N);

  float lambert = max(0.0, dot(N, L));
  float spec = pow(max(0.0, dot(R, V)), shininess);
  float att = 1.0 / (light.constant + d * (light.linear + d * light.quadratic));

  gl_FragColor = vec4(materialColour, 1.0) * vec4(vec3(light.ambient_strength + att * (light.diffuse_strength * lambert + light.specular_strength * spec)), 1.0);
}
