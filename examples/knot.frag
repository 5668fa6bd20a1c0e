#version 450
// The fragment shader of lesson 20: marble, wood or embers, as its specialization says. All three are looked up in space,
// so no texture is needed, and nothing shows where the tube was put together.
layout(constant_id = 0) const int STUFF = 0;
const int MARBLE = 0, WOOD = 1; // embers else

layout(set = 0, binding = 0) uniform Scene {
    mat4 to_clip;
    vec4 eye, sun;
};
layout(location = 0) in vec3 place;
layout(location = 1) in vec3 normal;
layout(location = 0) out vec4 color;

// A number from 0 to 1 that a corner of the lattice always has.
float random(ivec3 corner)
{
    uvec3 u = uvec3(corner) * uvec3(73856093u, 19349663u, 83492791u);
    uint mixed = (u.x ^ u.y ^ u.z) * 1274126177u;
    return float((mixed ^ mixed >> 15) & 0xffffu) / 65535.0;
}

// The numbers of the eight corners around a point, mixed smoothly.
float noise(vec3 p)
{
    vec3 whole = floor(p), part = p - whole;
    part = part * part * (3.0 - 2.0 * part);
    float sum = 0.0;
    for (int i = 0; i < 8; i++) {
        ivec3 corner = ivec3(i & 1, i >> 1 & 1, i >> 2);
        vec3 near = mix(1.0 - part, part, vec3(corner));
        sum += near.x * near.y * near.z * random(ivec3(whole) + corner);
    }
    return sum;
}

// Noise of finer and finer lattices, until one is as fine as a pixel. fwidth says how far `place` moves in a pixel.
float clouds(vec3 p)
{
    float pixel = length(fwidth(place)), sum = 0.5, size = 0.5;
    for (float scale = 1.0; scale < 64.0 && scale * pixel < 1.0; scale *= 2.0) {
        sum += size * (noise(scale * p) - 0.5) * (1.0 - scale * pixel);
        size *= 0.5;
    }
    return sum;
}

void main()
{
    vec3 n = normalize(normal), to_eye = normalize(eye.xyz - place), glow = vec3(0.0);
    vec3 base;
    float gloss;
    if (STUFF == MARBLE) {
        float vein = abs(sin(4.0 * place.x + 3.0 * place.y + 9.0 * clouds(2.0 * place)));
        base = mix(vec3(0.10, 0.22, 0.20), vec3(0.86, 0.87, 0.82), pow(vein, 0.35));
        gloss = 0.5;
    } else if (STUFF == WOOD) {
        float ring = fract(9.0 * length(place.xy + vec2(0.35, 1.1)) + 2.5 * clouds(place));
        float fiber = noise(vec3(40.0, 40.0, 3.0) * place);
        float late = smoothstep(0.1, 0.85, ring) * (1.0 - smoothstep(0.85, 1.0, ring));
        base = mix(vec3(0.55, 0.28, 0.11), vec3(0.23, 0.09, 0.03), late) * (0.8 + 0.3 * fiber);
        gloss = 0.25;
    } else {
        float heat = 1.0 - abs(2.0 * clouds(3.0 * place) - 1.0);
        glow = pow(heat, 14.0) * vec3(2.2, 0.55, 0.06);
        base = vec3(0.05, 0.045, 0.045);
        gloss = 0.12;
    }
    float direct = max(dot(n, sun.xyz), 0.0), sky = 0.5 + 0.5 * n.y;
    float shine = pow(max(dot(reflect(-to_eye, n), sun.xyz), 0.0), 40.0);
    vec3 light = vec3(1.0, 0.93, 0.82) * direct + vec3(0.16, 0.20, 0.28) * sky + 0.04;
    color = vec4(base * light + gloss * shine + glow, 1.0);
}
