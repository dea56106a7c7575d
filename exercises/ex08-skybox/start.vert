#version 330 core
// Exercise 08: the skybox. So far it draws a small cube of one colour, which you can walk away from.

in vec3 position; // a corner of the cube, each coordinate -1 or 1

uniform mat4 V; // view from world
uniform mat4 P; // clip from view

void main() {
    // TODO: send the fragment shader the direction to sample.
    // TODO: the sky turns with the camera, but never comes closer. Which part of V does that concern?
    // TODO: the sky is behind everything. Which depth is that, and what must z be to come out as it after the
    //       division by w?
    gl_Position = P * V * vec4(position, 1.0);
}
