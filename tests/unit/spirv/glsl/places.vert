#version 450
layout(location = 0) in vec4 position;
layout(location = 1) in vec4 value;
layout(location = 0) out vec2 smooth_at;
layout(location = 1) centroid out vec2 centroid_at;
layout(location = 2) sample out vec2 sample_at;
layout(location = 3) noperspective out vec2 straight_at;
layout(location = 4) flat out float constant;

void main()
{
    gl_Position = position;
    smooth_at = centroid_at = sample_at = straight_at = value.xy;
    constant = value.x;
}
