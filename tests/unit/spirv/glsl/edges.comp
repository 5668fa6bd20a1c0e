#version 450
layout(local_size_x = 8) in;
struct Three { uint x, y, z; };
layout(set = 0, binding = 0, std430) readonly buffer From { Three from[]; };
layout(set = 0, binding = 1, std430) buffer To { uvec4 to[]; };
layout(push_constant) uniform Push { uint at; };

void main()
{
    Three three = from[at];
    to[gl_GlobalInvocationID.x] = uvec4(three.x, three.y, three.z, from[1].z);
}
