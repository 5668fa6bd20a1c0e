#version 450
layout(location = 0) in vec4 color;
layout(location = 0) out vec4 target;

void main()
{
    float sum = color.x;
    for (float step = color.y; sum < 1.0; sum += step) {
    }
    target = vec4(sum, 0.0, 0.0, 1.0);
}
