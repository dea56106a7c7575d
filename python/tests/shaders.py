"""Answers to exercise ex04, Phong shading with diffuse light."""

VERTEX = """#version 300 es
in vec3 position;
in vec3 normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
out vec3 v_normal;
out vec3 fragCoord;
void main()
{
    v_normal = normalize((itM * vec4(normal, 0.0)).xyz);
    fragCoord = (M * vec4(position, 1.0)).xyz;
    gl_Position = P * V * vec4(fragCoord, 1.0);
}
"""

FRAGMENT = """#version 300 es
precision highp float;
in vec3 v_normal;
in vec3 fragCoord;
uniform vec3 u_light_pos;
uniform vec3 materialColour;
out vec4 frag_color;
void main()
{
    vec3 n = normalize(v_normal);
    vec3 l = normalize(u_light_pos - fragCoord);
    frag_color = vec4(materialColour * max(dot(n, l), 0.0), 1.0);
}
"""

RIGHT = {"answer.vert": VERTEX, "answer.frag": FRAGMENT}
WRONG = {"answer.vert": VERTEX, "answer.frag": FRAGMENT.replace("max(dot(n, l), 0.0)", "abs(dot(n, l))")}
ENDLESS = {"answer.vert": VERTEX, "answer.frag": FRAGMENT.replace("vec3 n =", "for (int i = 0; i < 1; ) { }\n    vec3 n =")}
