// Debug views: the raw values of the quantities of gonio-light's quantity.rs.

uniform int view_quantity;
uniform int view_light;   // row of the light table; -1: none
uniform bool view_of_one_light;
uniform float refraction_index;

// Quantities that are known where the equation is evaluated; 0 for those that are known only at a fragment.
vec3 quantity_of_point(vec3 position, vec3 n, vec3 v, float shininess) {
    if (view_quantity == QUANTITY_NORMAL) return n;
    if (view_quantity == QUANTITY_VIEW) return v;
    if (view_quantity == QUANTITY_VIEW_REFLECTION) return reflection(n, v);
    if (view_quantity == QUANTITY_REFRACTION) {
        bool outside = dot(n, v) >= 0.0;
        vec3 towards = outside ? n : -n;
        vec3 t;
        if (refraction(towards, v, outside ? 1.0 / refraction_index : refraction_index, t)) return t;
        return reflection(towards, v);
    }
    if (view_light < 0) return vec3(0.0);
    LightTerms t = light_terms(kind_of_light(view_light), view_light, position, n, v, shininess);
    if (view_quantity == QUANTITY_LIGHT) return t.l;
    if (view_quantity == QUANTITY_REFLECTION) return t.r;
    if (view_quantity == QUANTITY_HALF) return t.h;
    if (view_quantity == QUANTITY_DISTANCE) return vec3(t.distance);
    if (view_quantity == QUANTITY_ATTENUATION) return vec3(t.attenuation);
    if (view_quantity == QUANTITY_SPOT) return vec3(t.spot);
    if (view_quantity == QUANTITY_VISIBILITY) return vec3(t.visibility);
    if (view_quantity == QUANTITY_COS_THETA) return vec3(max(t.cos_theta, 0.0));
    if (view_quantity == QUANTITY_SPEC) return vec3(t.spec);
    return vec3(0.0);
}

// The sums that a view of terms needs: of all lights, or of the chosen one.
LightSums light_sums_of_view(vec3 position, vec3 n, vec3 v, float shininess) {
    if (!view_of_one_light) return light_sums(position, n, v, shininess);
    if (view_light < 0) return LightSums(vec3(0.0), vec3(0.0));
    LightTerms t = light_terms(kind_of_light(view_light), view_light, position, n, v, shininess);
    return LightSums(t.diffuse_light, t.specular_light);
}
