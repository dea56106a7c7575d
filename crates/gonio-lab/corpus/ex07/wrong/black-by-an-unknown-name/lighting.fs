#version 330 core
out vec4 FragColor;

in vec3 FragPos;  
in vec3 Normal;  
  
uniform vec3 viewPos;
uniform vec3 lightPos;
uniform vec3 lightColor;
uniform vec3 zebra;
uniform float ambientStrength;
uniform float diffuseStrength;
uniform float specularStrength;
uniform float constant;
uniform float linear;
uniform float quadratic;
uniform float shininess;

void main()
{
    // ambient
    vec3 ambient = ambientStrength * lightColor;
  	
    // diffuse 
    vec3 norm = normalize(Normal);
    vec3 lightDir = normalize(lightPos - FragPos);
    float diff = max(dot(norm, lightDir), 0.0);
    vec3 diffuse = diffuseStrength * diff * lightColor;
    
    // specular
    vec3 viewDir = normalize(viewPos - FragPos);
    vec3 reflectDir = reflect(-lightDir, norm);  
    float spec = pow(max(dot(viewDir, reflectDir), 0.0), shininess);
    vec3 specular = specularStrength * spec * lightColor;  

    // attenuation
    float distance    = length(lightPos - FragPos);
    float attenuation = 1.0 / (constant + linear * distance + quadratic * (distance * distance));    

    vec3 result = (ambient + (diffuse + specular) * attenuation) * zebra;
    FragColor = vec4(result, 1.0);
} 
