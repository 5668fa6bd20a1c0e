#version 450
layout(local_size_x = 2, local_size_y = 2) in;
layout(set = 0, binding = 0, r32ui) uniform uimage2D target;
layout(set = 0, binding = 1) uniform usamplerBuffer texels;
layout(set = 0, binding = 2, r32ui) uniform uimageBuffer count;
void main()
{
    const uint texel = texelFetch(texels, int(gl_LocalInvocationIndex)).x;
    imageStore(target, ivec2(gl_GlobalInvocationID.xy),
               uvec4(texel + 10 * gl_WorkGroupID.x + 100 * gl_WorkGroupID.y + 1000 * gl_NumWorkGroups.x));
    imageAtomicAdd(count, 1, 1);
}
