#version 130
in vec3 position;
in vec3 normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
uniform vec3 u_light_pos;
uniform vec3 u_view_pos;
uniform vec3 materialColour;
out vec3 v_col;
vec3 light(vec3 p, vec3 n)
{
    vec3 l = normalize(u_light_pos - p);
    float nl = dot(n, l);
    if (nl <= 0.0)
        return vec3(0.0);
    float c = dot(2.0 * nl * n - l, normalize(u_view_pos - p));
    if (c <= 0.0)
        return materialColour * nl;
    for (int i = 0; i < 5; i++)
        c = c * c;                  // c^32
    return materialColour * (nl + c);
}
void main()
{
    vec4 w = M * vec4(position, 1.0);
    v_col = light(w.xyz, normalize((itM * vec4(normal, 1.0)).xyz));
    gl_Position = P * V * w;
}
