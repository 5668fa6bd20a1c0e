#version 450
// A textured surface with a light: coordinates that are computed, quads that are left out, loops of several lengths.
layout(set = 0, binding = 0) uniform scene { vec4 light, eye; };
layout(set = 0, binding = 1) uniform sampler2D checker;
layout(location = 0) in vec3 normal;
layout(location = 1) in vec2 uv;
layout(location = 2) flat in int quad;
layout(location = 0) out vec4 color;

float bumps(vec2 at, int octaves)
{
    float sum = 0.0, weight = 0.5;
    for (int i = 0; i < octaves; i++, weight *= 0.5) {
        sum += weight * abs(sin(at.x) * cos(at.y + float(i)));
        at = mat2(1.6, 1.2, -1.2, 1.6) * at;
    }
    return sum;
}

void main()
{
    if ((quad * 7919 >> 3) % 11 == 3) {
        discard;
    }
    const vec2 at = 6.0 * uv + 0.1 * sin(20.0 * uv.yx);
    const vec4 texel = texture(checker, at);
    const vec3 n = normalize(normal + 0.3 * bumps(9.0 * uv, 1 + quad % 4));
    const vec3 v = normalize(eye.xyz - normal), h = normalize(v + light.xyz);
    const float edge = smoothstep(0.0, 0.3, length(fwidth(at)));
    const float gloss = pow(max(dot(n, h), 0.0), exp(3.0 * texel.r));
    const vec3 base = mix(texel.rgb, vec3(atan(n.y, n.x), acos(n.z), log(1.0 + uv.y)), 0.25);
    color = vec4(base * (0.2 + max(dot(n, light.xyz), 0.0)) + gloss + 0.2 * edge, 1.0);
}
