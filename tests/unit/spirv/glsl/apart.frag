#version 450
// Takes the derivative of one of four components, at as many locations as a constant says.
layout(constant_id = 0) const int count = 2;
layout(location = 0) in vec4 given[31];
layout(location = 0) out vec4 color;

void main()
{
    color = vec4(0.0);
    for (int i = 0; i < count; i++) {
        color += given[i];
        color.w += 100.0 * dFdx(given[i].y);
    }
}
