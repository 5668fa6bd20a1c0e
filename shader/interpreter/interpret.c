// SPDX-License-Identifier: MIT
// The interpreter, compiled for every instruction set.
#include "interpret.h"

#include "kernel_arithmetic.h"
#include "kernel_image.h"
#include "kernel_input.h"
#include "kernel_own.h"
#include "kernel_subgroup.h"

#define ENTRY(name)                                [SHADER_##name] = run_##name
#define ONE(name, result, operand, function)       ENTRY(name),
#define TWO(name, result, first, second, function) ENTRY(name),
static shader_kernel *const kernels[SHADER_COUNT_OPS] = {
#include "form/function.inc"
    ENTRY(COPY),
    ENTRY(SET),
    ENTRY(FADD),
    ENTRY(FSUB),
    ENTRY(FMUL),
    ENTRY(FDIV),
    ENTRY(FMIN),
    ENTRY(FMAX),
    ENTRY(FSQRT),
    ENTRY(FLOOR),
    ENTRY(CEIL),
    ENTRY(TRUNC),
    ENTRY(ROUND_EVEN),
    ENTRY(FEQUAL),
    ENTRY(FLESS),
    ENTRY(FLESS_EQUAL),
    ENTRY(IADD),
    ENTRY(ISUB),
    ENTRY(IMUL),
    ENTRY(AND),
    ENTRY(OR),
    ENTRY(XOR),
    ENTRY(NOT),
    ENTRY(SHIFT_LEFT),
    ENTRY(SHIFT_RIGHT),
    ENTRY(SHIFT_RIGHT_SIGNED),
    ENTRY(IEQUAL),
    ENTRY(ILESS),
    ENTRY(ULESS),
    ENTRY(SELECT),
    ENTRY(MUL_ADD),
    ENTRY(MUL_SUB),
    ENTRY(SUB_MUL),
    ENTRY(FLOAT_FROM_INT),
    ENTRY(INT_FROM_FLOAT),
    ENTRY(INPUT),
    ENTRY(BUILT_IN),
    ENTRY(OUTPUT),
    ENTRY(DISCARD),
    ENTRY(LOAD),
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
    [SHADER_LOOP] = run_REGION,
    [SHADER_FILL] = run_FILL,
    [SHADER_LOAD_PRIVATE] = run_LOAD_PRIVATE,
    [SHADER_STORE_PRIVATE] = run_STORE_PRIVATE,
    [SHADER_LOAD_TABLE] = run_LOAD_TABLE,
    ENTRY(BUFFER),
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
    [SHADER_PUSH] = run_NOTHING,
    ENTRY(WORKGROUP),
    [SHADER_BARRIER] = run_NOTHING,
    ENTRY(ATOMIC),
    ENTRY(IMAGE_ATOMIC),
    ENTRY(BALLOT),
    ENTRY(SHUFFLE),
    ENTRY(SCAN),
};
#undef ENTRY
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
        kernels[in->op](frame, in);
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
