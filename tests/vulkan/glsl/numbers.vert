#version 460
// A quarter of the target for each draw, whose colour tells the draw's numbers.
layout(push_constant) uniform Push { vec4 scale; };
layout(location = 0) out vec4 shade;
void main()
{
    const vec2 corners[3] = vec2[3](vec2(0, 0), vec2(2, 0), vec2(0, 2));
    const vec2 from = vec2(-1, 0.5 * gl_DrawID - 1);
    gl_Position = vec4(from + corners[gl_VertexIndex - gl_BaseVertex] * 0.25, 0, 1);
    shade = vec4(gl_BaseVertex, gl_BaseInstance, gl_DrawID, 255) * scale;
}
