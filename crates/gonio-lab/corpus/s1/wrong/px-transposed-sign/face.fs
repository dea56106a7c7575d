#version 330 core
in vec2 st;
out vec4 FragColor;
uniform sampler2D panorama;
uniform int face;
#define PI 3.1415926535

void main()
{
    vec3 dir;
    if (face == 0) {
        dir = vec3(1.0, -st.y, st.x);
    } else if (face == 1) {
        dir = vec3(-1.0, -st.y, st.x);
    } else if (face == 2) {
        dir = vec3(st.x, 1.0, st.y);
    } else if (face == 3) {
        dir = vec3(st.x, -1.0, -st.y);
    } else if (face == 4) {
        dir = vec3(st.x, -st.y, 1.0);
    } else {
        dir = vec3(-st.x, -st.y, -1.0);
    }
    dir = normalize(dir);
    float u = 0.5 + atan(dir.x, -dir.z) / (2.0 * PI);
    float v = acos(dir.y) / PI;
    FragColor = texture(panorama, vec2(u, v));
}
