#version 450
layout(location = 0) in vec4 color;
layout(location = 0) out vec3 target;
layout(location = 1) out uvec2 whole;
layout(location = 2) out vec4 unset;

void main()
{
    target.r = color.r;
    whole = uvec2(7, 8);
}
