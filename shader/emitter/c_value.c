// SPDX-License-Identifier: MIT
// Values as expressions. A value that is read once, in the same block, stands where it is read, unless the line would
// be long.
#include "c_emit.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { LONGEST = 64 };

// How an operation is written: an operator or a function, whether it gives a float, and whether its operands are
// floats.
struct notation {
    const char *text;
    bool gives_float, takes_float[2];
};

enum { IS_FLOAT_f = true, IS_FLOAT_i = false };

#define ONE(name, result, operand, function) \
    [SHADER_##name] = {#function, IS_FLOAT_##result, {IS_FLOAT_##operand, IS_FLOAT_##operand}},
#define TWO(name, result, first, second, function) \
    [SHADER_##name] = {#function, IS_FLOAT_##result, {IS_FLOAT_##first, IS_FLOAT_##second}},
#define FLOATS(name, text, is_float) [SHADER_##name] = {text, is_float, {true, true}}
#define WHOLES(name, text, is_float) [SHADER_##name] = {text, is_float, {false, false}}
static const struct notation notations[SHADER_OP_COUNT] = {
#include "form/function.inc"
    FLOATS(FADD, "+", true),
    FLOATS(FSUB, "-", true),
    FLOATS(FMUL, "*", true),
    FLOATS(FDIV, "/", true),
    FLOATS(FMIN, "rhw_min", true),
    FLOATS(FMAX, "rhw_max", true),
    FLOATS(FSQRT, "rhw_sqrt", true),
    FLOATS(FLOOR, "rhw_floor", true),
    FLOATS(CEIL, "rhw_ceil", true),
    FLOATS(TRUNC, "rhw_trunc", true),
    FLOATS(ROUND_EVEN, "rhw_round", true),
    FLOATS(FEQUAL, "rhw_equal", false),
    FLOATS(FLESS, "rhw_less", false),
    FLOATS(FLESS_EQUAL, "rhw_less_equal", false),
    WHOLES(IADD, "rhw_spirv_add", false),
    WHOLES(ISUB, "rhw_spirv_sub", false),
    WHOLES(IMUL, "rhw_spirv_mul", false),
    WHOLES(AND, "&", false),
    WHOLES(OR, "|", false),
    WHOLES(XOR, "^", false),
    WHOLES(NOT, "~", false),
    WHOLES(SHIFT_LEFT, "rhw_spirv_shift_left", false),
    WHOLES(SHIFT_RIGHT, "rhw_spirv_shift_right", false),
    WHOLES(SHIFT_RIGHT_SIGNED, "rhw_spirv_shift_right_signed", false),
    WHOLES(IEQUAL, "rhw_equal_int", false),
    WHOLES(ILESS, "rhw_less_int", false),
    WHOLES(ULESS, "rhw_spirv_less_uint", false),
    WHOLES(FLOAT_FROM_INT, "rhw_float_from_int", true),
    FLOATS(INT_FROM_FLOAT, "rhw_int_from_float", false),
};
#undef ONE
#undef TWO
#undef FLOATS
#undef WHOLES

// Types ----------------------------------------------------------------------------------------------

// Return 1 for an operation that gives a float, 0 for one that gives an integer, −1 for one that gives either.
static int gives_float(const struct shader_node *node)
{
    switch ((enum shader_op)node->op) {
    case SHADER_CONSTANT:
    case SHADER_HOME:
    case SHADER_COPY:
    case SHADER_SELECT:
    case SHADER_LOAD: return -1;
    case SHADER_BUILT_IN:
        return (node->immediate >= SHADER_IN_COORD && node->immediate < SHADER_IN_COORD + 4) ||
               (node->immediate >= SHADER_IN_SAMPLE_POSITION &&
                node->immediate < SHADER_IN_SAMPLE_POSITION + 2) ||
               (node->immediate >= SHADER_IN_POINT_COORD && node->immediate < SHADER_IN_POINT_COORD + 2);
    case SHADER_INPUT:
    case SHADER_INPUT_DX:
    case SHADER_INPUT_DY:
    case SHADER_INPUT_BESIDE:
    case SHADER_INPUT_BELOW:
    case SHADER_INPUT_AT:
    case SHADER_SAMPLE_X:
    case SHADER_SAMPLE_Y:
    case SHADER_PART: return 1;
    default: return notations[node->op].gives_float;
    }
}

// Return true if an operation takes this operand as a float.
static bool takes_float(const struct shader_node *node, uint32_t number)
{
    const uint32_t does = node->immediate & 15;
    switch ((enum shader_op)node->op) {
    case SHADER_INPUT_AT:
    case SHADER_OUTPUT: return true;
    case SHADER_SAMPLE:
        return number >= SHADER_IMAGE_COORDINATES && number < SHADER_IMAGE_OFFSET &&
               does != SHADER_DO_FETCH && does != SHADER_DO_LOAD && does != SHADER_DO_SIZE;
    default: return number < 2 && notations[node->op].takes_float[number];
    }
}

// Note what operands are declared as because of an operation that takes them, and what follows for its own value.
static void pass_types(struct shader_emitter *emitter, uint32_t value)
{
    bool *const is_float = emitter->is_float;
    struct shader_node *const nodes = emitter->form->nodes, *const node = &nodes[value];
    const enum shader_op op = (enum shader_op)node->op;
    const bool passes_on = gives_float(node) < 0 && op != SHADER_LOAD;
    uint32_t count;
    const uint32_t *const operands = shader_operands(emitter->form, node, &count);
    for (uint32_t o = 0; o < count; o++) {
        const bool is_either = gives_float(&nodes[operands[o]]) < 0;
        const bool is_wanted = takes_float(node, o) ||
                               (passes_on && is_float[value] && (op != SHADER_SELECT || o > 0)) ||
                               (op == SHADER_SET && o == 1 && is_float[operands[0]]);
        is_float[operands[o]] = is_float[operands[o]] || (is_either && is_wanted);
    }
    if (op == SHADER_SET && nodes[operands[1]].op != SHADER_CONSTANT) {
        is_float[operands[0]] = is_float[operands[0]] || is_float[operands[1]];
    }
    const uint32_t from = op == SHADER_SELECT ? 1 : 0;
    if (passes_on && nodes[operands[from]].op != SHADER_CONSTANT) {
        is_float[value] = is_float[value] || is_float[operands[from]];
    }
}

void shader_c_find_types(struct shader_emitter *emitter)
{
    const struct shader_program *const form = emitter->form;
    emitter->is_float = shader_take(emitter->memory, form->node_count, sizeof *emitter->is_float);
    for (uint32_t value = 0; value < form->node_count; value++) {
        emitter->is_float[value] = gives_float(&form->nodes[value]) == 1;
    }
    for (int round = 0; round < 3; round++) {
        for (uint32_t i = form->code_count; i-- > 0;) {
            pass_types(emitter, form->code[i]);
        }
    }
}

// Numbers --------------------------------------------------------------------------------------------

bool shader_c_is_number(const struct shader_emitter *emitter, uint32_t value, uint32_t *bits)
{
    const struct shader_node *const node = &emitter->form->nodes[value];
    *bits = node->immediate;
    return node->op == SHADER_CONSTANT;
}

// Return a literal, or NULL for a float that has none.
static const char *literal(struct shader_emitter *emitter, uint32_t bits, bool as_float)
{
    if (!as_float) {
        return bits == 0x80000000 ? "INT32_MIN" : shader_format(emitter->memory, "%d", (int)bits);
    }
    float number;
    memcpy(&number, &bits, sizeof number);
    if (!isfinite(number)) {
        return NULL;
    }
    char digits[32];
    snprintf(digits, sizeof digits, "%.9g", (double)number);
    for (char *c = digits; *c != '\0'; c++) {
        *c = *c == ',' ? '.' : *c; // a locale may want a comma
    }
    return shader_format(emitter->memory, "%s%s", digits, strpbrk(digits, ".e") ? "f" : ".0f");
}

const char *shader_c_number(struct shader_emitter *emitter, uint32_t bits, bool as_float)
{
    const char *const text = literal(emitter, bits, as_float);
    if (!text) {
        return shader_format(emitter->memory, "rhw_float_from_bits(rhw_splat_int(%s))",
                             literal(emitter, bits, false));
    }
    return shader_format(emitter->memory, as_float ? "rhw_splat(%s)" : "rhw_splat_int(%s)", text);
}

// Operands -------------------------------------------------------------------------------------------

const char *shader_c_name(struct shader_emitter *emitter, uint32_t value)
{
    const struct shader_plan *const plan = &emitter->plan;
    const char letter = emitter->form->nodes[value].op == SHADER_HOME ? 'h'
                        : plan->is_hoisted[value]                     ? 'u'
                                                                      : 'v';
    if (plan->is_kept[value]) {
        return shader_format(emitter->memory, "%c%u[%s]", letter, (unsigned)value, emitter->group);
    }
    return shader_format(emitter->memory, "%c%u", letter, (unsigned)value);
}

// Return a value that is no number, as it is declared or written in its place.
static const char *text_of(struct shader_emitter *emitter, uint32_t value)
{
    const char *const text = emitter->inlined[value];
    return text ? text : shader_c_name(emitter, value);
}

static const char *converted(struct shader_emitter *emitter, uint32_t value, bool as_float, const char *text)
{
    if (emitter->is_float[value] == as_float) {
        return text;
    }
    return shader_format(emitter->memory, as_float ? "rhw_float_from_bits(%s)" : "rhw_bits_from_float(%s)",
                         text);
}

const char *shader_c_argument(struct shader_emitter *emitter, uint32_t value, bool as_float)
{
    uint32_t bits;
    if (shader_c_is_number(emitter, value, &bits)) {
        return shader_c_number(emitter, bits, as_float);
    }
    return converted(emitter, value, as_float, text_of(emitter, value));
}

// Return true if a text has an operator outside of brackets.
static bool is_compound(const char *text)
{
    int depth = 0;
    for (const char *c = text; *c != '\0'; c++) {
        depth += *c == '(' || *c == '[' ? 1 : *c == ')' || *c == ']' ? -1 : 0;
        if (depth == 0 && *c == ' ') {
            return true;
        }
    }
    return false;
}

const char *shader_c_operand(struct shader_emitter *emitter, uint32_t value, bool as_float)
{
    uint32_t bits;
    if (shader_c_is_number(emitter, value, &bits)) {
        const char *const text = literal(emitter, bits, as_float);
        return text ? text : shader_c_number(emitter, bits, as_float);
    }
    const char *const text = converted(emitter, value, as_float, text_of(emitter, value));
    return is_compound(text) ? shader_format(emitter->memory, "(%s)", text) : text;
}

// Operations -----------------------------------------------------------------------------------------

static const char *expression_of(struct shader_emitter *emitter, uint32_t value)
{
    struct shader_memory *const memory = emitter->memory;
    const struct shader_node *const node = &emitter->form->nodes[value];
    const enum shader_op op = (enum shader_op)node->op;
    const struct notation *const notation = &notations[op];
    const uint32_t *const operands = node->operands;
    if (op == SHADER_COPY) {
        return shader_c_argument(emitter, operands[0], emitter->is_float[value]);
    }
    if (op == SHADER_SELECT) {
        const bool is_float = emitter->is_float[value];
        return shader_format(memory, "%s(%s, %s, %s)", is_float ? "rhw_select" : "rhw_select_int",
                             shader_c_argument(emitter, operands[0], false),
                             shader_c_argument(emitter, operands[1], is_float),
                             shader_c_argument(emitter, operands[2], is_float));
    }
    const char first = notation->text[0];
    const bool is_function = first >= 'a' && first <= 'z';
    if (shader_op_operands(op) == 1) {
        return is_function ? shader_format(memory, "%s(%s)", notation->text,
                                           shader_c_argument(emitter, operands[0], notation->takes_float[0]))
                           : shader_format(memory, "%s%s", notation->text,
                                           shader_c_operand(emitter, operands[0], notation->takes_float[0]));
    }
    if (is_function) {
        return shader_format(memory, "%s(%s, %s)", notation->text,
                             shader_c_argument(emitter, operands[0], notation->takes_float[0]),
                             shader_c_argument(emitter, operands[1], notation->takes_float[1]));
    }
    // One of two numbers is written as lanes.
    uint32_t bits;
    const bool are_numbers =
        shader_c_is_number(emitter, operands[0], &bits) && shader_c_is_number(emitter, operands[1], &bits);
    const char *const left = are_numbers ? shader_c_argument(emitter, operands[0], notation->takes_float[0])
                                         : shader_c_operand(emitter, operands[0], notation->takes_float[0]);
    return shader_format(memory, "%s %s %s", left, notation->text,
                         shader_c_operand(emitter, operands[1], notation->takes_float[1]));
}

void shader_c_define(struct shader_emitter *emitter, uint32_t value, const char *expression,
                     const char *comment)
{
    const struct shader_plan *const plan = &emitter->plan;
    const char *const type = emitter->is_float[value] ? "rhw_float" : "rhw_int";
    const char *const space = comment[0] ? " // " : "";
    if (plan->is_kept[value]) {
        shader_text_line(&emitter->arrays, "%s v%u[GROUPS];", type, (unsigned)value);
        shader_text_line(emitter->out, "v%u[g] = %s;%s%s", (unsigned)value, expression, space, comment);
        return;
    }
    shader_text_line(emitter->out, "const %s %s = %s;%s%s", type, shader_c_name(emitter, value), expression,
                     space, comment);
}

// A value may stand where it is read if nothing that it reads can have changed by then.
static bool may_stand_elsewhere(const struct shader_emitter *emitter, uint32_t place, const char *expression)
{
    const struct shader_plan *const plan = &emitter->plan;
    const uint32_t value = emitter->form->code[place];
    const uint32_t reader = plan->last_use[value];
    const struct shader_node *const node = &emitter->form->nodes[value];
    const struct shader_node *const user = &emitter->form->nodes[emitter->form->code[reader]];
    if (plan->uses[value] != 1 || plan->block[reader] != plan->block[place] || plan->is_kept[value] ||
        plan->is_hoisted[value] != plan->is_hoisted[emitter->form->code[reader]] || user->op == SHADER_IF ||
        user->op == SHADER_SAMPLE || user->op == SHADER_IMAGE_STORE || user->op == SHADER_ATOMIC ||
        user->op == SHADER_BUFFER || user->op == SHADER_LOAD || strlen(expression) > LONGEST) {
        return false;
    }
    for (int o = 0; o < shader_op_operands((enum shader_op)node->op); o++) {
        if (emitter->form->nodes[node->operands[o]].op == SHADER_HOME) {
            return false;
        }
    }
    return true;
}

static const char *const scans[] = {
    [SHADER_SCAN_FADD] = "FADD",         [SHADER_SCAN_FMUL] = "FMUL",
    [SHADER_SCAN_FMIN] = "FMIN",         [SHADER_SCAN_FMAX] = "FMAX",
    [SHADER_SCAN_IADD] = "IADD",         [SHADER_SCAN_IMUL] = "IMUL",
    [SHADER_SCAN_MIN_INT] = "MIN_INT",   [SHADER_SCAN_MAX_INT] = "MAX_INT",
    [SHADER_SCAN_MIN_UINT] = "MIN_UINT", [SHADER_SCAN_MAX_UINT] = "MAX_UINT",
    [SHADER_SCAN_AND] = "AND",           [SHADER_SCAN_OR] = "OR",
    [SHADER_SCAN_XOR] = "XOR",
};

// Operations among the lanes of a group.
static bool write_subgroup(struct shader_emitter *emitter, uint32_t value)
{
    static const char *const reaches[] = {"ALL", "INCLUSIVE", "EXCLUSIVE"};
    const struct shader_node *const node = &emitter->form->nodes[value];
    const unsigned mask = emitter->mask, immediate = node->immediate;
    const char *const first = shader_c_argument(emitter, node->operands[0], false);
    const char *text;
    switch ((enum shader_op)node->op) {
    case SHADER_BALLOT:
        text = shader_format(emitter->memory, "rhw_spirv_ballot(%s, m%u)", first, mask);
        break;
    case SHADER_SHUFFLE:
        text = shader_format(emitter->memory, "rhw_spirv_shuffle(%s, %s, m%u)", first,
                             shader_c_argument(emitter, node->operands[1], false), mask);
        break;
    case SHADER_SCAN:
        text = shader_format(emitter->memory,
                             "rhw_spirv_scan(RHW_SPIRV_SCAN_%s, RHW_SPIRV_REACH_%s, %d, %s, m%u)",
                             scans[immediate & 15], reaches[immediate >> SHADER_SCAN_REACH_SHIFT & 3],
                             1 << (immediate >> SHADER_SCAN_CLUSTER_SHIFT & 3), first, mask);
        break;
    default: return false;
    }
    shader_c_define(emitter, value, text, "");
    return true;
}

void shader_c_write_value(struct shader_emitter *emitter, uint32_t place)
{
    const uint32_t value = emitter->form->code[place];
    const struct shader_node *const node = &emitter->form->nodes[value];
    const enum shader_op op = (enum shader_op)node->op;
    if (write_subgroup(emitter, value)) {
        return;
    }
    if (op != SHADER_COPY && op != SHADER_SELECT && !notations[op].text) {
        snprintf(emitter->memory->message, sizeof emitter->memory->message,
                 "the operation %s cannot be written as C", shader_op_name(op));
        shader_memory_end(emitter->memory);
    }
    const char *const expression = expression_of(emitter, value);
    if (op != SHADER_COPY && may_stand_elsewhere(emitter, place, expression)) {
        emitter->inlined[value] = expression;
        return;
    }
    shader_c_define(emitter, value, expression, "");
}
