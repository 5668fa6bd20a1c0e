// SPDX-License-Identifier: MIT
// rhw thumbs: a small picture of every model in a folder. Each is drawn by a process of its own with one thread, as
// many at a time as there are cores: small models keep all cores busy so, and a file that takes its process down takes
// no other. What is there, newer than its model and drawn with the same options is left alone, so a run that was ended
// goes on where it stopped.
#include "budget.h"
#include "file.h"
#include "machine.h"
#include "options.h"
#include "output_file.h"
#include "render_job.h"
#include "render_look.h"
#include "subprocess.h"
#include "thumb_mark.h"
#include "thumb_name.h"
#include "rhw/rhw.h"
#include "verbs.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

enum {
    OPTION_OUT = 'o',
    OPTION_SIZE = 's',
    OPTION_QUIET = 'q',
    OPTION_JOBS = 'j',
    OPTION_BACKGROUND = 256,
    OPTION_FORCE,
    OPTION_FIT,
    OPTION_MEMORY = CLI_BUDGET_MEMORY,
    OPTION_TIME = CLI_BUDGET_TIME,
    OPTION_TEXTURE = CLI_BUDGET_TEXTURE,
    OPTION_CONFINE = CLI_BUDGET_CONFINE
};
enum { PATH_SIZE = 4096, DEEPEST = 32 };

static const struct cli_option options[] = {
    {"out", OPTION_OUT, "DIR", "the folder for the pictures, made where it is missing"},
    {"size", OPTION_SIZE, "WxH", "pixels, each way 1..16384, or N for a square; default 256x256"},
    {"background", OPTION_BACKGROUND, "COLOR", "as for rhw render; default transparent"},
    {"fit", OPTION_FIT, "[WHAT]",
     "fit each model into its picture, also when its file has cameras: its\nsubject (the default) or all, as "
     "for rhw render"},
    {"force", OPTION_FORCE, NULL,
     "draw also what is there, newer than its model and drawn with the same options"},
    {"jobs", OPTION_JOBS, "N",
     "models at a time, 1..64; default: one for each core that the process may use"},
    {"max-memory", OPTION_MEMORY, "SIZE",
     "fail for a model that needs more than this, for example 512M or 2G; default: what the machine "
     "has,\ndivided "
     "among the models at a time"},
    {"max-time", OPTION_TIME, "SECONDS", "fail for a model that takes longer, 0.1..86400; default 120"},
    {"max-texture", OPTION_TEXTURE, "N", "as for rhw render"},
    {"confine", OPTION_CONFINE, "FOLDER",
     "read no file outside this folder that a model names or a link leads to;\ndefault DIR"},
    {"quiet", OPTION_QUIET, NULL, "no warnings, and no count at the end"},
};

static const char notes[] = "Takes files that end as models do (.glb, .gltf, .obj, .ply, .stl, .3mf, .fbx, "
                            ".dae, .3ds, .off and more), also in\n"
                            "folders within DIR. The picture of DIR/a/b.glb is OUT/a/b.glb.png. One line "
                            "tells of each model that cannot be drawn;\n"
                            "the others are. One line tells of each format of models that is not supported. "
                            "A picture that is newer than its\n"
                            "model is kept, unless it was drawn with another --size, --background, --fit, "
                            "--max-texture or --confine, which its\n"
                            "file tells; one that rhw thumbs has not made tells nothing and is kept.\n\n"
                            "Exit status: 0, 1 when a model could not be drawn, 2 for a wrong command line.";

static const struct cli_verb verb = {
    .name = "thumbs",
    .operands = "DIR -o OUT",
    .summary = "Draws a small picture of every model in a folder.",
    .options = options,
    .option_count = (int)(sizeof options / sizeof *options),
    .notes = notes,
};

struct thumbs {
    const char *in, *out, *background;
    const char *fit; // an option; NULL: the file's camera, where it has one
    int width, height, jobs;
    bool quiet, force, keeps_memory;
    struct cli_budget budget;   // of each model
    struct cli_render_job look; // its background
    char memory[48], seconds[32], texture[32];
    char mark[CLI_THUMB_MARK_SIZE - 32]; // what is said of every model
    int levels; // of folders above DIR that files may be read in; negative: they may elsewhere
    char confine[PATH_SIZE + 16];
    int running, drawn, kept, failed, left_out;
    struct cli_thumb_unread unread; // files of formats that nothing here reads
};

// Waits for one of the processes that draw.
static void reap(struct thumbs *t)
{
    const int status = system_subprocess_wait();
    t->running--;
    if (status == CLI_OK) {
        t->drawn++;
    } else {
        t->failed++;
    }
}

// In the child.
static int draw(int count, char **arguments)
{
    cli_output_files_guard();
    return cli_render(count, arguments);
}

// False where no process can be started for it.
static bool start_drawing(const struct thumbs *t, const char *model, const char *picture, const char *mark)
{
    char size[32];
    snprintf(size, sizeof size, "%dx%d", t->width, t->height);
    const char *arguments[24] = {
        "render",    "--threads",    "1",  "--format", "png", "-o",           picture,
        "--literal", "--thumb-mark", mark, "--size",   size,  "--background", t->background};
    int count = 14;
    if (t->keeps_memory) {
        arguments[count++] = t->memory;
    }
    arguments[count++] = t->confine;
    arguments[count++] = t->seconds;
    if (t->fit) {
        arguments[count++] = t->fit;
    }
    if (t->budget.texture > 0) {
        arguments[count++] = t->texture;
    }
    if (t->quiet) {
        arguments[count++] = "--quiet";
    }
    arguments[count++] = "--";
    arguments[count++] = model;
    return system_subprocess_start(draw, count, (char **)arguments);
}

// Whether a path without links lies in a folder; `length`: of the folder, without a slash at its end.
static bool lies_in(const char *path, const char *folder, size_t *length)
{
    *length = strlen(folder);
    *length -= *length > 0 && folder[*length - 1] == '/'; // of the root
    return strncmp(path, folder, *length) == 0 && (path[*length] == '/' || path[*length] == '\0');
}

// Whether a file, which may be a link, lies in a folder.
static bool is_within(const char *path, const char *folder)
{
    char *const target = system_file_resolve(path), *const bounds = system_file_resolve(folder);
    size_t length;
    const bool within = target && bounds && lies_in(target, bounds, &length);
    free(target);
    free(bounds);
    return within;
}

// Whether a path, of a file or of a folder, is a link out of OUT, which is told. It came with the models, where OUT
// lies among them, and may lead to what is none of theirs.
static bool is_link_out(const struct thumbs *t, const char *path)
{
    const bool is_out = system_file_is_link(path) && !is_within(path, t->out);
    if (is_out) {
        cli_error(path, "is a link out of %s; no picture is written there", t->out);
    }
    return is_out;
}

// Whether no picture is to be written there. A pipe would be waited for, to read it and to write it. A link may lead to
// a model or to its texture, and is followed to a thumbnail alone.
static bool is_taken(const struct thumbs *t, const char *picture)
{
    struct stat status;
    if (stat(picture, &status) != 0) {
        return false;
    }
    if (!S_ISREG(status.st_mode)) {
        cli_error(picture, "is there and is no regular file; no picture is written there");
        return true;
    }
    if (is_link_out(t, picture)) {
        return true;
    }
    if (system_file_is_link(picture) && !cli_thumb_mark_differs(picture, "")) {
        cli_error(picture, "is a link to a file that is no thumbnail; no picture is written there");
        return true;
    }
    return false;
}

// `depth`: folders below DIR.
static bool start(struct thumbs *t, const char *model, const char *picture, int depth)
{
    char mark[CLI_THUMB_MARK_SIZE];
    if (is_taken(t, picture)) {
        t->failed++;
        return true;
    }
    snprintf(mark, sizeof mark, "%s --confine %d", t->mark, t->levels < 0 ? -1 : t->levels + depth);
    if (!t->force && system_file_is_newer(picture, model) && !cli_thumb_mark_differs(picture, mark)) {
        t->kept++;
        return true;
    }
    while (t->running >= t->jobs) {
        reap(t);
    }
    if (!start_drawing(t, model, picture, mark)) {
        cli_error(model, "no process can be started for it: %s", strerror(errno));
        return false;
    }
    t->running++;
    return true;
}

// With the folders that it lies in.
static bool make_folder(const char *path)
{
    char part[PATH_SIZE];
    struct stat status;
    bool made = true;
    for (size_t i = 1; i < PATH_SIZE && path[i - 1] != '\0'; i++) {
        if ((path[i] == '/' || path[i] == '\0') && path[i - 1] != '/') {
            memcpy(part, path, i);
            part[i] = '\0';
            made = system_folder_make(part);
        }
    }
    if (made || (errno == EEXIST && stat(path, &status) == 0 && S_ISDIR(status.st_mode))) {
        return true;
    }
    cli_error(path, "cannot be made: %s", strerror(errno == EEXIST ? ENOTDIR : errno));
    return false;
}

// Adds "/name" and an ending; false where the path gets too long.
static bool join(char path[PATH_SIZE], const char *folder, const char *name, const char *ending)
{
    const int length = snprintf(path, PATH_SIZE, "%s/%s%s", folder, name, ending);
    if (length < PATH_SIZE) {
        return true;
    }
    cli_error(name, "its path is longer than %d bytes", PATH_SIZE - 1);
    return false;
}

// That no model may read out of.
static const char *folder_of(const struct thumbs *t)
{
    return t->budget.folder ? t->budget.folder : t->in;
}

// How many folders --confine lies above DIR, or −1: it lies elsewhere. A path would make the bytes of pictures depend
// on where the models lie.
static int count_levels(const struct thumbs *t)
{
    char *const in = system_file_resolve(t->in), *const bounds = system_file_resolve(folder_of(t));
    size_t length = 0;
    int levels = -1;
    if (in && bounds && lies_in(in, bounds, &length)) {
        levels = 0;
        for (const char *c = in + length; *c; c++) {
            levels += *c == '/' && c[1] != '\0';
        }
    }
    free(in);
    free(bounds);
    return levels;
}

// Whether a link leads to a file neither of DIR nor of the folder that may be read: who packed the models may have
// meant a file that is none of theirs.
static bool leads_out(const struct thumbs *t, const char *link)
{
    return !is_within(link, t->in) && !is_within(link, folder_of(t));
}

static bool walk(struct thumbs *t, const char *in, const char *out, int depth);

// False: nothing more can be done.
static bool visit(struct thumbs *t, const char *in, const char *out, const char *name, int depth)
{
    char model[PATH_SIZE], picture[PATH_SIZE];
    struct stat status;
    if (!join(model, in, name, "")) {
        t->failed++;
        return true;
    }
    if (stat(model, &status) != 0) {
        return true; // it is gone, or a link to nowhere
    }
    if (S_ISDIR(status.st_mode) && system_file_is_link(model)) {
        if (!t->quiet) {
            cli_warning(model, "is a link to a folder, and is left out"); // it may lead back here
        }
        return true;
    }
    const bool is_folder = S_ISDIR(status.st_mode);
    if (!is_folder && (!S_ISREG(status.st_mode) || !cli_thumb_is_model(name))) {
        cli_thumb_count_unread(&t->unread, S_ISREG(status.st_mode) ? name : "");
        return true;
    }
    if (!is_folder && system_file_is_link(model) && leads_out(t, model)) {
        t->left_out++;
        if (!t->quiet) {
            cli_warning(model, "is a link out of %s, and is left out; see --confine", t->in);
        }
        return true;
    }
    if (is_folder && depth >= DEEPEST) {
        cli_error(model, "lies deeper than %d folders", DEEPEST);
        t->failed++;
        return true;
    }
    if (!join(picture, out, name, is_folder ? "" : ".png")) {
        t->failed++;
        return true;
    }
    if (is_folder) {
        if (is_link_out(t, picture)) {
            t->failed++;
            return true;
        }
        return walk(t, model, picture, depth + 1);
    }
    return make_folder(out) && start(t, model, picture, depth);
}

static int by_name(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

// The names in a folder that do not begin with a point, in order; to be freed, each and all. −1 with errno.
static int list_folder(const char *folder, char ***names)
{
    int count = 0, capacity = 0;
    bool complete = true;
    DIR *const entries = opendir(folder);
    *names = NULL;
    if (!entries) {
        return -1;
    }
    for (const struct dirent *entry = readdir(entries); entry && complete; entry = readdir(entries)) {
        if (entry->d_name[0] == '.') {
            continue;
        }
        if (count == capacity) {
            capacity = capacity > 0 ? capacity * 2 : 64;
            char **const larger = realloc(*names, (size_t)capacity * sizeof *larger);
            *names = larger ? larger : *names;
            complete = larger != NULL;
        }
        char *const name = complete ? strdup(entry->d_name) : NULL;
        complete = name != NULL;
        if (complete) {
            (*names)[count++] = name;
        }
    }
    closedir(entries);
    if (!complete) {
        while (count-- > 0) {
            free((*names)[count]);
        }
        free(*names);
        errno = ENOMEM;
        return -1;
    }
    qsort(*names, (size_t)count, sizeof **names, by_name);
    return count;
}

static bool walk(struct thumbs *t, const char *in, const char *out, int depth)
{
    char **names;
    const int count = list_folder(in, &names);
    if (count < 0) {
        cli_error(in, "cannot be read: %s", strerror(errno));
        t->failed++;
        return depth > 0;
    }
    bool going = true;
    for (int i = 0; i < count; i++) {
        // Pictures may lie within the folder of the models.
        going = going && visit(t, in, out, names[i], depth);
        free(names[i]);
    }
    free(names);
    return going;
}

// Reports where not.
static bool can_read(const char *folder)
{
    DIR *const entries = opendir(folder);
    if (entries) {
        closedir(entries);
    } else {
        cli_error(folder, "cannot be read: %s", strerror(errno));
    }
    return entries != NULL;
}

static bool parse_background(struct thumbs *t, const char *argument)
{
    t->background = argument;
    if (!cli_parse_look(&t->look, CLI_LOOK_BACKGROUND, argument)) {
        return false;
    }
    if (t->look.background == SCENE_BACKGROUND_PANORAMA) {
        cli_error("--background", "environment is for rhw render, which has an --environment FILE to show");
        return false;
    }
    return true;
}

static bool parse_option(struct thumbs *t, int id, const char *argument)
{
    bool fit_all;
    switch (id) {
    case OPTION_OUT: t->out = argument; return true;
    case OPTION_BACKGROUND: return parse_background(t, argument);
    case OPTION_FORCE: t->force = true; return true;
    case OPTION_FIT:
        if (!cli_parse_fit(argument, &fit_all)) {
            return false;
        }
        t->fit = fit_all ? "--fit=all" : "--fit";
        return true;
    case OPTION_QUIET: t->quiet = true; return true;
    case OPTION_JOBS:
        if (cli_parse_int(argument, 1, RHW_MAX_THREADS, &t->jobs)) {
            return true;
        }
        cli_error("--jobs", "'%s' is not a number of 1 to %d", argument, RHW_MAX_THREADS);
        return false;
    case OPTION_MEMORY:
    case OPTION_TIME:
    case OPTION_TEXTURE:
    case OPTION_CONFINE: return cli_parse_budget(&t->budget, id, argument);
    default:
        if (cli_parse_size(argument, &t->width, &t->height)) {
            return true;
        }
        cli_error("--size", "'%s' is not WxH or one number, each 1..%d", argument, RHW_MAX_TARGET_SIZE);
        return false;
    }
}

// What each process is told; cli_parse_budget has looked at the values.
static bool share_budget(struct thumbs *t)
{
    const size_t megabyte = 1 << 20, least = 256;
    const size_t machine = system_machine_memory() / megabyte;
    const size_t share = machine / (size_t)t->jobs > least ? machine / (size_t)t->jobs : least;
    snprintf(t->memory, sizeof t->memory, "--max-memory=%zuM",
             t->budget.memory > 0 ? t->budget.memory / megabyte : share);
    snprintf(t->seconds, sizeof t->seconds, "--max-time=%g",
             t->budget.seconds > 0.0 ? t->budget.seconds : 120.0);
    snprintf(t->texture, sizeof t->texture, "--max-texture=%u", t->budget.texture);
    const char *const folder = folder_of(t);
    if (snprintf(t->confine, sizeof t->confine, "--confine=%s", folder) < (int)sizeof t->confine) {
        return true;
    }
    cli_error(folder, "its path is longer than %d bytes", PATH_SIZE);
    return false;
}

// What other pictures follow from, in one form however it is written.
static void write_mark(struct thumbs *t)
{
    char color[8];
    const uint8_t *const c = t->look.background_color;
    snprintf(color, sizeof color, "%02x%02x%02x", c[0], c[1], c[2]);
    const char *const background = t->look.background == SCENE_BACKGROUND_TRANSPARENT ? "transparent"
                                   : t->look.background == SCENE_BACKGROUND_DEFAULT   ? "default"
                                                                                      : color;
    snprintf(t->mark, sizeof t->mark, "--size %dx%d --background %s%s%s%s%s", t->width, t->height, background,
             t->fit ? " " : "", t->fit ? t->fit : "", t->budget.texture > 0 ? " " : "",
             t->budget.texture > 0 ? t->texture : "");
    t->levels = count_levels(t);
}

int cli_thumbs(int argc, char **argv)
{
    const int cores = system_machine_processors();
    struct thumbs t = {.width = 256,
                       .height = 256,
                       .background = "transparent",
                       .look.background = SCENE_BACKGROUND_TRANSPARENT,
                       .jobs = cores > RHW_MAX_THREADS ? RHW_MAX_THREADS : cores};
    struct cli_parser parser;
    cli_parser_start(&parser, &verb, argc, argv);
    int id;
    while ((id = cli_parser_next(&parser)) > 0) {
        if (!parse_option(&t, id, parser.argument)) {
            return CLI_USAGE;
        }
    }
    if (id == CLI_OPTION_STOP) {
        return parser.status;
    }
    if (!cli_parser_operands(&parser, 1, 1)) {
        return CLI_USAGE;
    }
    if (!t.out) {
        cli_error("thumbs", "-o OUT is missing: where should the pictures go?");
        return CLI_USAGE;
    }
    if (*t.out == '\0') {
        cli_error("--out", "'': a folder needs a name");
        return CLI_USAGE;
    }
    t.in = parser.operands[0];
    if (!share_budget(&t)) {
        return CLI_USAGE;
    }
    if (!can_read(t.in) || !can_read(folder_of(&t)) || !make_folder(t.out)) {
        return CLI_FAILED;
    }
    write_mark(&t);
    t.keeps_memory = cli_budget_check(&t.budget);
    const bool complete = walk(&t, t.in, t.out, 0);
    while (t.running > 0) {
        reap(&t);
    }
    if (!t.quiet) {
        cli_thumb_tell_unread(&t.unread, t.in);
    }
    if (complete && t.drawn + t.kept + t.failed + t.left_out == 0) {
        cli_error(t.in, "has no file whose name is that of a model%s",
                  t.unread.count > 0 ? " that is supported" : "");
        return CLI_FAILED;
    }
    if (!t.quiet) {
        printf("%d drawn, %d kept, %d failed\n", t.drawn, t.kept, t.failed);
    }
    return complete && t.failed == 0 ? CLI_OK : CLI_FAILED;
}
