// A MERL table: the twin of gonio-bsdf's merl.rs and half_angles.rs, in f32.
// From Rust: MERL_WIDTH (texels of a row), MERL_THETA_H, MERL_THETA_D, MERL_PHI_D (cells).

uniform highp sampler2D merl_table;   // f, and 1 where a cell is not missing

void add_merl_cell(inout vec4 sum, int h, int d, int p, float weight) {
    int cell = (h * MERL_THETA_D + d) * MERL_PHI_D + p;
    sum += weight * texelFetch(merl_table, ivec2(cell % MERL_WIDTH, cell / MERL_WIDTH), 0);
}

// The first of two cells around a position, and the share of the second.
void around_merl(float position, int cells, out int first, out float share) {
    float at = clamp(position - 0.5, 0.0, float(cells) - 1.0);
    first = min(int(floor(at)), cells - 2);
    share = at - float(first);
}

vec3 gonioBrdfBRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y) {
    vec3 H = half_vector(L, V, N);
    vec3 local_h = vec3(dot(X, H), dot(Y, H), dot(N, H));
    vec3 wi = vec3(dot(X, L), dot(Y, L), dot(N, L));
    float across = length(local_h.xy);
    float theta_h = atan(across, local_h.z);
    vec2 phi_h = across > 1e-6 ? local_h.xy / across : vec2(1.0, 0.0);
    // L turned by -phi_h about the normal, then by -theta_h about the bitangent.
    vec3 turned = vec3(wi.x * phi_h.x + wi.y * phi_h.y, wi.y * phi_h.x - wi.x * phi_h.y, wi.z);
    vec3 diff = vec3(turned.x * local_h.z - turned.z * across, turned.y, turned.x * across + turned.z * local_h.z);
    float theta_d = atan(length(diff.xy), diff.z);
    // atan(0, 0) is undefined.
    float phi_d = diff.x == 0.0 && diff.y == 0.0 ? 0.0 : atan(diff.y, diff.x);
    if (phi_d < 0.0) phi_d += PI;
    int h, d;
    float share_h, share_d;
    around_merl(sqrt(max(theta_h * 2.0 / PI, 0.0)) * float(MERL_THETA_H), MERL_THETA_H, h, share_h);
    around_merl(theta_d * 2.0 / PI * float(MERL_THETA_D), MERL_THETA_D, d, share_d);
    float position = phi_d / PI * float(MERL_PHI_D) - 0.5;
    float share_p = position - floor(position);
    // The azimuth goes round.
    int p = (int(floor(position)) + MERL_PHI_D) % MERL_PHI_D;
    int q = (p + 1) % MERL_PHI_D;
    vec4 sum = vec4(0.0);
    add_merl_cell(sum, h, d, p, (1.0 - share_h) * (1.0 - share_d) * (1.0 - share_p));
    add_merl_cell(sum, h, d, q, (1.0 - share_h) * (1.0 - share_d) * share_p);
    add_merl_cell(sum, h, d + 1, p, (1.0 - share_h) * share_d * (1.0 - share_p));
    add_merl_cell(sum, h, d + 1, q, (1.0 - share_h) * share_d * share_p);
    add_merl_cell(sum, h + 1, d, p, share_h * (1.0 - share_d) * (1.0 - share_p));
    add_merl_cell(sum, h + 1, d, q, share_h * (1.0 - share_d) * share_p);
    add_merl_cell(sum, h + 1, d + 1, p, share_h * share_d * (1.0 - share_p));
    add_merl_cell(sum, h + 1, d + 1, q, share_h * share_d * share_p);
    // Missing cells are left out.
    return sum.a > 0.0 ? sum.rgb / sum.a : vec3(0.0);
}
