// SPDX-License-Identifier: MIT
// A dispatch is a scope of its own, as a pass is: it sets what its slots have with the encoder, by the rules of a pass,
// runs, and leaves nothing behind. So a pass before it has ended, a pass after it has not begun, and each sees what the
// others wrote.
#include <string.h>

#include "binding/validation/validation.h"
#include "context/entry.h"
#include "context/misuse.h"
#include "dispatch_check.h"
#include "pass/encoder.h"
#include "pass/indirect.h"
#include "pass/pass_binding.h"
#include "rhw/rhw.h"
#include "run/grid.h"

static bool set_image(struct rhw_encoder *encoder, int slot, const struct rhw_dispatch_image *image,
                      const char *where)
{
    return rhw_check(encoder->context, image->texture.index == 0 || image->buffer.index == 0,
                     "%s: images[%d] has a texture and a buffer; one of them must be null", where, slot) &&
           (image->texture.index == 0 ||
            rhw_encoder_set_storage_image(encoder, slot, image->texture, image->level, image->read_only,
                                          where)) &&
           (image->buffer.index == 0 ||
            rhw_encoder_set_texel_buffer(encoder, slot, image->buffer, image->format, image->offset,
                                         image->size, image->read_only, where));
}

// Set what the slots of the dispatch have. Return false where a rule is broken.
static bool set_slots(struct rhw_encoder *encoder, const struct rhw_dispatch_def *def, const char *where)
{
    for (int i = 0; i < RHW_MAX_TEXTURES; i++) {
        const struct rhw_dispatch_texture *const texture = &def->textures[i];
        if (texture->texture.index != 0 &&
            !rhw_encoder_set_texture(encoder, i, texture->texture, texture->sampler, where)) {
            return false;
        }
    }
    for (int i = 0; i < RHW_MAX_STORAGE_BUFFERS; i++) {
        const struct rhw_dispatch_buffer *const buffer = &def->buffers[i];
        if (buffer->buffer.index != 0 &&
            !rhw_encoder_set_storage_buffer(encoder, i, buffer->buffer, buffer->offset, buffer->size,
                                            buffer->read_only, where)) {
            return false;
        }
    }
    for (int i = 0; i < RHW_MAX_STORAGE_IMAGES; i++) {
        if (!set_image(encoder, i, &def->images[i], where)) {
            return false;
        }
    }
    return true;
}

// Return the function for the instruction set of the context, or NULL for the one-at-a-time form.
static rhw_workgroup_function *function_of(const struct rhw_context *context,
                                           const struct rhw_compute_program *program)
{
    rhw_workgroup_function *function = NULL;
    for (int i = RHW_ISA_BASELINE; i <= (int)context->isa; i++) {
        function = program->workgroup[i] != NULL ? program->workgroup[i] : function;
    }
    return function;
}

// Report what validation found while the workgroups ran. Return true if it was misuse.
static bool report_validation(const struct rhw_context *context, const char *where)
{
    const struct rhw_validation_message *const found = &context->validation->kinds[RHW_VALIDATION_MISUSE];
    return !rhw_check(context, !found->found, "%s: %s", where, found->text);
}

// Run the workgroups of a dispatch whose slots are set.
static enum rhw_result run(struct rhw_encoder *encoder, const struct rhw_dispatch_def *def,
                           const struct rhw_dispatch_command *counts, const char *where)
{
    struct rhw_context *const context = encoder->context;
    struct rhw_grid grid = {.program = &def->program,
                            .function = function_of(context, &def->program),
                            .uniforms = def->uniforms,
                            .count = {(int32_t)counts->x, (int32_t)counts->y, (int32_t)counts->z}};
    struct rhw_bindings bindings;
    for (int c = 0; c < 3; c++) {
        grid.base[c] = (int32_t)def->base[c];
        grid.size[c] = def->program.size[c] == 0 ? 1 : def->program.size[c];
    }
    if (encoder->out_of_memory || !rhw_pass_resolve_bindings(encoder)) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    if (encoder->given_up) {
        return RHW_ERROR_GIVEN_UP;
    }
    grid.bindings = encoder->bindings;
    if (context->validation) {
        rhw_validation_messages_clear(context->validation);
        rhw_bindings_copy(encoder->bindings, &bindings);
        bindings.site =
            (struct rhw_sample_site){.validation = context->validation, .pipeline = "the program"};
        grid.bindings = &bindings;
    }
    atomic_store_explicit(&context->refused, false, memory_order_relaxed);
    const enum rhw_result result = rhw_executor_run_grid(context->executor, &grid);
    bool misused = atomic_load_explicit(&context->refused, memory_order_relaxed);
    if (context->validation && result == RHW_OK) {
        misused |= report_validation(context, where);
    }
    return result == RHW_OK && misused ? RHW_ERROR_MISUSE : result;
}

// Where the counts of a dispatch stand: in `counts`, or in a buffer.
struct counts {
    struct rhw_dispatch_command counts;
    rhw_buffer buffer;
    size_t offset;
    bool is_indirect;
};

// Read the counts from their buffer. They are read before any workgroup runs, so the dispatch may write them.
static bool read_counts(const struct rhw_context *context, struct counts *counts, const char *where)
{
    if (!counts->is_indirect) {
        return true;
    }
    const unsigned char *const bytes =
        rhw_indirect_bytes(context, counts->buffer, counts->offset, sizeof counts->counts, "", where);
    if (bytes != NULL) {
        memcpy(&counts->counts, bytes, sizeof counts->counts);
    }
    return bytes != NULL;
}

static enum rhw_result dispatch(struct rhw_context *context, const struct rhw_dispatch_def *def,
                                uint32_t flaws, struct counts *counts, const char *where)
{
    struct rhw_encoder *const encoder = context->encoder;
    if (!rhw_check(context, def != NULL, "%s: def is NULL", where) ||
        !rhw_check(context, !context->recording.active, "%s: a pass is being recorded; end it first",
                   where)) {
        return RHW_ERROR_MISUSE;
    }
    context->definition = def->program.label;
    if (!rhw_dispatch_check(context, def, flaws, where) || !read_counts(context, counts, where) ||
        !rhw_dispatch_check_counts(context, def, &counts->counts, where)) {
        return RHW_ERROR_MISUSE;
    }
    rhw_encoder_renew(encoder);
    context->recording.dispatches = true;
    const bool is_set = set_slots(encoder, def, where);
    context->recording.dispatches = false;
    return is_set ? run(encoder, def, &counts->counts, where) : RHW_ERROR_MISUSE;
}

static enum rhw_result enter(rhw_context *context, const struct rhw_dispatch_def *def, uint32_t flaws,
                             struct counts counts, const char *where)
{
    if (!rhw_context_enter(context, where)) {
        return RHW_ERROR_MISUSE;
    }
    const enum rhw_result result = dispatch(context, def, flaws, &counts, where);
    context->definition = NULL;
    rhw_context_leave(context);
    return result;
}

enum rhw_result rhw_dispatch_probed(rhw_context *context, const struct rhw_dispatch_def *def, uint32_t flaws,
                                    uint32_t x, uint32_t y, uint32_t z)
{
    return enter(context, def, flaws, (struct counts){.counts = {x, y, z}}, "rhw_dispatch");
}

enum rhw_result rhw_dispatch_indirect_probed(rhw_context *context, const struct rhw_dispatch_def *def,
                                             uint32_t flaws, rhw_buffer buffer, size_t offset)
{
    return enter(context, def, flaws,
                 (struct counts){.buffer = buffer, .offset = offset, .is_indirect = true},
                 "rhw_dispatch_indirect");
}
