#version 450
// More rounds of loops without an index than are repeated, and behind them a long loop with one.
layout(local_size_x = 32) in;
layout(std430, set = 0, binding = 0) buffer Words { uint words[]; };
#define STEP state = state * 1664525u + 1013904223u; state ^= state >> 7;
#define STEPS STEP STEP STEP STEP STEP STEP STEP STEP
#define TURNS for (uint k = 0u; k < 4u; k++) { STEPS STEP STEP STEP STEP STEP STEP state += k ^ 55551u; }

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    uint state = words[i], kept[8];
    TURNS TURNS TURNS TURNS
    TURNS
    for (int k = 0; k < 8; k++) {
        STEPS STEPS STEPS
        kept[k] = state ^ 33331u;
    }
    for (int k = 0; k < 8; k++) {
        state += kept[7 - k];
    }
    words[i] = state;
}
