#version 450
layout(input_attachment_index = 0, set = 0, binding = 0) uniform subpassInput given;
layout(location = 0) out vec4 color;
void main()
{
    color = subpassLoad(given) * vec4(0.5, 0.5, 0.5, 1.0) + vec4(0.0, 0.0, 0.2, 0.0);
}
