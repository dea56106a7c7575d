// A line with smooth edges.

in float v_side;

uniform vec4 line_color;   // not premultiplied
uniform float half_width;  // pixels

out vec4 frag_color;

void main() {
    float alpha = line_color.a * clamp(half_width + 0.5 - abs(v_side), 0.0, 1.0);
    frag_color = vec4(line_color.rgb * alpha, alpha);
}
