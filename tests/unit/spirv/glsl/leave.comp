#version 450
// All lanes leave a function, and a round of a loop, at once.
layout(local_size_x = 20) in;
layout(push_constant) uniform choices { float which; int skipped; };
layout(set = 0, binding = 0) buffer words { uint word[]; };

uint pick()
{
    if (which > 0.5) {
        return 1;
    }
    return 2;
}

void main()
{
    uint rounds = 0;
    for (int i = 0; i < 4; i++) {
        if (i == skipped) {
            continue;
        }
        rounds++;
    }
    word[gl_GlobalInvocationID.x] = pick() + 10 * rounds;
}
