// The value of the material's own BRDF for l and v above the horizon of n, and the unit tangent t: at least 0.
vec3 material_brdf(vec3 l, vec3 v, vec3 n, vec3 t) {
    vec3 f = gonioBrdfBRDF(l, v, n, t, cross(n, t));
    // Values that are negative or not a number count as 0.
    return mix(vec3(0.0), min(f, vec3(LOBE_CAP)), vec3(greaterThan(f, vec3(0.0))));
}
