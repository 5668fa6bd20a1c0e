// SPDX-License-Identifier: MIT
// Validation: what a shader function does that its program does not declare, and draws that reach outside their buffers,
// are told, in both shader forms; right programs draw what they always do.
#include "harness.h"

#include <stdio.h>
#include <string.h>

static void open_validated(struct rig *rig, int threads)
{
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = threads;
    def.validate = RHW_VALIDATE_ON;
    rig_open_with(rig, 70, 70, &def);
    rig->pipeline.label = "wrong";
    rig->pass.label = "main";
}

static const float red[4] = {1, 0, 0, 1};

// Fragment functions ----------------------------------------------------------------------------------

// What the fragment functions below do besides painting; both forms.
enum deed {
    NOTHING,
    READ_COORD,
    READ_FACING,
    READ_IDS,
    READ_BARYCENTRIC,
    READ_BARYCENTRIC_DERIVATIVES,
    READ_SAMPLE_ID,
    READ_SAMPLE_POSITION,
    READ_SAMPLE_MASK,
    READ_POINT_COORD,
    READ_FULLY_COVERED,
    READ_DEPTH_INPUT,
    READ_STENCIL_INPUT,
    READ_VIEWPORT_INDEX,
    READ_DEPTH,
    READ_VARYING,
    READ_DDX,
    READ_UNIFORMS,
    DISCARD,
    WRITE_DEPTH,
    LEAVE_ALPHA,
    LEAVE_SOME_LANES,
    WRITE_NO_TARGET,
    SAMPLE_NO_SLOT,
    DIVIDE_BY_ZERO,
    DEEDS
};

static enum deed deed; // of the test under way

static void paint(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *const f = &groups[g];
        const float *const uniforms = f->uniforms;
        rhw_float *const color = f->color[0];
        rhw_float texel[4] = {rhw_splat(0), rhw_splat(0), rhw_splat(0), rhw_splat(0)};
        rhw_float extra = rhw_splat(0);
        switch (deed) {
        case READ_COORD: extra = f->coord[2]; break;
        case READ_FACING: extra = rhw_select(f->front_facing, rhw_splat(1), rhw_splat(0)); break;
        case READ_IDS: extra = __builtin_convertvector(f->primitive, rhw_float); break;
        case READ_BARYCENTRIC: extra = f->barycentric_noperspective[1]; break;
        case READ_BARYCENTRIC_DERIVATIVES: extra = f->barycentric_ddy[2]; break;
        case READ_SAMPLE_ID: extra = rhw_float_from_int(f->sample_id); break;
        case READ_SAMPLE_POSITION: extra = f->sample_position[1]; break;
        case READ_SAMPLE_MASK: extra = rhw_float_from_int(f->sample_mask & 1); break;
        case READ_POINT_COORD: extra = f->point_coord[1]; break;
        case READ_FULLY_COVERED: extra = rhw_float_from_int(f->fully_covered); break;
        case READ_DEPTH_INPUT: extra = f->depth_input; break;
        case READ_STENCIL_INPUT: extra = rhw_float_from_int(f->stencil_input); break;
        case READ_VIEWPORT_INDEX: extra = rhw_float_from_int(f->viewport_index); break;
        case READ_DEPTH: extra = f->depth; break;
        case READ_VARYING: extra = f->varying[4]; break;
        case READ_DDX: extra = f->ddx[3]; break;
        case READ_UNIFORMS: extra = rhw_splat(uniforms[4]); break;
        case DISCARD: f->mask &= rhw_less(f->varying[0], rhw_splat(0)); break;
        case WRITE_DEPTH: f->depth = rhw_splat(0.5f); break;
        case WRITE_NO_TARGET: f->color[1][2] = rhw_splat(1); break;
        case SAMPLE_NO_SLOT: {
            const rhw_float uv[2] = {rhw_splat(0), rhw_splat(0)};
            rhw_sample_lod(f->bindings, 32, uv, rhw_splat(0), texel);
            break;
        }
        case DIVIDE_BY_ZERO: extra = extra / extra; break;
        default: break;
        }
        for (int c = 0; c < (deed == LEAVE_ALPHA ? 3 : 4); c++) {
            const rhw_float value = f->varying[c] + extra + texel[0];
            color[c] = value;
            if (deed == LEAVE_SOME_LANES) {
                color[c] = rhw_select(rhw_less(f->varying[0], value + 1.0f), f->color[1][c], value);
            }
        }
    }
}

static void paint1(struct rhw_fragment1 *f)
{
    float extra = 0;
    float texel[4] = {0};
    switch (deed) {
    case READ_COORD: extra = f->coord[2]; break;
    case READ_FACING: extra = f->front_facing; break;
    case READ_IDS: extra = (float)f->primitive; break;
    case READ_BARYCENTRIC: extra = f->barycentric_noperspective[1]; break;
    case READ_BARYCENTRIC_DERIVATIVES: extra = f->barycentric_ddy[2]; break;
    case READ_SAMPLE_ID: extra = (float)f->sample_id; break;
    case READ_SAMPLE_POSITION: extra = f->sample_position[1]; break;
    case READ_SAMPLE_MASK: extra = (float)(f->sample_mask & 1); break;
    case READ_POINT_COORD: extra = f->point_coord[1]; break;
    case READ_FULLY_COVERED: extra = f->fully_covered; break;
    case READ_DEPTH_INPUT: extra = f->depth_input; break;
    case READ_STENCIL_INPUT: extra = (float)f->stencil_input; break;
    case READ_VIEWPORT_INDEX: extra = (float)f->viewport_index; break;
    case READ_DEPTH: extra = f->depth; break;
    case READ_VARYING: extra = f->varying[4]; break;
    case READ_DDX: extra = f->ddx[3]; break;
    case READ_UNIFORMS: extra = ((const float *)f->uniforms)[4]; break;
    case DISCARD: f->discard = f->varying[0] >= 0; break;
    case WRITE_DEPTH: f->depth = 0.5f; break;
    case WRITE_NO_TARGET: f->color[1][2] = 1; break;
    case SAMPLE_NO_SLOT: {
        const float uv[2] = {0, 0};
        rhw_sample_lod1(f->bindings, 32, uv, 0, texel);
        break;
    }
    case DIVIDE_BY_ZERO: extra = extra / texel[0]; break;
    default: break;
    }
    for (int c = 0; c < (deed == LEAVE_ALPHA ? 3 : 4); c++) {
        f->color[0][c] = deed == LEAVE_SOME_LANES ? f->color[1][c] : f->varying[c] + extra + texel[0];
    }
}

static const struct {
    enum deed deed;
    uint32_t uses;       // with which it is right; 0: with none that fits these passes
    const char *message; // NULL: nothing is wrong
} deeds[] = {
    {NOTHING, 0, NULL},
    {READ_COORD, RHW_USE_COORD, "reads coord; RHW_USE_COORD is missing in its program's uses; at pixel "},
    {READ_FACING, RHW_USE_FACING, "reads front_facing; RHW_USE_FACING is missing in its program's uses"},
    {READ_IDS, RHW_USE_IDS,
     "reads primitive, instance or draw; RHW_USE_IDS is missing in its program's uses"},
    {READ_BARYCENTRIC, RHW_USE_BARYCENTRIC, "reads barycentric weights; RHW_USE_BARYCENTRIC is missing"},
    {READ_BARYCENTRIC_DERIVATIVES, RHW_USE_BARYCENTRIC_DERIVATIVES,
     "reads derivatives of barycentric weights; RHW_USE_BARYCENTRIC_DERIVATIVES is missing"},
    {READ_SAMPLE_ID, RHW_USE_SAMPLE, "reads sample_id or sample_position; RHW_USE_SAMPLE is missing"},
    {READ_SAMPLE_POSITION, RHW_USE_SAMPLE, "reads sample_id or sample_position; RHW_USE_SAMPLE is missing"},
    {READ_SAMPLE_MASK, RHW_USE_SAMPLE_MASK, "reads sample_mask; RHW_USE_SAMPLE_MASK is missing"},
    {READ_POINT_COORD, RHW_USE_POINT_COORD, "reads point_coord; RHW_USE_POINT_COORD is missing"},
    {READ_FULLY_COVERED, 0, "reads fully_covered; RHW_USE_FULLY_COVERED is missing"},
    {READ_DEPTH_INPUT, 0, "reads depth_input; RHW_USE_DEPTH_INPUT is missing"},
    {READ_STENCIL_INPUT, 0, "reads stencil_input; RHW_USE_STENCIL_INPUT is missing"},
    {READ_VIEWPORT_INDEX, RHW_USE_LAYER, "reads layer or viewport_index; RHW_USE_LAYER is missing"},
    {READ_DEPTH, RHW_USE_DEPTH, "reads depth; RHW_USE_DEPTH is missing in its program's uses"},
    {READ_VARYING, 0, "reads a varying behind the last component"},
    {READ_DDX, 0, "reads ddx or ddy of a varying that does not ask for derivatives"},
    {READ_UNIFORMS, 0, "reads uniforms behind uniform_size"},
    {DISCARD, RHW_USE_DISCARD, "discards fragments; RHW_USE_DISCARD is missing in its program's uses"},
    {WRITE_DEPTH, RHW_USE_DEPTH, "writes depth; RHW_USE_DEPTH is missing in its program's uses"},
    {LEAVE_ALPHA, 0, "does not write color[0][3]"},
    {LEAVE_SOME_LANES, 0, "does not write color[0][0]"},
    {SAMPLE_NO_SLOT, 0, "samples slot 32; slots are 0..31"},
};

// Draws two triangles after one that is right, with the deed done.
static enum rhw_result draw_deed(struct rig *rig, bool one_at_a_time, uint32_t uses)
{
    struct rig_vertex all[6];
    rig_cover(rig, 0, red, all);
    rig_begin(rig);
    rig_set_program(rig, rig_vertex_pass, rig_fragment_pass);
    rig->pipeline.program.uses = 0;
    rig->pipeline.program.uniform_size = 0;
    rig_draw(rig, all, 6);
    rhw_pass_push_debug_group(rig->context, rig->recording, "deeds");
    rig_set_program(rig, rig_vertex_pass, one_at_a_time ? NULL : paint);
    rig->pipeline.program.fragment1 = paint1;
    rig->pipeline.program.uses = uses;
    rig->pipeline.program.uniform_size = 16;
    rhw_pass_set_uniforms(rig->context, rig->recording, (const float[5]){0}, 5 * sizeof(float));
    rig_draw(rig, all, 6);
    rhw_pass_pop_debug_group(rig->context, rig->recording);
    const enum rhw_result result = rhw_pass_end(rig->context, rig->recording, &rig->stats);
    return result;
}

static void test_fragment_functions(void **state)
{
    (void)state;
    for (size_t i = 0; i < 2 * sizeof deeds / sizeof deeds[0]; i++) {
        const size_t d = i / 2;
        const bool one_at_a_time = i % 2;
        struct rig rig;
        open_validated(&rig, 2);
        rig_set_depth(&rig);
        rig.pipeline.depth_compare = RHW_COMPARE_LESS_EQUAL;
        deed = deeds[d].deed;
        if (deeds[d].message == NULL) {
            assert_int_equal(draw_deed(&rig, one_at_a_time, 0), RHW_OK);
            rig_close(&rig);
            continue;
        }
        assert_int_equal(draw_deed(&rig, one_at_a_time, 0), RHW_ERROR_MISUSE);
        rig_expect_misuse(&rig, deeds[d].message);
        assert_non_null(strstr(rig.message, "\"wrong\""));
        assert_non_null(strstr(rig.message, "[draw 1 in deeds of pass \"main\"]"));
        if (deeds[d].uses != 0) { // declared, it is right
            assert_int_equal(draw_deed(&rig, one_at_a_time, deeds[d].uses), RHW_OK);
        }
        rig_close(&rig);
    }
}

// Alpha that is not kept, and that colours are blended by all the same.
static void test_blending_reads_alpha(void **state)
{
    (void)state;
    for (int blends = 0; blends < 3; blends++) { // by nothing, by the source's factor, by the target's
        struct rig rig;
        open_validated(&rig, 1);
        rig.pipeline.targets[0].write_mask = RHW_WRITE_RED | RHW_WRITE_GREEN | RHW_WRITE_BLUE;
        rig.pipeline.targets[0].blend = true;
        rig.pipeline.targets[0].color.src = blends == 1 ? RHW_BLEND_SRC_ALPHA : RHW_BLEND_ONE;
        rig.pipeline.targets[0].color.dst = blends == 2 ? RHW_BLEND_ONE_MINUS_SRC_ALPHA : RHW_BLEND_ONE;
        deed = LEAVE_ALPHA;
        assert_int_equal(draw_deed(&rig, false, 0), blends ? RHW_ERROR_MISUSE : RHW_OK);
        if (blends) {
            rig_expect_misuse(&rig, "does not write color[0][3]");
        }
        rig_close(&rig);
    }
}

// Without validation the same functions pass in silence, as they do to the speed of everybody's programs.
static void test_nothing_is_told_without(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 70, 70);
    deed = READ_COORD;
    assert_int_equal(draw_deed(&rig, false, 0), RHW_OK);
    deed = SAMPLE_NO_SLOT; // which is safe all the same
    assert_int_equal(draw_deed(&rig, false, 0), RHW_OK);
    assert_true(rig_read_float4(&rig)[0][0] == 1);
    rig_close(&rig);
}

static char logged[512];

static void keep_log(void *user, enum rhw_log_level level, const char *message)
{
    (void)user;
    if (level == RHW_LOG_WARNING) {
        snprintf(logged, sizeof logged, "%s", message);
    }
}

// What may be meant is drawn, and told in the log.
static void test_warnings(void **state)
{
    (void)state;
    const struct {
        enum deed deed;
        const char *message;
    } warned[] = {
        {DIVIDE_BY_ZERO, "gives NaN in color[0][0]; at pixel 0, 0 [draw 1 in deeds of pass \"main\"]"},
        {WRITE_NO_TARGET, "has no such target in its pipeline and writes color[1][2]; at pixel 0, 0"}};
    for (size_t i = 0; i < sizeof warned / sizeof warned[0]; i++) {
        struct rhw_context_def def = rhw_context_def_default();
        def.threads = 1;
        def.validate = RHW_VALIDATE_ON;
        def.log = keep_log;
        struct rig rig;
        rig_open_with(&rig, 8, 8, &def);
        rig.pass.label = "main";
        logged[0] = 0;
        deed = warned[i].deed;
        assert_int_equal(draw_deed(&rig, false, 0), RHW_OK);
        assert_non_null(strstr(logged, warned[i].message));
        rig_close(&rig);
    }
}

// A pipeline whose attributes end behind their stride is made, and told in the log.
static void test_a_short_stride_is_warned_of(void **state)
{
    (void)state;
    struct rhw_context_def def = rhw_context_def_default();
    def.validate = RHW_VALIDATE_ON;
    def.log = keep_log;
    struct rig rig;
    rig_open_with(&rig, 8, 8, &def);
    for (uint32_t stride = 31; stride <= 32; stride++) {
        rig.pipeline.buffers[0].stride = stride;
        logged[0] = 0;
        rhw_pipeline pipeline;
        assert_int_equal(rhw_pipeline_create(rig.context, &rig.pipeline, &pipeline), RHW_OK);
        assert_string_equal(logged, stride == 32
                                        ? ""
                                        : "rhw_pipeline_create: attributes[1] ends at byte 32 of its "
                                          "element and buffers[0].stride is 31");
        rhw_pipeline_destroy(rig.context, pipeline);
    }
    rig_close(&rig);
}

// Depth that a zeroed definition clears to 1 lets nothing greater pass.
static void test_greater_than_default_depth(void **state)
{
    (void)state;
    struct rig rig;
    open_validated(&rig, 1);
    rig.pass.depth = (struct rhw_depth_attachment){.enabled = true, .store = RHW_STORE_DISCARD};
    rig.pipeline.depth_test = true;
    rig.pipeline.depth_compare = RHW_COMPARE_GREATER;
    struct rig_vertex corners[6];
    rig_cover(&rig, 0.5f, red, corners);
    rig_draw_once(&rig, corners, 6);
    rig_expect_misuse(&rig, "rhw_pass_draw: the first draw asks for greater depth");
    rig_close(&rig);
}

// Vertex functions ------------------------------------------------------------------------------------

enum {
    LEAVE_W = DEEDS,
    LEAVE_VARYING,
    LEAVE_SOME_POSITIONS,
    LEAVE_SOME_VARYINGS,
    WRITE_FAR_VARYING,
    READ_ATTRIBUTE,
    MOVE_BY_ATTRIBUTE,
    CLIP_BY_ATTRIBUTE,
    CULL_BY_ATTRIBUTE,
    READ_FAR_UNIFORMS,
    SAMPLE_FROM_VERTEX
};

static int vertex_deed;

static void place(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *const v = &groups[g];
        const rhw_float before = v->position[2], varied = v->varying[3];
        rhw_float extra = rhw_splat(0), texel[4];
        if (vertex_deed == READ_ATTRIBUTE) {
            extra = v->attribute[2][1];
        } else if (vertex_deed == CLIP_BY_ATTRIBUTE) {
            v->clip_distance[0] = v->attribute[2][1];
        } else if (vertex_deed == CULL_BY_ATTRIBUTE) {
            v->cull_distance[0] = v->attribute[2][1];
        } else if (vertex_deed == READ_FAR_UNIFORMS) {
            extra = rhw_splat(((const float *)v->uniforms)[2]);
        } else if (vertex_deed == SAMPLE_FROM_VERTEX) {
            const rhw_float uv[2] = {rhw_splat(0), rhw_splat(0)};
            rhw_sample_lod(v->bindings, -1, uv, rhw_splat(0), texel);
        } else if (vertex_deed == WRITE_FAR_VARYING) {
            v->varying[4] = extra;
        }
        for (int c = 0; c < 4; c++) {
            if (c < 3 || vertex_deed != LEAVE_W) {
                v->position[c] = v->attribute[0][c] + extra;
            }
            if (c != 1 || vertex_deed != LEAVE_VARYING) {
                v->varying[c] = v->attribute[1][c];
            }
        }
        if (vertex_deed == MOVE_BY_ATTRIBUTE) {
            v->position[0] = v->attribute[2][1];
        }
        if (vertex_deed == LEAVE_SOME_POSITIONS) {
            v->position[2] = rhw_select(rhw_less_int(rhw_lane_numbers(), 3), v->position[2], before);
        } else if (vertex_deed == LEAVE_SOME_VARYINGS) {
            v->varying[3] = rhw_select(rhw_less_int(rhw_lane_numbers(), 3), v->varying[3], varied);
        }
    }
}

static void place1(struct rhw_vertex1 *v)
{
    const float before = v->position[2], varied = v->varying[3];
    const bool leaves = v->vertex_index % 2 != 0;
    float extra = 0, texel[4];
    if (vertex_deed == READ_ATTRIBUTE) {
        extra = v->attribute[2][1];
    } else if (vertex_deed == CLIP_BY_ATTRIBUTE) {
        v->clip_distance[0] = v->attribute[2][1];
    } else if (vertex_deed == CULL_BY_ATTRIBUTE) {
        v->cull_distance[0] = v->attribute[2][1];
    } else if (vertex_deed == READ_FAR_UNIFORMS) {
        extra = ((const float *)v->uniforms)[2];
    } else if (vertex_deed == SAMPLE_FROM_VERTEX) {
        rhw_sample_lod1(v->bindings, -1, (const float[2]){0, 0}, 0, texel);
    } else if (vertex_deed == WRITE_FAR_VARYING) {
        v->varying[4] = extra;
    }
    for (int c = 0; c < 4; c++) {
        if (c < 3 || vertex_deed != LEAVE_W) {
            v->position[c] = v->attribute[0][c] + extra;
        }
        if (c != 1 || vertex_deed != LEAVE_VARYING) {
            v->varying[c] = v->attribute[1][c];
        }
    }
    if (vertex_deed == MOVE_BY_ATTRIBUTE) {
        v->position[0] = v->attribute[2][1];
    }
    if (vertex_deed == LEAVE_SOME_POSITIONS && leaves) {
        v->position[2] = before;
    } else if (vertex_deed == LEAVE_SOME_VARYINGS && leaves) {
        v->varying[3] = varied;
    }
}

static void test_vertex_functions(void **state)
{
    (void)state;
    const struct {
        int deed;
        const char *message;
    } wrong[] = {
        {LEAVE_W,
         "the vertex function of pipeline 1 \"wrong\" does not write position[3] [draw 0 of pass \"main\"]"},
        {LEAVE_VARYING, "does not write varying[1]; its program has 4 components"},
        {LEAVE_SOME_POSITIONS, "does not write position[2] in every lane"},
        {LEAVE_SOME_VARYINGS, "does not write varying[3] in every lane"},
        {WRITE_FAR_VARYING, "writes varying[4]; its program has 4 components"},
        {READ_ATTRIBUTE, "reads an attribute behind the last; the pipeline has 2"},
        {MOVE_BY_ATTRIBUTE, "reads an attribute behind the last; the pipeline has 2"},
        {CLIP_BY_ATTRIBUTE, "reads an attribute behind the last; the pipeline has 2"},
        {CULL_BY_ATTRIBUTE, "reads an attribute behind the last; the pipeline has 2"},
        {READ_FAR_UNIFORMS, "reads uniforms behind uniform_size, which is 8"},
        {SAMPLE_FROM_VERTEX, "samples slot -1; slots are 0..31"},
    };
    for (size_t i = 0; i < 2 * sizeof wrong / sizeof wrong[0]; i++) {
        struct rig rig;
        open_validated(&rig, 2);
        vertex_deed = wrong[i / 2].deed;
        rig_set_program(&rig, i % 2 ? NULL : place, rig_fragment_pass);
        rig.pipeline.program.vertex1 = place1;
        rig.pipeline.program.uniform_size = 8;
        rig.pipeline.program.clip_distance_count = vertex_deed == CLIP_BY_ATTRIBUTE;
        rig.pipeline.program.cull_distance_count = vertex_deed == CULL_BY_ATTRIBUTE;
        struct rig_vertex all[6];
        rig_cover(&rig, 0, red, all);
        rig_begin(&rig);
        rhw_pass_set_uniforms(rig.context, rig.recording, (const float[2]){0}, 8);
        rig_draw(&rig, all, 6);
        assert_int_equal(rhw_pass_end(rig.context, rig.recording, NULL), RHW_ERROR_MISUSE);
        rig_expect_misuse(&rig, wrong[i / 2].message);
        rig_close(&rig);
    }
}

// Draws -----------------------------------------------------------------------------------------------

static void test_draws_stay_within_their_buffers(void **state)
{
    (void)state;
    struct rig rig;
    open_validated(&rig, 1);
    rig.pipeline.attributes[1].buffer = 1;
    rig.pipeline.attributes[1].offset = 0;
    rig.pipeline.buffers[1] = (struct rhw_vertex_layout){.stride = 16, .per_instance = true};
    rig.pipeline.buffer_count = 2;
    struct rig_vertex all[6];
    rig_cover(&rig, 0, red, all);
    const uint16_t indices[7] = {0, 1, 2, 3, 4, 5, 6};
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rig_use_vertices(&rig, 0, all, sizeof all);
    rig_use_vertices(&rig, 1, red, sizeof red);
    rig_use_indices(&rig, RHW_INDEX_UINT16, indices, sizeof indices);
    rhw_context *const context = rig.context;
    const rhw_pass pass = rig.recording;
    rhw_pass_draw(context, pass, 0, 6, 0, 1);
    rhw_pass_draw(context, pass, 3, 0, 9, 1); // nothing reads nothing
    rhw_pass_draw(context, pass, 9, 3, 0, 0);
    rhw_pass_draw_indexed(context, pass, 0, 6, 0, 0, 1);
    rhw_pass_draw_indexed(context, pass, 4, 3, -1, 0, 1);
    assert_int_equal(rig.misuses, 0);
    rhw_pass_draw(context, pass, 1, 6, 0, 1);
    rig_expect_misuse(
        &rig, "rhw_pass_draw: it reads vertices 1 to 6; attribute 0 has 6 in buffer 1, slot 0 [draw 5");
    rhw_pass_draw(context, pass, 0, 6, 0, 2);
    rig_expect_misuse(&rig, "it reads instances 0 to 1; attribute 1 has 1 in buffer 2, slot 1");
    rig.pipeline.buffers[1].instance_step = 3;
    rig_use_pipeline(&rig);
    rhw_pass_draw(context, pass, 0, 6, 0, 3);
    assert_int_equal(rig.misuses, 0);
    rhw_pass_draw(context, pass, 0, 6, 0, 4);
    rig_expect_misuse(&rig, "it reads instances 0 to 1; attribute 1 has 1 in buffer 2, slot 1");
    rhw_pass_draw_indexed(context, pass, 2, 6, 0, 0, 1);
    rig_expect_misuse(&rig,
                      "rhw_pass_draw_indexed: first is 2 and count is 6; the index buffer has 7 indices");
    rhw_pass_draw_indexed(context, pass, 0, 7, 0, 0, 1);
    rig_expect_misuse(&rig, "it reads vertices 0 to 6; attribute 0 has 6");
    rhw_pass_draw_indexed(context, pass, 0, 3, -1, 0, 1);
    rig_expect_misuse(&rig, "it reads vertices -1 to 1; attribute 0 has 6");
    rhw_pass_set_index_buffer(context, pass, rig.objects.buffers[2], RHW_INDEX_UINT16, 1);
    rhw_pass_draw_indexed(context, pass, 0, 3, 0, 0, 1);
    rig_expect_misuse(
        &rig, "the index buffer was set with offset 1; it must be a multiple of the 2 bytes of an index");
    rig_end(&rig);
    rig_close(&rig);
}

static void test_constants_are_there(void **state)
{
    (void)state;
    struct rig rig;
    open_validated(&rig, 1);
    rig.pipeline.attributes[1].buffer = 1;
    rig.pipeline.attributes[1].offset = 0;
    rig.pipeline.buffers[1] = (struct rhw_vertex_layout){.constant = true};
    rig.pipeline.buffer_count = 2;
    struct rig_vertex all[6];
    rig_cover(&rig, 0, red, all);
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rig_use_vertices(&rig, 0, all, sizeof all);
    rig_use_vertices(&rig, 1, red, sizeof red);
    rhw_pass_draw(rig.context, rig.recording, 0, 6, 0, 1);
    assert_int_equal(rig.misuses, 0);
    rhw_pass_set_vertex_buffer(rig.context, rig.recording, 1, rig.objects.buffers[1], 4);
    rhw_pass_draw(rig.context, rig.recording, 0, 6, 0, 1);
    rig_expect_misuse(&rig,
                      "rhw_pass_draw: attribute 1, which is constant, ends behind buffer 2, slot 1 [draw 1");
    rig_end(&rig);
    rig_close(&rig);
}

// The index that restarts a strip names no vertex.
static void test_restarts_name_no_vertex(void **state)
{
    (void)state;
    struct rig rig;
    open_validated(&rig, 1);
    rig.pipeline.topology = RHW_TRIANGLE_STRIP;
    rig.pipeline.primitive_restart = true;
    struct rig_vertex all[6];
    rig_cover(&rig, 0, red, all);
    const uint8_t indices[7] = {0, 1, 2, 255, 3, 4, 5};
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rig_use_vertices(&rig, 0, all, sizeof all);
    rig_use_indices(&rig, RHW_INDEX_UINT8, indices, sizeof indices);
    rhw_pass_draw_indexed(rig.context, rig.recording, 0, 7, 0, 0, 1);
    rig_end(&rig);
    assert_true(rig_read_float4(&rig)[0][0] == 1);
    rig_close(&rig);
}

static void test_nan_clears(void **state)
{
    (void)state;
    struct rig rig;
    open_validated(&rig, 1);
    rig.pass.colors[0].clear[2] = rhw_nan()[0];
    rhw_pass pass;
    assert_int_equal(rhw_pass_begin(rig.context, &rig.pass, &pass), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "colors[0].clear[2] is NaN");
    rig_close(&rig);
}

// With or without validation: colours that nobody computes.
static void test_a_missing_fragment_function(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    rig.pipeline.program.fragment[0] = NULL;
    rhw_pipeline pipeline;
    assert_int_equal(rhw_pipeline_create(rig.context, &rig.pipeline, &pipeline), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "the program has no fragment function and targets[0] is written");
    rig.pipeline.targets[0].write_mask = RHW_WRITE_NONE;
    assert_int_equal(rhw_pipeline_create(rig.context, &rig.pipeline, &pipeline), RHW_OK);
    rig_close(&rig);
}

// What the definition leaves open follows the file that creates the context.
static void test_the_default(void **state)
{
    (void)state;
    const struct {
        bool debug;
        enum rhw_validation validate;
        bool validates;
    } cases[] = {{false, RHW_VALIDATE_DEFAULT, false},
                 {true, RHW_VALIDATE_DEFAULT, true},
                 {true, RHW_VALIDATE_OFF, false},
                 {false, RHW_VALIDATE_ON, true},
                 {false, RHW_VALIDATE_OFF, false}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct rig rig;
        rig_open(&rig, 8, 8);
        struct rhw_context_def def = rhw_context_def_default();
        def.threads = 1;
        def.validate = cases[i].validate;
        def.assert_ = rig_misuse;
        def.user = &rig;
        rhw_context *context;
        assert_int_equal(rhw_context_create_probed(&def, cases[i].debug, &context), RHW_OK);
        const struct rhw_texture_def texture_def = {.format = RHW_FORMAT_R32_FLOAT, .width = 1, .height = 1};
        struct rhw_pass_def pass_def = {.color_count = 1, .colors = {{.clear = {rhw_nan()[0]}}}};
        assert_int_equal(rhw_texture_create(context, &texture_def, &pass_def.colors[0].texture), RHW_OK);
        rhw_pass pass;
        const enum rhw_result result = rhw_pass_begin(context, &pass_def, &pass);
        assert_int_equal(result, cases[i].validates ? RHW_ERROR_MISUSE : RHW_OK);
        if (result == RHW_OK) {
            assert_int_equal(rhw_pass_end(context, pass, NULL), RHW_OK);
        }
        rhw_context_destroy(context);
        rig.misuses = 0;
        rig_close(&rig);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_fragment_functions),
    cmocka_unit_test(test_blending_reads_alpha),
    cmocka_unit_test(test_nothing_is_told_without),
    cmocka_unit_test(test_greater_than_default_depth),
    cmocka_unit_test(test_warnings),
    cmocka_unit_test(test_a_short_stride_is_warned_of),
    cmocka_unit_test(test_vertex_functions),
    cmocka_unit_test(test_draws_stay_within_their_buffers),
    cmocka_unit_test(test_constants_are_there),
    cmocka_unit_test(test_restarts_name_no_vertex),
    cmocka_unit_test(test_nan_clears),
    cmocka_unit_test(test_a_missing_fragment_function),
    cmocka_unit_test(test_the_default),
};

const struct unit_tests test_validation = UNIT_TESTS(tests, NULL, NULL);
