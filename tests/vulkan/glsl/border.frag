#version 450
// What lies beside an image, beside the colour of the primitive.
layout(location = 0) flat in vec4 shade;
layout(set = 0, binding = 0) uniform sampler2D image;
layout(location = 0) out vec4 color;
void main()
{
    color = texture(image, vec2(-1, 0.5)) + 0.0 * shade;
}
