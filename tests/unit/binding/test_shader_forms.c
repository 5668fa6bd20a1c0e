// SPDX-License-Identifier: MIT
// Both shader forms: one vertex and one fragment at a time must give the bytes of the 8-lane form, with every
// builtin, discard, depth output and textures; and the mixes of the two.
#include "harness.h"

#include <string.h>

enum { SIZE = 100, TRIANGLES = 40 };

struct block {
    float gain[4];
};

static void wide_vertex(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const struct block *u = groups[g].uniforms;
        for (int c = 0; c < 4; c++) {
            groups[g].position[c] = groups[g].attribute[0][c];
            groups[g].varying[c] = groups[g].attribute[1][c] * u->gain[c];
        }
        groups[g].varying[4] = __builtin_convertvector(groups[g].vertex_index, rhw_float);
        groups[g].varying[5] = __builtin_convertvector(groups[g].instance_index, rhw_float);
    }
}

static void narrow_vertex(struct rhw_vertex1 *vertex)
{
    const struct block *u = vertex->uniforms;
    for (int c = 0; c < 4; c++) {
        vertex->position[c] = vertex->attribute[0][c];
        vertex->varying[c] = vertex->attribute[1][c] * u->gain[c];
    }
    vertex->varying[4] = (float)vertex->vertex_index;
    vertex->varying[5] = (float)vertex->instance_index;
}

static void wide_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *f = &groups[g];
        const struct block *u = f->uniforms;
        const rhw_float uv[2] = {f->varying[0], f->varying[1]};
        const rhw_float grad[4] = {f->ddx[0], f->ddx[1], f->ddy[0], f->ddy[1]};
        rhw_float texel[4];
        rhw_sample_grad(f->textures, 2, uv, grad, texel);
        for (int c = 0; c < 4; c++) {
            f->color[0][c] = f->varying[c] + texel[c] * u->gain[c];
            f->color[2][c] = f->coord[c];
        }
        f->color[1][0] = rhw_select(f->front_facing, rhw_splat(1), rhw_splat(-1));
        f->color[1][1] = __builtin_convertvector(f->primitive * 100 + f->instance * 10 + f->draw, rhw_float);
        f->color[1][2] = f->varying[4];
        f->color[1][3] = f->varying[5];
        for (int i = 0; i < 3; i++) {
            f->color[3][i] = f->barycentric[i];
            f->color[4][i] = f->barycentric_noperspective[i];
            f->color[5][i] = f->barycentric_ddx[i];
            f->color[6][i] = f->barycentric_ddy[i];
        }
        f->color[3][3] = f->ddx[2];
        f->color[4][3] = f->ddy[2];
        f->color[5][3] = f->depth;
        f->color[6][3] = f->varying[3];
        f->depth = f->depth * 0.5f + 0.125f;
        f->mask &= f->varying[2] > -0.5f;
    }
}

static void narrow_fragment(struct rhw_fragment1 *f)
{
    const struct block *u = f->uniforms;
    const rhw_float uv[2] = {rhw_splat(f->varying[0]), rhw_splat(f->varying[1])};
    const rhw_float grad[4] = {rhw_splat(f->ddx[0]), rhw_splat(f->ddx[1]), rhw_splat(f->ddy[0]),
                               rhw_splat(f->ddy[1])};
    rhw_float texel[4];
    rhw_sample_grad(f->textures, 2, uv, grad, texel);
    for (int c = 0; c < 4; c++) {
        f->color[0][c] = f->varying[c] + texel[c][0] * u->gain[c];
        f->color[2][c] = f->coord[c];
    }
    f->color[1][0] = f->front_facing ? 1 : -1;
    f->color[1][1] = (float)(f->primitive * 100 + f->instance * 10 + f->draw);
    f->color[1][2] = f->varying[4];
    f->color[1][3] = f->varying[5];
    for (int i = 0; i < 3; i++) {
        f->color[3][i] = f->barycentric[i];
        f->color[4][i] = f->barycentric_noperspective[i];
        f->color[5][i] = f->barycentric_ddx[i];
        f->color[6][i] = f->barycentric_ddy[i];
    }
    f->color[3][3] = f->ddx[2];
    f->color[4][3] = f->ddy[2];
    f->color[5][3] = f->depth;
    f->color[6][3] = f->varying[3];
    f->depth = f->depth * 0.5f + 0.125f;
    f->discard = !(f->varying[2] > -0.5f);
}

struct scene {
    struct rig_vertex vertices[3 * TRIANGLES];
    rhw_texture texture;
    rhw_sampler sampler;
};

static void make_scene(struct rig *rig, struct scene *scene)
{
    uint64_t random = 33;
    for (int i = 0; i < 3 * TRIANGLES; i++) {
        rig_place(rig, rig_random_float(&random, -30, 130), rig_random_float(&random, -30, 130),
                  rig_random_float(&random, -0.1f, 1.1f), rig_random_float(&random, 1, 9),
                  scene->vertices[i].position);
        for (int c = 0; c < 4; c++) {
            scene->vertices[i].value[c] = rig_random_float(&random, -1, 1);
        }
    }
    struct rhw_texture_def def = rhw_texture_def_default();
    def.width = def.height = 16;
    def.mip_levels = RHW_MIP_LEVELS_ALL;
    assert_int_equal(rhw_texture_create(rig->context, &def, &scene->texture), RHW_OK);
    unsigned char texels[16 * 16 * 4];
    for (size_t i = 0; i < sizeof texels; i++) {
        texels[i] = (unsigned char)rig_random(&random);
    }
    rhw_texture_write(rig->context, scene->texture, 0, texels, 0);
    rhw_texture_generate_mips(rig->context, scene->texture);
    const struct rhw_sampler_def sampler_def = rhw_sampler_def_default();
    assert_int_equal(rhw_sampler_create(rig->context, &sampler_def, &scene->sampler), RHW_OK);
}

static uint64_t draw_scene(struct rig *rig, const struct scene *scene)
{
    rig_begin(rig);
    rig_use_pipeline(rig);
    rig_use_vertices(rig, 0, scene->vertices, sizeof scene->vertices);
    rhw_pass_set_texture(rig->context, rig->recording, 2, scene->texture, scene->sampler);
    const struct block block = {{1.5f, -0.75f, 1, 0.5f}};
    rhw_pass_set_uniforms(rig->context, rig->recording, &block, sizeof block);
    rhw_pass_draw(rig->context, rig->recording, 0, 2 * TRIANGLES, 0, 1);
    rhw_pass_draw(rig->context, rig->recording, 0, 3 * TRIANGLES, 3, 2);
    rig_end(rig);
    uint64_t hash = 0;
    for (int t = 0; t < 7; t++) {
        hash = hash * 31 + rig_hash(rig, t);
    }
    const float *depth = rig_read_depth(rig);
    return rig_hash_bytes(hash, depth, SIZE * SIZE * sizeof *depth);
}

static void test_both_forms_give_the_same_bytes(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    rig_set_depth(&rig);
    for (int t = 1; t < 7; t++) {
        rig_set_target(&rig, t, RHW_FORMAT_RGBA32_FLOAT);
    }
    struct scene scene;
    make_scene(&rig, &scene);
    struct rhw_program *program = &rig.pipeline.program;
    program->varyings[0] = (struct rhw_varying){.components = 3, .derivatives = true};
    program->varyings[1] = (struct rhw_varying){.components = 1, .qualifier = RHW_NOPERSPECTIVE};
    program->varyings[2] = (struct rhw_varying){.components = 2, .qualifier = RHW_FLAT};
    program->varying_count = 3;
    program->uses = RHW_USE_COORD | RHW_USE_FACING | RHW_USE_IDS | RHW_USE_BARYCENTRIC | RHW_USE_DISCARD |
                    RHW_USE_DEPTH | RHW_USE_BARYCENTRIC_DERIVATIVES;
    program->uniform_size = sizeof(struct block);
    uint64_t hashes[4], shaded[4];
    for (int form = 0; form < 4; form++) {
        rig_set_program(&rig, form & 1 ? NULL : wide_vertex, form & 2 ? NULL : wide_fragment);
        program->vertex1 = form & 1 ? narrow_vertex : NULL;
        program->fragment1 = form & 2 ? narrow_fragment : NULL;
        hashes[form] = draw_scene(&rig, &scene);
        shaded[form] = rig.stats.fragments_shaded;
        assert_true(hashes[form] == hashes[0]);
        assert_true(shaded[form] == shaded[0] && shaded[0] > SIZE * SIZE);
    }
    // The 8-lane form goes first where both are there.
    rig_set_program(&rig, wide_vertex, wide_fragment);
    program->vertex1 = NULL;
    program->fragment1 = narrow_fragment;
    assert_true(draw_scene(&rig, &scene) == hashes[0]);
    rhw_texture_destroy(rig.context, scene.texture);
    rhw_sampler_destroy(rig.context, scene.sampler);
    rig_close(&rig);
}

static int lanes_seen, groups_seen, largest_call;

static void counting_vertex(struct rhw_vertex *groups, int count)
{
    rig_vertex_pass(groups, count);
    groups_seen += count;
    lanes_seen = RHW_LANES;
    largest_call = count > largest_call ? count : largest_call;
}

// The pipeline is wide: a strip of many vertices is shaded in far fewer calls than vertices, 8 lanes a group.
static void test_vertices_arrive_in_groups_of_8(void **state)
{
    (void)state;
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = 1;
    struct rig rig;
    rig_open_with(&rig, 16, 16, &def);
    rig_set_program(&rig, counting_vertex, rig_fragment_pass);
    rig.pipeline.topology = RHW_TRIANGLE_STRIP;
    struct rig_vertex strip[1600] = {0};
    rig_draw_once(&rig, strip, 1600);
    assert_int_equal(lanes_seen, 8);
    assert_true(groups_seen >= 200 && groups_seen < 260);
    assert_true(largest_call > 1);
    assert_true(rig.stats.vertices_shaded >= 1600 && rig.stats.vertices_shaded < 2000);
    rig_close(&rig);
}

// Calls with several groups, and groups whose colours do not lie where shader.h says.
static int calls_of_many, misplaced;

static void placing_fragment(struct rhw_fragment *groups, int count)
{
    calls_of_many += count > 1;
    for (int g = 0; g < count; g++) {
        misplaced += groups[g].color != groups->color + g * RHW_MAX_COLOR_ATTACHMENTS;
        memset(groups[g].color[0], 0, sizeof groups[g].color[0]);
    }
}

static void test_colors_lie_side_by_side(void **state)
{
    (void)state;
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = 1;
    struct rig rig;
    rig_open_with(&rig, SIZE, SIZE, &def);
    rig_set_program(&rig, rig_vertex_pass, placing_fragment);
    const float white[4] = {1, 1, 1, 1};
    struct rig_vertex rows[6];
    for (int n = 1; n < 8; n++) {
        rig_rectangle(&rig, 1, 1, (float)(11 * n), (float)(13 * n), 0.5f, white, rows);
        rig_draw_once(&rig, rows, 6);
    }
    assert_true(calls_of_many > 0);
    assert_int_equal(misplaced, 0);
    rig_close(&rig);
}

// What two programs of the same functions differ in.
struct closure {
    float shift, color[4];
};

static void closed_vertex(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const struct closure *closure = groups[g].user;
        for (int c = 0; c < 4; c++) {
            groups[g].position[c] = groups[g].attribute[0][c];
        }
        groups[g].position[0] += closure->shift;
    }
}

static void closed_vertex1(struct rhw_vertex1 *vertex)
{
    const struct closure *closure = vertex->user;
    for (int c = 0; c < 4; c++) {
        vertex->position[c] = vertex->attribute[0][c] + (c == 0 ? closure->shift : 0);
    }
}

static void closed_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const struct closure *closure = groups[g].user;
        for (int c = 0; c < 4; c++) {
            groups[g].color[0][c] = rhw_splat(closure->color[c]);
        }
    }
}

static void closed_fragment1(struct rhw_fragment1 *fragment)
{
    const struct closure *closure = fragment->user;
    memcpy(fragment->color[0], closure->color, sizeof closure->color);
}

// Draws the left half of the target with each closure, in one pass: the second one shifts it to the right half.
static void draw_closures(struct rig *rig, const struct closure closures[2])
{
    struct rig_vertex left[6];
    rig_rectangle(rig, 0, 0, SIZE / 2, SIZE, 0.5f, (const float[4]){0}, left);
    rig_begin(rig);
    for (int i = 0; i < 2; i++) {
        rig->pipeline.program.user = &closures[i];
        rig_draw(rig, left, 6);
    }
    rig_end(rig);
    const float(*const pixels)[4] = rig_read_float4(rig);
    for (int i = 0; i < SIZE * SIZE; i++) {
        assert_memory_equal(pixels[i], closures[i % SIZE >= SIZE / 2].color, sizeof pixels[i]);
    }
}

// Once with a fragment function that receives nothing, which is called once for a draw, and once with one that is
// called for every fragment.
static void test_functions_receive_their_programs_user(void **state)
{
    (void)state;
    const struct closure closures[2] = {{0, {1, 2, 3, 4}}, {1, {5, 6, 7, 8}}};
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    struct rhw_program *const program = &rig.pipeline.program;
    program->varyings[0] = (struct rhw_varying){0};
    program->varying_count = 0;
    program->vertex1 = closed_vertex1;
    program->fragment1 = closed_fragment1;
    for (int form = 0; form < 4; form++) {
        rig_set_program(&rig, form & 1 ? NULL : closed_vertex, form & 2 ? NULL : closed_fragment);
        program->uses = 0;
        draw_closures(&rig, closures);
        program->uses = RHW_USE_COORD;
        draw_closures(&rig, closures);
    }
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_both_forms_give_the_same_bytes),
    cmocka_unit_test(test_vertices_arrive_in_groups_of_8),
    cmocka_unit_test(test_colors_lie_side_by_side),
    cmocka_unit_test(test_functions_receive_their_programs_user),
};

const struct unit_tests test_shader_forms = UNIT_TESTS(tests, NULL, NULL);
