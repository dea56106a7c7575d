// A one for each fragment; blending adds them up.

out vec4 frag_color;

void main() {
    frag_color = vec4(1.0);
}
