// SPDX-License-Identifier: MIT
// The functions of tests/unit/spirv/glsl/functions.comp by librhw-shader and by the Vulkan driver of the machine: the same
// words, constants and operands. Every difference has its reason, or the test fails. It prints how many there are of each.
#include <rhw/bind.h>
#include <rhw/rhw.h>
#include <rhw/spirv.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "functions_comp.h"
#include "tolerance.h"
#include "vulkan_peer.h"

enum { ROWS = 2048, FUNCTIONS = 79, SKIPPED = 77 };

static const char *const reasons[DIFFERENCE_COUNT] = {"equal",    "precision", "sign of zero",
                                                      "denormal", "undefined", "UNEXPLAINED"};

// Numbers where something may go wrong, and between them numbers of ordinary size.
static void fill(float (*operands)[4])
{
    static const uint32_t numbers[] = {
        0x00000000, 0x80000000, 0x3f800000, 0xbf800000, 0x3f000000, 0xbf000000, 0x3fc00000, 0xc0200000,
        0x00000001, 0x807fffff, 0x00800000, 0x7f7fffff, 0x7f800000, 0xff800000, 0x7fc00000, 0x4effffff,
        0x4f000000, 0xcf000000, 0x4f800000, 0x4b000001, 0x3effffff, 0x41ffeb85, 0xc2c80001, 0x0000001f,
    };
    uint64_t state = 1;
    for (int i = 0; i < ROWS; i++) {
        for (int c = 0; c < 4; c++) {
            state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
            const uint32_t random = (uint32_t)(state >> 33);
            if (i % 2 == 0) {
                memcpy(&operands[i][c], &numbers[random % (sizeof numbers / sizeof *numbers)], sizeof(float));
            } else {
                operands[i][c] = (float)((int)(random % 20001) - 10000) / 2500.0f;
            }
        }
    }
}

static bool run_here(rhw_context *context, const struct rhw_shader_constant *constants, uint32_t count,
                     float (*operands)[4], uint32_t (*results)[4])
{
    const struct rhw_shader_def def = {
        .stage = RHW_SHADER_COMPUTE, .constants = constants, .constant_count = count};
    struct rhw_binding set[2];
    const struct rhw_shader_frame frame = {.sets = {set}};
    rhw_shader *shader;
    rhw_shader_program *program = NULL;
    bool is_done = rhw_shader_create(functions_comp, sizeof functions_comp, &def, &shader, NULL) == RHW_OK;
    const struct rhw_shader_program_def link = {.compute = shader};
    is_done = is_done && rhw_shader_program_create(&link, &program, NULL) == RHW_OK &&
              rhw_binding_of_memory(operands, ROWS * sizeof *operands, true, &set[0]) &&
              rhw_binding_of_memory(results, ROWS * sizeof *results, false, &set[1]);
    if (is_done) {
        const struct rhw_dispatch_def dispatch = {.program = *rhw_shader_program_get_compute(program),
                                                  .uniforms = &frame,
                                                  .uniform_bytes = sizeof frame};
        is_done = rhw_dispatch(context, &dispatch, ROWS / 64, 1, 1) == RHW_OK;
    }
    rhw_shader_program_destroy(program);
    rhw_shader_destroy(shader);
    return is_done;
}

// Compare a function. Return how many of its results differ without a reason.
static int compare(int which, float (*operands)[4], uint32_t (*here)[4], uint32_t (*there)[4])
{
    int counts[DIFFERENCE_COUNT] = {0}, shown = 0;
    for (int i = 0; i < ROWS; i++) {
        for (int word = 0; word < 4; word++) {
            const enum difference found =
                explain_difference(which, word, operands[i], here[i][word], there[i][word]);
            counts[found]++;
            if (found == DIFFERENCE_UNEXPLAINED && shown++ < 3) {
                printf("%s of %a, %a, %a: word %d is %08x here and %08x there\n", function_name(which),
                       (double)operands[i][0], (double)operands[i][1], (double)operands[i][2], word,
                       (unsigned)here[i][word], (unsigned)there[i][word]);
            }
        }
    }
    printf("%-30s", function_name(which));
    for (int d = 0; d < DIFFERENCE_COUNT; d++) {
        if (counts[d] > 0) {
            printf("  %s %d", reasons[d], counts[d]);
        }
    }
    printf("\n");
    return counts[DIFFERENCE_UNEXPLAINED];
}

static int compare_all(rhw_context *context, struct vulkan_peer *peer)
{
    static float operands[ROWS][4];
    static uint32_t here[ROWS][4], there[ROWS][4];
    int unexplained = 0;
    fill(operands);
    for (int which = 0; which < FUNCTIONS; which++) {
        if (!function_name(which)) {
            continue;
        }
        const struct rhw_shader_constant constants[] = {{0, (uint32_t)which}, {1, 0}};
        const struct peer_dispatch dispatch = {
            .words = functions_comp,
            .size = sizeof functions_comp,
            .buffers = {{operands, sizeof operands}, {there, sizeof there}},
            .buffer_count = 2,
            .constants = {{0, (uint32_t)which}, {1, 0}},
            .constant_count = 2,
            .groups = ROWS / 64,
        };
        memset(here, 0, sizeof here);
        memset(there, 0, sizeof there);
        if (!run_here(context, constants, 2, operands, here) || !vulkan_peer_dispatch(peer, &dispatch)) {
            printf("%s does not run\n", function_name(which));
            return 1;
        }
        unexplained += compare(which, operands, here, there);
    }
    return unexplained;
}

int main(void)
{
    struct rhw_context_def def = rhw_context_def_default();
    rhw_context *context;
    struct vulkan_peer *const peer = vulkan_peer_open();
    if (!peer) {
        printf("no Vulkan driver runs on the CPU here\n");
        return SKIPPED;
    }
    if (rhw_context_create(&def, &context) != RHW_OK) {
        return 2;
    }
    printf("%s\n", vulkan_peer_name(peer));
    const int unexplained = compare_all(context, peer);
    vulkan_peer_close(peer);
    rhw_context_destroy(context);
    return unexplained > 0 ? 1 : 0;
}
