// SPDX-License-Identifier: MIT
// A triangle that covers a picture. screen.inc has its words.
#version 450
layout(location = 0) out vec2 uv;

void main()
{
    uv = vec2(gl_VertexIndex == 1 ? 2.0 : 0.0, gl_VertexIndex == 2 ? 2.0 : 0.0);
    gl_Position = vec4(2.0 * uv.x - 1.0, 1.0 - 2.0 * uv.y, 0.0, 1.0);
}
