#version 410
in vec3 Position_cameraspace;
in vec3 Normal_cameraspace;
in vec3 LightPosition_cameraspace;
out vec4 color;

struct Light {
	vec3 light_pos;
	float ambient_strength;
	float diffuse_strength;
	float specular_strength;
	float constant;
	float linear;
	float quadratic;
};
uniform Light light;
uniform vec3 materialColour;
uniform float shininess;

void main(){
	vec3 n = normalize( Normal_cameraspace );
	vec3 toLight = LightPosition_cameraspace - Position_cameraspace;
	float d = length(toLight);
	vec3 l = toLight / d;
	vec3 E = normalize(-Position_cameraspace);
	vec3 R = reflect(-l,n);
	float cosTheta = clamp( dot( n,l ), 0,1 );
	float cosAlpha = clamp( dot( E,R ), 0,1 );
	float att = 1.0 / (light.constant + light.linear*d + light.quadratic*d*d);
	color = vec4(
		materialColour * light.ambient_strength +
		materialColour * light.diffuse_strength * cosTheta * att +
		materialColour * light.specular_strength * pow(cosAlpha, shininess) * att, 1.0);
}
