#version 330 core
in vec3 position;
in vec3 color;
uniform mat4 M, P;
uniform vec3 camPos;
uniform float yaw;
uniform float pitch;
const vec3 worldUp = vec3(0.0, 1.0, 0.0);
out vec3 v_col;
void main() {
    vec3 front = vec3(cos(radians(yaw)) * cos(radians(pitch)), sin(radians(pitch)), sin(radians(yaw)) * cos(radians(pitch)));
    front = normalize(front);
    vec3 right = normalize(cross(front, worldUp));
    vec3 up = normalize(cross(right, front));
    mat4 V = mat4(
        vec4(right, -dot(right, camPos)),
        vec4(up, -dot(up, camPos)),
        vec4(-front, dot(front, camPos)),
        vec4(0.0, 0.0, 0.0, 1.0));
    gl_Position = P * V * M * vec4(position, 1.0);
    v_col = color;
}
