// SPDX-License-Identifier: MIT
// Bindings of bytes, as words or as texels. Bytes of a buffer are looked up in its context; then they are as good as
// memory of the program.
#include "bind_entry.h"

#include "binding_check.h"
#include "context/context.h"
#include "context/entry.h"
#include "context/lookup.h"
#include "context/misuse.h"
#include "format/format.h"
#include "resource/buffer.h"

bool rhw_binding_enter(struct rhw_context *context, struct rhw_binding *binding, const char *where)
{
    if (binding) {
        memset(binding, 0, sizeof *binding);
    }
    if (!rhw_context_enter(context, where)) {
        return false;
    }
    if (!rhw_check(context, binding != NULL, "%s: binding is NULL", where)) {
        rhw_context_leave(context);
        return false;
    }
    return true;
}

static void put_words(void *memory, size_t size, bool is_read_only, struct rhw_binding *binding)
{
    const struct rhw_binding_data data = {.words = rhw_storage_words_of(memory, size, is_read_only),
                                          .kind = RHW_BINDING_WORDS};
    rhw_binding_put(&data, binding);
}

static void put_texels(const struct rhw_kernels *kernels, void *memory, size_t size, enum rhw_format format,
                       bool is_read_only, struct rhw_binding *binding)
{
    const struct rhw_binding_data data = {.image =
                                              rhw_storage_image_of_texels(format, memory, size, is_read_only),
                                          .kernels = kernels,
                                          .kind = RHW_BINDING_IMAGE};
    rhw_binding_put(&data, binding);
}

// Bytes of a buffer -------------------------------------------------------------------------------------

struct bytes {
    unsigned char *first;
    size_t size;
};

// Find bytes of a buffer, which stay where they are from now on. Report misuse and return false where there are none.
static bool find_bytes(struct rhw_context *context, rhw_buffer id, size_t offset, size_t size,
                       bool is_read_only, struct bytes *bytes, const char *where)
{
    struct rhw_buffer_data *const data = rhw_context_buffer(context, id, where);
    if (!data || !rhw_buffer_check_range(context, id, data, offset, size, where)) {
        return false;
    }
    data->is_bound = true;
    data->has_stores |= !is_read_only;
    *bytes = (struct bytes){data->bytes + offset, size == 0 ? data->size - offset : size};
    return true;
}

enum rhw_result rhw_binding_of_buffer(rhw_context *context, rhw_buffer buffer, size_t offset, size_t size,
                                      bool read_only, struct rhw_binding *binding)
{
    static const char *const where = "rhw_binding_of_buffer";
    struct bytes bytes;
    if (!rhw_binding_enter(context, binding, where)) {
        return RHW_ERROR_MISUSE;
    }
    const bool is_valid =
        rhw_check(context, offset % 4 == 0, "%s: offset is %zu; it must be a multiple of 4", where, offset) &&
        find_bytes(context, buffer, offset, size, read_only, &bytes, where);
    if (is_valid) {
        put_words(bytes.first, bytes.size, read_only, binding);
    }
    rhw_context_leave(context);
    return is_valid ? RHW_OK : RHW_ERROR_MISUSE;
}

enum rhw_result rhw_binding_of_texels(rhw_context *context, rhw_buffer buffer, enum rhw_format format,
                                      size_t offset, size_t size, bool read_only, struct rhw_binding *binding)
{
    static const char *const where = "rhw_binding_of_texels";
    struct bytes bytes;
    if (!rhw_binding_enter(context, binding, where)) {
        return RHW_ERROR_MISUSE;
    }
    const bool is_valid = rhw_binding_check_texels(context, format, offset, where) &&
                          find_bytes(context, buffer, offset, size, read_only, &bytes, where);
    if (is_valid) {
        put_texels(context->kernels, bytes.first, bytes.size, format, read_only, binding);
    }
    rhw_context_leave(context);
    return is_valid ? RHW_OK : RHW_ERROR_MISUSE;
}

// Memory ------------------------------------------------------------------------------------------------

static bool is_memory(const void *memory, size_t size, size_t alignment)
{
    return memory ? (uintptr_t)memory % alignment == 0 : size == 0;
}

bool rhw_binding_of_memory(void *memory, size_t size, bool read_only, struct rhw_binding *binding)
{
    memset(binding, 0, sizeof *binding);
    if (!is_memory(memory, size, sizeof(uint32_t))) {
        return false;
    }
    put_words(memory, size, read_only, binding);
    return true;
}

bool rhw_binding_of_texel_memory(enum rhw_isa isa, void *memory, size_t size, enum rhw_format format,
                                 bool read_only, struct rhw_binding *binding)
{
    const struct rhw_kernels *const kernels = rhw_kernels_for(isa);
    memset(binding, 0, sizeof *binding);
    if (!kernels || format == RHW_FORMAT_NONE || !rhw_format_valid(format) ||
        !rhw_format_has_texels(format)) {
        return false;
    }
    const size_t texel = rhw_format_size(format);
    if (!is_memory(memory, size, texel < sizeof(uint32_t) ? texel : sizeof(uint32_t))) {
        return false;
    }
    put_texels(kernels, memory, size, format, read_only, binding);
    return true;
}
