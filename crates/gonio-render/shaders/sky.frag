// The environment behind the objects.

in vec3 v_direction;

uniform highp samplerCube environment_map;
uniform float environment_intensity;
uniform float environment_level;

out vec4 frag_color;

void main() {
    frag_color = vec4(environment_intensity * textureLod(environment_map, v_direction, environment_level).rgb, 1.0);
}
