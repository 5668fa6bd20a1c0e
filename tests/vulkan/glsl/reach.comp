#version 450
// Reaches for elements, texels and descriptors by numbers that a program gives, whatever they are.
layout(local_size_x = 8) in;
layout(push_constant) uniform Push { ivec4 at; };
layout(set = 0, binding = 0) buffer Words { uint words[]; } buffers[3];
layout(set = 0, binding = 1, rgba8) uniform image2D image;
layout(set = 0, binding = 2) uniform Constants { vec4 constants[4]; } blocks[2];
layout(set = 0, binding = 3) uniform sampler2D textures[2];
layout(set = 0, binding = 4, r32ui) uniform uimageBuffer texels;
shared uint common_words[16];
void main()
{
    const int number = int(gl_LocalInvocationIndex);
    common_words[at.w + number] = 1u;
    barrier();
    vec4 sum = blocks[at.x].constants[at.y] + texelFetch(textures[at.x], at.yz, at.w);
    sum += texture(textures[at.z], vec2(at.xy)) + imageLoad(image, at.xy);
    buffers[at.x].words[at.y + number] = common_words[at.z] + uint(sum.x);
    atomicAdd(buffers[at.z].words[at.w], 1u);
    imageStore(image, at.zw, sum);
    imageAtomicAdd(texels, at.y + number, 1u);
}
