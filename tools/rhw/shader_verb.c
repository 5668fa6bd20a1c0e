// SPDX-License-Identifier: MIT
// rhw shader: what a shader is, what becomes of it, and what it computes.
#include "shader_job.h"
#include "shader_values.h"
#include "verbs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum {
    OPTION_OUT = 'o',
    OPTION_DEFINE = 'D',
    OPTION_INCLUDE = 'I',
    OPTION_PRINT = 256,
    OPTION_AFTER,
    OPTION_JSON,
    OPTION_ALL_ERRORS,
    OPTION_STRICT,
    OPTION_ENTRY,
    OPTION_CONSTANT,
    OPTION_RELAXED,
    OPTION_DEPFILE,
    OPTION_RUN, // those from here on belong to it
    OPTION_SIZE,
    OPTION_TIME,
    OPTION_MOUSE,
    OPTION_TEXTURE,
    OPTION_GROUPS,
    OPTION_BUFFER,
    OPTION_PUSH,
    OPTION_RESULT,
    OPTION_THREADS
};

static const struct cli_option options[] = {
    {"out", OPTION_OUT, "OUT",
     "write SPIR-V, to a file named .spv, or the program as C for rhw_add_shaders,\nto one named .c; with "
     "--run the "
     "picture, to one named .png"},
    {"print", OPTION_PRINT, "WHAT",
     "print info: stage, resources, inputs and outputs, which is what happens anyway;\n"
     "spirv: instructions of the module, as spirv-dis writes them;\n"
     "ir: the form that shaders are translated into, beside the lines of the source;\n"
     "bytecode: what the interpreter executes;\n"
     "code: machine code of x86-64 with AVX2, beside the form and the lines of the source"},
    {"after", OPTION_AFTER, "STEP", "with --print ir, the form behind build or passes; default passes"},
    {"json", OPTION_JSON, NULL, "print info as JSON"},
    {"all-errors", OPTION_ALL_ERRORS, NULL, "print every error of the compiler, not the first alone"},
    {"strict", OPTION_STRICT, NULL, "fail where the compiler warns"},
    {"entry", OPTION_ENTRY, "NAME", "entry point; default main, or the first of a module"},
    {"define", OPTION_DEFINE, "MACRO", "define a macro of GLSL: NAME, or NAME=VALUE"},
    {"include", OPTION_INCLUDE, "DIR", "where #include looks, behind the folder of the file"},
    {"constant", OPTION_CONSTANT, "CONSTANT",
     "value of a specialization constant: ID=NUMBER; what is written has it, too"},
    {"relaxed", OPTION_RELAXED, NULL,
     "take what is none for Vulkan as OpenGL has it: uniforms outside of blocks make one,\nwhat has no "
     "binding or "
     "location gets the next, and of two FILEs that of its name;\n--run does so anyway"},
    {"depfile", OPTION_DEPFILE, "FILE",
     "with --out, write a rule for make that names all files that OUT is made of"},
    {"run", OPTION_RUN, NULL,
     "draw with a fragment shader on all of a picture, or dispatch a compute shader"},
    {"size", OPTION_SIZE, "WxH", "pixels of the picture, or N for a square; default 512x512"},
    {"time", OPTION_TIME, "SECONDS", "what iTime has; default 0"},
    {"mouse", OPTION_MOUSE, "X,Y",
     "what iMouse has, in pixels from the top left, with mainImage() from the bottom left; default 0,0"},
    {"texture", OPTION_TEXTURE, "BINDING",
     "picture of a texture: SET:BINDING=FILE or NAME=FILE, 0:1=wood.png"},
    {"groups", OPTION_GROUPS, "X,Y,Z", "workgroups of a compute shader; default 1,1,1"},
    {"buffer", OPTION_BUFFER, "BINDING",
     "what a buffer holds at first: SET:BINDING=FILE, =BYTES of zeros,\nor =f32:, =i32: or =u32: and "
     "numbers: "
     "0:1=f32:1,2.5"},
    {"push", OPTION_PUSH, "VALUES", "push constants: a file, or numbers as of --buffer"},
    {"result", OPTION_RESULT, "BINDING",
     "what to do with a buffer at the end: SET:BINDING or NAME, and\n=FILE writes it, =f32, =i32 or =u32 "
     "prints it; of an image, =FILE.png"},
    {"threads", OPTION_THREADS, "N", "threads that draw, 1 to 64; default: all there are"},
    {"max-memory", CLI_BUDGET_MEMORY, "SIZE", "fail when it needs more than this; default: no limit"},
    {"max-time", CLI_BUDGET_TIME, "SECONDS", "fail when it takes longer, 0.1..86400; default 300"},
};

static const char notes[] =
    "FILE is GLSL for Vulkan (.vert, .frag, .comp; 4.50 where it has no #version) or SPIR-V (.spv). A vertex "
    "and a\n"
    "fragment shader may be given together, and are linked then.\n"
    "A fragment shader that is run or written as C alone covers the picture. It may read a vec2 at location "
    "0: 0,0 at the top left, 1,1 at the "
    "bottom right.\n"
    "Members of its uniform blocks or push constants with these names, or uniforms outside of blocks, are "
    "set:\n"
    "  vec3 iResolution   pixels of the picture, and 1\n"
    "  float iTime        seconds, as of --time\n"
    "  vec4 iMouse        pixels, as of --mouse, in xy, and in zw as if pressed there\n"
    "  int iFrame         number of the frame, of 60 in a second; iTimeDelta and iFrameRate are of that, "
    "too\n"
    "  vec4 iDate         1970, 0, 1: the first of January, and the seconds of --time\n"
    "  vec3 iChannelResolution[4]   pixels of the textures iChannel0 to iChannel3, and 1; 0 where there is "
    "none\n"
    "  float iChannelTime[4]        seconds, as of --time; iSampleRate is 44100\n"
    "A text with mainImage() in place of main(), as ShaderToy has it, need not declare these, nor iChannel0 "
    "to "
    "iChannel3.\n"
    "What no option gives is 0. A vertex shader that is run draws one triangle without attributes.\n"
    "Textures repeat and are filtered linearly. The picture has the numbers of the first output, clamped to "
    "0..1.\n\n"
    "Exit status: 0, 1 when a shader is refused or the work fails, 2 for a wrong command line.";

static const struct cli_verb verb = {
    .name = "shader",
    .operands = "FILE...",
    .summary = "Compiles and checks shaders, tells what they are, shows what becomes of them, and runs them.",
    .options = options,
    .option_count = (int)(sizeof options / sizeof *options),
    .notes = notes,
};

// Options --------------------------------------------------------------------------------------------

static bool has_room(const char *option, int count)
{
    if (count == CLI_SHADER_LIST) {
        cli_error(option, "is given more than %d times", CLI_SHADER_LIST);
    }
    return count < CLI_SHADER_LIST;
}

// NAME=VALUE is cut in place: arguments of the command line may be changed.
static bool parse_define(struct cli_shader_job *job, char *argument)
{
    if (!has_room("--define", job->macro_count)) {
        return false;
    }
    char *const equals = strchr(argument, '=');
    if (equals) {
        *equals = 0;
    }
    job->macros[job->macro_count++] = (struct glsl_macro){argument, equals ? equals + 1 : NULL};
    return true;
}

static bool parse_constant(struct cli_shader_job *job, const char *argument)
{
    char text[32];
    const char *const equals = strchr(argument, '=');
    int id, count;
    double number = 0;
    if (!has_room("--constant", job->constant_count)) {
        return false;
    }
    const size_t length = equals ? (size_t)(equals - argument) : sizeof text;
    if (length < sizeof text) {
        memcpy(text, argument, length);
        text[length] = 0;
    }
    const bool is_truth = equals && (strcmp(equals + 1, "true") == 0 || strcmp(equals + 1, "false") == 0);
    number = is_truth && equals[1] == 't' ? 1 : 0;
    if (length >= sizeof text || !cli_parse_int(text, 0, INT32_MAX, &id) ||
        (!is_truth && !cli_parse_numbers(equals + 1, 1, 1, &number, &count))) {
        cli_error("--constant", "'%s' is not ID=NUMBER, as in 7=0.5", argument);
        return false;
    }
    job->constants[job->constant_count++] =
        (struct cli_shader_constant){.argument = argument, .id = (uint32_t)id, .number = number};
    return true;
}

static bool parse_binding(struct cli_shader_bindings *bindings, const char *option, const char *argument)
{
    if (!has_room(option, bindings->count)) {
        return false;
    }
    struct cli_shader_binding binding = {.option = option, .argument = argument};
    unsigned set, number;
    int length = 0;
    const size_t name = strcspn(argument, "=");
    const bool has_numbers = argument[0] >= '0' && argument[0] <= '9';
    if (has_numbers && sscanf(argument, "%3u:%9u%n", &set, &number, &length) == 2 && (size_t)length == name &&
        set < RHW_SHADER_MAX_SETS) {
        binding.set = set;
        binding.binding = number;
    } else if (!has_numbers && name > 0 && name < sizeof binding.name) {
        memcpy(binding.name, argument, name);
    } else {
        length = -1;
    }
    if (length < 0 || argument[name] == 0 || argument[name + 1] == 0) {
        cli_error(option, "'%s' is not SET:BINDING=VALUE, with a SET of 0 to %d, and not NAME=VALUE",
                  argument, RHW_SHADER_MAX_SETS - 1);
        return false;
    }
    binding.value = argument + name + 1;
    bindings->list[bindings->count++] = binding;
    return true;
}

// A form that is misspelt is not to become the name of a file.
static bool check_result(const struct cli_shader_job *job)
{
    const struct cli_shader_binding *const result = &job->results.list[job->results.count - 1];
    if (cli_shader_values_are(result->value) || strpbrk(result->value, "./") ||
        strcmp(result->value, "-") == 0) {
        return true;
    }
    cli_error("--result", "'%s': %s is not f32, i32 or u32, and the name of a file has a point or a slash",
              result->argument, result->value);
    return false;
}

static bool parse_groups(int groups[3], const char *argument)
{
    double numbers[3];
    int count;
    bool is_right = cli_parse_numbers(argument, 1, 3, numbers, &count);
    for (int i = 0; is_right && i < 3; i++) {
        const double number = i < count ? numbers[i] : 1;
        is_right = number >= 0 && number <= RHW_MAX_WORKGROUP_COUNT && number == floor(number);
        groups[i] = is_right ? (int)number : 0;
    }
    if (!is_right) {
        cli_error("--groups", "'%s' is not X,Y,Z, each 0 to %d", argument, RHW_MAX_WORKGROUP_COUNT);
    }
    return is_right;
}

static bool parse_run_option(struct cli_shader_job *job, int id, const char *argument)
{
    int count;
    switch (id) {
    case OPTION_SIZE:
        if (cli_parse_size(argument, &job->width, &job->height)) {
            return true;
        }
        cli_error("--size", "'%s' is not WxH or one number, each 1..%d", argument, RHW_MAX_TARGET_SIZE);
        return false;
    case OPTION_TIME:
        if (cli_parse_numbers(argument, 1, 1, &job->time, &count)) {
            return true;
        }
        cli_error("--time", "'%s' is not a number of seconds", argument);
        return false;
    case OPTION_MOUSE:
        if (cli_parse_numbers(argument, 2, 2, job->mouse, &count)) {
            return true;
        }
        cli_error("--mouse", "'%s' is not X,Y", argument);
        return false;
    case OPTION_TEXTURE: return parse_binding(&job->textures, "--texture", argument);
    case OPTION_GROUPS: return parse_groups(job->groups, argument);
    case OPTION_BUFFER: return parse_binding(&job->buffers, "--buffer", argument);
    case OPTION_PUSH: job->push = argument; return true;
    case OPTION_RESULT: return parse_binding(&job->results, "--result", argument) && check_result(job);
    case OPTION_THREADS:
        if (cli_parse_int(argument, 1, 64, &job->threads)) {
            return true;
        }
        cli_error("--threads", "'%s' is not a number of 1 to 64", argument);
        return false;
    default: job->runs = true; return true;
    }
}

static bool parse_option(struct cli_shader_job *job, int id, char *argument)
{
    static const char *const prints[] = {"info", "spirv", "ir", "bytecode", "code"};
    static const char *const steps[] = {"build", "passes"};
    int choice;
    switch (id) {
    case OPTION_OUT: job->out = argument; return true;
    case OPTION_PRINT:
        choice = cli_choose("--print", argument, prints, 5);
        job->print = (enum cli_shader_print)choice;
        return choice >= 0;
    case OPTION_AFTER:
        choice = cli_choose("--after", argument, steps, 2);
        job->is_before_passes = choice == 0;
        job->has_step = true;
        return choice >= 0;
    case OPTION_JSON: job->json = true; return true;
    case OPTION_ALL_ERRORS: job->all_errors = true; return true;
    case OPTION_STRICT: job->is_strict = true; return true;
    case OPTION_RELAXED: job->is_relaxed = true; return true;
    case OPTION_DEPFILE: job->depfile = argument; return true;
    case OPTION_ENTRY: job->entry_point = argument; return true;
    case OPTION_DEFINE: return parse_define(job, argument);
    case OPTION_INCLUDE:
        if (!has_room("--include", job->folder_count)) {
            return false;
        }
        job->folders[job->folder_count++] = argument;
        return true;
    case OPTION_CONSTANT: return parse_constant(job, argument);
    case CLI_BUDGET_MEMORY:
    case CLI_BUDGET_TIME: return cli_parse_budget(&job->budget, id, argument);
    default: return parse_run_option(job, id, argument);
    }
}

static bool has_ending(const char *path, const char *ending)
{
    const size_t length = strlen(path), own = strlen(ending);
    return length > own && strcasecmp(path + length - own, ending) == 0;
}

// Report options that do not go together.
static bool check_options(const struct cli_shader_job *job, int files, const char *run_option)
{
    const bool writes_c = job->out && has_ending(job->out, ".c");
    if (job->out && !job->runs && !writes_c && !has_ending(job->out, ".spv")) {
        cli_error(job->out, "SPIR-V is named .spv, and C .c; a picture, .png, is drawn with --run");
    } else if (job->out && job->runs && !has_ending(job->out, ".png")) {
        cli_error(job->out, "a picture of --run is named .png");
    } else if (job->out && !job->runs && !writes_c && files > 1) {
        cli_error(job->out, "SPIR-V is written of one FILE");
    } else if (job->json && job->print > CLI_SHADER_INFO) {
        cli_error("--json", "goes with --print info alone");
    } else if (job->has_step && job->print != CLI_SHADER_FORM) {
        cli_error("--after", "goes with --print ir alone");
    } else if (job->depfile && (!job->out || job->runs)) {
        cli_error("--depfile", "goes with -o OUT.spv or OUT.c alone");
    } else if (run_option && !job->runs) {
        char name[32];
        snprintf(name, sizeof name, "--%s", run_option);
        cli_error(name, "goes with --run alone");
    } else if (job->runs && (job->json || job->print != CLI_SHADER_NOTHING)) {
        cli_error("--run", "prints results alone; --print and --json do without it");
    } else {
        return true;
    }
    return false;
}

// Work -----------------------------------------------------------------------------------------------

static const char identifier[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789";

static void write_text(void *user, const char *text, size_t size)
{
    (void)user;
    fwrite(text, 1, size, stdout);
}

static bool print_shader(const struct cli_shader_file *file, const struct cli_shader_job *job,
                         const rhw_shader_program *program)
{
    char message[RHW_SHADER_MESSAGE];
    const struct rhw_shader_def def = cli_shader_file_def(file);
    if (job->print == CLI_SHADER_INFO) {
        cli_shader_print_table(file);
        return true;
    }
    if (job->print == CLI_SHADER_SPIRV) {
        char *const text = glsl_disassemble(file->words, file->size, message, sizeof message);
        if (!text) {
            cli_error(file->path, "%s", message);
            return false;
        }
        fputs(text, stdout);
        free(text);
        return true;
    }
    if (job->print == CLI_SHADER_CODE) {
        if (rhw_shader_program_print_code(program, file->stage, write_text, NULL, message) != RHW_OK) {
            cli_error(file->path, "%s", message);
            return false;
        }
        return true;
    }
    const enum rhw_shader_stop stop = job->print == CLI_SHADER_BYTECODE ? RHW_SHADER_ASSEMBLED
                                      : job->is_before_passes           ? RHW_SHADER_BUILT
                                                                        : RHW_SHADER_PASSED;
    if (rhw_shader_print(file->words, file->size, &def, stop, write_text, NULL, message) != RHW_OK) {
        cli_error(file->path, "%s", message);
        return false;
    }
    return true;
}

static const char *name_in_folder(const char *path)
{
    const char *const slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

// Write the program as C, whose names begin as the file does.
static bool write_c(const struct cli_shader_file *files, int count, const rhw_shader_program *program,
                    const char *path)
{
    char name[64], source[512], message[RHW_SHADER_MESSAGE];
    const char *const file = name_in_folder(path);
    const size_t length = strlen(file) - strlen(".c");
    if (length >= sizeof name || strspn(file, identifier) < length || (file[0] >= '0' && file[0] <= '9')) {
        cli_error(
            path,
            "its name without .c begins the names of the program, so it is an identifier of C, of at most "
            "%zu letters, digits and underscores",
            sizeof name - 1);
        return false;
    }
    snprintf(name, sizeof name, "%.*s", (int)length, file);
    snprintf(source, sizeof source, "%.200s%s%.200s", name_in_folder(files[0].path), count > 1 ? " and " : "",
             count > 1 ? name_in_folder(files[1].path) : "");
    const struct rhw_shader_c_def def = {.name = name, .source = source};
    char *text;
    if (rhw_shader_program_emit_c(program, &def, &text, message) != RHW_OK) {
        cli_error(files[0].path, "%s", message);
        return false;
    }
    const bool written = cli_shader_write_bytes(path, text, strlen(text));
    rhw_shader_free_text(text);
    return written;
}

static bool check_constants(const struct cli_shader_job *job, const char *path)
{
    for (int i = 0; i < job->constant_count; i++) {
        if (!job->constants[i].is_used) {
            cli_error("--constant", "'%s': %s has no constant %u", job->constants[i].argument, path,
                      (unsigned)job->constants[i].id);
            return false;
        }
    }
    return true;
}

static bool work(struct cli_shader_job *job, struct cli_shader_file *files, int count)
{
    rhw_shader_program *program = NULL;
    const bool writes_c = job->out && has_ending(job->out, ".c");
    const bool needs_program = job->runs || writes_c || job->print == CLI_SHADER_CODE;
    bool done = check_constants(job, files[0].path) && cli_shader_link(files, count, needs_program, &program);
    if (done && job->runs) {
        done = cli_shader_run(job, files, count, program);
    } else if (done && writes_c) {
        done = write_c(files, count, program, job->out);
    } else if (done && job->out) {
        done = cli_shader_write_bytes(job->out, files[0].words, files[0].size);
    }
    done = done && (!job->depfile || cli_shader_write_depfile(job->depfile, job->out, files, count));
    if (done && !job->runs && job->json) {
        cli_shader_print_json(files, count);
    } else if (done && !job->runs && (job->print != CLI_SHADER_NOTHING || !job->out)) {
        job->print = job->print == CLI_SHADER_NOTHING ? CLI_SHADER_INFO : job->print;
        for (int i = 0; i < count && done; i++) {
            done = print_shader(&files[i], job, program);
        }
    }
    rhw_shader_program_destroy(program);
    return done;
}

int cli_shader(int argc, char **argv)
{
    static struct cli_shader_job job = {
        .print = CLI_SHADER_NOTHING, .groups = {1, 1, 1}, .budget = {.seconds = 300.0}};
    struct cli_shader_file files[CLI_SHADER_FILES] = {0};
    struct cli_parser parser;
    const char *run_option = NULL;
    cli_parser_start(&parser, &verb, argc, argv);
    int id;
    while ((id = cli_parser_next(&parser)) > 0) {
        for (size_t i = 0; id > OPTION_RUN && id <= OPTION_THREADS && i < sizeof options / sizeof *options;
             i++) {
            run_option = options[i].id == id ? options[i].name : run_option;
        }
        if (!parse_option(&job, id, (char *)parser.argument)) {
            return CLI_USAGE;
        }
    }
    if (id == CLI_OPTION_STOP) {
        return parser.status;
    }
    if (!cli_parser_operands(&parser, 1, CLI_SHADER_FILES) ||
        !check_options(&job, parser.operand_count, run_option)) {
        return CLI_USAGE;
    }
    if ((job.out && !cli_output_file_check(job.out)) ||
        (job.depfile && !cli_output_file_check(job.depfile))) {
        return CLI_FAILED;
    }
    cli_budget_apply(&job.budget, parser.operands[0]);
    bool done = true;
    int count = 0;
    while (done && count < parser.operand_count) {
        done = cli_shader_file_open(&files[count], parser.operands[count], &job);
        count++;
    }
    done = done && cli_shader_match(files, count);
    for (int i = 0; i < count && done; i++) {
        done = cli_shader_file_translate(&files[i], &job);
    }
    const bool is_usage = done && job.runs && !cli_shader_check_run(&job, files, count);
    done = done && !is_usage && work(&job, files, count);
    for (int i = 0; i < count; i++) {
        cli_shader_file_close(&files[i]);
    }
    return is_usage ? CLI_USAGE : done ? CLI_OK : CLI_FAILED;
}
