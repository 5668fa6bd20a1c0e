#version 450
#extension GL_KHR_shader_subgroup_basic : require
layout(set = 0, binding = 0) buffer Counts { uint elected, lanes; };
layout(location = 0) out vec4 target;

void main()
{
    if (subgroupElect()) {
        atomicAdd(elected, 1);
    }
    atomicAdd(lanes, 1);
    target = vec4(float(gl_SubgroupSize), float(gl_SubgroupInvocationID), 0.0, 1.0);
}
