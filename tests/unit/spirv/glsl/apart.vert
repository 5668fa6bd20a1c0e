#version 450
// Writes as many varyings as there may be, and the size that points have anyway.
layout(location = 0) in vec4 position;
layout(location = 1) in vec4 value;
layout(location = 0) out vec4 given[31];

void main()
{
    gl_Position = position;
    gl_PointSize = 1.0;
    for (int i = 0; i < 31; i++) {
        given[i] = value * float(i + 1);
    }
}
