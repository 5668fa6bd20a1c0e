#version 450
// Each block of an array goes to a buffer of its own.
layout(location = 0) in vec4 given;
layout(location = 0, xfb_buffer = 1, xfb_stride = 32) out Block
{
    layout(xfb_offset = 0) vec4 color;
    layout(xfb_offset = 20) float weight;
} blocks[2];
void main()
{
    gl_Position = given;
    for (int i = 0; i < 2; i++) {
        blocks[i].color = given;
        blocks[i].weight = given.x;
    }
}
