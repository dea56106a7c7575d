#include <glad/glad.h>
#include <GLFW/glfw3.h>

const char *vertexShaderSource =
    "#version 330 core\n"
    "in vec3 position;\n"
    "in vec3 color;\n"
    "\n"
    "uniform mat4 M;\n"
    "uniform mat4 V;\n"
    "uniform mat4 P;\n"
    "\n"
    "out vec3 v_col;\n"
    "\n"
    "void main(){\n"
    "    v_col = color;\n"
    "    gl_Position = P*V*M*vec4(position, 1.0);\n"
    "}\n";
const char *fragmentShaderSource =
    "#version 330 core\n"
    "in vec3 v_col;\n"
    "out vec4 FragColor;\n"
    "\n"
    "void main() {\n"
    "    FragColor = vec4(v_col, 1.0);\n"
    "}\n";
