#version 410 core
in vec2 coord;
out vec4 color;
uniform sampler2D equirectangularMap;
uniform int faceIndex;

const int RIGHT = 0, LEFT = 1, TOP = 2, BOTTOM = 3, BACK = 4;
#define PI 3.14159265

vec3 ray(vec2 p)
{
    vec3 r;
    switch (faceIndex)
    {
    default: // FRONT
        r = vec3(-p.x, -p.y, -1.0);
        break;
    case TOP:
        r = vec3(p.x, 1.0, p.y);
        break;
    case BOTTOM:
        r = vec3(p.x, -1.0, -p.y);
        break;
    case LEFT:
        r = vec3(-1.0, -p.y, -p.x);
        break;
    case RIGHT:
        r = vec3(1.0, -p.y, -p.x);
        break;
    case BACK:
        r = vec3(p.x, -p.y, 1.0);
        break;
    }
    return normalize(r);
}

void main()
{
    vec3 r = ray(coord);
    float longitude = atan(r.x, -r.z);
    float latitude = asin(clamp(r.y, -1.0, 1.0));
    color = texture(equirectangularMap, vec2(longitude / (2.0 * PI) + 0.5, 0.5 - latitude / PI));
}
