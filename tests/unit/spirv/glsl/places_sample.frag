#version 450
// Inputs whose value is the place in the target in pixels, where a fragment is one sample.
layout(location = 0) in vec2 smooth_at;
layout(location = 1) centroid in vec2 centroid_at;
layout(location = 2) sample in vec2 sample_at;
layout(location = 0) out vec4 offsets;
layout(location = 1) out vec4 samples;

void main()
{
    vec2 center = floor(gl_FragCoord.xy) + 0.5;
    offsets = vec4(interpolateAtOffset(smooth_at, vec2(0.25, -0.5)) - center,
                   interpolateAtOffset(smooth_at, gl_SamplePosition - 0.5) - sample_at);
    samples = vec4(interpolateAtSample(centroid_at, 1) - center,
                   interpolateAtSample(smooth_at, gl_SampleID) - sample_at);
}
