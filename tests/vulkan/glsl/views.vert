#version 450
#extension GL_EXT_multiview : require
// A triangle over everything, at a depth that the view has.
void main()
{
    gl_Position = vec4(gl_VertexIndex == 1 ? 3 : -1, gl_VertexIndex == 2 ? 3 : -1, 0.25 * gl_ViewIndex, 1);
}
