#version 450
layout(location = 0) in vec4 position;
layout(location = 1) in vec4 value;
layout(location = 0) out vec4 color;
layout(push_constant) uniform Push { float scale; } push;

void main()
{
    gl_Position = vec4(position.xy * push.scale, position.zw);
    color = value;
}
