// SPDX-License-Identifier: MIT
// See print.h.
#include "print.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void shader_sink_print(const struct shader_sink *sink, const char *format, ...)
{
    char text[512];
    va_list arguments;
    va_start(arguments, format);
    const int length = vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    const size_t size = (size_t)length < sizeof text ? (size_t)length : sizeof text - 1;
    for (size_t i = 0; i < size; i++) {
        const unsigned char c = (unsigned char)text[i];
        text[i] = c == '\t' ? ' ' : (c < ' ' && c != '\n') || c == 0x7f ? '?' : text[i];
    }
    sink->write(sink->user, text, size);
}

// Numbers --------------------------------------------------------------------------------------------

// Print the fewest digits that are read as the float again, and always a point or an exponent.
static void print_float(const struct shader_sink *sink, uint32_t bits)
{
    char text[32];
    float number, again = 0;
    memcpy(&number, &bits, sizeof number);
    for (int digits = 1; digits <= 9; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, (double)number);
        if (sscanf(text, "%f", &again) == 1 && memcmp(&again, &number, sizeof number) == 0) {
            break;
        }
    }
    shader_sink_print(sink, "%s%s", text, strpbrk(text, ".en") ? "" : ".0");
}

void shader_print_number(const struct shader_sink *sink, uint32_t bits, enum shader_number_style style)
{
    const uint32_t exponent = bits >> 23 & 0xff;
    const bool seems_float = exponent > 0x60 && exponent < 0x9f;
    const int32_t whole = (int32_t)bits;
    if (style == SHADER_NUMBER_FLOAT || (style == SHADER_NUMBER_EITHER && seems_float)) {
        print_float(sink, bits);
    } else if (whole > -0x10000 && whole < 0x10000) {
        shader_sink_print(sink, "%d", (int)whole);
    } else {
        shader_sink_print(sink, "0x%x", (unsigned)bits);
    }
}

enum shader_number_style shader_print_style(enum shader_op op, int operand)
{
    switch (op) {
    case SHADER_SET:
    case SHADER_COPY:
    case SHADER_OUTPUT: return SHADER_NUMBER_EITHER;
    case SHADER_SELECT:
    case SHADER_STORE: return operand == 0 ? SHADER_NUMBER_INT : SHADER_NUMBER_EITHER;
    case SHADER_LDEXP: return operand == 0 ? SHADER_NUMBER_FLOAT : SHADER_NUMBER_INT;
    case SHADER_INT_FROM_FLOAT:
    case SHADER_UINT_FROM_FLOAT:
    case SHADER_PACK_HALVES:
    case SHADER_FREXP_FRACTION:
    case SHADER_FREXP_EXPONENT:
    case SHADER_DDX:
    case SHADER_DDY: return SHADER_NUMBER_FLOAT;
    default: break;
    }
    return (op >= SHADER_FADD && op <= SHADER_FLESS_EQUAL) || (op >= SHADER_SIN && op <= SHADER_RSQRT)
               ? SHADER_NUMBER_FLOAT
               : SHADER_NUMBER_INT;
}

// Lines ----------------------------------------------------------------------------------------------

struct printer {
    const struct shader_sink *sink;
    const struct shader_program *program;
};

static void print_result(const struct printer *printer, uint32_t value)
{
    const struct shader_node *const node = &printer->program->nodes[value];
    if (node->op == SHADER_HOME) {
        shader_sink_print(printer->sink, "h%u", (unsigned)value);
        shader_print_home(printer->sink, printer->program, value);
        return;
    }
    const bool is_flow = shader_op_kind_of((enum shader_op)node->op) == SHADER_KIND_FLOW;
    shader_sink_print(printer->sink, "%c%u", !is_flow && (node->flags & SHADER_UNIFORM) ? 'u' : 'v',
                      (unsigned)value);
}

static void print_value(const struct printer *printer, uint32_t value, enum shader_number_style style)
{
    const struct shader_node *const node = &printer->program->nodes[value];
    if (node->op == SHADER_CONSTANT) {
        shader_print_number(printer->sink, node->immediate, style);
    } else if (node->op == SHADER_PRIVATE || node->op == SHADER_TABLE) {
        shader_sink_print(printer->sink, "%s%u", node->op == SHADER_PRIVATE ? "private" : "table",
                          (unsigned)node->immediate);
    } else {
        print_result(printer, value);
    }
}

void shader_print_value(const struct shader_sink *sink, const struct shader_program *program, uint32_t value,
                        enum shader_number_style style)
{
    print_value(&(struct printer){.sink = sink, .program = program}, value, style);
}

static void print_operation_name(const struct printer *printer, enum shader_op op)
{
    char name[32];
    size_t length = 0;
    for (const char *c = shader_op_name(op); *c != '\0' && length + 1 < sizeof name; c++) {
        name[length++] = (char)(*c >= 'A' && *c <= 'Z' ? *c - 'A' + 'a' : *c);
    }
    name[length] = '\0';
    shader_sink_print(printer->sink, "%s", name);
}

// Print the place in a buffer: "u3[u4 + 16]".
static void print_place(const struct printer *printer, const struct shader_node *node)
{
    const struct shader_node *const offset = &printer->program->nodes[node->operands[1]];
    print_value(printer, node->operands[0], SHADER_NUMBER_INT);
    if (offset->op == SHADER_CONSTANT) {
        shader_sink_print(printer->sink, "[%u]", (unsigned)(offset->immediate + node->immediate));
        return;
    }
    shader_sink_print(printer->sink, "[");
    print_result(printer, node->operands[1]);
    if (node->immediate != 0) {
        shader_sink_print(printer->sink, " + %u", (unsigned)node->immediate);
    }
    shader_sink_print(printer->sink, "]");
}

// Operands of an image operation that it may do without.
struct image_part {
    uint32_t flag;
    const char *name;
    int first, count; // a count of 0: as many as there are spatial coordinates
    enum shader_number_style style;
};

static void print_image_parts(const struct printer *printer, const struct shader_node *node,
                              const uint32_t *operands)
{
    static const struct image_part parts[] = {
        {SHADER_IMAGE_HAS_REFERENCE, "reference", SHADER_IMAGE_REFERENCE, 1, SHADER_NUMBER_FLOAT},
        {SHADER_IMAGE_HAS_BIAS, "bias", SHADER_IMAGE_BIAS, 1, SHADER_NUMBER_FLOAT},
        {SHADER_IMAGE_HAS_LOD, "lod", SHADER_IMAGE_LOD, 1, SHADER_NUMBER_EITHER},
        {SHADER_IMAGE_HAS_GRADIENT, "dx", SHADER_IMAGE_DX, 0, SHADER_NUMBER_FLOAT},
        {SHADER_IMAGE_HAS_GRADIENT, "dy", SHADER_IMAGE_DY, 0, SHADER_NUMBER_FLOAT},
        {SHADER_IMAGE_HAS_OFFSET, "offset", SHADER_IMAGE_OFFSET, 0, SHADER_NUMBER_INT},
        {SHADER_IMAGE_HAS_LEAST_LOD, "least_lod", SHADER_IMAGE_LEAST_LOD, 1, SHADER_NUMBER_FLOAT},
        {SHADER_IMAGE_HAS_SAMPLE, "sample", SHADER_IMAGE_SAMPLE, 1, SHADER_NUMBER_INT},
    };
    const int spatial = (int)(node->immediate >> SHADER_IMAGE_SPATIAL_SHIFT & 3);
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        const struct image_part *const part = &parts[i];
        if ((node->immediate & part->flag) == 0) {
            continue;
        }
        shader_sink_print(printer->sink, ", %s", part->name);
        for (int c = 0; c < (part->count == 0 ? spatial : part->count); c++) {
            shader_sink_print(printer->sink, " ");
            print_value(printer, operands[part->first + c], part->style);
        }
    }
}

static void print_image(const struct printer *printer, uint32_t value)
{
    static const char *const names[] = {"sample",  "fetch",     "gather",     "size",      "levels",
                                        "samples", "query_lod", "load_image", "image_size"};
    struct shader_node *const node = &printer->program->nodes[value];
    const bool stores = node->op == SHADER_IMAGE_STORE;
    const uint32_t operation = node->immediate & 15;
    uint32_t count;
    const uint32_t *const operands = shader_operands(printer->program, node, &count);
    const bool is_named = !stores && operation < sizeof names / sizeof *names;
    shader_sink_print(printer->sink, "%s ", stores ? "store_image" : is_named ? names[operation] : "image");
    print_result(printer, operands[SHADER_IMAGE_TEXTURE]);
    if (node->immediate & SHADER_IMAGE_HAS_SAMPLER) {
        shader_sink_print(printer->sink, " by ");
        print_result(printer, operands[SHADER_IMAGE_SAMPLER]);
    }
    const uint32_t coordinates = (node->immediate >> SHADER_IMAGE_SPATIAL_SHIFT & 3) +
                                 ((node->immediate & SHADER_IMAGE_IS_ARRAYED) ? 1 : 0);
    const bool asks = !stores && (operation == SHADER_DO_IMAGE_SIZE ||
                                  (operation >= SHADER_DO_SIZE && operation <= SHADER_DO_SAMPLES));
    for (uint32_t i = 0; !asks && i < coordinates; i++) {
        shader_sink_print(printer->sink, i == 0 ? " at " : " ");
        print_value(printer, operands[SHADER_IMAGE_COORDINATES + i], SHADER_NUMBER_EITHER);
    }
    print_image_parts(printer, node, operands);
    for (int i = 0; stores && i < 4; i++) {
        shader_sink_print(printer->sink, i == 0 ? ", texel " : " ");
        print_value(printer, operands[SHADER_IMAGE_TEXEL + i], SHADER_NUMBER_EITHER);
    }
}

static void print_plain(const struct printer *printer, struct shader_node *node)
{
    const enum shader_op op = (enum shader_op)node->op;
    uint32_t count;
    const uint32_t *const operands = shader_operands(printer->program, node, &count);
    print_operation_name(printer, op);
    if (node->immediate != 0 && shader_op_kind_of(op) != SHADER_KIND_FLOW) {
        shader_sink_print(printer->sink, " #%u", (unsigned)node->immediate);
    }
    for (uint32_t o = 0; o < count; o++) {
        shader_sink_print(printer->sink, " ");
        print_value(printer, operands[o], shader_print_style(op, (int)o));
    }
    if (op == SHADER_LEAVE) {
        shader_sink_print(printer->sink, " v%u", (unsigned)node->operands[0]);
    }
}

static void print_operation(const struct printer *printer, uint32_t value)
{
    struct shader_node *const node = &printer->program->nodes[value];
    const enum shader_op op = (enum shader_op)node->op;
    switch (op) {
    case SHADER_SAMPLE:
    case SHADER_IMAGE_STORE: print_image(printer, value); return;
    case SHADER_ATOMIC:
    case SHADER_IMAGE_ATOMIC: shader_print_atomic(printer->sink, printer->program, value); return;
    case SHADER_SCAN: shader_print_scan(printer->sink, printer->program, value); return;
    case SHADER_LOAD:
    case SHADER_STORE:
    case SHADER_STORE8:
    case SHADER_STORE16:
        print_operation_name(printer, op);
        shader_sink_print(printer->sink, " ");
        print_place(printer, node);
        if (op != SHADER_LOAD) {
            shader_sink_print(printer->sink, " ");
            print_value(printer, node->operands[2], SHADER_NUMBER_EITHER);
        }
        return;
    case SHADER_INPUT:
    case SHADER_INPUT_DX:
    case SHADER_INPUT_DY:
    case SHADER_INPUT_BESIDE:
    case SHADER_INPUT_BELOW:
        print_operation_name(printer, op);
        shader_sink_print(printer->sink, " ");
        shader_print_input(printer->sink, printer->program, node->immediate);
        return;
    case SHADER_INPUT_AT:
        shader_sink_print(printer->sink, "input_at ");
        shader_print_input(printer->sink, printer->program, node->immediate);
        for (int o = 0; o < 2; o++) {
            shader_sink_print(printer->sink, " ");
            print_value(printer, node->operands[o], SHADER_NUMBER_FLOAT);
        }
        return;
    case SHADER_BUILT_IN:
        shader_sink_print(printer->sink, "input ");
        shader_print_built_in(printer->sink, node->immediate);
        return;
    case SHADER_OUTPUT:
        shader_sink_print(printer->sink, "output ");
        shader_print_output(printer->sink, printer->program, node->immediate);
        shader_sink_print(printer->sink, " ");
        print_value(printer, node->operands[0], SHADER_NUMBER_EITHER);
        return;
    case SHADER_BUFFER:
        shader_sink_print(printer->sink, "resource ");
        shader_print_resource(printer->sink, printer->program, node->immediate);
        if (printer->program->resources[node->immediate].count != 1) {
            shader_sink_print(printer->sink, " element ");
            print_value(printer, node->operands[0], SHADER_NUMBER_INT);
        }
        return;
    case SHADER_PART:
        shader_sink_print(printer->sink, "part ");
        print_result(printer, node->operands[0]);
        shader_sink_print(printer->sink, ".%c", "xyzw"[node->immediate & 3]);
        return;
    default: print_plain(printer, node); return;
    }
}

void shader_print_node(const struct shader_sink *sink, const struct shader_program *program, uint32_t value)
{
    const struct printer printer = {.sink = sink, .program = program};
    const enum shader_op op = (enum shader_op)program->nodes[value].op;
    if (shader_op_has_result(op) || op == SHADER_REGION || op == SHADER_LOOP) {
        print_result(&printer, value);
        shader_sink_print(sink, " = ");
    }
    print_operation(&printer, value);
}

static void print_head(const struct shader_sink *sink, const struct shader_program *program)
{
    const struct shader_entry_point *const entry = program->entry;
    shader_sink_print(sink, "; %s shader %.100s, %u operations\n",
                      entry->model == SPIRV_VERTEX     ? "vertex"
                      : entry->model == SPIRV_FRAGMENT ? "fragment"
                                                       : "compute",
                      entry->name, (unsigned)program->code_count);
}

void shader_print(const struct shader_sink *sink, const struct shader_program *program)
{
    struct shader_source_lines *const lines = shader_find_source_lines(program->memory, program->module);
    int depth = 0;
    print_head(sink, program);
    for (uint32_t i = 0; i < program->code_count; i++) {
        const uint32_t value = program->code[i];
        const enum shader_op op = (enum shader_op)program->nodes[value].op;
        const bool closes =
            op == SHADER_ELSE || op == SHADER_END_IF || op == SHADER_END_REGION || op == SHADER_END_LOOP;
        const bool opens = op == SHADER_ELSE || op == SHADER_IF || op == SHADER_REGION || op == SHADER_LOOP;
        depth -= closes ? 1 : 0;
        if (lines) {
            shader_print_source_line(sink, lines, program->origins[value], 4 * depth);
        }
        shader_sink_print(sink, "%*s", 4 * depth, "");
        shader_print_node(sink, program, value);
        shader_sink_print(sink, "\n");
        depth += opens ? 1 : 0;
    }
}
