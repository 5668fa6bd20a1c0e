// SPDX-License-Identifier: MIT
// Storage buffers as shader functions reach them. Words are changed lane after lane by the atomics of the compiler,
// relaxed, on whatever thread the function runs: no vector instruction does this for 8 of them. Words that lie outside
// are found for 8 lanes at once.
#include "binding.h"

#include "rhw/shader.h"
#include "binding/validation/validation.h"

const struct rhw_storage rhw_no_storage;

static int32_t exchange_if(uint32_t *word, bool (*replaces)(uint32_t now, uint32_t value), uint32_t value)
{
    uint32_t now = __atomic_load_n(word, __ATOMIC_RELAXED);
    while (replaces(now, value) &&
           !__atomic_compare_exchange_n(word, &now, value, true, __ATOMIC_RELAXED, __ATOMIC_RELAXED)) {
    }
    return (int32_t)now;
}

static bool is_above(uint32_t now, uint32_t value)
{
    return (int32_t)now > (int32_t)value;
}

static bool is_below(uint32_t now, uint32_t value)
{
    return (int32_t)now < (int32_t)value;
}

static bool is_above_unsigned(uint32_t now, uint32_t value)
{
    return now > value;
}

static bool is_below_unsigned(uint32_t now, uint32_t value)
{
    return now < value;
}

int32_t rhw_storage_word(uint32_t *word, enum rhw_storage_operation operation, uint32_t value,
                         uint32_t comparand)
{
    switch (operation) {
    case RHW_STORAGE_LOAD: return (int32_t)__atomic_load_n(word, __ATOMIC_RELAXED);
    case RHW_STORAGE_STORE: __atomic_store_n(word, value, __ATOMIC_RELAXED); return 0;
    case RHW_STORAGE_ADD: return (int32_t)__atomic_fetch_add(word, value, __ATOMIC_RELAXED);
    case RHW_STORAGE_MIN: return exchange_if(word, is_above, value);
    case RHW_STORAGE_MAX: return exchange_if(word, is_below, value);
    case RHW_STORAGE_MIN_UNSIGNED: return exchange_if(word, is_above_unsigned, value);
    case RHW_STORAGE_MAX_UNSIGNED: return exchange_if(word, is_below_unsigned, value);
    case RHW_STORAGE_AND: return (int32_t)__atomic_fetch_and(word, value, __ATOMIC_RELAXED);
    case RHW_STORAGE_OR: return (int32_t)__atomic_fetch_or(word, value, __ATOMIC_RELAXED);
    case RHW_STORAGE_XOR: return (int32_t)__atomic_fetch_xor(word, value, __ATOMIC_RELAXED);
    case RHW_STORAGE_EXCHANGE: return (int32_t)__atomic_exchange_n(word, value, __ATOMIC_RELAXED);
    case RHW_STORAGE_COMPARE_EXCHANGE:
        __atomic_compare_exchange_n(word, &comparand, value, false, __ATOMIC_RELAXED, __ATOMIC_RELAXED);
        return (int32_t)comparand;
    case RHW_STORAGE_OPERATION_COUNT: break;
    }
    return 0;
}

struct rhw_storage_words rhw_storage_words_of(void *bytes, size_t size, bool is_read_only)
{
    const size_t count = size / sizeof(uint32_t);
    return (struct rhw_storage_words){bytes, count < UINT32_MAX ? (uint32_t)count : UINT32_MAX, is_read_only};
}

void rhw_words_access(struct rhw_storage_words range, const struct rhw_storage_request *request,
                      rhw_int *before)
{
    const enum rhw_storage_operation operation = request->operation;
    const rhw_int mask = request->mask ? *request->mask : rhw_splat_int(-1);
    const rhw_uint index = (rhw_uint)*request->index;
    const rhw_int inside = (rhw_int)(index < range.count) & mask;
    rhw_int result = rhw_splat_int(0);
    for (unsigned left = (unsigned)rhw_mask_bits(inside); left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        const uint32_t value = request->value ? (uint32_t)(*request->value)[lane] : 0;
        const uint32_t comparand = request->comparand ? (uint32_t)(*request->comparand)[lane] : 0;
        result[lane] = rhw_storage_word(&range.words[index[lane]], operation, value, comparand);
    }
    if (before) {
        *before = result;
    }
}

int32_t rhw_words_access1(struct rhw_storage_words range, enum rhw_storage_operation operation,
                          uint32_t index, int32_t value, int32_t comparand)
{
    return index < range.count
               ? rhw_storage_word(&range.words[index], operation, (uint32_t)value, (uint32_t)comparand)
               : 0;
}

// By slot ----------------------------------------------------------------------------------------------

// Return the words of a slot. Return none where the slot has no buffer or does not exist. Return none to an operation
// that changes them where the slot is set for reading, or where validation finds that the program did not declare the
// effect.
static struct rhw_storage_words words_of(const struct rhw_bindings *bindings, int slot,
                                         enum rhw_storage_operation operation)
{
    static const struct rhw_storage_words none;
    if (bindings->site.validation) {
        rhw_validate_storage(bindings, slot, operation);
    }
    const struct rhw_storage_words *const words =
        (unsigned)slot < RHW_MAX_STORAGE_BUFFERS ? &bindings->storage->buffers[slot] : &none;
    const bool is_dropped = operation != RHW_STORAGE_LOAD && (bindings->drops_effects || words->is_read_only);
    return is_dropped ? none : *words;
}

void rhw_storage_access(const struct rhw_bindings *bindings, int slot,
                        const struct rhw_storage_request *request, rhw_int *before)
{
    rhw_words_access(words_of(bindings, slot, request->operation), request, before);
}

int32_t rhw_storage_access1(const struct rhw_bindings *bindings, int slot,
                            enum rhw_storage_operation operation, uint32_t index, int32_t value,
                            int32_t comparand)
{
    return rhw_words_access1(words_of(bindings, slot, operation), operation, index, value, comparand);
}

uint32_t rhw_storage_count(const struct rhw_bindings *bindings, int slot)
{
    return words_of(bindings, slot, RHW_STORAGE_LOAD).count;
}
