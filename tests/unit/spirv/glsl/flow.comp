#version 450
layout(local_size_x = 200) in;
layout(set = 0, binding = 0) readonly buffer Source { int source[]; };
layout(set = 0, binding = 1) buffer Sink { int sink[]; };
layout(push_constant) uniform Push { int which, rounds; };

int early(int x)
{
    if (which == 3 && x > 40) {
        return -x;
    }
    if (x > 90) {
        return 1000;
    }
    if (which == 2) {
        return x * 3;
    }
    return x + 1;
}

// Every kind of jump, under conditions that are the same in all lanes and under others.
void main()
{
    int i = int(gl_GlobalInvocationID.x), x = source[i], sum = 0;
    sink[i] = -7;
    if (which == 1) {
        sum += 5;
    } else if (which == 2) {
        if (x % 3 == 0) {
            return;
        }
        sum += 9;
    } else {
        sum += early(x);
    }
    for (int r = 0; r < rounds; r++) {
        if (r == 3 && which == 3) {
            continue;
        }
        if (x == r) {
            break;
        }
        for (int q = 0; q < x % 5; q++) {
            if (q == 2 && which == 0) {
                break;
            }
            sum += q * r;
            if (sum > 300) {
                sink[i] = sum;
                return;
            }
        }
        switch (x % 4 + which) {
        case 0: sum += 1;
        case 1: sum += 2; break;
        case 2:
            if (which == 1) {
                sum += 30;
                break;
            }
            continue;
        default: sum = early(sum); break;
        }
    }
    sink[i] = sum;
}
