#version 450
layout(location = 0) in vec4 position;
layout(location = 1) in vec4 value;
layout(location = 0) out vec4 given;

void main()
{
    gl_Position = position;
    given = value;
}
