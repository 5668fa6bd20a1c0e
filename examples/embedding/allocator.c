// SPDX-License-Identifier: MIT
// A context with a budget: all of its memory comes from hooks that count it and refuse what is too much. Being refused
// is a result; the context goes on.
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>

#include "cube.h"
#include "target.h"

// Worker threads allocate too: the counters are atomic.
struct budget {
    size_t limit; // bytes
    atomic_size_t used, refused;
};

static void *budget_allocate(void *user, size_t size, size_t alignment)
{
    struct budget *const budget = user;
    // aligned_alloc takes multiples of the alignment, and at least that of a pointer.
    const size_t step = alignment < sizeof(void *) ? sizeof(void *) : alignment;
    const size_t used = atomic_fetch_add(&budget->used, size) + size;
    void *const memory = used <= budget->limit ? aligned_alloc(step, (size + step - 1) / step * step) : NULL;
    if (!memory) {
        atomic_fetch_sub(&budget->used, size);
        atomic_fetch_add(&budget->refused, 1);
    }
    return memory;
}

static void budget_release(void *user, void *memory, size_t size)
{
    struct budget *const budget = user;
    atomic_fetch_sub(&budget->used, size); // the size that it was allocated with
    free(memory);
}

// Draws a picture and says how that went.
static void draw(rhw_context *context, rhw_pipeline pipeline, struct target *target, int size)
{
    enum rhw_result result = target_fit(context, target, size, size);
    if (result == RHW_OK) {
        result = cube_draw(context, pipeline, target->texture, 0.5f);
    }
    printf("%d x %d: %s\n", size, size, rhw_result_string(result));
}

int main(void)
{
    struct budget budget = {.limit = 32 << 20};
    struct rhw_context_def def = rhw_context_def_default();
    struct target target = {0};
    rhw_context *context;
    rhw_pipeline pipeline;
    def.allocator = (struct rhw_allocator){budget_allocate, budget_release, &budget};
    def.threads = 2;
    if (rhw_context_create(&def, &context) != RHW_OK || cube_pipeline(context, &pipeline) != RHW_OK) {
        return 1;
    }
    draw(context, pipeline, &target, 500);
    draw(context, pipeline, &target, 5000); // 100 MB
    draw(context, pipeline, &target, 600);
    rhw_context_destroy(context);
    printf("refused: %zu, left: %zu bytes\n", atomic_load(&budget.refused), atomic_load(&budget.used));
    return 0;
}
