// SPDX-License-Identifier: MIT
// Compiles random GLSL texts, and writes each as C: chunk_K.c have so many programs each, words.c the modules and the
// table that compare.c reads.
// usage: emit_many FOLDER FIRST COUNT PROGRAMS_OF_A_CHUNK VERTEX.vert
#include <glsl.h>
#include <rhw/spirv.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void fail(const char *file, const char *message)
{
    fprintf(stderr, "emit_many: %s: %s\n", file, message);
    exit(1);
}

static FILE *open_file(const char *folder, const char *name, const char *mode)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return fopen(path, mode);
}

// Compile a text. Return false where there is no such file.
static bool compile(FILE *file, const char *name, enum rhw_shader_stage stage, struct glsl_code *code)
{
    static char text[1 << 20];
    char message[RHW_SHADER_MESSAGE];
    if (!file) {
        return false;
    }
    const size_t size = fread(text, 1, sizeof text, file);
    fclose(file);
    const struct glsl_options options = {.macros = NULL};
    if (!glsl_compile(stage, text, size, name, &options, code, message, sizeof message)) {
        fail(name, message);
    }
    return true;
}

static rhw_shader *create(const struct glsl_code *code, const char *name, enum rhw_shader_stage stage)
{
    const struct rhw_shader_def def = {.stage = stage};
    char message[RHW_SHADER_MESSAGE];
    rhw_shader *shader;
    if (rhw_shader_create(code->words, code->size, &def, &shader, message) != RHW_OK) {
        fail(name, message);
    }
    return shader;
}

static void write_words(FILE *words, const char *name, const struct glsl_code *code)
{
    fprintf(words, "static const uint32_t words_%s[] = {", name);
    for (size_t i = 0; i < code->size / sizeof(uint32_t); i++) {
        fprintf(words, "0x%x,", (unsigned)code->words[i]);
    }
    fprintf(words, "};\n");
}

// Write a program to a chunk, and its words. Return whether it is compute.
static bool write_one(const char *folder, int number, const rhw_shader *vertex, FILE *chunk, FILE *words)
{
    char name[32], path[64], message[RHW_SHADER_MESSAGE], *text = NULL;
    struct glsl_code code;
    snprintf(name, sizeof name, "r%d", number);
    snprintf(path, sizeof path, "%s.comp", name);
    const bool is_compute = compile(open_file(folder, path, "rb"), path, RHW_SHADER_COMPUTE, &code);
    if (!is_compute) {
        snprintf(path, sizeof path, "%s.frag", name);
        if (!compile(open_file(folder, path, "rb"), path, RHW_SHADER_FRAGMENT, &code)) {
            fail(name, "there is no such text");
        }
    }
    rhw_shader *const shader = create(&code, path, is_compute ? RHW_SHADER_COMPUTE : RHW_SHADER_FRAGMENT);
    const struct rhw_shader_program_def def = {.vertex = is_compute ? NULL : vertex,
                                               .fragment = is_compute ? NULL : shader,
                                               .compute = is_compute ? shader : NULL};
    const struct rhw_shader_c_def how = {.name = name, .source = path};
    rhw_shader_program *program;
    if (rhw_shader_program_create(&def, &program, message) != RHW_OK ||
        rhw_shader_program_emit_c(program, &how, &text, message) != RHW_OK) {
        fail(path, message);
    }
    fputs(text, chunk);
    write_words(words, name, &code);
    rhw_shader_free_text(text);
    rhw_shader_program_destroy(program);
    rhw_shader_destroy(shader);
    glsl_code_free(&code);
    return is_compute;
}

int main(int argc, char **argv)
{
    if (argc != 6) {
        fail("usage", "emit_many FOLDER FIRST COUNT PROGRAMS_OF_A_CHUNK VERTEX.vert");
    }
    const char *const folder = argv[1];
    const int first = atoi(argv[2]), count = atoi(argv[3]), per_chunk = atoi(argv[4]);
    struct glsl_code code;
    if (!compile(fopen(argv[5], "rb"), argv[5], RHW_SHADER_VERTEX, &code)) {
        fail(argv[5], "it cannot be read");
    }
    rhw_shader *const vertex = create(&code, argv[5], RHW_SHADER_VERTEX);
    FILE *const words = open_file(folder, "words.c", "wb"), *chunk = NULL;
    bool *const is_compute = calloc((size_t)count, sizeof *is_compute);
    if (!words || !is_compute) {
        fail(folder, "it cannot be written to");
    }
    fprintf(words, "#include \"compare.h\"\n");
    write_words(words, "vertex", &code);
    for (int i = 0; i < count; i++) {
        if (i % per_chunk == 0) {
            char name[64];
            snprintf(name, sizeof name, "chunk_%d.c", i / per_chunk);
            if (chunk && fclose(chunk) != 0) {
                fail(name, "it cannot be written");
            }
            chunk = open_file(folder, name, "wb");
            // One copy is compiled, which stands for every instruction set.
            fprintf(chunk, "#include <rhw/isa.h>\n#undef RHW_ISA_TABLE\n"
                           "#define RHW_ISA_TABLE(name) {RHW_ISA_NAME(name)}\n");
        }
        is_compute[i] = write_one(folder, first + i, vertex, chunk, words);
    }
    fprintf(words,
            "const struct random_words random_vertex = {\"vertex\", words_vertex, sizeof words_vertex};\n");
    for (int i = 0; i < count; i++) {
        fprintf(words, "extern const struct %s r%d_program;\n",
                is_compute[i] ? "rhw_compute_program" : "rhw_program", first + i);
    }
    fprintf(words, "const struct random_program random_programs[] = {\n");
    for (int i = 0; i < count; i++) {
        const int number = first + i;
        fprintf(words, "{{\"r%d\", words_r%d, sizeof words_r%d}, %s&r%d_program%s},\n", number, number,
                number, is_compute[i] ? "NULL, " : "", number, is_compute[i] ? "" : ", NULL");
    }
    fprintf(words, "};\nconst int random_count = %d;\n", count);
    free(is_compute);
    rhw_shader_destroy(vertex);
    glsl_code_free(&code);
    return (chunk && fclose(chunk) != 0) || fclose(words) != 0;
}
