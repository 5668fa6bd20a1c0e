#version 450
layout(set = 0, binding = 0) uniform sampler2D maps[18];
layout(location = 0) in vec4 value;
layout(location = 0) out vec4 target;

void main()
{
    vec4 a = texture(maps[0], value.xy), b = texture(maps[2], value.xy), c = texture(maps[3], value.zw);
    target = exp2(sin(log2(2.0 + sin(a + 2.0 * b))) + a) + exp2(-c) + b * texture(maps[6], value.xy);
}
