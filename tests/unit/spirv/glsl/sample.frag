#version 450
layout(location = 0) in vec4 given;
layout(location = 0) out vec4 color;
layout(depth_greater) out float gl_FragDepth;

void main()
{
    color = vec4(gl_SampleID, gl_SamplePosition, gl_SampleMaskIn[0]) + given;
    gl_FragDepth = 0.5;
    gl_SampleMask[0] = gl_SampleID == 3 ? 0 : -1;
    if (gl_HelperInvocation) {
        color = vec4(0.0);
    }
}
