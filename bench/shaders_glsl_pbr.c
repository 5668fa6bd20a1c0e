// SPDX-License-Identifier: MIT
// The built-in physically based shader in GLSL ES 3.00: scene/draw/shading/shade_surface.c and scene/draw/shading/pbr.h, formula by
// formula and name by name, for the textures that the scenes have, one directional light and nothing mirrored. What a
// variant does not need is left out when it is compiled, as it is there.
#include "scene_pbr.h"
#include "shaders_glsl.h"
#include "draw/shading/shade_shadow.h"

#include <stdio.h>

static const char vertex_main[] =
    "precision highp float;\n"
    "layout(location = POSITION) in vec3 position;\n"
    "#ifdef NORMAL\n"
    "layout(location = NORMAL) in vec3 normal;\n"
    "#endif\n"
    "layout(location = UV) in vec2 uv;\n"
    "#ifdef MAPPED\n"
    "layout(location = TANGENT) in vec4 tangent;\n"
    "#endif\n"
    "UNIFORM(0, u, 15);\n"
    "VARYING(0) vec2 varying_uv;\n"
    "#ifndef CAST\n"
    "VARYING(1) vec3 varying_position; VARYING(2) vec3 varying_normal; VARYING(3) float varying_support;\n"
    "#endif\n"
    "#ifdef MAPPED\n"
    "VARYING(4) vec4 varying_tangent;\n"
    "#endif\n"
    "vec3 to_world(vec4 p) { return vec3(dot(u[4], p), dot(u[5], p), dot(u[6], p)); }\n"
    "void main() {\n"
    "    gl_Position = u[0] * position.x + u[1] * position.y + u[2] * position.z + u[3];\n"
    "    varying_uv = uv;\n"
    "#ifndef CAST\n"
    "    varying_position = to_world(vec4(position, 1.0));\n"
    "    varying_normal = normalize(u[7].xyz * normal.x + u[8].xyz * normal.y + u[9].xyz * normal.z);\n"
    "    varying_support = dot(varying_position, varying_normal);\n"
    "#endif\n"
    "#ifdef MAPPED\n"
    "    varying_tangent = vec4(normalize(to_world(vec4(tangent.xyz, 0.0))), tangent.w);\n"
    "#endif\n"
    "}\n";

static const char fragment_formulas[] =
    "precision highp float;\n"
    "UNIFORM(0, u, 15); UNIFORM(1, f, 22);\n"
    "TEXTURE(0) sampler2D map0; TEXTURE(1) sampler2D map1; TEXTURE(2) sampler2D map2;\n"
    "TEXTURE(3) sampler2D map3; TEXTURE(4) sampler2D map4; TEXTURE(5) sampler2D map5;\n"
    "VARYING(0) vec2 varying_uv;\n"
    "VARYING(1) vec3 varying_position; VARYING(2) vec3 varying_normal; VARYING(3) float varying_support;\n"
    "#ifdef MAPPED\n"
    "VARYING(4) vec4 varying_tangent;\n"
    "#endif\n"
    "layout(location = 0) out vec4 target;\n"
    "const float inverse_pi = 0.31830988618;\n"
    "struct reflector { vec3 normal, view; float n_dot_v, alpha; vec3 diffuse, f0; };\n"
    "float smith(float cosine, float alpha2) {\n"
    "    return cosine + sqrt(alpha2 + (1.0 - alpha2) * (cosine * cosine));\n"
    "}\n"
    "vec3 reflect_light(reflector r, vec3 to_light, vec3 irradiance, float size) {\n"
    "    float n_dot_l = clamp(dot(r.normal, to_light), 0.0, 1.0), l_dot_v = dot(to_light, r.view);\n"
    "    float h_dot_v = sqrt(max(0.5 + 0.5 * l_dot_v, 1e-6));\n"
    "    float n_dot_h = min((n_dot_l + r.n_dot_v) / (2.0 * h_dot_v), 1.0);\n"
    "    float alpha = min(r.alpha + size, 1.0), alpha2 = alpha * alpha;\n"
    "    float base = 1.0 - n_dot_h * n_dot_h * (1.0 - alpha2);\n"
    "    float visibility = smith(n_dot_l, alpha2) * smith(r.n_dot_v, alpha2);\n"
    "    float specular = alpha2 * inverse_pi / (base * base * visibility);\n"
    "    float away = 1.0 - h_dot_v, away2 = away * away, fresnel = away2 * away2 * away;\n"
    "    vec3 reflectance = r.f0 + (1.0 - r.f0) * fresnel;\n"
    "    return irradiance * n_dot_l *\n"
    "        ((1.0 - reflectance) * r.diffuse * inverse_pi + reflectance * specular);\n"
    "}\n"
    "vec3 environment_reflection(vec3 direction, float alpha) {\n"
    "    float alpha2 = alpha * alpha, height = dot(direction, f[3].xyz);\n"
    "    float above = 0.5 + 0.5 * height * inversesqrt(height * height + (0.03 + 1.2 * alpha2));\n"
    "    vec3 radiance = f[5].rgb + (f[4].rgb - f[5].rgb) * above;\n"
    "    float k = 1.0 / (1.0 + 2.0 * f[3].w * alpha2), exponent = k * (f[3].w * 1.44269504);\n"
    "    for (int i = 0; i < 3; i++)\n"
    "        radiance += f[9 + i].rgb * (k * exp2(exponent * (dot(direction, f[6 + i].xyz) - 1.0)));\n"
    "    return radiance;\n"
    "}\n"
    "vec3 environment_diffuse(vec3 normal) {\n"
    "    float above = 0.5 + 0.5 * dot(normal, f[3].xyz);\n"
    "    vec3 irradiance = f[5].rgb + (f[4].rgb - f[5].rgb) * above;\n"
    "    for (int i = 0; i < 3; i++) {\n"
    "        float t = dot(normal, f[6 + i].xyz);\n"
    "        irradiance += f[9 + i].rgb * max(f[12].x + t * (f[12].y + t * f[12].z), 0.0);\n"
    "    }\n"
    "    return irradiance;\n"
    "}\n"
    "vec2 environment_brdf(float roughness, float n_dot_v) {\n"
    "    float r0 = 1.0 - roughness, r1 = 0.0425 - 0.0275 * roughness;\n"
    "    float r2 = 1.04 - 0.572 * roughness, r3 = 0.022 * roughness - 0.04;\n"
    "    float a = min(r0 * r0, exp2(-9.28 * n_dot_v)) * r0 + r1;\n"
    "    return vec2(r2 - 1.04 * a, 1.04 * a + r3);\n"
    "}\n"
    "vec3 reflect_environment(reflector r, float roughness, float occlusion) {\n"
    "    vec3 mirrored = environment_reflection(reflect(-r.view, r.normal), r.alpha);\n"
    "    vec3 diffuse = environment_diffuse(r.normal);\n"
    "    vec2 brdf = environment_brdf(roughness, r.n_dot_v);\n"
    "    float lost = 1.0 / (brdf.x + brdf.y) - 1.0;\n"
    "    vec3 single = r.f0 * brdf.x + brdf.y, specular = single * (1.0 + r.f0 * lost);\n"
    "    float slant = r.n_dot_v + occlusion;\n"
    "    float mirrors = clamp(slant * slant - 1.0 + occlusion, 0.0, 1.0);\n"
    "    return mirrors * mirrored * specular + occlusion * diffuse * r.diffuse * (1.0 - single);\n"
    "}\n"
    "vec3 tone_map(vec3 color) {\n"
    "    const float start = 0.8 - 0.04, desaturation = 0.15, rest = 1.0 - start;\n"
    "    float low = min(color.r, min(color.g, color.b));\n"
    "    color -= low < 0.08 ? low - 6.25 * low * low : 0.04;\n"
    "    float peak = max(color.r, max(color.g, color.b));\n"
    "    if (peak <= start) return color;\n"
    "    float new_peak = 1.0 - rest * rest / (peak + (rest - start)), scale = new_peak / peak;\n"
    "    float grey = 1.0 - 1.0 / (desaturation * (peak - new_peak) + 1.0);\n"
    "    return mix(color * scale, vec3(new_peak), grey);\n"
    "}\n";

static const char fragment_main[] =
    "void main() {\n"
    "#if defined(BLENDED) || defined(GLASS)\n"
    "    vec4 base = u[10];\n"
    "#else\n"
    "    vec4 base = u[10] * texture(map0, varying_uv);\n"
    "#endif\n"
    "#ifdef MASKED\n"
    "    if (base.a < u[11].w) discard;\n"
    "#endif\n"
    "    float metallic = u[12].x, roughness = u[12].y, occlusion = 1.0;\n"
    "    vec3 emissive = u[11].rgb;\n"
    "    reflector r;\n"
    "    r.view = normalize(f[0].xyz - varying_position);\n"
    "    r.normal = varying_normal;\n"
    "#ifdef MAPPED\n"
    "    vec4 texel = texture(map1, varying_uv);\n"
    "    roughness *= texel.g;\n"
    "    metallic *= texel.b;\n"
    "    vec3 tangent = varying_tangent.xyz, bitangent = cross(r.normal, tangent);\n"
    "    vec3 slope = texture(map2, varying_uv).xyz * 2.0 - 1.0;\n"
    "    r.normal = slope.x * u[12].z * tangent + slope.y * u[12].z * varying_tangent.w * bitangent +\n"
    "        slope.z * r.normal;\n"
    "#endif\n"
    "#ifdef FULL\n"
    "    occlusion = 1.0 + u[12].w * (texture(map3, varying_uv).r - 1.0);\n"
    "    emissive *= texture(map4, varying_uv).rgb;\n"
    "#endif\n"
    "    r.normal = normalize(r.normal);\n"
    "#if defined(MASKED) || defined(BLENDED)\n"
    "    if (!gl_FrontFacing) r.normal = -r.normal;\n"
    "#endif\n"
    "#ifdef MAPPED\n"
    "    r.normal = normalize(r.normal + r.view * max(0.02 - dot(r.normal, r.view), 0.0));\n"
    "#endif\n"
    "    r.diffuse = base.rgb * (1.0 - metallic);\n"
    "    r.f0 = mix(vec3(0.04), base.rgb, metallic);\n"
    "    float rough = clamp(roughness, 0.045, 1.0);\n"
    "    r.alpha = rough * rough;\n"
    "    r.n_dot_v = clamp(dot(r.normal, r.view), 1.0 / 1024.0, 1.0);\n"
    "#ifdef GLASS\n"
    "    vec3 sum = emissive + glass(r, rough);\n"
    "#else\n"
    "    vec3 sum = emissive + reflect_environment(r, roughness, occlusion) +\n"
    "        reflect_light(r, f[1].xyz, f[2].rgb * open_to_light(r.normal), f[1].w);\n"
    "#endif\n"
    "#ifdef BLENDED\n"
    "    target = vec4(tone_map(sum) * base.a, base.a);\n"
    "#elif defined(LINEAR)\n"
    "    target = vec4(sum, 1.0);\n"
    "#else\n"
    "    target = vec4(tone_map(sum), 1.0);\n"
    "#endif\n"
    "}\n";

static const char *const heads[BENCH_SHADERS] = {
    [BENCH_SHADER_PBR_BASE] = "",
    [BENCH_SHADER_PBR_MAPPED] = "#define MAPPED\n",
    [BENCH_SHADER_PBR_MASKED] = "#define MAPPED\n#define MASKED\n",
    [BENCH_SHADER_PBR_FULL] = "#define MAPPED\n#define FULL\n",
    [BENCH_SHADER_PBR_BASE_SHADOWED] = "#define SHADOWED map1\n",
    [BENCH_SHADER_PBR_MAPPED_SHADOWED] = "#define MAPPED\n#define SHADOWED map3\n",
    [BENCH_SHADER_PBR_MASKED_SHADOWED] = "#define MAPPED\n#define MASKED\n#define SHADOWED map3\n",
    [BENCH_SHADER_PBR_FULL_SHADOWED] = "#define MAPPED\n#define FULL\n#define SHADOWED map5\n",
    [BENCH_SHADER_PBR_HAIR] = "#define BLENDED\n",
    [BENCH_SHADER_PBR_GLASS] = "#define GLASS\n",
    [BENCH_SHADER_PBR_BASE_LINEAR] = "#define LINEAR\n",
    [BENCH_SHADER_PBR_CAST] = "#define CAST\n",
    [BENCH_SHADER_PBR_CAST_MASKED] = "#define CAST\n#define MASKED\n",
};

_Static_assert(sizeof(struct bench_surface_uniforms) == 15 * 16, "`u` of the shaders");
_Static_assert(sizeof(struct bench_frame_uniforms) == 22 * 16, "`f` of the shaders");

// scene/draw/shading/layered.c and scene/draw/shading/shade_layers.h, for a volume that lets all light through and has no texture.
static const char fragment_glass[] =
    "#ifdef GLASS\n"
    "vec3 look_through(reflector r, float rough) {\n"
    "    float eta = 1.0 / u[14].x, thickness = u[13].w;\n"
    "    float inside = sqrt(max(1.0 - eta * eta * (1.0 - r.n_dot_v * r.n_dot_v), 0.0));\n"
    "    vec3 bent = (eta * r.n_dot_v - inside) * r.normal - eta * r.view;\n"
    "    vec3 direction = thickness > 0.0 ? bent : -r.view, leaves = varying_position + direction * "
    "thickness;\n"
    "    vec4 clip = f[17] * leaves.x + f[18] * leaves.y + f[19] * leaves.z + f[20];\n"
    "    vec2 at = vec2(0.5) + vec2(0.5, -0.5) * clip.xy / max(clip.w, 1e-6);\n"
    "    float blur = max(rough - 0.045, 0.0) * (u[14].x > 1.5 ? 1.0 : 2.0 * u[14].x - 2.0);\n"
    "    vec4 light = textureLod(map0, at, blur * f[21].x);\n"
    "    return light.rgb + (1.0 - light.a) * environment_reflection(direction, blur * blur);\n"
    "}\n"
    "vec3 glass(reflector r, float rough) {\n"
    "    float step = (u[14].x - 1.0) / (u[14].x + 1.0);\n"
    "    r.f0 = vec3(min(step * step, 1.0));\n"
    "    vec3 behind = look_through(r, rough) * r.diffuse * exp2(u[13].xyz * u[13].w);\n"
    "    vec3 mirrored = environment_reflection(reflect(-r.view, r.normal), r.alpha);\n"
    "    vec2 brdf = environment_brdf(rough, r.n_dot_v);\n"
    "    float lost = 1.0 / (brdf.x + brdf.y) - 1.0;\n"
    "    vec3 single = r.f0 * brdf.x + brdf.y, specular = single * (1.0 + r.f0 * lost);\n"
    "    vec3 body = mix(environment_diffuse(r.normal) * r.diffuse, behind, u[14].y);\n"
    "    vec3 sum = mirrored * specular + body * (1.0 - min(single, 1.0));\n"
    "    vec3 halfway = normalize(f[1].xyz + r.view);\n"
    "    float n_dot_l = clamp(dot(r.normal, f[1].xyz), 0.0, 1.0);\n"
    "    float n_dot_h = clamp(dot(r.normal, halfway), 0.0, 1.0);\n"
    "    float h_dot_v = clamp(dot(halfway, r.view), 0.0, 1.0);\n"
    "    float alpha = min(r.alpha + f[1].w, 1.0), alpha2 = alpha * alpha;\n"
    "    float base = 1.0 - n_dot_h * n_dot_h * (1.0 - alpha2);\n"
    "    float ggx = alpha2 * inverse_pi /\n"
    "        (base * base * smith(n_dot_l, alpha2) * smith(r.n_dot_v, alpha2));\n"
    "    float away = 1.0 - h_dot_v, away2 = away * away;\n"
    "    vec3 reflectance = r.f0 + (1.0 - r.f0) * (away2 * away2 * away);\n"
    "    vec3 lit = (1.0 - reflectance) * (1.0 - u[14].y) * r.diffuse * inverse_pi + reflectance * ggx;\n"
    "    return sum + f[2].rgb * n_dot_l * lit;\n"
    "}\n"
    "#endif\n";

// scene/draw/shading/shade_shadow.h, for one parallel map. Where nothing casts a shadow, all of the light arrives.
static const char fragment_shadow[] =
    "#ifndef SHADOWED\n"
    "float open_to_light(vec3 normal) { return 1.0; }\n"
    "#else\n"
    "struct point { vec3 place; vec2 slope, gentle; float own, step, per_texel, distance; bool away; };\n"
    "struct seen { float before, above, sum; };\n"
    "float stored(ivec2 texel) {\n"
    "    return 1.0 - texelFetch(SHADOWED, clamp(texel, ivec2(0), ivec2(int(f[16].x) - 1)), 0).r;\n"
    "}\n"
    "ivec2 texel_at(vec2 place) { return ivec2(clamp(place, 0.0, f[16].x - 1.0)); }\n"
    "float plane(point p, vec2 slope, vec2 texel) {\n"
    "    return p.place.z + dot(slope, texel + 0.5 - p.place.xy);\n"
    "}\n"
    "void search(point p, vec2 seed, float reach, inout seen s) {\n"
    "    ivec2 texel = texel_at(p.place.xy + seed * reach);\n"
    "    float depth = stored(texel), bias = p.step * (1.0 + 0.1 * reach), least = depth - bias;\n"
    "    if (max(plane(p, p.gentle, vec2(texel)), -bias) >= least) return;\n"
    "    s.before += 1.0;\n"
    "    if (p.own >= least) return;\n"
    "    s.above += 1.0;\n"
    "    s.sum += (1.0 - depth) * f[16].z;\n"
    "}\n"
    "float tap(point p, vec2 seed, float radius) {\n"
    "    float bias = p.step * (0.7 + length(seed) * 2.0 * radius), sum = 0.0;\n"
    "    vec2 at = p.place.xy + seed * radius - 0.5, corner = floor(at), part = at - corner;\n"
    "    for (int i = 0; i < 4; i++) {\n"
    "        vec2 side = vec2(i & 1, i >> 1), share = mix(1.0 - part, part, side);\n"
    "        float most = max(plane(p, p.slope, corner + side), p.own) + bias;\n"
    "        if (stored(texel_at(corner + side)) <= most) sum += share.x * share.y;\n"
    "    }\n"
    "    return sum;\n"
    "}\n"
    "point place(vec3 position, vec3 dx, vec3 dy) {\n"
    "    mat3 rows = transpose(mat3(f[13].xyz, f[14].xyz, f[15].xyz));\n"
    "    point p;\n"
    "    p.place = rows * position + vec3(f[13].w, f[14].w, f[15].w);\n"
    "    p.own = max(p.place.z, 0.0);\n"
    "    p.distance = (1.0 - p.place.z) * f[16].z;\n"
    "    p.per_texel = 1.0 / f[16].y;\n"
    "    p.step = 1.0 / (f[16].y * f[16].z);\n"
    "    vec3 x = rows * dx, y = rows * dy;\n"
    "    float area = x.x * y.y - x.y * y.x, scale = abs(area) < 1e-30 ? 0.0 : 1.0 / area;\n"
    "    p.slope = clamp(vec2(y.y * x.z - x.y * y.z, x.x * y.z - y.x * x.z) * scale, -32.0 * p.step,\n"
    "        32.0 * p.step);\n"
    "    p.gentle = clamp(p.slope, -8.0 * p.step, 8.0 * p.step);\n"
    "    p.away = area > 0.0;\n" // rows of a window go up
    "    return p;\n"
    "}\n"
    "point place_curved(vec3 position, vec3 dx, vec3 dy) {\n"
    "    vec3 n = varying_normal;\n"
    "    float rise = varying_support - dot(position, n), inverse = 1.0 / max(dot(n, n), 1e-20);\n"
    "#ifdef MASKED\n"
    "    rise = gl_FrontFacing ? max(rise, 0.0) : min(rise, 0.0);\n"
    "#else\n"
    "    rise = max(rise, 0.0);\n"
    "#endif\n"
    "    point p = place(position + n * rise, dx - n * (dot(dx, n) * inverse), dy - n * (dot(dy, n) * "
    "inverse));\n"
    "    p.place.z += p.step * 6.0;\n"
    "    p.own = max(p.place.z, 0.0);\n"
    "    return p;\n"
    "}\n"
    "float open_to_light(vec3 normal) {\n"
    "    if (dot(normal, f[1].xyz) <= 0.0) return 1.0;\n"
    "    vec3 position = varying_position, dx = dFdx(position), dy = dFdy(position);\n"
    "    point p = place(position, dx, dy);\n"
    "    if (p.away) p = place_curved(position, dx, dy);\n"
    "    if (any(lessThanEqual(p.place.xy, vec2(0.0))) || any(greaterThanEqual(p.place.xy, vec2(f[16].x))))\n"
    "        return 1.0;\n"
    "    float reach = clamp(f[16].w * p.distance / p.per_texel, 1.5, 24.0), lit = 0.0;\n"
    "    seen s = seen(0.0, 0.0, 0.0);\n"
    "    for (int n = 0; n < 12; n++) search(p, searches[n], reach, s);\n"
    "    if (s.before == 0.0) return 1.0;\n"
    "    if (s.above > 11.5) return 0.0;\n"
    "    s = seen(0.0, 0.0, 0.0);\n"
    "    for (int n = 0; n < 24; n++) search(p, more[n], reach, s);\n"
    "    float height = s.above > 0.0 ? p.distance - s.sum / s.above : 0.0;\n"
    "    float radius = clamp(f[16].w * height / p.per_texel, 1.0, 24.0);\n"
    "    for (int n = 0; n < 20; n++) lit += tap(p, taps[n], radius);\n"
    "    if (radius <= 5.0) return lit / 20.0;\n"
    "    for (int n = 0; n < 44; n++) lit += tap(p, fine[n], radius);\n"
    "    return lit / 64.0;\n"
    "}\n"
    "#endif\n";

static const char cast_main[] = "precision highp float;\n"
                                "UNIFORM(0, u, 15);\n"
                                "TEXTURE(0) sampler2D map0;\n"
                                "VARYING(0) vec2 varying_uv;\n"
                                "void main() {\n"
                                "#ifdef MASKED\n"
                                "    if ((u[10] * texture(map0, varying_uv)).a < u[11].w) discard;\n"
                                "#endif\n"
                                "}\n";

typedef void seed_function(int n, int count, float seed[3]);

static int print_seeds(char *text, size_t size, const char *name, int count, seed_function *get)
{
    int length = snprintf(text, size, "const vec2 %s[%d] = vec2[%d](", name, count, count);
    for (int n = 0; n < count; n++) {
        float seed[3];
        get(n, count, seed);
        length += snprintf(text + length, size - (size_t)length, "%svec2(%.9g, %.9g)", n ? ", " : "",
                           (double)seed[0], (double)seed[1]);
    }
    return length + snprintf(text + length, size - (size_t)length, ");\n");
}

// Everything before `main`, the places of the discs among it.
static const char *formulas(void)
{
    static char text[sizeof fragment_formulas + sizeof fragment_shadow + sizeof fragment_glass + 8192];
    if (text[0] == 0) {
        size_t at = (size_t)snprintf(text, sizeof text, "%s#ifdef SHADOWED\n", fragment_formulas);
        at += (size_t)print_seeds(text + at, sizeof text - at, "searches", SCENE_SHADOW_SEARCHES,
                                  scene_shadow_seed);
        at += (size_t)print_seeds(text + at, sizeof text - at, "more", SCENE_SHADOW_MORE,
                                  scene_shadow_seed_between);
        at += (size_t)print_seeds(text + at, sizeof text - at, "taps", SCENE_SHADOW_TAPS, scene_shadow_seed);
        at += (size_t)print_seeds(text + at, sizeof text - at, "fine", SCENE_SHADOW_FINE,
                                  scene_shadow_seed_between);
        snprintf(text + at, sizeof text - at, "#endif\n%s%s", fragment_shadow, fragment_glass);
    }
    return text;
}

void bench_glsl_pbr(enum bench_shader shader, const char *vertex[BENCH_GLSL_PIECES],
                    const char *fragment[BENCH_GLSL_PIECES])
{
    vertex[3] = fragment[3] = heads[shader];
    vertex[4] = vertex_main;
    vertex[5] = vertex[6] = fragment[6] = "";
    fragment[4] = shader >= BENCH_SHADER_PBR_CAST ? cast_main : formulas();
    fragment[5] = shader >= BENCH_SHADER_PBR_CAST ? "" : fragment_main;
}
