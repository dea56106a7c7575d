#version 330 core
in vec3 MvertPos;
in vec3 MvertNorm;
uniform mat4 M; // model -> world
uniform mat4 V; // world -> view
uniform mat4 P; // view -> clip
out vec3 Wpos;
out vec3 Wnorm;
// ------------
void main() {
    Wpos = (M * vec4(MvertPos, 1.0)).xyz;
    // (M^-1)^T n written as n * M^-1
    Wnorm = normalize(MvertNorm * inverse(mat3(M)));
    gl_Position = P * V * vec4(Wpos, 1.0);
}
