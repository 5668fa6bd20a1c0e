#version 450
// Each invocation keeps WORDS numbers from one side of a barrier to the other.
layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint WORDS = 8;
layout(set = 0, binding = 0) buffer Sink { uint sink[]; };
shared uint line[gl_WorkGroupSize.x];

void main()
{
    uint i = gl_LocalInvocationIndex;
    uint kept[WORDS];
    for (uint k = 0; k < WORDS; k++) {
        kept[k] = i * (k + 3) ^ k;
    }
    line[i] = kept[i % WORDS];
    barrier();
    uint sum = line[(i + 1) % gl_WorkGroupSize.x];
    for (uint k = 0; k < WORDS; k++) {
        sum = 31 * sum + kept[k];
    }
    sink[i] = sum;
}
