#version 450
layout(location = 0) in vec4 position;
layout(location = 0) out vec4 a0;
layout(location = 1) out vec4 a1;
layout(location = 2) out vec4 a2;
layout(location = 3) out vec4 a3;
layout(location = 4) flat out ivec4 a4;
layout(location = 5) out vec4 a5;
layout(location = 6) out vec4 a6;
layout(location = 7) out vec4 a7;

void main()
{
    gl_Position = position;
    a0 = position;
    a1 = 0.5 * position + 0.5;
    a2 = vec4(gl_VertexIndex);
    a3 = a1 * a2;
    a4 = ivec4(gl_InstanceIndex);
    a5 = a6 = a7 = vec4(1.0, 2.0, 3.0, 4.0);
}
