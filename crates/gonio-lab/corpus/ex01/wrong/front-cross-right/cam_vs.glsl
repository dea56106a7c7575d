#version 300 es
precision highp float;
in vec3 a_position;
in vec3 a_color;
uniform mat4 u_modelMatrix;
uniform mat4 u_projectionMatrix;
uniform vec3 u_camPos;
uniform vec3 u_camFront;
uniform vec3 u_camUp;
out vec3 v_color;

void main() {
    vec3 f = normalize(u_camFront);
    vec3 r = normalize(cross(f, u_camUp));
    vec3 u = cross(f, r);
    mat3 R = transpose(mat3(r, u, -f));
    mat4 view = mat4(R);
    view[3] = vec4(R * -u_camPos, 1.0);
    gl_Position = u_projectionMatrix * view * u_modelMatrix * vec4(a_position, 1.0);
    v_color = a_color;
}
