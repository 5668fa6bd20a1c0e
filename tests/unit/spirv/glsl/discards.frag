#version 450
layout(set = 0, binding = 0) buffer Counts { uint behind; };
layout(location = 0) in vec4 color;
layout(location = 0) out vec4 target;

void main()
{
    if (gl_FragCoord.x > color.x) {
        if (gl_FragCoord.y > color.y) {
            discard;
        }
        if (gl_FragCoord.y < color.z) {
            discard;
        }
    }
    atomicAdd(behind, 1);
    target = vec4(1.0);
}
