// SPDX-License-Identifier: MIT
// The interpreter, compiled for every instruction set.
#include "interpret.h"

#include "kernel_arithmetic.h"
#include "kernel_image.h"
#include "kernel_input.h"
#include "kernel_own.h"
#include "kernel_subgroup.h"

// The functions of an operation, by kind.
#define EACH_OF(function) function, function, function, function, function, function, function, function
#define SAME_KINDS(function)        \
    {                               \
        EACH_OF(function), function \
    }
#define UNARY_KINDS(name)                                                     \
    {                                                                         \
        run_##name##_100, run_##name##_000, [SHADER_ONCE] = run_##name##_ONCE \
    }
#define BINARY_KINDS(name)                                      \
    {                                                           \
        run_##name##_110, run_##name##_010, run_##name##_100,   \
            run_##name##_000, [SHADER_ONCE] = run_##name##_ONCE \
    }
#define TERNARY_KINDS(name)                                                                       \
    {                                                                                             \
        run_##name##_111, run_##name##_011, run_##name##_101, run_##name##_001, run_##name##_110, \
            run_##name##_010, run_##name##_100, run_##name##_000, run_##name##_ONCE               \
    }

#define SAME(name, function)                       [SHADER_##name] = SAME_KINDS(function)
#define ENTRY(name)                                SAME(name, run_##name)
#define UNARY_ENTRY(name)                          [SHADER_##name] = UNARY_KINDS(name)
#define BINARY_ENTRY(name)                         [SHADER_##name] = BINARY_KINDS(name)
#define TERNARY_ENTRY(name)                        [SHADER_##name] = TERNARY_KINDS(name)
#define ONE(name, result, operand, function)       ENTRY(name),
#define TWO(name, result, first, second, function) ENTRY(name),
static shader_kernel *const kernels[SHADER_COUNT_OPS][SHADER_KINDS] = {
#include "form/function.inc"
    [SHADER_COPY] = UNARY_KINDS(COPY),
    ENTRY(SET),
    BINARY_ENTRY(FADD),
    BINARY_ENTRY(FSUB),
    BINARY_ENTRY(FMUL),
    BINARY_ENTRY(FDIV),
    BINARY_ENTRY(FMIN),
    BINARY_ENTRY(FMAX),
    UNARY_ENTRY(FSQRT),
    UNARY_ENTRY(FLOOR),
    UNARY_ENTRY(CEIL),
    UNARY_ENTRY(TRUNC),
    UNARY_ENTRY(ROUND_EVEN),
    BINARY_ENTRY(FEQUAL),
    BINARY_ENTRY(FLESS),
    BINARY_ENTRY(FLESS_EQUAL),
    BINARY_ENTRY(IADD),
    BINARY_ENTRY(ISUB),
    BINARY_ENTRY(IMUL),
    BINARY_ENTRY(AND),
    BINARY_ENTRY(OR),
    BINARY_ENTRY(XOR),
    UNARY_ENTRY(NOT),
    BINARY_ENTRY(SHIFT_LEFT),
    BINARY_ENTRY(SHIFT_RIGHT),
    BINARY_ENTRY(SHIFT_RIGHT_SIGNED),
    BINARY_ENTRY(IEQUAL),
    BINARY_ENTRY(ILESS),
    BINARY_ENTRY(ULESS),
    TERNARY_ENTRY(SELECT),
    TERNARY_ENTRY(MUL_ADD),
    TERNARY_ENTRY(MUL_SUB),
    TERNARY_ENTRY(SUB_MUL),
    BINARY_ENTRY(IMIN),
    BINARY_ENTRY(IMAX),
    UNARY_ENTRY(FLOAT_FROM_INT),
    UNARY_ENTRY(INT_FROM_FLOAT),
    ENTRY(INPUT),
    ENTRY(BUILT_IN),
    ENTRY(OUTPUT),
    ENTRY(DISCARD),
    [SHADER_LOAD] = {EACH_OF(run_LOAD), run_LOAD_ONCE},
    ENTRY(STORE),
    ENTRY(STORE8),
    ENTRY(STORE16),
    ENTRY(LENGTH),
    ENTRY(IF),
    ENTRY(ELSE),
    ENTRY(END_IF),
    ENTRY(REGION),
    ENTRY(END_REGION),
    ENTRY(END_LOOP),
    ENTRY(LEAVE),
    ENTRY(JUMP_UNLESS),
    ENTRY(JUMP),
    SAME(LOOP, run_REGION),
    SAME(FILL, run_FILL),
    SAME(LOAD_PRIVATE, run_LOAD_PRIVATE),
    SAME(STORE_PRIVATE, run_STORE_PRIVATE),
    SAME(LOAD_TABLE, run_LOAD_TABLE),
    [SHADER_BUFFER] = UNARY_KINDS(COPY), // the number of the element
    ENTRY(SAMPLE),
    ENTRY(PART),
    ENTRY(NEEDS_GRADIENT),
    ENTRY(IMAGE_STORE),
    ENTRY(INPUT_DX),
    ENTRY(INPUT_DY),
    ENTRY(INPUT_BESIDE),
    ENTRY(INPUT_BELOW),
    ENTRY(INPUT_AT),
    ENTRY(SAMPLE_X),
    ENTRY(SAMPLE_Y),
    SAME(PUSH, run_NOTHING),
    ENTRY(WORKGROUP),
    SAME(BARRIER, run_NOTHING),
    ENTRY(ATOMIC),
    ENTRY(IMAGE_ATOMIC),
    ENTRY(BALLOT),
    ENTRY(SHUFFLE),
    ENTRY(SCAN),
};
#undef EACH_OF
#undef SAME_KINDS
#undef UNARY_KINDS
#undef BINARY_KINDS
#undef TERNARY_KINDS
#undef SAME
#undef ENTRY
#undef UNARY_ENTRY
#undef BINARY_ENTRY
#undef TERNARY_ENTRY
#undef ONE
#undef TWO

// Execute the shader for the groups of a frame whose lanes are active by now.
static void execute(struct frame *frame)
{
    const struct shader_bytecode *const bytecode = frame->bytecode;
    union vector *const uniform = frame->registers + bytecode->first_uniform;
    for (uint32_t i = 0; i < bytecode->constant_count; i++) {
        uniform[i].i = rhw_splat_int((int32_t)bytecode->constants[i]);
    }
    memset(own_memory(frame), 0,
           (size_t)bytecode->private_count * bytecode->batch * sizeof *frame->registers);
    struct group_range outer[SHADER_MAX_DEPTH];
    frame->outer = outer;
    frame->range = (struct group_range){0, frame->groups};
    frame->next = bytecode->code;
    while (frame->next->op != SHADER_END) {
        const struct shader_instruction *const in = frame->next++;
        kernels[in->op][in->kind](frame, in);
    }
}

// Make lanes active, and no lane killed.
static void begin_lanes(struct frame *frame, int group, rhw_int mask)
{
    fixed_register(frame, SHADER_ACTIVE)[group].i = mask;
    fixed_register(frame, SHADER_ALIVE)[group].i = mask;
    fixed_register(frame, SHADER_KILLED)[group].i = rhw_splat_int(0);
}

void RHW_ISA_NAME(shader_interpret_vertices)(struct rhw_vertex *groups, int count)
{
    union vector registers[SHADER_REGISTER_VECTORS];
    rhw_float texels[RHW_MAX_WORKGROUP_GROUPS][4];
    const struct shader_bytecode *const bytecode = ((const struct shader_stages *)groups[0].user)->vertex;
    for (int first = 0; first < count; first += (int)bytecode->batch) {
        const int left = count - first;
        struct frame frame = {.registers = registers,
                              .texels = texels,
                              .bytecode = bytecode,
                              .bound = groups[0].uniforms,
                              .bindings = groups[0].bindings,
                              .groups = left < (int)bytecode->batch ? left : (int)bytecode->batch,
                              .vertices = groups + first};
        for (int i = 0; i < frame.groups; i++) {
            begin_lanes(&frame, i, frame.vertices[i].mask);
        }
        execute(&frame);
    }
}

void RHW_ISA_NAME(shader_interpret_fragments)(struct rhw_fragment *groups, int count)
{
    union vector registers[SHADER_REGISTER_VECTORS];
    rhw_float texels[RHW_MAX_WORKGROUP_GROUPS][4];
    const struct shader_bytecode *const bytecode = ((const struct shader_stages *)groups[0].user)->fragment;
    for (int first = 0; first < count; first += (int)bytecode->batch) {
        const int left = count - first;
        struct frame frame = {.registers = registers,
                              .texels = texels,
                              .bytecode = bytecode,
                              .bound = groups[0].uniforms,
                              .bindings = groups[0].bindings,
                              .groups = left < (int)bytecode->batch ? left : (int)bytecode->batch,
                              .fragments = groups + first};
        for (int i = 0; i < frame.groups; i++) {
            begin_lanes(&frame, i, frame.fragments[i].mask);
        }
        execute(&frame);
        for (int i = 0; i < frame.groups; i++) {
            frame.fragments[i].mask &= ~fixed_register(&frame, SHADER_KILLED)[i].i;
        }
    }
}

void RHW_ISA_NAME(shader_interpret_workgroup)(struct rhw_workgroup *workgroup)
{
    union vector few[SHADER_REGISTER_VECTORS];
    rhw_float texels[RHW_MAX_WORKGROUP_GROUPS][4];
    const struct shader_bytecode *const bytecode = ((const struct shader_stages *)workgroup->user)->compute;
    struct frame frame = {.registers = bytecode->invocation_size > 0 ? workgroup->memory : few,
                          .texels = texels,
                          .bytecode = bytecode,
                          .bound = workgroup->uniforms,
                          .bindings = workgroup->bindings,
                          .workgroup = workgroup};
    (void)rhw_binding_of_memory(workgroup->shared, bytecode->workgroup_size, false, &frame.shared);
    for (int first = 0; first < workgroup->count && !frame.is_given_up; first += (int)bytecode->batch) {
        const int left = workgroup->count - first;
        frame.groups = left < (int)bytecode->batch ? left : (int)bytecode->batch;
        frame.invocations = workgroup->groups + first;
        for (int i = 0; i < frame.groups; i++) {
            begin_lanes(&frame, i, frame.invocations[i].mask);
        }
        execute(&frame);
    }
}
