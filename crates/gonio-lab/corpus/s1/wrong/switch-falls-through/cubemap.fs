#version 330
in vec2 st;
uniform sampler2D panorama;
uniform int face;
out vec4 FragColor;

void main() {
    vec3 dir = vec3(0.0);
    float side = 1.0;
    switch (face) {
        case 1: side = -1.0; // and on
        case 0: dir = vec3(side, -st.y, -side * st.x); break;
        case 3: side = -1.0;
        case 2: dir = vec3(st.x, side, side * st.y); break;
        case 5: side = -1.0;
        case 4: dir = vec3(st.x, -st.y, side); break;
    }
    dir = normalize(dir);
    float u = atan(dir.x, -dir.z) / 6.28318530718;
    float v = acos(dir.y) / 3.14159265359;
    FragColor = vec4(texture(panorama, vec2(u + 0.5, v)).rgb, 1.0);
}
