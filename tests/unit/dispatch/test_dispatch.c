// SPDX-License-Identifier: MIT
// Dispatches: which invocations run, what they share and reach, in which order, and what is told of misuse.
#include "harness.h"
#include "patience.h"

#include "base/thread.h"

#include <stdlib.h>
#include <string.h>

static void open_rig(struct rig *rig, int threads)
{
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = threads;
    rig_open_with(rig, 16, 16, &def);
}

static rhw_buffer make_buffer(struct rig *rig, const void *data, size_t size)
{
    rhw_buffer buffer;
    const struct rhw_buffer_def def = {.size = size, .data = data, .label = "words"};
    assert_int_equal(rhw_buffer_create(rig->context, &def, &buffer), RHW_OK);
    return buffer;
}

static void read_buffer(struct rig *rig, rhw_buffer buffer, void *data, size_t size)
{
    assert_int_equal(rhw_buffer_read(rig->context, buffer, 0, data, size), RHW_OK);
}

static rhw_texture make_texture(struct rig *rig, enum rhw_format format, int width, int height)
{
    struct rhw_texture_def def = rhw_texture_def_default();
    rhw_texture texture;
    def.format = format;
    def.width = width;
    def.height = height;
    assert_int_equal(rhw_texture_create(rig->context, &def, &texture), RHW_OK);
    return texture;
}

// Invocations ------------------------------------------------------------------------------------------

enum { GRID_X = 3, GRID_Y = 4, GRID_Z = 2, SIZE_X = 5, SIZE_Y = 3, SIZE_Z = 2, WORDS = 8 };
enum { ALL = GRID_X * GRID_Y * GRID_Z * SIZE_X * SIZE_Y * SIZE_Z };

// Return the number of an invocation in the grid.
static int32_t number_of(const int32_t id[3])
{
    return id[0] + GRID_X * SIZE_X * (id[1] + GRID_Y * SIZE_Y * id[2]);
}

static void tell_place(struct rhw_workgroup *w)
{
    for (int g = 0; g < w->count; g++) {
        const struct rhw_invocations *const i = &w->groups[g];
        const rhw_int at =
            (i->id[0] + GRID_X * SIZE_X * (i->id[1] + GRID_Y * SIZE_Y * i->id[2])) * (int32_t)WORDS;
        rhw_storage_atomic(w->bindings, 0, RHW_STORAGE_ADD, at, rhw_splat_int(1), i->mask);
        rhw_storage_store(w->bindings, 0, at + 1, i->index, i->mask);
        for (int c = 0; c < 3; c++) {
            const rhw_int place = i->local[c] + 100 * w->id[c] + 10000 * w->counts[c] + 100000 * w->size[c];
            rhw_storage_store(w->bindings, 0, at + 2 + c, place, i->mask);
        }
    }
}

static bool tell_place1(struct rhw_invocation1 *i)
{
    const uint32_t at = (uint32_t)number_of(i->id) * WORDS;
    rhw_storage_atomic1(i->bindings, 0, RHW_STORAGE_ADD, at, 1);
    rhw_storage_store1(i->bindings, 0, at + 1, i->index);
    for (uint32_t c = 0; c < 3; c++) {
        rhw_storage_store1(i->bindings, 0, at + 2 + c,
                           i->local[c] + 100 * i->workgroup[c] + 10000 * i->counts[c] + 100000 * i->size[c]);
    }
    return false;
}

static void check_places(int threads, bool one, const int base[3])
{
    static int32_t words[ALL * WORDS];
    static const int size[3] = {SIZE_X, SIZE_Y, SIZE_Z};
    struct rig rig;
    open_rig(&rig, threads);
    const rhw_buffer buffer = make_buffer(&rig, NULL, sizeof words);
    struct rhw_dispatch_def def = {.program = {.size = {SIZE_X, SIZE_Y, SIZE_Z}},
                                   .buffers = {{.buffer = buffer}},
                                   .base = {(uint32_t)base[0], (uint32_t)base[1], (uint32_t)base[2]}};
    const int count[3] = {GRID_X - base[0], GRID_Y - base[1], GRID_Z - base[2]};
    if (one) {
        def.program.invocation1 = tell_place1;
    } else {
        def.program.workgroup[RHW_ISA_BASELINE] = tell_place;
    }
    assert_int_equal(
        rhw_dispatch(rig.context, &def, (uint32_t)count[0], (uint32_t)count[1], (uint32_t)count[2]), RHW_OK);
    read_buffer(&rig, buffer, words, sizeof words);
    for (int32_t z = 0; z < GRID_Z * SIZE_Z; z++) {
        for (int32_t y = 0; y < GRID_Y * SIZE_Y; y++) {
            for (int32_t x = 0; x < GRID_X * SIZE_X; x++) {
                const int32_t id[3] = {x, y, z};
                const int32_t *const told = &words[number_of(id) * WORDS];
                const bool runs = x >= base[0] * SIZE_X && y >= base[1] * SIZE_Y && z >= base[2] * SIZE_Z;
                assert_int_equal(told[0], runs);
                if (!runs) {
                    continue;
                }
                assert_int_equal(told[1], x % SIZE_X + SIZE_X * (y % SIZE_Y + SIZE_Y * (z % SIZE_Z)));
                for (int c = 0; c < 3; c++) {
                    assert_int_equal(told[2 + c], id[c] % size[c] + 100 * (id[c] / size[c]) +
                                                      10000 * count[c] + 100000 * size[c]);
                }
            }
        }
    }
    rig_close(&rig);
}

static void test_every_invocation_runs_once(void **state)
{
    (void)state;
    static const int zero[3] = {0, 0, 0}, base[3] = {1, 2, 1};
    for (int threads = 1; threads <= 4; threads += 3) {
        check_places(threads, false, zero);
        check_places(threads, true, zero);
        check_places(threads, false, base);
        check_places(threads, true, base);
    }
}

// Shared memory and barriers ---------------------------------------------------------------------------

enum { SCAN = 200, SCAN_GROUPS = (SCAN + RHW_LANES - 1) / RHW_LANES, SCANS = 40 };

// Add up the words of a workgroup by Hillis and Steele: in each step, all are read before one is written.
static void scan(struct rhw_workgroup *w)
{
    int32_t *const sums = w->shared;
    rhw_int added[SCAN_GROUPS];
    assert_int_equal(sums[SCAN - 1], 0); // the last workgroup of this thread wrote it
    for (int g = 0; g < w->count; g++) {
        const rhw_int value = rhw_storage_load(w->bindings, 0, w->groups[g].id[0], w->groups[g].mask);
        rhw_store_int(&sums[g * RHW_LANES], value);
    }
    for (int reach = 1; reach < SCAN; reach *= 2) {
        for (int g = 0; g < w->count; g++) {
            added[g] = rhw_gather_int(sums, SCAN, w->groups[g].index - reach);
        }
        for (int g = 0; g < w->count; g++) {
            rhw_store_int(&sums[g * RHW_LANES], rhw_load_int(&sums[g * RHW_LANES]) + added[g]);
        }
    }
    for (int g = 0; g < w->count; g++) {
        rhw_storage_store(w->bindings, 1, w->groups[g].id[0], rhw_load_int(&sums[g * RHW_LANES]),
                          w->groups[g].mask);
    }
}

// The one-at-a-time form keeps what it read in its own memory, behind a barrier. Odd steps read and even ones write.
static bool scan1(struct rhw_invocation1 *i)
{
    int32_t *const sums = i->shared, *const read = i->memory;
    const int32_t turn = i->step / 2, reach = turn < 30 ? 1 << turn : 0;
    if (i->step == 0) {
        assert_int_equal(*read, 0);
        assert_int_equal((uintptr_t)i->memory % 16, 0);
        sums[i->index] = rhw_storage_load1(i->bindings, 0, (uint32_t)i->id[0]);
    } else if (i->step % 2 == 0) {
        sums[i->index] += *read;
    }
    if (i->step % 2 == 0 && reach >= SCAN) {
        rhw_storage_store1(i->bindings, 1, (uint32_t)i->id[0], sums[i->index]);
        return false;
    }
    if (i->step % 2 == 1) {
        *read = i->index >= reach ? sums[i->index - reach] : 0;
    }
    return true;
}

static void check_scan(int threads, bool one)
{
    static int32_t words[SCAN * SCANS], sums[SCAN * SCANS];
    uint64_t random = 7;
    for (int i = 0; i < SCAN * SCANS; i++) {
        words[i] = rig_random_int(&random, 1000) + 1;
    }
    struct rig rig;
    open_rig(&rig, threads);
    const rhw_buffer in = make_buffer(&rig, words, sizeof words), out = make_buffer(&rig, NULL, sizeof sums);
    const struct rhw_dispatch_def def = {
        .program = {.workgroup = {one ? NULL : scan},
                    .invocation1 = one ? scan1 : NULL,
                    .size = {SCAN},
                    .shared_size = (SCAN_GROUPS * RHW_LANES) * sizeof(int32_t),
                    .invocation_size = sizeof(int32_t)},
        .buffers = {{.buffer = in, .read_only = true}, {.buffer = out}}};
    assert_int_equal(rhw_dispatch(rig.context, &def, SCANS, 1, 1), RHW_OK);
    read_buffer(&rig, out, sums, sizeof sums);
    int32_t sum = 0;
    for (int i = 0; i < SCAN * SCANS; i++) {
        sum = (i % SCAN == 0 ? 0 : sum) + words[i];
        assert_int_equal(sums[i], sum);
    }
    rig_close(&rig);
}

static void test_barriers(void **state)
{
    (void)state;
    for (int threads = 1; threads <= 4; threads += 3) {
        check_scan(threads, false);
        check_scan(threads, true);
    }
}

// An invocation that is done is not called again while others stand at barriers.
static bool leave_one_by_one(struct rhw_invocation1 *i)
{
    rhw_storage_atomic1(i->bindings, 0, RHW_STORAGE_ADD, (uint32_t)i->index, 1);
    return i->step < i->index;
}

static void test_invocations_that_are_done(void **state)
{
    (void)state;
    int32_t words[20];
    struct rig rig;
    open_rig(&rig, 1);
    const rhw_buffer buffer = make_buffer(&rig, NULL, sizeof words);
    const struct rhw_dispatch_def def = {.program = {.invocation1 = leave_one_by_one, .size = {20}},
                                         .buffers = {{.buffer = buffer}}};
    assert_int_equal(rhw_dispatch(rig.context, &def, 1, 1, 1), RHW_OK);
    read_buffer(&rig, buffer, words, sizeof words);
    for (int i = 0; i < 20; i++) {
        assert_int_equal(words[i], i + 1);
    }
    rig_close(&rig);
}

static void touch_limits(struct rhw_workgroup *w)
{
    unsigned char *const shared = w->shared;
    assert_int_equal(w->count, RHW_MAX_WORKGROUP_GROUPS);
    assert_int_equal((uintptr_t)shared % 64, 0);
    assert_int_equal(shared[0] | shared[RHW_MAX_SHARED_SIZE - 1], 0);
    memset(shared, 255, RHW_MAX_SHARED_SIZE);
    rhw_storage_atomic1(w->bindings, 0, RHW_STORAGE_ADD, 0, w->id[0] == RHW_MAX_WORKGROUP_COUNT - 1);
}

static void add_user(struct rhw_workgroup *w)
{
    const int32_t *const uniform = w->uniforms, *const user = w->user;
    rhw_storage_atomic1(w->bindings, 0, RHW_STORAGE_ADD, 0, *uniform + *user);
}

static void test_limits(void **state)
{
    (void)state;
    static const int32_t user = 100, uniform = 1;
    int32_t word;
    struct rig rig;
    open_rig(&rig, 2);
    const rhw_buffer buffer = make_buffer(&rig, NULL, sizeof word);
    struct rhw_dispatch_def def = {
        .program = {.workgroup = {touch_limits}, .size = {4, 4, 64}, .shared_size = RHW_MAX_SHARED_SIZE},
        .buffers = {{.buffer = buffer}}};
    assert_int_equal(rhw_dispatch(rig.context, &def, 20, 1, 2), RHW_OK);
    def.program =
        (struct rhw_compute_program){.workgroup = {add_user}, .user = &user, .uniform_size = sizeof uniform};
    def.uniforms = &uniform;
    def.uniform_bytes = sizeof uniform;
    assert_int_equal(rhw_dispatch(rig.context, &def, RHW_MAX_WORKGROUP_COUNT, 1, 1), RHW_OK);
    assert_int_equal(rhw_dispatch(rig.context, &def, 1, RHW_MAX_WORKGROUP_COUNT, 1), RHW_OK);
    assert_int_equal(rhw_dispatch(rig.context, &def, 1, 1, RHW_MAX_WORKGROUP_COUNT), RHW_OK);
    assert_int_equal(rhw_dispatch(rig.context, &def, 0, 1, RHW_MAX_WORKGROUP_COUNT), RHW_OK);
    read_buffer(&rig, buffer, &word, sizeof word);
    assert_int_equal(word, 3 * RHW_MAX_WORKGROUP_COUNT * 101);
    rig_close(&rig);
}

// What a dispatch reaches ------------------------------------------------------------------------------

enum { SIDE = 16 };

// Sample a texture, load a texel buffer, and store their sum into an image and into another texel buffer.
static void reach(struct rhw_workgroup *w)
{
    for (int g = 0; g < w->count; g++) {
        const struct rhw_invocations *const i = &w->groups[g];
        const rhw_float at[2] = {(rhw_float_from_int(i->id[0]) + 0.5f) / (float)SIDE,
                                 (rhw_float_from_int(i->id[1]) + 0.5f) / (float)SIDE};
        const rhw_int row = i->id[1] * SIDE + i->id[0];
        rhw_float texel[4], other[4];
        rhw_sample_lod(w->bindings, 3, at, rhw_splat(0), texel);
        rhw_image_load(w->bindings, 1, &row, other);
        for (int c = 0; c < 4; c++) {
            texel[c] += other[c];
        }
        rhw_image_store(w->bindings, 0, i->id, &i->mask, texel);
        rhw_image_store(w->bindings, 2, &row, &i->mask, texel);
    }
}

// A pass draws what a dispatch samples, and another pass samples what the dispatch stored.
static void test_between_passes(void **state)
{
    (void)state;
    static const float value[4] = {0.25f, 0.5f, 0.75f, 1};
    static float texels[SIDE * SIDE][4], sums[SIDE * SIDE][4];
    struct rig rig;
    struct rig_vertex vertices[6];
    rhw_sampler sampler;
    const struct rhw_sampler_def nearest = {.min_filter = RHW_FILTER_NEAREST,
                                            .mag_filter = RHW_FILTER_NEAREST};
    for (int i = 0; i < SIDE * SIDE; i++) {
        texels[i][1] = (float)i;
    }
    open_rig(&rig, 2);
    assert_int_equal(rhw_sampler_create(rig.context, &nearest, &sampler), RHW_OK);
    rig_cover(&rig, 0.5f, value, vertices);
    rig_draw_once(&rig, vertices, 6);
    const rhw_texture image = make_texture(&rig, RHW_FORMAT_RGBA32_FLOAT, SIDE, SIDE);
    const rhw_buffer in = make_buffer(&rig, texels, sizeof texels),
                     out = make_buffer(&rig, NULL, sizeof sums);
    const struct rhw_dispatch_def def = {
        .program = {.workgroup = {reach}, .size = {8, 4}},
        .textures = {[3] = {rig.pass.colors[0].texture, sampler}},
        .images = {{.texture = image},
                   {.buffer = in, .format = RHW_FORMAT_RGBA32_FLOAT, .read_only = true},
                   {.buffer = out, .format = RHW_FORMAT_RGBA32_FLOAT}}};
    assert_int_equal(rhw_dispatch(rig.context, &def, SIDE / 8, SIDE / 4, 1), RHW_OK);
    read_buffer(&rig, out, sums, sizeof sums);
    for (int i = 0; i < SIDE * SIDE; i++) {
        for (int c = 0; c < 4; c++) {
            assert_true(sums[i][c] == value[c] + texels[i][c]);
        }
    }
    assert_memory_equal(rig_read(&rig, image), sums, sizeof sums);
    rig_cover(&rig, 0.5f, (const float[4]){0}, vertices);
    rig_draw_once(&rig, vertices, 6); // the texture is an attachment again
    assert_int_equal(rhw_dispatch(rig.context, &def, SIDE / 8, SIDE / 4, 1), RHW_OK);
    read_buffer(&rig, out, sums, sizeof sums);
    assert_memory_equal(sums, texels, sizeof sums);
    rig_close(&rig);
}

// Indirect ---------------------------------------------------------------------------------------------

// Write the numbers of the next dispatch into the buffer that has those of this one.
static void plan_next(struct rhw_workgroup *w)
{
    for (uint32_t c = 0; c < 3; c++) {
        rhw_storage_store1(w->bindings, 0, 2 + c, (int32_t)c + 2);
    }
    rhw_storage_atomic1(w->bindings, 0, RHW_STORAGE_ADD, 0, 1);
}

static void test_indirect(void **state)
{
    (void)state;
    const uint32_t words[6] = {0, 0, 5, 3, 1, 65536};
    uint32_t counted;
    struct rig rig;
    open_rig(&rig, 2);
    const rhw_buffer buffer = make_buffer(&rig, words, sizeof words);
    const struct rhw_dispatch_def def = {.program = {.workgroup = {plan_next}},
                                         .buffers = {{.buffer = buffer}}};
    assert_int_equal(rhw_dispatch_indirect(rig.context, &def, buffer, 8), RHW_OK);
    read_buffer(&rig, buffer, &counted, 4);
    assert_int_equal(counted, 15);
    assert_int_equal(rhw_dispatch_indirect(rig.context, &def, buffer, 8), RHW_OK);
    read_buffer(&rig, buffer, &counted, 4);
    assert_int_equal(counted, 15 + 2 * 3 * 4);
    assert_int_equal(rhw_dispatch_indirect(rig.context, &def, buffer, 12), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "rhw_dispatch_indirect: x, y, z are 3, 4, 65536 workgroups; each is in 0..65535");
    assert_int_equal(rhw_dispatch_indirect(rig.context, &def, buffer, 16), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "offset is 16 and 12 bytes are read there");
    assert_int_equal(rhw_dispatch_indirect(rig.context, &def, buffer, 6), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "offset is 6; it must be a multiple of 4");
    assert_int_equal(rhw_dispatch_indirect(rig.context, &def, (rhw_buffer){0}, 0), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "the buffer id is null");
    rig_close(&rig);
}

// Order ------------------------------------------------------------------------------------------------

// Write the turn of each workgroup, as an atomic gives it. The first one waits for others, which must not come.
static void take_turn(struct rhw_workgroup *w)
{
    const int32_t number = w->id[0] + w->counts[0] * (w->id[1] + w->counts[1] * w->id[2]);
    const uint64_t end = rhw_time_ns() + 20000000;
    while (number == 0 && rhw_storage_load1(w->bindings, 0, 0) == 0 && rhw_time_ns() < end) {
    }
    const int32_t turn = rhw_storage_atomic1(w->bindings, 0, RHW_STORAGE_ADD, 0, 1);
    rhw_storage_store1(w->bindings, 0, 1 + (uint32_t)number, turn);
}

static void test_results_of_atomics(void **state)
{
    (void)state;
    enum { X = 20, Y = 30, Z = 7 };
    static int32_t turns[1 + X * Y * Z];
    for (int threads = 1; threads <= 4; threads += 3) {
        struct rig rig;
        open_rig(&rig, threads);
        const rhw_buffer buffer = make_buffer(&rig, NULL, sizeof turns);
        struct rhw_dispatch_def def = {.program = {.workgroup = {take_turn}, .uses_atomic_results = true},
                                       .buffers = {{.buffer = buffer}}};
        assert_int_equal(rhw_dispatch(rig.context, &def, X, Y, Z), RHW_OK);
        read_buffer(&rig, buffer, turns, sizeof turns);
        assert_int_equal(turns[0], X * Y * Z);
        for (int i = 0; i < X * Y * Z; i++) {
            assert_int_equal(turns[1 + i], i);
        }
        rig_close(&rig);
    }
}

// Giving up --------------------------------------------------------------------------------------------

static void count_workgroup(struct rhw_workgroup *w)
{
    rhw_storage_atomic1(w->bindings, 0, RHW_STORAGE_ADD, 0, 1);
}

static void check_given_up(int threads)
{
    enum { WORKGROUPS = 300 };
    int32_t counted, zero = 0;
    struct rig rig;
    open_rig(&rig, threads);
    const rhw_buffer buffer = make_buffer(&rig, NULL, 4);
    const struct rhw_dispatch_def def = {.program = {.workgroup = {count_workgroup}},
                                         .buffers = {{.buffer = buffer}}};
    for (int left = 0; left <= WORKGROUPS; left += 60) {
        struct patience patience = {.left = left};
        rhw_context_set_goes_on(rig.context, goes_on, &patience);
        assert_int_equal(rhw_buffer_write(rig.context, buffer, 0, &zero, 4), RHW_OK);
        const enum rhw_result result = rhw_dispatch(rig.context, &def, WORKGROUPS, 1, 1);
        read_buffer(&rig, buffer, &counted, 4);
        if (threads == 1 || left == 0) {
            assert_int_equal(result, RHW_ERROR_GIVEN_UP);
            assert_int_equal(patience.asked, left + 1);
            assert_int_equal(counted, left == 0 ? 0 : left - 1); // asked once before the first
        } else {
            assert_true(result == RHW_OK ? counted == WORKGROUPS : result == RHW_ERROR_GIVEN_UP);
        }
    }
    rhw_context_set_goes_on(rig.context, NULL, NULL);
    assert_int_equal(rhw_buffer_write(rig.context, buffer, 0, &zero, 4), RHW_OK);
    assert_int_equal(rhw_dispatch(rig.context, &def, WORKGROUPS, 1, 1), RHW_OK);
    read_buffer(&rig, buffer, &counted, 4);
    assert_int_equal(counted, WORKGROUPS);
    rig_close(&rig);
}

static void test_given_up_between_workgroups(void **state)
{
    (void)state;
    check_given_up(1);
    check_given_up(4);
}

static void wait_for_nothing(struct rhw_workgroup *w)
{
    rhw_storage_atomic1(w->bindings, 0, RHW_STORAGE_ADD, 0, 1);
    while (!rhw_work_is_given_up(w->bindings)) {
    }
}

static void test_given_up_within_a_workgroup(void **state)
{
    (void)state;
    for (int threads = 1; threads <= 4; threads += 3) {
        struct rig rig;
        open_rig(&rig, threads);
        int32_t begun;
        struct patience patience = {.left = 6};
        const rhw_buffer buffer = make_buffer(&rig, NULL, 4);
        const struct rhw_dispatch_def def = {.program = {.workgroup = {wait_for_nothing}},
                                             .buffers = {{.buffer = buffer}}};
        rhw_context_set_goes_on(rig.context, goes_on, &patience);
        assert_int_equal(rhw_dispatch(rig.context, &def, 20, 1, 1), RHW_ERROR_GIVEN_UP);
        assert_int_equal(patience.asked, 7);
        read_buffer(&rig, buffer, &begun, 4);
        assert_in_range(begun, 1, threads);
        rig_close(&rig);
    }
}

// Misuse -----------------------------------------------------------------------------------------------

static void expect_refused(struct rig *rig, const struct rhw_dispatch_def *def, const char *part)
{
    assert_int_equal(rhw_dispatch(rig->context, def, 1, 1, 1), RHW_ERROR_MISUSE);
    rig_expect_misuse(rig, part);
}

static void test_misuse_of_programs(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig, 1);
    const struct rhw_dispatch_def good = {.program = {.workgroup = {count_workgroup}, .label = "count"}};
    struct rhw_dispatch_def def = {.program.size = {1}};
    assert_int_equal(rhw_dispatch(rig.context, NULL, 1, 1, 1), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "rhw_dispatch: def is NULL");
    expect_refused(&rig, &def, "program.workgroup and program.invocation1 are NULL; one of them must be set");
    def.program.workgroup[RHW_ISA_AVX2] = count_workgroup;
    expect_refused(&rig, &def, "program.workgroup[RHW_ISA_BASELINE] is NULL");
    def = good;
    def.program.size[1] = 1025;
    expect_refused(&rig, &def, "rhw_dispatch \"count\": program.size[1] is 1025; it must be 0..1024");
    def.program.size[1] = -1;
    expect_refused(&rig, &def, "program.size[1] is -1");
    memcpy(def.program.size, (const int[3]){32, 33, 0}, sizeof def.program.size);
    expect_refused(&rig, &def,
                   "program.size is 32, 33, 0, which are 1056 invocations; they must be at most 1024");
    def = good;
    def.program.shared_size = RHW_MAX_SHARED_SIZE + 1;
    expect_refused(&rig, &def, "program.shared_size is 65537; it must be 0..65536");
    def = good;
    def.program.invocation_size = UINT32_MAX;
    expect_refused(&rig, &def, "program.invocation_size is 4294967295; it must be 0..4096");
    def = good;
    def.program.uniform_size = RHW_MAX_UNIFORM_SIZE + 1;
    expect_refused(&rig, &def, "program.uniform_size is 1048577");
    def.program.uniform_size = 8;
    def.uniforms = &def;
    def.uniform_bytes = 7;
    expect_refused(&rig, &def, "7 bytes of uniforms are given; the program reads 8");
    assert_int_equal(rhw_dispatch(rig.context, &good, 1, 65536, 1), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "x, y, z are 1, 65536, 1 workgroups; each is in 0..65535");
    def = good;
    def.base[2] = 65535;
    assert_int_equal(rhw_dispatch(rig.context, &def, 1, 1, 1), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "base is 0, 0, 65535 before 1, 1, 1 workgroups; together they are at most 65535");
    assert_int_equal(rhw_dispatch_probed(rig.context, &good, RHW_ARITHMETIC_FUSED, 1, 1, 1),
                     RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "rhw_dispatch \"count\": multiplications and additions are fused");
    rig_begin(&rig);
    expect_refused(&rig, &good, "rhw_dispatch: a pass is being recorded; end it first");
    assert_int_equal(rhw_pass_end(rig.context, rig.recording, NULL), RHW_ERROR_MISUSE);
    rig_close(&rig);
}

static void test_misuse_of_slots(void **state)
{
    (void)state;
    struct rig rig;
    rhw_sampler sampler;
    const struct rhw_sampler_def sampler_def = {.min_filter = RHW_FILTER_LINEAR};
    open_rig(&rig, 1);
    const rhw_buffer words = make_buffer(&rig, NULL, 64), gone = make_buffer(&rig, NULL, 64);
    const rhw_texture image = make_texture(&rig, RHW_FORMAT_RGBA8_UNORM, 4, 4);
    rhw_buffer_destroy(rig.context, gone);
    assert_int_equal(rhw_sampler_create(rig.context, &sampler_def, &sampler), RHW_OK);
    const struct rhw_dispatch_def good = {.program = {.workgroup = {count_workgroup}, .label = "count"},
                                          .buffers = {{.buffer = words}}};
    struct rhw_dispatch_def def = good;
    def.buffers[1].buffer = gone;
    expect_refused(&rig, &def, "is stale: it was destroyed");
    def.buffers[1] = (struct rhw_dispatch_buffer){words, 60, 8, false};
    expect_refused(&rig, &def, "rhw_dispatch \"count\": offset is 60 and size is 8");
    def.buffers[1] = (struct rhw_dispatch_buffer){words, 2, 4, false};
    expect_refused(&rig, &def, "offset is 2; it must be a multiple of 4");
    def.buffers[1] = (struct rhw_dispatch_buffer){words, 32, 4, true};
    expect_refused(&rig, &def, "storage of this dispatch may write bytes 0 to 64");
    // What the refused dispatch was to use is free again.
    assert_int_equal(rhw_buffer_write(rig.context, words, 0, &def, 64), RHW_OK);
    def = good;
    def.textures[2] = (struct rhw_dispatch_texture){image, {0}};
    expect_refused(&rig, &def, "the sampler id is null");
    def.textures[2].sampler = sampler;
    def.images[1].texture = image;
    expect_refused(&rig, &def, "is sampled in this dispatch or set for reading alone");
    def.textures[2] = (struct rhw_dispatch_texture){0};
    def.images[1].level = 1;
    expect_refused(&rig, &def, "level is 1");
    def.images[1].level = 0;
    def.images[1].buffer = words;
    expect_refused(&rig, &def, "images[1] has a texture and a buffer; one of them must be null");
    def.images[1] = (struct rhw_dispatch_image){.buffer = words, .format = RHW_FORMAT_D32_FLOAT};
    expect_refused(&rig, &def, "it must be of colour");
    assert_int_equal(rhw_dispatch(rig.context, &good, 1, 1, 1), RHW_OK);
    rig_close(&rig);
}

// Validation tells of slots that are empty. Without it they read zeros.
static void use_empty_slots(struct rhw_workgroup *w)
{
    const int32_t which = *(const int32_t *)w->uniforms;
    float texel[4];
    if (which == 0) {
        rhw_storage_store1(w->bindings, 5, 0, 1);
    } else if (which == 1) {
        rhw_image_load1(w->bindings, 6, (const int32_t[3]){0}, texel);
    } else if (which == 2) {
        const float at[2] = {0, 0};
        rhw_sample_lod1(w->bindings, 7, at, 0, texel);
    } else {
        rhw_storage_store1(w->bindings, 0, 0, 1);
    }
}

static void test_validation(void **state)
{
    (void)state;
    static const char *const parts[] = {
        "rhw_dispatch \"empty\": a shader function of the program uses storage slot 5, in which nothing",
        "uses image slot 6, in which nothing is set", "samples slot 7, in which no texture is set",
        "writes to storage slot 0, which is set for reading alone"};
    for (int validates = 0; validates < 2; validates++) {
        struct rhw_context_def context = rhw_context_def_default();
        struct rig rig;
        context.validate = validates ? RHW_VALIDATE_ON : RHW_VALIDATE_OFF;
        rig_open_with(&rig, 4, 4, &context);
        const rhw_buffer words = make_buffer(&rig, NULL, 4);
        for (int32_t which = 0; which < 4; which++) {
            const struct rhw_dispatch_def def = {
                .program = {.workgroup = {use_empty_slots}, .uniform_size = 4, .label = "empty"},
                .uniforms = &which,
                .uniform_bytes = 4,
                .buffers = {{.buffer = words, .read_only = true}}};
            if (validates) {
                expect_refused(&rig, &def, parts[which]);
            } else {
                assert_int_equal(rhw_dispatch(rig.context, &def, 1, 1, 1), RHW_OK);
            }
        }
        rig_close(&rig);
    }
}

static void call_the_library(struct rhw_workgroup *w)
{
    const struct rig *const rig = w->user;
    rhw_buffer_destroy(rig->context, (rhw_buffer){1, 1, 1});
}

static void test_functions_may_not_call_the_library(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig, 1);
    const struct rhw_dispatch_def def = {.program = {.workgroup = {call_the_library}, .user = &rig}};
    expect_refused(&rig, &def, "rhw_buffer_destroy: called by a function that the library called");
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_every_invocation_runs_once),
    cmocka_unit_test(test_barriers),
    cmocka_unit_test(test_invocations_that_are_done),
    cmocka_unit_test(test_limits),
    cmocka_unit_test(test_between_passes),
    cmocka_unit_test(test_indirect),
    cmocka_unit_test(test_results_of_atomics),
    cmocka_unit_test(test_given_up_between_workgroups),
    cmocka_unit_test(test_given_up_within_a_workgroup),
    cmocka_unit_test(test_misuse_of_programs),
    cmocka_unit_test(test_misuse_of_slots),
    cmocka_unit_test(test_validation),
    cmocka_unit_test(test_functions_may_not_call_the_library),
};

const struct unit_tests test_dispatch = UNIT_TESTS(tests, NULL, NULL);
