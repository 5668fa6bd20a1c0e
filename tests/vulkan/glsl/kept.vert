#version 450
// Transform feedback keeps the position and a number in buffer 0, and in buffer 1 two more, of which one goes nowhere
// else.
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 color;
layout(location = 0, xfb_buffer = 1, xfb_offset = 4, xfb_stride = 24) out vec4 shade;
layout(location = 1, xfb_buffer = 1, xfb_offset = 0, xfb_stride = 24) out float number;
layout(xfb_buffer = 0, xfb_offset = 0, xfb_stride = 16) out gl_PerVertex { vec4 gl_Position; };
void main()
{
    gl_Position = vec4(position, 1);
    shade = color;
    number = float(gl_VertexIndex + 10);
}
