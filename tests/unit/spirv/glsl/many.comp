#version 450
#extension GL_EXT_nonuniform_qualifier : require
layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer Many { uint x; } many[64];
layout(set = 0, binding = 1) buffer Sink { uint sink[]; };
void main() { uint i = gl_LocalInvocationIndex; sink[i] = many[nonuniformEXT(i)].x; }
