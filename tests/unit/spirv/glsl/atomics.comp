#version 450
#extension GL_EXT_shader_atomic_float : require
layout(local_size_x = 24) in;
layout(set = 0, binding = 0) buffer Words { uint words[16]; int signed_words[8]; float numbers[4]; };
layout(set = 0, binding = 1, r32ui) uniform uimage2DArray planes;
layout(set = 0, binding = 2, r32i) uniform iimage1D line;
layout(set = 0, binding = 3, r32ui) uniform uimageBuffer texels;
layout(set = 0, binding = 4, r32f) uniform image2D floats;
layout(set = 0, binding = 5, r32ui) uniform uimageCubeArray cubes;
layout(set = 1, binding = 0) writeonly buffer Results { uint results[]; };
shared uint together[8];
shared int signed_together[2];
uint next = 0;

void put(uint value)
{
    results[next * 24 + gl_LocalInvocationIndex] = value;
    next++;
}

void main()
{
    uint i = gl_LocalInvocationIndex, value = 3u * i + 1u;
    put(atomicAdd(words[0], value));
    put(atomicMin(words[1], value ^ 5u));
    put(atomicMax(words[2], value ^ 9u));
    put(atomicAnd(words[3], ~(1u << i)));
    put(atomicOr(words[4], 1u << i));
    put(atomicXor(words[5], value));
    put(atomicExchange(words[6 + i % 2], value));
    put(atomicCompSwap(words[8], i / 4, i / 4 + 1));
    put(uint(atomicMin(signed_words[0], 7 - int(value))));
    put(uint(atomicMax(signed_words[1], int(value) - 40)));
    put(uint(atomicAdd(signed_words[i % 8], -int(i))));
    put(floatBitsToUint(atomicExchange(numbers[i % 4], float(i))));
    // Images
    ivec3 at = ivec3(i % 3, i / 8, i % 2);
    put(imageAtomicAdd(planes, at, value));
    put(imageAtomicMax(planes, at, value * 2u));
    put(imageAtomicCompSwap(planes, at, 2u, value));
    put(uint(imageAtomicMin(line, int(i % 5), 3 - int(i))));
    put(imageAtomicXor(texels, int(i % 7), value));
    put(imageAtomicOr(cubes, ivec3(1, 2, i % 13), 1u << i));
    put(floatBitsToUint(imageAtomicExchange(floats, ivec2(i % 2, 1), float(i) + 0.5)));
    // Memory of the workgroup
    if (i < 8) {
        together[i] = i;
    }
    barrier();
    atomicAdd(together[i % 8], value);
    memoryBarrierShared();
    barrier();
    put(together[(i + 1) % 8]);
    put(uint(atomicAdd(signed_together[i % 2], -3)));
}
