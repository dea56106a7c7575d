#version 330 core
struct Point { vec3 p; vec3 n; };
in vec3 position;
in vec3 normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
out vec3 wp;
out vec3 wn;
Point world(Point m) { return Point((M * vec4(m.p, 1.0)).xyz, normalize((itM * vec4(m.n, 0.0)).xyz)); }

void main() {
    Point w = world(Point(position, normal));
    wp = w.p;
    wn = w.n;
    gl_Position = P * V * vec4(w.p, 1.0);
}
