#version 450
layout(constant_id = 0) const int WHICH = 0;
layout(constant_id = 1) const bool ALONG_Y = false;
layout(location = 0) in vec4 value;
layout(location = 1) in vec2 at;
layout(location = 0) out vec4 target;
layout(set = 0, binding = 0) uniform sampler2D image;
layout(push_constant) uniform Push { float one; };

vec4 derivative(vec4 v)
{
    return ALONG_Y ? dFdy(v) : dFdx(v);
}

void main()
{
    vec4 v = value * one; // not a varying any more
    switch (WHICH) {
    case 0: target = derivative(value); break;
    case 1: target = derivative(v); break;
    case 2: target = derivative(textureLod(image, at, 0.0)); break;
    case 3: target = derivative(v * v); break;
    case 4: target = ALONG_Y ? fwidth(v) - abs(dFdx(v)) : fwidth(v) - abs(dFdy(v)); break;
    case 5: target = ALONG_Y ? dFdyFine(v) : dFdxCoarse(v); break;
    case 6: target = ALONG_Y ? dFdy(dFdx(v * v)) : dFdx(dFdy(v * v)); break;
    case 7:
        if (fract(at.x * 7.0) > 0.5) {
            target = derivative(textureLod(image, at, 0.0));
        } else {
            target = derivative(v * v);
        }
        break;
    default: {
        vec2 bent = at * at + 0.125 * at.yx;
        target = texture(image, bent) - textureGrad(image, bent, dFdx(bent), dFdy(bent));
        target.w = texture(image, bent).x - textureLod(image, bent, 0.0).x;
        break;
    }
    }
}
