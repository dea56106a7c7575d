#version 460
layout(location = 0) in vec3 aPos;
layout(location = 1) in vec3 aNormal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
layout(location = 0) out vec3 v_frag_coord;
layout(location = 1) out vec3 v_normal;
void main()
{
    vec4 world = M * vec4(aPos, 1.0);
    v_frag_coord = world.xyz;
    v_normal = normalize((itM * vec4(aNormal, 0.0)).xyz);
    gl_Position = P * V * world;
}
