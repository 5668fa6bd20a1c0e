// SPDX-License-Identifier: MIT
// The messages of a pass under validation, and what a validator needs before its functions are called.
#include "validation.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/arena.h"
#include "base/constants.h"
#include "context/context.h"

bool rhw_validation_messages_init(struct rhw_validation_messages *validation)
{
    rhw_validation_messages_clear(validation);
    return rhw_mutex_init(&validation->mutex);
}

void rhw_validation_messages_destroy(struct rhw_validation_messages *validation)
{
    rhw_mutex_destroy(&validation->mutex);
}

void rhw_validation_messages_clear(struct rhw_validation_messages *validation)
{
    for (int i = 0; i < RHW_VALIDATION_KINDS; i++) {
        validation->kinds[i].found = false;
    }
}

void rhw_validation_messages_add(struct rhw_validation_messages *validation, enum rhw_validation_kind kind,
                                 uint32_t draw, const char *format, ...)
{
    struct rhw_validation_message *const message = &validation->kinds[kind];
    rhw_mutex_lock(&validation->mutex);
    if (!message->found || draw < message->draw) {
        message->found = true;
        message->draw = draw;
        va_list arguments;
        va_start(arguments, format);
        vsnprintf(message->text, sizeof message->text, format, arguments);
        va_end(arguments);
    }
    rhw_mutex_unlock(&validation->mutex);
}

const uint32_t rhw_validator_input[2] = {0x7fc01234, 0x3ecf1bbd};
const uint32_t rhw_validator_output[2] = {0x7fc05678, 0x3f2d74e1};

bool rhw_validate_pipeline(struct rhw_context *context, struct rhw_pipeline_data *pipeline, const char *name)
{
    struct rhw_program *const program = &pipeline->def.program;
    struct rhw_validator *const validator =
        rhw_memory_allocate(&context->memory, sizeof *validator, _Alignof(struct rhw_validator));
    if (!validator) {
        return false;
    }
    *validator = (struct rhw_validator){.validation = context->validation,
                                        .pipeline = pipeline,
                                        .vertex = pipeline->vertex,
                                        .fragment = pipeline->fragment,
                                        .user = program->user,
                                        .uses = program->uses};
    snprintf(validator->name, sizeof validator->name, "%s", name);
    pipeline->validator = validator;
    pipeline->validator_size = sizeof *validator;
    pipeline->vertex = rhw_validated_vertex;
    if (pipeline->fragment || program->fragment1) {
        pipeline->fragment = rhw_validated_fragment;
        program->uses |= RHW_USE_COORD;
    }
    program->user = validator;
    return true;
}

static void put_copy(unsigned char *to, const void *uniforms, uint32_t size, uint32_t rubbish)
{
    if (size != 0) {
        memcpy(to, uniforms, size);
    }
    for (size_t i = 0; i < RHW_VALIDATED_PADDING; i += sizeof rubbish) {
        memcpy(to + size + i, &rubbish, sizeof rubbish);
    }
}

const void *rhw_validated_uniforms(struct rhw_arena *arena, const void *uniforms, uint32_t size,
                                   uint32_t draw)
{
    const size_t second =
        ((size_t)size + RHW_VALIDATED_PADDING + RHW_CACHE_LINE - 1) & ~(size_t)(RHW_CACHE_LINE - 1);
    struct rhw_validated_uniforms *const header =
        rhw_arena_alloc(arena, sizeof *header + 2 * second, RHW_CACHE_LINE);
    if (!header) {
        return NULL;
    }
    *header = (struct rhw_validated_uniforms){draw, size, second, uniforms};
    rhw_validated_uniforms_renew(header + 1);
    return header + 1;
}

void rhw_validated_uniforms_renew(const void *validated)
{
    const struct rhw_validated_uniforms *const header = rhw_validator_draw(validated);
    unsigned char *const first = (unsigned char *)validated;
    put_copy(first, header->own, header->size, rhw_validator_input[0]);
    put_copy(first + header->second, header->own, header->size, rhw_validator_input[1]);
}
