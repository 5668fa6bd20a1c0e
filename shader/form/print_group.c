// SPDX-License-Identifier: MIT
// Operations on what lanes share: atomics and those of subgroups, whose immediates stand for what they do.
#include "print.h"

static const char *const atomic_names[] = {
#define ATOMIC(name, printed, operation) printed,
#include "atomic.inc"
#undef ATOMIC
};

static const char *const scan_names[] = {
    [SHADER_SCAN_FADD] = "fadd",         [SHADER_SCAN_FMUL] = "fmul",
    [SHADER_SCAN_FMIN] = "fmin",         [SHADER_SCAN_FMAX] = "fmax",
    [SHADER_SCAN_IADD] = "iadd",         [SHADER_SCAN_IMUL] = "imul",
    [SHADER_SCAN_MIN_INT] = "min_int",   [SHADER_SCAN_MAX_INT] = "max_int",
    [SHADER_SCAN_MIN_UINT] = "min_uint", [SHADER_SCAN_MAX_UINT] = "max_uint",
    [SHADER_SCAN_AND] = "and",           [SHADER_SCAN_OR] = "or",
    [SHADER_SCAN_XOR] = "xor",
};

// Return a name of a table, or what stands for one that it does not have.
static const char *name_of(const char *const *names, size_t count, uint32_t number)
{
    return number < count && names[number] ? names[number] : "other";
}

void shader_print_atomic(const struct shader_sink *sink, const struct shader_program *program, uint32_t value)
{
    struct shader_node *const node = &program->nodes[value];
    const bool is_image = node->op == SHADER_IMAGE_ATOMIC;
    const int value_at = is_image ? SHADER_IMAGE_ATOMIC_VALUE : SHADER_ATOMIC_VALUE;
    const bool compares = node->immediate == SHADER_ATOMIC_COMPARE_EXCHANGE;
    uint32_t count;
    const uint32_t *const operands = shader_operands(program, node, &count);
    shader_sink_print(sink, "%s_%s ", is_image ? "image_atomic" : "atomic",
                      name_of(atomic_names, sizeof atomic_names / sizeof *atomic_names, node->immediate));
    shader_print_value(sink, program, operands[0], SHADER_NUMBER_INT);
    shader_sink_print(sink, "[");
    for (int i = 1; i < value_at; i++) {
        shader_print_value(sink, program, operands[i], SHADER_NUMBER_INT);
        shader_sink_print(sink, i + 1 < value_at ? " " : "]");
    }
    for (int i = 0; i < (compares ? 2 : 1) && node->immediate != SHADER_ATOMIC_LOAD; i++) {
        shader_sink_print(sink, i == 0 ? " " : " where ");
        shader_print_value(sink, program, operands[value_at + i], SHADER_NUMBER_INT);
    }
}

void shader_print_scan(const struct shader_sink *sink, const struct shader_program *program, uint32_t value)
{
    const struct shader_node *const node = &program->nodes[value];
    const uint32_t operation = node->immediate & 15, reach = node->immediate >> SHADER_SCAN_REACH_SHIFT & 3;
    const uint32_t cluster = 1u << (node->immediate >> SHADER_SCAN_CLUSTER_SHIFT & 3);
    static const char *const reaches[] = {"", "inclusive ", "exclusive ", ""};
    shader_sink_print(sink, "scan_%s %sof %u lanes ",
                      name_of(scan_names, sizeof scan_names / sizeof *scan_names, operation), reaches[reach],
                      (unsigned)cluster);
    shader_print_value(sink, program, node->operands[0], SHADER_NUMBER_EITHER);
}
