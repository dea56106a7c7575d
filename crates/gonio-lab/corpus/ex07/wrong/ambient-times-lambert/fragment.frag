#version 330 core
out vec4 FragColor;

in vec3 Normal;
in vec3 FragPos;

uniform vec3 lightPos;
uniform vec3 viewPos;
uniform vec3 lightColor;
uniform vec3 objectColor;
uniform float constant;
uniform float ambientStrength;
uniform float diffuseStrength;
uniform float specularStrength;
uniform float kc, kl, kq;

void main()
{

  


  vec3 norm = normalize(Normal);
  vec3 lightDir = normalize(lightPos - FragPos);
  float diff = max(dot(norm, lightDir), 0.0);
  vec3 ambient = ambientStrength * diff * lightColor;
  vec3 diffuse = diffuseStrength * diff * lightColor;


  vec3 viewDir = normalize(viewPos - FragPos);
  vec3 reflectDir = reflect(-lightDir, norm);
  float spec = pow(max(dot(viewDir, reflectDir), 0.0), 32);
  vec3 specular = specularStrength * spec * lightColor;


  float distance = length(lightPos - FragPos);
  float attenuation = 1.0 / (kc + kl * distance + kq * (distance * distance));

  vec3 result = (ambient + attenuation * (diffuse + specular)) * objectColor;
  FragColor = vec4(result, 1.0);
}
