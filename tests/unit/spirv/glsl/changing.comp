#version 450
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) buffer Numbers { float first, all; float numbers[64]; };
layout(push_constant) uniform Push { int rounds; } push;

// Every round reads what one invocation stored before a barrier, and what each invocation stored itself.
void main()
{
    float x = numbers[gl_LocalInvocationIndex];
    for (int k = 0; k < push.rounds; k++) {
        if (gl_LocalInvocationIndex == 0u) {
            first += 1.5;
        }
        barrier();
        x = exp2(0.5 * log2(x + first));
        all = float(k) * 3.0 + 1.0;
        x = exp2(0.5 * log2(x + all));
        barrier();
    }
    numbers[gl_LocalInvocationIndex] = x;
}
