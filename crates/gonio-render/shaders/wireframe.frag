// A triangle's edges, smooth: the distance to an edge in pixels is the barycentric coordinate over its change from one
// pixel to the next (Bærentzen et al. 2006, "Single-pass wireframe rendering").

in vec3 v_corner;

uniform vec4 line_color;   // not premultiplied

out vec4 frag_color;

// Each of the triangles that share the edge has half of the line.
const float HALF_WIDTH = 0.65;

void main() {
    vec3 change = max(fwidth(v_corner), vec3(1e-7));
    vec3 pixels = v_corner / change;
    float nearest = min(min(pixels.x, pixels.y), pixels.z);
    float line = 1.0 - smoothstep(HALF_WIDTH - 0.5, HALF_WIDTH + 0.5, nearest);
    // Lines would cover triangles of a few pixels completely, so they fade as triangles get smaller.
    float height = 1.0 / max(max(change.x, change.y), change.z);
    float alpha = line_color.a * line * mix(0.25, 1.0, smoothstep(1.0, 7.0, height));
    frag_color = vec4(line_color.rgb * alpha, alpha);
}
