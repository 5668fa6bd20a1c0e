#version 450
layout(local_size_x = 8) in;
layout(set = 0, binding = 0) buffer Own { uint own[]; };
void main()
{
    bool turns = (own[gl_LocalInvocationIndex] & 1u) != 0u;
    uint odd = 0u, even = 0u;
    for (uint i = 0u; i < 5u; i++) {
        if (turns) {
            odd++;
            turns = false;
        } else {
            even++;
            turns = true;
        }
    }
    own[gl_LocalInvocationIndex] = 16u * odd + even;
}
