#version 450
layout(location = 0) in vec4 a;
layout(location = 1) in vec4 b;
layout(location = 4) flat in ivec4 n;
layout(location = 0) out vec4 target;
layout(set = 0, binding = 0) uniform Block { mat4 matrix; vec3 axis; float values[4]; int count; };

struct Part { vec2 at; float weight; };

float fall(int k, float x)
{
    switch (k) {
    case 0: x += 1.0;
    case 1: x *= 2.0; break;
    case 2: return x - 1.0;
    case 7:
    case 8: x = sqrt(x);
    default: x = -x;
    }
    return x + 0.5;
}

vec4 rounds(vec4 v, int most)
{
    Part parts[3];
    for (int i = 0; i < 3; i++) {
        parts[i] = Part(v.xy * float(i), values[i]);
    }
    for (int i = 0; i < most; i++) {
        if (v.x > 10.0) {
            break;
        }
        if (i == 3) {
            continue;
        }
        int j = 0;
        do {
            v += vec4(parts[j].at, parts[j].weight, 0.25);
            j++;
        } while (j < 2 && v.y < 4.0);
    }
    return v;
}

void main()
{
    vec4 v = matrix * a;
    if (b.x < 0.1) {
        discard;
    }
    v = rounds(v, min(count, 5));
    v.w = fall(n.x, v.w) + fall(2, b.y);
    v[n.y & 3] = dFdx(v.x * b.x) + fwidth(b.y);
    target = mix(v, b, step(0.5, b.z)) * dot(axis, b.xyz);
}
