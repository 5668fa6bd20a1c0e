#version 450
layout(location = 0) out vec4 color;
layout(set = 0, binding = 0) uniform Source { ivec4 source[2]; } sources[2];
layout(set = 0, binding = 2) buffer Sink { uint covered; };

// What all lanes have alike, in groups that a triangle covers in part. The effect lets them have a mask.
void main()
{
    int sum = 0;
    for (int k = 0; k < 2; k++) {
        if (sources[k].source[0].x == 0) {
            sum += 100;
        }
        sum += sources[k].source[sources[k].source[0].x].y;
    }
    atomicAdd(covered, 1);
    color = vec4(sum, 0, 0, 1);
}
