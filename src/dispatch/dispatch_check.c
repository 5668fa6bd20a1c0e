// SPDX-License-Identifier: MIT
// A program is no object that was checked when it was created, so each dispatch checks it. These are comparisons of a
// few numbers, which cost less than the scheduler's look at the clock.
#include "dispatch_check.h"

#include "context/context.h"
#include "context/misuse.h"
#include "pipeline/pipeline_check.h"

static bool check_functions(const struct rhw_context *context, const struct rhw_compute_program *program,
                            const char *where)
{
    bool any = false;
    for (int i = 0; i < RHW_ISA_COUNT; i++) {
        any |= program->workgroup[i] != NULL;
    }
    return rhw_check(context, any || program->invocation1 != NULL,
                     "%s: program.workgroup and program.invocation1 are NULL; one of them must be set",
                     where) &&
           rhw_check(context, !any || program->workgroup[RHW_ISA_BASELINE] != NULL,
                     "%s: program.workgroup[RHW_ISA_BASELINE] is NULL; it must be set where another entry is",
                     where);
}

static bool check_size(const struct rhw_context *context, const struct rhw_compute_program *program,
                       const char *where)
{
    const int *const size = program->size;
    int64_t product = 1;
    for (int c = 0; c < 3; c++) {
        if (!rhw_check(context, size[c] >= 0 && size[c] <= RHW_MAX_WORKGROUP_INVOCATIONS,
                       "%s: program.size[%d] is %d; it must be 0..%d", where, c, size[c],
                       RHW_MAX_WORKGROUP_INVOCATIONS)) {
            return false;
        }
        product *= size[c] == 0 ? 1 : size[c];
    }
    return rhw_check(context, product <= RHW_MAX_WORKGROUP_INVOCATIONS,
                     "%s: program.size is %d, %d, %d, which are %lld invocations; they must be at most %d",
                     where, size[0], size[1], size[2], (long long)product, RHW_MAX_WORKGROUP_INVOCATIONS);
}

static bool check_bytes(const struct rhw_context *context, const char *field, uint32_t bytes, uint32_t most,
                        const char *where)
{
    return rhw_check(context, bytes <= most, "%s: %s is %u; it must be 0..%u", where, field, (unsigned)bytes,
                     (unsigned)most);
}

bool rhw_dispatch_check(const struct rhw_context *context, const struct rhw_dispatch_def *def, uint32_t flaws,
                        const char *where)
{
    const struct rhw_compute_program *const program = &def->program;
    const size_t uniforms = def->uniforms != NULL ? def->uniform_bytes : 0;
    return rhw_check_flaws(context, flaws, where) && check_functions(context, program, where) &&
           check_size(context, program, where) &&
           check_bytes(context, "program.shared_size", program->shared_size, RHW_MAX_SHARED_SIZE, where) &&
           check_bytes(context, "program.invocation_size", program->invocation_size, RHW_MAX_INVOCATION_SIZE,
                       where) &&
           check_bytes(context, "program.uniform_size", program->uniform_size, RHW_MAX_UNIFORM_SIZE, where) &&
           rhw_check(context, uniforms >= program->uniform_size,
                     "%s: %zu bytes of uniforms are given; the program reads %u", where, uniforms,
                     (unsigned)program->uniform_size);
}

bool rhw_dispatch_check_counts(const struct rhw_context *context, const struct rhw_dispatch_def *def,
                               const struct rhw_dispatch_command *counts, const char *where)
{
    const uint32_t most = RHW_MAX_WORKGROUP_COUNT, count[3] = {counts->x, counts->y, counts->z};
    const bool fits = counts->x <= most && counts->y <= most && counts->z <= most;
    bool is_below = true;
    for (int c = 0; fits && c < 3; c++) {
        is_below = is_below && def->base[c] <= most - count[c];
    }
    return rhw_check(context, fits, "%s: x, y, z are %u, %u, %u workgroups; each is in 0..%u", where,
                     (unsigned)counts->x, (unsigned)counts->y, (unsigned)counts->z, (unsigned)most) &&
           rhw_check(
               context, is_below,
               "%s: base is %u, %u, %u before %u, %u, %u workgroups; together they are at most %u in each "
               "direction",
               where, (unsigned)def->base[0], (unsigned)def->base[1], (unsigned)def->base[2],
               (unsigned)counts->x, (unsigned)counts->y, (unsigned)counts->z, (unsigned)most);
}
