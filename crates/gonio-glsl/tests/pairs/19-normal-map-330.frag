#version 330 core
in vec2 TexCoords;
in mat3 TBN;
in vec3 FragPos;
uniform sampler2D diffuseMap, normalMap;
uniform vec3 lightPos, viewPos;
out vec4 FragColor;
void main() {
    vec3 normal = texture(normalMap, TexCoords).rgb;
    normal = normalize(normal * 2 - 1);
    normal = normalize(TBN * normal);
    vec3 lightDir = normalize(lightPos - FragPos);
    vec3 viewDir = normalize(viewPos - FragPos);
    vec3 halfway = normalize(lightDir + viewDir);
    float spec = pow(max(dot(normal, halfway), 0.0), 64);
    FragColor.rgb = texture(diffuseMap, TexCoords).rgb * (.1 + max(dot(lightDir, normal), 0)) + spec * .2;
    FragColor.a = 1;
}
