#version 450
layout(location = 0) in vec4 shade;
layout(set = 0, binding = 0) uniform sampler2D viewed;
layout(location = 0) out vec4 color;
void main()
{
    color = texture(viewed, shade.xy);
}
