#version 450
#extension GL_EXT_shader_image_load_formatted : require
layout(local_size_x = 24) in;
layout(set = 0, binding = 0) uniform image2D numbers;
layout(set = 0, binding = 1) uniform uimage2D whole;
layout(set = 1, binding = 0) readonly buffer Points { vec4 points[]; };
layout(set = 1, binding = 1) writeonly buffer Results { uvec4 results[]; };

void main()
{
    uint i = gl_LocalInvocationIndex;
    ivec2 at = ivec2(i % 5, i / 5);
    imageStore(numbers, at, points[i]);
    imageStore(whole, at, floatBitsToUint(points[i]));
    results[i] = floatBitsToUint(imageLoad(numbers, at));
    results[24 + i] = imageLoad(whole, at);
}
