#version 450
layout(location = 0) out vec4 color;
layout(set = 0, binding = 0) readonly buffer Source { int source[]; } sources[2];

// What all lanes have alike, in groups that a triangle covers in part.
void main()
{
    int sum = 0;
    for (int k = 0; k < 2; k++) {
        if (sources[k].source[0] == 0) {
            sum += 100;
        }
        sum += sources[k].source[sources[k].source[0]] * sources[k].source.length();
    }
    color = vec4(sum, 0, 0, 1);
}
