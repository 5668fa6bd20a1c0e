#version 450
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) buffer Numbers { float first, all; float numbers[64]; };
layout(push_constant) uniform Push { int rounds; } push;

// The condition is known when the module is translated, and has the bits that the counter counts by.
void main()
{
    float x = numbers[gl_LocalInvocationIndex];
    int k = push.rounds;
    if ((push.rounds & 0) == 0) {
        do {
            k--;
            x = exp2(0.5 * log2(x + float(k)));
        } while (k > 0);
    }
    numbers[gl_LocalInvocationIndex] = x;
}
