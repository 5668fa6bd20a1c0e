#version 450
#extension GL_KHR_shader_subgroup_shuffle : require
layout(location = 0) in vec4 color;
layout(location = 0) out vec4 target;

void main()
{
    target = subgroupShuffleXor(color, 1u);
}
