#version 450
// Transform feedback keeps more components than there are varyings, in two buffers.
layout(location = 0) in vec4 given;
layout(location = 0, xfb_buffer = 0, xfb_offset = 0, xfb_stride = 256) out vec4 many[16];
layout(location = 16, xfb_buffer = 1, xfb_offset = 0, xfb_stride = 16) out vec4 last;
void main()
{
    gl_Position = given;
    for (int i = 0; i < 16; i++) {
        many[i] = given * float(i);
    }
    last = given;
}
