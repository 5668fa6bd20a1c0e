// SPDX-License-Identifier: MIT
// Gives the translator hostile SPIR-V modules, and runs what it takes: each is refused with one line, or translated,
// linked and run on a small target, in bounded time. What a compute shader leaves in its buffers is the same by the
// instruction set of this machine and by the baseline. A sanitizer sees what goes wrong. Modules that are taken become
// seeds, so that changes add up. The same seed makes the same modules.
//
//   fuzz_spirv COUNT SEED FOLDER        COUNT mutations of the *.spv files of a folder
//   fuzz_spirv replay FILE...           the files as they are
//
// A module that breaks a promise is what is left in the file hostile.spv of the working folder.
#include <dirent.h>
#include <fcntl.h>
#include <rhw/bind.h>
#include <rhw/rhw.h>
#include <rhw/spirv.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

#include "spirv_mutation.h"

enum {
    POOL = 512, // modules that others are made of
    LANES = 8,
    SIZE = 8, // of the target, and invocations of a dispatch in x
    MAX_ELEMENTS = 64,
    TIME_LIMIT = 20, // seconds for a module
    SLOW = 2         // seconds that are too long for one
};

struct fuzz {
    rhw_context *context;
    rhw_context *baseline; // of the instruction set that every machine has
    rhw_texture target, texture;
    rhw_sampler sampler;
    rhw_buffer vertices;
    rhw_shader *vertex, *fragment; // partners that fit many modules
    struct spirv_words *pool[POOL];
    uint32_t pool_count;
    uint32_t *shown; // the file of the module under way, mapped
    uint32_t translated, linked, ran;
    struct timespec deadline;
    uint32_t memory[1024];
    uint32_t
        constants[1024]; // of uniform buffers and push constants, which a shader may take to stay as they are
};

static _Noreturn void die(const char *what, const char *name)
{
    fprintf(stderr, "fuzz_spirv: %s %s\n", what, name);
    exit(2);
}

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

// What modules find ----------------------------------------------------------------------------------

static void ignore_misuse(void *user, const char *message)
{
    (void)user;
    (void)message;
}

static bool goes_on(void *user)
{
    return seconds() < *(const double *)user;
}

static double give_up_at;

static void open_context(struct fuzz *fuzz)
{
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = 1;
    def.assert_ = ignore_misuse;
    def.validate = RHW_VALIDATE_OFF;
    const struct rhw_texture_def target = {.format = RHW_FORMAT_RGBA32_FLOAT, .width = SIZE, .height = SIZE};
    const struct rhw_texture_def texture = {
        .format = RHW_FORMAT_RGBA8_UNORM, .width = 4, .height = 4, .mip_levels = 3};
    const struct rhw_sampler_def sampler = rhw_sampler_def_default();
    static const float positions[3][4] = {{-1, -1, 0, 1}, {3, -1, 0, 1}, {-1, 3, 0, 1}};
    const struct rhw_buffer_def vertices = {.data = positions, .size = sizeof positions};
    if (rhw_context_create(&def, &fuzz->context) != RHW_OK ||
        rhw_texture_create(fuzz->context, &target, &fuzz->target) != RHW_OK ||
        rhw_texture_create(fuzz->context, &texture, &fuzz->texture) != RHW_OK ||
        rhw_sampler_create(fuzz->context, &sampler, &fuzz->sampler) != RHW_OK ||
        rhw_buffer_create(fuzz->context, &vertices, &fuzz->vertices) != RHW_OK) {
        die("no context", "");
    }
    rhw_context_set_goes_on(fuzz->context, goes_on, &give_up_at);
    def.isa_limit = RHW_ISA_UP_TO_BASELINE;
    if (rhw_context_create(&def, &fuzz->baseline) != RHW_OK) {
        die("no context", "");
    }
    rhw_context_set_goes_on(fuzz->baseline, goes_on, &give_up_at);
}

static void fill_binding(struct fuzz *fuzz, enum rhw_shader_resource_kind kind, struct rhw_binding *binding)
{
    switch (kind) {
    case RHW_SHADER_UNIFORM_BUFFER:
    case RHW_SHADER_STORAGE_BUFFER:
        (void)rhw_binding_of_memory(kind == RHW_SHADER_UNIFORM_BUFFER ? fuzz->constants : fuzz->memory, 256,
                                    kind == RHW_SHADER_UNIFORM_BUFFER, binding);
        break;
    case RHW_SHADER_SAMPLER: (void)rhw_binding_of_sampler(fuzz->context, fuzz->sampler, binding); break;
    case RHW_SHADER_STORAGE_IMAGE:
        (void)rhw_binding_of_image(fuzz->context, fuzz->texture, 0, false, binding);
        break;
    case RHW_SHADER_TEXEL_BUFFER:
        (void)rhw_binding_of_texel_memory(RHW_ISA_BASELINE, fuzz->memory, 256, RHW_FORMAT_R32_UINT, false,
                                          binding);
        break;
    default: (void)rhw_binding_of_texture(fuzz->context, fuzz->texture, fuzz->sampler, binding); break;
    }
}

// Bind what a shader names, and now and then something else or nothing. Return false where it asks for too much.
static bool bind(struct fuzz *fuzz, const rhw_shader_program *program, const rhw_shader *shader,
                 struct rhw_shader_frame *frame)
{
    const struct rhw_shader_info *const info = rhw_shader_get_info(shader);
    const uint32_t odd = fuzz->linked % 8;
    if (odd == 7) {
        return true;
    }
    for (uint32_t set = 0; set < RHW_SHADER_MAX_SETS; set++) {
        const uint32_t size = rhw_shader_program_set_size(program, set);
        if (size > 4096) {
            return false;
        }
        if (size > 0 && !frame->sets[set]) {
            frame->sets[set] = calloc(size, sizeof(struct rhw_binding));
        }
    }
    for (uint32_t r = 0; r < info->resource_count; r++) {
        const struct rhw_shader_resource *const resource = &info->resources[r];
        const int first = rhw_shader_program_find(program, resource->set, resource->binding);
        for (uint32_t i = 0; first >= 0 && i < resource->count && i < MAX_ELEMENTS; i++) {
            const uint32_t kind = resource->kind + (odd == 6 ? fuzz->linked / 8 : 0);
            fill_binding(fuzz, (enum rhw_shader_resource_kind)(kind % (RHW_SHADER_INPUT_ATTACHMENT + 1)),
                         (struct rhw_binding *)frame->sets[resource->set] + first + i);
        }
    }
    return true;
}

// Running --------------------------------------------------------------------------------------------

static bool is_nan(uint32_t bits)
{
    return (bits & 0x7fffffff) > 0x7f800000;
}

static void dispatch(struct fuzz *fuzz, const rhw_shader_program *program,
                     const struct rhw_shader_frame *frame, bool is_compared)
{
    const struct rhw_dispatch_def def = {.program = *rhw_shader_program_get_compute(program),
                                         .uniforms = frame,
                                         .uniform_bytes = sizeof *frame};
    uint32_t before[sizeof fuzz->memory / 4], after[sizeof fuzz->memory / 4];
    memcpy(before, fuzz->memory, sizeof before);
    const enum rhw_result result = rhw_dispatch(fuzz->context, &def, 2, 1, 1);
    if (!is_compared) {
        return;
    }
    memcpy(after, fuzz->memory, sizeof after);
    memcpy(fuzz->memory, before, sizeof before);
    if (result != RHW_OK || rhw_dispatch(fuzz->baseline, &def, 2, 1, 1) != RHW_OK) {
        return;
    }
    for (size_t i = 0; i < sizeof after / 4; i++) {
        // Which NaN comes of an operation is not said.
        if (after[i] != fuzz->memory[i] && !(is_nan(after[i]) && is_nan(fuzz->memory[i]))) {
            fprintf(stderr, "fuzz_spirv: word %zu is %08x, and %08x by the baseline\n", i, (unsigned)after[i],
                    (unsigned)fuzz->memory[i]);
            abort();
        }
    }
}

static bool has_images(const rhw_shader *shader)
{
    const struct rhw_shader_info *const info = rhw_shader_get_info(shader);
    bool result = false;
    for (uint32_t r = 0; r < info->resource_count; r++) {
        result = result || info->resources[r].kind > RHW_SHADER_STORAGE_BUFFER;
    }
    return result;
}

static void draw(struct fuzz *fuzz, const rhw_shader_program *program, const struct rhw_shader_frame *frame)
{
    struct rhw_pipeline_def def = rhw_pipeline_def_default();
    rhw_pipeline pipeline;
    rhw_pass pass;
    def.program = *rhw_shader_program_get(program);
    for (int i = 0; i < RHW_MAX_ATTRIBUTES; i++) {
        def.attributes[i] = (struct rhw_attribute){RHW_VERTEX_FLOAT4, 0, 0};
    }
    def.attribute_count = RHW_MAX_ATTRIBUTES;
    def.buffers[0].stride = 16;
    def.buffer_count = 1;
    def.target_count = 1;
    def.targets[0].format = RHW_FORMAT_RGBA32_FLOAT;
    const struct rhw_pass_def begin = {.colors = {{.texture = fuzz->target}}, .color_count = 1};
    if (rhw_pipeline_create(fuzz->context, &def, &pipeline) != RHW_OK) {
        return;
    }
    if (rhw_pass_begin(fuzz->context, &begin, &pass) == RHW_OK) {
        rhw_pass_set_pipeline(fuzz->context, pass, pipeline);
        rhw_pass_set_vertex_buffer(fuzz->context, pass, 0, fuzz->vertices, 0);
        rhw_pass_set_uniforms(fuzz->context, pass, frame, sizeof *frame);
        rhw_pass_draw(fuzz->context, pass, 0, 3, 0, 1);
        (void)rhw_pass_end(fuzz->context, pass, NULL);
    }
    rhw_pipeline_destroy(fuzz->context, pipeline);
}

static void check_message(const char *message, enum rhw_result result)
{
    if (!message[0] || strchr(message, '\n')) {
        fprintf(stderr, "fuzz_spirv: result %d with the message \"%s\"\n", (int)result, message);
        abort();
    }
}

// Write a program as C. What is linked is written, or refused in one line.
static void write_c(const rhw_shader_program *program)
{
    const struct rhw_shader_c_def def = {.name = "fuzz"};
    char message[RHW_SHADER_MESSAGE], *text;
    const enum rhw_result result = rhw_shader_program_emit_c(program, &def, &text, message);
    if (result != RHW_OK) {
        check_message(message, result);
    }
    rhw_shader_free_text(text);
}

// Machine code takes one group of 8 invocations after the other, and the interpreter does each instruction for many. Of
// modules that write where others read both are right, so what they leave is compared within a group alone.
static bool has_one_group(const rhw_shader *shader)
{
    const uint32_t *const size = rhw_shader_get_info(shader)->size;
    return (uint64_t)size[0] * size[1] * size[2] <= LANES;
}

static void run(struct fuzz *fuzz, const rhw_shader *shader, enum rhw_shader_stage stage, bool is_interpreted)
{
    const rhw_shader *const vertex = stage == RHW_SHADER_VERTEX ? shader : fuzz->vertex;
    const rhw_shader *const fragment = stage == RHW_SHADER_FRAGMENT ? shader : fuzz->fragment;
    const bool is_compute = stage == RHW_SHADER_COMPUTE;
    const struct rhw_shader_program_def def = {.vertex = is_compute ? NULL : vertex,
                                               .fragment = is_compute ? NULL : fragment,
                                               .compute = is_compute ? shader : NULL,
                                               .is_interpreted = is_interpreted};
    struct rhw_shader_frame frame = {.push_constants = fuzz->constants, .push_size = 128};
    char message[RHW_SHADER_MESSAGE];
    rhw_shader_program *program;
    const enum rhw_result result = rhw_shader_program_create(&def, &program, message);
    if (result != RHW_OK) {
        check_message(message, result);
        return;
    }
    fuzz->linked++;
    write_c(program);
    if (bind(fuzz, program, shader, &frame)) {
        fuzz->ran++;
        give_up_at = seconds() + 0.02;
        if (is_compute) {
            dispatch(fuzz, program, &frame, !has_images(shader) && (is_interpreted || has_one_group(shader)));
        } else {
            draw(fuzz, program, &frame);
        }
    }
    for (uint32_t set = 0; set < RHW_SHADER_MAX_SETS; set++) {
        free((void *)frame.sets[set]);
    }
    rhw_shader_program_destroy(program);
}

// Translate and run a module. Return true if it was translated.
static bool try(struct fuzz *fuzz, const uint32_t *words, size_t count)
{
    bool is_taken = false;
    const double begin = seconds();
    memcpy(fuzz->shown, words, count * sizeof *words);
    memset(fuzz->shown + count, 0, (SPIRV_MUTATION_ROOM - count) * sizeof *words);
    alarm(TIME_LIMIT);
    for (int stage = 0; stage < RHW_SHADER_STAGE_COUNT; stage++) {
        const struct rhw_shader_def def = {.stage = (enum rhw_shader_stage)stage};
        char message[RHW_SHADER_MESSAGE];
        rhw_shader *shader;
        const enum rhw_result result =
            rhw_shader_create(words, count * sizeof *words, &def, &shader, message);
        if (result != RHW_OK) {
            check_message(message, result);
            continue;
        }
        is_taken = true;
        fuzz->translated++;
        run(fuzz, shader, def.stage, false);
        run(fuzz, shader, def.stage, true);
        rhw_shader_destroy(shader);
    }
    if (seconds() - begin > SLOW) {
        fprintf(stderr, "fuzz_spirv: a module of %zu words took %.1f s\n", count, seconds() - begin);
        abort();
    }
    return is_taken;
}

// Modules --------------------------------------------------------------------------------------------

static bool read_module(const char *path, struct spirv_words *module)
{
    FILE *const stream = fopen(path, "rb");
    if (!stream) {
        die("cannot open", path);
    }
    module->count = fread(module->words, sizeof(uint32_t), SPIRV_MUTATION_ROOM, stream);
    fclose(stream);
    while (module->count > 5 &&
           module->words[module->count - 1] == 0) { // what follows a module that was kept
        module->count--;
    }
    return module->count >= 5;
}

static void add_to_pool(struct fuzz *fuzz, const struct spirv_words *module, uint64_t *state)
{
    uint32_t place = fuzz->pool_count;
    if (place == POOL) {
        place = spirv_pick(state, POOL);
        free(fuzz->pool[place]);
    } else {
        fuzz->pool_count++;
    }
    const size_t size = offsetof(struct spirv_words, words) + sizeof module->words + sizeof module->count;
    fuzz->pool[place] = malloc(size);
    if (!fuzz->pool[place]) {
        die("no memory", "");
    }
    memcpy(fuzz->pool[place], module, sizeof *module);
}

static int by_name(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

static rhw_shader *partner(const struct spirv_words *module, enum rhw_shader_stage stage)
{
    rhw_shader *shader;
    const struct rhw_shader_def def = {.stage = stage};
    (void)rhw_shader_create(module->words, module->count * sizeof(uint32_t), &def, &shader, NULL);
    return shader;
}

// Read the seeds in the order of their names, and try them.
static void read_seeds(struct fuzz *fuzz, const char *folder, uint64_t *state)
{
    static struct spirv_words module;
    char *names[POOL / 2];
    size_t count = 0;
    DIR *const entries = opendir(folder);
    for (struct dirent *entry; entries && (entry = readdir(entries)) != NULL;) {
        const char *const dot = strrchr(entry->d_name, '.');
        if (dot && strcmp(dot, ".spv") == 0 && count < POOL / 2) {
            char path[4096];
            snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
            names[count++] = strdup(path);
        }
    }
    if (count == 0) {
        die("no seeds in", folder);
    }
    closedir(entries);
    qsort(names, count, sizeof *names, by_name);
    for (size_t i = 0; i < count; i++) {
        if (read_module(names[i], &module)) {
            add_to_pool(fuzz, &module, state);
            if (strstr(names[i], "partner.vert")) {
                fuzz->vertex = partner(&module, RHW_SHADER_VERTEX);
            } else if (strstr(names[i], "partner.frag")) {
                fuzz->fragment = partner(&module, RHW_SHADER_FRAGMENT);
            }
        }
        free(names[i]);
    }
    for (uint32_t i = 0; i < fuzz->pool_count; i++) {
        (void)try(fuzz, fuzz->pool[i]->words, fuzz->pool[i]->count);
    }
}

static void mutate(struct fuzz *fuzz, uint32_t count, uint64_t *state)
{
    static struct spirv_words module;
    for (uint32_t i = 0; i < count; i++) {
        if (spirv_pick(state, 16) == 0) {
            spirv_generate(state, &module);
        } else {
            memcpy(&module, fuzz->pool[spirv_pick(state, fuzz->pool_count)], sizeof module);
            spirv_mutate(state, &module, fuzz->pool[spirv_pick(state, fuzz->pool_count)]);
        }
        if (try(fuzz, module.words, module.count) && module.count < 2048) {
            add_to_pool(fuzz, &module, state);
        }
    }
}

int main(int argc, char **argv)
{
    struct fuzz *const fuzz = calloc(1, sizeof *fuzz);
    if (argc < 3 || !fuzz) {
        die("usage: fuzz_spirv COUNT SEED FOLDER, or fuzz_spirv replay FILE...", "");
    }
    const int file = open("hostile.spv", O_RDWR | O_CREAT, 0600);
    const size_t size = SPIRV_MUTATION_ROOM * sizeof(uint32_t);
    void *const shown = file < 0 || ftruncate(file, (off_t)size) != 0
                            ? MAP_FAILED
                            : mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (shown == MAP_FAILED) {
        die("cannot write", "hostile.spv");
    }
    fuzz->shown = shown;
    for (uint32_t i = 0; i < sizeof fuzz->memory / 4; i++) { // floats of ordinary size
        fuzz->memory[i] = fuzz->constants[i] = 0x3e000000 + i * 0x00123457 % 0x02800000;
    }
    open_context(fuzz);
    if (strcmp(argv[1], "replay") == 0) {
        static struct spirv_words module;
        for (int i = 2; i < argc; i++) {
            if (read_module(argv[i], &module)) {
                (void)try(fuzz, module.words, module.count);
            }
        }
    } else if (argc == 4) {
        uint64_t state = strtoull(argv[2], NULL, 10);
        read_seeds(fuzz, argv[3], &state);
        mutate(fuzz, (uint32_t)strtoul(argv[1], NULL, 10), &state);
    }
    printf("%u translated, %u linked, %u run\n", fuzz->translated, fuzz->linked, fuzz->ran);
    for (uint32_t i = 0; i < fuzz->pool_count; i++) {
        free(fuzz->pool[i]);
    }
    rhw_shader_destroy(fuzz->vertex);
    rhw_shader_destroy(fuzz->fragment);
    rhw_context_destroy(fuzz->context);
    rhw_context_destroy(fuzz->baseline);
    munmap(shown, size);
    close(file);
    (void)unlink("hostile.spv");
    free(fuzz);
    return 0;
}
