#version 450
layout(location = 0) in vec2 position;
layout(location = 1) in vec4 color;
layout(set = 0, binding = 0) uniform Place { mat4 matrix; };
layout(location = 0) out vec4 shade;
void main()
{
    gl_Position = matrix * vec4(position, 0.25, 1.0);
    shade = color;
}
