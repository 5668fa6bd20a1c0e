#version 450
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_clustered : require
#extension GL_KHR_shader_subgroup_shuffle : require
#extension GL_KHR_shader_subgroup_shuffle_relative : require
#extension GL_KHR_shader_subgroup_quad : require
layout(local_size_x = 21) in;
layout(set = 0, binding = 0) readonly buffer Source { uint source[]; };
layout(set = 0, binding = 1) buffer Results { uint results[]; };
uint next = 0;

void put(uint value)
{
    results[next * 24 + gl_LocalInvocationIndex] = value;
    next++;
}

void put(float value)
{
    put(floatBitsToUint(value));
}

void put(bool value)
{
    put(value ? 1u : 0u);
}

void main()
{
    uint i = gl_LocalInvocationIndex, value = source[i];
    int signed_value = int(value) - 50;
    float number = float(value) * 0.37 - 9.0;
    put(gl_SubgroupSize);
    put(gl_NumSubgroups);
    put(gl_SubgroupID);
    put(gl_SubgroupInvocationID);
    put(gl_SubgroupEqMask.x | gl_SubgroupGeMask.x << 8 | gl_SubgroupGtMask.x << 16);
    put(gl_SubgroupLeMask.x | gl_SubgroupLtMask.x << 8 | gl_SubgroupLtMask.y << 16);
    if ((value & 3u) != 1u) { // the other lanes take no part
        put(subgroupElect());
        put(subgroupAll(value > 5u));
        put(subgroupAny(value > 95u));
        put(subgroupAllEqual(i / 8));
        put(subgroupAllEqual(vec2(1.0, number)));
        uvec4 ballot = subgroupBallot((value & 4u) != 0u);
        put(ballot.x);
        put(subgroupInverseBallot(ballot));
        put(subgroupBallotBitExtract(ballot, i % 8));
        put(subgroupBallotBitCount(ballot));
        put(subgroupBallotInclusiveBitCount(ballot));
        put(subgroupBallotExclusiveBitCount(ballot));
        put(subgroupBallotFindLSB(ballot));
        put(subgroupBallotFindMSB(ballot));
        put(subgroupBroadcast(value, 3));
        put(subgroupBroadcastFirst(number));
        put(subgroupShuffle(value, (value >> 1) & 7u));
        put(subgroupShuffleXor(value, 5));
        put(subgroupShuffleUp(value, 2));
        put(subgroupShuffleDown(value, 1));
        put(subgroupQuadBroadcast(value, 2));
        put(subgroupQuadSwapHorizontal(value));
        put(subgroupQuadSwapVertical(value));
        put(subgroupQuadSwapDiagonal(value));
        put(subgroupAdd(number));
        put(subgroupMul(number));
        put(subgroupMin(number));
        put(subgroupMax(number));
        put(subgroupAdd(value));
        put(subgroupMul(value));
        put(uint(subgroupMin(signed_value)));
        put(uint(subgroupMax(signed_value)));
        put(subgroupMin(value));
        put(subgroupMax(value));
        put(subgroupAnd(value));
        put(subgroupOr(value));
        put(subgroupXor(value));
        put(subgroupInclusiveAdd(number));
        put(subgroupInclusiveMul(value));
        put(subgroupInclusiveMin(number));
        put(subgroupExclusiveAdd(value));
        put(subgroupExclusiveMul(number));
        put(subgroupExclusiveMin(number));
        put(subgroupExclusiveMax(number));
        put(uint(subgroupExclusiveMin(signed_value)));
        put(uint(subgroupExclusiveMax(signed_value)));
        put(subgroupExclusiveMin(value));
        put(subgroupExclusiveMax(value));
        put(subgroupExclusiveAnd(value));
        put(subgroupClusteredAdd(value, 4));
        put(subgroupClusteredAdd(number, 2));
        put(subgroupClusteredMax(value, 1));
        put(subgroupClusteredXor(value, 8));
        subgroupBarrier();
    }
}
