#version 330 core
in vec3 FragPos; in vec3 Normal; in vec2 uv;
struct Material { vec3 ambient, diffuse; sampler2D map; float shininess; };
struct Light { vec3 position; vec3 colour[2]; };
uniform Material material;
uniform Light light;
uniform vec3 viewPos;
out vec4 FragColor;
float lit(float x) { return x; }
vec3 lit(vec3 x) { return x * 2; }
vec3 sum(vec3 a[2]) { return a[0] + a[1]; }
void main() {
  vec3 L = normalize(light.position - FragPos);
  float d = max(dot(L, normalize(Normal)), 0.0);
  vec3 c = material.ambient + lit(d) * material.diffuse * lit(sum(light.colour)) * texture(material.map, uv).rgb;
  float s = d > 0 ? pow(max(dot(reflect(-L, normalize(Normal)), normalize(viewPos - FragPos)), 0), material.shininess) : 0;
  vec3 t[2] = vec3[](c, vec3(s)); vec3 w[2] = vec3[2](vec3(1), vec3(0)); w = t;
  FragColor = vec4(sum(w), 1);
}
