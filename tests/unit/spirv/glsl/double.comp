#version 450
layout(local_size_x = 24) in;
layout(set = 0, binding = 0) readonly buffer Source { uint source[]; };
layout(set = 1, binding = 2) buffer Sink { uint sink[]; };
layout(constant_id = 3) const uint FACTOR = 2;

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i < source.length()) {
        sink[i] = FACTOR * source[i];
    }
}
