#version 450
#extension GL_EXT_shader_16bit_storage : require
#extension GL_EXT_shader_8bit_storage : require
// Numbers of 8 and 16 bits in buffers and push constants, each of which an invocation reads, changes and writes.
layout(local_size_x = 64) in;
layout(push_constant) uniform Push { uint16_t more; int8_t less; float16_t scale; } push;
struct Record { uint8_t a; int8_t b; uint16_t c; float16_t d; int16_t e; };
layout(std430, set = 0, binding = 0) readonly buffer Source { Record records[]; };
layout(std430, set = 0, binding = 1) buffer Bytes { uint8_t bytes[]; };
layout(std430, set = 0, binding = 2) buffer Halves { float16_t halves[]; };
layout(std430, set = 0, binding = 3) buffer Whole { int whole[]; };
layout(std430, set = 0, binding = 4) buffer Vectors { i16vec4 vectors[]; };
layout(std430, set = 0, binding = 5) buffer Copies { Record copies[]; };

void main()
{
    uint i = gl_GlobalInvocationID.x;
    whole[4 * i] = int(records[i].a) + int(push.more);
    whole[4 * i + 1] = int(records[i].b) + int(push.less);
    whole[4 * i + 2] = int(uint(records[i].c));
    whole[4 * i + 3] = int(records[i].e);
    bytes[i] = uint8_t(uint(records[i].b) + uint(records[i].c));
    halves[i] = float16_t(float(records[i].d) * float(push.scale) + 1.0 / 3.0);
    vectors[i] = i16vec4(ivec4(int(records[i].e)) * ivec4(1, -1, 3, 70000));
    copies[i].a = records[i].a;
    copies[i].b = records[i].b;
    copies[i].c = records[i].c;
    copies[i].d = records[i].d;
    copies[i].e = records[i].e;
}
