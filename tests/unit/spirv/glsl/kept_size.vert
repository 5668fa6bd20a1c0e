#version 450
// Transform feedback keeps a point size that is 1, as it is where nothing writes it.
layout(location = 0) in vec4 given;
layout(xfb_buffer = 0, xfb_stride = 4) out gl_PerVertex
{
    vec4 gl_Position;
    layout(xfb_offset = 0) float gl_PointSize;
};
void main()
{
    gl_Position = given;
    gl_PointSize = 1.0;
}
