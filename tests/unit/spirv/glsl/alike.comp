#version 450
layout(local_size_x = 8) in;
layout(set = 0, binding = 0) readonly buffer Source { int source[]; } sources[2];
layout(set = 0, binding = 2) buffer Sink { int sink[]; };
layout(push_constant) uniform Push { int scale, rounds; };

// What all lanes have alike, while the first of them are not active.
void main()
{
    int i = int(gl_LocalInvocationIndex), kept, sum = 0, round = 0;
    do {
        kept = scale * 3;
        round++;
    } while (round < rounds);
    sink[i] = kept;
    if (i < 4) {
        return;
    }
    for (int k = 0; k < 2; k++) {
        if (sources[k].source[0] == 0) {
            sum += 100;
        }
        sum += sources[k].source[sources[k].source[0]] * sources[k].source.length();
    }
    sink[i] += sum;
}
