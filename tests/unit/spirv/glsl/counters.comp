#version 450
layout(local_size_x = 100) in;
layout(set = 0, binding = 0) readonly buffer Source { int source[]; };
layout(set = 0, binding = 1) buffer Sink { int sink[]; };

// Counters that lanes share as long as they go round together, and others that look like it.
void main()
{
    const int x = source[gl_GlobalInvocationID.x];
    int sum = 0;
    for (int i = 0; i < 40; i++) { // lanes leave one by one
        if (i * i > x) {
            break;
        }
        if ((x & 3) == 1) {
            continue;
        }
        sum += i;
    }
    int n = 0;
    for (; n < 40; n++) {
        if (n * 3 >= x) {
            break;
        }
    }
    sum += 100 * n; // read behind the loop
    int late = 5, twice = 0;
    for (int i = 0; i < 6; i++) {
        if (((x >> i) & 1) == 1) { // lanes come here in different rounds
            sum += late;
            late++;
            for (int j = 0; j < i; j++) {
                if (j == (x & 7)) {
                    break;
                }
                sum += j * i;
            }
        }
        if (i == 2) { // all of them
            twice += 2;
        }
        twice = twice * 2 + 1;
        sum += twice;
    }
    int other = 1;
    if (x > 50) {
        other = 2;
        for (int i = 0; i < 5; i++) {
            sum += other * i;
            other += 3;
            if (i > (x & 3)) {
                break;
            }
        }
    }
    sink[gl_GlobalInvocationID.x] = sum * 16 + other; // lanes differ, though each set what all share
}
