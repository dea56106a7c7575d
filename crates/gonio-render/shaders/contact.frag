// How much of the sky the objects hide from each place of the ground: the aid's contact shadow. The objects are seen from
// below; a patch of area A at height d, at the distance r along the ground, hides A d^2 / (pi (r^2 + d^2)^2).

uniform highp sampler2D heights;   // of the lowest surface, 0 to 1 of `rise`; 1: none
uniform float rise;                // world units
uniform float side;                // of the map, world units
uniform float reach;               // of the samples along the ground, world units

out vec4 frag_color;

const int SAMPLES = 160;
const float GOLDEN_ANGLE = 2.39996323;

void main() {
    vec2 size = vec2(textureSize(heights, 0));
    vec2 here = gl_FragCoord.xy / size;
    // Lower surfaces would be seen by single samples only.
    float least = 1.5 * side / size.x;
    float hidden = 0.0;
    for (int i = 0; i < SAMPLES; ++i) {
        float u = (float(i) + 0.5) / float(SAMPLES);
        // Denser near the middle: r = reach u^1.5.
        float r = reach * u * sqrt(u);
        float area = 3.0 * PI * reach * reach * u * u / float(SAMPLES);
        float angle = GOLDEN_ANGLE * float(i);
        vec2 there = here + r / side * vec2(cos(angle), sin(angle));
        float height = textureLod(heights, there, 0.0).r;
        if (height >= 1.0) continue;
        float d = max(height * rise, least);
        float distance_squared = r * r + d * d;
        hidden += area * d * d / (PI * distance_squared * distance_squared);
    }
    frag_color = vec4(vec3(min(hidden, 1.0)), 1.0);
}
