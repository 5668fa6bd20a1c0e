// SPDX-License-Identifier: MIT
// Writes modules as C, for tests that compile what is written: a vertex and a fragment shader, or a compute shader. Beside
// it stands a row for the table of emitted.c, with hashes of the modules.
// usage: emit_tool NAME OUT MODULE.STAGE.spv..., which writes OUT.c and OUT.inc
#include <rhw/spirv.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void fail(const char *file, const char *message)
{
    fprintf(stderr, "emit_tool: %s: %s\n", file, message);
    exit(1);
}

// FNV-1a, as emitted.c has it.
static uint64_t hash_bytes(const unsigned char *bytes, size_t size)
{
    uint64_t hash = 0xcbf29ce484222325;
    for (size_t i = 0; i < size; i++) {
        hash = (hash ^ bytes[i]) * 0x100000001b3;
    }
    return hash;
}

// Return NULL where the module is refused, as some of the tests want.
static rhw_shader *read_shader(const char *path, enum rhw_shader_stage stage, uint64_t *hash)
{
    static unsigned char words[1 << 22];
    FILE *const file = fopen(path, "rb");
    if (!file) {
        fail(path, "it cannot be read");
    }
    const size_t size = fread(words, 1, sizeof words, file);
    fclose(file);
    *hash = hash_bytes(words, size);
    const struct rhw_shader_def def = {.stage = stage};
    char message[RHW_SHADER_MESSAGE];
    rhw_shader *shader;
    if (rhw_shader_create(words, size, &def, &shader, message) != RHW_OK) {
        fprintf(stderr, "emit_tool: %s: %s\n", path, message);
    }
    return shader;
}

static enum rhw_shader_stage stage_of(const char *path)
{
    return strstr(path, ".vert.")   ? RHW_SHADER_VERTEX
           : strstr(path, ".frag.") ? RHW_SHADER_FRAGMENT
                                    : RHW_SHADER_COMPUTE;
}

static void write_file(const char *out, const char *ending, const char *text)
{
    char path[4096];
    snprintf(path, sizeof path, "%s%s", out, ending);
    FILE *const file = fopen(path, "wb");
    if (!file || fputs(text, file) < 0 || fclose(file) != 0) {
        fail(path, "it cannot be written");
    }
}

int main(int argc, char **argv)
{
    struct rhw_shader_program_def def = {.vertex = NULL};
    const rhw_shader **const stages[] = {&def.vertex, &def.fragment, &def.compute};
    uint64_t hashes[RHW_SHADER_STAGE_COUNT] = {0};
    char message[RHW_SHADER_MESSAGE], row[256], *text = NULL;
    rhw_shader_program *program;
    if (argc < 4) {
        fail("usage", "emit_tool NAME OUT MODULE.STAGE.spv...");
    }
    for (int i = 3; i < argc; i++) {
        const enum rhw_shader_stage stage = stage_of(argv[i]);
        *stages[stage] = read_shader(argv[i], stage, &hashes[stage]);
        if (!*stages[stage]) { // nothing is written, and nothing stands in the table
            write_file(argv[2], ".c", "#include <rhw/spirv.h>\n");
            write_file(argv[2], ".inc", "");
            return 0;
        }
    }
    const struct rhw_shader_c_def how = {.name = argv[1]};
    if (rhw_shader_program_create(&def, &program, message) != RHW_OK ||
        rhw_shader_program_emit_c(program, &how, &text, message) != RHW_OK) {
        fprintf(stderr, "emit_tool: %s: %s\n", argv[3], message);
        write_file(argv[2], ".c", "#include <rhw/spirv.h>\n");
        write_file(argv[2], ".inc", "");
        return 0;
    }
    snprintf(row, sizeof row, "%s(%s, 0x%llx, 0x%llx)\n", def.compute ? "EMITTED_COMPUTE" : "EMITTED_DRAWN",
             argv[1], (unsigned long long)(def.compute ? hashes[RHW_SHADER_COMPUTE] : hashes[0]),
             (unsigned long long)hashes[RHW_SHADER_FRAGMENT]);
    write_file(argv[2], ".c", text);
    write_file(argv[2], ".inc", row);
    rhw_shader_free_text(text);
    rhw_shader_program_destroy(program);
    for (int s = 0; s < RHW_SHADER_STAGE_COUNT; s++) {
        rhw_shader_destroy((rhw_shader *)*stages[s]);
    }
    return 0;
}
