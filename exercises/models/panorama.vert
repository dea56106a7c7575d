#version 330 core
in vec3 position;

out vec2 v_face_coord;

void main() {
    v_face_coord = position.xy;
    gl_Position = vec4(position.xy, 0.0, 1.0);
}
