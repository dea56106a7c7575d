#version 300 es
precision highp float;
in vec2 v_st;
uniform sampler2D u_panorama;
uniform int u_face;
out vec4 outColor;

vec3 toDirection(int face, float s, float t) {
    switch (face) {
        case 0: return vec3(1.0, -t, -s);
        case 1: return vec3(-1.0, -t, s);
        case 2: return vec3(s, 1.0, t);
        case 3: return vec3(s, -1.0, -t);
        case 4: return vec3(s, -t, 1.0);
        default: return vec3(-s, -t, -1.0);
    }
}

void main() {
    vec3 d = toDirection(u_face, v_st.x, v_st.y);
    // no need of a unit vector: two legs of a triangle
    float lon = atan(d.x, -d.z);
    float lat = atan(d.y, length(d.xz));
    outColor = texture(u_panorama, vec2(lon / 6.2831853 + 0.5, 0.5 - lat / 3.14159265));
}
