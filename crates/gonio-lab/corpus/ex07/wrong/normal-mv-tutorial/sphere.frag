#version 330 core


in vec3 Position_worldspace;
in vec3 Normal_cameraspace;
in vec3 EyeDirection_cameraspace;
in vec3 LightDirection_cameraspace;


out vec3 color;


uniform vec3 LightPosition_worldspace;
uniform vec3 materialColour;
uniform float ambient_strength;
uniform float diffuse_strength;
uniform float specular_strength;
uniform float kc;
uniform float kl;
uniform float kq;

void main(){

	vec3 MaterialDiffuseColor = materialColour;
	vec3 MaterialAmbientColor = vec3(ambient_strength) * MaterialDiffuseColor;
	vec3 MaterialSpecularColor = vec3(specular_strength) * MaterialDiffuseColor;


	float distance = length( LightPosition_worldspace - Position_worldspace );


	vec3 n = normalize( Normal_cameraspace );

	vec3 l = normalize( LightDirection_cameraspace );
	float cosTheta = clamp( dot( n,l ), 0,1 );


	vec3 E = normalize(EyeDirection_cameraspace);

	vec3 R = reflect(-l,n);
	float cosAlpha = clamp( dot( E,R ), 0,1 );

	color =

		MaterialAmbientColor +

		diffuse_strength * MaterialDiffuseColor * cosTheta / (kc + kl*distance + kq*distance*distance) +

		MaterialSpecularColor * pow(cosAlpha,32) / (kc + kl*distance + kq*distance*distance);
}
