// SPDX-License-Identifier: MIT
// Images of every kind: what GLSL samples, fetches, gathers and asks has the bits of the functions of
// rhw/shader_binding.h, which C shaders call.
#include "../binding/bound_things.h"
#include "spirv_run.h"

#include "sampling_comp.h"
#include "levels_frag.h"
#include "plain_vert.h"

enum { LANES = 24, MAX_RESULTS = 64 };

enum image {
    LINE,
    LINES,
    PLANE,
    PLANES,
    VOLUME,
    CUBE,
    CUBES,
    SAMPLES,
    WHOLE,
    SIGNED_WHOLE,
    SHADOW,
    CUBE_SHADOW,
    TEXELS,
    WHOLE_TEXELS,
    TEXTURES,
    SAMPLERS = TEXTURES + 3,
    IMAGES = SAMPLERS + 2
};

static struct rhw_binding bind(const struct rig *rig, rhw_texture texture, rhw_sampler sampler)
{
    struct rhw_binding binding;
    assert_int_equal(rhw_binding_of_texture(rig->context, texture, sampler, &binding), RHW_OK);
    return binding;
}

// Fill the set of images that the shaders name.
static void bind_all(const struct rig *rig, struct rhw_binding set[IMAGES])
{
    static uint32_t texels[2][40];
    static const struct rhw_texture_def defs[] = {
        [LINE] = {.kind = RHW_TEXTURE_1D, .width = 13, .mip_levels = RHW_MIP_LEVELS_ALL},
        [LINES] = {.kind = RHW_TEXTURE_1D, .width = 9, .layers = 3},
        [PLANE] = {.width = 16, .height = 12, .mip_levels = RHW_MIP_LEVELS_ALL},
        [PLANES] = {.width = 8, .height = 7, .layers = 4, .mip_levels = 2},
        [VOLUME] = {.kind = RHW_TEXTURE_3D, .width = 6, .height = 5, .depth = 4, .mip_levels = 2},
        [CUBE] = {.kind = RHW_TEXTURE_CUBE, .width = 8, .height = 8, .mip_levels = 3},
        [CUBES] = {.kind = RHW_TEXTURE_CUBE, .width = 8, .height = 8, .layers = 2, .mip_levels = 3},
        [SAMPLES] = {.width = 8, .height = 8, .samples = 4},
        [WHOLE] = {.width = 8, .height = 8, .format = RHW_FORMAT_RGBA8_UINT},
        [SIGNED_WHOLE] = {.width = 8, .height = 8, .format = RHW_FORMAT_RG16_SINT},
        [SHADOW] = {.width = 16, .height = 16, .format = RHW_FORMAT_D32_FLOAT, .mip_levels = 2},
        [CUBE_SHADOW] = {.kind = RHW_TEXTURE_CUBE, .width = 8, .height = 8, .format = RHW_FORMAT_D32_FLOAT},
    };
    const rhw_sampler linear = make_sampler(rig, &(struct rhw_sampler_def){.address_v = RHW_ADDRESS_MIRROR});
    const rhw_sampler nearest =
        make_sampler(rig, &(struct rhw_sampler_def){.min_filter = RHW_FILTER_NEAREST,
                                                    .mag_filter = RHW_FILTER_NEAREST,
                                                    .mip_filter = RHW_MIP_FILTER_NEAREST});
    const rhw_sampler compares =
        make_sampler(rig, &(struct rhw_sampler_def){.compares = true, .mip_filter = RHW_MIP_FILTER_NEAREST});
    rhw_texture plane = {0};
    for (int i = 0; i <= CUBE_SHADOW; i++) {
        struct rhw_texture_def def = defs[i];
        const bool is_whole = i == WHOLE || i == SIGNED_WHOLE;
        def.format = i == SHADOW || i == CUBE_SHADOW || is_whole ? def.format : RHW_FORMAT_RGBA8_UNORM;
        const rhw_texture texture = make_texture(rig, &def);
        plane = i == PLANE ? texture : plane;
        if (i == SAMPLES) {
            const struct rhw_clear_value value = {.color = {0.25f, 0.5f, 0.75f, 1}};
            assert_int_equal(rhw_texture_clear(rig->context, texture, NULL, &value), RHW_OK);
        } else {
            write_noise(rig, texture, (uint64_t)i + 1);
        }
        set[i] = bind(rig, texture,
                      i == SAMPLES                      ? (rhw_sampler){0}
                      : i == SHADOW || i == CUBE_SHADOW ? compares
                      : is_whole                        ? nearest
                                                        : linear);
    }
    for (uint32_t i = 0; i < 40; i++) {
        texels[0][i] = texels[1][i] = i * 0x9e3779b9;
    }
    assert_true(rhw_binding_of_texel_memory(RHW_ISA_BASELINE, texels[0], sizeof *texels,
                                            RHW_FORMAT_RGBA8_UNORM, true, &set[TEXELS]));
    assert_true(rhw_binding_of_texel_memory(RHW_ISA_BASELINE, texels[1], sizeof *texels, RHW_FORMAT_R32_UINT,
                                            true, &set[WHOLE_TEXELS]));
    for (int i = 0; i < 3; i++) {
        const rhw_texture texture = make_texture(
            rig, &(struct rhw_texture_def){.format = RHW_FORMAT_RGBA8_UNORM, .width = 5 + i, .height = 6});
        write_noise(rig, texture, (uint64_t)i + 100);
        set[TEXTURES + i] = bind(rig, texture, (rhw_sampler){0});
    }
    assert_int_equal(rhw_binding_of_sampler(rig->context, linear, &set[SAMPLERS]), RHW_OK);
    assert_int_equal(rhw_binding_of_sampler(rig->context, nearest, &set[SAMPLERS + 1]), RHW_OK);
}

// What C gives ---------------------------------------------------------------------------------------

// 8 lanes of one group, and the results that the shader has left.
struct check {
    const struct rhw_binding *set;
    const uint32_t (*results)[4];
    int group, next;
    rhw_float p[4];
    rhw_int at[4], number;
};

static void expect(struct check *check, const rhw_float texel[4])
{
    for (int lane = 0; lane < 8; lane++) {
        const uint32_t *const found = check->results[check->next * LANES + check->group * 8 + lane];
        for (int c = 0; c < 4; c++) {
            if (found[c] != (uint32_t)rhw_bits_from_float(texel[c])[lane]) {
                fail_msg("result %d, lane %d, component %d: %08x for %08x", check->next, lane, c, found[c],
                         (uint32_t)rhw_bits_from_float(texel[c])[lane]);
            }
        }
    }
    check->next++;
}

static void expect_one(struct check *check, rhw_float value)
{
    expect(check, (const rhw_float[4]){value, value, value, value});
}

static void expect_whole(struct check *check, rhw_int a, rhw_int b, rhw_int c, rhw_int d)
{
    expect(check, (const rhw_float[4]){rhw_float_from_bits(a), rhw_float_from_bits(b), rhw_float_from_bits(c),
                                       rhw_float_from_bits(d)});
}

static void expect_sample(struct check *check, enum image image, const struct rhw_sample_request *request)
{
    rhw_float texel[4];
    rhw_binding_sample(&check->set[image], request, texel);
    if (request->reference) {
        expect_one(check, texel[0]);
    } else {
        expect(check, texel);
    }
}

static void expect_level(struct check *check, enum image image, rhw_float x, rhw_float y, rhw_float z,
                         rhw_float w, rhw_float level)
{
    const rhw_float at[4] = {x, y, z, w};
    expect_sample(check, image, &(struct rhw_sample_request){.coordinates = at, .lod = &level});
}

static void expect_fetch(struct check *check, enum image image, int level)
{
    const rhw_int lod = rhw_splat_int(level);
    rhw_float texel[4];
    rhw_binding_sample_fetch(&check->set[image], check->at, &lod, texel);
    expect(check, texel);
}

static void expect_gather(struct check *check, enum image image, int channel, const rhw_int *offset,
                          const rhw_float *reference)
{
    const struct rhw_sample_request request = {
        .coordinates = check->p, .offset = offset, .reference = reference};
    rhw_float texel[4];
    rhw_binding_sample_gather(&check->set[image], &request, channel, texel);
    expect(check, texel);
}

static void check_levels(struct check *check)
{
    const rhw_float *const p = check->p;
    const rhw_float none = rhw_splat(0);
    expect_level(check, LINE, p[0], none, none, none, p[3]);
    expect_level(check, LINES, p[0], p[1] * 3, none, none, p[3]);
    expect_level(check, PLANE, p[0], p[1], none, none, p[3]);
    expect_level(check, PLANES, p[0], p[1], p[2] * 4, none, p[3]);
    expect_level(check, VOLUME, p[0], p[1], p[2], none, p[3]);
    expect_level(check, CUBE, p[0], p[1], p[2], none, p[3]);
    expect_level(check, CUBES, p[0], p[1], p[2], p[3], rhw_splat(0.5f));
    expect_level(check, WHOLE, p[0], p[1], none, none, none);
    expect_level(check, SIGNED_WHOLE, p[0], p[1], none, none, none);
}

static void check_gradients(struct check *check)
{
    const rhw_float *const p = check->p;
    const rhw_float none = rhw_splat(0), q = p[3] + 2;
    const rhw_float flat[4] = {p[2] * 0.1f, p[3] * 0.1f, p[3] * 0.05f, p[0] * 0.05f};
    const rhw_float deep[6] = {p[1] * 0.3f, p[2] * 0.3f, p[3] * 0.3f, p[3] * 0.1f, p[0] * 0.1f, p[1] * 0.1f};
    const rhw_float back[6] = {p[0], p[1], p[2], p[2], p[1], p[0]};
    const rhw_float divided[4] = {p[0] / q, p[1] / q, p[2] / q, none};
    const rhw_int two[3] = {rhw_splat_int(3), rhw_splat_int(-2), rhw_splat_int(0)};
    const rhw_int other[3] = {rhw_splat_int(-1), rhw_splat_int(1), rhw_splat_int(0)};
    const rhw_int three[3] = {rhw_splat_int(1), rhw_splat_int(2), rhw_splat_int(3)};
    expect_sample(check, PLANE, &(struct rhw_sample_request){.coordinates = p, .gradient = flat});
    expect_sample(check, VOLUME, &(struct rhw_sample_request){.coordinates = p, .gradient = deep});
    expect_sample(check, CUBE, &(struct rhw_sample_request){.coordinates = p, .gradient = deep});
    for (int i = 0; i < 2; i++) {
        expect_sample(check, PLANE, &(struct rhw_sample_request){.coordinates = divided, .lod = &p[2]});
    }
    expect_sample(check, LINE, &(struct rhw_sample_request){.coordinates = divided, .lod = &p[2]});
    expect_sample(check, VOLUME, &(struct rhw_sample_request){.coordinates = divided, .gradient = back});
    expect_sample(check, PLANE, &(struct rhw_sample_request){.coordinates = p, .lod = &p[3], .offset = two});
    expect_sample(check, PLANES,
                  &(struct rhw_sample_request){.coordinates = p, .gradient = p, .offset = other});
    expect_sample(check, VOLUME,
                  &(struct rhw_sample_request){.coordinates = divided, .lod = &p[2], .offset = three});
}

static void check_shadows(struct check *check)
{
    const rhw_float *const p = check->p;
    const rhw_float none = rhw_splat(0), q = p[3] + 2, by_z = p[2] * 0.002f, by_w = p[3] * 0.002f;
    const rhw_float divided[2] = {p[0] / q, p[1] / q}, by_q = by_z / q;
    const rhw_float turned[6] = {p[1], p[2], p[3], p[3], p[0], p[1]};
    expect_sample(check, SHADOW,
                  &(struct rhw_sample_request){.coordinates = p, .reference = &by_z, .lod = &p[3]});
    expect_sample(check, CUBE_SHADOW,
                  &(struct rhw_sample_request){.coordinates = p, .reference = &by_w, .gradient = turned});
    expect_sample(check, SHADOW,
                  &(struct rhw_sample_request){.coordinates = divided, .reference = &by_q, .lod = &none});
}

static void check_texels(struct check *check)
{
    const rhw_int *const at = check->at;
    rhw_float texel[4];
    expect_fetch(check, LINE, 1);
    expect_fetch(check, LINES, 0);
    expect_fetch(check, PLANE, 1);
    expect_fetch(check, PLANES, 0);
    expect_fetch(check, VOLUME, 0);
    rhw_binding_sample_fetch_sample(&check->set[SAMPLES], at, &at[2], texel);
    expect(check, texel);
    expect_fetch(check, WHOLE, 0);
    expect_fetch(check, SIGNED_WHOLE, 0);
    rhw_binding_image_load(&check->set[TEXELS], at, texel);
    expect(check, texel);
    rhw_binding_image_load(&check->set[WHOLE_TEXELS], &at[1], texel);
    expect(check, texel);
    struct check moved = *check;
    moved.at[0] += 2;
    moved.at[1] -= 1;
    expect_fetch(&moved, PLANE, 1);
    moved.at[0] -= 3;
    moved.at[1] += 2;
    expect_fetch(&moved, PLANES, 0);
    check->next = moved.next;
    rhw_binding_sample_fetch(&check->set[PLANE], at, NULL, texel);
    const rhw_float first = texel[0], *const p = check->p;
    for (int c = 0; c < 4; c++) {
        texel[c] = p[c] * p[(c + 1) & 3] + first * p[c];
    }
    expect(check, texel);
}

static void check_gathers(struct check *check)
{
    static const int offsets[4][2] = {{-3, 1}, {2, 2}, {0, -4}, {5, 0}};
    const rhw_float by_z = check->p[2] * 0.002f;
    const rhw_int two[3] = {rhw_splat_int(2), rhw_splat_int(-3), rhw_splat_int(0)};
    expect_gather(check, PLANE, 0, NULL, NULL);
    expect_gather(check, PLANE, 2, NULL, NULL);
    expect_gather(check, PLANES, 1, NULL, NULL);
    expect_gather(check, CUBE, 3, NULL, NULL);
    expect_gather(check, WHOLE, 1, NULL, NULL);
    expect_gather(check, SHADOW, 0, NULL, &by_z);
    expect_gather(check, PLANE, 1, two, NULL);
    expect_gather(check, PLANE, 0, &check->at[2], NULL);
    rhw_float corners[4];
    for (int i = 0; i < 4; i++) {
        const rhw_int offset[3] = {rhw_splat_int(offsets[i][0]), rhw_splat_int(offsets[i][1]),
                                   rhw_splat_int(0)};
        rhw_float texel[4];
        rhw_binding_sample_gather(&check->set[PLANE],
                                  &(struct rhw_sample_request){.coordinates = check->p, .offset = offset}, 2,
                                  texel);
        corners[i] = texel[3];
    }
    expect(check, corners);
}

static void check_sizes(struct check *check)
{
    rhw_int size[3];
    rhw_binding_sample_size(&check->set[PLANE], &check->at[0], size);
    expect_whole(check, rhw_splat_int(6), rhw_splat_int(9), rhw_splat_int(3), rhw_splat_int(5));
    expect_whole(check, size[0], size[1], rhw_splat_int(4), rhw_splat_int(4));
    expect_whole(check, rhw_splat_int(8), rhw_splat_int(7), rhw_splat_int(4), rhw_splat_int(4));
    expect_whole(check, rhw_splat_int(3), rhw_splat_int(2), rhw_splat_int(2), rhw_splat_int(40));
    expect_whole(check, rhw_splat_int(2), rhw_splat_int(2), rhw_splat_int(2), rhw_splat_int(8));
}

static void check_pairs(struct check *check)
{
    struct rhw_binding pair;
    rhw_float texel[4], result[4];
    assert_true(rhw_binding_of_pair(&check->set[TEXTURES + 1], &check->set[SAMPLERS + 1], &pair));
    rhw_binding_sample_lod(&pair, check->p, check->p[3], texel);
    expect(check, texel);
    for (int fetches = 0; fetches < 2; fetches++) {
        for (int lane = 0; lane < 8; lane++) {
            const int i = check->number[lane];
            const struct rhw_binding *binding = &check->set[TEXTURES + i % 3];
            if (fetches) {
                rhw_binding_sample_fetch(binding, check->at, NULL, texel);
            } else {
                const bool has_pair =
                    i % 4 < 3 && rhw_binding_of_pair(&check->set[TEXTURES + i % 4],
                                                     &check->set[SAMPLERS + i / 3 % 2], &pair);
                rhw_binding_sample_lod(has_pair ? &pair : NULL, check->p, check->p[3], texel);
            }
            for (int c = 0; c < 4; c++) {
                result[c][lane] = texel[c][lane];
            }
        }
        expect(check, result);
    }
}

static void test_compute_samples_as_c_does(void **state)
{
    (void)state;
    static uint32_t results[MAX_RESULTS * LANES][4];
    static float points[LANES][4];
    uint64_t random = 5;
    for (int i = 0; i < LANES * 4; i++) {
        points[i / 4][i % 4] = rig_random_float(&random, -0.4f, 1.3f);
    }
    rhw_shader_program *const program =
        spirv_link(NULL, NULL, SPIRV_CREATE(sampling_comp, RHW_SHADER_COMPUTE));
    assert_int_equal(rhw_shader_program_set_size(program, 0), IMAGES);
    struct rig rig;
    struct rhw_binding set[IMAGES];
    rig_open(&rig, 4, 4);
    bind_all(&rig, set);
    const struct rhw_binding memory[2] = {spirv_memory(points, sizeof points),
                                          spirv_memory(results, sizeof results)};
    assert_int_equal(spirv_dispatch(&rig, program, &(struct rhw_shader_frame){.sets = {set, memory}}, 1),
                     RHW_OK);
    for (int group = 0; group < LANES / 8; group++) {
        struct check check = {.set = set, .results = (const uint32_t(*)[4])results, .group = group};
        for (int lane = 0; lane < 8; lane++) {
            check.number[lane] = 8 * group + lane;
            for (int c = 0; c < 4; c++) {
                check.p[c][lane] = points[8 * group + lane][c];
            }
        }
        for (int c = 0; c < 4; c++) {
            check.at[c] = rhw_int_from_float(rhw_floor(check.p[c] * 8));
        }
        check_levels(&check);
        check_gradients(&check);
        check_shadows(&check);
        check_texels(&check);
        check_gathers(&check);
        check_sizes(&check);
        check_pairs(&check);
    }
    rig_close(&rig);
    rhw_shader_program_destroy(program);
}

// Levels that follow from how coordinates change -----------------------------------------------------

enum { SIZE = 24, DRAWS = 8 };

// What the C shader gets, as the translated one does.
struct uniforms {
    const struct rhw_binding *set;
    int which;
};

// Comparisons of a window, each with a weight of its own.
static void compare_around(const struct rhw_binding *shadow, const rhw_float *at, const rhw_float *gradient,
                           rhw_float sums[4])
{
    static const struct {
        int x, y, sum;
        float weight;
    } parts[] = {{-1, -1, 0, 1}, {0, -1, 0, 2}, {1, -1, 0, 4}, {-1, 0, 1, 1}, {0, 0, 1, 2},
                 {1, 0, 1, 4},   {-1, 1, 2, 1}, {0, 1, 2, 2},  {1, 1, 2, 4},  {3, 0, 3, 1}};
    const rhw_float reference = rhw_splat(0.001f);
    sums[0] = sums[1] = sums[2] = sums[3] = rhw_splat(0.0f);
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        const rhw_int offset[3] = {rhw_splat_int(parts[i].x), rhw_splat_int(parts[i].y), rhw_splat_int(0)};
        const struct rhw_sample_request request = {
            .coordinates = at, .gradient = gradient, .reference = &reference, .offset = offset};
        rhw_float texel[4];
        rhw_binding_sample(shadow, &request, texel);
        sums[parts[i].sum] = sums[parts[i].sum] + parts[i].weight * texel[0];
    }
}

static void paint(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *const group = &groups[g];
        const struct uniforms *const uniforms = group->uniforms;
        const struct rhw_binding *const set = uniforms->set;
        const rhw_float *const at = group->varying;
        const rhw_float flat[4] = {group->ddx[0], group->ddx[1], group->ddy[0], group->ddy[1]};
        const rhw_float deep[6] = {group->ddx[0], group->ddx[1], group->ddx[2],
                                   group->ddy[0], group->ddy[1], group->ddy[2]};
        const rhw_int offset[3] = {rhw_splat_int(1), rhw_splat_int(2), rhw_splat_int(0)};
        const rhw_float bias = rhw_splat(0.75f), none = rhw_splat(0), least = rhw_splat(2.5f);
        struct rhw_sample_request request = {.coordinates = at, .gradient = flat};
        rhw_float lod[2], *const texel = group->color[0];
        switch (uniforms->which) {
        case 1: request.bias = &bias; break;
        case 2: request.gradient = deep; break;
        case 4: request.offset = offset; break;
        case 5: request.bias = &none; break;
        case 6:
            request.gradient = NULL;
            request.lod = &least;
            break;
        default: break;
        }
        if (uniforms->which == 7) {
            compare_around(&set[2], at, flat, texel);
            continue;
        }
        rhw_binding_sample(&set[uniforms->which == 2 ? 1 : 0], &request, texel);
        if (uniforms->which == 3) {
            rhw_binding_sample_query_lod(&set[0], &request, lod);
            texel[0] = rhw_binding_sample_compare_grad(&set[2], at, rhw_splat(0.001f), flat);
            texel[1] = lod[0];
            texel[2] = lod[1];
            texel[3] = rhw_splat(1);
        }
    }
}

static void draw(struct rig *rig, const void *uniforms, size_t size, float pixels[SIZE * SIZE][4])
{
    static const struct rig_vertex triangle[3] = {
        {{-1, -1, 0, 1}, {0, 0, 0, 1}}, {{9, -1, 0, 3}, {3, 1, 2, 1}}, {{-1, 5, 0, 2}, {1, 2, -1, 1}}};
    rig_begin(rig);
    rig_use_pipeline(rig);
    rig_use_vertices(rig, 0, triangle, sizeof triangle);
    rhw_pass_set_uniforms(rig->context, rig->recording, uniforms, size);
    rhw_pass_draw(rig->context, rig->recording, 0, 3, 0, 1);
    rig_end(rig);
    memcpy(pixels, rig_read_float4(rig), SIZE * SIZE * sizeof *pixels);
}

static void test_fragments_find_levels_as_c_does(void **state)
{
    (void)state;
    static float pixels[2][SIZE * SIZE][4];
    rhw_shader_program *const program = spirv_link(SPIRV_CREATE(plain_vert, RHW_SHADER_VERTEX),
                                                   SPIRV_CREATE(levels_frag, RHW_SHADER_FRAGMENT), NULL);
    struct rig rig;
    struct rhw_binding images[IMAGES];
    rig_open(&rig, SIZE, SIZE);
    bind_all(&rig, images);
    const struct rhw_binding set[3] = {images[PLANE], images[VOLUME], images[SHADOW]};
    const struct rhw_program plain = rig.pipeline.program;
    for (int which = 0; which < DRAWS; which++) {
        const struct {
            float scale;
            int which;
        } push = {1, which};
        const struct rhw_shader_frame frame = {
            .sets = {set}, .push_constants = &push, .push_size = sizeof push};
        const struct uniforms uniforms = {set, which};
        rig.pipeline.program = plain;
        rig_set_program(&rig, rig_vertex_pass, paint);
        rig.pipeline.program.varyings[0].derivatives = true;
        rig.pipeline.program.uniform_size = sizeof uniforms;
        draw(&rig, &uniforms, sizeof uniforms, pixels[0]);
        rig.pipeline.program = *rhw_shader_program_get(program);
        draw(&rig, &frame, sizeof frame, pixels[1]);
        for (int i = 0; i < SIZE * SIZE * 4; i++) {
            const float c = pixels[0][i / 4][i % 4], glsl = pixels[1][i / 4][i % 4];
            if (which == 6 ? !(c - glsl < 1e-4f && glsl - c < 1e-4f) : c != glsl) {
                fail_msg("draw %d, pixel %d, channel %d: %.9g for %.9g", which, i / 4, i % 4, (double)glsl,
                         (double)c);
            }
        }
    }
    rig_close(&rig);
    rhw_shader_program_destroy(program);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_compute_samples_as_c_does),
    cmocka_unit_test(test_fragments_find_levels_as_c_does),
};

const struct unit_tests test_spirv_images = UNIT_TESTS(tests, NULL, NULL);
