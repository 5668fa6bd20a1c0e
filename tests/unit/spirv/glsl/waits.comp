#version 450
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) buffer State { uint state[]; };

// One invocation changes what its loop waits for; of other groups none comes to it.
void main()
{
    uint i = gl_LocalInvocationIndex;
    if ((i & 1u) == 1u) {
        if (i != 63u) {
            return;
        }
        while (state[0] < 10u) {
            state[0] += 1u;
        }
    }
}
