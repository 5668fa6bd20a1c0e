#version 450
#extension GL_EXT_samplerless_texture_functions : require
// Lights on what surface.frag left.
layout(set = 0, binding = 0) uniform texture2D albedos;
layout(set = 0, binding = 1) uniform texture2D directions;
layout(set = 0, binding = 2) uniform texture2D places;
layout(set = 0, binding = 3) uniform utexture2D numbers;
layout(set = 0, binding = 4) readonly buffer lights { vec4 light[]; };
layout(location = 0) out vec4 color;

void main()
{
    const ivec2 at = ivec2(gl_FragCoord.xy);
    const vec3 place = texelFetch(places, at, 0).xyz, n = texelFetch(directions, at, 0).xyz;
    const uint number = texelFetch(numbers, at, 0).x;
    vec3 sum = vec3(0.0);
    if (dot(n, n) == 0.0) {
        color = vec4(0.02, 0.02, 0.05, 1.0);
        return;
    }
    for (int i = 0; i < light.length(); i += 2) {
        const vec3 way = light[i].xyz - place;
        const float left = 1.0 - dot(way, way) * light[i].w;
        if (left <= 0.0 || (number >> i & 1u) == 0u) {
            continue;
        }
        sum += light[i + 1].rgb * left * left * max(dot(n, normalize(way)), 0.0);
        if (all(greaterThan(sum, vec3(0.9)))) {
            break;
        }
    }
    color = vec4(texelFetch(albedos, at, 0).rgb * (0.1 + sum), 1.0);
}
