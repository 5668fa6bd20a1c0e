#version 450
layout(location = 0) in vec4 position;
layout(location = 1) in vec4 corner; // x and y of 0..1
layout(location = 0) out vec4 value;
layout(location = 1) out vec2 at;

void main()
{
    float middle = 0.5 * (corner.x + corner.y);
    gl_Position = position;
    value = mix(vec4(-97.0, 0.2, 71.0, 74.0), vec4(-13.2, -77.0, 44.0, 76.0), vec4(corner.xy, middle, 1.0 - middle));
    at = corner.xy;
}
