#version 450
layout(local_size_x = 8) in;
layout(set = 0, binding = 0) uniform Constants { vec4 scale; ivec4 whole; };
layout(set = 0, binding = 1) readonly buffer Source { float source[]; };
layout(set = 0, binding = 2) writeonly buffer Sink { uint sink[]; };
uint next = 0;

void put(uint value)
{
    sink[next * 8 + gl_LocalInvocationIndex] = value;
    next++;
}

void put(float value)
{
    put(floatBitsToUint(value));
}

void main()
{
    float x = source[gl_LocalInvocationIndex];
    uint u = floatBitsToUint(x);
    int i = int(u);
    // Simpler operations with the same bits
    put(x * 1.0);
    put(1.0 * x);
    put(x - 0.0);
    put(x / 8.0);
    put(x / -0.25);
    put(-(-x));
    put(~~u);
    put((u + 3u) - 1u);
    put(u * 16u);
    put(u / 4u);
    put(u % 8u);
    put(u ^ 5u ^ 6u);
    put(i == i ? 1u : 0u);
    // Operations that must stay
    put(x + 0.0);
    put(x * 0.0);
    put(x / 3.0);
    put(uint(i / 4));
    put(uint(i % 8));
    // Values that are computed twice
    float a = sin(x * scale.x), b = scale.y;
    if (x > 0.5) {
        b += sin(x * scale.x);
    }
    put(a);
    put(b + sin(x * scale.x) * scale.y);
}
