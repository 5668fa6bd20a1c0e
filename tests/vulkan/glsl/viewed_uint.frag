#version 450
layout(location = 0) in vec4 shade;
layout(set = 0, binding = 0) uniform usampler2D viewed;
layout(location = 0) out vec4 color;
void main()
{
    color = vec4(texture(viewed, shade.xy).rrr, 255.0) / 255.0;
}
