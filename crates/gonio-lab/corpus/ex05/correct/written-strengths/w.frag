#version 330 core
in float v_light;
out vec4 FragColor;
void main()
{
   FragColor = vec4(vec3(v_light), 1.0);
}
