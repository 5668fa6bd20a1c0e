#version 450
#extension GL_EXT_shader_16bit_storage : require
layout(set = 0, binding = 0) buffer Sink { uint16_t sink[]; };
layout(set = 0, binding = 1) buffer Source { uint source[]; };

void main()
{
    uint table[40];
    for (uint i = 0; i < 40; i++) {
        table[i] = source[i];
    }
    sink[gl_GlobalInvocationID.x] = uint16_t(table[source[3] % 40]);
}
