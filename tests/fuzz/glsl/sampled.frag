#version 450
layout(location = 1) in vec4 at;
layout(location = 0) out vec4 target;
layout(set = 0, binding = 0) uniform sampler2D whole;
layout(set = 0, binding = 1) uniform texture2D texels[3];
layout(set = 0, binding = 2) uniform sampler how;
layout(set = 1, binding = 0, rgba8) uniform image2D image;
layout(set = 1, binding = 1) uniform sampler2DShadow shadow;
layout(push_constant) uniform Push { vec4 offset; int which; };

void main()
{
    vec4 sum = texture(whole, at.xy) + textureLod(whole, at.yx, 1.0) + textureGrad(whole, at.xy, at.zw, at.xy);
    sum += texture(sampler2D(texels[which], how), at.xy * at.z + offset.xy);
    sum += texelFetch(whole, ivec2(at.xy * 4.0), 0) + textureGather(whole, at.xy, 2);
    sum += textureOffset(whole, at.xy, ivec2(1, -1)) + textureProj(whole, at.xyw);
    sum.x += texture(shadow, at.xyz) + float(textureSize(whole, 0).x) + textureQueryLod(whole, at.xy).x;
    imageStore(image, ivec2(gl_FragCoord.xy), sum);
    target = sum + imageLoad(image, ivec2(1, 2));
}
