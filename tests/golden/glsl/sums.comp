#version 450
// Sums along rows in shared memory, and how many of them each interval has.
layout(local_size_x = 64) in;
layout(set = 0, binding = 0) buffer values { float value[]; };
layout(set = 0, binding = 1) buffer counts { uint count[16]; };
shared float row[64];

void main()
{
    const uint own = gl_LocalInvocationIndex;
    row[own] = sinh(sin(float(gl_GlobalInvocationID.x) * 0.37)) + value[gl_GlobalInvocationID.x];
    barrier();
    for (uint reach = 1u; reach < 64u; reach *= 2u) {
        const float before = own >= reach ? row[own - reach] : 0.0;
        barrier();
        row[own] += before;
        barrier();
    }
    value[gl_GlobalInvocationID.x] = row[own] / (1.0 + float(own));
    atomicAdd(count[uint(clamp(4.0 * row[own], 0.0, 15.0))], 1u + (gl_WorkGroupID.x & 1u));
}
