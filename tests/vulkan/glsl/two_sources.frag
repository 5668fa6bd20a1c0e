#version 450
// The second source keeps a quarter of what was there.
layout(location = 0) in vec4 shade;
layout(location = 0, index = 0) out vec4 color;
layout(location = 0, index = 1) out vec4 kept;
void main()
{
    color = shade;
    kept = vec4(0.25);
}
