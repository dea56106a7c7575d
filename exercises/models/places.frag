#version 330 core
// No colours of anybody's: how far away everything is. Places can be judged by it where colours say nothing.
out vec4 FragColor;

void main() {
    float distance = 1.0 / gl_FragCoord.w;
    FragColor = vec4(0.5 + 0.4 * sin(2.0 * distance), 0.5 + 0.4 * cos(3.0 * distance), gl_FragCoord.z, 1.0);
}
