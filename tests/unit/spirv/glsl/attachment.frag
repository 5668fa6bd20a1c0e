#version 450
layout(input_attachment_index = 0, set = 0, binding = 0) uniform subpassInput whole;
layout(input_attachment_index = 1, set = 0, binding = 1) uniform subpassInputMS parts;
layout(location = 0) in vec4 given;
layout(location = 0) out vec4 plain;
layout(location = 1) out vec4 third;
layout(location = 2) out vec4 change;
layout(location = 3) out vec4 masked;

void main()
{
    plain = subpassLoad(whole) * given;
    third = subpassLoad(parts, 2);
    masked = subpassLoad(parts, 3);
    change = dFdx(subpassLoad(whole));
}
