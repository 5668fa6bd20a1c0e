#version 450
layout(location = 0, index = 0) out vec4 color;
layout(location = 0, index = 1) out vec4 factor;
layout(location = 0) in vec4 given;

void main()
{
    color = given;
    factor = vec4(0.25, 0.5, 0.75, 1.0);
}
