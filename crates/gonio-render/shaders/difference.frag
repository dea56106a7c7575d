// The difference of two pictures in the colours of a scale: twins of `heat` and `signed` in gonio-scene's difference.rs.

uniform sampler2D first;
uniform sampler2D second;
/// The difference in 8-bit steps that has the last colour of the scale.
uniform float full_scale;
/// 1: second minus first, by the channel that differs most. 0: the largest difference of a channel.
uniform int is_signed;
out vec4 frag_color;

vec3 heat(float share) {
    float place = clamp(share, 0.0, 1.0) * float(HEAT_COUNT - 1);
    int low = min(int(place), HEAT_COUNT - 2);
    return mix(HEAT[low], HEAT[low + 1], place - float(low));
}

vec3 signed_heat(float share) {
    return mix(SIGNED[1], share < 0.0 ? SIGNED[0] : SIGNED[2], clamp(abs(share), 0.0, 1.0));
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    // Whole steps, so that rounding of the division by 255 does not decide between equal channels: the first one is used.
    vec3 way = round(255.0 * (texelFetch(second, pixel, 0).rgb - texelFetch(first, pixel, 0).rgb));
    float most = abs(way.r) >= abs(way.g) ? way.r : way.g;
    most = abs(most) >= abs(way.b) ? most : way.b;
    vec3 color = is_signed == 1 ? signed_heat(most / full_scale) : heat(abs(most) / full_scale);
    frag_color = vec4(color / 255.0, 1.0);
}
