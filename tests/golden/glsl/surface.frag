#version 450
// What a surface is, into four targets.
layout(location = 0) in vec3 normal;
layout(location = 1) in vec2 uv;
layout(location = 2) flat in int quad;
layout(location = 0) out vec4 albedo;
layout(location = 1) out vec4 direction;
layout(location = 2) out vec4 at;
layout(location = 3) out uint number;

void main()
{
    albedo = vec4(fract(float(quad) * vec3(0.618034, 0.754878, 0.56984)), 1.0);
    direction = vec4(normalize(normal) * (gl_FrontFacing ? 1.0 : -1.0), 0.0);
    at = vec4(normal, 1.0 / gl_FragCoord.w);
    number = bitfieldInsert(uint(quad), uint(255.0 * uv.x), 16, 8) ^ bitfieldReverse(uint(quad));
}
