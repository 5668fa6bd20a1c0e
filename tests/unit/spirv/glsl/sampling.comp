#version 450
#extension GL_EXT_samplerless_texture_functions : require
layout(local_size_x = 24) in;
layout(set = 0, binding = 0) uniform sampler1D line;
layout(set = 0, binding = 1) uniform sampler1DArray lines;
layout(set = 0, binding = 2) uniform sampler2D plane;
layout(set = 0, binding = 3) uniform sampler2DArray planes;
layout(set = 0, binding = 4) uniform sampler3D volume;
layout(set = 0, binding = 5) uniform samplerCube cube;
layout(set = 0, binding = 6) uniform samplerCubeArray cubes;
layout(set = 0, binding = 7) uniform sampler2DMS samples;
layout(set = 0, binding = 8) uniform usampler2D whole;
layout(set = 0, binding = 9) uniform isampler2D signed_whole;
layout(set = 0, binding = 10) uniform sampler2DShadow shadow;
layout(set = 0, binding = 11) uniform samplerCubeShadow cube_shadow;
layout(set = 0, binding = 12) uniform samplerBuffer texels;
layout(set = 0, binding = 13) uniform usamplerBuffer whole_texels;
layout(set = 0, binding = 14) uniform texture2D textures[3];
layout(set = 0, binding = 15) uniform sampler samplers[2];
layout(set = 1, binding = 0) readonly buffer Points { vec4 points[]; };
layout(set = 1, binding = 1) writeonly buffer Results { uvec4 results[]; };

const ivec2 OFFSETS[4] = ivec2[4](ivec2(-3, 1), ivec2(2, 2), ivec2(0, -4), ivec2(5, 0));
uint next = 0;

void put(uvec4 value)
{
    results[next * 24 + gl_LocalInvocationIndex] = value;
    next++;
}

void put(vec4 value)
{
    put(floatBitsToUint(value));
}

void put(ivec4 value)
{
    put(uvec4(value));
}

void main()
{
    vec4 p = points[gl_LocalInvocationIndex];
    ivec4 at = ivec4(floor(p * 8.0));
    uint i = gl_LocalInvocationIndex;
    // Levels
    put(textureLod(line, p.x, p.w));
    put(textureLod(lines, vec2(p.x, p.y * 3.0), p.w));
    put(textureLod(plane, p.xy, p.w));
    put(textureLod(planes, vec3(p.xy, p.z * 4.0), p.w));
    put(textureLod(volume, p.xyz, p.w));
    put(textureLod(cube, p.xyz, p.w));
    put(textureLod(cubes, vec4(p.xyz, p.w), 0.5));
    put(textureLod(whole, p.xy, 0.0));
    put(textureLod(signed_whole, p.xy, 0.0));
    // Gradients, projections and offsets
    put(textureGrad(plane, p.xy, p.zw * 0.1, p.wx * 0.05));
    put(textureGrad(volume, p.xyz, p.yzw * 0.3, p.wxy * 0.1));
    put(textureGrad(cube, p.xyz, p.yzw * 0.3, p.wxy * 0.1));
    put(textureProjLod(plane, vec4(p.xy, 0.0, p.w + 2.0), p.z));
    put(textureProjLod(plane, vec3(p.xy, p.w + 2.0), p.z));
    put(textureProjLod(line, vec2(p.x, p.w + 2.0), p.z));
    put(textureProjGrad(volume, vec4(p.xyz, p.w + 2.0), p.xyz, p.zyx));
    put(textureLodOffset(plane, p.xy, p.w, ivec2(3, -2)));
    put(textureGradOffset(planes, p.xyz, p.xy, p.zw, ivec2(-1, 1)));
    put(textureProjLodOffset(volume, vec4(p.xyz, p.w + 2.0), p.z, ivec3(1, 2, 3)));
    // Shadows
    put(vec4(textureLod(shadow, vec3(p.xy, p.z * 0.002), p.w)));
    put(vec4(textureGrad(cube_shadow, vec4(p.xyz, p.w * 0.002), p.yzw, p.wxy)));
    put(vec4(textureProjLod(shadow, vec4(p.xy, p.z * 0.002, p.w + 2.0), 0.0)));
    // Texels
    put(texelFetch(line, at.x, 1));
    put(texelFetch(lines, at.xy, 0));
    put(texelFetch(plane, at.xy, 1));
    put(texelFetch(planes, at.xyz, 0));
    put(texelFetch(volume, at.xyz, 0));
    put(texelFetch(samples, at.xy, at.z));
    put(texelFetch(whole, at.xy, 0));
    put(texelFetch(signed_whole, at.xy, 0));
    put(texelFetch(texels, at.x));
    put(texelFetch(whole_texels, at.y));
    put(texelFetchOffset(plane, at.xy, 1, ivec2(2, -1)));
    put(texelFetchOffset(planes, at.xyz, 0, ivec2(-1, 1)));
    vec4 products = p * p.yzwx; // in registers while one component is fetched
    put(products + texelFetch(plane, at.xy, 0).x * p);
    // Gathers
    put(textureGather(plane, p.xy));
    put(textureGather(plane, p.xy, 2));
    put(textureGather(planes, p.xyz, 1));
    put(textureGather(cube, p.xyz, 3));
    put(textureGather(whole, p.xy, 1));
    put(textureGather(shadow, p.xy, p.z * 0.002));
    put(textureGatherOffset(plane, p.xy, ivec2(2, -3), 1));
    put(textureGatherOffset(plane, p.xy, at.zw, 0));
    put(textureGatherOffsets(plane, p.xy, OFFSETS, 2));
    // Sizes
    put(ivec4(textureSize(line, 1), textureSize(lines, 0), textureQueryLevels(plane)));
    put(ivec4(textureSize(plane, at.x), textureSize(cube, 1)));
    put(ivec4(textureSize(planes, 0), textureSamples(samples)));
    put(ivec4(textureSize(volume, 1), textureSize(texels)));
    put(ivec4(textureSize(cubes, 2), textureSize(samples).x));
    // Textures and samplers of their own, by numbers that are the same in all lanes and that are not
    put(textureLod(sampler2D(textures[1], samplers[1]), p.xy, p.w));
    put(textureLod(sampler2D(textures[i % 4], samplers[i / 3 % 2]), p.xy, p.w));
    put(texelFetch(textures[i % 3], at.xy, 0));
}
