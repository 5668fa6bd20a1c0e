#version 450
layout(location = 0) in vec4 position;
layout(location = 1) in vec4 value;
layout(location = 0) out vec4 smooth_out;
layout(location = 1) flat out ivec2 flat_out;

void main()
{
    gl_Position = position;
    smooth_out = value;
    flat_out = ivec2(gl_VertexIndex, int(value.x * 10.0));
}
