static const char* vertexSource = R"(#version 330 core
in vec3 position;
in vec3 color;

uniform mat4 M;
uniform mat4 V;
uniform mat4 P;

out vec3 v_col;

void main(){
    v_col = color;
    gl_Position = V*M*vec4(position, 1.0);
}
)";

static const char* fragmentSource = R"(#version 330 core
in vec3 v_col;
out vec4 FragColor;

void main() {
    FragColor = vec4(v_col, 1.0);
}
)";

int main() {
    Shader shader(vertexSource, fragmentSource);
    return run(shader);
}
