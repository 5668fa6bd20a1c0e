#version 450
layout(local_size_x = 20) in;
layout(set = 0, binding = 0) buffer Words { uint words[]; };

// Lanes whose word is 0 never end.
void main()
{
    uint i = gl_GlobalInvocationID.x, steps = 0;
    while (words[i] != 1) {
        steps++;
        if (words[i] == 2) {
            break;
        }
    }
    words[i] = 100 + steps;
}
