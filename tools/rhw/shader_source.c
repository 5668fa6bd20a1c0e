// SPDX-License-Identifier: MIT
// From a file to a translated shader; see shader_job.h.
#include "file.h"
#include "shader_job.h"
#include "shader_words.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

const char *const cli_shader_stage_names[RHW_SHADER_STAGE_COUNT] = {"vertex", "fragment", "compute"};

// Reading --------------------------------------------------------------------------------------------

// Read up to the end of a stream. Return NULL, with *problem, for what cannot be read.
static char *read_stream(FILE *stream, size_t most, size_t *size, const char **problem)
{
    size_t room = 1 << 16;
    char *bytes = malloc(room + 1);
    *size = 0;
    while (bytes) {
        *size += fread(bytes + *size, 1, room - *size, stream);
        if (*size < room || *size > most) {
            break;
        }
        room *= 2;
        char *const larger = realloc(bytes, room + 1);
        if (!larger) {
            free(bytes);
        }
        bytes = larger;
    }
    *problem = !bytes ? "out of memory" : ferror(stream) ? strerror(errno) : NULL;
    if (*problem) {
        free(bytes);
        return NULL;
    }
    bytes[*size] = 0;
    return bytes;
}

char *cli_shader_read(const char *path, size_t most, size_t *size)
{
    errno = 0;
    const int descriptor = system_file_open_regular(path);
    FILE *const stream = descriptor < 0 ? NULL : fdopen(descriptor, "rb");
    if (!stream) {
        cli_error(path, "cannot be opened: %s", errno ? strerror(errno) : "it is no regular file");
        if (descriptor >= 0) {
            close(descriptor);
        }
        return NULL;
    }
    const char *problem;
    char *bytes = read_stream(stream, most, size, &problem);
    fclose(stream);
    if (!bytes) {
        cli_error(path, "cannot be read: %s", problem);
    } else if (*size > most) {
        cli_error(path, "is larger than %zu MiB", most >> 20);
        free(bytes);
        bytes = NULL;
    }
    return bytes;
}

bool cli_shader_write_bytes(const char *path, const void *bytes, size_t size)
{
    struct cli_output_file file;
    if (!cli_output_file_open(&file, path)) {
        return false;
    }
    fwrite(bytes, 1, size, file.stream);
    const bool written = cli_output_file_finish(&file) && cli_output_file_commit(&file);
    if (!written) {
        cli_output_file_discard(&file);
    }
    return written;
}

// Compiling ------------------------------------------------------------------------------------------

// Report a line of the compiler, "NAME:LINE: what is wrong".
static void report(const char *line, int length, const char *path)
{
    static const char warning[] = "warning: ";
    char subject[1024];
    const char *const colon = strstr(line, ": ");
    const bool is_split = colon && colon < line + length && colon - line < (ptrdiff_t)sizeof subject;
    snprintf(subject, sizeof subject, "%.*s", is_split ? (int)(colon - line) : (int)strlen(path),
             is_split ? line : path);
    const char *const text = is_split ? colon + 2 : line;
    const int rest = length - (int)(text - line);
    if (strncmp(text, warning, sizeof warning - 1) == 0) {
        cli_warning(subject, "%.*s", rest - (int)(sizeof warning - 1), text + sizeof warning - 1);
    } else {
        cli_error(subject, "%.*s", rest, text);
    }
}

static void report_log(const char *log, const char *path)
{
    while (*log) {
        const int length = (int)strcspn(log, "\n");
        report(log, length, path);
        log += length;
        log += *log == '\n';
    }
}

// Compile a text, which cli_shader_main_image may have changed.
static bool compile(struct cli_shader_file *file, const char *text, size_t size,
                    const struct cli_shader_job *job)
{
    char message[1024];
    struct glsl_code code;
    struct glsl_folders folders = {job->folders, (uint32_t)job->folder_count};
    const struct glsl_options options = {
        .macros = job->macros,
        .macro_count = (uint32_t)job->macro_count,
        .include = glsl_include_file,
        .user = &folders,
        .is_relaxed = job->runs || job->is_relaxed || file->main_image.text,
        .has_lines = job->print >= CLI_SHADER_FORM,
        .before = file->main_image.before,
    };
    const bool compiled =
        glsl_compile(file->stage, text, size, file->path, &options, &code, message, sizeof message);
    if (compiled || (job->all_errors && code.log && code.log[0])) {
        report_log(code.log, file->path);
    } else {
        report(message, (int)strlen(message), file->path);
    }
    const bool is_good = compiled && (!job->is_strict || code.log[0] == 0);
    file->words = code.words;
    file->size = code.size;
    file->is_relaxed = code.is_relaxed;
    file->included = code.files;
    code.words = NULL;
    code.files = NULL;
    glsl_code_free(&code);
    return is_good;
}

static bool has_ending(const char *path, const char *ending)
{
    const size_t length = strlen(path), own = strlen(ending);
    return length > own && strcasecmp(path + length - own, ending) == 0;
}

// Set what the name of a file says: whether it is a text, and of which stage.
static bool set_kind(struct cli_shader_file *file)
{
    static const char *const endings[RHW_SHADER_STAGE_COUNT] = {".vert", ".frag", ".comp"};
    for (int stage = 0; stage < RHW_SHADER_STAGE_COUNT; stage++) {
        if (has_ending(file->path, endings[stage])) {
            file->stage = (enum rhw_shader_stage)stage;
            file->is_text = true;
            return true;
        }
    }
    if (has_ending(file->path, ".spv")) {
        return true;
    }
    if (strcmp(file->path, "-") == 0) {
        cli_error("standard input",
                  "is not read: the name of a shader's file tells what it is; it ends with .vert, "
                  ".frag, .comp (GLSL) or .spv (SPIR-V)");
        return false;
    }
    cli_error(file->path, "a shader's file is named .vert, .frag, .comp (GLSL) or .spv (SPIR-V)");
    return false;
}

// Give the constants of the command line to a module, each as what it is there. They are its own from here on, also
// where it is printed or written.
static bool set_constants(struct cli_shader_file *file, struct cli_shader_job *job)
{
    const struct cli_shader_words words = cli_shader_words_of(file->words, file->size);
    for (int i = 0; i < job->constant_count; i++) {
        struct cli_shader_constant *const constant = &job->constants[i];
        const enum cli_shader_constant_kind kind = cli_shader_find_constant(&words, constant->id);
        const float number = (float)constant->number;
        uint32_t value = 0;
        if (kind == CLI_CONSTANT_ABSENT) {
            continue;
        }
        if (kind == CLI_CONSTANT_FLOAT) {
            memcpy(&value, &number, sizeof number);
        } else if (constant->number != floor(constant->number) || constant->number < INT32_MIN ||
                   constant->number > UINT32_MAX) {
            cli_error("--constant", "'%s': constant %u of %s is a whole number of 32 bits",
                      constant->argument, (unsigned)constant->id, file->path);
            return false;
        } else {
            value = (uint32_t)(int64_t)constant->number;
        }
        constant->is_used = true;
        cli_shader_set_constant(&words, constant->id, value);
    }
    return true;
}

struct rhw_shader_def cli_shader_file_def(const struct cli_shader_file *file)
{
    return (struct rhw_shader_def){.stage = file->stage, .entry_point = file->entry_point};
}

bool cli_shader_file_translate(struct cli_shader_file *file, struct cli_shader_job *job)
{
    const struct cli_shader_words words = cli_shader_words_of(file->words, file->size);
    enum rhw_shader_stage stage = file->stage;
    file->entry_point = cli_shader_find_entry(&words, job->entry_point, &stage);
    if (!file->is_text) {
        file->stage = stage;
    }
    if (!set_constants(file, job)) {
        return false;
    }
    char message[RHW_SHADER_MESSAGE];
    struct rhw_shader_def def = cli_shader_file_def(file);
    def.entry_point = file->entry_point ? file->entry_point : job->entry_point;
    if (rhw_shader_create(file->words, file->size, &def, &file->shader, message) != RHW_OK) {
        cli_error(file->path, "%s", message);
        return false;
    }
    return true;
}

bool cli_shader_file_open(struct cli_shader_file *file, const char *path, const struct cli_shader_job *job)
{
    *file = (struct cli_shader_file){.path = path, .stage = RHW_SHADER_FRAGMENT};
    size_t size;
    if (!set_kind(file)) {
        return false;
    }
    char *const bytes = cli_shader_read(path, GLSL_MAX_TEXT_SIZE, &size);
    if (!bytes) {
        return false;
    }
    if (!file->is_text) {
        file->words = (uint32_t *)(void *)bytes;
        file->size = size;
        return true;
    }
    bool done = file->stage != RHW_SHADER_FRAGMENT || cli_shader_main_image(bytes, size, &file->main_image);
    if (!done) {
        cli_error(path, "out of memory");
    } else if (file->main_image.text && job->shades_models) {
        cli_error(
            path,
            "has mainImage() and no main(): it covers a picture, which rhw shader --run draws; what shades "
            "models has void main(), as rhw render --fragment-shader-template shows");
        done = false;
    } else if (file->main_image.text) {
        done = compile(file, file->main_image.text, file->main_image.size, job);
    } else {
        done = compile(file, bytes, size, job);
    }
    free(bytes);
    return done;
}

void cli_shader_file_close(struct cli_shader_file *file)
{
    rhw_shader_destroy(file->shader);
    free(file->entry_point);
    free(file->words);
    free(file->included);
    free(file->main_image.text);
    *file = (struct cli_shader_file){0};
}
