#version 120
attribute vec3 aVertexPosition;
attribute vec3 aVertexColor;
uniform mat4 uMMatrix;
uniform mat4 uVMatrix;
uniform mat4 uPMatrix;
varying vec3 vColor;
void main(void) {
    mat4 mv = uVMatrix * uMMatrix;
    gl_Position = uPMatrix * (mv * vec4(aVertexPosition, 1.0));
    vColor = aVertexColor;
}
