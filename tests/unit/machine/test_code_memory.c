// SPDX-License-Identifier: MIT
// Memory of generated code: it runs, is never writable while it does, goes back to the system, and a system that refuses
// it is no failure. Children are given such systems by a filter of their calls.
#if defined(__linux__) && !defined(_GNU_SOURCE)
#define _GNU_SOURCE // for syscall
#endif
#include "machine/code_memory.h"

#include <errno.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "machine/encoder.h"
#include "rhw/spirv.h"
#include "unit.h"

// mov eax, NUMBER; ret
static void *map_number(uint8_t number)
{
    const uint8_t bytes[] = {0xb8, number, 0, 0, 0, 0xc3};
    return shader_code_map(bytes, sizeof bytes);
}

static int call(const void *code)
{
    int (*function)(void);
    memcpy(&function, &code, sizeof function);
    return function();
}

static void unmap(void *code)
{
    shader_code_unmap(code, 6);
}

static void skip_elsewhere(void)
{
    if (!shader_code_is_wanted()) {
        print_message("there is no AVX2 here\n");
        skip();
    }
}

// Code that the encoder writes: out[i] = 3 in[i] + 1 for groups of 8 floats, with labels, constants and a loop.
static void write_loop(struct shader_encoder *encoder, struct shader_memory *memory)
{
    shader_encoder_init(encoder, memory);
    const uint32_t begin = shader_label_new(encoder), end = shader_label_new(encoder);
    shader_encode(encoder, X86_TEST, X86_RDX, 0, x86_reg(X86_RDX), 0);
    shader_encode_jump_if(encoder, X86_EQUAL, end);
    shader_encode(encoder, X86_VBROADCASTSS, 12, 0, shader_pool_scalar(encoder, 0x3f800000), 0);
    shader_label_place(encoder, begin);
    shader_encode(encoder, X86_VMOVUPS, 9, 0, x86_at(X86_RSI, 0), 0);
    shader_encode(encoder, X86_VMULPS, 9, 9, shader_pool_splat(encoder, 0x40400000), 0);
    shader_encode(encoder, X86_VADDPS, 9, 9, x86_reg(12), 0);
    shader_encode(encoder, X86_VMOVUPS_STORE, 9, 0, x86_at(X86_RDI, 0), 0);
    shader_encode(encoder, X86_ADD_I | X86_WIDE, 0, 0, x86_reg(X86_RSI), 32);
    shader_encode(encoder, X86_ADD_I | X86_WIDE, 0, 0, x86_reg(X86_RDI), 32);
    shader_encode(encoder, X86_SUB_I, 0, 0, x86_reg(X86_RDX), 1);
    shader_encode_jump_if(encoder, X86_NOT_EQUAL, begin);
    shader_label_place(encoder, end);
    shader_encode(encoder, X86_VZEROUPPER | X86_NARROW, 0, 0, x86_reg(0), 0);
    shader_encode(encoder, X86_RET, 0, 0, x86_reg(0), 0);
    shader_encoder_finish(encoder);
}

static void test_code_of_the_encoder_runs(void **state)
{
    (void)state;
    skip_elsewhere();
    struct shader_memory memory;
    struct shader_encoder encoder;
    void (*function)(float *out, const float *in, int groups);
    float in[24], out[24];
    shader_memory_init(&memory, (size_t)1 << 20);
    if (setjmp(memory.end) != 0) {
        fail_msg("%s", memory.message);
    }
    write_loop(&encoder, &memory);
    void *const code = shader_code_map(encoder.bytes, encoder.size);
    assert_non_null(code);
    memcpy(&function, &code, sizeof function);
    for (int i = 0; i < 24; i++) {
        in[i] = (float)i;
        out[i] = -1.0f;
    }
    function(out, in, 0);
    assert_true(out[0] == -1.0f);
    function(out, in, 3);
    for (int i = 0; i < 24; i++) {
        assert_true(out[i] == 3.0f * (float)i + 1.0f);
    }
    shader_code_unmap(code, encoder.size);
    shader_memory_free(&memory);
}

// Maps -----------------------------------------------------------------------------------------------

// Return how many mappings there are. Find the permissions of the one that has an address.
static int read_maps(const void *address, char permissions[5])
{
    char line[512];
    int count = 0;
    FILE *const maps = fopen("/proc/self/maps", "r");
    assert_non_null(maps);
    while (fgets(line, sizeof line, maps)) {
        unsigned long long first, end;
        char found[5];
        assert_int_equal(sscanf(line, "%llx-%llx %4s", &first, &end, found), 3);
        assert_false(found[1] == 'w' && found[2] == 'x');
        if ((uintptr_t)address >= first && (uintptr_t)address < end) {
            memcpy(permissions, found, sizeof found);
        }
        count++;
    }
    fclose(maps);
    return count;
}

static void test_code_is_never_writable(void **state)
{
    (void)state;
    skip_elsewhere();
    char permissions[5] = "";
    void *const code = map_number(42);
    assert_non_null(code);
    assert_int_equal(call(code), 42);
    read_maps(code, permissions);
    assert_string_equal(permissions, "r-xp");
    unmap(code);
}

static void test_memory_is_given_back(void **state)
{
    (void)state;
    char permissions[5];
    unmap(map_number(1));
    const int before = read_maps(NULL, permissions);
    for (int i = 0; i < 10000; i++) {
        void *const code = map_number(1);
        assert_non_null(code);
        unmap(code);
    }
    assert_in_range(read_maps(NULL, permissions), 1, before + 4); // others may map, too
}

// Programs -------------------------------------------------------------------------------------------

// Make a program of a compute shader that does nothing. Return it, or NULL.
static rhw_shader_program *make_program(void)
{
    static const uint32_t words[] = {
        0x07230203,
        0x00010000,
        0,
        5,
        0, // the header
        2 << 16 | 17,
        1, // OpCapability Shader
        3 << 16 | 14,
        0,
        1, // OpMemoryModel Logical GLSL450
        5 << 16 | 15,
        5,
        1,
        0x6e69616d,
        0, // OpEntryPoint GLCompute %1 "main"
        6 << 16 | 16,
        1,
        17,
        1,
        1,
        1, // OpExecutionMode %1 LocalSize 1 1 1
        2 << 16 | 19,
        2, // %2 = OpTypeVoid
        3 << 16 | 33,
        3,
        2, // %3 = OpTypeFunction %2
        5 << 16 | 54,
        2,
        1,
        0,
        3, // %1 = OpFunction %2 None %3
        2 << 16 | 248,
        4, // %4 = OpLabel
        1 << 16 | 253,
        1 << 16 | 56, // OpReturn, OpFunctionEnd
    };
    rhw_shader *shader = NULL;
    rhw_shader_program *program = NULL;
    const struct rhw_shader_def def = {.stage = RHW_SHADER_COMPUTE};
    if (rhw_shader_create(words, sizeof words, &def, &shader, NULL) == RHW_OK) {
        const struct rhw_shader_program_def linked = {.compute = shader};
        (void)rhw_shader_program_create(&linked, &program, NULL);
        rhw_shader_destroy(shader);
    }
    return program;
}

static void test_programs_give_their_code_back(void **state)
{
    (void)state;
    skip_elsewhere();
    char permissions[5];
    rhw_shader_program_destroy(make_program());
    const int before = read_maps(NULL, permissions);
    for (int i = 0; i < 1000; i++) {
        rhw_shader_program *const program = make_program();
        assert_non_null(program);
        assert_true(rhw_shader_program_is_generated(program, RHW_SHADER_COMPUTE));
        rhw_shader_program_destroy(program);
    }
    assert_in_range(read_maps(NULL, permissions), 1, before + 4);
}

// Systems that refuse --------------------------------------------------------------------------------

// Let a call fail where it asks for memory that is executed.
static void refuse_executable(unsigned number)
{
    struct sock_filter code[] = {
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, nr)),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, number, 0, 3),
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, args[2])),
        BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, PROT_EXEC, 0, 1),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EACCES),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
    };
    const struct sock_fprog program = {sizeof code / sizeof *code, code};
    if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 ||
        prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) != 0) {
        _exit(77);
    }
}

// Return 0 if code runs, 1 if the system refuses it, and 2 if it does something else.
static int try_code(void)
{
    void *const code = map_number(7);
    return !code ? 1 : shader_code_is_wanted() && call(code) != 7 ? 2 : 0;
}

// Return 0 if a program has code, 1 if the interpreter executes it, and 2 if there is no program.
static int try_program(void)
{
    const rhw_shader_program *const program = make_program();
    return !program ? 2 : rhw_shader_program_is_generated(program, RHW_SHADER_COMPUTE) ? 0 : 1;
}

// Return what a child tells for which the system refuses calls.
static int run_child(bool refuses_mapping, int (*try)(void))
{
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        refuse_executable(SYS_mprotect);
        if (refuses_mapping) {
            refuse_executable(SYS_mmap);
        }
        _exit(try());
    }
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    if (WEXITSTATUS(status) == 77) {
        print_message("calls cannot be refused here\n");
        skip();
    }
    return WEXITSTATUS(status);
}

static void test_a_system_that_refuses(void **state)
{
    (void)state;
    assert_int_equal(run_child(true, try_code), 1);
    assert_int_equal(run_child(false, try_code), 0); // a file without a name takes its place
    assert_int_equal(run_child(true, try_program), 1);
}

// Environment ----------------------------------------------------------------------------------------

static void test_code_can_be_turned_off(void **state)
{
    (void)state;
    skip_elsewhere();
    assert_int_equal(setenv("RHW_JIT", "0", 1), 0);
    assert_false(shader_code_is_wanted());
    assert_int_equal(setenv("RHW_JIT", "1", 1), 0);
    assert_true(shader_code_is_wanted());
    assert_int_equal(unsetenv("RHW_JIT"), 0);
    assert_true(shader_code_is_wanted());
}

static void test_names_for_perf(void **state)
{
    (void)state;
    char path[64], line[256] = "", second[256];
    snprintf(path, sizeof path, "/tmp/perf-%ld.map", (long)getpid());
    assert_false(shader_code_name((void *)0x1000, 32, "main"));
    assert_int_not_equal(access(path, F_OK), 0);
    assert_int_equal(setenv("RHW_PERF_MAP", "1", 1), 0);
    assert_int_equal(symlink("/tmp/rhw-no-such-file", path), 0);
    assert_false(shader_code_name((void *)0x1000, 32, "main"));
    assert_int_equal(unlink(path), 0);
    assert_true(shader_code_name((void *)0x1000, 32, "main\n2"));
    assert_true(shader_code_name((void *)0x2000, 64, "other"));
    assert_int_equal(unsetenv("RHW_PERF_MAP"), 0);
    FILE *const map = fopen(path, "r");
    assert_non_null(map);
    assert_non_null(fgets(line, sizeof line, map));
    assert_non_null(fgets(second, sizeof second, map));
    fclose(map);
    assert_int_equal(unlink(path), 0);
    assert_string_equal(line, "1000 20 main?2\n");
    assert_string_equal(second, "2000 40 other\n");
}

// Threads --------------------------------------------------------------------------------------------

static void *make_many(void *user)
{
    const uint8_t number = *(const uint8_t *)user;
    uintptr_t failed = 0;
    for (int i = 0; i < 300; i++) {
        void *const code = map_number(number);
        failed += !code || call(code) != number;
        if (code) {
            unmap(code);
        }
    }
    return (void *)failed;
}

static void test_threads_make_code(void **state)
{
    (void)state;
    skip_elsewhere();
    pthread_t threads[4];
    uint8_t numbers[4] = {11, 22, 33, 44};
    for (int i = 0; i < 4; i++) {
        assert_int_equal(pthread_create(&threads[i], NULL, make_many, &numbers[i]), 0);
    }
    for (int i = 0; i < 4; i++) {
        void *failed;
        assert_int_equal(pthread_join(threads[i], &failed), 0);
        assert_null(failed);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_code_of_the_encoder_runs), cmocka_unit_test(test_code_is_never_writable),
    cmocka_unit_test(test_memory_is_given_back),     cmocka_unit_test(test_programs_give_their_code_back),
    cmocka_unit_test(test_a_system_that_refuses),    cmocka_unit_test(test_code_can_be_turned_off),
    cmocka_unit_test(test_names_for_perf),           cmocka_unit_test(test_threads_make_code),
};

const struct unit_tests test_code_memory = UNIT_TESTS(tests, NULL, NULL);
