#version 450
// Corners with depth and a colour, 1/2 further right with each instance.
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 color;
layout(location = 0) out vec4 shade;
void main()
{
    gl_Position = vec4(position.x + 0.5 * gl_InstanceIndex, position.yz, 1);
    shade = color;
}
