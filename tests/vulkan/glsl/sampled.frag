#version 450
// The colour of a quad says what is sampled, and where.
layout(location = 0) in vec4 shade;
layout(set = 0, binding = 0) uniform sampler2D whole;
layout(set = 0, binding = 1) uniform texture2D parts[3];
layout(set = 1, binding = 2) uniform sampler fixed_sampler;
layout(location = 0) out vec4 color;
void main()
{
    const int which = int(shade.a * 255.0 + 0.5);
    color = which < 3 ? texture(sampler2D(parts[which], fixed_sampler), shade.xy) : texture(whole, shade.xy);
}
