#version 330 core
// Exercise 08: the sky around everything.

in vec3 position; // a corner of the cube, each coordinate -1 or 1

uniform mat4 V; // view from world
uniform mat4 P; // clip from view

out vec3 v_direction; // in the world, of any length

void main() {
    v_direction = position;
    // The rotation of V without its translation: the sky turns, and never comes closer.
    vec4 place = P * mat4(mat3(V)) * vec4(position, 1.0);
    // z = w is a depth of 1 after the division: behind everything.
    gl_Position = place.xyww;
}
