#version 330
in vec3 position;
in vec3 normal;
uniform mat4 model;
uniform mat4 view;
uniform mat4 projection;
out vec3 world;
out vec3 nrm;
void main(void) {
    world = vec3(model * vec4(position, 1.0));
    // normal matrix here, the host does not send it
    mat3 nm = mat3(transpose(inverse(model)));
    nrm = normalize(nm * normal);
    gl_Position = projection * view * vec4(world, 1.0);
}
