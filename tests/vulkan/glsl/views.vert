#version 450
#extension GL_EXT_multiview : require
layout(location = 0) out vec4 shade;
void main()
{
    const vec2 corners[3] = vec2[3](vec2(-1, -1), vec2(3, -1), vec2(-1, 3));
    gl_Position = vec4(corners[gl_VertexIndex], 0, 1);
    shade = vec4(gl_ViewIndex == 1 ? 1 : 0, gl_ViewIndex == 2 ? 1 : 0, 0, 1);
}
