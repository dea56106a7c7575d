#version 330 core
// The point of the panorama for each point of a face.
in vec2 v_face_coord;

uniform sampler2D panorama;
uniform int face;

out vec4 FragColor;

const float PI = 3.14159265358979;

void main() {
    float s = v_face_coord.x;
    float t = v_face_coord.y;
    vec3 posx = vec3(1.0, -t, -s);
    vec3 negx = vec3(-1.0, -t, s);
    vec3 posy = vec3(s, 1.0, t);
    vec3 negy = vec3(s, -1.0, -t);
    vec3 posz = vec3(s, -t, 1.0);
    vec3 negz = vec3(-s, -t, -1.0);
    vec3 along_x = face == 0 ? posx : negx;
    vec3 along_y = face == 2 ? posy : negy;
    vec3 along_z = face == 4 ? posz : negz;
    vec3 on_face = face < 2 ? along_x : face < 4 ? along_y : along_z;
    vec3 direction = normalize(on_face);
    float height = clamp(direction.y, -1.0, 1.0);
    float longitude = atan(direction.x, -direction.z);
    float latitude = asin(height);
    float u = 0.5 + longitude / (2.0 * PI);
    float v = 0.5 - latitude / PI;
    vec3 found = texture(panorama, vec2(u, v)).rgb;
    vec3 colour = found;
    FragColor = vec4(colour, 1.0);
}
