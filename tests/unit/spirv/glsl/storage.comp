#version 450
#extension GL_EXT_shader_image_load_formatted : require
layout(local_size_x = 24) in;
layout(set = 0, binding = 0) uniform image1D line;
layout(set = 0, binding = 1) uniform image1DArray lines;
layout(set = 0, binding = 2) uniform image2D plane;
layout(set = 0, binding = 3) uniform image2DArray planes;
layout(set = 0, binding = 4) uniform image3D volume;
layout(set = 0, binding = 5) uniform imageCube cube;
layout(set = 0, binding = 6) uniform imageCubeArray cubes;
layout(set = 0, binding = 7) uniform imageBuffer texels;
layout(set = 0, binding = 8) uniform image2D table[3];
layout(set = 1, binding = 0) readonly buffer Points { vec4 points[]; };
layout(set = 1, binding = 1) writeonly buffer Results { uvec4 results[]; };
uint next = 0;

void put(vec4 value)
{
    results[next * 24 + gl_LocalInvocationIndex] = floatBitsToUint(value);
    next++;
}

void put(ivec4 value)
{
    put(intBitsToFloat(value));
}

void main()
{
    vec4 p = points[gl_LocalInvocationIndex];
    ivec4 at = ivec4(floor(p * 6.0));
    uint i = gl_LocalInvocationIndex;
    imageStore(line, at.x, p);
    imageStore(lines, at.xy, p);
    imageStore(plane, at.xy, p);
    imageStore(planes, at.xyz, p);
    imageStore(volume, at.xyz, p);
    imageStore(cube, at.xyz, p);
    imageStore(cubes, at.xyw, p);
    imageStore(texels, at.x + at.y, p);
    imageStore(table[i % 4], at.xy, p);
    barrier(); // what others stored is loaded
    put(imageLoad(line, at.x));
    put(imageLoad(lines, at.yz));
    put(imageLoad(plane, at.zw));
    put(imageLoad(planes, at.xyz));
    put(imageLoad(volume, at.xyz));
    put(imageLoad(cube, at.xyz));
    put(imageLoad(cubes, at.xyw));
    put(imageLoad(texels, at.x + at.y));
    put(imageLoad(table[(i + 1) % 4], at.xy));
    put(ivec4(imageSize(line), imageSize(lines), imageSize(texels)));
    put(ivec4(imageSize(plane), imageSize(cube)));
    put(ivec4(imageSize(planes), 1));
    put(ivec4(imageSize(volume), 1));
    put(ivec4(imageSize(cubes), 1));
}
