// The environment as seen in mirrors and through glass at a fragment.

// The light seen at the point: the twin of gonio-light's `sight`.
Sight sight(vec3 position, vec3 n, vec3 v) {
    Boundary at = boundary(n, v, indices.g, fresnel_kind);
    Sight seen;
    seen.reflection = at.reflected;
    seen.reflected = environment(at.reflected, level_of(at.reflected));
    seen.transmitted = vec3(0.0);
    seen.fresnel = vec3(at.reflectance);
#if GLASS
    // One level for all channels. With total reflection its direction replaces the missing one, so that derivatives are
    // defined, with weight 0.
    float level = level_of(at.transmits ? at.transmitted : at.reflected);
    for (int i = 0; i < index_count; ++i) {
        if (index_count > 1) at = boundary(n, v, indices[i], fresnel_kind);
        vec3 t = at.transmits ? at.transmitted : at.reflected;
#if BODY
        // Seen from inside, the ray goes out here.
        vec3 through = dot(n, v) >= 0.0 ? through_body(position, t, indices[i], level) : environment(t, level);
#else
        vec3 through = environment(t, level);
#endif
        through *= (1.0 - at.reflectance) * tint;
        if (index_count > 1) {
            seen.transmitted[i] = through[i];
            seen.fresnel[i] = at.reflectance;
        } else {
            seen.transmitted = through;
        }
    }
#endif
    return seen;
}
