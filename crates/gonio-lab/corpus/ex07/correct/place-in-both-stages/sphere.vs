#version 410
layout(location = 0) in vec3 vertexPosition_modelspace;
layout(location = 1) in vec2 vertexUV;
layout(location = 2) in vec3 vertexNormal_modelspace;

uniform mat4 MVP;
uniform mat4 V;
uniform mat4 M;
uniform vec3 LightPosition_worldspace;

out vec3 Position_cameraspace;
out vec3 Normal_cameraspace;
out vec3 LightPosition_cameraspace;

void main(){
	gl_Position =  MVP * vec4(vertexPosition_modelspace,1);
	Position_cameraspace = ( V * M * vec4(vertexPosition_modelspace,1)).xyz;
	LightPosition_cameraspace = ( V * vec4(LightPosition_worldspace,1)).xyz;
	Normal_cameraspace = mat3(transpose(inverse(V * M))) * vertexNormal_modelspace;
}
