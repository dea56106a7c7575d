#version 330 core
// Outputs the distance instead of a colour, so that positions can be compared independently of colours.
out vec4 FragColor;

void main() {
    float distance = 1.0 / gl_FragCoord.w;
    FragColor = vec4(0.5 + 0.4 * sin(2.0 * distance), 0.5 + 0.4 * cos(3.0 * distance), gl_FragCoord.z, 1.0);
}
