#version 450
// Inputs whose value is the place in the target in pixels: where are they taken? Distances from the centre of the pixel.
layout(location = 0) in vec2 smooth_at;
layout(location = 1) centroid in vec2 centroid_at;
layout(location = 3) noperspective in vec2 straight_at;
layout(location = 4) flat in float constant;
layout(location = 0) out vec4 offsets;
layout(location = 1) out vec4 samples;
layout(location = 2) out vec4 centroids;
layout(location = 3) out vec4 others;

void main()
{
    vec2 center = floor(gl_FragCoord.xy) + 0.5;
    offsets = vec4(interpolateAtOffset(smooth_at, vec2(0.25, -0.5)),
                   interpolateAtOffset(centroid_at, vec2(-0.25, 0.5))) - center.xyxy;
    samples = vec4(interpolateAtSample(smooth_at, 1), interpolateAtSample(straight_at, int(gl_FragCoord.x) & 3)) -
        center.xyxy;
    centroids = vec4(interpolateAtCentroid(smooth_at), centroid_at) - center.xyxy;
    others = vec4(interpolateAtCentroid(constant), dFdx(interpolateAtOffset(smooth_at, vec2(0.5))),
                  interpolateAtOffset(smooth_at[int(gl_FragCoord.y) & 1], vec2(0.0)));
}
