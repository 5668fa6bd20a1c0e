#version 450
layout(location = 0) in vec4 color;
layout(location = 0) out vec4 target;
layout(set = 0, binding = 1) uniform Tint { vec4 tint; };

void main()
{
    target = color * tint + vec4(0.0, 0.0, 0.25, 0.0);
}
