#version 450
layout(location = 0) in vec4 position;
layout(location = 1) in vec4 value;
layout(location = 0) out vec4 color;

void main()
{
    vec4 sum = value;
    while (sum.x + sum.y < position.w) {
        sum.xy = -sum.yx;
    }
    gl_Position = position;
    color = sum;
}
