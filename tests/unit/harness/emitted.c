// SPDX-License-Identifier: MIT
// See emitted.h.
#undef rhw_shader_create
#undef rhw_shader_program_create
#undef rhw_shader_program_get
#undef rhw_shader_program_get_compute
#include "emitted.h"

#include <stdlib.h>
#include <string.h>

#include "unit.h"

// What was written, and what of.
struct row {
    uint64_t hashes[2]; // the vertex or compute shader, the fragment shader or 0
    const struct rhw_program *drawn;
    const struct rhw_compute_program *compute;
};

#define EMITTED_DRAWN(name, vertex, fragment)  extern const struct rhw_program name##_program;
#define EMITTED_COMPUTE(name, compute, unused) extern const struct rhw_compute_program name##_program;
#include "emitted_rows.inc"
#undef EMITTED_DRAWN
#undef EMITTED_COMPUTE

#define EMITTED_DRAWN(name, vertex, fragment)  {{vertex, fragment}, &name##_program, NULL},
#define EMITTED_COMPUTE(name, compute, unused) {{compute, unused}, NULL, &name##_program},
static const struct row rows[] = {
#include "emitted_rows.inc"
    {{0, 0}, NULL, NULL},
};

// Shaders and programs of the test that runs, the newest last. An address may come again, so the newest counts.
enum { MOST = 4096 };

struct known {
    const void *object;
    uint64_t hash; // of a shader
    const struct row *row;
};

static struct known known[MOST];
static int known_count, used_count;

static void add_known(const void *object, uint64_t hash, const struct row *row)
{
    known[known_count++ % MOST] = (struct known){object, hash, row};
}

static const struct known *find(const void *object)
{
    static const struct known nothing;
    for (int i = known_count; object && i > 0 && i > known_count - MOST; i--) {
        if (known[(i - 1) % MOST].object == object) {
            return &known[(i - 1) % MOST];
        }
    }
    return &nothing;
}

static bool is_wanted(void)
{
    const char *const back_end = getenv("RHW_TEST_BACK_END");
    return back_end && strcmp(back_end, "c") == 0;
}

static uint64_t hash_bytes(const unsigned char *bytes, size_t size)
{
    uint64_t hash = 0xcbf29ce484222325;
    for (size_t i = 0; i < size; i++) {
        hash = (hash ^ bytes[i]) * 0x100000001b3;
    }
    return hash;
}

enum rhw_result emitted_shader_create(const void *words, size_t size, const struct rhw_shader_def *def,
                                      rhw_shader **shader, char *message)
{
    const enum rhw_result result = rhw_shader_create(words, size, def, shader, message);
    if (result == RHW_OK && is_wanted()) {
        add_known(*shader, def->constant_count == 0 ? hash_bytes(words, size) : 0, NULL);
    }
    return result;
}

// Return whether a workgroup keeps more from barrier to barrier than generated code has room for on the stack.
static bool keeps_much(const rhw_shader_program *program)
{
    const struct rhw_compute_program *const compute = rhw_shader_program_get_compute(program);
    const size_t invocations = (size_t)compute->size[0] * (size_t)compute->size[1] * (size_t)compute->size[2];
    return invocations * compute->invocation_size > 128 << 10;
}

// Where one program has machine code, all have but those that keep much: nothing else that the tests use is left to the
// interpreter in silence.
static void check_generated(const struct rhw_shader_program_def *def, const rhw_shader_program *program)
{
    static bool has_code;
    const rhw_shader *const shaders[] = {def->vertex, def->fragment, def->compute};
    const struct rhw_program *const drawn = rhw_shader_program_get(program);
    for (int s = 0; s < RHW_SHADER_STAGE_COUNT; s++) {
        const bool is_left_out = s == RHW_SHADER_FRAGMENT && !drawn->fragment[RHW_ISA_BASELINE];
        const bool is_large = s == RHW_SHADER_COMPUTE && shaders[s] && keeps_much(program);
        if (!shaders[s] || is_left_out || def->is_interpreted || is_large) {
            continue;
        }
        const bool is_generated = rhw_shader_program_is_generated(program, (enum rhw_shader_stage)s);
        if (has_code && !is_generated) {
            fail_msg("a program has no machine code of stage %d", s);
        }
        has_code = has_code || is_generated;
    }
}

enum rhw_result emitted_program_create(const struct rhw_shader_program_def *def, rhw_shader_program **program,
                                       char *message)
{
    const enum rhw_result result = rhw_shader_program_create(def, program, message);
    if (result == RHW_OK) {
        check_generated(def, *program);
    }
    if (result != RHW_OK || !is_wanted()) {
        return result;
    }
    const uint64_t first = find(def->compute ? def->compute : def->vertex)->hash;
    const uint64_t second = find(def->fragment)->hash;
    const struct row *row = rows;
    while (row->hashes[0] != 0 && (row->hashes[0] != first || row->hashes[1] != second)) {
        row++;
    }
    const bool is_c = row->hashes[0] != 0 && !def->layout && !def->is_interpreted;
    add_known(*program, 0, is_c ? row : NULL);
    return result;
}

const struct rhw_program *emitted_program_get(const rhw_shader_program *program)
{
    const struct row *const row = find(program)->row;
    used_count += row ? 1 : 0;
    return row ? row->drawn : rhw_shader_program_get(program);
}

const struct rhw_compute_program *emitted_program_get_compute(const rhw_shader_program *program)
{
    const struct row *const row = find(program)->row;
    used_count += row ? 1 : 0;
    return row ? row->compute : rhw_shader_program_get_compute(program);
}

int emitted_count(void)
{
    return used_count;
}
