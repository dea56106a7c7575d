#version 400 core
in vec2 TexCoords;
out vec4 FragColor;

uniform sampler2D equirectangularMap;
uniform int faceIndex;

const vec3 middle[6] = vec3[6](vec3(1,0,0), vec3(-1,0,0), vec3(0,1,0), vec3(0,-1,0), vec3(0,0,1), vec3(0,0,-1));
const vec3 alongS[6] = vec3[6](vec3(0,0,-1), vec3(0,0,1), vec3(1,0,0), vec3(1,0,0), vec3(1,0,0), vec3(-1,0,0));
const vec3 alongT[6] = vec3[6](vec3(0,-1,0), vec3(0,-1,0), vec3(0,0,1), vec3(0,0,-1), vec3(0,-1,0), vec3(0,-1,0));
const float PI = 3.14159265359;

void main() {
    vec2 st = TexCoords;
    vec3 d = normalize(middle[faceIndex] + st.x * alongS[faceIndex] + st.y * alongT[faceIndex]);
    float longitude = atan(d.x, -d.z);
    float polar = acos(clamp(d.y, -1.0, 1.0));
    vec2 uv = vec2(0.5 + longitude / (2.0 * PI), polar / PI);
    FragColor = vec4(textureLod(equirectangularMap, uv, 0.0).rgb, 1.0);
}
