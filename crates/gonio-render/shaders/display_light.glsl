// Exposure, tone map, encoding: the twin of OutputTransform::encode, with all choices made at compile time.

vec3 display_light(vec3 linear, float stops) {
    vec3 c = exposed(linear, stops);
#if TONE_MAP == TONE_MAP_REINHARD
    c = reinhard(c);
#elif TONE_MAP == TONE_MAP_ACES
    c = aces(c);
#elif TONE_MAP == TONE_MAP_AGX
    c = agx(c);
#endif
#if ENCODE_SRGB
    return srgb_encode(c);
#else
    return unit_interval(c);
#endif
}
