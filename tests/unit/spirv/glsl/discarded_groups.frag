#version 450
layout(set = 0, binding = 0) buffer Counts { uint more, fewer; };
layout(location = 0) in vec4 color;
layout(location = 0) out vec4 target;
layout(push_constant) uniform Push { layout(offset = 4) int rounds; } push;

// All fragments that are left count to the same number. Groups without any do not count.
void main()
{
    if (gl_FragCoord.y < color.y) {
        discard;
    }
    int n = 0;
    for (int k = 0; k < push.rounds; k++) {
        n += 1;
    }
    if (n > 3) {
        target = vec4(atomicAdd(more, 1u));
    } else {
        target = vec4(-float(atomicAdd(fewer, 1u)));
    }
}
