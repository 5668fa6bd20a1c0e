#version 450
layout(local_size_x_id = 1) in;
layout(constant_id = 0) const uint FACTOR = 1;
layout(constant_id = 7) const bool COUNTS = false;
layout(set = 0, binding = 0) readonly buffer Given { uint given[]; };
layout(set = 0, binding = 1) buffer Made { uint made[]; };
layout(set = 0, binding = 3) uniform Add { uint add; };
void main()
{
    const uint i = gl_GlobalInvocationID.x;
    made[i] = given[i] * FACTOR + add + (COUNTS ? uint(given.length()) * 1000 : 0);
}
