#version 330 core
flat in int side;
centroid in vec3 c;
out vec4 first;
out vec4 second;
in vec4 gl_FragCoord;
void main() {
  switch (side) { case 1: first = vec4(1, 0, 0, 1); break; default: first = vec4(0, 0, 1, 1); }
  second = vec4(c * side, 1);
  second.xy += side;
  second.x = mod(side, 2) + step(0, c.x) + mix(0, 1, c.y) + smoothstep(0, 1, c.z) + min(1, c.x);
}
