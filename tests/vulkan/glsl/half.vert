#version 450
// A rectangle whose colour is declared and stored in part.
layout(location = 0) out vec4 shade;
void main()
{
    const vec2 corners[3] = vec2[3](vec2(-1, -1), vec2(3, -1), vec2(-1, 3));
    gl_Position = vec4(corners[gl_VertexIndex], 0, 1);
    shade.y = 1;
}
