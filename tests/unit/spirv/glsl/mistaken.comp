#version 450
layout(local_size_x = 8) in;
layout(set = 0, binding = 0) uniform sampler2D image;
layout(set = 0, binding = 1) writeonly buffer Results { vec4 results[]; };

void main()
{
    uint i = gl_LocalInvocationIndex;
    results[i] = textureLod(image, vec2(0.125 * float(i), 0.5), 0.0);
}
