// A line in the world as a strip of two triangles on the screen, one instance per line; vertices 0 and 1 are its start, 2
// and 3 its end.

in vec3 position;   // its start, in the model
in vec3 normal;     // its vector, in the model

uniform mat4 clip_from_world;
uniform mat4 world_from_model;
uniform mat3 way_world_from_model;
uniform float line_length;   // world units; 0: the length of the vector
uniform vec2 half_picture;   // pixels
uniform float half_width;    // pixels

out float v_side;            // pixels from the line's middle

void main() {
    vec3 start = (world_from_model * vec4(position, 1.0)).xyz;
    vec3 way = way_world_from_model * normal;
    if (line_length > 0.0) way *= line_length * inversesqrt(max(dot(way, way), 1e-30));
    vec4 a = clip_from_world * vec4(start, 1.0);
    vec4 b = clip_from_world * vec4(start + way, 1.0);
    // Points behind the eye have no place on the screen: the line is clipped in front of it.
    float least = 1e-3 * max(abs(a.w), abs(b.w));
    if (max(a.w, b.w) <= least) {
        gl_Position = vec4(2.0, 2.0, 2.0, 1.0);   // outside
        v_side = 0.0;
        return;
    }
    if (a.w < least) a = mix(a, b, (least - a.w) / (b.w - a.w));
    if (b.w < least) b = mix(b, a, (least - b.w) / (a.w - b.w));
    vec2 along = (b.xy / b.w - a.xy / a.w) * half_picture;
    float pixels = length(along);
    along = pixels > 1e-4 ? along / pixels : vec2(1.0, 0.0);
    vec4 here = gl_VertexID < 2 ? a : b;
    float side = (gl_VertexID % 2 == 0 ? -1.0 : 1.0) * (half_width + 0.5);
    v_side = side;
    here.xy += vec2(-along.y, along.x) * side / half_picture * here.w;
    gl_Position = here;
}
