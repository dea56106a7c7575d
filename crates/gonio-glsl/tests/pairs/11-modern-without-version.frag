out vec4 FragColor;
in vec3 v_col;
uniform sampler2D tex0;
void main() { FragColor = vec4(v_col, 1.0) * texture(tex0, v_col.xy); }
