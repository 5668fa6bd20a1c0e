#version 450
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) buffer State { uint state[]; };

// The same where all groups go together up to the atomic.
void main()
{
    if (gl_LocalInvocationIndex == 63u) {
        uint n = atomicAdd(state[1], 1u);
        while (state[0] < 10u) {
            state[0] += n + 1u;
        }
    }
}
