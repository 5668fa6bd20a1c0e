#version 450
layout(location = 0) in vec2 at; // from 0, 0 in the top left corner to 1, 1
layout(location = 0) out vec4 color;
layout(push_constant) uniform Push { float radius; };

void main()
{
    float far = length(at - 0.5);
    float edge = fwidth(far);
    color = vec4(0.0, 0.0, 0.25, 1.0);
    if (far < radius) {
        color.rg = vec2(1.0, 0.5) * min((radius - far) / edge, 1.0);
    }
}
