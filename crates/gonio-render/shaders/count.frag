// One for each fragment, to be added up.

out vec4 frag_color;

void main() {
    frag_color = vec4(1.0);
}
