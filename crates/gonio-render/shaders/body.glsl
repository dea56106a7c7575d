// Rays of sight through an object: the twin of gonio-light's `through_body`, with the tree of body.rs as the body.
// Body space is the world moved and scaled, not turned.
// From Rust: MOST_MEETINGS, WEIGHT_THAT_COUNTS, NEAREST_MEETING, BODY_ROW, LEAF_STEP.

uniform highp sampler2D body_table;
uniform int body_nodes;
uniform int body_corners;            // first texels
uniform int body_normals;
uniform vec3 body_center;            // in the world
uniform float body_scale;            // body units to a world unit
uniform vec3 absorption_in_body;     // per body unit

struct Meeting {
    vec3 position;   // in the body
    vec3 normal;     // unit, outwards
    float distance;  // in the body
};

vec4 body_texel(int index) {
    return texelFetch(body_table, ivec2(index % BODY_ROW, index / BODY_ROW), 0);
}

// Boxes are larger than their triangles by this, which exceeds all rounding errors of the intersection.
const float BOX_SLACK = 1e-6;

// The next intersection of a ray in body space with the body's surface from inside; false if the body is open there.
bool next_meeting(vec3 origin, vec3 direction, out Meeting found) {
    // The ray is the z axis of its own space. Both triangles at an edge then compute the edge function from the same
    // numbers, so that no ray passes between them.
    vec3 right = any_orthonormal_vector(direction);
    vec3 up = cross(right, direction);
    // If a component is 0 the whole ray is between two planes of a box, or outside of them.
    vec3 clear = mix(direction, vec3(1e-12), lessThan(abs(direction), vec3(1e-12)));
    vec3 inverse = 1.0 / clear;
    float nearest = 1e30;
    int triangle = -1;
    vec3 weights = vec3(0.0);
    int node = 0;
    while (node < body_nodes) {
        vec4 low = body_texel(2 * node);
        vec4 high = body_texel(2 * node + 1);
        vec3 a = (low.xyz - BOX_SLACK - origin) * inverse;
        vec3 b = (high.xyz + BOX_SLACK - origin) * inverse;
        vec3 entry = min(a, b);
        vec3 leave = max(a, b);
        float from = max(max(entry.x, entry.y), max(entry.z, 0.0));
        float to = min(min(leave.x, leave.y), min(leave.z, nearest));
        if (from > to) {
            node = int(low.w);
            continue;
        }
        int leaf = int(high.w);
        int first = leaf / LEAF_STEP;
        int end = first + leaf % LEAF_STEP;
        for (int i = first; i < end; ++i) {
            vec3 p = body_texel(body_corners + 3 * i).xyz - origin;
            vec3 q = body_texel(body_corners + 3 * i + 1).xyz - origin;
            vec3 r = body_texel(body_corners + 3 * i + 2).xyz - origin;
            vec2 p2 = vec2(dot(p, right), dot(p, up));
            vec2 q2 = vec2(dot(q, right), dot(q, up));
            vec2 r2 = vec2(dot(r, right), dot(r, up));
            // Clockwise, seen along the ray: from inside.
            vec3 edges = vec3(q2.x * r2.y - q2.y * r2.x, r2.x * p2.y - r2.y * p2.x, p2.x * q2.y - p2.y * q2.x);
            float sum = edges.x + edges.y + edges.z;
            if (max(edges.x, max(edges.y, edges.z)) <= 0.0 && sum < 0.0) {
                vec3 w = edges / sum;
                float depth = dot(w, vec3(dot(p, direction), dot(q, direction), dot(r, direction)));
                if (depth > NEAREST_MEETING && depth < nearest) {
                    nearest = depth;
                    triangle = i;
                    weights = w;
                }
            }
        }
        ++node;
    }
    found = Meeting(vec3(0.0), direction, nearest);
    if (triangle < 0) return false;
    vec3 p = body_texel(body_corners + 3 * triangle).xyz;
    vec3 q = body_texel(body_corners + 3 * triangle + 1).xyz;
    vec3 r = body_texel(body_corners + 3 * triangle + 2).xyz;
    found.position = weights.x * p + weights.y * q + weights.z * r;
    vec3 geometric = unit_or(cross(q - p, r - p), direction);
    vec3 shading = unit_or(weights.x * body_texel(body_normals + 3 * triangle).xyz
        + weights.y * body_texel(body_normals + 3 * triangle + 1).xyz
        + weights.z * body_texel(body_normals + 3 * triangle + 2).xyz, geometric);
    // Interpolated normals may face the ray although the triangle does not.
    found.normal = dot(shading, direction) > 0.0 ? shading : geometric;
    return true;
}

// The light along a ray of sight that has entered at a place in the world.
vec3 through_body(vec3 position, vec3 direction, float index, float level) {
    vec3 origin = (position - body_center) * body_scale;
    vec3 sum = vec3(0.0);
    vec3 weight = vec3(1.0);
    for (int i = 0; i < MOST_MEETINGS; ++i) {
        Meeting found;
        if (!next_meeting(origin, direction, found)) break;
        weight *= exp(-absorption_in_body * found.distance);
        Boundary at = boundary(found.normal, -direction, index, fresnel_kind);
        if (at.transmits) sum += ((1.0 - at.reflectance) * weight) * environment(at.transmitted, level);
        weight *= at.reflectance;
        if (max(weight.r, max(weight.g, weight.b)) < WEIGHT_THAT_COUNTS) return sum;
        origin = found.position;
        direction = at.reflected;
    }
    return sum + weight * environment(direction, level);
}
