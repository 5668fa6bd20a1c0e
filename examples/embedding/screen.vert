#version 450
// One triangle that covers the picture. It has no attributes: three vertices are drawn.
layout(location = 0) out vec2 at; // from 0, 0 in the top left corner to 1, 1

void main()
{
    vec2 corner = vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1);
    gl_Position = vec4(4.0 * corner - 1.0, 0.0, 1.0);
    at = vec2(2.0 * corner.x, 1.0 - 2.0 * corner.y);
}
